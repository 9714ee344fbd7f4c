"use strict";
// Graphs in the page: graph6, and lists of pairs. All else about them the program says.

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
