#!/usr/bin/env python3
"""Writes the section of docs/certificate.md in which a certificate is checked by hand.

    by_hand.py            rewrites the section in place (nothing changes if it is as it should be)
    by_hand.py --check    changes nothing; exit code 1 if something would change

All numbers are computed here, from the formulas of the page and the tools of draw.py, and every
statement of the section about them is asserted before it is written.
"""
import os
import re
import sys
from itertools import combinations

from draw import Core, Echelon, Stream, bearings, camera_at, graph6, graph_hash, jacobian, null_space, pivots

P = 11
EDGES = [(0, 1), (0, 3), (1, 2), (2, 3)]
PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../docs/certificate.md")
ROWS, COLS = [0, 1, 4, 5, 6, 7, 2, 3], [1, 2, 4, 5, 7, 8, 0, 3]


def modulo(*entries):
    return [entry % P for entry in entries]


def outer(x, y):
    return [modulo(*(a * b for b in y)) for a in x]


def times(a, b):
    return [modulo(*(sum(x * y for x, y in zip(row, column)) for column in zip(*b))) for row in a]


class Example:
    """The draw with a seed; `fine` if the section can be written with it."""

    def __init__(self, core, graph, seed):
        stream = Stream(b"draw", graph, core.hash, seed, 0)
        self.seed, self.key = seed, stream.key
        # The words of which each low four bits become a value, or are left out.
        self.words, values = [], []
        while len(values) < 12:
            word = next(stream.words) & 15
            self.words.append(word)
            values += [word] if word < P else []
        self.centres = c = [values[3 * v:3 * v + 3] for v in range(4)]
        self.fine = len(set(map(tuple, c))) == 4
        self.fine = self.fine and all(c[i][0] != c[j][0] for i, j in EDGES) and self.eliminate(core) and self.move()

    def eliminate(self, core):
        self.n = bearings(core, self.centres, P)[0]
        echelon = Echelon(P)
        return all(echelon.push(self.n[row], column) is not None for row, column in zip(ROWS, COLS))

    def move(self):
        """w, z, X and lambda = -1 with P_2 X = (c_1 - c_2) w^T and P_3 X - P_3 = (c_0 - c_3) z^T."""
        c, cameras = self.centres, [camera_at(centre, P) for centre in self.centres]
        self.d12, self.d03 = (modulo(*(a - b for a, b in zip(c[i], c[j]))) for i, j in ((1, 2), (0, 3)))
        # Unknowns: X (16, row by row), w (4), z (4), lambda.
        system = []
        for camera, shift, place, scale in ((cameras[2], self.d12, 16, 0), (cameras[3], self.d03, 20, 1)):
            for r in range(3):
                for b in range(4):
                    row = [0] * 25
                    for a in range(4):
                        row[4 * a + b] = camera[r][a]
                    row[place + b] = -shift[r] % P
                    row[24] = scale * camera[r][b] % P
                    system.append(row)
        basis = null_space(system, 25, P)
        with_scale = [vector for vector in basis if vector[24]]
        if len(basis) != 1 or not with_scale:
            return False
        vector = with_scale[0]
        factor = -pow(vector[24], -1, P)
        vector = modulo(*(entry * factor for entry in vector))
        self.x = [vector[4 * a:4 * a + 4] for a in range(4)]
        self.w, self.z = vector[16:20], vector[20:24]
        self.dp2, self.dp3 = outer(self.d12, self.w), outer(self.d03, self.z)
        assert times(cameras[2], self.x) == self.dp2
        moved = times(cameras[3], self.x)
        assert [modulo(*(a - b for a, b in zip(*rows))) for rows in zip(moved, cameras[3])] == self.dp3
        zero = [[0] * 4] * 3
        self.motion = [d[r][column] for d in (zero, zero, self.dp2, self.dp3) for column in range(4) for r in range(3)]
        for row in jacobian(self.core, cameras):
            assert sum(a * b for a, b in zip(row, self.motion)) % P == 0
        self.marks = [[0, 0], self.w[:2], self.z[:2], self.x[3][:2]]
        return all(a != b for a, b in combinations(self.marks, 2))


def listed(numbers):
    return ", ".join(map(str, numbers))


def block(matrix):
    wide = [max(len(str(row[column])) for row in matrix) for column in range(4)]
    return ["[ " + "  ".join(str(entry).rjust(width) for entry, width in zip(row, wide)) + " ]" for row in matrix]


def section():
    nodes, edges = graph6("Cl")
    assert (nodes, edges) == (4, EDGES)
    graph = graph_hash(nodes, edges)
    core = Example.core = Core([(True, set(edge)) for edge in edges])
    # The first seed whose stream leaves out few words.
    found = (Example(core, graph, seed) for seed in range(100_000))
    e = next(one for one in found if one.fine and len(one.words) <= 14)

    c, n = e.centres, e.n
    d = [modulo(*(a - b for a, b in zip(c[i], c[j]))) for i, j in EDGES]
    table = "\n".join(
        f"| {row} | {EDGES[row // 2][0]}-{EDGES[row // 2][1]} | " + " | ".join(str(x) if x else "" for x in n[row]) + " |"
        for row in range(8)).replace("|  |", "| |").replace("|  |", "| |")

    # Elimination, in the words of the section.
    def less(row, steps):
        row, told = n[row], []
        for other, column in steps:
            factor = row[column] * pow(n[other][column], -1, P) % P
            told.append(factor)
            row = modulo(*(a - factor * b for a, b in zip(row, n[other])))
        assert all(row[column] == 0 for column in range(12) if column % 3)
        return told, [row[column] for column in (0, 3, 6, 9)]

    for row, columns in ((4, (1, 2)), (5, (1, 2)), (6, (1, 2, 4, 5)), (7, (1, 2, 4, 5))):
        assert all(n[row][column] == 0 for column in columns)
    assert n[0][2] == n[4][5] == n[6][8] == n[1][1] == n[5][4] == n[7][7] == 0
    assert n[0][1] == n[1][2] and n[4][4] == n[5][5] and n[6][7] == n[7][8]
    first, left = less(2, ((0, 1), (4, 4), (6, 7)))
    second, right = less(3, ((1, 2), (5, 5), (7, 8)))
    factor = right[0] * pow(left[0], -1, P) % P
    last = (right[1] - factor * left[1]) % P
    assert left[0] and last
    assert 4 * 8 + 0 - 4 == 28 == 4 * 7 < 29 == 11 * 4 - 15

    x, p2x, dp3 = block(e.x), block(e.dp2), block(e.dp3)
    assert times(camera_at(c[2], P), e.x)[0] == modulo(*(e.x[0][b] - c[2][0] * e.x[3][b] for b in range(4)))
    row = listed(f"{e.x[0][b]} - {c[2][0] * e.x[3][b]}" for b in range(4))
    vector = [f'"{entry}"' for entry in e.motion]
    blocks = ", ".join(map(lambda k: ",".join(vector[12 * k:12 * k + 12]), (0, 1))) + ",\n   "
    blocks += ", ".join(map(lambda k: ",".join(vector[12 * k:12 * k + 12]), (2, 3)))
    entry = e.d12[0] * e.w[0]
    return f'''## 10. A certificate checked by hand

The 4-cycle, with edges 0-1, 0-3, 1-2, 2-3 (graph6 `Cl`), modulo 11, so that every number can be followed with a pencil.

```json
{{"format": "viewcert certificate", "version": 3, "question": "generic", "program": "by hand",
 "graph": {{"name": "4-cycle", "nodes": 4, "edges": 4,
  "sha256": "{graph.hex()}", "graph6": "Cl"}},
 "model": "projective",
 "claim": {{
  "verdict": {{"value": "not-finite-solvable", "strength": "proof", "error_log2": null}},
  "rank": {{"value": 28, "required": 29, "strength": "proof", "error_log2": null}},
  "components": {{"value": 4, "strength": "proof", "error_log2": null}}}},
 "bodies": [],
 "rigid": {{"bodies": [], "edges": []}},
 "pieces": [{{"bodies": [], "edges": [[0,1],[0,3],[1,2],[2,3]], "evidence": [
  {{"kind": "plane-flow", "prime": "11", "seed": "{e.seed}", "draw": 0,
   "rows": [0,1,4,5,6,7,2,3], "cols": [1,2,4,5,7,8,0,3], "flows": 0, "lambda_rows": [], "lambda_cols": []}},
  {{"kind": "counting", "blocks": [
   {{"bodies": [], "edges": [[0,1]], "hubs": []}}, {{"bodies": [], "edges": [[0,3]], "hubs": []}},
   {{"bodies": [], "edges": [[1,2]], "hubs": []}}, {{"bodies": [], "edges": [[2,3]], "hubs": []}}], "bound": 28}},
  {{"kind": "classes", "classes": [
   {{"bodies": [], "edges": [[0,1]], "evidence": [], "split": null}},
   {{"bodies": [], "edges": [[0,3]], "evidence": [], "split": null}},
   {{"bodies": [], "edges": [[1,2]], "evidence": [], "split": null}},
   {{"bodies": [], "edges": [[2,3]], "evidence": [], "split": null}}]}},
  {{"kind": "kernel", "prime": "11", "seed": "{e.seed}", "draw": 0, "vector": [
   {blocks}]}}]}}]}}
```

*Structure.* There are no bodies, so all four edges are loose and form the one piece. The core is the 4-cycle itself: n' = 4,
m' = 4, and `required` is 11 * 4 - 15 = 29.

*Upper bound.* Four blocks of two nodes: 4 * (11 * 2 - 15) = 4 * 7 = 28.

*Centres.* The SHA-256 of the core is `{core.hash.hex()}`, and the key of draw 0 with seed
{e.seed} is `{e.key.hex()}`. The low four bits of the words of its stream
begin {listed(e.words)}. Those below 11 are the uniform values, three for each node:

    {"    ".join(f"c_{v} = ({listed(c[v])})" for v in range(4))}

*N.* The differences d of the edges are {listed(f"({listed(one)})" for one in d)}. All have d_0 != 0, so q = 0, r = 1, s = 2.
The two directions of an edge are (-d_1, d_0, 0) and (-d_2, 0, d_0). Blanks are zeros.

| row | edge | 0 | 1 | 2 | 3 | 4 | 5 | 6 | 7 | 8 | 9 | 10 | 11 |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
{table}

*Pivots.* Row 0 at column 1: {n[0][1]}. Row 1 at column 2: {n[1][2]}. Rows 4 and 5 have nothing in columns 1 and 2, and {n[4][4]} in columns 4 and 5. Rows 6
and 7 have nothing in these, and {n[6][7]} in columns 7 and 8. So far nothing had to be eliminated.

Subtract {first[0]} times row 0, {first[1]} times row 4 and {first[2]} times row 6 from row 2. It is zero in columns 1, 4 and 7 then, with {listed(left)} left in columns 0, 3,
6, 9. The pivot in column 0 is {left[0]}. Row 3 less {second[0]} times row 1, {second[1]} times row 5 and {second[2]} times row 7 leaves {listed(right)} in the same columns.
Less {factor} times what was left of row 2 it has {right[1]} - {factor} * {left[1]} = {last} in column 3, the last pivot. Hence a = 8.

*Lower bound.* f = 0, Lambda has no pivots, and 4 a + b - m' is 4 * 8 + 0 - 4 = 28, as is the upper bound.
So the rank is 28, as a proof. It is below 29: not finite solvable, as a proof.

*Motion.* The vector is dP_0 = dP_1 = 0, dP_2 = (c_1 - c_2) w^T and dP_3 = (c_0 - c_3) z^T.
Here w = ({listed(e.w)}) and z = ({listed(e.z)}). For example, its entry 24, entry (0, 0) of dP_2, is {e.d12[0]} * {e.w[0]} = {entry % P}. With C_v = (c_v, 1), for which P_u C_v = c_v - c_u:

* edge 0-1: X = 0, lambda = 0;
* edge 1-2: X = C_1 w^T, lambda = 0: P_1 C_1 = 0 and P_2 C_1 = c_1 - c_2;
* edge 0-3: X = C_0 z^T, lambda = 0, likewise;
* edge 2-3: lambda = -1 and

          {x[0]}
      X = {x[1]}
          {x[2]}
          {x[3]}

              {p2x[0]}                         {dp3[0]}
      P_2 X = {p2x[1]} = dP_2    P_3 X - P_3 = {dp3[1]} = dP_3
              {p2x[2]}                         {dp3[2]}

  The first row of P_2 X, for one, is the first row of X less {c[2][0]} times its last: ({row}).

*Components.* The first two entries of the last row of X are {listed(f"({listed(e.marks[k])})" for k in range(4))} on the edges 0-1, 1-2, 0-3, 2-3. Multiples of I do not
touch them, so the four X are different, and the four classes are separated. This is a proof: at this draw the lower bound equals the upper one.
Each class is a single edge, so there are four components.
'''


def main():
    with open(PAGE, encoding="utf-8") as file:
        page = file.read()
    before, rest = page.split("## 10. ", 1)
    after = re.search(r"\n## 11\. ", rest)
    text = before + section() + (rest[after.start():] if after else "")
    if sys.argv[1:] == ["--check"]:
        sys.exit("section 10 of docs/certificate.md is not what by_hand.py writes" if text != page else 0)
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
