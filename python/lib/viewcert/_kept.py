"""Verdicts that come from another process.

What was found travels: the answer, the components, the report, the certificate. What advice and
pictures need beside that (what the library knows and no text says) is found again where it is first
asked for: the same question, with the same seed, has the same answer, which is compared.
"""

from __future__ import annotations

import os
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._errors import Error
from ._native import Decided as Found
from ._types import Decided, Strength, Value

#: The question: what `_native.decide` is asked, limits apart.
Question = Dict[str, Any]


class Kept:
    """What a native verdict says, as far as it was kept; the rest by deciding again."""

    def __init__(self, graph: _native.Graph, question: Question, said: Dict[str, Any]) -> None:
        self._graph, self._question, self._said = graph, question, said
        self._found: Optional[Found] = None

    @staticmethod
    def said(found: Union[Found, Kept]) -> Dict[str, Any]:
        """All that travels."""
        if isinstance(found, Kept):
            return found._said
        members, ends = found.components()
        return {
            "model": found.model,
            "value": found.value,
            "measured": found.measured,
            "has_own_frame": found.has_own_frame,
            "only_given": found.only_given(),
            "rank": found.rank,
            "required": found.required,
            "seconds": found.seconds,
            "notes": found.notes,
            "parts": found.parts(),
            "displacements": found.displacements(),
            "vectors": found.vectors(),
            "strengths": found.strengths(),
            "components": (members, ends),
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

    @property
    def model(self) -> Decided:
        model: Decided = self._said["model"]
        return model

    @property
    def value(self) -> Value:
        value: Value = self._said["value"]
        return value

    @property
    def measured(self) -> Value:
        value: Value = self._said["measured"]
        return value

    @property
    def has_own_frame(self) -> bool:
        return bool(self._said["has_own_frame"])

    def only_given(self) -> List[int]:
        return list(self._said["only_given"])

    @property
    def rank(self) -> int:
        return int(self._said["rank"])

    @property
    def required(self) -> int:
        return int(self._said["required"])

    @property
    def seconds(self) -> float:
        return float(self._said["seconds"])

    @property
    def notes(self) -> List[str]:
        return list(self._said["notes"])

    def parts(self) -> List[List[int]]:
        return list(self._said["parts"])

    def displacements(self) -> List[List[int]]:
        return list(self._said["displacements"])

    def vectors(self) -> Optional[List[List[Tuple[int, int, int]]]]:
        vectors: Optional[List[List[Tuple[int, int, int]]]] = self._said["vectors"]
        return vectors

    def strengths(self) -> List[Tuple[Strength, Optional[int]]]:
        return list(self._said["strengths"])

    def components(self) -> Tuple[NDArray[np.uint32], NDArray[np.uint64]]:
        # What came over a wire may begin anywhere in a buffer.
        members, ends = (np.require(one, requirements="A") for one in self._said["components"])
        return members, ends

    def component_count(self) -> int:
        return len(self._said["components"][1])

    def certificate(self, *, embed_graph: bool = False, compact: bool = False) -> bytes:
        if not embed_graph and not compact:
            return bytes(self._said["certificate"])
        return self.again().certificate(embed_graph=embed_graph, compact=compact)

    def certificate_of_intrinsics(
        self, classes: List[str], sensors: List[int], *, embed_graph: bool = False
    ) -> bytes:
        again = self.again()
        return again.certificate_of_intrinsics(classes, sensors, embed_graph=embed_graph)

    def report(self, kind: str, *, list_components: bool = False, **question: Any) -> bytes:
        if kind in ("json", "text") and not list_components and not question:
            return bytes(self._said[kind])
        return self.again().report(kind, list_components=list_components, **question)

    def picture(self) -> str:
        return self.again().picture()

    @staticmethod
    def write(path: Union[str, os.PathLike[str]], bytes: bytes) -> None:
        Found.write(path, bytes)
