// The map at the time of the view.

const TRAIL_S = 30;
const MARGIN_PX = 10;
const MOST_HEIGHT_PX = 520;
const NEAR_PX = 24;
const canvas = byId("map");
const pen = canvas.getContext("2d");
let scale = 1;

const { origin_m: ORIGIN, size_m: SIZE } = DATA.ground;
const toX = (x) => MARGIN_PX + (x - ORIGIN[0]) * scale;
const toY = (y) => MARGIN_PX + (ORIGIN[1] + SIZE[1] - y) * scale;

function fitMap() {
  const wide = canvas.parentElement.clientWidth - 24;
  scale = Math.min((wide - 2 * MARGIN_PX) / SIZE[0], (MOST_HEIGHT_PX - 2 * MARGIN_PX) / SIZE[1]);
  const high = SIZE[1] * scale + 2 * MARGIN_PX;
  const width = SIZE[0] * scale + 2 * MARGIN_PX;
  const density = window.devicePixelRatio || 1;
  canvas.style.width = `${width}px`;
  canvas.style.height = `${high}px`;
  canvas.width = Math.round(width * density);
  canvas.height = Math.round(high * density);
  pen.setTransform(density, 0, 0, density, 0, 0);
  drawMap();
}

function drawMap() {
  pen.clearRect(0, 0, canvas.width, canvas.height);
  drawGround();
  AGENTS.forEach(drawTrail);
  drawAhead();
  drawPlaces();
  drawLinks();
  drawReach();
  AGENTS.forEach(drawAgent);
}

function drawGround() {
  pen.lineWidth = 1;
  pen.fillStyle = styled("--obstacle");
  for (const [left, low, right, high] of obstaclesAt(view.time)) {
    pen.fillRect(toX(left), toY(high), (right - left) * scale, (high - low) * scale);
  }
  pen.strokeStyle = styled("--region");
  pen.strokeRect(toX(ORIGIN[0]), toY(ORIGIN[1] + SIZE[1]), SIZE[0] * scale, SIZE[1] * scale);
  for (const [name, [x, y, radius]] of Object.entries(DATA.ground.regions_m)) {
    pen.beginPath();
    pen.arc(toX(x), toY(y), radius * scale, 0, 2 * Math.PI);
    pen.stroke();
    write(name, toX(x), toY(y), styled("--quiet"), "center");
  }
}

/** Writes a text that is read on any ground. */
function write(text, x, y, colour, align) {
  pen.font = "12px system-ui, sans-serif";
  pen.textAlign = align;
  pen.textBaseline = "middle";
  pen.lineWidth = 3;
  pen.strokeStyle = styled("--card");
  pen.strokeText(text, x, y);
  pen.fillStyle = colour;
  pen.fillText(text, x, y);
  pen.lineWidth = 1;
  pen.strokeStyle = styled("--region");
}

function drawTrail(agent, index) {
  const way = wayBetween(agent, Math.max(view.time - TRAIL_S, 0), view.time);
  pen.beginPath();
  way.forEach(([x, y]) => pen.lineTo(toX(x), toY(y)));
  pen.strokeStyle = agentColour(index);
  pen.globalAlpha = view.agent === null || view.agent === index ? 0.55 : 0.2;
  pen.lineWidth = view.agent === index ? 3 : 2;
  pen.stroke();
  pen.globalAlpha = 1;
}

/** The way that the chosen agent has before it, to its next meeting. */
function drawAhead() {
  if (view.agent === null) return;
  const agent = AGENTS[view.agent];
  const place = placeAt(agent, view.time);
  const corners = place ? wayAhead(agent, view.time) : [];
  if (!corners.length) return;
  pen.setLineDash([1, 5]);
  pen.lineCap = "round";
  pen.strokeStyle = agentColour(view.agent);
  pen.lineWidth = 3;
  pen.beginPath();
  [place, ...corners].forEach(([x, y]) => pen.lineTo(toX(x), toY(y)));
  pen.stroke();
  pen.setLineDash([]);
  pen.lineCap = "butt";
}

function drawPlaces() {
  for (const round of nextMeetings(view.time)) {
    for (const member of round.members) {
      const [x, y] = member.place_m;
      pen.strokeStyle = agentColour(NUMBER_OF.get(member.agent) ?? 0);
      pen.lineWidth = 2;
      pen.strokeRect(toX(x) - 6, toY(y) - 6, 12, 12);
    }
  }
}

function drawLinks() {
  pen.strokeStyle = styled("--link");
  pen.lineWidth = 1.5;
  pen.beginPath();
  for (const [one, other] of linksAt(view.time)) {
    const ends = [placeAt(AGENTS[one], view.time), placeAt(AGENTS[other], view.time)];
    if (!ends[0] || !ends[1]) continue;
    pen.moveTo(toX(ends[0][0]), toY(ends[0][1]));
    pen.lineTo(toX(ends[1][0]), toY(ends[1][1]));
  }
  pen.stroke();
}

/** How far the radio of the chosen agent reaches. */
function drawReach() {
  const place = view.agent === null ? null : placeAt(AGENTS[view.agent], view.time);
  if (!place) return;
  pen.setLineDash([4, 4]);
  pen.strokeStyle = agentColour(view.agent);
  pen.beginPath();
  pen.arc(toX(place[0]), toY(place[1]), RUN.range_m * scale, 0, 2 * Math.PI);
  pen.stroke();
  pen.setLineDash([]);
}

function drawAgent(agent, index) {
  const place = placeAt(agent, view.time);
  if (!place) return;
  pen.beginPath();
  pen.arc(toX(place[0]), toY(place[1]), view.agent === index ? 8 : 6, 0, 2 * Math.PI);
  pen.fillStyle = agentColour(index);
  pen.fill();
  pen.strokeStyle = styled("--card");
  pen.lineWidth = 1.5;
  pen.stroke();
  write(SHORT[index], toX(place[0]) + 10, toY(place[1]) - 8, styled("--text"), "left");
}

function chooseOnMap(event) {
  const distances = AGENTS.map((agent) => {
    const place = placeAt(agent, view.time);
    return place
      ? Math.hypot(toX(place[0]) - event.offsetX, toY(place[1]) - event.offsetY) : Infinity;
  });
  const nearest = distances.indexOf(Math.min(...distances));
  show({ agent: distances[nearest] <= NEAR_PX ? nearest : null });
}

function setUpMap() {
  canvas.addEventListener("click", chooseOnMap);
  new ResizeObserver(fitMap).observe(canvas.parentElement);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawMap);
  onChange(drawMap);
}
