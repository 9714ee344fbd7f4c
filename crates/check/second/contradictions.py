"""docs/contradictions.md: not all measured motions of pairs can be right; and that they are those of a database."""

import hashlib
import math
import os
import re
import sqlite3
import struct
import urllib.parse

from notation import Unreadable, a_list, a_string, an_int, increasing, members, members_about, need, same

FACTOR = 2147483647
DISTORTED = {0: 3, 1: 4, 2: 3, 3: 3, 4: 4, 6: 4}  # where the distortion of a model begins
PARAMETERS = {0: 3, 1: 4, 2: 4, 3: 5, 4: 8, 6: 12}
TABLES = {
    "cameras": "camera_id model prior_focal_length params",
    "images": "image_id camera_id name",
    "keypoints": "image_id rows cols data",
    "two_view_geometries": "pair_id rows config data E qvec tvec",
}


# Section 1: quaternions and vectors -----------------------------------------------------------------------------------


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def times(p, q):
    v = cross(p[1:], q[1:])
    return (p[0] * q[0] - dot(p[1:], q[1:]), *(p[0] * q[k + 1] + q[0] * p[k + 1] + v[k] for k in range(3)))


def conj(q):
    return (q[0], -q[1], -q[2], -q[3])


def turn(q, v):
    """|q|^2 R(q) v."""
    return times(times(q, (0, *v)), conj(q))[1:]


def essential(q, t):
    """[t]_x |q|^2 R(q), row by row."""
    columns = [cross(t, turn(q, axis)) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    return [columns[j][i] for i in range(3) for j in range(3)]


def along(a, b, bits):
    return dot(a, b) ** 2 << bits >= (2**bits - 1) * dot(a, a) * dot(b, b)


def exact(numbers):
    """Finite floating point numbers times one power of two, as integers."""
    ratios = [number.as_integer_ratio() for number in numbers]
    whole = max(below for _, below in ratios)
    return [above * (whole // below) for above, below in ratios]


def cosines():
    c = [2**62, 4610983636309578612]
    for k in range(1, 180):
        c.append((c[1] * c[k] >> 61) - c[k - 1])
    return c


COS = cosines()


def ints(value, count, where):
    """So many ints, not all zero."""
    need(len(a_list(value, where)) == count, f"{where} has not {count} entries")
    for entry in value:
        an_int(entry, where)
    need(any(value), f"{where} is zero")
    return tuple(value)


class ContradictionsCheck:
    """The check of one certificate, and of its numbers where the path of their database is known."""

    def __init__(self, document, source=None):
        names = "database images pairs excluded packings upper"
        self.database, images, pairs, excluded, packings, upper = members_about("contradictions", document, names, "the document")
        need(self.database is None or re.fullmatch("[0-9a-f]{64}", a_string(self.database, "database")), "database: no 64 digits")
        self.images = [a_string(name, "a name") for name in a_list(images, "images")]
        need(self.images and len(set(self.images)) == len(images), "(C1) no images, or two of one name")
        self.pairs = [self.read_pair(pair, f"pairs[{k}]") for k, pair in enumerate(a_list(pairs, "pairs"))]
        self.excluded = [self.read_pair(pair, f"excluded[{k}]") for k, pair in enumerate(a_list(excluded, "excluded"))]
        ends = [frozenset(pair[0]) for pair in self.pairs + self.excluded]
        need(self.database is None or len(set(ends)) == len(ends), "(C2) a pair is there twice")
        need(self.database is not None or not excluded, "(C2) excluded pairs, and no database")
        self.at_least = [self.packing(value, f"packings[{k}]") for k, value in enumerate(a_list(packings, "packings"))]
        self.at_most = [self.upper(value, f"upper[{k}]") for k, value in enumerate(a_list(upper, "upper"))]
        self.bound = source is not None
        if self.bound:
            self.bind(source)

    def read_pair(self, value, where):
        ends, configuration, q, t = members(value, "ends configuration q t", where)
        need(len(a_list(ends, where)) == 2, f"{where}: not two ends")
        i, j = (an_int(end, where, least=0, below=len(self.images)) for end in ends)
        need(i != j, f"{where}: (C1) one image")
        fine = (None,) if self.database is None else (2, 3)
        need(any(same(configuration, one) for one in fine), f"{where}: (C2) another configuration")
        return (i, j), configuration, ints(q, 4, f"{where}: q"), None if t is None else ints(t, 3, f"{where}: t")

    # Section 3 -------------------------------------------------------------------------------------------------------

    def packing(self, value, where):
        names = "theta phi assumed assumed_within denominator cycles at_least"
        theta, phi, assumed, within, denominator, cycles, at_least = members(value, names, where)
        an_int(theta, f"{where}: theta", least=1, below=90)
        if phi is not None:
            an_int(phi, f"{where}: phi", least=theta, below=90)
        for number in increasing(a_list(assumed, where), f"{where}: assumed"):
            an_int(number, f"{where}: assumed", least=0, below=len(self.pairs))
        an_int(within, f"{where}: assumed_within", least=1, below=1000 * theta + 1)
        an_int(denominator, f"{where}: denominator", least=1)
        weights, total, witnessed, right = {}, 0, False, set(assumed)
        for k, cycle in enumerate(a_list(cycles, f"{where}: cycles")):
            at = f"{where}.cycles[{k}]"
            walk, weight, witness = members(cycle, "walk weight witness", at)
            an_int(weight, f"{at}: weight", least=0)
            steps = self.walk(walk, at)
            angle = -(-sum(within if k in right else 1000 * theta for k, _ in steps) // 1000)
            need(angle < 180, f"{at}: (C4) its angles sum to 180 or more")
            need(not {k for k, _ in steps} <= right, f"{at}: (C5) all of its pairs are assumed")
            if witness is None:
                self.rotations(steps, angle, at)
            else:
                need(phi is not None, f"{at}: (C3) a witness without phi")
                self.directions(steps, theta, phi, ints(witness, 3, f"{at}: witness"), at)
                witnessed = True
            total += weight
            for k, _ in steps:
                weights[k] = weights.get(k, 0) + weight
        need(phi is None or witnessed, f"{where}: (C3) phi without a witness")
        for k in weights.keys() - right:
            need(weights[k] <= denominator, f"{where}: (C8) pair {k} carries more than one")
        need(same(at_least, -(-total // denominator)), f"{where}: (C8) at_least is another number")
        return theta, phi, len(assumed), within, at_least

    def walk(self, value, where):
        """(C4)."""
        steps = []
        for step in a_list(value, f"{where}: walk"):
            need(len(a_list(step, where)) == 2, f"{where}: a step is no list of two")
            k = an_int(step[0], f"{where}: a step", least=0, below=len(self.pairs))
            need(an_int(step[1], where) in (1, -1), f"{where}: no sense")
            steps.append((k, step[1]))
        need(len(steps) >= 2, f"{where}: (C4) too short")
        need(len({k for k, _ in steps}) == len(steps), f"{where}: (C4) a pair is taken twice")
        ends = [self.pairs[k][0][::sense] for k, sense in steps]
        need(all(ends[m - 1][1] == ends[m][0] for m in range(len(ends))), f"{where}: (C4) not closed")
        return steps

    def composed(self, steps):
        whole = (1, 0, 0, 0)
        for k, sense in steps:
            q = self.pairs[k][2]
            whole = times(q if sense == 1 else conj(q), whole)
        return whole

    def rotations(self, steps, angle, where):
        """(C6)."""
        whole, count = self.composed(steps), len(steps)
        need(whole[0] ** 2 << 63 < (2**62 + COS[angle] - count * 2**47) * dot(whole, whole), f"{where}: (C6) no contradiction")

    def directions(self, steps, theta, phi, w, where):
        """(C7)."""
        for m, (k, sense) in enumerate(steps):
            links = min(m, len(steps) - 1 - m)
            within = phi + links * theta
            need(within < 90, f"{where}: (C7) phi + h theta is 90 or more")
            _, _, q, t = self.pairs[k]
            need(t is not None, f"{where}: (C7) pair {k} has no t")
            of_i, of_j = turn(conj(q), [-x for x in t]), [-x for x in t]
            first, second = (of_i, of_j) if sense == 1 else (of_j, of_i)
            if m <= len(steps) - 1 - m:
                v = turn(conj(self.composed(steps[:m])), first)
            else:
                v = turn(self.composed(steps[m + 1 :]), second)
            forward = sense * dot(w, v)
            least = (2**62 - COS[2 * within] + (links + 1) * 2**48) * dot(w, w) * dot(v, v)
            need(forward > 0 and forward**2 << 63 > least, f"{where}: (C7) step {m} is too far from the witness")

    # Section 4 -------------------------------------------------------------------------------------------------------

    def upper(self, value, where):
        """(C9)."""
        theta, rotations, at_most = members(value, "theta rotations at_most", where)
        an_int(theta, f"{where}: theta", least=1, below=90)
        need(len(a_list(rotations, where)) == len(self.images), f"{where}: not a rotation for each image")
        p = [ints(rotation, 4, f"{where}: a rotation") for rotation in rotations]
        rest = [times(conj(p[j]), times(q, p[i])) for (i, j), _, q, _ in self.pairs]
        off = sum(r[0] ** 2 << 63 < (2**62 + COS[theta] + 2**47) * dot(r, r) for r in rest)
        need(same(at_most, off), f"{where}: (C9) at_most is another number")
        return theta, at_most

    # Section 5 -------------------------------------------------------------------------------------------------------

    def bind(self, path):
        """(B1) to (B7)."""
        self.read_database(path)
        need(self.hash_of_database() == self.database, "(B1) the database has another hash")
        ids = {row["name"]: row["image_id"] for row in self.tables["images"].values()}
        for name in self.images:
            need(name in ids, f"(B2) the database has no image {name}")
        stated = {}
        for listed, pairs in ((True, self.pairs), (False, self.excluded)):
            for (i, j), *rest in pairs:
                stated[ids[self.images[i]], ids[self.images[j]]] = (listed, *rest)
        for number, row in self.tables["two_view_geometries"].items():
            ends = divmod(number, FACTOR)
            measured = self.measured(row, ends)
            need(measured is None or ends in stated, f"(B7) the checkable pair {ends} is not listed")
            if ends in stated:
                need(measured is not None, f"(B2) the pair {ends} cannot be checked")
                self.bind_pair(row, measured, *stated.pop(ends))
        need(not stated, "(B2) a pair is no row of the database")

    def bind_pair(self, row, measured, listed, configuration, q, t):
        need(configuration == row["config"], "(B2) the configuration is another one")
        e, inliers, p, u = measured
        if e is None:
            need(listed, "(B5) a pair by qvec is excluded")
            need(along(q, p, 36), "(B5) q is not qvec")
            return need(t is None or u and dot(t, u) > 0 and along(t, u, 36), "(B5) t is not tvec")
        need(t is not None, "(B3) a pair by E without t")
        need(along(e, essential(q, t), 40), "(B3) the motion is not that of E")
        back = [-x for x in t]
        if listed:
            need(in_front(q, t, inliers), "(B4) not more than half of the points are in front")
        else:
            every = [(r, s) for r in (q, times((0, *t), q)) for s in (t, back)]
            need(not any(in_front(r, s, inliers) for r, s in every), "(B6) more than half of the points are in front")

    def read_database(self, path):
        try:
            log = path + "-wal"
            # Without changes in a log nothing is beside the file, and nothing is to be left there.
            how = "mode=ro" if os.path.exists(log) and os.path.getsize(log) else "mode=ro&immutable=1"
            connection = sqlite3.connect(f"file:{urllib.parse.quote(path)}?{how}", uri=True)
            self.tables = {name: read_table(connection, name, columns.split()) for name, columns in TABLES.items()}
            connection.close()
        except sqlite3.Error as error:
            raise Unreadable(f"{path}: {error}") from None
        names = [row["name"] for row in self.tables["images"].values()]
        if len(set(names)) < len(names):
            raise Unreadable(f"{path}: two images have one name")

    def hash_of_database(self):
        done = hashlib.sha256(b"viewcert database 1\n")
        for table in self.tables.values():
            done.update(struct.pack("<Q", len(table)))
            for row in table.values():
                for value in row.values():
                    if type(value) is int:
                        done.update(struct.pack("<q", value))
                    else:
                        value = value.encode() if type(value) is str else value
                        done.update(struct.pack("<Q", len(value)) + value)
        return done.hexdigest()

    def measured(self, row, ends):
        """E and inliers of a row by E, or the motion of one by qvec."""
        images = [self.tables["images"].get(end) for end in ends]
        cameras = [image and self.tables["cameras"].get(image["camera_id"]) for image in images]
        if not (all(cameras) and ends[0] < ends[1] and row["config"] in (2, 3) and row["rows"] >= 15):
            return None
        if not all(camera["prior_focal_length"] for camera in cameras):
            return None
        e, sides = doubles(row["E"], 9), [self.side(camera, end) for camera, end in zip(cameras, ends)]
        if e and is_essential(exact(e)) and all(sides) and len(row["data"]) == 8 * row["rows"]:
            inliers = [[side(at) for side, at in zip(sides, two)] for two in struct.iter_unpack("<II", row["data"])]
            if all(map(all, inliers)):
                return exact(e), inliers, None, None
        p, u = doubles(row["qvec"], 4), doubles(row["tvec"], 3)
        return (None, None, exact(p), u and exact(u)) if row["config"] == 2 and p else None

    def side(self, camera, end):
        """What gives the ray of a keypoint, if the camera has no distortion and the keypoint is there."""
        model, keypoints = camera["model"], self.tables["keypoints"].get(end)
        if model not in PARAMETERS or not keypoints:
            return None
        values, begin = doubles(camera["params"], PARAMETERS[model]), DISTORTED[model]
        rows, cols, data = keypoints["rows"], keypoints["cols"], keypoints["data"]
        if not values or any(values[begin:]) or cols < 2 or len(data) != 4 * rows * cols:
            return None
        fx, fy = values[0], values[begin - 3]
        return None if fx <= 0 or fy <= 0 else lambda at: ray(data, at, cols, fx, fy, *values[begin - 2 : begin]) if at < rows else None

    def statements(self):
        """What was verified, for people."""
        of = "of this database" if self.bound else "about the numbers written here"
        count, found = len(self.pairs), []
        for theta, phi, assumed, within, least in self.at_least:
            directions = "" if phi is None else f", or their directions by more than {phi}"
            given = f", if {assumed} others are right within {within / 1000:g} degrees" if assumed else ""
            found.append(f"contradictions: at least {least} of {count} pairs are off by more than {theta} degrees{directions}{given} (proof), {of}")
        found += [f"rotations: all pairs but {most} agree within {theta} degrees (proof), {of}" for theta, most in self.at_most]
        named = f"database with SHA-256 {self.database}" if self.database else "no database is named"
        return [f"numbers: {len(self.images)} images, {count} pairs, {of}; {named}", *found]


def read_table(connection, name, columns):
    """The rows by their numbers, in order; NULL is an empty blob."""
    present = [row[1].lower() for row in connection.execute(f"pragma table_info({name})")]
    if not present and name == "keypoints":
        return {}
    optional = {"E", "qvec", "tvec"}
    chosen = [column if column.lower() in present or column not in optional else "NULL" for column in columns]
    table = {}
    for values in connection.execute(f"select {', '.join(chosen)} from {name} order by {columns[0]}"):
        row = dict(zip(columns, values))
        for column in columns:
            kind = {"name": str, "params": bytes, "data": bytes, "E": bytes, "qvec": bytes, "tvec": bytes}.get(column, int)
            row[column] = b"" if kind is bytes and row[column] is None else row[column]
            if type(row[column]) is not kind:
                raise Unreadable(f"{name}.{column} is of another type")
        if values[0] in table:
            raise Unreadable(f"{name}: row {values[0]} is there twice")
        table[values[0]] = row
    return table


def doubles(blob, count):
    """So many finite doubles, not all zero."""
    values = struct.unpack(f"<{count}d", blob) if len(blob) == 8 * count else ()
    return values if all(map(math.isfinite, values)) and any(values) else None


def is_essential(e):
    rows, size = [e[0:3], e[3:6], e[6:9]], dot(e, e)
    square = [[dot(a, b) for b in rows] for a in rows]
    rest = [2 * dot(square[i], e[j::3]) - size * e[3 * i + j] for i in range(3) for j in range(3)]
    return dot(rest, rest) << 48 <= size**3


def ray(data, at, cols, fx, fy, cx, cy):
    u, v = struct.unpack_from("<2f", data, 4 * cols * at)
    if not math.isfinite(u) or not math.isfinite(v):
        return None
    u, v, fx, fy, cx, cy = exact([u, v, fx, fy, cx, cy])
    return ((u - cx) * fy, (v - cy) * fx, fx * fy)


def in_front(q, t, inliers):
    """Whether more than half of the points are."""
    count, axes = 0, [turn(q, axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    for x, other in inliers:
        y = [sum(axis[k] * entry for axis, entry in zip(axes, x)) for k in range(3)]
        n = cross(y, other)
        count += dot(cross(other, t), n) > 0 and dot(cross(y, t), n) > 0
    return 2 * count > len(inliers)
