"""The singular values of `verify audit --cameras`, computed by numpy from the definitions.

In: pairs, and lines `pose NAME qw qx qy qz x y z`. Out: one number a line, of J_P and of the bearing matrix, each the
first one that is not of a trivial motion.
"""
import sys

import numpy as np


def rotation(q):
    w, x, y, z = q / np.linalg.norm(q)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + 2 * w * cross + 2 * cross @ cross


names, cameras, centres = [], [], []
for line in open(sys.argv[2]):
    _, name, *numbers = line.split()
    numbers = np.array(numbers, dtype=float)
    r, t = rotation(numbers[:4]), numbers[4:]
    camera = np.hstack([r, t[:, None]])
    names.append(name)
    cameras.append(10 * camera / np.linalg.norm(camera))
    centres.append(-r.T @ t)
pairs = [tuple(names.index(name) for name in line.split()) for line in open(sys.argv[1])]

vech = [(r, c) for c in range(4) for r in range(c, 4)]
n, rows, bearings = len(names), [], []
for i, j in pairs:
    # F = [e]x P_j P_i^+ with the image e of the centre of i, of norm 10.
    e = cameras[j] @ np.append(centres[i], 1)
    f = np.cross(np.eye(3), e) @ cameras[j] @ np.linalg.pinv(cameras[i])
    f *= 10 / np.linalg.norm(f)
    block = np.zeros((10, 12 * n))
    for k in range(12):
        unit = np.zeros((3, 4))
        unit[k // 4, k % 4] = 1
        for v, s in [(i, cameras[j].T @ f @ unit), (j, unit.T @ f @ cameras[i])]:
            block[:, 12 * v + k] = [(s + s.T)[at] for at in vech]
    rows.append(block)
    d = centres[j] - centres[i]
    block = np.zeros((3, 3 * n))
    block[:, 3 * i : 3 * i + 3] = np.eye(3) - np.outer(d, d) / (d @ d)
    block[:, 3 * j : 3 * j + 3] = -block[:, 3 * i : 3 * i + 3]
    bearings.append(block)
for matrix, required in [(rows, 11 * n - 15), (bearings, 3 * n - 4)]:
    print(repr(float(np.linalg.svd(np.vstack(matrix), compute_uv=False)[required - 1])))
