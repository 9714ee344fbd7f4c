"use strict";
// The table of the atlas: facets that count, sorting, and what was found as files. Names come from rows.js.
let NAMES, ROWS, AT, found = [];
const NUMBERS = new Set(["nodes", "pairs", "girth", "automorphisms", "triangles", "diameter", "chromatic"]);
const FACETS = ["nodes", "pairs", "solutions", "girth", "automorphisms", "triangles", "diameter", "chromatic", "planar", "affine", "calibrated", "kernel"];
const YES = { 0: "no", 1: "yes" };
const WORDS = { affine: YES, calibrated: YES, planar: YES, girth: { 0: "no cycle" }, solutions: { 1: "1: unique" } };
const SHOWN = 100;

const state = { chosen: {}, degrees: "", sort: "", falling: false, shown: SHOWN };

function readAddress() {
  const words = new URLSearchParams(location.hash.slice(1));
  state.chosen = Object.fromEntries([...words].filter(([name]) => FACETS.includes(name)));
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

// Numbers from and to, either of which may be left out; null for a value as it stands in a row.
const bounds = (name, value) => {
  const [, least, most] = (NUMBERS.has(name) && /^\s*(\d*)\s*(?:-|–|to)\s*(\d*)\s*$/.exec(value)) || [];
  return least === undefined ? null : [+least, most ? +most : Infinity];
};
// How a value is read out: "1-3" are bounds of a number of solutions, and the parts of a kernel are its nodes, edges and columns.
function inWords(name, value) {
  if (name === "solutions" && value.includes("-")) { const [least, most] = value.split("-"); return most ? `${least} to ${most}` : `${least} or more`; }
  if (name === "kernel") { const [nodes, edges, columns] = value.split("."); return `${nodes} nodes, ${edges} edges: ${columns}`; }
  return WORDS[name]?.[value] ?? value;
}

// One pass: a row that fails one facet only counts among the choices of that facet.
function filter() {
  const begin = performance.now();
  const chosen = Object.entries(state.chosen).map(([name, value]) => {
    const range = bounds(name, value), at = AT[name];
    return [name, range ? (row) => +row[at] >= range[0] && +row[at] <= range[1] : (row) => row[at] === value];
  });
  const counts = Object.fromEntries(FACETS.map((name) => [name, new Map()]));
  const count = (name, row) => { const value = row[AT[name]]; counts[name].set(value, (counts[name].get(value) ?? 0) + 1); };
  const degrees = state.degrees.match(/\d+/g)?.map((degree) => `${degree},`).join("");
  found = [];
  for (const row of ROWS) {
    if (degrees && !`${row[AT.degrees]},`.startsWith(degrees)) continue;
    let failed = null, times = 0;
    for (const [name, fits] of chosen) if (!fits(row)) { failed = name; if (++times > 1) break; }
    if (times === 0) { found.push(row); for (const name of FACETS) count(name, row); } else if (times === 1) count(failed, row);
  }
  if (state.sort) {
    const at = AT[state.sort], sign = state.falling ? -1 : 1, numeric = NUMBERS.has(state.sort);
    const label = ([name]) => name.split(".");
    if (!at) found = found.map((row) => [label(row), row]).sort(([[, n, m, k]], [[, nodes, pairs, other]]) => sign * (n - nodes || m - pairs || k.length - other.length || (k < other ? -1 : 1))).map(([, row]) => row);
    else found.sort((a, b) => sign * (numeric ? +a[at] - +b[at] : a[at] < b[at] ? -1 : a[at] > b[at] ? 1 : 0));
  }
  return [counts, performance.now() - begin];
}

function fill(counts) {
  for (const name of FACETS) {
    const select = id(name), chosen = state.chosen[name] ?? "";
    const values = [...counts[name]].filter(([value]) => value !== "");
    if (id(`${name}-range`) && document.activeElement !== id(`${name}-range`)) id(`${name}-range`).value = bounds(name, chosen) ? chosen : "";
    values.sort((a, b) => (name === "kernel" ? b[1] - a[1] : a[0].localeCompare(b[0], "en", { numeric: true })));
    if (chosen && !counts[name].has(chosen)) values.push([chosen, bounds(name, chosen) ? found.length : 0]);
    const options = values.map(([value, count]) => new Option(`${inWords(name, value)} (${count})`, value, false, value === chosen));
    select.replaceChildren(new Option("any", "", false, !chosen), ...options);
  }
}

const cell = (content, className = "") => make("td", { className }, content);

// A row without a stored page has one made in the browser.
const pageOf = (row) => (row[AT.page] !== "0" ? `graphs/${row[AT.page]}.html` : `graph.html#${encodeURIComponent(row[AT.graph6])}`);

// Where nothing is found: which one condition less finds how many.
function hint(counts) {
  const near = Object.keys(state.chosen).map((name) => [name, [...counts[name].values()].reduce((all, more) => all + more, 0)]).filter(([, count]) => count);
  id("hint").replaceChildren(...near.map(([name, count]) => {
    const words = `Any ${document.querySelector(`label[for="${name}"]`).textContent}: ${count}`;
    return make("button", { type: "button", onclick: () => choose(name, "") }, words);
  }));
  if (!near.length) id("hint").textContent = "No single condition is to blame: clear some of them.";
}

function show() {
  id("rows").replaceChildren(...found.slice(0, state.shown).map((row) => {
    const link = make("a", { href: pageOf(row) }, row[AT.label]);
    return make("tr", {}, cell(link), cell(row[AT.nodes], "num"), cell(row[AT.pairs], "num"), cell(inWords("solutions", row[AT.solutions]), "num"), cell(row[AT.degrees].replaceAll(",", " ")),
      cell(inWords("girth", row[AT.girth]), "num"), cell(row[AT.automorphisms], "num"), cell(row[AT.triangles], "num"), cell(WORDS.affine[row[AT.affine]]), cell(WORDS.calibrated[row[AT.calibrated]]));
  }));
  id("more").hidden = found.length <= state.shown;
  for (const button of document.querySelectorAll("th button")) {
    const mine = button.dataset.sort === state.sort;
    button.closest("th").ariaSort = mine ? (state.falling ? "descending" : "ascending") : "none";
  }
}

function update() {
  if (!ROWS) return;
  state.shown = SHOWN;
  const [counts, time] = filter();
  fill(counts);
  show();
  const number = found.length.toLocaleString("en");
  id("hint").replaceChildren();
  if (!found.length) hint(counts);
  id("count").textContent = found.length === 1 ? "1 graph" : `${number} graphs`;
  id("count").dataset.count = found.length;
  id("count").dataset.milliseconds = time.toFixed(1);
  writeAddress();
}

function choose(name, value) {
  if (value) state.chosen[name] = value; else delete state.chosen[name];
  update();
}

for (const name of FACETS) id(name).addEventListener("change", (event) => choose(name, event.target.value));
id("degrees").addEventListener("input", (event) => { state.degrees = event.target.value; update(); });
for (const name of NUMBERS) id(`${name}-range`).addEventListener("input", ({ target: { value } }) => {
  if (!value || bounds(name, value) || /^\d+$/.test(value)) choose(name, value);
});
id("clear").addEventListener("click", () => { state.chosen = {}; state.degrees = ""; id("degrees").value = ""; update(); });
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
id("random").addEventListener("click", () => { if (found.length) location.href = pageOf(found[Math.floor(Math.random() * found.length)]); });
// Letters that have to be put in, left out or changed to come from one word to the other.
function distance(a, b) {
  let row = Array.from({ length: b.length + 1 }, (_, k) => k);
  for (let i = 1; i <= a.length; i++) row = row.reduce((next, up, j) => [...next, j ? Math.min(up + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] !== b[j - 1])) : i], []);
  return row[b.length];
}

// A name of the atlas, in any case; one that is nearly right is offered; all else is a graph of the reader's.
id("find").addEventListener("submit", (event) => {
  event.preventDefault();
  const asked = id("pasted").value.trim(), plain = (words) => words.toLowerCase().replace(/[^a-z0-9]/g, "");
  const row = ROWS?.find((row) => row[AT.label] === asked.toLowerCase());
  const scored = text("names").map(([name, page]) => [distance(plain(asked), plain(name)), name, `graphs/${page}.html`]).sort((a, b) => a[0] - b[0]);
  const [far, name, page] = scored.find(([, name]) => plain(asked).length > 2 && plain(name).includes(plain(asked))) ?? scored[0];
  if (row) location.href = pageOf(row);
  else if (!far || (plain(asked).length > 3 && plain(name).includes(plain(asked)))) location.href = page;
  else if (/^vg\./i.test(asked) || far > Math.min(2, plain(asked).length / 2)) location.href = `graph.html#${encodeURIComponent(asked)}`;
  else {
    const other = make("a", { href: `graph.html#${encodeURIComponent(asked)}` }, `read ${asked} as a graph`);
    id("near").replaceChildren("Did you mean ", make("a", { href: page }, name), "? Or ", other, ".");
  }
});

load("rows.js").then(() => {
  NAMES = window.ATLAS.columns;
  ROWS = window.ATLAS.text.split("\n").map((line) => line.split("\t"));
  AT = Object.fromEntries(NAMES.map((name, k) => [name, k]));
  const begin = () => { readAddress(); update(); };
  addEventListener("hashchange", begin);
  begin();
});
