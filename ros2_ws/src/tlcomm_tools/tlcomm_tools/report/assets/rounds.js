// The rounds: what was agreed on, why, and what it cost.

const buttons = [];
let shownRound = null;
// What numbers in the page are rounded to.
const ROUNDING_S = 0.001;

function setUpRounds() {
  drawButtons();
  onGrowth(() => {
    const isNewest = view.round === null || view.round === buttons.length - 1;
    drawButtons();
    if (view.isFollowing && isNewest && ROUNDS.length) show({ round: ROUNDS.length - 1 });
  });
  onChange(drawRound);
}

function drawButtons() {
  byId("rounds-section").hidden = ROUNDS.length === 0;
  ROUNDS.forEach((round, index) => {
    if (index === buttons.length) addButton(roundName(round), index);
    const missed = isMissed(round.round);
    buttons[index].className = missed ? "missed" : "";
    buttons[index].title = missed ? "window missed" : "";
  });
}

function addButton(name, index) {
  const button = element("button", { type: "button" }, name);
  button.addEventListener("click", () => showRound(index));
  byId("rounds").append(button);
  buttons.push(button);
}

function pressButton() {
  const button = buttons[view.round];
  buttons.forEach((own) => own.setAttribute("aria-pressed", own === button));
  const list = byId("rounds");
  list.scrollTop = button.offsetTop - list.offsetTop - list.clientHeight / 2;
}

function drawRound() {
  if (view.round === null || ROUNDS[view.round] === shownRound) return;
  pressButton();
  const round = ROUNDS[view.round];
  shownRound = round;
  const what = RUN.has_meetings ? "Meeting" : "Turn";
  byId("round").replaceChildren(
    element("h3", {}, `${what} ${roundName(round)}`),
    element("p", {}, describeWhen(round)),
    element("p", {}, describeWhy(round)),
    memberTable(round),
    ...(round.moves?.length ? [moveTable(round)] : []),
  );
}

function describeWhen(round) {
  const holders = round.held_by.length === round.members.length ? "all" : round.held_by.join(", ");
  const agreed = `Agreed by ${told(round.agreed_s, 3)} s, held by ${holders}; planned for `
    + `${told(round.planned_s, 3)} s`;
  if (!RUN.has_meetings) return `${agreed}.`;
  const [opens, closes] = round.window_s;
  const absent = isLive() ? "it hasn't begun yet" : "it didn't take place before the end";
  const begun = round.started_s === null ? absent : `it began at ${told(round.started_s, 3)} s`;
  const missed = isMissed(round.round) ? " The window was missed." : "";
  return `Window from ${told(opens)} s to ${told(closes)} s. ${agreed}, ${begun}.${missed}`;
}

function describeWhy(round) {
  const bound = round.bound_s === null ? "" : ` No strategy costs less than ${told(round.bound_s, 2)} s.`;
  const members = round.members;
  const detour = members.reduce((sum, own) => sum + own.detour_s, 0);
  const last = members.reduce((one, own) => (own.planned_arrival_s > one.planned_arrival_s ? own : one));
  const opens = RUN.has_meetings ? round.window_s[0] : 0;
  const waits = last.planned_arrival_s > opens
    ? `${last.agent} comes last, and the others wait for it.`
    : "All are there before the window opens, and wait for that.";
  return `Coordination began with a cost of Φ(S⁰) = ${told(round.initial_potential_s, 2)} s and came, `
    + `${describeHow(round)}, to Φ = ${told(round.potential_s, 2)} s: ${told(detour, 2)} s of detours `
    + `and ${told(round.potential_s - detour, 2)} s of waiting. ${waits}${bound}`;
}

/** By what the cost came down: the best proposal, then moves of single agents. */
function describeHow(round) {
  const changes = (round.moves ?? []).map((own) => own.change_s);
  const before = round.potential_s - changes.reduce((sum, own) => sum + own, 0);
  const count = round.move_count;
  const moves = `${count} ${count === 1 ? "move" : "moves"} of single agents`;
  const byProposal = round.initial_potential_s - before > ROUNDING_S * (count + 1);
  if (byProposal && round.moves !== null) {
    return count ? `by the best proposal and ${moves}` : "by the best proposal";
  }
  return count ? `by ${moves}` : "without a move that betters it";
}

function memberTable(round) {
  const columns = [
    ["agent", false], ["place/m", false], ["after step", true], ["planned arrival/s", true],
    ["detour/s", true], ["planned wait/s", true], ["arrival/s", true], ["wait/s", true],
    ["additional/s", true],
  ];
  const rows = round.members.map((own) => [
    own.agent, toldPlace(own.place_m), String(own.after_step), told(own.planned_arrival_s, 2),
    told(own.detour_s, 2), told(own.planned_wait_s, 2), told(own.arrival_s, 2), told(own.wait_s, 2),
    told(own.additional_s, 2),
  ]);
  return tableOf("As planned, and as it came", columns, rows);
}

/** How the potential came down, move by move. */
function moveTable(round) {
  const columns = [["move", true], ["agent", false], ["to/m", false], ["change/s", true], ["Φ/s", true]];
  const rows = round.moves.map((own, index) => [
    String(index + 1), own.agent, toldPlace(own.place_m), told(own.change_s, 3),
    told(own.potential_s, 3),
  ]);
  return tableOf("The potential's course, by the moves of single agents", columns, rows);
}
