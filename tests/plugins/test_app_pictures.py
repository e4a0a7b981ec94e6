"""The pictures of models: bodies, springs, dampers and gaps are those of the equations, and each has a description."""

import xml.etree.ElementTree as ET
from dataclasses import dataclass

import pytest

from lostmotion.contracts import Interface, Model, Param
from lostmotion.quantities import DAMPING, INERTIA, LENGTH, STIFFNESS
from lostmotion.registry import default
from lostmotion.written import model_of

pytest.importorskip("panel", reason="no page: Panel is absent (the extra `app`)")

from lostmotion_app.machine_drawing import describe_machine, draw_machine
from lostmotion_app.machine_parts import BASE, GROUND, DrawnElement, find_parts
from lostmotion_app.model_library import ModelLibrary, list_models

MODELS = list_models(default())


def list_elements(model):
    """Return kind, ends, shape and names of each element of a model."""
    return {(one.kind, one.body, one.end, one.shape, one.name, one.length) for one in find_parts(model).elements}


def test_each_element_is_where_the_equations_have_it():
    make = default().make
    assert list_elements(make("model", "lin_backlash")) == {
        ("damper", 0, GROUND, "linear", "c", ""),
        ("spring", 0, GROUND, "linear", "k1", ""),
        ("spring", 0, GROUND, "gap", "k0", "x0"),
    }
    assert list_elements(make("model", "impact_oscillator")) >= {("spring", 0, GROUND, "stop", "k0", "x0")}
    assert list_elements(make("model", "duffing")) >= {("spring", 0, GROUND, "nonlinear", "k3", "")}
    joint = find_parts(make("model", "robot_joint"))
    assert joint.moved
    assert {(one.kind, one.end, one.name) for one in joint.elements} == {
        ("damper", BASE, "c"), ("spring", BASE, "k0"), ("weight", GROUND, "mgl"),
    }  # fmt: skip
    pair = find_parts(make("model", "gear_pair"))
    assert pair.bodies == ("m1", "m2")
    assert {(one.name, one.body, one.end) for one in pair.elements} == {
        ("c1", 0, GROUND), ("c2", 1, GROUND), ("c", 0, 1), ("k0", 0, 1), ("load", 1, GROUND),
    }  # fmt: skip
    assert find_parts(make("model", "dc_motor")).inputs == ("voltage",)


def test_equations_of_a_user_have_a_picture_with_springs_over_a_body():
    lines = (
        "m1*x1'' + k1*x1 + k*(x1 - x2) + k4*(x1 - x3) = force",
        "m2*x2'' + k*(x2 - x1) + c*(x2' - x3') = 0",
        "m3*x3'' + c*(x3' - x2') + stop(x3, k3, d) + k4*(x3 - x1) = 0",
    )
    parts = find_parts(model_of(lines)())
    assert parts.bodies == ("m1", "m2", "m3")
    assert set(parts.elements) == {
        DrawnElement("spring", 0, GROUND, "k1"),
        DrawnElement("spring", 0, 1, "k"),
        DrawnElement("damper", 1, 2, "c"),
        DrawnElement("spring", 2, GROUND, "k3", "stop", "d"),
        DrawnElement("spring", 0, 2, "k4"),
    }
    assert "k4" in draw_machine(parts)


@pytest.mark.parametrize("name", MODELS)
def test_every_model_has_a_picture_with_all_its_elements_and_a_description(name):
    parts = find_parts(default().make("model", name))
    root = ET.fromstring(draw_machine(parts))  # noqa: S314 - the text of this package
    width, height = map(float, root.attrib["viewBox"].split()[2:])
    shown = {one.text: one for one in root.iter("{http://www.w3.org/2000/svg}text")}
    for one in parts.elements:
        assert any(one.name in text for text in shown), one
        assert one.name in root.attrib["aria-label"]
    for one in shown.values():
        assert 0.0 < float(one.attrib["x"]) < width
        assert 0.0 < float(one.attrib["y"]) < height
    assert root.attrib["aria-label"] == describe_machine(parts)
    assert root.attrib["stroke"] == "currentColor"


@dataclass(frozen=True)
class Unwilling(Model):
    """A model whose equations cannot be called, and whose names have to be escaped."""

    name = "unwilling"
    paper = "none"
    motion: str = "translation"
    states = ("position", "velocity")
    inputs = ("force",)
    channels = ("position",)
    params = (
        Param("m<b>", "mass", INERTIA, low=0.0, scale="log"),
        Param("c", "damping", DAMPING),
        Param("k", "stiffness", STIFFNESS),
        Param("gap", "half gap", LENGTH),
    )
    interfaces = (
        Interface(
            "ground", row=1, inertia="m<b>", motion=lambda y, _: y, holds=("k", "gap"), stiffness="k", play="gap"
        ),
    )

    @staticmethod
    def rhs(t, y, u, p, dydt):
        raise RuntimeError("no")

    observe = rhs


def test_a_model_that_cannot_be_probed_is_drawn_as_it_declares_itself():
    parts = find_parts(Unwilling())
    assert parts.elements == (DrawnElement("spring", 0, GROUND, "k", "gap", "gap"),)
    assert parts.others == ("c",)
    drawn = draw_machine(parts)
    assert "<b>" not in drawn
    assert "m&lt;b&gt;" in drawn


def test_a_picture_chooses_its_model():
    chosen = []
    library = ModelLibrary(default(), chosen.append)
    library.switch.value = True
    cards = {card[1].name: card for card in library.pictures}
    assert sorted(cards) == MODELS
    assert "<svg" in cards["gear_pair"][0].object
    cards["gear_pair"][1].clicks += 1
    assert chosen == ["gear_pair"]
    assert not library.pictures.visible
