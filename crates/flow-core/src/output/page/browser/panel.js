// A panel: a canvas with a frame, axes, and lines in the units of the axes.

const FONT = '12px system-ui, "DejaVu Sans", sans-serif';
const TICK = 5;

/** A colour of the style sheet, which knows light from dark. */
function ink(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

class Panel {
  /** `margins`: pixels left of, above, right of and below the frame. */
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
    const [left, top, right, bottom] = margins;
    this.frame = { left, top, right: Math.max(left + 1, width - right), bottom: Math.max(top + 1, height - bottom) };
  }

  get width() {
    return this.frame.right - this.frame.left;
  }

  get height() {
    return this.frame.bottom - this.frame.top;
  }

  /** Draws grid, frame and names of the axes. */
  axes(x, y, xName, yName) {
    Object.assign(this, { x, y });
    const { pen, frame } = this;
    Object.assign(pen, { font: FONT, lineWidth: 1, strokeStyle: ink("grid"), fillStyle: ink("faint") });
    pen.setLineDash([]);
    pen.textAlign = "center";
    pen.textBaseline = "top";
    for (const { value, text } of x.ticks(this.width / 75)) {
      const at = this.across(value);
      this.stroke([[at, frame.top], [at, frame.bottom]]);
      pen.fillText(text, at, frame.bottom + TICK);
    }
    pen.fillText(xName, (frame.left + frame.right) / 2, frame.bottom + 22);
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    for (const { value, text } of y.ticks(this.height / 45)) {
      const at = this.up(value);
      this.stroke([[frame.left, at], [frame.right, at]]);
      pen.fillText(text, frame.left - TICK, at);
    }
    this.sideways(yName, 10);
    pen.strokeStyle = ink("edge");
    pen.strokeRect(frame.left, frame.top, this.width, this.height);
  }

  /** A second axis on the right. */
  rightAxis(scale, name, colour) {
    const { pen, frame } = this;
    Object.assign(pen, { fillStyle: colour, textAlign: "left", textBaseline: "middle" });
    for (const { value, text } of scale.ticks(this.height / 45)) {
      pen.fillText(text, frame.right + TICK, this.up(value, scale));
    }
    this.sideways(name, this.canvas.clientWidth - 8);
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
