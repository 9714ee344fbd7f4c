"""A graph that grows says at every time what `verify` says of its pairs."""

import random

import pytest

import viewcert


@pytest.mark.parametrize("model", ["projective", "calibrated", "affine"])
def test_every_prefix_is_verified(model):
    drawn = random.Random(7)
    verifier = viewcert.Verifier(model)
    pairs = [(f"p{k}", f"p{j}") for k in range(9) for j in range(k)]
    drawn.shuffle(pairs)
    told = set()
    for at, pair in enumerate(pairs[:24]):
        verifier.add_pair(*pair)
        verdict = viewcert.verify(pairs[: at + 1], model=model)
        assert verifier.verdict() == (verdict.value, verdict.strength)
        assert sorted(map(sorted, verifier.components())) == sorted(map(sorted, verdict.components))
        for growth in verifier.changed():
            assert told.issuperset(growth.parts)
            told.difference_update(growth.parts)
            told.add(growth.images)
        assert told == {nodes for nodes in verdict.components if len(nodes) > 2}
        together = [nodes for nodes in verdict.components if {"p0", "p1"} <= nodes]
        assert verifier.same_component("p0", "p1") == bool(together)
    assert viewcert.check(verifier.certificate()).value == verdict.value
    assert repr(verifier) == f"<viewcert.Verifier {model}: {len(verifier)} images>"


def test_what_cannot_be_added():
    verifier = viewcert.Verifier()
    with pytest.raises(viewcert.InputError, match="paired with itself"):
        verifier.add_pairs([("a", "b"), ("c", "c")])
    assert len(verifier) == 0 and verifier.components() == []
    with pytest.raises(viewcert.InputError, match="model"):
        viewcert.Verifier("focal")
    assert verifier.same_component("x", "x") and not verifier.same_component("x", "y")
