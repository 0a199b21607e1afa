// The state as a line: curvature over a density, with the nodal lines of the agents, or over the parameter s.

/** Room around the state, in parts of its range: it ends on the nodal lines. */
const ROOM = 0.12;
const LINE_STYLES = [
  { colour: "length", width: 2 },
  { colour: "low", width: 2, dash: [9, 5] },
  { colour: "high", width: 2.5, dash: [2, 4] },
];

class TracePanel {
  /** `density`: the number of a density; null for the parameter s. */
  constructor(record, density, canvas, redraw) {
    Object.assign(this, { record, density });
    this.panel = new Panel(canvas, [50, 8, 12, 40], redraw);
    this.abscissa = density === null ? null : record.fields[density];
    this.name = density === null ? "parameter s" : this.abscissa.name;
    this.lines = density !== null && record.plane && record.plane.density === density ? record.plane.lines : [];
  }

  draw(view) {
    const { record, panel, abscissa } = this;
    panel.clear();
    const ranges = [abscissa, record.curvature].map((field) =>
      field && rangeOf(view.ofFrame ? inFrame(record, field, view.frame) : field.values));
    const x = abscissa ? Scale.around(ranges[0], ROOM) : new Scale(0, 1);
    const y = Scale.around(ranges[1], ROOM);
    panel.fit(y);
    panel.axes(x, y, this.name, "curvature κ");
    this.lines.forEach(({ points }, k) => {
      const { colour, width, dash } = LINE_STYLES[k];
      panel.line(points.length / 2, (i) => [panel.across(points[2 * i]), panel.up(points[2 * i + 1])],
        { colour: ink(colour), width, dash });
    });
    this.drawState(0, { colour: ink("faint"), width: 1.5, dash: [6, 5] });
    this.drawState(view.frame, { colour: ink("ink"), width: 2.5 });
    if (view.node !== null) panel.mark(this.pixels(view.frame)(view.node), ink("mark"));
  }

  /** Closed over a density, and a dot if it is one; over s once around, to s = 1. */
  drawState(frame, style) {
    const { record, panel, abscissa } = this;
    const [kappa, rho] = smooth([record.curvature, abscissa].filter(Boolean).map((field) => inFrame(record, field, frame)));
    const count = kappa.length;
    const point = (k) => [panel.across(rho ? rho[k % count] : k / count), panel.up(kappa[k % count])];
    panel.line(count + 1, point, style);
    const spread = [0, 1].map((axis) => extremes(Array.from({ length: count }, (_, k) => point(k)[axis])));
    if (spread.every(([low, high]) => high - low < 2)) panel.dot(point(0), style.colour);
  }

  pixels(frame) {
    const { record, panel, abscissa } = this;
    const kappa = inFrame(record, record.curvature, frame);
    const rho = abscissa && inFrame(record, abscissa, frame);
    return (node) => [panel.across(rho ? rho[node] : node / record.nodes), panel.up(kappa[node])];
  }

  /** The node that an event points at. */
  nodeAt(event, view) {
    return nearest(this.record.nodes, this.pixels(view.frame), this.panel.pointer(event));
  }
}
