// The agents: what each is doing, and what is known of the chosen one.

const STEPS_BEFORE = 2;
const STEPS_SHOWN = 7;
// While the run goes on, what is known of the chosen agent is renewed every so many changes.
const GROWTHS_SHOWN = 4;
const entries = [];
let shownKey = "";

function setUpAgents() {
  AGENTS.forEach((agent, index) => {
    const dot = element("span", { className: "dot" });
    dot.style.background = `var(--agent-${index % COLOURS})`;
    const doing = element("span", {});
    const place = element("span", { className: "place" });
    const button = element("button", { type: "button" }, dot, element("span", {}, agent.name), doing, place);
    button.addEventListener("click", () => show({ agent: view.agent === index ? null : index }));
    byId("agents").append(element("li", {}, button));
    entries.push({ button, doing, place });
  });
  onChange(drawAgents);
}

function drawAgents() {
  AGENTS.forEach((agent, index) => {
    const { button, doing, place } = entries[index];
    button.setAttribute("aria-pressed", view.agent === index);
    doing.textContent = activityAt(agent, view.time);
    place.textContent = toldPlace(placeAt(agent, view.time));
  });
  byId("now").textContent = describeNow();
  drawChosenAgent();
}

/** What goes on, in one line. */
function describeNow() {
  const parts = [`Window ${windowAt(view.time)}`];
  const [meeting] = nextMeetings(view.time);
  if (!RUN.has_meetings || !meeting) return parts[0];
  const wait = startOf(meeting) - view.time;
  parts.push(wait > 0
    ? `meeting ${roundName(meeting)} in ${told(wait)} s` : `meeting ${roundName(meeting)} is on`);
  return parts.join(" · ");
}

function drawChosenAgent() {
  if (view.agent === null) {
    if (shownKey !== "none") {
      const hint = "Choose an agent, here or on the map, to see its task, plan and next meeting.";
      byId("agent").replaceChildren(element("p", { className: "quiet" }, hint));
    }
    shownKey = "none";
    return;
  }
  const agent = AGENTS[view.agent];
  const done = agent.steps.filter((step) => step[0] <= view.time).length;
  const satisfied = agent.satisfied_s.filter((time) => time <= view.time).length;
  const meeting = nextMeetingOf(agent, view.time);
  const age = Math.floor(growths / GROWTHS_SHOWN);
  const key = [view.agent, done, satisfied, meeting ? ROUNDS.indexOf(meeting) : "", age].join(" ");
  if (key === shownKey) return;
  shownKey = key;
  byId("agent").replaceChildren(
    element("h3", {}, agent.name),
    element("p", {}, element("code", {}, agent.task)),
    ...(agent.soft_task ? [element("p", {}, "if it pays: ", element("code", {}, agent.soft_task))] : []),
    element("p", {}, describeTask(agent, satisfied)),
    element("p", {}, describeNext(agent, meeting)),
    stepTable(agent, done),
  );
}

function describeTask(agent, satisfied) {
  const own = DATA.metrics.agents[agent.name];
  return `Satisfied ${satisfied} × by now, ${agent.satisfied_s.length} × in all${describeAudit(agent)}. `
    + `One cycle takes ${told(own.mean_cycle_s)} s on average; ${told(own.distance_m)} m driven in all.`;
}

function describeAudit(agent) {
  if (DATA.audit === null) return "";
  const found = DATA.audit.tasks[agent.name];
  return `; the audit counts ${told(found?.satisfied, 0)}`
    + `${found?.verdict ? ` and finds it ${found.verdict}` : ""}`;
}

function describeNext(agent, round) {
  if (!round) return `No further meeting ${isLive() ? "is agreed on yet" : "was agreed on"}.`;
  const own = round.members.find((member) => member.agent === agent.name);
  if (!RUN.has_meetings) {
    return `Next turn ${roundName(round)}: to ${toldPlace(own.place_m)} by ${told(own.planned_arrival_s)} s.`;
  }
  const came = own.arrival_s === null ? "" : `, and came at ${told(own.arrival_s)} s`;
  return `Next meeting ${roundName(round)}: at ${toldPlace(own.place_m)} after step ${own.after_step}; `
    + `it was to be there at ${told(own.planned_arrival_s)} s${came}. It begins at `
    + `${told(startOf(round))} s.`;
}

/** The steps round the present one, as they were done. */
function stepTable(agent, done) {
  const first = Math.max(done - STEPS_BEFORE, 0);
  const steps = agent.steps.slice(first, first + STEPS_SHOWN);
  const rows = steps.map(([time, index, region, action]) => [
    String(index), region || "–", action || "visit", told(time),
  ]);
  const columns = [["step", true], ["region", false], ["action", false], ["done at/s", true]];
  return tableOf("Its plan, as it was carried out", columns, rows, done - first);
}
