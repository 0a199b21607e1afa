// Texts and tables; all of them are inserted as text.

function element(name, text = "", className = "") {
  const made = document.createElement(name);
  made.textContent = text;
  if (className) made.className = className;
  return made;
}

/** A table of names and texts; returns it and its cells with texts. */
function tableOf(rows) {
  const table = document.createElement("table");
  const cells = rows.map(([name, text]) => {
    const row = table.insertRow();
    const head = row.appendChild(element("th"));
    head.scope = "row";
    head.append(element("bdi", name));
    return row.appendChild(element("td", text));
  });
  return { table, cells };
}

function valueText(value) {
  if (typeof value === "string") return value;
  const precise = value.length > 1 ? 7 : 4;
  return value.map((number) => written(number, Number.isInteger(number) ? 9 : precise)).join(" → ");
}

/** A table under a heading, at the end of the tables; returns its cells. */
function addTable(title, rows) {
  const { table, cells } = tableOf(rows);
  const box = document.createElement("div");
  box.append(element("h2", title), table);
  document.getElementById("tables").append(box);
  return cells;
}

function writeTexts(record) {
  const put = (id, text) => { document.getElementById(id).textContent = text; };
  const last = record.frames - 1;
  put("title", record.title);
  put("ending", `${record.status}: ${record.message}; t = ${written(record.time[last])}, energy ` +
    `${written(record.energy[0])} → ${written(record.energy[last])}, ${record.nodes} nodes`);
  put("scene", record.scene);
  put("resolved-scene", record.resolvedScene);
  put("version", record.version);
  for (const { title, rows } of record.tables) addTable(title, rows.map(([name, value]) => [name, valueText(value)]));
}

/** The coordinates of a node, with the digits that tell it from the next one. */
function positionText([x, y], node) {
  const next = (node + 1) % x.length;
  const distance = Math.hypot(x[next] - x[node], y[next] - y[node]);
  const size = Math.max(Math.abs(x[node]), Math.abs(y[node]));
  const digits = Math.max(5, Math.min(15, Math.ceil(Math.log10(size / distance)) + 2)) || 5;
  const rounded = (value) => (Math.abs(value) < 1e-6 * distance ? 0 : value);
  return [x, y].map((values) => written(rounded(values[node]), digits)).join(", ");
}

/** What a node holds in a frame, by name. */
function nodeRows(record, frame, node) {
  const value = (field) => written(inFrame(record, field, frame)[node], 5);
  return [
    [`node ${node}`, `s = ${written(node / record.nodes, 5)}`],
    ["position", positionText(coordinatesIn(record, frame), node)],
    ...record.fields.map((field) => [field.name, value(field)]),
  ];
}
