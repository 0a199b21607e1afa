// Energy (left axis) and length (right axis) over time, with a cursor at the frame shown.

/** A run that spans more than this factor of time starts with a logarithmic axis. */
const LOGARITHMIC_TIME_FROM = 10;
/** Pixels: a line that is longer in time is a guess, unless it rises or falls by less than what is visible. */
const SPARSE = 24;
const VISIBLE = 4;

class HistoryPanel {
  constructor(record, canvas, redraw) {
    this.record = record;
    this.panel = new Panel(canvas, [50, 8, 50, 40], redraw);
    const every = record.everyStep;
    this.name = every === 0 ? "energy of the frames"
      : every === 1 ? "energy of every step and frame" : `energy of the frames and of one step in ${every}`;
    const times = record.energies.time.filter((time) => time > 0 && Number.isFinite(time));
    [this.start, this.end] = times.reduce(([low, high], time) => [Math.min(low, time), Math.max(high, time)], [Infinity, 0]);
  }

  /** Whether there is a positive time before the last. */
  get canBeLogarithmic() {
    return this.start < this.end;
  }

  get startsLogarithmic() {
    return this.end > LOGARITHMIC_TIME_FROM * this.start;
  }

  draw(view) {
    const { record, panel } = this;
    panel.clear();
    const x = view.logTime ? new Scale(this.start, this.end, true) : new Scale(0, this.end || 1);
    const colours = { energy: ink("energy"), length: ink("length") };
    const left = Scale.fitted(rangeOf(record.energies.value), 0.06);
    const right = Scale.around(rangeOf(record.length), 0.08);
    panel.fit(left, right);
    panel.axes(x, left, "time", "energy");
    panel.rightAxis(right, "length", colours.length);
    const starts = [
      this.drawSeries(record.time, record.length, right, { colour: colours.length, width: 2, dash: [7, 5] }),
      this.drawSeries(record.energies.time, record.energies.value, left, { colour: colours.energy, width: 2 }),
    ];
    document.getElementById("at-start").hidden = !starts.includes(true);
    this.drawCursor(view.frame, right, colours);
  }

  /** A line, with dots at the ends of its parts that are guesses. Time zero has no place on a logarithmic axis: no line leads there,
      and a ring at the edge tells the value unless the line begins beside it; returns whether there is one. */
  drawSeries(time, value, scale, style) {
    const { panel } = this;
    const point = (k) => [panel.across(time[k]), panel.up(value[k], scale)];
    panel.line(time.length, point, style);
    const edge = panel.frame.left;
    const hidden = time.length > 1 && Number.isNaN(point(0)[0]);
    for (let k = 1; k < time.length; k++) {
      const [[fromX, fromY], [toX, toY]] = [point(k - 1), point(k)];
      const noLine = hidden && k === 1;
      if (toX - (noLine ? edge : fromX) <= SPARSE || !(noLine || Math.abs(toY - fromY) > VISIBLE)) continue;
      panel.dot([fromX, fromY], style.colour);
      panel.dot([toX, toY], style.colour);
    }
    if (!hidden) return false;
    const [start, [x, y]] = [point(0)[1], point(1)];
    const shown = x - edge <= SPARSE && Math.abs(start - y) <= VISIBLE;
    if (!shown) panel.dot([edge, start], style.colour, true);
    return !shown;
  }

  drawCursor(frame, right, colours) {
    const { record, panel } = this;
    const x = this.pixel(frame);
    Object.assign(panel.pen, { strokeStyle: ink("ink"), lineWidth: 1 });
    panel.pen.setLineDash([]);
    panel.stroke([[x, panel.frame.top], [x, panel.frame.bottom]]);
    panel.mark([x, panel.up(record.energy[frame])], colours.energy, 4);
    panel.mark([x, panel.up(record.length[frame], right)], colours.length, 4);
  }

  /** Pixel of the time of a frame; time zero stands at the left end of a logarithmic axis. */
  pixel(frame) {
    const place = this.panel.x.place(this.record.time[frame]);
    return this.panel.frame.left + Math.max(0, place || 0) * this.panel.width;
  }

  /** The frame whose time is nearest to the pointer. */
  frameAt(event) {
    const [x] = this.panel.pointer(event);
    let best = 0;
    for (let k = 1; k < this.record.frames; k++) {
      if (Math.abs(this.pixel(k) - x) < Math.abs(this.pixel(best) - x)) best = k;
    }
    return best;
  }
}
