"""Second solutions to look at: other cameras with the same fundamental matrices."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Annotated, Any, Dict, Generic, List, Optional, Tuple, overload

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._act import _decided
from ._arguments import flag, whole
from ._errors import Absent, InputError, Undecided
from ._pickled import found_of
from ._types import N, Other
from ._verdict import Given
from ._words import in_python

#: Cameras as exact numbers: integers or fractions, of shape (n, 3, 4).
Exact = NDArray[np.object_]

_COLUMNS = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
_SIGNS = (1, -1, 1, 1, -1, 1)


def fundamental_matrix(first: Any, second: Any) -> NDArray[Any]:
    """The fundamental matrix F of two cameras, up to a factor: y^T F x = 0 for the images x in the first and
    y in the second of any point.

    It is exact where the cameras are (arrays of dtype object, with integers, fractions or numbers of
    sympy), and of floats otherwise; zero if their centres coincide.

    Parameters
    ----------
    first, second : array_like
        Matrices of 3 rows and 4 columns.

    Examples
    --------
    >>> import viewcert
    >>> viewcert.fundamental_matrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]],
    ...                             [[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0]]).tolist()
    [[0, 0, 0], [0, 0, 1], [0, -1, 0]]
    """
    cameras = [np.asarray(camera) for camera in (first, second)]
    for camera in cameras:
        if camera.shape != (3, 4):
            raise InputError(f"a camera of shape {camera.shape}: give 3 rows and 4 columns")
    if all(camera.dtype.kind in "iuO" for camera in cameras):
        # Products of machine numbers would overflow.
        cameras = [np.array([[_exact(x) for x in row] for row in camera], dtype=object) for camera in cameras]
    minors = [[_minors(camera, omitted) for omitted in range(3)] for camera in cameras]
    found = np.empty((3, 3), dtype=np.result_type(*cameras))
    for h in range(3):
        for k in range(3):
            a, b = minors[0][k], minors[1][h]
            total = sum(sign * a[m] * b[5 - m] for m, sign in enumerate(_SIGNS))
            found[h, k] = total if (h + k) % 2 == 0 else -total
    return found


def _exact(number: Any) -> Any:
    return int(number) if isinstance(number, np.integer) else number


def _minors(camera: NDArray[Any], omitted: int) -> List[Any]:
    p, q = (camera[row] for row in range(3) if row != omitted)
    return [p[k] * q[j] - p[j] * q[k] for k, j in _COLUMNS]


@dataclass(frozen=True, eq=False)
class Witness(Generic[N]):
    """Two families of cameras with the same fundamental matrices on all pairs of the graph, of which none is
    the other one times one 4 x 4 matrix: exact, modulo a prime.
    """

    prime: Annotated[int, "The modulus."]
    nodes: Annotated[Tuple[N, ...], "The nodes, in the order of the cameras."]
    first: Annotated[NDArray[np.uint64], "Cameras as least residues, ``uint64`` of shape (n, 3, 4)."]
    second: Annotated[NDArray[np.uint64], "Other cameras."]

    def fundamental(self, a: N, b: N) -> Tuple[Exact, Exact]:
        """The fundamental matrices of two nodes in both families, as least residues, the first entry that is not
        zero made 1: equal if (and only if) the matrices are the same up to a factor.
        """
        found = []
        i, j = (_place(self.nodes, node) for node in (a, b))
        for family in (self.first, self.second):
            matrix = fundamental_matrix(family[i], family[j]) % self.prime
            lead = next((x for x in matrix.ravel().tolist() if x), None)
            if lead is not None:
                matrix = matrix * pow(lead, -1, self.prime) % self.prime
            found.append(matrix)
        return found[0], found[1]

    def differs_at(self) -> List[Tuple[N, N]]:
        """The pairs of nodes whose fundamental matrices are not the same in both families: none is a pair of the
        graph. O(n^2)."""
        nodes = self.nodes
        pairs = ((a, b) for k, b in enumerate(nodes) for a in nodes[:k])
        return [pair for pair in pairs if not np.array_equal(*self.fundamental(*pair))]

    def __repr__(self) -> str:
        return f"<viewcert.Witness: two solutions of {len(self.nodes)} cameras modulo {self.prime}>"


def _place(nodes: Tuple[Any, ...], node: Any) -> int:
    try:
        return nodes.index(node)
    except ValueError:
        raise Absent(f"{node!r} is no node of the graph") from None


@overload
def witness(verdict: Given[N], *, full: bool = ..., seed: Optional[int] = ...) -> Optional[Witness[N]]: ...
@overload
def witness(verdict: Other, *, full: bool = ..., seed: Optional[int] = ...) -> Optional[Witness[Any]]: ...
def witness(verdict: Any, *, full: bool = False, seed: Optional[int] = None) -> Any:
    """Two sets of cameras that have the same fundamental matrices, of a graph with finitely many solutions.

    Parameters
    ----------
    verdict : Verdict
        Of the projective model. Or a graph, which is decided first.
    full : bool
        Count solutions whatever it takes.
    seed : int, optional
        The seed of the random cameras; by default that of the verdict.

    Returns
    -------
    Witness or None
        None if there is one solution alone.

    Raises
    ------
    InputError
        If there are infinitely many solutions, or the verdict is of another model.
    Undecided
        If no second solution is known; the message says why.

    Examples
    --------
    A graph with nine cameras and two solutions: on its pairs both have the same fundamental matrices, but not
    on all others.

    >>> import networkx, viewcert
    >>> graph = networkx.from_graph6_bytes(b"HBQkcP_")
    >>> found = viewcert.witness(graph)
    >>> found.first.shape, found.second.shape
    ((9, 3, 4), (9, 3, 4))
    >>> first, second = found.fundamental(*next(iter(graph.edges)))
    >>> bool((first == second).all())
    True
    >>> any(graph.has_edge(*pair) for pair in found.differs_at()), len(found.differs_at()) > 0
    (False, True)
    """
    verdict = _decided(verdict)
    if verdict.model != "projective":
        raise InputError(f"witness: second solutions are of the projective model, not of the {verdict.model} one")
    if verdict.value == "not-finite-solvable":
        raise InputError(
            "witness: there are infinitely many solutions; viewcert.at_cameras(verdict, cameras).velocities() says "
            "how cameras move"
        )
    if verdict.value == "solvable":
        return None
    wanted = dict(verdict._question["wanted"])
    seed = wanted["seed"] if seed is None else whole("seed", seed, 0, 2**64 - 1)
    if (flag("full", full) and wanted["solutions"] != "full") or wanted["solutions"] is None or seed != wanted["seed"]:
        wanted["solutions"] = "full" if full else wanted["solutions"] or "quick"
        wanted["seed"] = seed
        found = _native.decide(verdict.graph._native, wanted, verdict._question["beside"])
    else:
        found = found_of(verdict._native)
    text, (why, words) = _native.witness(found, seed=seed)
    if text is None:
        if why == "one":
            return None
        advice = "" if full else "; full=True counts whatever it takes"
        raise Undecided(f"witness: {in_python(words)}{advice}")
    said: Dict[str, Any] = json.loads(text)
    nodes = tuple(verdict.graph.nodes)
    families = (np.array([[list(map(int, row)) for row in camera] for camera in said[name]], dtype=np.uint64)
                for name in ("first", "second"))
    return Witness(int(said["prime"]), nodes, *families)
