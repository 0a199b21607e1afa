// How the values at the ticks of a linear axis are written: what they share stands in the name of the axis.

/** Digits of a label at most; values that need more are written as differences. */
const MOST_DIGITS = 5;

/** The power of ten at or below a positive value. */
function decade(value) {
  return Math.floor(Math.log10(value) + 1e-9);
}

/** A label is (value − origin) / 10^exponent; for ticks at multiples of `step` from `low` to `high`. */
function notation(low, high, step) {
  const sizeFrom = (origin) => decade(Math.max(Math.abs(low - origin), Math.abs(high - origin)));
  let origin = 0;
  if (sizeFrom(0) - decade(step) + 1 > MOST_DIGITS) {
    const unit = 10 ** Math.ceil(Math.log10(high - low));
    origin = Math.round((low / 2 + high / 2) / unit) * unit;
  }
  const size = sizeFrom(origin);
  const exponent = size >= -2 && size < 5 ? 0 : size;
  const decimals = Math.max(0, exponent - decade(step));
  const label = (value) => {
    const difference = Math.abs(value - origin) < 1e-6 * step ? 0 : value - origin;
    return (difference / 10 ** exponent).toFixed(decimals).replace("-", "−");
  };
  const from = origin === 0 ? "" : ` ${origin < 0 ? "+" : "−"} ${written(Math.abs(origin), 15)}`;
  const unit = exponent === 0 ? "" : ` [${powerOfTen(exponent)}]`;
  return { label, title: (name) => name + from + unit };
}
