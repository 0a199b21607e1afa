// Colour maps: viridis (van der Walt and Smith), and for values of both signs one from blue over grey to red.

const VIRIDIS = ["440154", "482475", "414487", "355f8d", "2a788e", "21918c", "22a884", "44bf70", "7ad151", "bddf26", "fde725"];
const SIGNED = ["053061", "2166ac", "4393c3", "92c5de", "d1e5f0", "e9e9e9", "fddbc7", "f4a582", "d6604d", "b2182b", "67001f"];
const SHADES = 128;
/** A field has both signs if the smaller of its extremes is at least this part of the larger. */
const BOTH_SIGNS = 0.02;

function shadesOf(anchors) {
  const channels = anchors.map((hex) => [0, 2, 4].map((k) => parseInt(hex.slice(k, k + 2), 16)));
  return Array.from({ length: SHADES }, (_, shade) => {
    const place = (shade / (SHADES - 1)) * (anchors.length - 1);
    const below = Math.min(Math.floor(place), anchors.length - 2);
    const mixed = channels[below].map((from, k) => Math.round(from + (place - below) * (channels[below + 1][k] - from)));
    return `rgb(${mixed.join(",")})`;
  });
}

const SHADES_OF = { plain: shadesOf(VIRIDIS), signed: shadesOf(SIGNED) };

/** The shades of a range of values, with zero in the middle if they have both signs. */
function colouring([low, high]) {
  const signed = low < 0 && high > 0 && Math.min(-low, high) > BOTH_SIGNS * Math.max(-low, high);
  const most = Math.max(-low, high);
  return signed ? { low: -most, high: most, shades: SHADES_OF.signed } : { low, high, shades: SHADES_OF.plain };
}

/** Number of the shade of `value`; −1 if it is none. */
function shadeOf(colouring, value) {
  if (!Number.isFinite(value)) return -1;
  const place = (value - colouring.low) / (colouring.high - colouring.low);
  return Math.max(0, Math.min(SHADES - 1, Math.round(place * (SHADES - 1))));
}
