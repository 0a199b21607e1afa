// The page: what is shown, and who is told when that changes.

const record = readRecord();
const view = { frame: 0, node: null, kept: false, field: 0, ofFrame: false, logTime: false };
const find = (id) => document.getElementById(id);
let waiting = false;

/** Draws everything once before the next picture of the screen. */
function redraw() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    for (const panel of [curve, history, ...traces]) panel.draw(view);
    showTip();
    values.forEach((cell, k) => { cell.textContent = written(record.history[k].values[view.frame], 8); });
  });
}

function change(changes) {
  Object.assign(view, changes);
  redraw();
}

/** Shows the values of the node in the corner that is farthest from it, so that it is never covered. */
function showTip() {
  const tip = find("tip");
  tip.hidden = view.node === null;
  if (tip.hidden) return;
  tip.replaceChildren(tableOf(nodeRows(record, view.frame, view.node)).table);
  const [x, y] = curve.pixels(view.frame)(view.node);
  const { left, top, right, bottom } = curve.panel.frame;
  const far = (at, size, from, to) => `${at > (from + to) / 2 ? from + 6 : Math.max(0, to - size - 6)}px`;
  tip.style.left = far(x, tip.offsetWidth, left, right);
  tip.style.top = far(y, tip.offsetHeight, top, bottom);
}

/** Lets a pointer choose a node: pointing shows it, a click keeps it, a click elsewhere lets it go. */
function pointAt(panel) {
  const { canvas } = panel.panel;
  canvas.addEventListener("pointermove", (event) => {
    if (!view.kept) change({ node: panel.nodeAt(event, view) });
  });
  canvas.addEventListener("pointerdown", (event) => {
    const node = panel.nodeAt(event, view);
    change({ node, kept: node !== null });
  });
  canvas.addEventListener("pointerleave", () => {
    if (!view.kept) change({ node: null });
  });
}

/** A figure with a legend for one trace. */
function addTrace(density) {
  const [figure, caption, canvas] = ["figure", "figcaption", "canvas"].map((name) => document.createElement(name));
  const trace = new TracePanel(record, density, canvas, redraw);
  const keys = [["", "frame shown"], ["first", "first"], ...trace.lines.map(({ name }, k) => [`line-${k}`, name])];
  for (const [style, name] of keys) {
    const key = document.createElement("span");
    key.append(element("i", "", `key ${style}`), name);
    caption.append(key);
  }
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", `curvature over ${trace.name}`);
  figure.append(caption, canvas);
  find("traces").append(figure);
  pointAt(trace);
  return trace;
}

const values = addTable("Frame shown", record.history.map(({ name }) => [name, ""]));
writeTexts(record);
const curve = new CurvePanel(record, find("curve"), redraw);
const history = new HistoryPanel(record, find("history"), redraw);
const traces = (record.densities.length ? record.densities.map((_, k) => k) : [null]).map(addTrace);
const player = new Player(record, (frame) => change({ frame }));

record.fields.forEach(({ name }, k) => find("field").append(new Option(name, k)));
find("field").addEventListener("change", (event) => change({ field: Number(event.target.value) }));
find("ranges").addEventListener("change", (event) => change({ ofFrame: event.target.value === "frame" }));
find("energy-name").textContent = history.name;
find("log-time").disabled = !history.canBeLogarithmic;
find("log-time").checked = view.logTime = history.startsLogarithmic;
find("log-time").addEventListener("change", (event) => change({ logTime: event.target.checked }));
pointAt(curve);
find("history").addEventListener("pointerdown", (event) => {
  event.target.setPointerCapture(event.pointerId);
  player.go(history.frameAt(event));
});
find("history").addEventListener("pointermove", (event) => {
  if (event.buttons & 1) player.go(history.frameAt(event));
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
player.set(0);
