"""The matrices of the theory at given cameras."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING, Annotated, Any, Literal, Tuple, Union, get_args, overload

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._arguments import flag, one_of
from ._cameras import Cameras, texts_of
from ._graph import as_graph
from ._types import MatrixName

if TYPE_CHECKING:
    import scipy.sparse


@dataclass(frozen=True, eq=False)
class ExactMatrix:
    """A sparse matrix with exact entries."""

    name: Annotated[MatrixName, "Which matrix it is."]
    shape: Annotated[Tuple[int, int], "Rows and columns."]
    row: Annotated[NDArray[np.int64], "The row of each entry, row by row; no entry is zero."] = field(repr=False)
    column: Annotated[NDArray[np.int64], "Its column."] = field(repr=False)
    data: Annotated[NDArray[Any],
        "The entries, of dtype object: `int` where all are integers, and `Fraction` otherwise."] = field(repr=False)

    def to_scipy(self) -> scipy.sparse.csr_array:
        """The matrix for scipy, each entry rounded to the nearest float."""
        import scipy.sparse

        values = np.array([_float(x) for x in self.data], dtype=np.float64)
        return scipy.sparse.coo_array((values, (self.row, self.column)), shape=self.shape).tocsr()

    def toarray(self) -> NDArray[np.object_]:
        """The whole matrix, zeros included, exactly."""
        found = np.full(self.shape, 0, dtype=object)
        found[self.row, self.column] = self.data
        return found

    def to_sympy(self) -> Any:
        """The matrix for sympy, whose `rank` and `nullspace` are exact."""
        import sympy

        places = zip(self.row.tolist(), self.column.tolist())
        entries = {place: sympy.Rational(x.numerator, x.denominator) for place, x in zip(places, self.data)}
        return sympy.SparseMatrix(*self.shape, entries)


def _float(x: Union[int, Fraction]) -> float:
    return x.numerator / x.denominator


@overload
def rigidity_matrix(
    graph: Any, cameras: Cameras, matrix: MatrixName = ..., *, exact: Literal[True]
) -> ExactMatrix: ...
@overload
def rigidity_matrix(
    graph: Any, cameras: Cameras, matrix: MatrixName = ..., *, exact: Literal[False] = ...
) -> scipy.sparse.csr_array: ...
def rigidity_matrix(
    graph: Any, cameras: Cameras, matrix: MatrixName = "J_P", *, exact: bool = False
) -> Any:
    """The matrix whose rank decides at given cameras, as a sparse one of scipy, or exactly.

    Rows follow the pairs of the graph (`Graph.pairs`), columns its nodes (`Graph.nodes`).

    * ``'J_P'``, 10 m x 12 n: the Jacobian of the conditions that each P_j^T F P_i is skew-symmetric, with respect to
      the cameras. Its rank is 11 n - 15 exactly where nothing but the trivial moves. Column ``12 v + 3 c + r``
      belongs to entry (r, c) of camera v.
    * ``'J'``, (10 m + n + 15) x 12 n: the same with rows that fix frame and scales; full rank 12 n, at cameras that
      are not special for that frame.
    * ``'N'``, 2 m x 3 n: parallel rigidity of the centres, for calibrated cameras; full rank 3 n - 4.
    * ``'R'``, m x 2 n: plane directions, for affine cameras; full rank 2 n - 3.

    Parameters
    ----------
    graph
        A verdict, or any graph that :func:`verify` takes.
    cameras
        As of :func:`at_cameras`. 'J_P' and 'J' take matrices, as they are: scaled cameras give scaled rows.
        'N' takes the centres alone, and 'R' the viewing directions (x, y, z), of which it takes (x/z, y/z);
        both may be given by matrices too. Of a file each matrix is the multiple with coprime
        integers.
    exact : bool
        Whether entries are integers or fractions, as an :class:`ExactMatrix`, instead of floats. Floats are these,
        each rounded once.

    Examples
    --------
    >>> import numpy, viewcert
    >>> triangle = [("a", "b"), ("a", "c"), ("b", "c")]
    >>> places = {"a": (0, 0, 0), "b": (1, 0, 0), "c": (0, 1, 0)}
    >>> matrix = viewcert.rigidity_matrix(triangle, places, "N")
    >>> matrix.shape, int(numpy.linalg.matrix_rank(matrix.toarray()))
    ((6, 9), 5)
    >>> viewcert.rigidity_matrix(triangle, places, "N", exact=True).to_sympy().rank()
    5
    """
    one_of("matrix", matrix, get_args(MatrixName))
    given = as_graph(graph)
    model = "affine" if matrix == "R" else "calibrated" if matrix == "N" else "projective"
    texts, width = texts_of(given, cameras, model)
    (rows, columns), (above, below), shape = _native.rigidity_matrix(given._native, matrix, texts, width)
    data = np.empty(len(above), dtype=object)
    if all(text == "1" for text in below):
        data[:] = [int(text) for text in above]
    else:
        data[:] = [Fraction(int(p), int(q)) for p, q in zip(above, below)]
    found = ExactMatrix(
        name=matrix,
        shape=(shape[0], shape[1]),
        row=np.array(rows, dtype=np.int64),
        column=np.array(columns, dtype=np.int64),
        data=data,
    )
    return found if flag("exact", exact) else found.to_scipy()
