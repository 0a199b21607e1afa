// The curve, coloured by a field, with the initial curve behind it and the bar of colours beside it.

const WIDTH = 6;
const BAR = { gap: 18, width: 14 };

class CurvePanel {
  constructor(record, canvas, redraw) {
    this.record = record;
    this.panel = new Panel(canvas, [46, 10, 90, 40], redraw);
    const ofFrames = Array.from({ length: record.frames }, (_, frame) => coordinatesIn(record, frame).map(extremes));
    // Far from the origin a curve is small beside its coordinates.
    this.extent = [0, 1].map((axis) => apart(extremes(ofFrames.flatMap((frame) => frame[axis])), 1e-12));
    this.ranges = record.fields.map((field) => rangeOf(field.values));
  }

  draw(view) {
    const { record, panel } = this;
    panel.clear();
    const field = record.fields[view.field];
    const values = inFrame(record, field, view.frame);
    const colours = colouring(view.ofFrame ? rangeOf(values) : this.ranges[view.field]);
    const bar = new Scale(colours.low, colours.high);
    panel.fit(this.equalScales()[1], bar, BAR.gap + BAR.width);
    panel.axes(...this.equalScales(), "x", "y");
    const start = this.through(smooth(coordinatesIn(record, 0)));
    panel.line(start.count + 1, (k) => start.at(k % start.count), { colour: ink("faint"), width: 1.5, dash: [6, 5] });
    const [x, y, shown] = smooth([...coordinatesIn(record, view.frame), values]);
    this.drawColoured(this.through([x, y]), shown, colours);
    this.drawBar(colours, bar, field.name);
    if (view.node !== null) panel.mark(this.pixels(view.frame)(view.node), ink("mark"), 8);
    panel.canvas.setAttribute("aria-label",
      `the curve at time ${written(record.time[view.frame])}, coloured by ${field.name}`);
  }

  /** The same length of a unit on both axes. */
  equalScales() {
    const { panel, extent } = this;
    const sizes = extent.map(([low, high]) => high - low);
    const unit = 1.1 * Math.max(sizes[0] / panel.width, sizes[1] / panel.height);
    return extent.map(([low, high], k) => {
      const half = 0.5 * unit * (k === 0 ? panel.width : panel.height);
      return new Scale(0.5 * (low + high) - half, 0.5 * (low + high) + half);
    });
  }

  /** The pixels of points, and their number. */
  through([x, y]) {
    return { count: x.length, at: (k) => [this.panel.across(x[k]), this.panel.up(y[k])] };
  }

  /** Pixels of the nodes in a frame. */
  pixels(frame) {
    return this.through(coordinatesIn(this.record, frame)).at;
  }

  /** Each side between two points in one shade; sides without a value are left out. */
  drawColoured({ count, at }, values, colours) {
    const { pen } = this.panel;
    const shades = new Int16Array(count);
    for (let k = 0; k < count; k++) shades[k] = shadeOf(colours, 0.5 * (values[k] + values[(k + 1) % count]));
    Object.assign(pen, { lineJoin: "round", lineCap: "round" });
    pen.setLineDash([]);
    const run = (from, to, style, width) => {
      pen.beginPath();
      for (let k = from; k <= to; k++) {
        const [x, y] = at(k % count);
        if (Number.isFinite(x) && Number.isFinite(y)) {
          k > from && at((k - 1) % count).every(Number.isFinite) ? pen.lineTo(x, y) : pen.moveTo(x, y);
        }
      }
      Object.assign(pen, { strokeStyle: style, lineWidth: width });
      pen.stroke();
    };
    const runs = (same, draw) => {
      for (let from = 0, to; from < count; from = to) {
        for (to = from + 1; to < count && same(shades[from], shades[to]); to++);
        if (shades[from] >= 0) draw(from, to);
      }
    };
    runs((one, other) => (one < 0) === (other < 0), (from, to) => run(from, to, ink("ink"), WIDTH + 2));
    runs((one, other) => one === other, (from, to) => run(from, to, colours.shades[shades[from]], WIDTH));
  }

  drawBar(colours, scale, name) {
    const { panel } = this;
    const { pen, frame } = panel;
    const left = frame.right + BAR.gap;
    const step = panel.height / SHADES;
    colours.shades.forEach((shade, k) => {
      pen.fillStyle = shade;
      pen.fillRect(left, frame.bottom - (k + 1) * step, BAR.width, step + (k > 0 ? 0.7 : 0));
    });
    Object.assign(pen, { strokeStyle: ink("edge"), lineWidth: 1 });
    pen.strokeRect(left, frame.top, BAR.width, panel.height);
    panel.rightAxis(scale, name, ink("faint"), BAR.gap + BAR.width);
  }

  /** The node that an event points at. */
  nodeAt(event, view) {
    return nearest(this.record.nodes, this.pixels(view.frame), this.panel.pointer(event));
  }
}
