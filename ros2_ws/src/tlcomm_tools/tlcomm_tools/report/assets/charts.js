// The charts, by Plotly.

const REDRAW_MS = 150;
// While the run goes on, charts are drawn anew no sooner than so; in a hidden page not at all.
const FOLLOW_MS = 1000;
const GROW_MS = 4000;
// Axes and colours beside a map in a chart, its axis and margin below.
const BESIDE_MAP_PX = 140;
const BELOW_MAP_PX = 70;
const MOST_MAP_PX = 480;
// With no more counts than that, each has its tick.
const FEW_COUNTS = 6;
const CONFIG = { responsive: true, displayModeBar: false };
// Where a finger scrolls the page, it can't also zoom.
const DRAG = matchMedia("(pointer: coarse)").matches ? false : "zoom";
// Plotly reads a few tags in texts: none of them is meant.
const plain = (text) => String(text).replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");

function axis(title, more) {
  return {
    title: { text: title, standoff: 8 }, gridcolor: styled("--line"), zerolinecolor: styled("--line"),
    linecolor: styled("--line"), automargin: true, ...more,
  };
}

function layoutOf(x, y, more) {
  return {
    paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)",
    font: { color: styled("--text"), size: 12, family: "system-ui, sans-serif" },
    margin: { l: 50, r: 10, t: 10, b: 40 }, height: 300, xaxis: x, yaxis: y,
    dragmode: DRAG, uirevision: "kept",
    legend: { orientation: "h", y: 1.02, yanchor: "bottom", x: 0, traceorder: "normal" },
    hoverlabel: { bgcolor: styled("--card"), font: { color: styled("--text") } }, ...more,
  };
}

const lineAt = (x, colour, dash = "solid") => ({
  type: "line", xref: "x", yref: "paper", x0: x, x1: x, y0: 0, y1: 1,
  line: { color: colour, width: 1.5, dash },
});

function drawPotentials() {
  const chart = byId("potentials");
  const x = ROUNDS.map((round) => startOf(round));
  const trace = (name, key, look) => ({
    name, x, y: ROUNDS.map((round) => round[key]), text: ROUNDS.map((round) => plain(roundName(round))),
    hovertemplate: `round %{text}<br>${name} %{y:.2f} s<extra></extra>`, ...look,
  });
  const traces = [
    trace("Φ(S⁰)", "initial_potential_s", { mode: "markers", marker: { symbol: "circle-open", color: styled("--quiet") } }),
    trace("Φ", "potential_s", { mode: "lines+markers", marker: { color: styled("--accent") }, line: { width: 1 } }),
  ];
  if (ROUNDS.some((round) => round.bound_s !== null)) {
    traces.push(trace("none is below", "bound_s", { mode: "lines", line: { color: styled("--quiet"), dash: "dot" } }));
  }
  const chosen = view.round === null ? [] : [lineAt(startOf(ROUNDS[view.round]), styled("--accent"), "dash")];
  const layout = layoutOf(axis("time of the meeting (s)"), axis("cost (s)", { rangemode: "tozero" }), { shapes: chosen });
  const isFirst = !chart.data;
  Plotly.react(chart, traces, layout, CONFIG);
  if (isFirst) chart.on("plotly_click", (event) => showRound(event.points[0].pointNumber));
}

function drawCosts() {
  if (view.round === null) return;
  const { members } = ROUNDS[view.round];
  const y = members.map((own) => plain(own.agent));
  const bars = (name, key, colour) => ({
    type: "bar", orientation: "h", name, y, x: members.map((own) => own[key]),
    marker: { color: styled(colour) }, hovertemplate: `%{y}: ${name} %{x:.2f} s<extra></extra>`,
  });
  const traces = [bars("detour", "detour_s", "--agent-1"), bars("planned wait", "planned_wait_s", "--agent-0")];
  const layout = layoutOf(axis("additional time (s)"), axis("", { autorange: "reversed", type: "category" }), {
    barmode: "stack", height: 110 + 24 * members.length,
  });
  Plotly.react(byId("costs"), traces, layout, CONFIG);
}

/** From when to when the schedule is drawn: the window of the view, and those beside it. */
function scheduleRange() {
  const first = Math.max(windowAt(view.time) - 0.25, 0) * RUN.period_s;
  return [first, Math.max(Math.min(first + 2.5 * RUN.period_s, RUN.end_s), first + 1)];
}

function drawSchedule() {
  const [first, last] = scheduleRange();
  const kinds = new Map();
  AGENTS.forEach((agent) => agent.spans.forEach((span) => {
    const name = span.activity === "action" ? span.action : span.activity;
    if (!kinds.has(name)) kinds.set(name, { span, x: [], base: [], y: [] });
    if (span.end_s <= first || span.start_s >= last) return;
    const kind = kinds.get(name);
    kind.x.push(span.end_s - span.start_s);
    kind.base.push(span.start_s);
    kind.y.push(plain(agent.name));
  }));
  const rank = [...kinds.keys()].filter((name) => kinds.get(name).span.activity === "action");
  const colourOf = (name, { span }) => {
    if (span.activity === "meeting") return styled("--text");
    return span.activity === "wait" ? styled("--line") : agentColour(rank.indexOf(name));
  };
  const traces = [...kinds].map(([name, kind]) => ({
    type: "bar", orientation: "h", name: plain(name), x: kind.x, base: kind.base, y: kind.y,
    marker: { color: colourOf(name, kind) },
    hovertemplate: `%{y}: ${plain(name)} from %{base:.2f} s, %{x:.2f} s<extra></extra>`,
  }));
  traces.push(satisfactions(first, last));
  const names = AGENTS.map((agent) => plain(agent.name));
  const layout = layoutOf(
    axis("time (s)", { range: [first, last] }),
    axis("", { type: "category", categoryarray: names, range: [names.length - 0.4, -1.4] }),
    { barmode: "overlay", height: 150 + 26 * names.length, shapes: scheduleShapes(first, last), uirevision: first, ...lineNames(first, last) },
  );
  Plotly.react(byId("schedule"), traces, layout, CONFIG);
}

function satisfactions(first, last) {
  const x = [];
  const y = [];
  AGENTS.forEach((agent) => agent.satisfied_s.forEach((time) => {
    if (time >= first && time <= last) {
      x.push(time);
      y.push(plain(agent.name));
    }
  }));
  return {
    type: "scatter", mode: "markers", name: "task satisfied", x, y,
    marker: { symbol: "star", size: 11, color: styled("--text"), line: { color: styled("--card"), width: 1 } },
    hovertemplate: "%{y}: task satisfied at %{x:.3f} s<extra></extra>",
  };
}

function windowsBetween(first, last) {
  const numbers = [];
  for (let r = Math.ceil(first / RUN.period_s - 1e-9); r * RUN.period_s < last; r++) numbers.push(r);
  return numbers;
}

function scheduleShapes(first, last) {
  const opens = windowsBetween(first, last).map((r) => lineAt(r * RUN.period_s, styled("--quiet"), "dash"));
  const changes = mapChanges(first, last).map((own) => lineAt(own.at_s, styled("--bad"), "dot"));
  return [...opens, ...changes, lineAt(view.time, styled("--accent"))];
}

const mapChanges = (first, last) =>
  DATA.ground.changes.filter((own) => own.at_s >= first && own.at_s <= last);

const nameAt = (x, text, yanchor) => ({
  x, xref: "x", y: 1, yref: "paper", yanchor, xanchor: "left", showarrow: false, text,
  font: { size: 11, color: styled("--quiet") },
});

/** What the lines of the schedule are. */
function lineNames(first, last) {
  const windows = windowsBetween(first, last).map((r) =>
    nameAt(r * RUN.period_s, `window ${r}${isMissed(r) ? " missed" : ""}`, "top"));
  const changes = mapChanges(first, last).map((own) => nameAt(own.at_s, "the map changes", "bottom"));
  return { annotations: [...windows, ...changes] };
}

// What the counts of places are drawn on.
let shownObstacles = null;

/** How high a map is drawn that is as wide as its chart. */
function mapHeight(chart, wide, high) {
  const width = Math.max(chart.clientWidth - BESIDE_MAP_PX, 100);
  return Math.min(BELOW_MAP_PX + width * (high / wide), MOST_MAP_PX);
}

function drawPlaceCounts() {
  shownObstacles = obstaclesAt(view.time);
  const met = RUN.has_meetings ? ROUNDS.filter((round) => round.started_s !== null) : [];
  byId("places-section").hidden = met.length === 0;
  if (met.length === 0) return;
  const { cell_m: cell, origin_m: [left, low], size_m: [wide, high] } = DATA.ground;
  const columns = Math.ceil(wide / cell - 1e-9);
  const rows = Math.ceil(high / cell - 1e-9);
  const counts = Array.from({ length: rows }, () => Array(columns).fill(null));
  met.forEach((round) => round.members.forEach(({ place_m: [x, y] }) => {
    const row = counts[Math.floor((y - low) / cell)];
    const column = Math.floor((x - left) / cell);
    if (row && column >= 0 && column < columns) row[column] = (row[column] ?? 0) + 1;
  }));
  const middle = (from, count) => Array.from({ length: count }, (_, k) => from + (k + 0.5) * cell);
  const most = Math.max(...counts.flat());
  const heat = {
    type: "heatmap", x: middle(left, columns), y: middle(low, rows), z: counts, zmin: 0, zmax: most,
    colorscale: "Viridis", reversescale: !matchMedia("(prefers-color-scheme: dark)").matches,
    colorbar: {
      title: { text: "times", side: "top" }, thickness: 12, outlinewidth: 0,
      ...(most <= FEW_COUNTS && { dtick: 1 }),
    },
    hovertemplate: "(%{x:.2f}, %{y:.2f}): %{z} times<extra></extra>", hoverongaps: false,
  };
  const layout = layoutOf(
    axis("x (m)", { range: [left, left + wide], constrain: "domain", showgrid: false, zeroline: false }),
    axis("y (m)", { range: [low, low + high], scaleanchor: "x", constrain: "domain", showgrid: false, zeroline: false }),
    { height: mapHeight(byId("places"), wide, high), ...groundShapes() },
  );
  Plotly.react(byId("places"), [heat], layout, CONFIG);
}

function groundShapes() {
  const outline = { color: styled("--region"), width: 1 };
  const boxes = shownObstacles.map(([x0, y0, x1, y1]) => ({
    type: "rect", x0, y0, x1, y1, fillcolor: styled("--obstacle"), line: { width: 0 },
  }));
  const regions = Object.entries(DATA.ground.regions_m);
  const discs = regions.map(([, [x, y, radius]]) => ({
    type: "circle", x0: x - radius, x1: x + radius, y0: y - radius, y1: y + radius, line: outline,
  }));
  const annotations = regions.map(([name, [x, y]]) => ({
    x, y, text: plain(name), showarrow: false, font: { size: 11, color: styled("--quiet") },
  }));
  return { shapes: [...boxes, ...discs], annotations };
}

/** The field at a time. */
function fieldAt({ times_s: times, values }, time) {
  const last = lastUpTo(times, time);
  if (last < 0) return values[0];
  if (last === times.length - 1) return values[last];
  const share = (time - times[last]) / (times[last + 1] - times[last]);
  return values[last] + share * (values[last + 1] - values[last]);
}

/** How far an estimate is off while it holds; what it is off by changes with the field. */
function deviationOf({ times_s: times, values }, field) {
  const x = [];
  const y = [];
  times.forEach((start, k) => {
    const end = times[k + 1] ?? RUN.end_s;
    const bends = field.times_s.filter((time) => time > start && time < end);
    for (const time of [start, ...bends, end]) {
      x.push(time);
      y.push(values[k] - fieldAt(field, time));
    }
  });
  return { x, y };
}

function drawField() {
  const { field } = DATA;
  const measuring = AGENTS.map((agent, index) => ({ agent, index })).filter(({ agent }) => agent.estimates.times_s.length);
  byId("field-section").hidden = field === null || measuring.length === 0;
  if (byId("field-section").hidden) return;
  const look = ({ agent, index }) => ({ name: plain(agent.name), mode: "lines", line: { color: agentColour(index), width: 1.3 } });
  const estimates = measuring.map((own) => ({
    ...look(own), x: [...own.agent.estimates.times_s, RUN.end_s],
    y: [...own.agent.estimates.values, own.agent.estimates.values.at(-1)],
    line: { ...look(own).line, shape: "hv" },
  }));
  estimates.push({ name: "true ν(t)", mode: "lines", x: field.times_s, y: field.values, line: { color: styled("--text"), dash: "dot" } });
  Plotly.react(byId("estimates"), estimates, layoutOf(axis("time (s)"), axis("estimate of ν")), CONFIG);
  const deviations = measuring.map((own) => ({ ...look(own), ...deviationOf(own.agent.estimates, field) }));
  const layout = layoutOf(axis("time (s)"), axis("deviation from ν"), { showlegend: false });
  Plotly.react(byId("deviations"), deviations, layout, CONFIG);
}

function drawAll() {
  const draws = [drawSchedule, ...(ROUNDS.length ? [drawPotentials, drawCosts] : []), drawPlaceCounts, drawField];
  draws.forEach((draw, rank) => setTimeout(draw, rank));
  setTimeout(() => { document.body.dataset.charts = "drawn"; }, draws.length);
}

let isDue = false;
onChange((changes) => {
  if ("round" in changes && ROUNDS.length) {
    drawPotentials();
    drawCosts();
  }
  if (obstaclesAt(view.time) !== shownObstacles) drawPlaceCounts();
  if (isDue || !("time" in changes)) return;
  isDue = true;
  setTimeout(() => {
    isDue = false;
    if (!document.hidden) drawSchedule();
  }, view.isFollowing ? FOLLOW_MS : REDRAW_MS);
});
let isGrown = false;
function drawGrown() {
  if (isGrown || document.hidden) return;
  isGrown = true;
  setTimeout(() => {
    isGrown = false;
    drawAll();
  }, growths > 1 ? GROW_MS : 0);
}
onGrowth(drawGrown);
document.addEventListener("visibilitychange", drawGrown);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawAll);
drawAll();
