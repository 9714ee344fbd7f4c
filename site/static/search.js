"use strict";
// The table of the atlas: facets that count, sorting, and what was found as files. Names come from rows.js.
const NAMES = window.ATLAS.columns;
const ROWS = window.ATLAS.text.split("\n").map((line) => line.split("\t"));
const AT = Object.fromEntries(NAMES.map((name, k) => [name, k]));
const NUMBERS = new Set(["nodes", "pairs", "girth", "automorphisms", "triangles"]);
const FACETS = ["nodes", "pairs", "solutions", "girth", "automorphisms", "triangles", "affine", "calibrated", "kernel"];
const WORDS = { affine: { 0: "no", 1: "yes" }, calibrated: { 0: "no", 1: "yes" } };
const SHOWN = 100;

const state = { chosen: {}, degrees: "", sort: "", falling: false, shown: SHOWN };
let found = [];
const id = (name) => document.getElementById(name);

function readAddress() {
  const words = new URLSearchParams(location.hash.slice(1));
  state.chosen = {};
  for (const name of FACETS) if (words.has(name)) state.chosen[name] = words.get(name);
  state.degrees = words.get("degrees") ?? "";
  state.sort = NAMES.includes(words.get("sort")) ? words.get("sort") : "";
  state.falling = words.get("order") === "falling";
  id("degrees").value = state.degrees;
}

function writeAddress() {
  const words = new URLSearchParams(state.chosen);
  if (state.degrees) words.set("degrees", state.degrees);
  if (state.sort) words.set("sort", state.sort);
  if (state.falling) words.set("order", "falling");
  history.replaceState(null, "", `#${words}`);
}

// One pass: a row that fails one facet only counts among the choices of that facet.
function filter() {
  const begin = performance.now();
  const chosen = Object.entries(state.chosen).map(([name, value]) => [name, AT[name], value]);
  const counts = Object.fromEntries(FACETS.map((name) => [name, new Map()]));
  const count = (name, row) => { const value = row[AT[name]]; counts[name].set(value, (counts[name].get(value) ?? 0) + 1); };
  const degrees = state.degrees.replace(/\s/g, "");
  found = [];
  for (const row of ROWS) {
    if (degrees && !row[AT.degrees].startsWith(degrees)) continue;
    let failed = null, times = 0;
    for (const [name, at, value] of chosen) if (row[at] !== value) { failed = name; if (++times > 1) break; }
    if (times === 0) { found.push(row); for (const name of FACETS) count(name, row); } else if (times === 1) count(failed, row);
  }
  if (state.sort) {
    const at = AT[state.sort], sign = state.falling ? -1 : 1, numeric = NUMBERS.has(state.sort);
    found.sort((a, b) => sign * (numeric ? +a[at] - +b[at] : a[at] < b[at] ? -1 : a[at] > b[at] ? 1 : 0));
  }
  return [counts, performance.now() - begin];
}

function fill(counts) {
  for (const name of FACETS) {
    const select = id(name), chosen = state.chosen[name] ?? "";
    const values = [...counts[name]].filter(([value]) => value !== "");
    values.sort((a, b) => (name === "kernel" ? b[1] - a[1] : a[0].localeCompare(b[0], "en", { numeric: true })));
    if (chosen && !counts[name].has(chosen)) values.push([chosen, 0]);
    const options = values.slice(0, 400).map(([value, count]) => {
      const shown = WORDS[name]?.[value] ?? (name === "girth" && value === "0" ? "no cycle" : value);
      return new Option(`${shown} (${count})`, value, false, value === chosen);
    });
    select.replaceChildren(new Option("any", "", false, !chosen), ...options);
  }
}

function cell(text, kind = "") {
  const td = document.createElement("td");
  td.textContent = text;
  td.className = kind;
  return td;
}

function show() {
  const body = id("rows");
  body.replaceChildren(...found.slice(0, state.shown).map((row) => {
    const tr = document.createElement("tr");
    const name = cell("");
    const link = document.createElement("a");
    link.textContent = row[AT.label];
    link.href = row[AT.page] !== "0" ? `graphs/${row[AT.page]}.html` : `graph.html#${encodeURIComponent(row[AT.graph6])}`;
    name.append(link);
    tr.append(name, cell(row[AT.nodes], "num"), cell(row[AT.pairs], "num"), cell(row[AT.solutions] || "infinitely many", "num"), cell(row[AT.degrees].replaceAll(",", " ")),
      cell(row[AT.girth] === "0" ? "–" : row[AT.girth], "num"), cell(row[AT.automorphisms], "num"), cell(row[AT.triangles], "num"), cell(WORDS.affine[row[AT.affine]]), cell(WORDS.calibrated[row[AT.calibrated]]));
    return tr;
  }));
  id("more").hidden = found.length <= state.shown;
  for (const button of document.querySelectorAll("th button")) {
    const mine = button.dataset.sort === state.sort;
    button.closest("th").ariaSort = mine ? (state.falling ? "descending" : "ascending") : "none";
  }
}

function update() {
  const [counts, time] = filter();
  fill(counts);
  show();
  const number = found.length.toLocaleString("en");
  id("count").textContent = found.length === 1 ? "1 graph" : `${number} graphs`;
  id("count").dataset.count = found.length;
  id("count").dataset.milliseconds = time.toFixed(1);
  writeAddress();
}

for (const name of FACETS) id(name).addEventListener("change", (event) => {
  if (event.target.value) state.chosen[name] = event.target.value; else delete state.chosen[name];
  state.shown = SHOWN;
  update();
});
id("degrees").addEventListener("input", (event) => { state.degrees = event.target.value; state.shown = SHOWN; update(); });
id("clear").addEventListener("click", () => { state.chosen = {}; state.degrees = ""; id("degrees").value = ""; state.shown = SHOWN; update(); });
id("more").addEventListener("click", () => { state.shown += 5 * SHOWN; show(); });
for (const button of document.querySelectorAll("th button")) button.addEventListener("click", () => {
  state.falling = state.sort === button.dataset.sort && !state.falling;
  state.sort = button.dataset.sort;
  update();
});
id("save-g6").addEventListener("click", () => save("selection.g6", found.map((row) => `${row[AT.graph6]}\n`).join("")));
id("save-tsv").addEventListener("click", () => {
  const kept = NAMES.filter((name) => name !== "page");
  save("selection.tsv", [kept, ...found.map((row) => kept.map((name) => row[AT[name]]))].map((cells) => `${cells.join("\t")}\n`).join(""));
});
// Columns by kind: numbers, yes or no, texts; of the numbers of solutions some are bounds ("1-3"), so they are texts.
function columns() {
  const kept = NAMES.filter((name) => name !== "page");
  return kept.map((name) => {
    const cells = found.map((row) => row[AT[name]]);
    if (NUMBERS.has(name)) return { name, data: cells.map(Number), type: "INT32" };
    return WORDS[name] ? { name, data: cells.map((cell) => cell === "1"), type: "BOOLEAN" } : { name, data: cells, type: "STRING" };
  });
}
id("save-parquet").addEventListener("click", async () => {
  await load("parquet.js");
  save("selection.parquet", window.parquet(columns()), "application/vnd.apache.parquet");
});
id("find").addEventListener("submit", (event) => {
  event.preventDefault();
  location.href = `graph.html#${encodeURIComponent(id("pasted").value)}`;
});
addEventListener("hashchange", () => { readAddress(); update(); });
readAddress();
update();
