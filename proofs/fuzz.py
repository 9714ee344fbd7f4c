"""Hostile files for viewcert-proved: python3 fuzz.py PROGRAM [--seconds S] [--seed N].

Bytes and words of graphs and proofs are changed, cut, repeated and swapped between files. Each run has to end by itself,
within seconds and 1 GB, with an exit code of its own; VERIFIED is only said with code 0, and of a claim that is true.
Ranks are computed as in tests.py, and so are components."""

import argparse
import random
import re
import resource
import subprocess
import sys
import time

from tests import BOW, BOW_APART, BOW_PROOF, CYCLE, CYCLE_PROOF, FLOW_PROOF, GAMMA, GAMMA_PROOF, KITE, KITE_PROOF, PAIRS_PROOF
from tests import DIAMOND, DIAMOND_PROOF, PENTAGON, SQUARE, TRIANGLE, TRIANGLE_PROOF
from tests import Program, bounds, components, generic_rank, listed, model_of, text_of

WORDS = b"viewcert proof 1 graph claim body block other shared components cut apart flows free one two model calibrated affine unique solvable end # \n \t\r\0 -1 +1 0x1 1e3 "
WORDS = WORDS.split(b" ") + [b"%d" % x for x in (0, 1, 2, 3, 11, 15, 65520, 65521, 10**9, 2**30, 2**30 + 1, 2**31, 2**62, 2**63, 10**30)]


def changed(data, other, draw):
    data = bytearray(data)
    for _ in range(draw.choice((1, 1, 1, 2, 3, 8))):
        at, to = sorted(draw.randrange(len(data) + 1) for _ in range(2))
        kind = draw.randrange(12)
        if kind == 0:
            data[at : at + 1] = bytes([draw.randrange(256)])
        elif kind == 1:
            del data[at : min(to, at + draw.choice((1, 4, 40)))]
        elif kind == 2:
            data[at:at] = data[at : min(to, at + 80)] * draw.choice((1, 2, 50))
        elif kind == 3:
            del data[at:]
        elif kind == 4:
            data[at:at] = b" " + draw.choice(WORDS) + b" "
        elif kind == 5:
            start = draw.randrange(len(other))
            data[at:to] = other[start : start + draw.randrange(200)]
        elif data:
            # a whole word for another one, mostly a number for a number
            words = re.split(rb"([ \n])", bytes(data))
            numbers = [k for k, word in enumerate(words) if word.isdigit()]
            if kind > 5 and numbers:
                words[draw.choice(numbers)] = b"%d" % draw.randrange(7)
            else:
                words[draw.randrange(len(words))] = draw.choice(WORDS)
            data = bytearray(b"".join(words))
    return bytes(data)


def limited():
    resource.setrlimit(resource.RLIMIT_AS, (2**30, 2**30))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--seed", type=int, default=time.time_ns())
    asked = parser.parse_args()
    draw = random.Random(asked.seed)
    program = Program(asked.program)
    files = [program.place / "graph", program.place / "proof"]
    kite = ((KITE, KITE_PROOF), (BOW, BOW_APART), (CYCLE, PAIRS_PROOF), (TRIANGLE, FLOW_PROOF), (GAMMA, GAMMA_PROOF), (DIAMOND, DIAMOND_PROOF))
    seeds = [(text_of(g).encode(), p.encode()) for g, p in ((TRIANGLE, TRIANGLE_PROOF), (CYCLE, CYCLE_PROOF), (BOW, BOW_PROOF), *kite)]
    seeds += [(g.encode(), p.encode()) for g, p in (PENTAGON, SQUARE)]
    codes = {0: 0, 1: 0, 2: 0, 3: 0}
    end = time.time() + asked.seconds
    while time.time() < end:
        (graph, proof), other = draw.choice(seeds), draw.choice(draw.choice(seeds))
        graph = changed(graph, other, draw) if draw.random() < 0.3 else graph
        proof = changed(proof, other, draw) if draw.random() < 0.9 else proof
        for file, data in zip(files, (graph, proof)):
            file.write_bytes(data)
        run = subprocess.run([program.path, *files], capture_output=True, timeout=20, preexec_fn=limited)
        out = run.stdout.decode(errors="replace")
        told = f"seed {asked.seed}: {run.returncode} {out} {run.stderr!r}\n{graph!r}\n{proof!r}"
        assert run.returncode in codes and b"exception" not in run.stderr, told
        assert (run.returncode == 0) == ("VERIFIED" in out), told
        codes[run.returncode] += 1
        if run.returncode == 0:
            rows = [line.split() for line in graph.decode().splitlines() if not line.startswith("#")]
            pairs = [(int(row[0]), int(row[1])) for row in rows if len(row) == 2]
            n = 1 + max(int(x) for row in rows for x in row)
            low, high = bounds(out)
            model = model_of(out)
            true = generic_rank(n, pairs, draw, model) if n < 10 else None
            assert true is None or ((low or 0) <= true and (high is None or true <= high)), told
            found = listed(out)
            assert found is None or n > 6 or found == components(n, pairs, draw, model), told
    print(f"{sum(codes.values())} hostile files: {codes[0]} accepted and true, {codes[1]} rejected, {codes[2]} unreadable, {codes[3]} too large")
    assert codes[0] and codes[1] and codes[2]


if __name__ == "__main__":
    sys.exit(main())
