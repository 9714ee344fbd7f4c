"""Answers as values: dataclasses of what the native part says, whose attributes are described where they stand."""

from __future__ import annotations

import ast
import inspect
from dataclasses import fields
from typing import Any, Dict, Literal, Mapping, NoReturn, Type, TypeVar, get_args, get_origin

from . import _types

_T = TypeVar("_T")


class Frozen:
    """What cannot be changed, and so need not be copied."""

    __slots__ = ()

    def _keep(self, name: str, value: object) -> None:
        """Remembers what follows from the rest and was asked for."""
        object.__setattr__(self, name, value)

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"a {type(self).__name__} cannot be changed: {name}")

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"a {type(self).__name__} cannot be changed: {name}")

    def __copy__(self: _T) -> _T:
        return self

    def __deepcopy__(self: _T, memo: Dict[int, Any]) -> _T:
        return self


def described(kind: Any) -> None:
    """Lists in the documentation of a dataclass what ``Annotated`` says of its attributes."""
    lines = []
    for one in fields(kind):
        annotation = ast.parse(str(one.type), mode="eval").body
        if isinstance(annotation, ast.Subscript) and ast.unparse(annotation.value) == "Annotated":
            of, text = annotation.slice.elts  # type: ignore[attr-defined]
            named = ast.unparse(of)
            words = getattr(_types, named, None)
            if get_origin(words) is Literal:
                named = f"{{{', '.join(map(repr, get_args(words)))}}}"
            lines += [f"{one.name} : {named}", f"    {text.value}"]
    if lines:
        kind.__doc__ = "\n".join([inspect.cleandoc(kind.__doc__), "", "Attributes", "----------", *lines])


def of_said(kind: Type[_T], said: Mapping[str, Any], **given: Any) -> _T:
    """A dataclass of members that are called as its attributes, lists as tuples; `given` goes before."""
    members: Dict[str, Any] = {one.name: said[one.name] for one in fields(kind) if one.name in said}  # type: ignore[arg-type]
    tuples = {name: tuple(value) if isinstance(value, list) else value for name, value in members.items()}
    return kind(**{**tuples, **given})
