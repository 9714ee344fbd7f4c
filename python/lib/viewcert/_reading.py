"""How files are read."""

from __future__ import annotations

from decimal import Decimal
from typing import Any, Dict, Optional, Sequence, Union, get_args

from ._arguments import flag, listed, one_of, whole_if
from ._errors import InputError
from ._types import Format, Lines, Pipeline


def reading(
    *,
    format: Union[Format, Lines, None] = None,
    variable: Optional[str] = None,
    pipeline: Optional[Pipeline] = None,
    min_inliers: Optional[int] = None,
    min_views: Optional[int] = None,
    max_spread: Optional[int] = None,
    rigs: bool = True,
    columns: Optional[Sequence[Union[str, int]]] = None,
    min_weight: Union[str, int, Decimal, None] = None,
    skip_loops: bool = False,
) -> Dict[str, Any]:
    """How pairs and tracks of a file are read, as the native part takes it."""
    if isinstance(min_weight, float):
        raise InputError(f"min_weight={min_weight!r}: give an integer, a Decimal or a string")
    if pipeline is not None:
        one_of("pipeline", pipeline, get_args(Pipeline))
    return {
        "format": format,
        "variable": variable,
        "pipeline": pipeline,
        "min_inliers": whole_if("min_inliers", min_inliers, 0, 2**32 - 1),
        "min_views": whole_if("min_views", min_views, 1, 2**32 - 1),
        "max_spread": whole_if("max_spread", max_spread, 0, 2**32 - 1),
        "rigs": flag("rigs", rigs),
        "columns": None if columns is None else ",".join(map(str, listed("columns", columns))),
        "min_weight": None if min_weight is None else str(min_weight),
        "skip_loops": flag("skip_loops", skip_loops),
    }
