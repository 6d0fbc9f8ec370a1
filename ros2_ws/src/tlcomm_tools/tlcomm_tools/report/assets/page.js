// Puts the page together; a link may name a moment: #time=S&round=N&agent=NAME.

function readLink() {
  const asked = new URLSearchParams(location.hash.slice(1));
  const changes = {};
  const round = ROUNDS.findIndex((own) => String(own.round) === asked.get("round"));
  if (round >= 0) Object.assign(changes, { round, time: startOf(ROUNDS[round]) });
  const time = Number.parseFloat(asked.get("time"));
  if (Number.isFinite(time)) changes.time = time;
  if (NUMBER_OF.has(asked.get("agent"))) changes.agent = NUMBER_OF.get(asked.get("agent"));
  return changes;
}

setUpFindings();
setUpPlayback();
setUpMap();
setUpAgents();
setUpRounds();
const begin = () => show({
  time: isLive() ? RUN.end_s : 0, round: isLive() || !ROUNDS.length ? view.round : 0,
  ...readLink(),
});
if (DATA.feed) listen(begin);
else begin();
addEventListener("hashchange", () => show(readLink()));
