"""Tests of viewcert-proved: python3 tests.py PROGRAM [--catalog PROVE] [--mutants N] [--seed S].

By hand: small graphs, hostile files. --catalog: every published graph, proofs written by the example
`prove`; ranks are those of the published certificates. Mutants of proofs and graphs: what is accepted
is true by the rank of J at random cameras modulo a prime, computed here from (1.1) and (1.2) alone."""

import argparse
import gzip
import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).parent
P = 2**31 - 1


def det(rows):
    """The determinant of a small matrix modulo P, by the first row."""
    if len(rows) == 1:
        return rows[0][0]
    minor = lambda k: [row[:k] + row[k + 1 :] for row in rows[1:]]
    return sum((-1) ** k * x * det(minor(k)) for k, x in enumerate(rows[0])) % P


def rank(rows):
    """The rank of a matrix modulo P."""
    found = 0
    rows = [list(row) for row in rows]
    while rows:
        row = rows.pop()
        at = next((k for k, x in enumerate(row) if x % P), None)
        if at is None:
            continue
        found += 1
        scale = pow(row[at], -1, P)
        for other in rows:
            if other[at] % P:
                times = other[at] * scale
                for k, x in enumerate(row):
                    other[k] = (other[k] - times * x) % P
    return found


def generic_rank(n, pairs, draw):
    """The rank of J at cameras with random entries."""
    cameras = [[[draw.randrange(P) for _ in range(4)] for _ in range(3)] for _ in range(n)]
    rows = []
    for i, j in pairs:
        a, b = cameras[i], cameras[j]
        f = [
            [(-1) ** (h + k) * det(a[:k] + a[k + 1 :] + b[:h] + b[h + 1 :]) for k in range(3)]
            for h in range(3)
        ]
        left_i = [[sum(b[r][c] * f[r][h] for r in range(3)) for h in range(3)] for c in range(4)]
        left_j = [[sum(a[r][c] * f[h][r] for r in range(3)) for h in range(3)] for c in range(4)]
        for c in range(4):
            for d in range(c, 4):
                row = [0] * (12 * n)
                for v, left in ((i, left_i), (j, left_j)):
                    for h in range(3):
                        row[12 * v + 4 * h + d] += left[c][h]
                        row[12 * v + 4 * h + c] += left[d][h]
                rows.append([x % P for x in row])
    return rank(rows)


class Program:
    def __init__(self, path):
        self.path = path
        self.folder = tempfile.TemporaryDirectory()
        self.place = pathlib.Path(self.folder.name)

    def list(self, path):
        run = subprocess.run([self.path, "--list", path], capture_output=True, text=True)
        return run.returncode, run.stdout, run.stderr

    def run(self, graph, proof):
        files = self.place / "graph.txt", self.place / "proof.txt"
        for file, text in zip(files, (graph, proof)):
            file.write_bytes(text if isinstance(text, bytes) else text.encode())
        run = subprocess.run([self.path, *files], capture_output=True, timeout=60)
        return run.returncode, run.stdout.decode(errors="replace"), run.stderr.decode(errors="replace")


def bounds(text):
    """What a printed theorem says: lower and upper bound, None where it says nothing."""
    exact = re.search(r"generic rank of J is (\d+)", text)
    if exact:
        return int(exact[1]), int(exact[1])
    low, high = re.search(r"have rank (\d+) at least", text), re.search(r"is at most (\d+)", text)
    return low and int(low[1]), high and int(high[1])


def text_of(pairs):
    return "".join(f"{i} {j}\n" for i, j in pairs)


TRIANGLE = [(0, 1), (0, 2), (1, 2)]
TRIANGLE_PROOF = "viewcert proof 1\ngraph 3 3\nclaim 18 18\nbody 3 0 0\nfree 0\none 1 0 0\ntwo 2 0 0 1 0\nend\n"
CYCLE = [(0, 1), (0, 3), (1, 2), (2, 3)]
CYCLE_PROOF = """viewcert proof 1
graph 4 4
claim 28 28
body 4 4 4
0 1 2 3
1 10 22 37
2 600 7 8000
3 123 456 789
0 1 1023 0
0 3 1023 0
1 2 1023 0
2 3 1023 0
end
"""
# Two triangles that share node 0, and a pair: bodies, and a last one that is not rigid.
BOW = [(0, 1), (0, 2), (0, 3), (0, 4), (1, 2), (3, 4), (4, 5)]
BOW_PROOF = """viewcert proof 1
graph 6 7
claim 43 43
body 3 0 0
free 0
one 1 0 0
two 2 0 0 1 0
body 3 0 0
free 0
one 3 0 0
two 4 0 0 3 0
body 6 0 0
free 0
one 1 0 1
two 2 0 1 1 1
one 3 0 2
two 4 0 2 3 2
one 5 4 0
block 3 0 1 2
block 3 0 3 4
end
"""

# Two triangles that share a pair, and one more pair: 18 + 18 - 7 + 7.
KITE = [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3), (3, 4)]
KITE_PROOF = """viewcert proof 1
graph 5 6
claim 0 36
block 3 0 1 2
other 3 1 2 3
shared 2 0 0
free 1
one 2 1 0
end
"""


def by_hand(program):
    def case(name, code, graph, proof, says=""):
        got, out, err = program.run(graph, proof)
        assert got == code and says in out + err, (name, got, out, err)
        assert (code == 0) == ("VERIFIED" in out), (name, out)

    # what is trusted stands in the README as it is
    assert (HERE / "program" / "graph.ml").read_text() in (HERE / "README.md").read_text()
    t, c = text_of(TRIANGLE), text_of(CYCLE)
    case("triangle", 0, t, TRIANGLE_PROOF, "the generic rank of J is 18 = 11 n - 15: full rank")
    case("4-cycle", 0, c, CYCLE_PROOF, "the generic rank of J is 28")
    case("bow", 0, text_of(BOW), BOW_PROOF, "the generic rank of J is 43")
    refuted = "viewcert proof 1\ngraph 4 4\nclaim 0 28\nend\n"
    case("names in comments", 0, "# 0 left.jpg\n#\n" + t + "# 3 4\n", TRIANGLE_PROOF)
    case("upper bound alone", 0, c, refuted, "not of full rank")
    # every condition, broken
    case("more than is shown", 1, t, TRIANGLE_PROOF.replace("claim 18", "claim 19"))
    case("upper too small", 1, c, refuted.replace("28", "27"))
    case("no body", 1, t, "viewcert proof 1\ngraph 3 3\nclaim 18 18\nend\n")
    case("one and the same", 1, t, TRIANGLE_PROOF.replace("two 2 0 0 1 0", "two 2 0 0 0 0"))
    case("no pair", 2, c, CYCLE_PROOF.replace("0 3 1023 0", "0 2 1023 0"), "0 2 is no pair")
    case("equal centres", 1, c, CYCLE_PROOF.replace("1 10 22 37", "1 1 2 3"))
    case("rows left out", 1, c, CYCLE_PROOF.replace("0 1 1023 0", "0 1 1 0"))
    case("a body that is not rigid", 1, text_of(BOW), BOW_PROOF.replace("two 2 0 0 1 0", "one 2 0 0", 1))
    case("a node twice", 1, text_of(BOW), BOW_PROOF.replace("one 5 4 0", "one 3 4 0"))
    case("a body that comes later", 2, text_of(BOW), BOW_PROOF.replace("one 1 0 0", "one 1 0 3", 1))
    case("a block with one node", 1, text_of(BOW), BOW_PROOF.replace("block 3 0 1 2", "block 1 0"))
    kite = text_of(KITE)
    case("overlap", 0, kite, KITE_PROOF, "is at most 36")
    # the pair that is shared is not in this graph, whose rank is 35
    open_kite, open_proof = text_of([e for e in KITE if e != (1, 2)]), KITE_PROOF.replace("5 6", "5 5")
    case("added pair", 0, open_kite, open_proof, "is at most 36")
    case("overlap, less", 1, kite, KITE_PROOF.replace("0 36", "0 35"))
    case("overlap, less", 1, open_kite, open_proof.replace("0 36", "0 35"))
    outside = "shared 3 0 0\nfree 1\none 2 1 0\none {} 2 0\nend"
    for v in (0, 3):
        shared = KITE_PROOF[: KITE_PROOF.index("shared")] + outside.format(v) + "\n"
        case("a pair in one list of blocks alone", 2, kite, shared, "are not both in a block and in one of the others")
    case("shared, by a body", 2, kite, KITE_PROOF.replace("one 2 1 0", "one 2 1 1"))
    case("shared, two times", 2, kite, KITE_PROOF.replace("end", "shared 0 0 0\nend"))
    case("nothing shared", 2, kite, KITE_PROOF[: KITE_PROOF.index("shared")] + "end\n")
    case("shared without others", 2, kite, KITE_PROOF.replace("other", "block"))
    case("blocks behind the others", 2, kite, KITE_PROOF.replace("shared", "block 2 0 1\nshared", 1))
    case("an other block with one node", 1, kite, KITE_PROOF.replace("other 3", "other 1 0\nother 3"))
    case("a shared node twice", 1, kite, KITE_PROOF.replace("one 2 1 0", "two 2 1 0 1 0"))
    # graphs that are none
    for name, graph in {
        "loop": "0 0\n0 1\n", "turned": "1 0\n", "twice": "0 1\n0 1\n", "gap": "0 2\n", "empty": "", "one node": "0\n",
        "leading zero": "0 01\n", "sign": "0 -1\n", "plus": "0 +1\n", "hex": "0 0x1\n", "underscore": "0 1_0\n",
        "three": "0 1 2\n", "comma": "0,1\n", "blank line": "0 1\n\n0 2\n", "no line end": "0 1", "tab": "0\t1\n",
        "return": "0 1\r\n", "two blanks": "0  1\n", "large": "0 1073741825\n", "huge": "0 " + "9" * 40 + "\n",
        "wraps": f"0 {2**64 + 1}\n", "comment": "# 0 1\n",
        "comment behind a pair": "0 1 # 2\n", "comment without end": t + "# 3", "blank before a comment": " # 3\n" + t,
        "nul": "0 1\0\n", "letters": "a b\n",
    }.items():  # fmt: skip
        case(name, 2, graph, TRIANGLE_PROOF)
    for name, proof in {
        "empty": "", "garbage": "\0\1\2", "another graph": TRIANGLE_PROOF.replace("graph 3 3", "graph 3 2"),
        "10^9 nodes": TRIANGLE_PROOF.replace("body 3", "body 1000000000"), "truncated": TRIANGLE_PROOF[:60],
        "10^9 rows": TRIANGLE_PROOF.replace("body 3 0 0", "body 3 0 1000000000"),
        "10^9 in a block": TRIANGLE_PROOF.replace("end", "block 1000000000 0 end"),
        "negative": TRIANGLE_PROOF.replace("two 2 0 0", "two 2 -1 0"), "trailing": TRIANGLE_PROOF + "x\n",
        "2^63": TRIANGLE_PROOF.replace("claim 18", f"claim {2**63}"), "version": TRIANGLE_PROOF.replace("proof 1", "proof 2"),
    }.items():  # fmt: skip
        case(name, 2, t, proof)
    path = text_of((v, v + 1) for v in range(10**6))
    case("10^6 pairs", 1, path, f"viewcert proof 1\ngraph {10**6 + 1} {10**6}\nclaim 0 {7 * 10**6 - 1}\nend\n")
    case("10^6 pairs", 0, path, f"viewcert proof 1\ngraph {10**6 + 1} {10**6}\nclaim 0 {7 * 10**6}\nend\n")
    assert subprocess.run([program.path, "none", "none"], capture_output=True).returncode == 2
    # a list: one verdict per graph, the worst exit code
    (program.place / "g").write_text(t)
    (program.place / "p").write_text(TRIANGLE_PROOF)
    (program.place / "q").write_text(TRIANGLE_PROOF.replace("claim 18", "claim 19"))
    (program.place / "list").write_text("".join(f"{program.place}/g {program.place}/{p}\n" for p in "pqp"))
    code, out, _ = program.list(program.place / "list")
    assert code == 1 and out.count("VERIFIED") == 2 and out.count("REJECTED") == 1, out


def catalog(program, prove, required):
    """All published graphs but those whose refutation needs a hub; returns their proofs."""
    folder = program.place / "catalog"
    folder.mkdir()
    ranks = []
    lines = []
    for file in sorted((HERE.parent / "certificates").glob("n*.jsonl.gz")):
        for line in gzip.open(file, "rt"):
            document = json.loads(line)
            lines.append(document["graph"]["graph6"])
            ranks.append((document["graph"]["nodes"], document["claim"]["rank"]["value"]))
    done = subprocess.run([prove, folder], input="\n".join(lines) + "\n", capture_output=True, text=True, check=True)
    refused = done.stdout.count("by a hub")
    assert refused == len(done.stdout.splitlines()) == 10, done.stdout
    start = time.time()
    code, out, err = program.list(folder / "list")
    seconds = time.time() - start
    assert code == 0, (code, err)
    seen = 0
    for verdict in out.split(str(folder) + "/")[1:]:
        number = int(verdict.split(".")[0])
        n, value = ranks[number]
        assert "VERIFIED" in verdict and f"generic rank of J is {value}" in verdict, verdict
        assert ("full rank\n" in verdict and "not of" not in verdict) == (value == 11 * n - 15), verdict
        seen += 1
    assert seen == len(ranks) - refused == required, seen
    print(f"catalog: {seen} graphs, rank and verdict, {seconds:.1f} s")
    return [(folder / f"{k}.txt", folder / f"{k}.proof") for k in range(400)]


def mutants(program, base, count, draw):
    """Changed files: never a crash, and what is accepted is true."""
    accepted = {0: 0, 1: 0, 2: 0}
    for _ in range(count):
        graph, proof = draw.choice(base)
        if draw.random() < 0.2:
            graph = mutate(graph, draw)
        if draw.random() < 0.9:
            proof = mutate(proof, draw)
        code, out, err = program.run(graph, proof)
        assert code in accepted and "exception" not in err.lower(), (code, out, err, graph, proof)
        accepted[code] += 1
        if code == 0:
            pairs = [tuple(map(int, line.split())) for line in graph.splitlines()]
            n = 1 + max(max(pair) for pair in pairs)
            true = generic_rank(n, [pair for pair in pairs if len(pair) == 2], draw)
            low, high = bounds(out)
            assert (low or 0) <= true and (high is None or true <= high), (graph, proof, out, true)
    print(f"{count} mutants: {accepted[0]} accepted and true, {accepted[1]} rejected, {accepted[2]} unreadable")
    assert accepted[0] and accepted[1] and accepted[2]


def mutate(text, draw):
    words = re.split(r"(\s)", text)
    numbers = [k for k, word in enumerate(words) if word.isdigit()]
    for _ in range(draw.randrange(1, 4)):
        kind = draw.randrange(5)
        if kind < 3 and numbers:
            k = draw.choice(numbers)
            words[k] = str(draw.choice([0, 1, 2, 3, 65520, 65521, 2**30, max(0, int(words[k] or 0) + draw.choice([-1, 1]))]))
        elif kind == 3:
            lines = "".join(words).splitlines(keepends=True)
            k = draw.randrange(len(lines))
            lines[k : k + 1] = draw.choice([[], [lines[k]] * 2])
            return "".join(lines)
        else:
            whole = "".join(words)
            k = draw.randrange(len(whole))
            return whole[:k] + chr(draw.randrange(128)) + whole[k + draw.randrange(2) :]
    return "".join(words)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--catalog", metavar="PROVE")
    parser.add_argument("--mutants", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    draw = random.Random(asked.seed)
    assert [generic_rank(n, g, draw) for n, g in ((3, TRIANGLE), (4, CYCLE), (6, BOW))] == [18, 28, 43]
    program = Program(asked.program)
    by_hand(program)
    base = [(text_of(TRIANGLE), TRIANGLE_PROOF), (text_of(CYCLE), CYCLE_PROOF), (text_of(BOW), BOW_PROOF)]
    base.append((text_of(KITE), KITE_PROOF))
    if asked.catalog:
        files = catalog(program, asked.catalog, 6515)
        base += [(g.read_text(), p.read_text()) for g, p in files if g.exists()]
    mutants(program, base, asked.mutants, draw)


if __name__ == "__main__":
    sys.exit(main())
