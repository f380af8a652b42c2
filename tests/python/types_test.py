#!/usr/bin/env python3
"""Types and words of the package: mypy finds nothing, stubs name exactly what is there, all that is public says what it is.

Usage: types_test.py ROCKYARD PLUGINS [unittest's arguments]
"""

import ast
import importlib
import inspect
import os
import pkgutil
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import package
import rockyard as ry
from rockyard import _core, navigator

PACKAGE = Path(ry.__file__).parent
HERE = Path(__file__).parent
MODULES = sorted({each.name for each in pkgutil.iter_modules([str(PACKAGE)])} - {"_core"})
MYPY = "/usr/bin/mypy"  # of Debian, which knows the types of Debian's NumPy


def mypy(cache, *words):
    environment = {**os.environ, "MYPYPATH": str(PACKAGE.parent)}
    environment.pop("PYTHONPATH", None)
    return subprocess.run([MYPY, "--config-file", HERE / "mypy.ini", "--cache-dir", cache, *words], capture_output=True, text=True,
                          env=environment, check=False)


def stub(name):
    """Returns what a stub names: of each class its members, of each function how many parameters it has."""
    found = {}
    for node in ast.parse((PACKAGE / name).read_text()).body:
        if isinstance(node, ast.ClassDef):
            found[node.name] = {each.target.id if isinstance(each, ast.AnnAssign) else each.name: each for each in node.body
                                if isinstance(each, (ast.FunctionDef, ast.AnnAssign))}
        elif isinstance(node, ast.FunctionDef):
            found[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = node
    return found


def parameters(function):
    """Returns how many parameters the compiled function has, by the signature that it states."""
    signature = re.match(r"\w+\((.*)\) ->", function.__doc__.split("\n")[0])[1]
    flat = re.sub(r"\[[^][]*\]", "", re.sub(r"\[[^][]*\]", "", re.sub(r"\[[^][]*\]", "", signature)))
    return len([each for each in flat.split(", ") if ":" in each])


def public(owner):
    return {name for name in dir(owner) if not name.startswith("_")}


class Types(unittest.TestCase):
    @unittest.skipUnless(os.path.exists(MYPY), "mypy is not there")
    def test_mypy_finds_nothing_but_what_is_planted(self):
        """In the package, and in a user's program; and it would find wrong uses."""
        program = """
import rockyard as ry
from rockyard.environment import Environment, forward
from rockyard.navigator import Navigator, drive, parameter

class Mine(Navigator):
    name = "mine"
    parameters = [parameter("goal_tolerance_m", "real", 0.3, "arrives within")]
    def decide(self, input: object) -> dict[str, object]:
        return drive(0.1, until_distance_m=self.p.goal_tolerance_m)

run: ry.Run = ry.run("nominal", trials=3, set={"rover.fidelity": "quasi_static"}, deciders=[Mine])
rate: float = run.true_success.rate
cells: ry.Sweep = ry.sweep({"name": "a", "axes": []})
first: ry.Run = cells[0]
seen, reward, terminated, truncated, info = Environment("nominal").step(forward(0.1))
height: object = run.trial(0).place.height(1.0, 2.0)
"""
        wrong = {"int(ry.run)": "No overload|incompatible type", 'ry.run(trials="3")': "incompatible type|Missing positional",
                 "run.no_such_member": "has no attribute", "first: ry.Sweep = ry.load('x')": "already defined|Incompatible types"}
        with tempfile.TemporaryDirectory() as folder:
            cache, mine = Path(folder, "cache"), Path(folder, "mine.py")
            done = mypy(cache, "-p", "rockyard")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            mine.write_text(program)
            done = mypy(cache, str(mine))
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            mine.write_text(program + "\n".join(wrong))
            told = mypy(cache, str(mine)).stdout
            for number, text in enumerate(wrong.values(), 1 + program.count("\n")):
                self.assertRegex(told, rf"mine\.py:{number}: error: .*({text})")

    def test_the_stub_names_what_is_compiled(self):
        told = stub("_core.pyi")
        self.assertEqual(set(told), public(_core))
        for name, members in told.items():
            there = getattr(_core, name)
            if not isinstance(members, dict):
                if isinstance(members, ast.FunctionDef):
                    self.assertEqual(len(members.args.args), parameters(there), name)
                continue
            self.assertEqual({each for each in members if each != "__init__"}, public(there), name)
            for member, node in members.items():
                function = getattr(there, member)
                if isinstance(node, ast.FunctionDef) and not isinstance(function, property):
                    static = any(isinstance(each, ast.Name) and each.id == "staticmethod" for each in node.decorator_list)
                    self.assertEqual(len(node.args.args), parameters(function), f"{name}.{member}, {static}")

    def test_the_package_uses_what_is_compiled(self):
        text = "".join(path.read_text(encoding="utf-8") for path in PACKAGE.glob("*.py"))
        unused = [name for name in stub("_core.pyi") if f"_core.{name}" not in text]
        self.assertEqual(unused, ["end_work"])  # which the interpreter calls as it ends

    def test_the_stub_of_navigators_names_what_is_there(self):
        told = stub("navigator.pyi")
        self.assertEqual(set(told), public(navigator) - {"base64", "json", "struct", "traceback"})
        for name, members in told.items():
            if isinstance(members, dict):
                there = public(getattr(navigator, name))
                annotated = {"p", "goal", "own", "uses"} if name == "Navigator" else set()
                own = {each for each in there if not hasattr(dict, each)} - {"uses"}
                self.assertEqual({each for each in members if not each.startswith("_")} - annotated, own - annotated, name)
            else:
                self.assertEqual([each.arg for each in members.args.args + members.args.kwonlyargs],
                                 [each.name for each in inspect.signature(getattr(navigator, name)).parameters.values()
                                  if each.kind != inspect.Parameter.VAR_KEYWORD], name)


class Words(unittest.TestCase):
    def members(self):
        """Yields the public functions, classes, and members of classes, with their names."""
        for name in ("__init__", *MODULES):
            module = importlib.import_module("rockyard" if name == "__init__" else f"rockyard.{name}")
            yield module.__name__, module
            for member in public(module):
                made = getattr(module, member)
                if not (inspect.isfunction(made) or inspect.isclass(made)) or not made.__module__.startswith("rockyard"):
                    continue
                yield f"{made.__module__}.{member}", made
                for each, value in vars(made).items() if inspect.isclass(made) else ():
                    value = getattr(value, "func", value)  # of a cached property
                    if not each.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
                        yield f"{made.__module__}.{member}.{each}", value

    def test_all_that_is_public_says_what_it_is(self):
        silent = sorted({name for name, made in self.members() if not self.words(made)})
        self.assertEqual(silent, [])
        self.assertGreater(len(dict(self.members())), 150)

    @staticmethod
    def words(made):
        """Returns its docstring; one that is made for a dataclass or a named tuple says nothing."""
        text = made.__doc__ or ""
        generated = inspect.isclass(made) and text.startswith(f"{made.__name__}(")
        return "" if generated else text

    def test_all_names_what_is_there(self):
        self.assertEqual(sorted(ry.__all__), sorted(set(ry.__all__)))
        for name in ry.__all__:
            self.assertTrue(hasattr(ry, name), name)
        imported = {name for name in public(ry) if not inspect.ismodule(getattr(ry, name))} - {"annotations"}
        self.assertEqual(imported | {"plot"}, set(ry.__all__))
        with self.assertRaises(AttributeError):
            ry.no_such_name

    def test_the_package_is_typed(self):
        self.assertTrue((PACKAGE / "py.typed").exists())


if __name__ == "__main__":
    package.main()
