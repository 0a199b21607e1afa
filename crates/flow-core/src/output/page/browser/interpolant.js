// Values between the nodes: fields are trigonometric polynomials, and few nodes are not drawn as a polygon.

/** Points of a curve at least. */
const POINTS = 256;

/** The weight of every node, by its distance, in the value `part` of a node's distance behind a node. */
function weightsAt(part, nodes) {
  return Float64Array.from({ length: nodes }, (_, distance) => {
    const angle = (Math.PI * (distance + part)) / nodes;
    // The sawtooth of an even number of nodes is a cosine.
    const wave = nodes % 2 ? Math.sin(angle) : Math.tan(angle);
    return ((distance % 2 ? -1 : 1) * Math.sin(Math.PI * part)) / (nodes * wave);
  });
}

/** `values` at the nodes and at `parts` − 1 places after each. */
function refined(values, parts) {
  const nodes = values.length;
  const fine = new Float64Array(nodes * parts);
  for (let part = 0; part < parts; part++) {
    const weights = part && weightsAt(part / parts, nodes);
    for (let k = 0; k < nodes; k++) {
      let sum = part ? 0 : values[k];
      if (part) for (let i = 0; i < nodes; i++) sum += weights[k < i ? k - i + nodes : k - i] * values[i];
      fine[k * parts + part] = sum;
    }
  }
  return fine;
}

/** The `fields` of one frame on as many points as a smooth line needs; as they are if there are gaps in them. */
function smooth(fields) {
  const nodes = fields[0].length;
  const whole = nodes > 2 && fields.every((field) => field.every((value) => Number.isFinite(value)));
  const parts = whole ? Math.ceil(POINTS / nodes) : 1;
  return parts > 1 ? fields.map((field) => refined(field, parts)) : fields;
}
