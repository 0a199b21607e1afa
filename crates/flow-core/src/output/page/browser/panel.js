// A panel: a canvas with a frame, axes, and lines in the units of the axes.

const FONT = '12px system-ui, "DejaVu Sans", sans-serif';
const TICK = 5;
/** Room for the name of a vertical axis, and for a row of labels on one. */
const NAME = 22;
const ROW = 45;
/** Room for a label on a horizontal axis, and least distance to the next. */
const COLUMN = 75;
const APART = 8;

/** A colour of the style sheet, which knows light from dark. */
function ink(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

class Panel {
  /** `margins`: pixels left of, above, right of and below the frame at least. */
  constructor(canvas, margins, redraw) {
    Object.assign(this, { canvas, margins, pen: canvas.getContext("2d") });
    new ResizeObserver(redraw).observe(canvas);
  }

  /** Clears the canvas and fits the frame to its size. */
  clear() {
    const { canvas, pen, margins } = this;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    const ratio = window.devicePixelRatio || 1;
    const [columns, rows] = [width, height].map((length) => Math.max(1, Math.round(length * ratio)));
    if (canvas.width !== columns || canvas.height !== rows) Object.assign(canvas, { width: columns, height: rows });
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.font = FONT;
    const [left, top, right, bottom] = margins;
    this.frame = { left, top, right: Math.max(left + 1, width - right), bottom: Math.max(top + 1, height - bottom) };
  }

  get width() {
    return this.frame.right - this.frame.left;
  }

  get height() {
    return this.frame.bottom - this.frame.top;
  }

  /** Widens the margins to what the labels of a vertical scale on the left need, and of one on the right, `off` the frame. */
  fit(left, right = null, off = 0) {
    const { canvas, frame, margins } = this;
    const room = (scale) => TICK + Math.max(0, ...this.rows(scale).ticks.map(({ text }) => this.textWidth(text))) + NAME;
    frame.left = Math.max(margins[0], room(left));
    const beside = right ? Math.max(margins[2], off + room(right)) : margins[2];
    frame.right = Math.max(frame.left + 1, canvas.clientWidth - beside);
  }

  textWidth(text) {
    return this.pen.measureText(text).width;
  }

  /** The labels of a vertical scale. */
  rows(scale) {
    return scale.labels(this.height / ROW);
  }

  /** The labels of the horizontal scale, as many as stand beside each other, with their places. */
  columns(scale) {
    for (let count = this.width / COLUMN; ; count--) {
      const { ticks, title } = scale.labels(count);
      const placed = ticks.map((tick) => ({ ...tick, at: this.across(tick.value), half: this.textWidth(tick.text) / 2 }));
      const clear = placed.every((tick, k) => !k || tick.at - tick.half >= placed[k - 1].at + placed[k - 1].half + APART);
      if (clear || count <= 1) return { ticks: clear ? placed : placed.slice(0, 1), title };
    }
  }

  /** Draws grid, frame and names of the axes. */
  axes(x, y, xName, yName) {
    Object.assign(this, { x, y });
    const { canvas, pen, frame } = this;
    const [columns, rows] = [this.columns(x), this.rows(y)];
    Object.assign(pen, { lineWidth: 1, strokeStyle: ink("grid"), fillStyle: ink("faint") });
    pen.setLineDash([]);
    pen.textAlign = "center";
    pen.textBaseline = "top";
    for (const { text, at, half } of columns.ticks) {
      this.stroke([[at, frame.top], [at, frame.bottom]]);
      // The last label may be wider than the margin.
      pen.fillText(text, Math.min(at, canvas.clientWidth - half), frame.bottom + TICK);
    }
    pen.fillText(columns.title(xName), (frame.left + frame.right) / 2, frame.bottom + 22);
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    for (const { value, text } of rows.ticks) {
      const at = this.up(value);
      this.stroke([[frame.left, at], [frame.right, at]]);
      pen.fillText(text, frame.left - TICK, at);
    }
    this.sideways(rows.title(yName), 10);
    pen.strokeStyle = ink("edge");
    pen.strokeRect(frame.left, frame.top, this.width, this.height);
  }

  /** A second axis on the right, `off` the frame. */
  rightAxis(scale, name, colour, off = 0) {
    const { pen, frame, canvas } = this;
    const { ticks, title } = this.rows(scale);
    Object.assign(pen, { fillStyle: colour, textAlign: "left", textBaseline: "middle" });
    for (const { value, text } of ticks) pen.fillText(text, frame.right + off + TICK, this.up(value, scale));
    this.sideways(title(name), canvas.clientWidth - 8);
  }

  sideways(text, x) {
    const { pen, frame } = this;
    pen.save();
    pen.translate(x, (frame.top + frame.bottom) / 2);
    pen.rotate(-Math.PI / 2);
    Object.assign(pen, { textAlign: "center", textBaseline: "middle" });
    pen.fillText(text, 0, 0);
    pen.restore();
  }

  /** Pixel of a value on the horizontal axis. */
  across(value) {
    return this.frame.left + this.x.place(value) * this.width;
  }

  /** Pixel of a value on the vertical axis, or on another one. */
  up(value, scale = this.y) {
    return this.frame.bottom - scale.place(value) * this.height;
  }

  /** A line of `count` points in pixels inside the frame; it breaks where `point` is not finite. */
  line(count, point, { colour, width, dash = [] }) {
    const { pen, frame } = this;
    pen.save();
    pen.beginPath();
    pen.rect(frame.left, frame.top, this.width, this.height);
    pen.clip();
    pen.beginPath();
    let drawing = false;
    for (let k = 0; k < count; k++) {
      const [x, y] = point(k);
      const finite = Number.isFinite(x) && Number.isFinite(y);
      if (finite) drawing ? pen.lineTo(x, y) : pen.moveTo(x, y);
      drawing = finite;
    }
    Object.assign(pen, { strokeStyle: colour, lineWidth: width, lineJoin: "round", lineCap: "butt" });
    pen.setLineDash(dash);
    pen.stroke();
    pen.restore();
  }

  stroke([from, to]) {
    this.pen.beginPath();
    this.pen.moveTo(...from);
    this.pen.lineTo(...to);
    this.pen.stroke();
  }

  /** A dot at a point in pixels; hollow if it only stands for the point. */
  dot([x, y], colour, hollow = false) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) return;
    const { pen } = this;
    pen.setLineDash([]);
    pen.beginPath();
    pen.arc(x, y, 3.5, 0, 2 * Math.PI);
    Object.assign(pen, { fillStyle: hollow ? ink("back") : colour, strokeStyle: colour, lineWidth: 1.5 });
    pen.fill();
    pen.stroke();
  }

  /** A ring around a point in pixels. */
  mark([x, y], colour, radius = 6) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) return;
    const { pen } = this;
    pen.setLineDash([]);
    for (const [width, style] of [[5, ink("back")], [2.5, colour]]) {
      pen.beginPath();
      pen.arc(x, y, radius, 0, 2 * Math.PI);
      Object.assign(pen, { lineWidth: width, strokeStyle: style });
      pen.stroke();
    }
  }

  /** Where a pointer is, in pixels of the canvas. */
  pointer(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }
}

/** The number of the point nearest to `at`, if it is at most `reach` pixels away. */
function nearest(count, point, [x, y], reach = 28) {
  let [best, least] = [null, reach * reach];
  for (let k = 0; k < count; k++) {
    const [px, py] = point(k);
    const distance = (px - x) ** 2 + (py - y) ** 2;
    if (distance <= least) [best, least] = [k, distance];
  }
  return best;
}
