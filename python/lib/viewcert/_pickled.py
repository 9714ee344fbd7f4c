"""Verdicts that come from another process.

What was found travels: the answer, the components, the report, the certificate. What advice and
pictures need beside that (what the library knows and no text says) is found again where it is first
asked for: the same question, with the same seed, has the same answer, which is compared.
"""

from __future__ import annotations

from typing import Any, Dict, Optional

import numpy as np

from . import _native
from ._errors import Error

#: The question: what `_native.decide` is asked.
Question = Dict[str, Any]


class Pickled:
    """What a native verdict says, as far as it travelled; the rest by deciding again."""

    def __init__(self, graph: _native.Graph, question: Question, said: Dict[str, Any]) -> None:
        self._graph, self._question, self._said = graph, question, said
        self._found: Optional[_native.Decided] = None

    @staticmethod
    def taken(found: Any) -> Dict[str, Any]:
        """All that travels."""
        if isinstance(found, Pickled):
            return found._said
        said: Dict[str, Any] = found.said()
        texts = {kind: found.report(kind) for kind in ("json", "text")}
        return {**said, **texts, "components": found.components(), "certificate": found.certificate()}

    def said(self) -> Dict[str, Any]:
        return self._said

    def components(self) -> Any:
        # What came over a wire may begin anywhere in a buffer.
        return tuple(np.require(one, requirements="A") for one in self._said["components"])

    def again(self) -> _native.Decided:
        """What is decided again, and compared."""
        if self._found is None:
            found = _native.decide(self._graph, self._question["wanted"], self._question["beside"])
            said, again = self._said, found.said()
            same = (again["value"], again["rank"]) == (said["value"], said["rank"])
            if not same or found.certificate() != said["certificate"]:
                raise Error(
                    "this verdict was decided by another version of viewcert, which found other "
                    "evidence; decide the graph again"
                )
            self._found = found
        return self._found

    def __getattr__(self, name: str) -> Any:
        return getattr(self.again(), name)

    def certificate(self, *, embed_graph: bool = False, compact: bool = False) -> bytes:
        if not embed_graph and not compact:
            return bytes(self._said["certificate"])
        return self.again().certificate(embed_graph=embed_graph, compact=compact)

    def report(self, kind: str, *, list_components: bool = False, **question: Any) -> bytes:
        if kind in ("json", "text") and not list_components and not question:
            return bytes(self._said[kind])
        return self.again().report(kind, list_components=list_components, **question)


def found_of(native: Any) -> _native.Decided:
    """A verdict of the native part itself."""
    return native.again() if isinstance(native, Pickled) else native
