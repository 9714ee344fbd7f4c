"use strict";
// Small graphs in the page: graph6, lists of pairs, the greatest relabelling and the label (docs/catalog.md, Labels).
const MOST_NODES = 16;

function toGraph6({ nodes, pairs }) {
  const present = new Set(pairs.map(([i, j]) => `${Math.min(i, j)},${Math.max(i, j)}`));
  let bits = "";
  for (let j = 1; j < nodes; j++) for (let i = 0; i < j; i++) bits += present.has(`${i},${j}`) ? "1" : "0";
  bits = bits.padEnd(6 * Math.ceil(bits.length / 6), "0");
  const sixes = nodes <= 62 ? [nodes] : [63, nodes >> 12, (nodes >> 6) & 63, nodes & 63];
  return String.fromCharCode(...sixes.map((six) => six + 63)) + (bits.match(/.{6}/g) ?? []).map((six) => String.fromCharCode(parseInt(six, 2) + 63)).join("");
}

// The pairs that `verify convert` writes: a comment with the name of each node, pairs, and nodes without any.
function ofConverted(lines) {
  const names = [], pairs = [];
  let nodes = 0;
  for (const line of lines.split("\n").filter(Boolean)) {
    const [, node, name] = /^# (\d+) (.*)$/.exec(line) ?? [];
    if (node) names[node] = name;
    if (line.startsWith("#")) continue;
    const ends = line.split(" ").map(Number);
    nodes = Math.max(nodes, ...ends.map((end) => end + 1));
    if (ends.length === 2) pairs.push(ends);
  }
  return { nodes, pairs, names: names.length ? names : null };
}

function neighbours({ nodes, pairs }) {
  const near = Array(nodes).fill(0);
  for (const [i, j] of pairs) { near[i] |= 1 << j; near[j] |= 1 << i; }
  return near;
}

// The relabelling with the greatest line of graph6: all orders that are the greatest so far go on.
function greatest(graph) {
  const { nodes } = graph, near = neighbours(graph), pairs = [];
  const twins = near.map((mine, v) => near.reduce((all, other, u) => (u < v && (mine & ~(1 << u)) === (other & ~(1 << v)) ? all | (1 << u) : all), 0));
  let orders = [[]];
  for (let column = 0; column < nodes; column++) {
    let best = 0, next = [];
    for (const order of orders) {
      const placed = order.reduce((all, v) => all | (1 << v), 0);
      for (let v = 0; v < nodes; v++) {
        if ((placed >> v) & 1 || twins[v] & ~placed) continue;
        const seen = order.reduce((all, u) => (all << 1) | ((near[v] >> u) & 1), 0);
        if (seen > best) { best = seen; next = []; }
        if (seen === best) next.push([...order, v]);
      }
    }
    for (let i = 0; i < column; i++) if ((best >> (column - 1 - i)) & 1) pairs.push([i, column]);
    orders = next;
  }
  // Each order that is left is an automorphism away from the others; of twins one order was tried.
  const automorphisms = twins.reduce((all, smaller) => all * (1 + smaller.toString(2).replaceAll("0", "").length), orders.length);
  return { nodes, pairs, automorphisms };
}

function binomial(all, size) {
  let found = size <= all ? 1n : 0n;
  for (let k = 1n; k <= BigInt(size); k++) found = (found * (BigInt(all) + 1n - k)) / k;
  return found;
}

function labelOf(graph) {
  if (graph.nodes > MOST_NODES) return null;
  const best = greatest(graph);
  const present = new Set(best.pairs.map(String));
  let left = best.pairs.length, k = 1n, free = (best.nodes * (best.nodes - 1)) / 2;
  for (let j = 1; j < best.nodes; j++) for (let i = 0; i < j; i++) {
    free--;
    if (present.has(`${i},${j}`)) left--;
    else if (left > 0) k += binomial(free, left - 1);
  }
  return `vg.${best.nodes}.${best.pairs.length}.${k}`;
}

function ofLabel(label) {
  const parts = /^vg\.(0|[1-9]\d?)\.(0|[1-9]\d{0,2})\.([1-9]\d{0,39})$/.exec(label);
  if (!parts || +parts[1] > MOST_NODES) throw new Error("a label is vg., the numbers of nodes (up to 16) and of pairs, and k, as in vg.5.6.55");
  const nodes = +parts[1], pairs = [];
  let left = +parts[2], k = BigInt(parts[3]) - 1n, free = (nodes * (nodes - 1)) / 2;
  if (k >= binomial(free, left)) throw new Error("no graph has this label: k is too large");
  for (let j = 1; j < nodes; j++) for (let i = 0; i < j; i++) {
    free--;
    const greater = left > 0 ? binomial(free, left - 1) : 0n;
    if (k < greater) { pairs.push([i, j]); left--; } else k -= greater;
  }
  const found = labelOf({ nodes, pairs });
  if (found !== label) throw new Error(`no graph has this label: k is the place of a line of ${found} that is not its greatest`);
  return { nodes, pairs };
}

// The length of a shortest cycle: a shortest way between the ends of a pair without it, and the pair; 0 if there is none.
function girthOf(graph) {
  let girth = 0;
  for (const [i, j] of graph.pairs) {
    const near = neighbours({ nodes: graph.nodes, pairs: graph.pairs.filter(([a, b]) => a !== i || b !== j) });
    let reached = 1 << i, length = 1;
    for (;;) {
      const next = near.reduce((all, mine, v) => ((reached >> v) & 1 ? all | mine : all), reached);
      if (next === reached) break;
      reached = next;
      if ((reached >> j) & 1) { girth = girth ? Math.min(girth, length + 1) : length + 1; break; }
      length++;
    }
  }
  return girth;
}

if (typeof module !== "undefined") module.exports = { ofConverted, toGraph6, greatest, girthOf, labelOf, ofLabel };
