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
  record.centres = numbersOf("centres", 8);
  record.fields = named(record.fields, numbersOf("fields", 4));
  record.history = named(record.history, numbersOf("values", 8));
  const [time, energy] = named(["time", "energy"], numbersOf("energies", 8));
  record.energies = { time: time.values, value: energy.values };
  [record.time, record.energy, record.length] = record.history.map((value) => value.values);
  for (const line of record.plane?.lines ?? []) line.points = decoded(line.points, 4);
  record.curvature = record.fields[record.densities.length];
  return record;
}

/** The values of `field` in one frame, one per node. */
function inFrame(record, field, frame) {
  return field.values.subarray(frame * record.nodes, (frame + 1) * record.nodes);
}

/** The coordinates x and y in one frame, one per node. */
function coordinatesIn(record, frame) {
  const first = 2 * frame * record.nodes;
  return [0, 1].map((axis) => Float64Array.from({ length: record.nodes },
    (_, node) => record.centres[2 * frame + axis] + record.positions[first + 2 * node + axis]));
}

/** Least and greatest of the finite values. */
function extremes(values) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
}

/** The same, never equal. Single precision holds seven digits: what varies by less than a part `constant` is constant. */
function apart([low, high], constant = 1e-6) {
  if (low > high) return [0, 1];
  const size = Math.max(Math.abs(low), Math.abs(high), 1e-300);
  return high - low > constant * size ? [low, high] : [low - 0.05 * size, high + 0.05 * size];
}

function rangeOf(values) {
  return apart(extremes(values));
}
