// Scales of axes: linear or logarithmic, and the values that they name.

/** Values that differ by more than this factor get a logarithmic axis. */
const LOGARITHMIC_FROM = 20;

class Scale {
  constructor(low, high, logarithmic = false) {
    Object.assign(this, { low, high, logarithmic });
  }

  /** A scale around a range, with a margin in parts of it. */
  static around([low, high], margin) {
    const pad = margin * (high - low);
    return new Scale(low - pad, high + pad);
  }

  /** As `around`, but logarithmic if the values are positive and differ by a large factor. */
  static fitted([low, high], margin) {
    if (!(low > 0) || high < LOGARITHMIC_FROM * low) return Scale.around([low, high], margin);
    const factor = (high / low) ** margin;
    return new Scale(low / factor, high * factor, true);
  }

  /** Place of `value` along the axis: 0 at its low end, 1 at its high end; NaN if it has none. */
  place(value) {
    if (!this.logarithmic) return (value - this.low) / (this.high - this.low);
    return value > 0 ? Math.log(value / this.low) / Math.log(this.high / this.low) : NaN;
  }

  /** Up to about `count` values to name, with their texts, and what becomes of the name of the axis. */
  labels(count) {
    return this.logarithmic ? { ticks: this.decades(count), title: (name) => name } : this.steps(count);
  }

  steps(count) {
    const rough = (this.high - this.low) / Math.max(count, 1);
    const unit = 10 ** Math.floor(Math.log10(rough));
    const step = unit * ([1, 2, 5].find((factor) => factor * unit >= rough) ?? 10);
    const { label, title } = notation(this.low, this.high, step);
    const ticks = [];
    for (let k = Math.ceil(this.low / step); k <= Math.floor(this.high / step); k++) {
      ticks.push({ value: k * step, text: label(k * step) });
    }
    return { ticks, title };
  }

  decades(count) {
    const [first, last] = [Math.ceil(Math.log10(this.low) - 1e-9), Math.floor(Math.log10(this.high) + 1e-9)];
    const ticks = [];
    if (last - first < 2) {
      const inside = (value) => Math.abs(this.place(value) - 0.5) < 0.5 + 1e-9;
      for (let k = first - 1; k <= last; k++) {
        for (const factor of count < 3 ? [1, 5] : [1, 2, 5]) {
          const value = factor * 10 ** k;
          if (inside(value)) ticks.push({ value, text: written(value, 3) });
        }
      }
      return ticks;
    }
    const every = Math.ceil((last - first + 1) / Math.max(count, 1));
    for (let k = first; k <= last; k += every) ticks.push({ value: 10 ** k, text: powerOfTen(k) });
    return ticks;
  }
}
