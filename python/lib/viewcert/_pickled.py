"""Verdicts that come from another process.

What was found travels: the answer, the components, the report, the certificate. What advice and
pictures need beside that (what the library knows and no text says) is found again where it is first
asked for: the same question, with the same seed, has the same answer, which is compared.
"""

from __future__ import annotations

from typing import Any, Dict, Optional, Union

import numpy as np

from . import _native
from ._errors import Error
from ._native import Decided as Found

#: The question: what `_native.decide` is asked.
Question = Dict[str, Any]

#: What a native verdict has, and what its methods say without arguments.
_MEMBERS = ("model", "value", "measured", "has_own_frame", "rank", "required", "seconds", "notes")
_METHODS = ("only_given", "parts", "displacements", "vectors", "strengths", "components", "component_count")


class Pickled:
    """What a native verdict says, as far as it travelled; the rest by deciding again."""

    def __init__(self, graph: _native.Graph, question: Question, said: Dict[str, Any]) -> None:
        # What came over a wire may begin anywhere in a buffer.
        members, ends = (np.require(one, requirements="A") for one in said["components"])
        self._graph, self._question, self._said = graph, question, {**said, "components": (members, ends)}
        self._found: Optional[Found] = None

    @staticmethod
    def said(found: Union[Found, Pickled]) -> Dict[str, Any]:
        """All that travels."""
        if isinstance(found, Pickled):
            return found._said
        return {
            **{name: getattr(found, name) for name in _MEMBERS},
            **{name: getattr(found, name)() for name in _METHODS},
            "certificate": found.certificate(),
            "json": found.report("json"),
            "text": found.report("text"),
        }

    def again(self) -> Found:
        """What is decided again, and compared."""
        if self._found is None:
            question = dict(self._question)
            found = _native.decide(self._graph, question.pop("wanted"), **question)
            said = self._said
            same = (found.value, found.rank) == (said["value"], said["rank"])
            if not same or found.certificate() != said["certificate"]:
                raise Error(
                    "this verdict was decided by another version of viewcert, which found other "
                    "evidence; decide the graph again"
                )
            self._found = found
        return self._found

    def __getattr__(self, name: str) -> Any:
        if name in _METHODS:
            return lambda: self._said[name]
        return self._said[name] if name in _MEMBERS else getattr(self.again(), name)

    def certificate(self, *, embed_graph: bool = False, compact: bool = False) -> bytes:
        if not embed_graph and not compact:
            return bytes(self._said["certificate"])
        return self.again().certificate(embed_graph=embed_graph, compact=compact)

    def report(self, kind: str, *, list_components: bool = False, **question: Any) -> bytes:
        if kind in ("json", "text") and not list_components and not question:
            return bytes(self._said[kind])
        return self.again().report(kind, list_components=list_components, **question)


def found_of(native: Union[Found, Pickled]) -> Found:
    """A verdict of the native part itself."""
    return native.again() if isinstance(native, Pickled) else native
