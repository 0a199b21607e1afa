// Energy (left axis) and length (right axis) over time, with a cursor at the frame shown.

/** A run that spans more than this factor of time starts with a logarithmic axis. */
const LOGARITHMIC_TIME_FROM = 10;

class HistoryPanel {
  constructor(record, canvas, redraw) {
    this.record = record;
    this.panel = new Panel(canvas, [58, 8, 58, 40], redraw);
    // The steps are finer than the frames, if they were logged.
    const logged = record.steps.time.length >= record.frames;
    this.energy = logged
      ? { time: [record.time[0], ...record.steps.time], value: [record.energy[0], ...record.steps.energy] }
      : { time: record.time, value: record.energy };
    this.name = !logged ? "energy of the frames"
      : record.everyStep > 1 ? `energy of one step in ${record.everyStep}` : "energy of every step";
    const times = [...this.energy.time, ...record.time].filter((time) => time > 0 && Number.isFinite(time));
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
    const { record, panel, energy } = this;
    panel.clear();
    const x = view.logTime ? new Scale(this.start, this.end, true) : new Scale(0, this.end || 1);
    const colours = { energy: ink("energy"), length: ink("length") };
    const right = Scale.around(rangeOf(record.length), 0.08);
    panel.axes(x, Scale.fitted(rangeOf(energy.value), 0.06), "time", "energy");
    panel.rightAxis(right, "length", colours.length);
    // Frames are rarer than steps: up to the first one the length is that of the start.
    const earliest = view.logTime ? this.start : 0;
    panel.line(record.frames, (k) => [panel.across(Math.max(record.time[k], earliest)), panel.up(record.length[k], right)],
      { colour: colours.length, width: 2, dash: [7, 5] });
    panel.line(energy.time.length, (k) => [panel.across(energy.time[k]), panel.up(energy.value[k])],
      { colour: colours.energy, width: 2 });
    this.drawCursor(view.frame, right, colours);
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
