// The run: what is known of any time.

const DATA = JSON.parse(byId("data").textContent);
const RUN = DATA.run;
const AGENTS = DATA.agents;
const ROUNDS = DATA.rounds;
const NUMBER_OF = new Map(AGENTS.map((agent, index) => [agent.name, index]));
const COLOURS = 8;

/** Names without what they all begin with. */
function shortNames(names) {
  const parts = names.map((name) => name.split("_"));
  const isShared = names.length > 1 && parts.every((own) => own.length > 1 && own[0] === parts[0][0]);
  return isShared ? parts.map((own) => own.slice(1).join("_")) : names;
}
const SHORT = shortNames(AGENTS.map((agent) => agent.name));

const agentColour = (index) => styled(`--agent-${index % COLOURS}`);

/** The last index whose value isn't above a limit, in ascending values; -1 if all are above. */
function lastUpTo(values, limit) {
  let low = 0;
  let high = values.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] <= limit) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** Where an agent is at a time; null before anything is known of it. */
function placeAt(agent, time) {
  const { times_s: times, x_m: x, y_m: y } = agent.path;
  if (times.length === 0) return null;
  const last = Math.max(lastUpTo(times, time), 0);
  if (last === times.length - 1 || time <= times[0]) return [x[last], y[last]];
  const share = (time - times[last]) / (times[last + 1] - times[last] || 1);
  return [x[last] + share * (x[last + 1] - x[last]), y[last] + share * (y[last + 1] - y[last])];
}

/** The way of an agent between two times. */
function wayBetween(agent, start, end) {
  const { times_s: times, x_m: x, y_m: y } = agent.path;
  const way = [placeAt(agent, start)];
  for (let k = lastUpTo(times, start) + 1; k < times.length && times[k] < end; k++) {
    way.push([x[k], y[k]]);
  }
  way.push(placeAt(agent, end));
  return way.filter(Boolean);
}

// Nearer than that, a corner has been passed.
const AT_CORNER_M = 0.05;

/** The corners that an agent had before it, as it had agreed. */
function wayAhead(agent, time) {
  const { times_s: times, way, first } = agent.ahead;
  const row = lastUpTo(times, time);
  if (row < 0) return [];
  const corners = agent.ways[way[row]].slice(first[row]);
  // Rows come every two seconds; what was driven since is left out.
  let passed = 0;
  for (const [x, y] of wayBetween(agent, times[row], time)) {
    const next = corners[passed];
    if (next && Math.hypot(next[0] - x, next[1] - y) < AT_CORNER_M) passed += 1;
  }
  return corners.slice(passed);
}

const spanAt = (agent, time) =>
  agent.spans.find((span) => span.start_s <= time && time < span.end_s);

/** Where an agent is under way to, in words: to what it did next. */
function wayAt(agent, time) {
  const step = agent.steps.find(([done]) => done > time);
  const arrivals = ROUNDS.flatMap((round) => round.members)
    .filter((member) => member.agent === agent.name && member.arrival_s > time)
    .map((member) => member.arrival_s);
  const arrival = Math.min(...arrivals);
  if (!step && arrival === Infinity) return "under way";
  return step && step[0] <= arrival ? `to ${step[2] || "its next step"}` : "to the meeting";
}

/** What an agent is doing, in words. */
function activityAt(agent, time) {
  const span = spanAt(agent, time);
  if (!span) return wayAt(agent, time);
  if (span.activity === "action") return span.action;
  return span.activity === "wait" ? "waiting" : "meeting";
}

const linksAt = (time) => DATA.links.filter((link) => link[2] <= time && time < link[3]);

const startOf = (round) => round.started_s ?? round.planned_s;
const endOf = (round) => startOf(round) + (RUN.has_meetings ? RUN.duration_s : 0);
const hasMember = (round, name) => round.members.some((member) => member.agent === name);
let BY_START = [];
function sortRounds() {
  BY_START = [...ROUNDS].sort((one, other) => startOf(one) - startOf(other));
}
sortRounds();

/** The meetings that come next: at one time there are several, of pairs. */
function nextMeetings(time) {
  const busy = new Set();
  return BY_START.filter((round) => {
    const isNext = endOf(round) >= time && round.agreed_s <= time
      && !round.members.some((member) => busy.has(member.agent));
    if (isNext) round.members.forEach((member) => busy.add(member.agent));
    return isNext;
  });
}

const nextMeetingOf = (agent, time) =>
  BY_START.find((round) => hasMember(round, agent.name) && endOf(round) >= time);

const obstaclesAt = (time) => {
  const later = DATA.ground.changes.filter((change) => change.at_s <= time);
  return later.length ? later[later.length - 1].obstacles_m : DATA.ground.obstacles_m;
};

const windowAt = (time) => Math.floor(time / RUN.period_s + 1e-9);
const isMissed = (number) =>
  RUN.keeps_windows && DATA.windows.some((own) => own.round === number && !own.satisfied);

/** What a round is called: by its number, and by who meets unless all do. */
function roundName(round) {
  if (round.members.length === AGENTS.length) return String(round.round);
  const members = round.members.map((member) => SHORT[NUMBER_OF.get(member.agent)] ?? member.agent);
  return `${round.round}: ${members.join(" · ")}`;
}
