"""What may be asked, and what goes together."""

from __future__ import annotations

from typing import Any, ContextManager, Dict, Optional, Tuple, get_args

from ._arguments import flag, one_of, whole, whole_if
from ._arguments import limits as bounds_of
from ._errors import InputError
from ._graph import Graph
from ._limits import limits
from ._types import Counting, MemoryLimit, Model, Progress, TimeLimit


def asked(
    *,
    model: Optional[Model] = None,
    seed: int = 1,
    planar: bool = False,
    solutions: Optional[Counting] = "quick",
    rational: bool = False,
    prime: Optional[int] = None,
    contraction: bool = True,
    counting: bool = True,
    time_limit: TimeLimit = None,
    memory_limit: MemoryLimit = None,
    progress: Progress = None,
) -> Tuple[Dict[str, Any], ContextManager[None]]:
    """A question as the native part takes it, and what it is asked within."""
    if model is not None:
        one_of("model", model, get_args(Model))
    if solutions is not None and solutions not in get_args(Counting):
        raise InputError(f"solutions={solutions!r}: give 'quick' or 'full', or None, which does not count")
    if flag("planar", planar) and model == "affine":
        raise InputError(
            "planar=True: affine cameras have no centres that could lie in a plane; leave it out"
        )
    wanted = {
        "model": model or "projective",
        "seed": whole("seed", seed, 0, 2**64 - 1),
        "planar": bool(planar),
        "solutions": solutions,
        "rational": flag("rational", rational),
        "prime": whole_if("prime", prime, 5, 2**62 - 1),
        "contraction": flag("contraction", contraction),
        "counting": flag("counting", counting),
    }
    seconds, memory = bounds_of(time_limit, memory_limit)
    return wanted, limits(time_limit=seconds, memory_limit=memory, progress=progress)


def beside(
    parts: Any = None, displacements: Any = None, vectors: Any = None, one_frame: bool = False
) -> Dict[str, Any]:
    """What is known of a graph besides its pairs, as the native part takes it."""
    return {"parts": parts, "displacements": displacements, "vectors": vectors, "one_frame": one_frame}


def chosen_model(graph: Graph[Any], model: Optional[str]) -> str:
    """The model that is decided, if none is named: calibrated of camera-point graphs."""
    points = graph.cameras is not None
    if points and model not in (None, "calibrated"):
        raise InputError(
            "observations are directions of known rotations, which only the calibrated model has; "
            f"leave out model={model!r}"
        )
    return model or ("calibrated" if points else "projective")
