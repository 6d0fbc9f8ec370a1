// What was found: verdict, figures, audit.

const VIOLATIONS_ON_TOP = 5;
// While the run goes on, figures are renewed every so many changes.
const GROWTHS_TOLD = 4;
let toldVerdict;
let toldIncidents;

/** As the audit says or, of a run that was just looked on, as the run says itself. */
const verdict = () => (DATA.audit ? DATA.audit.verdict : RUN.verdict);

function setUpFindings() {
  byId("title").textContent = `${RUN.scenario} · ${RUN.method}`;
  if (DATA.feed) byId("source").textContent = "Everything on this page comes from the run's messages.";
  drawFindings();
  onGrowth(() => {
    drawSubtitle();
    drawVerdict();
    if (!isLive() || growths % GROWTHS_TOLD === 1) drawFindings();
  });
}

function drawFindings() {
  drawSubtitle();
  byId("figures").replaceChildren(...keyFigures().map(figureTile));
  drawVerdict();
  // Not each time: a reader may be in the midst of it.
  if (toldIncidents === DATA.incidents.length && toldVerdict === verdict()) return;
  toldIncidents = DATA.incidents.length;
  toldVerdict = verdict();
  showViolations();
  showAudit();
}

function drawSubtitle() {
  byId("subtitle").textContent = [
    `${AGENTS.length} agents`, `${told(RUN.end_s)} s simulated`,
    `R = ${told(RUN.range_m, 2)} m, T_c = ${told(RUN.period_s)} s, D_c = ${told(RUN.duration_s)} s`,
    ...(RUN.solver === null ? [] : [`solver ${RUN.solver}`]),
    ...(RUN.seed === null ? [] : [`seed ${RUN.seed}`]),
  ].join(" · ");
}

function drawVerdict() {
  const isFine = verdict() === "ok";
  byId("map-title").textContent = isLive() ? "What is going on" : "What happened";
  byId("verdict").textContent = state || `verdict: ${isFine ? "ok" : "FAILED"}`;
  byId("verdict").classList.toggle("ok", isFine && !isLive());
  byId("verdict").classList.toggle("running", isLive());
}

/** What failed; nothing of a run that goes on. */
const violations = () => (Array.isArray(verdict()) ? verdict() : []);

function showViolations() {
  const lines = violations();
  const shown = lines.slice(0, VIOLATIONS_ON_TOP).map((line) => element("li", {}, line));
  const rest = lines.length - shown.length;
  const list = byId("violations");
  list.replaceChildren(...shown, ...(rest > 0 ? [element("li", {}, `and ${rest} more, below`)] : []));
  list.hidden = lines.length === 0;
}

/** [what, value, unit] of what is available. */
function keyFigures() {
  const team = DATA.metrics.team;
  const { windows } = DATA;
  const kept = windows.filter((own) => own.satisfied).length;
  const figures = [
    ["windows kept", `${kept} of ${windows.length}`, ""],
    ["tasks satisfied", told(team.tasks_satisfied, 0), ""],
    ["additional time per agent and meeting", team.additional_s, "s"],
    ["of it detour", team.detour_s, "s"],
    ["of it waiting", team.wait_s, "s"],
    ["lost of each window", team.lost_per_window_s, "s"],
    ["longest makespan", team.makespan_max_s, "s"],
    ["oldest information", team.information_age_max_s, "s"],
    ["largest settled deviation", told(team.deviation_settled_max, 3), ""],
    ["driven", team.distance_m, "m"],
    ["messages", told(team.messages, 0), ""],
  ];
  return figures.filter(([, value]) => value !== null && value !== "–");
}

function figureTile([what, value, unit]) {
  const shown = element("dd", {}, told(value), element("small", {}, unit && ` ${unit}`));
  return element("div", {}, element("dt", {}, what), shown);
}

function showAudit() {
  const parts = DATA.audit ? auditParts(DATA.audit) : [element("p", {}, describeMissingAudit())];
  const lines = violations();
  if (verdict()) parts.push(element("h3", {}, lines.length ? "Violations" : "No violations"));
  parts.push(element("ul", {}, ...lines.map((line) => element("li", {}, line))));
  if (DATA.incidents.length) parts.push(incidentTable());
  byId("audit").replaceChildren(...parts);
}

/** Why there is no audit of a run that was just looked on. */
function describeMissingAudit() {
  const how = "Its bag is audited by tlcomm check, and shown with the audit by tlcomm report.";
  return verdict()
    ? `This is what the run itself says at its end. ${how}` : `A run is audited when it is over. ${how}`;
}

function auditParts(audit) {
  const { equal, rounds } = audit.strategies;
  const parts = [taskTable(audit), promiseTable(audit)];
  if (audit.note) parts.unshift(element("p", {}, `The bag was read only in part: ${audit.note}`));
  for (const [name, lines] of Object.entries(audit.unavailable)) {
    lines.forEach((line) => parts.push(element("p", {}, `Not available: ${name}: ${line}`)));
  }
  parts.push(element("p", {}, `Strategies agreed: ${equal} of ${rounds}.`));
  return parts;
}

function taskTable(audit) {
  const columns = [
    ["agent", false], ["satisfied", true], ["claimed", true], ["longest gap/s", true],
    ["task", false], ["settled at/s", true], ["makespan/s", true], ["driven/m", true],
    ["messages", true],
  ];
  const rows = Object.entries(audit.tasks).map(([name, own]) => {
    const figures = DATA.metrics.agents[name];
    return [
      name, told(own.satisfied, 0), told(own.claimed, 0), told(own.longest_gap_s), own.verdict ?? "–",
      told(own.settled_s, 3), told(figures.makespan_s), told(figures.distance_m),
      told(figures.messages, 0),
    ];
  });
  return tableOf("Tasks", columns, rows);
}

function promiseTable(audit) {
  const rows = audit.guarantees.map(({ promise, kept, ...figures }) => [
    promise, kept ? "kept" : "BROKEN",
    Object.entries(figures)
      .filter(([, value]) => typeof value === "number")
      .map(([name, value]) => `${name} ${told(value, Number.isInteger(value) ? 0 : 3)}`).join(", "),
  ]);
  return tableOf("What the method promises", [["promise", false], ["", false], ["found", false]], rows);
}

function incidentTable() {
  const rows = DATA.incidents.map((own) => [
    told(own.time_s, 3), own.agent, own.kind, [own.region, own.action].join(" "), own.detail,
  ]);
  const columns = [["time/s", true], ["agent", false], ["what", false], ["at", false], ["detail", false]];
  return tableOf("Faults and changes", columns, rows);
}
