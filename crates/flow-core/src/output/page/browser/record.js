// The record: what the page was given, as texts and numbers.

/** The numbers in a base64 text, `size` bytes each, little end first. */
function decoded(text, size) {
  const bytes = atob(text);
  const view = new DataView(new ArrayBuffer(bytes.length));
  for (let k = 0; k < bytes.length; k++) view.setUint8(k, bytes.charCodeAt(k));
  const numbers = size === 4 ? new Float32Array(bytes.length / 4) : new Float64Array(bytes.length / 8);
  for (let k = 0; k < numbers.length; k++) {
    numbers[k] = size === 4 ? view.getFloat32(4 * k, true) : view.getFloat64(8 * k, true);
  }
  return numbers;
}

function numbersOf(id, size) {
  return decoded(document.getElementById(id).textContent, size);
}

/** As many equal parts of `numbers` as there are `names`. */
function named(names, numbers) {
  const size = names.length ? numbers.length / names.length : 0;
  return names.map((name, k) => ({ name, values: numbers.subarray(k * size, (k + 1) * size) }));
}

function readRecord() {
  const record = JSON.parse(document.getElementById("summary").textContent);
  record.positions = numbersOf("positions", 4);
  record.fields = named(record.fields, numbersOf("fields", 4));
  record.history = named(record.history, numbersOf("values", 8));
  const [time, energy] = named(["time", "energy"], numbersOf("steps", 8));
  record.steps = { time: time.values, energy: energy.values };
  [record.time, record.energy, record.length] = record.history.map((value) => value.values);
  for (const line of record.plane?.lines ?? []) line.points = decoded(line.points, 4);
  record.curvature = record.fields[record.densities.length];
  return record;
}

/** The values of `field` in one frame, one per node. */
function inFrame(record, field, frame) {
  return field.values.subarray(frame * record.nodes, (frame + 1) * record.nodes);
}

/** The positions in one frame: x, y, x, y and so on. */
function positionsIn(record, frame) {
  return record.positions.subarray(2 * frame * record.nodes, 2 * (frame + 1) * record.nodes);
}

/** Least and greatest of the finite values, never equal; `first` and `every` pick some of them. */
function rangeOf(values, first = 0, every = 1) {
  let [low, high] = [Infinity, -Infinity];
  for (let k = first; k < values.length; k += every) {
    const value = values[k];
    if (!Number.isFinite(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (low > high) return [0, 1];
  const size = Math.max(Math.abs(low), Math.abs(high), 1e-300);
  // Single precision holds seven digits: what varies by less is constant.
  return high - low > 1e-6 * size ? [low, high] : [low - 0.05 * size, high + 0.05 * size];
}
