"""Section 2 of docs/certificate.md: the graph, and what is given besides it, each from a file of its own."""

import hashlib
import itertools
import math
import re
import struct

from notation import Unreadable, distinct

CONVERT = " (`verify convert` writes files that can be read here)"


class Graph:
    """Section 2: nodes 0 .. n-1, edges in order, and the hash of the canonical form."""

    def __init__(self, n, edges):
        self.n = n
        self.edges = sorted(set(edges))
        self.edge_set = frozenset(self.edges)
        flat = itertools.chain.from_iterable(self.edges)
        form = b"viewcert graph 1\n" + struct.pack("<QQ", n, len(self.edges))
        self.hash = hashlib.sha256(form + struct.pack(f"<{2 * len(self.edges)}I", *flat)).digest()


def read_graph6(line):
    """The graph of a graph6 line, or None if it is not one: n in its shortest form, no bit behind the last."""
    if not re.fullmatch("[?-~]+", line):
        return None
    values = [ord(c) - 63 for c in line]
    skip, size = (2, 6) if values[:2] == [63, 63] else (1, 3) if values[0] == 63 else (0, 1)
    if len(values) < skip + size:
        return None
    n = sum(value << 6 * (size - 1 - k) for k, value in enumerate(values[skip : skip + size]))
    body = values[skip + size :]
    bits = n * (n - 1) // 2
    if n <= {6: 258047, 3: 62, 1: -1}[size] or len(body) != -(-bits // 6):
        return None
    if body and body[-1] & ((1 << (-bits % 6)) - 1):
        return None
    edges = []
    for at, value in enumerate(body):
        for bit in range(6):
            if value >> (5 - bit) & 1:
                k = 6 * at + bit
                j = (1 + math.isqrt(8 * k + 1)) // 2
                edges.append((k - j * (j - 1) // 2, j))
    return Graph(n, edges)


def lines_of(data):
    """Section 2: the lines of a file without their ends, as bytes, each with its number."""
    *lines, last = data.split(b"\n")
    lines = [line[:-1] if line.endswith(b"\r") else line for line in lines]
    return enumerate(lines + [last] if last else lines, 1)


def read_graph(data, sha256):
    """Section 2, files that hold a graph: the graph that the certificate means."""
    if not re.match(b"[>?-~]", data):
        return read_pairs(data)
    graphs = []
    for k, line in lines_of(data[10:] if data.startswith(b">>graph6<<") else data):
        graphs.append(read_graph6(line.decode("latin-1")))
        if graphs[-1] is None:
            raise Unreadable(f"line {k}: not graph6{CONVERT}")
    if not graphs:
        raise Unreadable("no graph in it")
    return next((graph for graph in graphs if graph.hash.hex() == sha256), graphs[0])


def numbers_of(line, where):
    """Section 2: the numbers of a line, with a single blank or tab between them."""
    fields = [b""] if re.search(b"[^0-9 \t]", line) else re.split(b"[ \t]", line)
    if not all(re.fullmatch(b"0|[1-9][0-9]{0,9}", field) and int(field) < 2**32 - 1 for field in fields):
        raise Unreadable(f"{where}: not node numbers with a single blank or tab between them{CONVERT}")
    return [int(field) for field in fields]


def read_pairs(data):
    """Section 2, pairs."""
    edges, alone = set(), set()
    for k, line in lines_of(data):
        if line.startswith(b"#"):
            continue
        nodes = numbers_of(line, f"line {k}")
        if len(nodes) > 2:
            raise Unreadable(f"line {k}: more than two numbers")
        if not distinct(nodes):
            raise Unreadable(f"line {k}: a node is paired with itself")
        known = edges if len(nodes) == 2 else alone
        if tuple(sorted(nodes)) in known:
            raise Unreadable(f"line {k}: this is there already")
        known.add(tuple(sorted(nodes)))
    paired = set(itertools.chain.from_iterable(edges))
    alone = set(itertools.chain.from_iterable(alone))
    if paired & alone:
        raise Unreadable("a node stands alone and is in a pair")
    n = len(paired | alone)
    if not n:
        raise Unreadable("no node in it")
    if max(paired | alone) >= n:
        raise Unreadable(f"a number below the largest does not occur{CONVERT}")
    return Graph(n, edges)


def read_given(data, graph):
    """Section 2, files of what is given: known parts in their canonical form, and the hashes of displacements, of those in a
    frame of their own, and of frames, or None."""
    parts, lines = set(), [(k, line) for k, line in lines_of(data) if not line.startswith(b"#")]
    last = re.fullmatch(b"frames[ \t]([0-9a-fA-F]{64})", lines[-1][1]) if lines else None
    frames = last and last[1].decode().lower()
    lines = lines[:-1] if last else lines
    own = re.fullmatch(b"own-frame[ \t]([0-9a-fA-F]{64})", lines[-1][1]) if lines else None
    lines = lines[:-1] if own else lines
    own = own and own[1].decode().lower()
    if (last or own) and not lines:
        return [], None, own, frames
    for k, line in lines:
        word, numbers = re.fullmatch(b"([a-z]*)[ \t]?(.*)", line, re.DOTALL).groups()
        if word == b"displacements" and len(lines) == 1 and re.fullmatch(b"displacements[ \t][0-9a-fA-F]{64}", line):
            return [], numbers.decode().lower(), own, frames
        if not re.match(b"part[ \t]", line):
            raise Unreadable(f"line {k}: neither a part nor, alone, the hash of displacements, nor, last, that of frames")
        part = tuple(sorted(numbers_of(numbers, f"line {k}")))
        if len(part) < 2 or not distinct(part):
            raise Unreadable(f"line {k}: not two different nodes or more")
        if part[-1] >= graph.n:
            raise Unreadable(f"line {k}: {part[-1]} is no node of the graph")
        if part in parts:
            raise Unreadable(f"line {k}: the part is there already")
        parts.add(part)
    if not parts:
        raise Unreadable("nothing is given in it")
    return [list(part) for part in sorted(parts)], None, own, frames
