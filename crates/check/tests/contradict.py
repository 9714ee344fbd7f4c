#!/usr/bin/env python3
"""Writes a certificate of contradictions of a COLMAP database, for tests of the checkers: docs/contradictions.md.

    contradict.py DATABASE              the certificate
    contradict.py --made [--check]      contradictions/: the rows of a database with each kind of pair, and its certificate
    contradict.py --mutants N --seed S --checker verify [DATABASE ..]
                                        mutants of that, and of these databases: both checkers agree, and accept what is true

Plain floating point and greedy packings find it. What the checkers accept does not rest on that."""

import json
import math
import os
import random
import sqlite3
import struct
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "second"))

import check  # noqa: E402
from notation import Reject  # noqa: E402
from contradictions import TABLES, ContradictionsCheck, conj, cross, dot, essential, in_front, times, turn  # noqa: E402


def unit(v):
    length = math.sqrt(dot(v, v))
    return [x / length for x in v]


def rounded(v, bits=30):
    return [round(x * 2**bits) for x in unit(v)]


def quaternion(rows):
    """Of a rotation, by the largest of its four numbers."""
    (a, b, c), (d, e, f), (g, h, i) = rows
    every = [
        (1 + a + e + i, h - f, c - g, d - b), (h - f, 1 + a - e - i, b + d, c + g),
        (c - g, b + d, 1 - a + e - i, f + h), (d - b, c + g, f + h, 1 - a - e + i),
    ]
    return max(every, key=lambda q: dot(q, q))


def motions(e):
    """The four of an essential matrix, with integers."""
    rows = [unit_row for unit_row in (e[0:3], e[3:6], e[6:9])]
    scale = math.sqrt(2 / dot(e, e))
    rows = [[x * scale for x in row] for row in rows]
    columns = list(zip(*rows))
    t = unit(max((cross(columns[i], columns[j]) for i, j in ((0, 1), (0, 2), (1, 2))), key=lambda v: dot(v, v)))
    cofactors = [cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])]
    turned = list(zip(*(cross(t, column) for column in columns)))
    for sign in (1, -1):
        q = rounded(quaternion([[x - sign * y for x, y in zip(*two)] for two in zip(cofactors, turned)]))
        for back in (1, -1):
            yield q, rounded([back * x for x in t])


class Source:
    """The pairs of a database, and its cycles."""

    def __init__(self, path):
        self.check = check = ContradictionsCheck.__new__(ContradictionsCheck)
        check.read_database(path)
        images = check.tables["images"]
        self.names = [row["name"] for row in images.values()]
        at = {number: k for k, number in enumerate(images)}
        self.pairs, self.excluded, self.inliers = [], [], []
        for number, row in check.tables["two_view_geometries"].items():
            ends = divmod(number, 2147483647)
            found = check.measured(row, ends)
            if found is None:
                continue
            e, inliers, q, t = found
            if e is None:
                best, listed = (rounded(q), t and rounded(t)), True
            else:
                every = list(motions([x / max(map(abs, e)) for x in e]))
                front = [motion for motion in every if in_front(*motion, inliers)]
                best, listed = (front or every)[0], bool(front)
            pair = {"ends": [at[end] for end in ends], "configuration": row["config"], "q": best[0], "t": best[1]}
            (self.pairs if listed else self.excluded).append(pair)
            self.inliers += [row["rows"]] * listed

    def document(self, packings, upper):
        return {
            "format": "viewcert certificate", "version": 3, "question": "contradictions", "program": "contradict.py",
            "database": self.check.hash_of_database(), "images": self.names, "pairs": self.pairs, "excluded": self.excluded,
            "packings": packings, "upper": upper,
        }

    def cycles(self, longest):
        """Walks over three or four pairs, from each image that is the least of them."""
        beside = {}
        for k, pair in enumerate(self.pairs):
            i, j = pair["ends"]
            beside.setdefault(i, []).append((j, [k, 1]))
            beside.setdefault(j, []).append((i, [k, -1]))
        for first in sorted(beside):
            stack = [(first, [first], [])]
            while stack:
                at, seen, walk = stack.pop()
                for to, step in beside[at]:
                    if to == first and len(walk) >= 2 and walk[0][0] < step[0]:
                        yield [*walk, step]
                    elif to > first and to not in seen and len(walk) + 1 < longest:
                        stack.append((to, [*seen, to], [*walk, step]))

    def turns(self, walk):
        return [self.pairs[k]["q"] if sense == 1 else conj(self.pairs[k]["q"]) for k, sense in walk]

    def angle(self, walk):
        whole = [1.0, 0.0, 0.0, 0.0]
        for q in self.turns(walk):
            whole = times(unit(q), whole)
        return 2 * math.degrees(math.acos(min(1, abs(whole[0]))))

    def witness(self, walk, theta, phi):
        """A vector that all directions are near enough, or none."""
        every, last = [], len(walk) - 1
        for m, (k, sense) in enumerate(walk):
            q, t = self.pairs[k]["q"], self.pairs[k]["t"]
            if t is None:
                return None
            early = m <= last - m
            v = turn(conj(unit(q)), t) if early == (sense == 1) else t
            steps = [unit(q) for q in self.turns(walk[:m] if early else walk[m + 1 :])]
            for q in reversed(steps) if early else steps:
                v = turn(conj(q) if early else q, v)
            every.append((unit([-sense * x for x in v]), math.radians(90 - phi - min(m, last - m) * theta)))
        w = unit([sum(v[k] for v, _ in every) for k in range(3)])
        return rounded(w, 20) if all(dot(w, v) > math.cos(a) + 1e-3 for v, a in every) else None

    def packing(self, theta, phi=None, assumed=(), denominator=1, longest=4, within=None):
        """Greedy: the cycles that turn most first, each as often as there is room."""
        found = []
        for walk in self.cycles(longest):
            if len(walk) * theta < 179 and not {k for k, _ in walk} <= set(assumed):
                excess = (self.angle(walk) - math.ceil(sum(within if within and k in assumed else 1000 * theta for k, _ in walk) / 1000)) / len(walk)
                if excess > 0.01:
                    found.append((-len(walk) * len(assumed), excess, walk, None))
                elif phi is not None and (witness := self.witness(walk, theta, phi)):
                    found.append((-99, excess, walk, witness))
        room = {k: denominator for k in range(len(self.pairs)) if k not in assumed}
        weights = {}
        for _ in range(denominator):
            for at, (*_, walk, _) in sorted(enumerate(found), key=lambda one: one[1][:2], reverse=True):
                if all(room.get(k, 1) for k, _ in walk):
                    weights[at] = weights.get(at, 0) + 1
                    room.update({k: room[k] - 1 for k, _ in walk if k in room})
        cycles = [{"walk": found[at][2], "weight": weight, "witness": found[at][3]} for at, weight in weights.items()]
        witnessed = any(cycle["witness"] for cycle in cycles)
        return {
            "theta": theta, "phi": phi if witnessed else None, "assumed": sorted(assumed), "assumed_within": within or 1000 * theta, "denominator": denominator,
            "cycles": cycles, "at_least": -(-sum(weights.values()) // denominator),
        }

    def upper(self, theta):
        """Rotations along the trees of most inliers."""
        p = {}
        order = sorted(range(len(self.pairs)), key=lambda k: -self.inliers[k])
        for root in range(len(self.names)):
            p.setdefault(root, [1.0, 0.0, 0.0, 0.0])
            while True:
                for k in order:
                    (i, j), q = self.pairs[k]["ends"], unit(self.pairs[k]["q"])
                    if (i in p) != (j in p):
                        p.update({j: times(q, p[i])} if i in p else {i: times(conj(q), p[j])})
                        break
                else:
                    break
        p = [rounded(p[image]) for image in range(len(self.names))]
        off = 0
        for pair in self.pairs:
            i, j = pair["ends"]
            rest = unit(times(conj(p[j]), times(pair["q"], p[i])))
            off += 2 * math.degrees(math.acos(min(1, abs(rest[0])))) > theta
        return {"theta": theta, "rotations": p, "at_most": off}

    def neighbours(self):
        """Pairs of images that follow each other by name."""
        rank = {name: k for k, name in enumerate(sorted(self.names))}
        near = lambda pair: abs(rank[self.names[pair["ends"][0]]] - rank[self.names[pair["ends"][1]]]) == 1  # noqa: E731
        return [k for k, pair in enumerate(self.pairs) if near(pair)]


def certificate(path):
    source = Source(path)
    packings = [
        source.packing(10), source.packing(5, denominator=2), source.packing(5, 15),
        source.packing(10, 20, source.neighbours(), longest=3),
    ]
    return source.document(packings, [source.upper(10), source.upper(5)])


# A database with each kind of pair ------------------------------------------------------------------------------------

HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "contradictions")
QUARTER = (5, 2, 0, 0)  # a turn by 44 degrees
# Two images, and what is special: the configuration, a wrong turn, a reversed vector, how many inliers and how many behind.
PAIRS = [
    (1, 2, {}), (2, 3, {}), (1, 3, {"config": 3, "wrong": QUARTER}), (3, 4, {}), (2, 4, {}), (1, 4, {"wrong": (5, 0, 2, 1)}),
    (3, 5, {"reversed": True}), (4, 5, {"config": 3}), (1, 6, {}), (2, 6, {"tvec": False}), (1, 5, {"behind": 8}),
    (2, 5, {"config": 4}), (4, 6, {"rows": 14}), (1, 7, {}), (3, 6, {"config": 3}), (2, 7, {"config": 1, "rows": 0}),
]


def made_rows():
    """Rows of the four tables; blobs are in hexadecimal digits."""
    draw = random.Random(7)
    doubles = lambda numbers: struct.pack(f"<{len(numbers)}d", *numbers).hex()  # noqa: E731
    cameras = [[1, 1, 1, doubles((800, 810.5, 400, 300))], [2, 2, 1, doubles((800.25, 400, 300, 0.01))], [3, 0, 0, doubles((800, 400, 300))]]
    of = {6: 2, 7: 3}
    images = [[k, of.get(k, 1), f"{k}.jpg"] for k in range(1, 8)]
    turns = {k: (20, k, 3 - k, (k * k) % 5) for k in range(1, 8)}
    centres = {k: (10 * k, (k * 3) % 4, k % 2) for k in range(1, 8)}
    points, views = {k: [] for k in range(1, 8)}, []
    for i, j, special in PAIRS:
        q = times(turns[j], conj(turns[i]))
        q = times(special.get("wrong", (1, 0, 0, 0)), q)
        t = turn(turns[j], [a - b for a, b in zip(centres[i], centres[j])])
        t = [-x for x in t] if special.get("reversed") else t
        rows, data = special.get("rows", 16), b""
        for k in range(rows):
            while True:
                x = [draw.uniform(-20, 20), draw.uniform(-20, 20), draw.uniform(20, 60)]
                y = [a / dot(q, q) + b / dot(turns[j], turns[j]) for a, b in zip(turn(q, x), t)]
                if y[2] > 5:
                    break
            side = -1 if k < special.get("behind", 0) else 1  # a point behind has its ray in one image turned round
            pixels = ([800 * x[0] / x[2] + 400, 810.5 * x[1] / x[2] + 300], [800 * side * y[0] / y[2] + 400, 810.5 * side * y[1] / y[2] + 300])
            for end, pixel in zip((i, j), pixels):
                data += struct.pack("<I", len(points[end]))
                points[end].append(pixel)
        e, size = essential(q, t), math.sqrt(dot(q, q))
        tvec = [float(x) for x in t] if special.get("tvec", True) else [0.0, 0.0, 0.0]
        views.append([i * 2147483647 + j, rows, special.get("config", 2), data.hex(), doubles(e), doubles([x / size for x in q]), doubles(tvec)])
    keypoints = [[k, len(points[k]), 2, b"".join(struct.pack("<2f", *point) for point in points[k]).hex()] for k in points]
    return {"cameras": cameras, "images": images, "keypoints": keypoints, "two_view_geometries": sorted(views)}


def write_database(path, tables):
    """A database of such rows."""
    connection = sqlite3.connect(path)
    for table, rows in tables.items():
        columns = TABLES[table].split()
        connection.execute(f"create table {table} ({', '.join(columns)})")
        for row in rows:
            values = [bytes.fromhex(value) if type(value) is str and column != "name" else value for column, value in zip(columns, row)]
            connection.execute(f"insert into {table} values ({', '.join('?' * len(row))})", values)
    connection.commit()
    connection.close()


def made():
    """The rows, and their certificate."""
    tables = made_rows()
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "made.db")
        write_database(path, tables)
        source = Source(path)
    packings = [source.packing(10, denominator=2), source.packing(10, 20), source.packing(8, 20, source.neighbours(), longest=3), source.packing(30, None, source.neighbours(), within=500)]
    return tables, source.document(packings, [source.upper(10)])


# Mutants ---------------------------------------------------------------------------------------------------------------


class Mutants:
    """A document with one thing changed, or two: weights, walks, senses, numbers of motions, names, claims."""

    def __init__(self, document, draw):
        self.text, self.draw = json.dumps(document), draw

    def next(self):
        document, draw = json.loads(self.text), self.draw
        for _ in range(draw.choice((1, 1, 2))):
            self.change(document, draw)
        return document

    def change(self, document, draw):
        pair = draw.choice(document["pairs"] + document["excluded"])
        packing = draw.choice(document["packings"])
        cycle = draw.choice(packing["cycles"])
        step = draw.choice(cycle["walk"])
        numbers = draw.choice([pair["q"], pair["t"] or pair["q"], cycle["witness"] or pair["q"], draw.choice(draw.choice(document["upper"])["rotations"])])
        at, by = draw.randrange(len(numbers)), draw.choice((1, -1, 2**8, 2**14, 2**20, 2**26, -(2**29)))
        k, i = draw.randrange(len(document["pairs"])), draw.randrange(len(document["images"]))
        first = document["images"][0]
        draw.choice((
            lambda: numbers.__setitem__(at, numbers[at] + by),
            lambda: numbers.__setitem__(at, -numbers[at]),
            lambda: numbers.__setitem__(slice(None), [-x for x in numbers]),
            lambda: pair.update(t=pair["t"] and [-x for x in pair["t"]]),
            lambda: pair.update(ends=pair["ends"][::-1]),
            lambda: pair.update(ends=[pair["ends"][0], i]),
            lambda: pair.update(configuration=5 - pair["configuration"]),
            lambda: pair.update(t=None),
            lambda: packing["cycles"].append(json.loads(json.dumps(cycle))),
            lambda: packing["cycles"].remove(cycle) if len(packing["cycles"]) > 1 else None,
            lambda: cycle.update(weight=cycle["weight"] + draw.choice((1, -1))),
            lambda: cycle["walk"].remove(step) if len(cycle["walk"]) > 1 else None,
            lambda: cycle["walk"].append(list(step)),
            lambda: cycle.update(walk=[[k, -s] for k, s in reversed(cycle["walk"])]),
            lambda: cycle.update(walk=cycle["walk"][1:] + cycle["walk"][:1]),
            lambda: step.__setitem__(1, -step[1]),
            lambda: step.__setitem__(0, k),
            lambda: packing.update(assumed=sorted({*packing["assumed"], k})),
            lambda: packing.update(assumed=[one for one in packing["assumed"] if one != k]),
            lambda: packing.update(theta=packing["theta"] + draw.choice((1, -1, 5))),
            lambda: packing.update(assumed_within=packing["assumed_within"] + draw.choice((1000, -1000, -400))),
            lambda: packing.update(phi=packing["phi"] and packing["phi"] + draw.choice((1, -1, 5))),
            lambda: packing.update(denominator=packing["denominator"] + draw.choice((1, -1))),
            lambda: packing.update(at_least=packing["at_least"] + draw.choice((1, -1))),
            lambda: document["upper"][0].update(at_most=document["upper"][0]["at_most"] + draw.choice((1, -1))),
            lambda: document["pairs"].append(document["pairs"].pop(k)),
            lambda: document["excluded"].append(document["pairs"].pop(k)),
            lambda: document["images"].__setitem__(0, document["images"][i]) or document["images"].__setitem__(i, first),
            lambda: document["images"].__setitem__(i, "another.jpg"),
            lambda: document.update(database=document["database"][::-1]),
        ))()


def same_motions(one, other):
    """Whether two documents have the same pairs, by names, with quaternions and vectors that differ by what is rounded."""

    def of(document):
        names = document["images"]
        return {tuple(names[end] for end in pair["ends"]): pair for pair in document["pairs"]}

    mine, others = of(one), of(other)
    if mine.keys() != others.keys() or one["database"] != other["database"]:
        return False
    for ends, pair in mine.items():
        if pair["configuration"] != others[ends]["configuration"]:
            return False
        for a, b in ((pair["q"], others[ends]["q"]), (pair["t"], others[ends]["t"])):
            if a and b and min(math.dist(unit(a), unit(b)), math.dist(unit([-x for x in a]), unit(b)) if len(a) == 4 else 9) > 2**-15:
                return False
    return True


def true(document):
    """Whether what a document claims follows from its numbers, found otherwise: matrices and floating point."""

    def matrix(q):
        w, x, y, z = unit(q)
        return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]

    def after(a, b):
        return [[dot(row, column) for column in zip(*b)] for row in a]

    def angle(m):
        return math.degrees(math.acos(max(-1, min(1, (m[0][0] + m[1][1] + m[2][2] - 1) / 2))))

    moves = [(pair["ends"], matrix(pair["q"]), pair["t"]) for pair in document["pairs"]]
    flipped = lambda m: [list(column) for column in zip(*m)]  # noqa: E731
    for packing in document["packings"]:
        theta, phi, loads, total = packing["theta"], packing["phi"], {}, 0
        for cycle in packing["cycles"]:
            frame, at, into, ends = [[1, 0, 0], [0, 1, 0], [0, 0, 1]], None, [], cycle["walk"]
            start = moves[ends[0][0]][0][0 if ends[0][1] == 1 else 1]
            at, frames = start, [frame]
            for k, sense in ends:
                (i, j), r, t = moves[k]
                if at != (i if sense == 1 else j):
                    return False
                at, frame = (j, after(r, frame)) if sense == 1 else (i, after(flipped(r), frame))
                frames.append(frame)
                loads[k] = loads.get(k, 0) + cycle["weight"]
            if at != start or len({k for k, _ in ends}) < len(ends) or cycle["weight"] < 0:
                return False
            if all(k in packing["assumed"] for k, _ in ends):
                return False
            total += cycle["weight"]
            if cycle["witness"] is None:
                if angle(frame) <= math.ceil(sum(packing["assumed_within"] if k in packing["assumed"] else 1000 * theta for k, _ in ends) / 1000):
                    return False
                continue
            last = len(ends) - 1
            for m, (k, sense) in enumerate(ends):
                (_, _), r, t = moves[k]
                early = m <= last - m
                of_j = [-x for x in unit(t)]
                of_i = [dot(column, of_j) for column in zip(*r)]
                v = (of_i if sense == 1 else of_j) if early else (of_j if sense == 1 else of_i)
                # A frame m steps on is frames[m] of the first; on the way back the rest of the walk leads there.
                back = flipped(frames[m]) if early else after(frames[-1], flipped(frames[m + 1]))
                v = [sense * dot(row, v) for row in back]
                if math.degrees(math.acos(max(-1, min(1, dot(unit(cycle["witness"]), v))))) >= 90 - phi - min(m, last - m) * theta:
                    return False
        if packing["denominator"] < 1 or any(load > packing["denominator"] and k not in packing["assumed"] for k, load in loads.items()):
            return False
        if packing["at_least"] != math.ceil(total / packing["denominator"]):
            return False
    for upper in document["upper"]:
        p = [matrix(q) for q in upper["rotations"]]
        off = [angle(after(flipped(p[j]), after(r, p[i]))) > upper["theta"] for (i, j), r, _ in moves]
        if sum(off) != upper["at_most"]:
            return False
    return True


def accepted(document, path=None):
    try:
        check.check(document, database=path)
        return True
    except Reject:
        return False


def agree(count, seed, checker, databases):
    """Both checkers on mutants, alone and with the database."""
    draw, numbers = random.Random(seed), {"written": 0, "of the database": 0}
    with tempfile.TemporaryDirectory() as folder:
        path, file = os.path.join(folder, "made.db"), os.path.join(folder, "mutants.jsonl")
        tables, document = made()
        write_database(path, tables)
        sources = [(document, path), *((certificate(name), name) for name in databases)]
        for document, path in sources:
            mutants = Mutants(document, draw)
            every = [mutants.next() for _ in range(count // len(sources))]
            with open(file, "w", encoding="utf-8") as out:
                out.writelines(json.dumps(mutant) + "\n" for mutant in every)
            run = subprocess.run([checker, "check", file], capture_output=True, text=True)
            rejected = {int(line.split(":")[1]) for line in run.stdout.splitlines() if line.startswith("REJECTED")}
            for number, mutant in enumerate(every, 1):
                verdict = accepted(mutant)
                assert verdict == (number not in rejected), (mutant, run.stdout)
                if not verdict:
                    continue
                assert true(mutant), mutant
                numbers["written"] += 1
                one = os.path.join(folder, "one.json")
                with open(one, "w", encoding="utf-8") as out:
                    json.dump(mutant, out)
                bound = accepted(mutant, path)
                run = subprocess.run([checker, "check", one, path], capture_output=True, text=True)
                assert run.returncode == (0 if bound else 1), (mutant, run)
                assert not bound or same_motions(mutant, document), mutant
                numbers["of the database"] += bound
    print(f"{count} mutants: both checkers accept the same {numbers['written']} about what is written, {numbers['of the database']} of the database, and all are true")


def main():
    if sys.argv[1] == "--mutants":
        agree(int(sys.argv[2]), int(sys.argv[4]), sys.argv[6], sys.argv[7:])
        return 0
    if sys.argv[1] != "--made":
        json.dump(certificate(sys.argv[1]), sys.stdout, separators=(",", ":"))
        return 0
    same = True
    for name, value in zip(("rows.json", "certificate.json"), made()):
        text, path = json.dumps(value, separators=(",", ":")).replace("]],", "]],\n").replace("},", "},\n") + "\n", os.path.join(HERE, name)
        if "--check" in sys.argv:
            with open(path, encoding="utf-8") as file:
                same &= file.read() == text
        else:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
