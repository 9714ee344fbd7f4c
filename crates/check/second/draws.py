"""Section 4 of docs/certificate.md: draws of cameras, by SHA-256 from the graph, the core, a seed and a number."""

import functools
import hashlib
import itertools
import math
import struct

from notation import distinct, is_prime, need

DRAW, FLOW = b"viewcert draw 2\n", b"viewcert flow 2\n"


class Stream:
    """Section 4: ChaCha20, read as little-endian 64-bit words."""

    def __init__(self, label, graph_hash, core_hash, seed, draw):
        key = hashlib.sha256(label + graph_hash + core_hash + struct.pack("<QQ", seed, draw)).digest()
        self.start = [0x61707865, 0x3320646E, 0x79622D32, 0x6B206574, *struct.unpack("<8I", key), 0, 0, 0, 0]
        self.words = []

    def block(self):
        x = self.start[:]
        for turn in range(10):
            for a, b, c, d in ROUNDS:
                p, q, r, s = x[a], x[b], x[c], x[d]
                p = (p + q) & 0xFFFFFFFF
                s ^= p
                s = (s << 16 | s >> 16) & 0xFFFFFFFF
                r = (r + s) & 0xFFFFFFFF
                q ^= r
                q = (q << 12 | q >> 20) & 0xFFFFFFFF
                p = (p + q) & 0xFFFFFFFF
                s ^= p
                s = (s << 8 | s >> 24) & 0xFFFFFFFF
                r = (r + s) & 0xFFFFFFFF
                q ^= r
                q = (q << 7 | q >> 25) & 0xFFFFFFFF
                x[a], x[b], x[c], x[d] = p, q, r, s
        x = [(value + begin) & 0xFFFFFFFF for value, begin in zip(x, self.start)]
        self.start[12] += 1
        self.words = [x[k] | x[k + 1] << 32 for k in range(14, -1, -2)]

    def word(self):
        if not self.words:
            self.block()
        return self.words.pop()

    def below(self, b):
        mask = (1 << (b - 1).bit_length()) - 1
        while True:
            value = self.word() & mask
            if value < b:
                return value

    def prime(self):
        """Section 9: the prime that a draw chooses."""
        while True:
            p = 2**61 + 2 * (self.word() % 2**60) + 1
            if is_prime(p):
                return p


ROUNDS = (
    *((0, 4, 8, 12), (1, 5, 9, 13), (2, 6, 10, 14), (3, 7, 11, 15)),
    *((0, 5, 10, 15), (1, 6, 11, 12), (2, 7, 8, 13), (3, 4, 9, 14)),
)


@functools.lru_cache(maxsize=256)
def draw_centres(graph_hash, core_hash, n, p, seed, draw, coordinates=3, places=None):
    """Section 4: centres modulo p (with two coordinates plane points), or None if the draw is void."""
    stream = Stream(DRAW, graph_hash, core_hash, seed, draw)
    if places is None:
        points = tuple(tuple(stream.below(p) for _ in range(coordinates)) for _ in range(n))
    else:
        points = placed_centres(stream, p, places)
    return points if distinct(points) else None


def placed_centres(stream, p, places):
    """Section 4: centres modulo p of which some lie at given vectors from earlier ones."""
    points = []
    for place in places:
        if place is None:
            points.append(tuple(stream.below(p) for _ in range(3)))
        else:
            points.append(tuple((c + v) % p for c, v in zip(points[place[0]], place[1])))
    return tuple(points)


@functools.lru_cache(maxsize=64)
def draws_of(graph_hash, core_hash, n, seed, count):
    """Section 9: the draws (number, prime, centres) that an error bound rests on."""
    found = []
    for number in itertools.count():
        if len(found) == count:
            return tuple(found)
        stream = Stream(DRAW, graph_hash, core_hash, seed, number)
        p = stream.prime()
        points = tuple(tuple(stream.below(p) for _ in range(3)) for _ in range(n))
        if distinct(points):
            found.append((number, p, points))


def integer_cameras(graph_hash, core, seed, draw, top, bottom):
    """Section 4: integer cameras with bounds A, B."""
    stream = Stream(DRAW, graph_hash, core.hash, seed, draw)
    cameras = []
    for _ in range(core.n):
        entries = [(stream.below(2 * top + 1) - top, stream.below(bottom) + 1) for _ in range(12)]
        scale = functools.reduce(lambda x, y: x * y // math.gcd(x, y), (w for _, w in entries))
        entries = [u * (scale // w) for u, w in entries]
        cameras.append([entries[0:4], entries[4:8], entries[8:12]])
    return cameras


def det3(a, b, c):
    return (
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    )


def refuse_void(cameras, p, where):
    """Section 4: each camera has rank 3 and a centre of its own; p is None for cameras over Q."""
    points = []
    for camera in cameras:
        columns = list(zip(*camera))
        point = [(-1) ** k * det3(*(columns[:k] + columns[k + 1 :])) for k in range(4)]
        point = [entry % p for entry in point] if p else point
        lead = next((entry for entry in point if entry), None)
        need(lead is not None, f"{where}: the draw is void, a camera has rank below 3")
        unit = math.gcd(*point) * (1 if lead > 0 else -1) if p is None else pow(lead, -1, p)
        points.append(tuple(entry * unit % p if p else entry // unit for entry in point))
    need(distinct(points), f"{where}: the draw is void, two centres agree")
