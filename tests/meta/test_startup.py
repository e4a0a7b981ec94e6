"""House rules of start-up and size: what loads, how fast, how long the files are, and that hooks are documented."""

import ast
import inspect
import os
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path

import click
import pytest

from lostmotion import hookspecs
from lostmotion.cli import main
from lostmotion.offers import HOOKS
from lostmotion.registry import Registry

ROOT = Path(__file__).parents[2]
HEAVY = (
    "numpy",
    "numba",
    "scipy",
    "xarray",
    "matplotlib",
    "emcee",
    "arviz_stats",
    "pint",
    "h5py",
    "jinja2",
    "tqdm",
    "zarr",
)
LISTING_SECONDS = 0.3
SLOWER_MACHINE = 3.0
"""How much slower than the machine of the promise a test machine may be, its other work included."""


def loaded_after(*args):
    """Return the modules that a command line has loaded when it is done."""
    code = f"import sys; from lostmotion.cli import main; main({list(args)!r}, standalone_mode=False)\n"
    code += "print('\\n'.join(['MODULES', *sys.modules]))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stdout.split("MODULES\n")[-1].split())


@pytest.mark.parametrize("args", [("plugins",), ("plugins", "--json"), ("--help",), ("plugins", "--help")])
def test_listing_loads_nothing_heavy(args):
    loaded = loaded_after(*args)
    assert loaded & {*HEAVY, "lostmotion.contracts", "lostmotion_plugins.terms", "lostmotion_plugins.models"} == set()


def test_help_imports_no_command():
    commands = {target.partition(":")[0] for target, _ in COMMANDS.values()}
    assert loaded_after("--help") & commands == set()


def test_listing_is_fast():
    """The best of a few runs, since other work on the machine only adds."""
    best = min(timed() for _ in range(4))
    assert best < LISTING_SECONDS * SLOWER_MACHINE


def timed():
    start = time.perf_counter()
    subprocess.run([sys.executable, "-m", "lostmotion", "plugins"], capture_output=True, check=True, env=os.environ)
    return time.perf_counter() - start


COMMANDS = main.find_commands(click.Context(main))


@pytest.mark.parametrize("name", list(COMMANDS))
def test_every_command_stands_where_the_table_says(name):
    module, _, attribute = COMMANDS[name][0].partition(":")
    assert attribute in {target for node in tree(Path(find_spec(module).origin)).body for target in bound(node)}


def tree(path):
    return ast.parse(path.read_text(encoding="utf-8"))


def bound(node):
    """Return the names that a statement at the top of a module binds."""
    if isinstance(node, ast.Assign):
        return [t.id for t in node.targets if isinstance(t, ast.Name)]
    return [node.name] if isinstance(node, (ast.FunctionDef, ast.ClassDef)) else []


@pytest.mark.parametrize("hook", list(HOOKS))
def test_every_hook_is_documented(hook):
    doc = inspect.getdoc(getattr(hookspecs, hook))
    assert doc
    assert "package.module:" in doc
    assert f"`{hook}`" in (ROOT / "plugins" / "template" / "README.md").read_text(encoding="utf-8")


def test_hooks_are_those_of_the_specification():
    assert set(HOOKS) == {name for name in vars(hookspecs) if name.startswith("lostmotion_")}


def sources():
    return [p for top in ("framework", "plugins") for p in sorted((ROOT / top).rglob("*.py"))]


@pytest.mark.parametrize("path", sources(), ids=lambda p: str(p.relative_to(ROOT)))
def test_files_are_short(path):
    assert len(path.read_text(encoding="utf-8").splitlines()) <= 400


def test_nothing_is_imported_through_the_folders():
    for path in sources():
        for node in ast.walk(tree(path)):
            names = [a.name for a in node.names] if isinstance(node, ast.Import) else []
            names += [node.module or ""] if isinstance(node, ast.ImportFrom) else []
            assert not [n for n in names if n.split(".")[0] in ("framework", "plugins")], path


def test_the_framework_knows_plugins_by_name_in_one_file_alone():
    """Engines are ours, the proper names of methods are words, and `fixed` is a key of a file."""
    kinds = ("model", "term", "embedder", "quantifier", "surrogate", "denoiser")
    names = {e.name for e in Registry.discover().entries() if e.kind in kinds and e.ours}
    words = {"fixed", "fourier", "aaft", "iaaft"}
    for path in (p for p in sources() if "lostmotion" in p.parts and p.name not in ("defaults.py", "words.py")):
        said = {node.value for node in ast.walk(tree(path)) if isinstance(node, ast.Constant)}
        assert not {word for word in said if isinstance(word, str)} & (names - words), path
