"""What is compiled depends on what a plugin does, and not on how it was loaded; fields of a term reach its kernel."""

import json
import subprocess
import sys
from dataclasses import dataclass

import numpy as np
import pytest

from lostmotion.contracts import Param, Term
from lostmotion.errors import ContractError
from lostmotion.likelihood.plan import make_law
from lostmotion.likelihood.system import System
from lostmotion.quantities import FORCE
from lostmotion.testing import check
from lostmotion_plugins.models.basic import RigidDrive

PLUGIN = '''
import math
from dataclasses import dataclass

from lostmotion.contracts import Param, Term
from lostmotion.quantities import FORCE, LENGTH

TURN = 2.0 * math.pi


def wave(x, pitch):
    return math.sin(TURN * x / pitch)


@dataclass(frozen=True)
class Ratchet(Term):
    """A force that pulls a motor from pole to pole."""

    at: str = "ground"
    name = "ratchet"
    physics = "Ratchet of {force}, from pole to pole over {pitch}, acts"
    formula = "-force * sin(2 pi x / pitch)"
    paper = "Zhu, Howe, IEEE Trans. Energy Conversion 15 (2000) 407-412"
    params = (
        Param("force", "largest ratchet force", FORCE, null=0.0),
        Param("pitch", "travel from pole to pole", LENGTH, low=0.0, scale="log"),
    )

    @staticmethod
    def force(t, x, v, u, p, s):
        return -p[0] * wave(x, p[1])


if __name__ == "__main__":
    import told

    told.told(Ratchet)
'''
TOLD = """
import json
import numpy as np
from lostmotion.likelihood.drive import Drive
from lostmotion.likelihood.system import System
from lostmotion_plugins.models.basic import RigidDrive

def told(term):
    system = System(RigidDrive(), (term(),))
    full = system.vector({"m": 2.0, "c": 10.0, "ratchet.force": 3.0, "ratchet.pitch": 0.15})
    drive = Drive.smooth([lambda t: 20.0 * np.cos(8.0 * t)], 0.005, 200)
    states = system.simulate(full, system.everything, np.array([0.01, 0.0]), drive, 4).states
    print(json.dumps([term.__module__, states[-1].tolist()]))
"""
WAYS = {
    "a plugin file": "from lostmotion.registry import Registry; import told; from pathlib import Path; "
    "told.told(type(Registry.discover().add_file(Path('my_terms.py')).make('term', 'ratchet')))",
    "an import": "import told, my_terms; told.told(my_terms.Ratchet)",
    "a program": "import runpy; runpy.run_path('my_terms.py', run_name='__main__')",
}


def said(folder, way):
    """Return the module under which a term was loaded in one of the ways, and the end of its motion."""
    done = subprocess.run(
        [sys.executable, "-c", WAYS[way]], cwd=folder, capture_output=True, text=True, check=False,
        env={**__import__("os").environ, "LOSTMOTION_CACHE": str(folder / "cache"), "PYTHONPATH": str(folder)},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.slow
def test_a_plugin_file_loaded_under_three_names_shares_one_cache_and_one_answer(tmp_path):
    (tmp_path / "my_terms.py").write_text(PLUGIN)
    (tmp_path / "told.py").write_text(TOLD)
    modules, ends, kept = [], [], []
    for way in WAYS:
        module, end = said(tmp_path, way)
        modules.append(module)
        ends.append(end)
        kept.append(
            {
                p.name: p.stat().st_mtime_ns
                for p in (tmp_path / "cache").rglob("lostmotion_kernel*")
                if p.suffix != ".pyc"
            }
        )
    assert len(set(modules)) == 3
    assert ends[0] == ends[1] == ends[2]
    assert kept[0] == kept[1] == kept[2]


@dataclass(frozen=True)
class Step(Term):
    """A constant force, of a size in units of `steps`, beyond the place `edge`."""

    at: str = "ground"
    steps: int = 2
    edges: tuple[float, ...] = (0.1, 0.3)
    name = "step"
    physics = "A force of {force}"
    formula = "force * steps where x > edge"
    paper = "Nobody (2000)"
    params = (Param("force", "force", FORCE, null=0.0),)

    def force(self, t, x, v, u, p, s):
        total = 0.0
        for edge in self.edges:
            if x > edge:
                total += self.steps * p[0]
        return total


@dataclass(frozen=True)
class Prepared(Step):
    """The same force, with the product computed once for each point."""

    name = "prepared"

    def prepared(self, p):
        return self.steps * p

    def force(self, t, x, v, u, p, s):
        return p[0] if x > self.edges[0] else 0.0


@dataclass(frozen=True)
class Empty(Term):
    """Reads fields that it does not have."""

    at: str = "ground"
    name = "empty"
    physics = "A force of {force}"
    formula = "force"
    paper = "Nobody (2000)"
    params = (Param("force", "force", FORCE, null=0.0),)

    def force(self, t, x, v, u, p, s):
        return p[0]


def pushed(term, x):
    """Return the force of a term of size 3 N at `x`, by its compiled kernel."""
    system = System(RigidDrive(), (term,))
    full = system.vector({"m": 1.0, "c": 0.0, f"{term.name}.force": 3.0})
    rates, _ = system.compute_derivatives(
        system.everything, system.pack(full[None], 1e-3), np.array([[x, 0.0]]), np.zeros((1, 1))
    )
    return rates[0, 1]


def test_fields_of_a_term_reach_its_kernel():
    assert [pushed(Step(), x) for x in (0.0, 0.2, 0.4)] == [0.0, 6.0, 12.0]
    assert [pushed(Step(steps=5, edges=(0.2,)), x) for x in (0.1, 0.4)] == [0.0, 15.0]
    assert [pushed(Prepared(steps=4), x) for x in (0.0, 0.2)] == [0.0, 12.0]


@pytest.mark.parametrize("term", [Step, Prepared])
def test_terms_that_read_their_fields_pass_the_kit(term):
    assert [str(f) for f in check(term) if not f.ok] == []


def test_a_method_without_fields_and_a_prepared_law_with_a_step_are_refused():
    with pytest.raises(ContractError, match="none that are numbers"):
        make_law(Empty(), 0)
    stepped = type("Stepped", (Prepared,), {"needs": ("step",)})
    with pytest.raises(ContractError, match="prepares its numbers"):
        make_law(stepped(), 0)
