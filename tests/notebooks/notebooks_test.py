"""The notebooks of examples/notebooks run from top to bottom, are typed, and are stored without what came out.

Cells run in order in one namespace, without jupyter, figures without a screen. Types are checked by mypy --strict against
those of the package. A fault of each kind, planted, is found.

Usage: notebooks_test.py FOLDER_OF_PACKAGE [unittest options]
"""

import contextlib
import io
import json
import os
import subprocess
import sys
import tempfile
import traceback
import unittest
import warnings
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NOTEBOOKS = sorted((ROOT / "examples/notebooks").glob("*.ipynb"))
MYPY = "/usr/bin/mypy"  # Debian's: another one that comes first knows other packages
# Only what is imported from others may lack types.
CONFIGURATION = """[mypy]
strict = True
follow_imports = silent
[mypy-pandas.*,matplotlib.*]
ignore_missing_imports = True
"""


def code_of(notebook):
    """The sources of the code cells, in order."""
    return ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]


def faults_of_form(notebook):
    """What nbformat 4 asks for, and what must not be stored."""
    if (notebook.get("nbformat"), notebook.get("nbformat_minor")) != (4, 5) or "kernelspec" not in notebook["metadata"]:
        yield "is not of nbformat 4.5"
    ids = [cell.get("id", "") for cell in notebook["cells"]]
    if len(set(ids)) != len(ids) or not all(ids):
        yield "has cells without ids of their own"
    for cell in notebook["cells"]:
        wanted = {"cell_type", "id", "metadata", "source"}
        if cell["cell_type"] == "code":
            wanted |= {"execution_count", "outputs"}
            if cell.get("outputs") or cell.get("execution_count") is not None:
                yield f"holds what cell {cell['id']} has put out"
        if set(cell) != wanted or cell["metadata"] or cell["cell_type"] not in ("code", "markdown"):
            yield f"has a cell {cell['id']} that is not stripped"


def fault_of_run(notebook):
    """The error that ends it, or ""; runs in the current folder."""
    space = {"__name__": "__main__"}
    for number, code in enumerate(code_of(notebook)):
        try:
            # As a shell does: where the last statement is an expression, its value is shown.
            tree = compile(code, f"cell {number}", "exec", flags=0x400)  # an ast
            shown = tree.body.pop().value if type(tree.body[-1]).__name__ == "Expr" else None
            exec(compile(tree, f"cell {number}", "exec"), space)  # pylint: disable=exec-used
            if shown is not None:
                expression = type(compile("0", "", "eval", flags=0x400))(body=shown)
                value = eval(compile(expression, f"cell {number}", "eval"), space)  # pylint: disable=eval-used
                print(repr(value))
        except Exception:  # pylint: disable=broad-except
            return f"cell {number}:\n{traceback.format_exc()}"
    return ""


def type_faults(notebooks, folder):
    """What mypy says of {name: notebook}, by name."""
    for name, notebook in notebooks.items():
        (folder / f"{name}.py").write_text("\n\n".join(code_of(notebook)) + "\n", encoding="utf-8")
    (folder / "mypy.ini").write_text(CONFIGURATION, encoding="utf-8")
    told = subprocess.run([MYPY, "--config-file", "mypy.ini", *(f"{name}.py" for name in notebooks)], cwd=folder, text=True,
                          env=dict(os.environ, MYPYPATH=str(PACKAGE)), check=False, stdout=subprocess.PIPE).stdout
    lines = [line for line in told.splitlines() if ": error: " in line]
    if not lines and "Success" not in told:
        raise AssertionError(told)
    return {name: [line for line in lines if line.startswith(f"{name}.py:")] for name in notebooks}


class NotebooksTest(unittest.TestCase):
    def setUp(self):
        self.notebooks = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in NOTEBOOKS}
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def planted(self, code):
        """A notebook with one more cell."""
        first = json.loads(json.dumps(self.notebooks["first_run"]))
        first["cells"].append({"cell_type": "code", "id": "planted", "metadata": {}, "execution_count": None,
                               "outputs": [], "source": [code]})
        return first

    def run_here(self, notebook):
        """(the error that ends it, warnings, what is printed) in a folder of its own."""
        import matplotlib.pyplot  # pylint: disable=import-outside-toplevel
        before, printed = os.getcwd(), io.StringIO()
        os.chdir(self.folder)
        try:
            with warnings.catch_warnings(record=True) as told, contextlib.redirect_stdout(printed):
                warnings.simplefilter("always")
                fault = fault_of_run(notebook)
        finally:
            os.chdir(before)
            matplotlib.pyplot.close("all")
        return fault, [str(each.message) for each in told if "published values" not in str(each.message)], printed.getvalue()

    def test_there_are_three(self):
        self.assertEqual(sorted(self.notebooks), ["comparison", "first_run", "own_navigator"])
        page = (ROOT / "examples/notebooks/README.md").read_text(encoding="utf-8")
        for path in NOTEBOOKS:
            self.assertIn(path.name, page)

    def test_they_run(self):
        for name, notebook in self.notebooks.items():
            with self.subTest(name):
                fault, told, printed = self.run_here(notebook)
                self.assertEqual(fault, "")
                self.assertEqual(told, [])
                self.assertNotIn(" object at 0x", printed)  # all that is shown can be read

    def test_an_error_is_found(self):
        self.notebooks["first_run"]["cells"] = []
        self.assertIn("ZeroDivisionError", self.run_here(self.planted("1 / 0"))[0])

    def test_they_are_stripped(self):
        for name, notebook in self.notebooks.items():
            with self.subTest(name):
                self.assertEqual(list(faults_of_form(notebook)), [])

    def test_what_is_stored_is_found(self):
        notebook = self.planted("1")
        self.assertEqual(list(faults_of_form(notebook)), [])
        for member, value, fault in (("outputs", [{}], "holds what cell planted has put out"),
                                     ("execution_count", 3, "holds what cell planted has put out"),
                                     ("metadata", {"a": 1}, "has a cell planted that is not stripped"),
                                     ("id", "first-run-0", "has cells without ids of their own")):
            kept = notebook["cells"][-1][member]
            notebook["cells"][-1][member] = value
            self.assertIn(fault, list(faults_of_form(notebook)))
            notebook["cells"][-1][member] = kept
        notebook["nbformat"] = 3
        self.assertEqual(list(faults_of_form(notebook)), ["is not of nbformat 4.5"])

    @unittest.skipUnless(Path(MYPY).exists(), "mypy is not installed")
    def test_they_are_typed(self):
        planted = self.planted('ry.run("nominal", trials="many")')
        found = type_faults({**self.notebooks, "planted": planted}, self.folder)
        self.assertEqual({name: faults for name, faults in found.items() if name != "planted"},
                         {name: [] for name in self.notebooks})
        self.assertEqual(len(found["planted"]), 1, found)
        self.assertIn('"trials"', found["planted"][0])


if __name__ == "__main__":
    PACKAGE = Path(sys.argv.pop(1)).resolve()
    sys.path.insert(0, str(PACKAGE))
    os.environ.update(MPLBACKEND="Agg")
    unittest.main()
