"""Mappings and arrays of results: read-only, and so are their copies and pickles."""

import copy
import json
import pickle
from collections.abc import Callable, Mapping
from dataclasses import asdict
from typing import Any

import numpy as np
import pandas as pd
import pytest

import curveflow as cf


def pickled(value: Any) -> Any:
    return pickle.loads(pickle.dumps(value))


COPIES = [pickled, copy.copy, copy.deepcopy]
CHANGES: list[Callable[[Any], object]] = [
    lambda mapping: mapping.__setitem__("time", 0),
    lambda mapping: mapping.__delitem__(next(iter(mapping))),
    lambda mapping: mapping.__ior__({"time": 0}),
    lambda mapping: mapping.update(time=0),
    lambda mapping: mapping.setdefault("time", 0),
    lambda mapping: mapping.pop("time", None),
    lambda mapping: mapping.popitem(),
    lambda mapping: mapping.clear(),
]


@pytest.fixture(scope="module")
def result() -> cf.Result:
    """A run that has something in every mapping."""
    scene = cf.Scene.shipped("membrane_penalty")
    return cf.run(scene.with_values({"time.end": 1e-3, "output.frames": 3, "output.fields": ["normal-force"]}))


@pytest.fixture(scope="module")
def rates(result: cf.Result) -> cf.Rates:
    density = {name: rho[-1] for name, rho in result.density.items()}
    return cf.flow_map(result.curvature[-1], result.metric[-1], result.normal_velocity[-1], density)


@pytest.fixture(scope="module")
def mappings(result: cf.Result, rates: cf.Rates) -> dict[str, Mapping[str, Any]]:
    names = ("stats", "density", "mass", "energy_terms", "fields", "diagnostics", "steps")
    why = result.why_slow()
    return {name: getattr(result, name) for name in names} | {
        "state": cf.Simulation(result.scene).state.density,
        "rates": rates.density,
        "seconds": why.seconds,
        "evaluation_seconds": why.evaluation_seconds,
        "errors": cf.tradeoff(cf.Scene.shipped("circle"), [1e-2]).errors,
    }


def assert_same(left: Any, right: Any) -> None:
    if isinstance(left, Mapping):
        assert list(left) == list(right)
        for key, value in left.items():
            assert_same(value, right[key])
    else:
        np.testing.assert_array_equal(left, right)


@pytest.mark.parametrize("copied", [lambda value: value, *COPIES])
def test_mappings_and_their_copies_refuse_changes(mappings: dict[str, Any], copied: Callable[[Any], Any]):
    for name, mapping in mappings.items():
        assert mapping, name
        same = copied(mapping)
        for change in CHANGES:
            with pytest.raises(TypeError, match="read-only"):
                change(same)
        assert_same(same, mapping)
        for value in same.values():
            assert not isinstance(value, np.ndarray) or not value.flags.writeable, name


def test_a_copy_by_dict_can_be_changed(result: cf.Result):
    for mine in (dict(result.stats), result.stats.copy(), result.stats | {}):  # type: ignore[attr-defined,operator]
        mine["steps"] = 0
        assert type(mine) is dict
    assert result.stats["steps"] > 0


def test_mappings_are_dicts_to_others(result: cf.Result):
    steps = pd.DataFrame(result.steps)
    assert list(steps.columns) == list(result.steps) and len(steps) == result.stats["steps"]
    np.testing.assert_array_equal(steps["energy"], result.steps["energy"])
    assert json.loads(json.dumps(result.stats)) == result.stats


@pytest.mark.parametrize("copied", COPIES)
def test_objects_of_arrays_stay_read_only(result: cf.Result, rates: cf.Rates, copied: Callable[[Any], Any]):
    for given in (cf.geometry(result.position[-1]), rates, cf.Simulation(result.scene).state):
        same = copied(given)
        assert type(same) is type(given)
        assert_same(asdict(same), asdict(given))
        for name in asdict(given):
            value = getattr(same, name)
            for array in value.values() if isinstance(value, Mapping) else [value]:
                assert not isinstance(array, np.ndarray) or not array.flags.writeable, name
