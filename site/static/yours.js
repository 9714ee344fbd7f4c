"use strict";
// A graph of the reader's: pasted or drawn, named, and looked up in the atlas.
const NAMES = window.ATLAS.columns;
const AT = Object.fromEntries(NAMES.map((name, k) => [name, k]));
let rows = null;
const id = (name) => document.getElementById(name);
const SVG = "http://www.w3.org/2000/svg";
const drawn = { nodes: 0, pairs: [], places: [], chosen: null };

function rowOf(label) {
  rows ??= new Map(window.ATLAS.text.split("\n").map((line) => [line.slice(0, line.indexOf("\t")), line]));
  return rows.get(label)?.split("\t");
}

function element(name, attributes, text = "") {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.textContent = text;
  return made;
}

// Springs from a circle: the same picture for the same graph.
function layout({ nodes, pairs }) {
  const width = 640, height = 300;
  const at = Array.from({ length: nodes }, (_, v) => [Math.cos((2 * Math.PI * v) / nodes), Math.sin((2 * Math.PI * v) / nodes)]);
  for (let round = 0; round < 300; round++) {
    const force = at.map(() => [0, 0]), heat = 0.1 * (1 - round / 300);
    const push = (i, j, by) => {
      const dx = at[i][0] - at[j][0], dy = at[i][1] - at[j][1], d = Math.hypot(dx, dy) || 0.01, f = by(d) / d;
      force[i][0] += dx * f; force[i][1] += dy * f; force[j][0] -= dx * f; force[j][1] -= dy * f;
    };
    for (let i = 0; i < nodes; i++) for (let j = 0; j < i; j++) push(i, j, (d) => 0.18 / d);
    for (const [i, j] of pairs) push(i, j, (d) => -d * d);
    at.forEach((p, v) => { const f = Math.hypot(...force[v]) || 1, s = Math.min(f, heat) / f; p[0] += force[v][0] * s; p[1] += force[v][1] * s; });
  }
  const xs = at.map((p) => p[0]), ys = at.map((p) => p[1]);
  const [x0, y0] = [Math.min(...xs), Math.min(...ys)];
  const scale = Math.min((width - 80) / (Math.max(...xs) - x0 || 1), (height - 60) / (Math.max(...ys) - y0 || 1));
  const dx = (width - scale * (Math.max(...xs) - x0)) / 2, dy = (height - scale * (Math.max(...ys) - y0)) / 2;
  return at.map(([x, y]) => [dx + (x - x0) * scale, dy + (y - y0) * scale]);
}

function paint() {
  const canvas = id("canvas");
  canvas.replaceChildren();
  for (const [i, j] of drawn.pairs) {
    const [a, b] = [drawn.places[i], drawn.places[j]];
    canvas.append(element("line", { x1: a[0], y1: a[1], x2: b[0], y2: b[1], stroke: "#4477aa", "stroke-width": 2.5 }));
  }
  drawn.places.forEach(([x, y], v) => {
    canvas.append(element("circle", { cx: x, cy: y, r: 11, fill: drawn.chosen === v ? "#ee6677" : "#4477aa", stroke: "#fff", "data-node": v }));
    canvas.append(element("text", { x, y, class: "number", style: "font-size: 11px; pointer-events: none" }, String(v)));
  });
}

function line(term, value) {
  const div = document.createElement("div"), dt = document.createElement("dt"), dd = document.createElement("dd");
  dt.textContent = term;
  dd.append(value);
  div.append(dt, dd);
  return div;
}

function tell() {
  const place = id("found");
  const { nodes, pairs } = drawn;
  place.replaceChildren();
  if (!nodes) return;
  const facts = document.createElement("dl");
  facts.className = "facts";
  const degrees = Array(nodes).fill(0);
  for (const pair of pairs) for (const v of pair) degrees[v]++;
  facts.append(line("cameras", nodes), line("pairs", pairs.length), line("degrees", degrees.sort((a, b) => b - a).join(", ")));
  const words = document.createElement("p");
  place.append(facts, words);
  const graph6 = nodes <= 62 ? toGraph6(drawn) : "";
  const command = document.createElement("code");
  command.textContent = `echo '${graph6}' | verify -`;
  if (nodes > MOST_NODES) {
    words.append("Graphs with up to 16 cameras have labels. What this one determines: ", command);
    return;
  }
  const best = greatest(drawn), label = labelOf(drawn), row = rowOf(label);
  facts.append(line("label", label), line("graph6, greatest", toGraph6(best)), line("girth", girthOf(drawn) || "no cycle"), line("automorphisms", best.automorphisms));
  facts.dataset.label = label;
  if (row) {
    const link = document.createElement("a");
    link.href = row[AT.page] !== "0" ? `graphs/${row[AT.page]}.html` : `search.html#kernel=${row[AT.kernel]}`;
    link.textContent = row[AT.page] !== "0" ? "its page" : "graphs with the same kernel";
    const solutions = row[AT.solutions];
    const known = !solutions ? "It is not finite solvable (proved)" : `It is finite solvable (proved), number of solutions: ${solutions.replace(/-$/, " at least")}`;
    words.append(`This graph is in the atlas. ${known}; affine cameras: ${row[AT.affine] === "1" ? "solvable" : "not"}, known intrinsics: ${row[AT.calibrated] === "1" ? "solvable" : "not"}. Go to `, link, ".");
    if (row[AT.page] === "0") words.append(" Its certificate is made by ", command, " with --certificate FILE.");
  } else if (7 * pairs.length < 11 * nodes - 15) {
    words.append(`Too few pairs: 7·${pairs.length} < 11·${nodes} − 15, so it is not finite solvable (theory, section 5). Which parts are determined: `, command);
  } else {
    words.append("This graph is not in the atlas, which holds the finite-solvable graphs with the least number of pairs and up to 12 cameras. What it determines: ", command);
  }
}

function take(graph) {
  Object.assign(drawn, { nodes: graph.nodes, pairs: graph.pairs, places: layout(graph), chosen: null });
  id("message").textContent = "";
  paint();
  tell();
}

function read(input) {
  try {
    const graph = readGraph(input);
    if (graph.nodes > 62) throw new Error("graphs with up to 62 cameras are drawn here");
    take(graph);
  } catch (error) {
    id("message").textContent = error.message;
  }
}

function nodeAdded(x, y) { drawn.places.push([x, y]); drawn.nodes++; }

function joined(i, j) {
  const [a, b] = [Math.min(i, j), Math.max(i, j)];
  const at = drawn.pairs.findIndex((pair) => pair[0] === a && pair[1] === b);
  if (at >= 0) drawn.pairs.splice(at, 1); else drawn.pairs.push([a, b]);
}

id("canvas").addEventListener("click", (event) => {
  const canvas = id("canvas"), node = event.target.dataset?.node;
  if (node === undefined) {
    if (drawn.nodes >= 62) return;
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(canvas.getScreenCTM().inverse());
    nodeAdded(point.x, point.y);
    if (drawn.chosen !== null) joined(drawn.chosen, drawn.nodes - 1);
    drawn.chosen = null;
  } else if (drawn.chosen === null) drawn.chosen = +node;
  else { if (drawn.chosen !== +node) joined(drawn.chosen, +node); drawn.chosen = null; }
  paint();
  tell();
});
id("empty").addEventListener("click", () => take({ nodes: 0, pairs: [] }));
id("read").addEventListener("submit", (event) => { event.preventDefault(); history.replaceState(null, "", `#${encodeURIComponent(id("pasted").value)}`); read(id("pasted").value); });
function fromAddress() {
  const input = decodeURIComponent(location.hash.slice(1));
  if (!input) return;
  id("pasted").value = input;
  read(input);
}
addEventListener("hashchange", fromAddress);
fromAddress();
