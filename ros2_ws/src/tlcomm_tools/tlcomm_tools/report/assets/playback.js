// Time, and what is chosen: everything that moves is drawn from `view`.

// Following: the time is the last that is known, while the run goes on.
const view = { time: 0, isPlaying: false, isFollowing: false, speed: 10, agent: null, round: null };
const SPEEDS = [1, 2, 5, 10, 20, 50, 100];
const SMALL_STEP_S = 1;
const LARGE_STEP_S = 10;
const drawn = [];

/** Has something drawn whenever the view changes; it is told what did. */
const onChange = (draw) => drawn.push(draw);

/** Changes the view, and draws what depends on it. */
function show(changes) {
  if ("time" in changes) {
    changes.time = Math.min(Math.max(changes.time, 0), RUN.end_s);
    view.isFollowing = isLive() && changes.time >= RUN.end_s;
  }
  Object.assign(view, changes);
  drawn.forEach((draw) => draw(changes));
}

/** Shows a round and, unless it is to stay, the time of its meeting. */
function showRound(index) {
  show({ round: index, time: startOf(ROUNDS[index]) });
}

function play() {
  if (view.time >= RUN.end_s) {
    show({ time: isLive() ? RUN.end_s : 0 });
    if (view.isFollowing) return;
  }
  show({ isPlaying: true });
  let before = performance.now();
  const advance = (now) => {
    if (!view.isPlaying) return;
    const time = view.time + (now - before) / 1000 * view.speed;
    before = now;
    show(time < RUN.end_s ? { time } : { time, isPlaying: false });
    requestAnimationFrame(advance);
  };
  requestAnimationFrame(advance);
}

const isMoving = () => view.isPlaying || view.isFollowing;
const toggle = () => (isMoving() ? show({ isPlaying: false, isFollowing: false }) : play());

/** Goes to the meeting before or after the present time. */
function skip(direction) {
  const starts = BY_START.filter((round) => round.started_s !== null);
  const ahead = direction > 0
    ? starts.find((round) => startOf(round) > view.time + 1e-6)
    : starts.findLast((round) => startOf(round) < view.time - 1e-6);
  if (ahead) showRound(ROUNDS.indexOf(ahead));
}

function onKey(event) {
  const isTaken = event.target.closest("input, select, textarea");
  if (event.ctrlKey || event.altKey || event.metaKey || isTaken) return;
  const step = event.shiftKey ? LARGE_STEP_S : SMALL_STEP_S;
  if (event.key === "ArrowRight") show({ time: view.time + step });
  else if (event.key === "ArrowLeft") show({ time: view.time - step });
  // A button in focus is pressed by space.
  else if (event.key === " " && !event.target.closest("button")) toggle();
  else return;
  event.preventDefault();
}

function setUpPlayback() {
  const slider = byId("slider");
  // The slider's steps don't end where the run does.
  const isAtEnd = () => Number(slider.value) > RUN.end_s - Number(slider.step);
  slider.addEventListener("input", () => {
    show({ time: isAtEnd() ? RUN.end_s : Number(slider.value) });
  });
  byId("live").addEventListener("click", () => show({ time: RUN.end_s, isPlaying: false }));
  byId("play").addEventListener("click", toggle);
  byId("earlier").addEventListener("click", () => skip(-1));
  byId("later").addEventListener("click", () => skip(1));
  const speed = byId("speed");
  speed.append(...SPEEDS.map((value) => element("option", { value }, `${value} ×`)));
  speed.value = view.speed;
  speed.addEventListener("change", () => show({ speed: Number(speed.value) }));
  document.addEventListener("keydown", onKey);
  onChange(() => {
    slider.max = RUN.end_s;
    slider.value = view.time;
    slider.setAttribute("aria-valuetext", `${told(view.time)} seconds`);
    byId("play").textContent = isMoving() ? "Pause" : "Play";
    byId("live").hidden = !isLive();
    byId("live").setAttribute("aria-pressed", view.isFollowing);
    byId("clock").textContent = `${told(view.time)} s of ${told(RUN.end_s)} s`;
  });
}
