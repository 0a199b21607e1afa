import copy
import inspect
import pickle
from html.parser import HTMLParser
from pathlib import Path

import h5py
import pytest

import curveflow as cf

HOSTILE = "</div><script>alert(1)</script> \"&' <b>"


def test_shares_add_up_and_name_every_term(membrane: cf.Result):
    why = membrane.why_slow()
    assert why.limit in ("accuracy", "frames")
    assert all(seconds >= 0 for seconds in (*why.seconds.values(), *why.evaluation_seconds.values()))
    assert sum(why.seconds.values()) == pytest.approx(why.total) and why.total > 0
    parts = ("right_hand_sides", "linearisations", "jacobian_products", "checks")
    assert sum(why.evaluation_seconds.values()) == pytest.approx(sum(why.seconds[part] for part in parts))
    assert set(membrane.energy_terms) < set(why.evaluation_seconds)
    assert list(why.seconds.values()) == sorted(why.seconds.values(), reverse=True)
    for name, seconds in why.seconds.items():
        assert membrane.stats[f"seconds_{name}"] == seconds
    stats = membrane.stats
    assert why.krylov_iterations_per_solve == stats["krylov_iterations"] / stats["newton_iterations"]


def test_it_can_be_pickled_and_copied(membrane: cf.Result):
    why = membrane.why_slow()
    for same in (pickle.loads(pickle.dumps(why)), copy.deepcopy(why)):
        assert same == why and str(same) == str(why)
        with pytest.raises(TypeError):
            same.seconds["start"] = 0.0


def test_the_docstring_says_what_every_second_was_spent_on(membrane: cf.Result):
    text = inspect.getsource(cf.WhySlow)
    assert all(f"``{name}``" in text for name in membrane.why_slow().seconds)


def test_it_prints_as_the_sentence_and_the_tables(membrane: cf.Result):
    why = membrane.why_slow()
    text = str(why)
    assert text == repr(why)
    assert why.sentence[1:] in text and f"try: {why.advice}" in text
    assert "energy.agents" in text and "energy.length" in text


def test_the_group_of_the_file_has_the_same_numbers(membrane: cf.Result, tmp_path: Path):
    path = tmp_path / "out.h5"
    membrane.save(path)
    why = membrane.why_slow()
    with h5py.File(path) as file:
        assert dict(file["seconds"].attrs) == why.seconds
        assert dict(file["seconds/evaluations"].attrs) == why.evaluation_seconds
    assert cf.open(path).why_slow() == why


def test_files_that_do_not_say_are_read(membrane: cf.Result, tmp_path: Path):
    path = tmp_path / "out.h5"
    membrane.save(path)
    with h5py.File(path, "a") as file:
        del file["seconds"]
    why = cf.open(path).why_slow()
    assert why.limit == "not-measured"
    assert why.total == 0


def test_a_simulation_says_where_it_stands(circle: cf.Scene):
    simulation = cf.Simulation(circle)
    simulation.run(until=0.1)
    why = simulation.result().why_slow()
    assert why.total > 0
    assert "bending" in why.evaluation_seconds


class Parsed(HTMLParser):
    """Elements of a fragment, checked to be closed in order, and its texts."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.opened: list[str] = []
        self.elements: list[str] = []
        self.texts: list[str] = []
        self.feed(html)
        self.close()
        assert not self.opened

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append(tag)
        self.opened.append(tag)
        assert not any(name.startswith("on") or name in ("src", "href") for name, _ in attrs)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.opened.pop() == tag

    def handle_data(self, data: str) -> None:
        self.texts.append(data)


def test_the_card_shows_the_run(membrane: cf.Result):
    card = Parsed(membrane._repr_html_())
    texts = " ".join(card.texts)
    assert card.elements.count("svg") == 1 and "script" not in card.elements
    for part in (membrane.title, "equilibrium", "fell at every step", "mass of protein off by", "512 nodes", "steps"):
        assert part in texts, part
    assert str(membrane.stats["steps"]) in card.texts


def test_texts_of_the_card_are_escaped(circle: cf.Scene):
    result = cf.run(circle.with_values({"title": HOSTILE}))
    assert result.title == HOSTILE
    card = Parsed(result._repr_html_())
    assert HOSTILE in card.texts
    assert card.elements == Parsed(cf.run(circle)._repr_html_()).elements
