// The feed of a run that goes on: the document grows, and what is shown with it.

const LOST = "connection lost";
// "": no feed, or the run is over; else what people read.
let state = DATA.feed ? "waiting for the run" : "";
let growths = 0;
const growing = [];

/** Has something done whenever the document has grown. */
const onGrowth = (act) => growing.push(act);

const isLive = () => state !== "" && state !== LOST;

/** Changes one part of the document: a value, or what a list has from an index on. */
function applyEdit({ path, from, items, value }) {
  const owner = path.slice(0, -1).reduce((part, key) => part[key], DATA);
  const key = path.at(-1);
  if (items === undefined) {
    owner[key] = value;
    return;
  }
  owner[key].length = from;
  for (const item of items) owner[key].push(item);
}

function grow(edits) {
  edits.forEach(applyEdit);
  if (RUN.verdict !== null) state = "";
  else if (RUN.end_s > 0) state = "running";
  growths += 1;
  sortRounds();
  growing.forEach((act) => act());
  show(view.isFollowing ? { time: RUN.end_s, isFollowing: isLive() } : {});
}

/** Listens; `begin` is called when the document is up to date for the first time. */
function listen(begin) {
  const feed = new WebSocket(DATA.feed);
  feed.addEventListener("message", (event) => {
    grow(JSON.parse(event.data));
    if (growths === 1) begin();
  });
  feed.addEventListener("close", () => {
    if (!isLive()) return;
    state = LOST;
    growing.forEach((act) => act());
    show({ isFollowing: false });
  });
}
