import sys
from dataclasses import MISSING, fields
from typing import Any

import jsonschema
import pytest
from family import FAMILY, choices, fields_of

import curveflow as cf
from curveflow import _curveflow
from curveflow.model.curve import CURVES
from curveflow.model.energy import TERMS

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

SCHEMA = cf.schema()
VALIDATOR = jsonschema.Draft7Validator(SCHEMA)
TEXTS = dict(_curveflow.shipped())
KEYS = SCHEMA["properties"]
ENERGY = KEYS["energy"]["properties"]

# Each class with the alternatives of its table in the schema.
TABLES: list[tuple[type, list[dict[str, Any]]]] = [
    (cf.Scene, [SCHEMA]),
    (cf.Density, [KEYS["density"]["items"]]),
    (cf.Flow, [KEYS["flow"]]),
    (cf.Switch, [KEYS["flow"]["properties"]["switch"]["items"]]),
    (cf.Time, [KEYS["time"]]),
    (cf.Accuracy, [KEYS["accuracy"]]),
    (cf.Output, KEYS["output"]["anyOf"]),
    *((term, ENERGY[term.name].get("anyOf", [ENERGY[term.name]])) for term in TERMS),
    *(
        (curve, [t for t in KEYS["curve"]["anyOf"] if t["properties"]["shape"]["const"] == curve.shape])
        for curve in CURVES
    ),
]


def test_the_schema_is_one():
    jsonschema.Draft7Validator.check_schema(SCHEMA)
    assert SCHEMA["$schema"] == "http://json-schema.org/draft-07/schema#"
    cf.schema().clear()
    assert cf.schema() == SCHEMA


@pytest.mark.parametrize("name", cf.scenes())
def test_shipped_scenes_are_valid(name: str):
    VALIDATOR.validate(tomllib.loads(TEXTS[name]))


@pytest.mark.parametrize("scene", FAMILY.values(), ids=FAMILY)
def test_scenes_of_objects_are_valid(scene: cf.Scene):
    VALIDATOR.validate(tomllib.loads(scene.to_toml()))
    VALIDATOR.validate(tomllib.loads(cf.Scene(**fields_of(scene)).text))


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("rigidity = 1.0", "rigidty = 1.0"),
        ("rigidity = 1.0", ""),
        ("rigidity = 1.0", "rigidity = -1.0"),
        ("rigidity = 1.0", 'rigidity = "1.0"'),
        ("[energy.bending]", "[energy.bendng]"),
        ("[energy.bending]\nrigidity = 1.0", "[energy]"),
        ('"ellipse"', '"elipse"'),
        ('"ellipse"', '"circle"'),
        ("[1.6, 0.8]", "[1.6]"),
        ("[1.6, 0.8]", "[1.6, 0.0]"),
        ("[1.6, 0.8]", "[1.6, 0.8]\nturning_number = 2"),
        ('"curved"\ninitial', '"kappa"\ninitial'),
        ('"curved"\ninitial', '"2curved"\ninitial'),
        ('"curved"\ninitial', '"curved_sigma"\ninitial'),
        ('"diffusion"', '"difusion"'),
        ('"diffusion"', '"diffusion"\nweight = 0'),
        ("epsilon = 0.1", "epsilon = 0"),
        ("target_ratio = 1.0", ""),
        ("target_ratio = 1.0", "target_ratio = 1.0\ntarget = 6.3"),
        ("target_ratio = 1.0", "target_ratio = 1.0\ntension = 1.0"),
        ("end = 10.0", "end = 0"),
        ("end = 10.0", "end = 10.0\nmax_steps = 0"),
        ("end = 10.0", "end = 10.0\nequilibrium_tolerance = 0.1"),
        ("end = 10.0", "end = 10.0\nstop_at_equilibrium = 1"),
        ("tolerance = 1e-5", "tolerance = 1e-12"),
        ('nodes = "auto"', "nodes = 7"),
        ('nodes = "auto"', 'nodes = "many"'),
        ("frames = 200", "frames = 0"),
        ("frames = 200", "frames = 200\ntimes = [1.0]"),
        ("frames = 200", 'frames = 200\nfields = ["force"]'),
        ('spacing = "log"', 'spacing = "exp"'),
        ('spacing = "log"', 'spacing = "log"\n[flow]\ngauge = "garded"'),
        ('spacing = "log"', 'spacing = "log"\n[[flow.switch]]\ntime = -1\ngauge = "graded"\ngrading = 1'),
        ('spacing = "log"', 'spacing = "log"\n[extra]'),
    ],
)
def test_seeded_mistakes_are_found(before: str, after: str):
    good = TEXTS["blend"].replace("stop_at_equilibrium = true\n", "")
    VALIDATOR.validate(tomllib.loads(good))
    assert before in good
    text = good.replace(before, after, 1)
    assert not VALIDATOR.is_valid(tomllib.loads(text))
    with pytest.raises(cf.SceneError):
        cf.Scene.parse(text)


def test_every_table_has_a_class():
    assert {term.name for term in TERMS} == set(ENERGY)
    shapes = {table["properties"]["shape"]["const"] for table in KEYS["curve"]["anyOf"]}
    assert {curve.shape for curve in CURVES} == shapes
    assert set(cf.__all__) >= {cls.__name__ for cls, _ in TABLES}


@pytest.mark.parametrize(("cls", "tables"), TABLES, ids=[cls.__name__ for cls, _ in TABLES])
def test_keys_and_defaults_are_those_of_the_schema(cls: type, tables: list[dict[str, Any]]):
    held = {field.name: field for field in fields(cls) if field.init}
    keys = {key: schema for table in tables for key, schema in table["properties"].items() if key != "shape"}
    assert set(held) == set(keys)
    needed = [set(table.get("required", ())) - {"shape"} for table in tables]
    assert {name for name, field in held.items() if field.default is MISSING} == set.intersection(*needed)
    if cls in (cf.Scene, cf.Output):  # theirs are objects, and depend on other keys
        return
    for name, field in held.items():
        if field.default is not MISSING:
            listed = keys[name].get("type") == "array" and name not in set.union(*needed)
            default = keys[name].get("default", () if listed else None)
            assert field.default == default, name
            assert type(field.default) is type(default), name


@pytest.mark.parametrize(("cls", "tables"), TABLES, ids=[cls.__name__ for cls, _ in TABLES])
def test_names_are_those_of_the_schema(cls: type, tables: list[dict[str, Any]]):
    for key, schema in (item for table in tables for item in table["properties"].items() if item[0] != "shape"):
        if key in ("curve", "energy") and cls is cf.Scene:  # tables, not values
            continue
        alternatives = schema.get("items", schema)
        alternatives = alternatives.get("oneOf", alternatives.get("anyOf", []))
        assert choices(cls, key) == tuple(choice["const"] for choice in alternatives if "const" in choice), key
