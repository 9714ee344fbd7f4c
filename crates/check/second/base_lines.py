"""Section 13 of docs/certificate.md: unknown base lines, the same in all frames of a rig."""

import hashlib
import itertools
import struct

from claim import Claims
from draws import DRAW, Stream
from elimination import Elimination
from notation import TooLarge, a_list, an_int, increasing, members, need


class Frames:
    """Section 13, (B1) and (B2): the images of frames, and which places of their sensors are unknown."""

    def __init__(self, frames, known, n, where):
        self.at, self.frames, sensors = {}, [], 0
        for f, images in enumerate(a_list(frames, f"{where}: frames")):
            at = f"{where}: frame {f}"
            own = []
            for image in a_list(images, at):
                need(len(a_list(image, at)) == 2, f"{at}: an image is not [v, k]")
                v, k = an_int(image[0], at, least=0, below=n), an_int(image[1], at, least=0, below=sensors + 1)
                need(v not in self.at, f"{at}: node {v} is an image twice")
                need(all(k != other for _, other in own), f"{at}: sensor {k} is there twice")
                self.at[v] = f, k
                own.append((v, k))
                sensors = max(sensors, k + 1)
            need(len(own) >= 2, f"{at} has less than two images")
            increasing([v for v, _ in own], f"{at}: images")
            self.frames.append(own)
        need(self.frames, f"{where}: there is no frame")
        increasing([own[0][0] for own in self.frames], f"{where}: first nodes of frames")
        known = [an_int(k, f"{where}: known", least=0, below=sensors) for k in a_list(known, f"{where}: known")]
        self.known, self.sensors = increasing(known, f"{where}: known"), sensors
        linked = [{k} for k in range(sensors)]
        for own in self.frames:
            joined = set().union(*(linked[k] for _, k in own))
            for k in joined:
                linked[k] = joined
        self.origins = {k for k in range(sensors) if k == min(linked[k]) and not linked[k] & set(known)}
        self.places = [k for k in range(sensors) if k not in known and k not in self.origins]
        self.linked_known = any(len(linked[k] & set(known)) >= 2 for k in known)
        need(self.places, f"{where}: there is no unknown place")

    def hash(self):
        form = b"viewcert frames 1\n" + struct.pack("<Q", len(self.frames))
        for own in self.frames:
            form += struct.pack(f"<Q{2 * len(own)}I", len(own), *itertools.chain.from_iterable(own))
        return hashlib.sha256(form + struct.pack(f"<Q{len(self.known)}I", len(self.known), *self.known)).digest()


def rotation(x, y, z, p):
    """Section 13: the rows of R_f, or None if q is 0."""
    q = (1 + x * x + y * y + z * z) % p
    rows = (
        (1 + x * x - y * y - z * z, 2 * (x * y - z), 2 * (x * z + y)),
        (2 * (x * y + z), 1 - x * x + y * y - z * z, 2 * (y * z - x)),
        (2 * (x * z - y), 2 * (y * z + x), 1 - x * x - y * y + z * z),
    )
    return [[entry * pow(q, -1, p) % p for entry in row] for row in rows] if q else None


class BaseLines(Claims):
    """Section 13: what frames add."""

    def check_base_lines(self, value):
        """Section 13: the claim that the evidence gives."""
        where = "section 13"
        frames, known, lower, upper, one_axis = members(value, "frames known lower upper one_axis", where)
        need(self.model == "calibrated", f"{where}: calibrated model only")
        need(self.vectors is None, f"{where}: beside vectors")
        self.frames = frames = Frames(frames, known, self.graph.n, where)
        given = self.given_frames
        need(not self.expects or given == frames.hash().hex(), f"{where}: the frames that are given are others")
        self.frames_scaled = bool(self.groups) or frames.linked_known
        free = self.graph.n - len(frames.at)
        required = 3 * (free + len(frames.frames) + len(frames.places)) - 4 + self.frames_scaled
        self.everything = sorted(self.cover(), key=lambda member: (type(member) is not int, member))
        self.lay_out()
        least = self.frames_lower(lower, False, f"{where}: lower")
        most = required if upper is None else min(required, self.frames_upper(upper, f"{where}: upper"))
        need(least <= most, f"{where}: at_least is above at_most")
        if one_axis is not None:
            rank = self.frames_lower(one_axis, True, f"{where}: one_axis")
            need(rank == required, f"{where}: one_axis: the rank is {rank}, not {required}")
        verdict = "solvable" if least == required else "not-finite-solvable" if most < required else "open"
        numbers = {"at_least": least, "at_most": most, "required": required, "about_one_axis": one_axis is not None}
        return {"value": verdict, **numbers, "strength": "proof", "error_log2": None}

    def lay_out(self):
        """Section 13: the shared nodes, the pairs of the rows, and what the rank is beyond the number of pivots."""
        frames, times = self.frames, {}
        for member in self.everything:
            for node in self.nodes(member):
                times[node] = times.get(node, 0) + 1
        shared = sorted({node for node, count in times.items() if count >= 2} | set(frames.at))
        free = [node for node in shared if node not in frames.at]
        self.shared, self.column = shared, {node: 3 * k for k, node in enumerate(free)}
        self.width = 3 * (len(free) + len(frames.frames) + len(frames.places))
        if self.width > 3 * self.core_limit:
            raise TooLarge(f"section 13: {self.width // 3} vectors are unknown, the limit is {self.core_limit}")
        alone = set(range(self.graph.n)) - set(times) - set(frames.at)
        lost, self.pairs, inside = 3 * len(alone), [], set(shared)
        for member in self.everything:
            own, scaled = sorted(inside & set(self.nodes(member))), self.is_scaled([member])
            if len(own) < 2:
                lost += (1 if own else 4) - scaled
                continue
            for pair in [*zip(own, own[1:]), *zip(own, own[2:])]:
                self.pairs += [(pair, 0), (pair, 1)]
            if scaled:
                self.pairs.append(((own[0], own[1]), None))
        self.beyond = 3 * (self.graph.n - len(frames.at) - len(free)) - lost

    def frames_lower(self, value, one_axis, where):
        """Section 13, (B3), and (B5): a lower bound on the rank."""
        prime, seed, draw, rows, cols = members(value, "prime seed draw rows cols", where)
        p, seed, draw = self.prime_seed_draw(prime, seed, draw, where)
        rows, cols = self.pivots(rows, cols, len(self.pairs), self.width, where)
        turns, centres = self.draw_frames(p, seed, draw, one_axis, where)
        matrix = [self.frames_row(*self.pairs[row], turns, centres, p) for row in rows]
        Elimination(matrix, cols, p, where)
        return self.beyond + len(rows)

    def draw_frames(self, p, seed, draw, one_axis, where):
        """Section 13, the draw: the rotations of frames, and the centres of shared nodes."""
        frames, turns, starts = self.frames, [], []
        stream = Stream(DRAW, self.graph.hash, frames.hash(), seed, draw)
        axis = [stream.below(p) for _ in range(3)] if one_axis else None
        for _ in frames.frames:
            if one_axis:
                angle = stream.below(p)
                turn = [angle * entry for entry in axis]
            else:
                turn = [stream.below(p) for _ in range(3)]
            turns.append(rotation(*turn, p))
            need(turns[-1], f"{where}: the draw is void, a rotation has q = 0")
            starts.append([stream.below(p) for _ in range(3)])
        places = [[stream.below(p) for _ in range(3)] for _ in range(frames.sensors)]
        for k in frames.origins:
            places[k] = [0, 0, 0]
        centres = {}
        for node in self.shared:
            if node in frames.at:
                f, k = frames.at[node]
                arm = [sum(turns[f][r][c] * places[k][r] for r in range(3)) for c in range(3)]
                centres[node] = [(x + y) % p for x, y in zip(starts[f], arm)]
            else:
                centres[node] = [stream.below(p) for _ in range(3)]
        for (u, w), _ in self.pairs:
            need(centres[u] != centres[w], f"{where}: the draw is void, the ends of a pair agree")
        return turns, centres

    def frames_row(self, pair, which, turns, centres, p):
        """Section 13: a row of M'; `which` of the two directions, or None for that of a scaled body."""
        frames, (u, w), row = self.frames, pair, {}
        d = [(x - y) % p for x, y in zip(centres[u], centres[w])]
        q = next(k for k in range(3) if d[k])
        a = [int(k == q) for k in range(3)]
        if which is not None:
            r = [k for k in range(3) if k != q][which]
            a[q], a[r] = -d[r], d[q]
        for node, sign in ((u, 1), (w, -1)):
            if node in self.column:
                parts = [(self.column[node], a)]
            else:
                f, k = frames.at[node]
                first = 3 * len(self.column)
                parts = [(first + 3 * f, a)]
                if k in frames.places:
                    turned = [sum(x * y for x, y in zip(line, a)) for line in turns[f]]
                    parts.append((first + 3 * (len(frames.frames) + frames.places.index(k)), turned))
            for start, vector in parts:
                for k, entry in enumerate(vector):
                    row[start + k] = (row.get(start + k, 0) + sign * entry) % p
        return {column: entry for column, entry in row.items() if entry}

    def frames_upper(self, value, where):
        """Section 13, (B4): an upper bound on the rank."""
        frames = self.frames
        held, blocks, bound = members(value, "held blocks bound", where)
        held = [an_int(k, f"{where}: held") for k in a_list(held, f"{where}: held")]
        need(set(increasing(held, f"{where}: held")) <= set(frames.places), f"{where}: held: no unknown place")
        groups = []
        for k, block in enumerate(a_list(blocks, f"{where}: blocks")):
            groups.append(self.read_group(*members(block, "bodies edges", f"{where}: block {k}"), f"{where}: block {k}"))
        self.partition(groups, set(self.everything), f"{where}: blocks")
        fixed = set(held) | set(range(frames.sensors)) - set(frames.places)
        total = 3 * len(held) - bool(held and not self.frames_scaled)
        total += sum(self.frames_block(group, fixed) for group in groups)
        need(an_int(bound, f"{where}: bound") == total, f"{where}: the bound is {total}")
        return total

    def frames_block(self, group, fixed):
        """Section 13, (B4): what a block contributes."""
        nodes, parts = self.union(group), []
        images = [self.frames.at[node] for node in nodes if node in self.frames.at]
        for f, k in images:
            both = {("frame", f), ("sensor", k)}
            apart = [part for part in parts if not part & both]
            parts = [*apart, both.union(*(part for part in parts if part & both))]
        counts = [sum(kind == "sensor" and k in fixed for kind, k in part) for part in parts]
        size = len(nodes) - len(images) + sum(map(len, parts)) - sum(max(1, count) for count in counts)
        return 3 * size - 4 + (self.is_scaled(group) or any(count >= 2 for count in counts))

    def supposed_frames(self):
        """Section 13: what is claimed of base lines, and what it supposes; for people."""
        part, frames = self.claim["base_lines"], self.frames
        numbers = f"rank {part['at_least']} to {part['at_most']} of {part['required']} required (proof)"
        unknown = f"where frames ({len(frames.frames)}) share unknown base lines ({len(frames.places)})"
        axis = ", also about one axis" if part["about_one_axis"] else ""
        return f"base lines: {part['value']}{axis}, {numbers}, {unknown}, SHA-256 {frames.hash().hex()}"
