"""Graphs with names: those of the documentation, to try things on, and cameras in special places.

>>> import viewcert
>>> viewcert.verify(viewcert.examples.courtyard()).value
'solvable'
>>> viewcert.examples.names()
['courtyard', 'courtyard_gaps', 'facade', 'house', 'prism', 'psi', 'two_solutions']
"""

from __future__ import annotations

from typing import Any, Callable, Dict, List, Tuple

from ._errors import InputError
from ._graph import Graph
from ._types import Decided

__all__ = [
    "courtyard", "courtyard_gaps", "degenerate", "degenerate_names", "facade", "graph", "house", "names", "prism", "psi",
    "two_solutions",
]

_Place = Tuple[str, str, str]


def _pairs(text: str, name: str = "{}") -> List[Tuple[str, str]]:
    """Pairs as ``a-b a-c``; `name` is put around each node."""
    ends = (pair.rsplit("-", 1) for pair in text.split())
    return [(name.format(a), name.format(b)) for a, b in ends]


def courtyard() -> Graph[str]:
    """28 images from a walk round a courtyard, each matched to the next ones in view, the last ones to the first,
    and some to images on the other side: solvable."""
    return Graph(_pairs(_COURTYARD, "IMG_{}.jpg"), name="courtyard")


def courtyard_gaps() -> Graph[str]:
    """The same walk with a single pair left at every corner, and none across: it falls into eight components."""
    return Graph(_pairs(_COURTYARD_GAPS, "IMG_{}.jpg"), name="courtyard_gaps")


def facade() -> Graph[str]:
    """A sequence of 8 images around an object, and 3 of a facade that hang on by two single matches."""
    return Graph(_pairs(_FACADE), name="facade")


def house() -> Graph[str]:
    """A house: the roof is a triangle, the walls and the floor are three sides of a square."""
    corners = "left-top right-top left-bottom right-bottom"
    roof, left, right, low_left, low_right = (f"{node}.jpg" for node in ["roof", *corners.split()])
    pairs = [(roof, left), (roof, right), (left, right), (left, low_left), (right, low_right), (low_left, low_right)]
    return Graph(pairs, name="house")


def prism() -> Graph[str]:
    """Two triangles and three pairs between them: solvable in every model."""
    return Graph(_pairs("a-b a-c b-c d-e d-f e-f a-d b-e c-f"), name="prism")


def psi() -> Graph[int]:
    """11 cameras and 15 pairs, of which the last four always move as one body and yet are four components
    (Example 6.2 of docs/theory.md)."""
    return Graph([(int(a), int(b)) for a, b in _pairs(_PSI)], name="psi")


def two_solutions() -> Graph[int]:
    """A published graph with nine cameras and two solutions, ``HBQkcP_`` in graph6."""
    return Graph([(int(a), int(b)) for a, b in _pairs(_TWO_SOLUTIONS)], name="two_solutions")


_ALL: Tuple[Callable[[], Graph[Any]], ...] = (courtyard, courtyard_gaps, facade, house, prism, psi, two_solutions)
_NAMED = {function.__name__: function for function in _ALL}


def names() -> List[str]:
    """The names of the graphs."""
    return sorted(_NAMED)


def graph(name: str) -> Graph[Any]:
    """The graph of a name.
    """
    if name not in _NAMED:
        raise InputError(f"there is no example {name!r}: give one of {names()}")
    return _NAMED[name]()


def degenerate_names() -> List[str]:
    """The names of the cameras in special places."""
    return sorted(_DEGENERATE)


def degenerate(name: str) -> Tuple[Graph[str], Decided, Dict[str, _Place]]:
    """A graph that is determined at cameras in general position, and is not at the given ones.

    Returns
    -------
    graph : Graph
        The graph.
    model : str
        The model in which that is so.
    places : dict
        For each node its centre (affine: its viewing direction), as decimals.

    Examples
    --------
    >>> import viewcert
    >>> graph, model, places = viewcert.examples.degenerate("square")
    >>> verdict = viewcert.verify(graph, model=model)
    >>> verdict.value, viewcert.at_cameras(verdict, places).determined
    ('solvable', False)
    """
    if name not in _DEGENERATE:
        raise InputError(f"there is no example {name!r}: give one of {degenerate_names()}")
    model, pairs, centres = _DEGENERATE[name]
    places: Dict[str, _Place] = {}
    for line in centres.split(";"):
        node, x, y, z = line.split()
        places[node] = (x, y, z)
    return Graph(_pairs(pairs), name=name), model, places


#: A name, the model, the pairs, and the centres. Sources are in examples/degenerate.
_DEGENERATE: Dict[str, Tuple[Decided, str, str]] = {
    # Affine cameras whose directions are on a cone of degree two.
    "conic": (
        "affine",
        "a-x a-y a-z b-x b-y b-z c-x c-y c-z",
        "a -3 9 1; b -1 1 1; c 2 4 1; x 0 0 1; y 1 1 1; z 4 16 1",
    ),
    # Affine cameras whose directions make two triangles in perspective (Desargues): one triangle can be scaled against the other.
    "desargues": (
        "affine",
        "a-b a-c b-c d-e d-f e-f a-d b-e c-f",
        "a 2 1 1; b -1 3 1; c 1 -2 1; d 4 2 1; e -3 9 1; f 2.5 -5 1",
    ),
    # One flying height: generally finite solvable, and not if all centres are in one plane.
    "k23": (
        "projective",
        "a-x a-y a-z b-x b-y b-z",
        "a 0 0 100; b 50 10 100; x 20 40 100; y 30 -35 100; z 70 60 100",
    ),
    # On one line: three fundamental matrices do not say where the third camera is on it.
    "line": (
        "projective",
        "a-b a-c b-c",
        "a 0 0 0; b 1 2 -1; c 3 6 -3",
    ),
    # In one plane a quadrangle keeps all directions when a side is moved along itself; four directions in space hold it.
    "square": (
        "calibrated",
        "a-b b-c c-d d-a",
        "a 0 0 0; b 4 0 0; c 5 3 0; d -1 2 0",
    ),
    # On one line: with known intrinsics, too, only the order is determined.
    "street": (
        "calibrated",
        "a-b a-c a-d b-c b-d c-d",
        "a 0 0 1.5; b 2.25 0 1.5; c 4 0 1.5; d 7.5 0 1.5",
    ),
}

_COURTYARD = """
2041-2042 2041-2043 2041-2044 2041-2067 2041-2068 2042-2043 2042-2044 2042-2045 2043-2044 2043-2045
2043-2046 2044-2045 2044-2046 2044-2047 2044-2058 2044-2059 2045-2046 2045-2047 2045-2048 2045-2058
2046-2047 2046-2048 2047-2048 2047-2049 2048-2049 2049-2050 2049-2051 2050-2051 2050-2052 2051-2052
2051-2053 2051-2066 2052-2053 2052-2054 2053-2054 2053-2055 2054-2055 2055-2056 2055-2057 2055-2058
2056-2057 2056-2058 2056-2059 2057-2058 2057-2059 2057-2060 2058-2059 2058-2060 2058-2061 2059-2060
2059-2061 2059-2062 2060-2061 2060-2062 2061-2062 2061-2063 2062-2063 2063-2064 2063-2065 2064-2065
2064-2066 2065-2066 2065-2067 2066-2067 2066-2068 2067-2068
"""

_COURTYARD_GAPS = """
2041-2042 2041-2043 2041-2044 2041-2068 2042-2043 2042-2044 2042-2045 2043-2044 2043-2045 2043-2046
2044-2045 2044-2046 2044-2047 2045-2046 2045-2047 2045-2048 2046-2047 2046-2048 2047-2048 2048-2049
2049-2050 2049-2051 2050-2051 2050-2052 2051-2052 2051-2053 2052-2053 2052-2054 2053-2054 2054-2055
2055-2056 2055-2057 2055-2058 2056-2057 2056-2058 2056-2059 2057-2058 2057-2059 2057-2060 2058-2059
2058-2060 2058-2061 2059-2060 2059-2061 2059-2062 2060-2061 2060-2062 2061-2062 2062-2063 2063-2064
2063-2065 2064-2065 2064-2066 2065-2066 2065-2067 2066-2067 2066-2068 2067-2068
"""

_FACADE = """
ring1-ring2 ring1-ring3 ring2-ring3 ring2-ring4 ring3-ring4 ring3-ring5 ring4-ring5 ring4-ring6
ring5-ring6 ring5-ring7 ring6-ring7 ring6-ring8 ring7-ring8 ring7-ring1 ring8-ring1 ring8-ring2
facade1-facade2 facade2-facade3 facade1-facade3 facade1-ring3 facade3-ring6
"""

_PSI = """
0-3 0-5 1-4 1-5 1-6 1-7 1-8 2-4 2-6 3-7 3-8 0-9 2-9 0-10 2-10
"""

_TWO_SOLUTIONS = """
1-3 2-3 1-4 0-5 2-5 4-5 0-6 3-6 0-7 4-7 1-8 2-8
"""
