"use strict";
// A graph of the reader's: pasted or drawn, named, looked up in the atlas, and decided in the page.
let AT = null;
const SVG = "http://www.w3.org/2000/svg";
const drawn = { nodes: 0, pairs: [], names: null, places: [], chosen: null };
const MOST_DRAWN = 200;
const MOST_NODES = 16; // Of a label.

async function rowOf(label) {
  await load("rows.js");
  AT ??= Object.fromEntries(window.ATLAS.columns.map((name, k) => [name, k]));
  return window.ATLAS.text.split("\n").find((line) => line.startsWith(`${label}\t`))?.split("\t");
}

function element(name, attributes, text = "") {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.textContent = text;
  return made;
}

// A place for a camera of its own; and those of the program's picture, as large as the ground.
const spot = (v) => [320 + 26 * Math.sqrt(v) * Math.cos(2.4 * v), 150 + 14 * Math.sqrt(v) * Math.sin(2.4 * v)];
async function layout(graph) {
  if (!graph.pairs.length) return Array.from({ length: graph.nodes }, (_, v) => spot(v));
  const { out } = await PROGRAM.run(["draw", "-", "-"], `${toGraph6(graph)}\n`), places = [];
  for (const [, v, x, y] of out.matchAll(/<g data-node="(\d+)" transform="translate\(([-\d.]+) ([-\d.]+)\)">/g)) places[v] = [+x, +y];
  const spans = [0, 1].map((axis) => places.map((place) => place[axis])).map((all) => [Math.min(...all), Math.max(...all)]);
  const scale = Math.min(560 / (spans[0][1] - spans[0][0] || 1), 240 / (spans[1][1] - spans[1][0] || 1));
  return places.map((place) => place.map((x, axis) => [320, 150][axis] + scale * (x - (spans[axis][0] + spans[axis][1]) / 2)));
}

function paint() {
  const canvas = id("canvas");
  canvas.replaceChildren();
  for (const [i, j] of drawn.pairs) {
    const [a, b] = [drawn.places[i], drawn.places[j]];
    canvas.append(element("line", { x1: a[0], y1: a[1], x2: b[0], y2: b[1], stroke: "#4477aa", "stroke-width": 2.5 }));
  }
  drawn.places.forEach(([x, y], v) => {
    const chosen = drawn.chosen === v;
    canvas.append(element("circle", { cx: x, cy: y, r: 11, fill: chosen ? "#ee6677" : "#4477aa", stroke: "#fff", "data-node": v, tabindex: 0, role: "button", "aria-label": `camera ${v}`, "aria-pressed": chosen }));
    canvas.append(element("text", { x, y, class: "number", style: "font-size: 11px; pointer-events: none" }, String(v)));
  });
}

const line = (term, value) => make("div", {}, make("dt", {}, term), make("dd", {}, value));

// What is said at once, counted in this script.
function tell() {
  const { nodes, pairs, names } = drawn;
  id("found").replaceChildren();
  if (!nodes) return;
  const degrees = Array(nodes).fill(0), words = make("p");
  for (const pair of pairs) for (const v of pair) degrees[v]++;
  const facts = [line("cameras", nodes), line("pairs", pairs.length), line("degrees", degrees.sort((a, b) => b - a).join(", "))];
  id("found").append(make("dl", { className: "facts" }, ...facts), words);
  if (names?.some((name, v) => name !== String(v))) words.append(`Numbered here: ${names.map((name, v) => `${v} is ${name}`).join(", ")}. `);
}

// What the program says of a small graph, and the place of the atlas where it is.
async function tellName({ label, graph6, girth, automorphisms }, current) {
  const facts = id("found").querySelector("dl");
  facts.append(line("label", label), line("graph6, greatest", graph6), line("girth", girth || "no cycle"), line("automorphisms", automorphisms));
  facts.dataset.label = label;
  const row = await rowOf(label);
  if (!row || !current()) return;
  const [href, words] = row[AT.page] !== "0" ? [`graphs/${row[AT.page]}.html`, "its page"] : [`search.html#kernel=${row[AT.kernel]}`, "graphs with the same kernel"];
  facts.nextSibling.append("This graph is in the atlas: ", make("a", { href }, words), ".");
}

// Seconds that one question may take, and the most pairs for which a second solution and an explicit proof are asked for.
const MOST_SECONDS = 60;
const MOST_PAIRS = 120;
let asked = 0;

// What `verify` says of the graph, run by run, in this page; then the page that the atlas would have of it.
async function decide() {
  const mine = ++asked, { nodes, pairs } = drawn;
  PROGRAM.stop();
  id("written").replaceChildren();
  id("stop").hidden = !nodes;
  id("status").textContent = "";
  if (!nodes) return;
  if (!pairs.length) { id("status").textContent = "One pair is needed."; id("stop").hidden = true; return; }
  const graph6 = toGraph6(drawn), said = {};
  const current = () => mine === asked;
  const status = (words) => { if (current()) id("status").textContent = words; };
  // Standard output of a run; "" where it gave nothing and may.
  const ask = async (name, words) => {
    const { code, out, err } = await PROGRAM.run([...words, "--time-limit", String(MOST_SECONDS)], `${graph6}\n`);
    if (code === 3 && said.report) return "";
    if (code > 1) throw new Error(err.trim() || `exit code ${code}`);
    return (said[name] = out);
  };
  try {
    status("The program is starting …");
    const first = await ask("report", ["--json", "--components", "--solutions=off", "-"]);
    if (current()) tellVerdict(JSON.parse(first));
    if (nodes <= MOST_NODES) await tellName(JSON.parse(await ask("label", ["label", "--json", "-"])), current);
    status("Decided. Its solutions are being counted …");
    await ask("report", ["--json", "--components", "-"]);
    const report = JSON.parse(said.report);
    if (current()) tellVerdict(report);
    status("Decided. Its certificate, proof and picture are being made …");
    await ask("certificate", ["-", "--certificate", "-"]);
    await ask("models", ["models", "--json", "-"]);
    await ask("picture", ["draw", "-", "-"]);
    if (pairs.length <= MOST_PAIRS) await ask("proof", ["-", "--proof", "-", "--solutions=off"]);
    if ((report.solutions?.at_least ?? 1) > 1 && pairs.length <= MOST_PAIRS) {
      status("Decided. The other solution is being looked for …");
      await ask("witness", ["witness", "-", "-"]);
    }
    if (!current()) return;
    status("Decided. Its page is being written, by Python; the first time takes some seconds …");
    const html = await written(graph6, said);
    if (!current()) return;
    id("written").innerHTML = html;
    enliven(id("written"));
    offerChecks();
    status("");
  } catch (error) {
    status(error.message === "stopped" ? "Stopped." : error.message);
  }
  if (current()) { id("stop").hidden = true; id("written").dataset.done = mine; }
}

// The verdict of the last run, in the place of that before it.
function tellVerdict(report) {
  const [word, kind] = { solvable: ["solvable", "good"], "finite-solvable": ["finite solvable", "fair"], "not-finite-solvable": ["not finite solvable", "bad"] }[report.verdict];
  const words = ` rank ${report.rank} of ${report.rank_required}, ${report.strength === "proof" ? "proved" : `error at most 2^${report.error_log2}`}: ${report.because.replace(/K_\{([\d,]+)\}/g, "K$1")}.`;
  id("verdict")?.remove();
  id("found").append(make("p", { id: "verdict" }, make("span", { className: `badge ${kind}` }, word), words));
}

async function written(graph6, said) {
  const found = await interpreter();
  await load("writer.js");
  found.FS.mkdirTree("/writer/atlas");
  for (const [name, source] of Object.entries(window.WRITER)) found.FS.writeFile(`/writer/${name}`, source);
  const kernels = {}, listed = Boolean(await rowOf(id("found").firstChild.dataset.label));
  for (const row of window.ATLAS.text.split("\n")) { const kernel = row.split("\t")[AT.kernel]; kernels[kernel] = (kernels[kernel] ?? 0) + 1; }
  found.globals.set("asked", JSON.stringify({ graph6, said, siblings: kernels, listed }));
  return found.runPython("import json, sys; sys.path.append('/writer') if '/writer' not in sys.path else None\nimport atlas.graph_page; atlas.graph_page.written(**json.loads(asked))");
}

let pause = 0;
// After a change by hand the reader may go on: it is decided when the hand rests.
function changed() {
  paint();
  tell();
  clearTimeout(pause);
  pause = setTimeout(decide, 600);
}

function take(graph, places) {
  Object.assign(drawn, { nodes: graph.nodes, pairs: graph.pairs, names: graph.names, places, chosen: null });
  id("message").textContent = "";
  paint();
  tell();
  decide();
}

// A label; or any text that `verify` reads, read by it.
async function graphOf(text) {
  const label = /^vg\.\S+$/i.test(text) && text.toLowerCase();
  const { code, out, err } = await PROGRAM.run(label ? ["label", "--json", label] : ["convert", "-"], `${text}\n`);
  if (code) throw new Error(err.trim().replace(/^verify: (?:-(?::(\d+))?: )?/, (_, line) => (line ? `line ${line}: ` : "")));
  return label ? graphOf(JSON.parse(out).graph6) : ofConverted(out);
}

// Not `read`: by a function of that name Python takes the page for a shell.
async function taken(input) {
  const mine = ++asked;
  clearTimeout(pause);
  PROGRAM.stop();
  id("message").textContent = "";
  id("status").textContent = "The program is starting …";
  try {
    const graph = await graphOf(input.trim());
    if (graph.nodes > MOST_DRAWN) throw new Error(`this page decides graphs of up to ${MOST_DRAWN} cameras; for larger ones there is the program`);
    const places = await layout(graph);
    if (mine === asked) take(graph, places);
  } catch (error) {
    if (mine !== asked) return;
    id("status").textContent = "";
    id("message").textContent = error.message;
  }
}

function joined(i, j) {
  const [a, b] = [Math.min(i, j), Math.max(i, j)];
  const at = drawn.pairs.findIndex((pair) => pair[0] === a && pair[1] === b);
  if (at >= 0) drawn.pairs.splice(at, 1); else drawn.pairs.push([a, b]);
}

// A camera at a place, joined to the chosen one.
function placed(x, y) {
  if (drawn.nodes >= MOST_DRAWN) return;
  drawn.places.push([x, y]);
  drawn.nodes++;
  drawn.names = null;
  if (drawn.chosen !== null) joined(drawn.chosen, drawn.nodes - 1);
  drawn.chosen = null;
  changed();
}

// A camera is chosen, or joined to the chosen one; the keyboard stays on it.
function pressed(node) {
  const before = drawn.chosen;
  if (before !== null && before !== node) joined(before, node);
  drawn.chosen = before === null ? node : null;
  if (drawn.chosen === null) changed(); else paint();
  id("canvas").querySelector(`[data-node="${node}"]`).focus();
}

id("canvas").addEventListener("click", (event) => {
  const node = event.target.dataset?.node;
  if (node !== undefined) { pressed(+node); return; }
  const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(id("canvas").getScreenCTM().inverse());
  placed(x, y);
});
id("canvas").addEventListener("keydown", (event) => {
  const node = event.target.dataset?.node;
  if (node === undefined || ![" ", "Enter"].includes(event.key)) return;
  event.preventDefault();
  pressed(+node);
});
id("add").addEventListener("click", () => placed(...spot(drawn.nodes)));
id("stop").addEventListener("click", () => PROGRAM.stop());
id("empty").addEventListener("click", () => take({ nodes: 0, pairs: [] }, []));
id("read").addEventListener("submit", (event) => { event.preventDefault(); history.replaceState(null, "", `#${encodeURIComponent(id("pasted").value)}`); taken(id("pasted").value); });
function fromAddress() {
  let input = "";
  try { input = decodeURIComponent(location.hash.slice(1)); } catch { id("message").textContent = "The address of this page holds no text: paste the graph"; }
  if (!input) return;
  id("pasted").value = input;
  taken(input);
}
addEventListener("hashchange", fromAddress);
fromAddress();
