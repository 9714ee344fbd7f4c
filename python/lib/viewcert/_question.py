"""What may be asked, and what goes together."""

from __future__ import annotations

from typing import Any, Dict, Optional, get_args

from ._arguments import flag, one_of, whole, whole_if
from ._errors import InputError
from ._graph import Graph
from ._types import Counting, Model


def wanted(
    model: str,
    *,
    seed: int,
    planar: bool,
    solutions: Optional[str],
    rational: bool,
    numerator: int,
    denominator: int,
    prime: Optional[int],
    contraction: bool,
    counting: bool,
) -> Dict[str, Any]:
    """What is asked, as the native part takes it.

    Raises
    ------
    InputError
        What cannot be asked, or does not go together.
    """
    one_of("model", model, get_args(Model))
    if solutions is not None and solutions not in get_args(Counting):
        raise InputError(f"solutions={solutions!r}: give 'quick' or 'full', or None, which does not count")
    if flag("planar", planar) and model == "affine":
        raise InputError(
            "planar=True: affine cameras have no centres that could lie in a plane; leave it out"
        )
    bounds = None
    if flag("rational", rational):
        bounds = whole("numerator", numerator, 1, 100), whole("denominator", denominator, 1, 12)
    return {
        "model": model,
        "seed": whole("seed", seed, 0, 2**64 - 1),
        "planar": bool(planar),
        "solutions": solutions,
        "bounds": bounds,
        "prime": whole_if("prime", prime, 5, 2**62 - 1),
        "contraction": flag("contraction", contraction),
        "counting": flag("counting", counting),
    }


def chosen_model(graph: Graph[Any], model: Optional[str]) -> str:
    """The model that is decided, if none is said: calibrated of camera-point graphs.

    Raises
    ------
    InputError
        If it cannot be asked of the graph.
    """
    points = graph.cameras is not None
    if points and model not in (None, "calibrated"):
        raise InputError(
            "observations are directions of known rotations, which only the calibrated model has; "
            f"leave out model={model!r}"
        )
    return model or ("calibrated" if points else "projective")
