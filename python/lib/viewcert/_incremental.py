"""Pairs that arrive one by one, and the answer at any time."""

from __future__ import annotations

from typing import Any, Dict, FrozenSet, Generic, Iterable, List, NamedTuple, Tuple, cast, get_args

from . import _native
from ._arguments import one_of
from ._errors import InputError
from ._types import Decided, N, Strength, Value
from ._verdict import Verdict, verify


class Growth(NamedTuple):
    """A component with three images and more that has grown."""

    #: Its images.
    images: FrozenSet[Any]
    #: The components with three images and more that have become part of it.
    parts: List[FrozenSet[Any]]


class Verifier(Generic[N]):
    """A viewing graph that grows. The answers are those of :func:`viewcert.verify` for the pairs so far.

    A pair costs microseconds. A question decides what pairs have reached since the last one: nothing in a
    sequence, and as much as :func:`viewcert.verify` near the threshold. :func:`viewcert.limits` limits it.

    Parameters
    ----------
    model
        What is known of the cameras: ``"projective"``, ``"calibrated"`` or ``"affine"``.
    seed
        Seed of all random cameras.

    Examples
    --------
    >>> import viewcert
    >>> verifier = viewcert.Verifier()
    >>> verifier.add_pairs([("a", "b"), ("b", "c"), ("c", "d")])
    >>> verifier.same_component("a", "c")
    False
    >>> verifier.add_pair("a", "c")
    >>> verifier.same_component("a", "c"), verifier.verdict()
    (True, ('not-finite-solvable', 'proof'))
    >>> [sorted(growth.images) for growth in verifier.changed()]
    [['a', 'b', 'c']]
    >>> verifier.add_pair("b", "d")
    >>> viewcert.check(verifier.certificate()).value
    'solvable'
    """

    __slots__ = ("_growing", "_model", "_names", "_numbers", "_seed")

    def __init__(self, model: Decided = "projective", *, seed: int = 1) -> None:
        one_of("model", model, get_args(Decided))
        self._model = model
        self._seed = seed
        self._growing = _native.Growing(model, seed)
        self._names: List[N] = []
        self._numbers: Dict[N, int] = {}

    def add_pair(self, a: N, b: N) -> None:
        """Adds a pair of images. Raises :class:`viewcert.InputError` if an image is paired with itself."""
        self.add_pairs([(a, b)])

    def add_pairs(self, pairs: Iterable[Tuple[N, N]]) -> None:
        """Adds pairs of images. If one is of an image with itself, it raises :class:`viewcert.InputError` and
        adds none."""
        given = [(a, b) for a, b in pairs]
        for a, b in given:
            if a == b:
                raise InputError(f"{a!r} is paired with itself; leave the pair out")
        self._growing.add_pairs([(self._number(a), self._number(b)) for a, b in given])

    def verdict(self) -> Tuple[Value, Strength]:
        """What the pairs so far determine, and how strong the answer is."""
        value, strength = self._growing.verdict()
        return cast(Value, value), cast(Strength, strength.split()[0])

    def components(self) -> List[FrozenSet[N]]:
        """The maximal components, the largest first."""
        return [self._named(nodes) for nodes in self._growing.components()]

    def same_component(self, a: N, b: N) -> bool:
        """Whether two images are in one component. If one body holds both, nothing is decided."""
        if a not in self._numbers or b not in self._numbers:
            return a == b
        return self._growing.same_component(self._numbers[a], self._numbers[b])

    def changed(self) -> List[Growth]:
        """The components with three images and more that have grown since the last call, or since the start."""
        changes = self._growing.changed()
        return [Growth(self._named(nodes), [self._named(part) for part in parts]) for nodes, parts in changes]

    def verified(self) -> Verdict[N]:
        """The verdict on all pairs so far, which it decides from the start."""
        pairs = [(self._names[a], self._names[b]) for a, b in self._growing.pairs()]
        return verify(pairs, model=self._model, seed=self._seed)

    def certificate(self) -> bytes:
        """The certificate of all pairs so far."""
        return self.verified().certificate()

    def __len__(self) -> int:
        """How many images have a pair."""
        return len(self._names)

    def __repr__(self) -> str:
        return f"<viewcert.Verifier {self._model}: {len(self)} images>"

    def _number(self, name: N) -> int:
        number = self._numbers.setdefault(name, len(self._names))
        if number == len(self._names):
            self._names.append(name)
        return number

    def _named(self, nodes: Iterable[int]) -> FrozenSet[N]:
        return frozenset(self._names[node] for node in nodes)
