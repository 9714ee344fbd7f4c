"""The rank that frames give (docs/certificate.md, section 13), by brute force: for the comparison of the checkers.

All centres, all starts of frames and all places of sensors are unknowns here, and what a frame says is an equation for
each image; rotations are products of reflections. Nothing of this is in the checkers.
"""

import itertools

PRIME = 2**61 - 1


def turned(rng):
    """A rotation modulo PRIME: two reflections, one after the other."""

    def reflection():
        v = [rng.randrange(1, PRIME) for _ in range(3)]
        unit = 2 * pow(sum(x * x for x in v), -1, PRIME)
        return [[(int(r == c) - unit * v[r] * v[c]) % PRIME for c in range(3)] for r in range(3)]

    a, b = reflection(), reflection()
    return [[sum(a[r][k] * b[k][c] for k in range(3)) % PRIME for c in range(3)] for r in range(3)]


def numbers(n, edges, groups, stated, rank_of, rng):
    """The rank and that which is required, for the frames and known sensors of `stated`."""
    frames, known = stated["frames"], set(stated["known"])
    sensors = sorted({k for images in frames for _, k in images})
    links = {k: {k} for k in sensors}
    for images in frames:
        joined = set().union(*(links[k] for _, k in images))
        links.update((k, joined) for k in joined)
    rigs = {frozenset(links[k]) for k in sensors}
    without = [rig for rig in rigs if not rig & known]
    width = 3 * (n + len(frames) + len(sensors))
    centre = [[rng.randrange(PRIME) for _ in range(3)] for _ in range(n)]
    place = {k: [rng.randrange(PRIME) for _ in range(3)] for k in sensors}
    rows = []

    def add(entries):
        row = [0] * width
        for column, value in entries:
            row[column] = (row[column] + value) % PRIME
        rows.append(row)

    for f, images in enumerate(frames):
        turn, start = turned(rng), [rng.randrange(PRIME) for _ in range(3)]
        for v, k in images:
            at = 3 * (n + len(frames) + sensors.index(k))
            centre[v] = [(start[c] + sum(turn[r][c] * place[k][r] for r in range(3))) % PRIME for c in range(3)]
            for c in range(3):
                add([(3 * v + c, 1), (3 * (n + f) + c, -1), *((at + r, -turn[r][c]) for r in range(3))])
    for k in known:
        for c in range(3):
            add([(3 * (n + len(frames) + sensors.index(k)) + c, 1)])
    for i, j in edges:
        x, y, z = (a - b for a, b in zip(centre[i], centre[j]))
        for line in ([0, -z, y], [z, 0, -x], [-y, x, 0]):
            add([(3 * v + c, sign * line[c]) for v, sign in ((i, 1), (j, -1)) for c in range(3)])
    for i, j in itertools.chain.from_iterable(itertools.combinations(group, 2) for group in groups):
        for c in range(3):
            add([(3 * i + c, 1), (3 * j + c, -1)])
    # Of a rig without a known place all places may move with the frames' starts, which changes nothing.
    kernel = width - rank_of(rows) - 3 * len(without)
    images = sum(map(len, frames))
    unknown = sum(k not in known for k in sensors) - len(without)
    unknowns = 3 * (n - images + len(frames) + unknown)
    scaled = bool(groups) or any(len(rig & known) >= 2 for rig in rigs)
    return unknowns - kernel, unknowns - 4 + scaled


def contradiction(claim, *what):
    """What is wrong with a claim, or None."""
    rank, required = numbers(*what)
    least, most = claim["at_least"], claim["at_most"]
    if claim["required"] != required:
        return f"with frames {required} is required, claimed is {claim['required']}"
    if not least <= rank <= most:
        return f"with frames the rank is {rank}, claimed are {least} to {most}"
    verdict = "solvable" if least == required else "not-finite-solvable" if most < required else "open"
    return None if claim["value"] == verdict else f"with frames it is {verdict}, claimed is {claim['value']}"


def change(stated, n, rng):
    """Another member `base_lines`, of which more may be true than at random: bounds and numbers are put right later."""
    frames, known, upper = stated["frames"], stated["known"], stated["upper"]
    sensors = 1 + max((k for images in frames for _, k in images), default=0)
    ways = [
        lambda: known.append(rng.randrange(sensors)),
        lambda: known and known.pop(),
        lambda: rng.choice(frames).append([rng.randrange(n), rng.randrange(sensors + 1)]),
        lambda: frames.append([[rng.randrange(n), rng.randrange(sensors + 1)] for _ in range(2)]),
        lambda: frames.remove(rng.choice(frames)),
        lambda: rng.choice(rng.choice(frames)).__setitem__(1, rng.randrange(sensors + 1)),
        lambda: stated.update(upper=None),
        lambda: stated.update(one_axis=None),
        lambda: stated.update(one_axis=stated["lower"]),
        lambda: [stated["lower"][name].pop() for name in ("rows", "cols")],
    ]
    if upper and upper["blocks"]:
        one, other = rng.choice(upper["blocks"]), rng.choice(upper["blocks"])
        ways += [
            lambda: upper["held"].append(rng.randrange(sensors)),
            lambda: upper["held"] and upper["held"].pop(),
            lambda: one is not other and (move(one, other), upper["blocks"].remove(one)),
            lambda: upper["blocks"].append({"bodies": [one["bodies"].pop()] if one["bodies"] else [], "edges": []}),
            lambda: upper["blocks"].append({"bodies": [], "edges": [one["edges"].pop()] if one["edges"] else []}),
        ]
    rng.choice(ways)()


def move(one, other):
    for name in ("bodies", "edges"):
        other[name] += one[name]


def put_in_order(stated):
    """Frames in the one order and numbering in which they are written."""
    frames = sorted(sorted(map(tuple, images)) for images in stated["frames"])
    number = {}
    stated["frames"] = [[[v, number.setdefault(k, len(number))] for v, k in images] for images in frames]
    stated["known"] = sorted({number[k] for k in stated["known"] if k in number})
    if stated["upper"]:
        stated["upper"]["held"] = sorted({number[k] for k in stated["upper"]["held"] if k in number})
