"""How often the published test of affine solvability errs in floating point: `affine_audit.py [DRAWS]`
(lab/docs/studies.md). What is true is known: the graphs have the fewest pairs possible, or one less."""

import sys

import numpy

TOLERANCE = 1e-6  #: of the published demonstration, on the smallest singular value


def triangle_strip(nodes):
    """Triangles of which each shares an edge with the next."""
    return [(j - k, j) for k in (1, 2) for j in range(k, nodes)]


def random_laman(nodes, random):
    """Joins each node to two earlier ones or, as often, to three of which two lose their edge (Henneberg's steps)."""
    edges = [(0, 1)]
    for z in range(2, nodes):
        a, b = random.choice(z, 2, replace=False)
        if z > 2 and random.integers(2):
            a, b = edges.pop(random.integers(len(edges)))
            edges.append((random.choice([c for c in range(z) if c not in (a, b)]), z))
        edges += [(a, z), (b, z)]
    return edges


def singular_values(nodes, edges, random):
    """Those of the matrix with 4 m + 12 rows and 8 n columns (docs/theory.md, Theorem 13.2), one a column."""
    cameras = random.random((nodes, 2, 4))
    matrix = numpy.zeros((4 * len(edges) + 12, 8 * nodes))
    for e, (i, j) in enumerate(edges):
        (a, b), (c, d) = (cameras[v][:, :3] for v in (i, j))
        # The left null vector of [A_i; A_j], by its minors.
        from_i, from_j = numpy.cross(a, b), numpy.cross(c, d)
        null = ((i, 0, b @ from_j), (i, 1, -(a @ from_j)), (j, 0, d @ from_i), (j, 1, -(c @ from_i)))
        for v, r, x in null:
            for k in range(4):
                matrix[4 * e + k, 8 * v + 4 * r + k] = x
    # The frame: all of one camera, and a row of a neighbour.
    first, second = edges[0]
    for row, column in enumerate([8 * first + k for k in range(8)] + [8 * second + k for k in range(4)]):
        matrix[4 * len(edges) + row, column] = 1
    values = numpy.zeros(8 * nodes)
    found = numpy.linalg.svd(matrix, compute_uv=False)
    values[: len(found)] = found
    return values, max(matrix.shape) * numpy.spacing(found[0])  # the tolerance of MATLAB's `rank`


def row(name, nodes, graphs, is_solvable, draws, random):
    """A line of the table."""
    drawn = [singular_values(nodes, edges, random) for edges in graphs for _ in range(draws)]
    smallest = sorted(values[-1] for values, _ in drawn)
    wrong = sum((least > TOLERANCE) != is_solvable for least in smallest)
    by_rank = sum((values[-1] > rounding) != is_solvable for values, rounding in drawn)
    print(f"| {name} | {nodes} | {len(drawn)} | {wrong} | {by_rank} | {smallest[0]:.1e} | {smallest[len(drawn) // 2]:.1e} |")


def main(draws):
    random = numpy.random.default_rng(1)
    print("| graphs | cameras | draws | wrong by 1e-6 | wrong by `rank` | least | median |")
    print("|---|---:|---:|---:|---:|---:|---:|")
    for nodes in (10, 20, 40, 80):
        row("triangle strip", nodes, [triangle_strip(nodes)], True, draws, random)
        laman = [random_laman(nodes, random) for _ in range(10)]
        row("ten random Laman graphs", nodes, laman, True, draws // 10, random)
        row("the same, without an edge", nodes, [edges[1:] for edges in laman], False, draws // 10, random)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100)
