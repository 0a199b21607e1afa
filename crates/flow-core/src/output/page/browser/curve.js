// The curve, coloured by a field, with the initial curve behind it and the bar of colours beside it.

const WIDTH = 6;
const BAR = { gap: 18, width: 14 };

class CurvePanel {
  constructor(record, canvas, redraw) {
    this.record = record;
    this.panel = new Panel(canvas, [46, 10, 100, 40], redraw);
    this.extent = [0, 1].map((first) => rangeOf(record.positions, first, 2));
    this.ranges = record.fields.map((field) => rangeOf(field.values));
  }

  draw(view) {
    const { record, panel } = this;
    panel.clear();
    panel.axes(...this.equalScales(), "x", "y");
    const field = record.fields[view.field];
    const values = inFrame(record, field, view.frame);
    const colours = colouring(view.ofFrame ? rangeOf(values) : this.ranges[view.field]);
    const start = this.pixels(0);
    panel.line(record.nodes + 1, (k) => start(k % record.nodes), { colour: ink("faint"), width: 1.5, dash: [6, 5] });
    this.drawColoured(view, values, colours);
    this.drawBar(colours, field.name);
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

  /** Pixels of the nodes in a frame. */
  pixels(frame) {
    const points = positionsIn(this.record, frame);
    return (node) => [this.panel.across(points[2 * node]), this.panel.up(points[2 * node + 1])];
  }

  /** Each side between two nodes in one shade; sides without a value are left out. */
  drawColoured(view, values, colours) {
    const { panel, record: { nodes } } = this;
    const { pen } = panel;
    const point = this.pixels(view.frame);
    const shades = new Int16Array(nodes);
    for (let k = 0; k < nodes; k++) shades[k] = shadeOf(colours, 0.5 * (values[k] + values[(k + 1) % nodes]));
    Object.assign(pen, { lineJoin: "round", lineCap: "round" });
    pen.setLineDash([]);
    const run = (from, to, style, width) => {
      pen.beginPath();
      for (let k = from; k <= to; k++) {
        const [x, y] = point(k % nodes);
        if (Number.isFinite(x) && Number.isFinite(y)) {
          k > from && point((k - 1) % nodes).every(Number.isFinite) ? pen.lineTo(x, y) : pen.moveTo(x, y);
        }
      }
      Object.assign(pen, { strokeStyle: style, lineWidth: width });
      pen.stroke();
    };
    const runs = (same, draw) => {
      for (let from = 0, to; from < nodes; from = to) {
        for (to = from + 1; to < nodes && same(shades[from], shades[to]); to++);
        if (shades[from] >= 0) draw(from, to);
      }
    };
    runs((one, other) => (one < 0) === (other < 0), (from, to) => run(from, to, ink("ink"), WIDTH + 2));
    runs((one, other) => one === other, (from, to) => run(from, to, colours.shades[shades[from]], WIDTH));
  }

  drawBar(colours, name) {
    const { panel } = this;
    const { pen, frame } = panel;
    const left = frame.right + BAR.gap;
    const step = panel.height / SHADES;
    colours.shades.forEach((shade, k) => {
      pen.fillStyle = shade;
      pen.fillRect(left, frame.bottom - (k + 1) * step, BAR.width, step + (k > 0 ? 0.7 : 0));
    });
    Object.assign(pen, { strokeStyle: ink("edge"), lineWidth: 1, font: FONT, fillStyle: ink("faint") });
    pen.strokeRect(left, frame.top, BAR.width, panel.height);
    const scale = new Scale(colours.low, colours.high);
    Object.assign(pen, { textAlign: "left", textBaseline: "middle" });
    for (const { value, text } of scale.ticks(panel.height / 50)) {
      pen.fillText(text, left + BAR.width + TICK, panel.up(value, scale));
    }
    panel.sideways(name, panel.canvas.clientWidth - 8);
  }

  /** The node that an event points at. */
  nodeAt(event, view) {
    return nearest(this.record.nodes, this.pixels(view.frame), this.panel.pointer(event));
  }
}
