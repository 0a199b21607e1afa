// Numbers as texts.

const SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹";

function powerOfTen(exponent) {
  const digits = String(Math.abs(exponent)).replace(/\d/g, (digit) => SUPERSCRIPTS[digit]);
  return `10${exponent < 0 ? "⁻" : ""}${digits}`;
}

/** `value` with at most `digits` significant digits. */
function written(value, digits = 6) {
  if (value === null || Number.isNaN(value)) return "not a number";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e").map(Number);
  const plain = exponent >= -3 && exponent < Math.max(6, digits);
  const text = String(plain ? Number(value.toPrecision(digits)) : mantissa).replace("-", "−");
  return plain ? text : `${text}\u00a0×\u00a0${powerOfTen(exponent)}`;
}
