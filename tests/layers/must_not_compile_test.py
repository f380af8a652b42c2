"""What the compiler refuses, with the include paths that each module is really compiled with.

Usage: must_not_compile_test.py COMPILER INCLUDE_PATHS
INCLUDE_PATHS has one line per module: its name and its include directories, separated by tabs.
"""

import os
import subprocess
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
from layers.rules import read_rules  # noqa: E402  (the path comes first)

COMPILER = ""
INCLUDE_PATHS = {}


def read_include_paths(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    return {fields[0]: fields[1:] for fields in (line.split("\t") for line in lines if line)}


def compile_source(module, arguments, source=None):
    """Runs the compiler on a file or a text, syntax only, as part of `module`."""
    includes = [f"-I{directory}" for directory in INCLUDE_PATHS[module] if directory]
    command = [COMPILER, "-std=c++20", "-fsyntax-only", "-x", "c++", *includes, *arguments]
    return subprocess.run([*command, "-"] if source is not None else command, input=source, text=True,
                          capture_output=True, check=False, env={**os.environ, "LC_ALL": "C"})


def headers_of(module):
    src = ROOT / "src"
    return [path.relative_to(src).as_posix() for path in sorted((src / module).rglob("*.h"))]


def reachable(rules, module):
    """The folders that `module` may include, and what their headers may include in turn.

    Parameter headers may use messages (a sensor's geometry is a calibration) and no other folder.
    """
    reached, todo = set(), [module]
    if module in rules.params_only:
        todo.append("messages")
    while todo:
        folder = todo.pop()
        if folder not in reached:
            reached.add(folder)
            if folder not in rules.params_only or folder == module:
                todo += rules.allowed[folder]
    return reached


class CheatingNavigator(unittest.TestCase):
    """The same file, with and without one include."""

    def compile_navigator(self, *arguments):
        return compile_source("navigation", [*arguments, str(HERE / "navigator.cc")])

    def test_control_compiles(self):
        result = self.compile_navigator()
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_control_may_include_messages(self):
        result = self.compile_navigator('-DCHEAT_HEADER="messages/estimates.h"')
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_terrain_does_not_compile(self):
        self.check_refused("terrain/terrain.h")

    def test_truth_does_not_compile(self):
        self.check_refused("truth/rover_state.h")

    def check_refused(self, header):
        self.assertTrue((ROOT / "src" / header).is_file(), f"{header} is gone: name another one")
        result = self.compile_navigator(f'-DCHEAT_HEADER="{header}"')
        self.assertNotEqual(result.returncode, 0, f"a navigator could include {header}")
        self.assertRegex(result.stderr, rf"{header}.*(No such file|file not found)")


class UnstatedTraits(unittest.TestCase):
    """A navigator that leaves open what it reads, costs or tolerates."""

    STATED = {"reads": "LookReading::kPoints", "cost": "CostOfLook{}", "goal": "GoalTolerance{}"}

    def compile_traits(self, names):
        members = ", ".join(self.STATED[name] for name in names)
        return compile_source("navigation", [], f"""
            #include "navigation/navigator_traits_params.h"
            namespace rockyard::navigation {{
            NavigatorTraits Traits() {{ return {{{members}}}; }}
            }}""")

    def test_control_compiles(self):
        result = self.compile_traits(self.STATED)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_none_may_be_left_out(self):
        for left_out in self.STATED:
            with self.subTest(left_out=left_out):
                result = self.compile_traits([name for name in self.STATED if name != left_out])
                self.assertNotEqual(result.returncode, 0)
                self.assertIn("NavigatorTraits", result.stderr)


class CheatingSources(unittest.TestCase):
    """Real sources that decide on board, as they are and with one include more."""

    # Module, and where in it.
    PLACES = (("navigation", "gestalt"), ("localization", "."))
    HEADERS = ("terrain/terrain.h", "truth/rover_state.h", "rover/rover.h",
               "rendering/image_scene.h", "sensing/stereo_sensor.h", "trial/drive.h")

    def sources(self):
        for module, folder in self.PLACES:
            found = sorted((ROOT / "src" / module / folder).glob("*.cc"))
            self.assertGreaterEqual(len(found), 4, f"where has {module}/{folder} gone?")
            yield from ((module, source) for source in found)

    def test_control_compiles(self):
        for module, _ in self.PLACES:
            sources = [source for of, source in self.sources() if of == module]
            # At once, for the headers that they share. Names of a module do not clash: its library is built
            # of joined sources, too.
            joined = "".join(f'#include "{source}"\n' for source in sources)
            with self.subTest(module=module):
                result = compile_source(module, [], joined)
                self.assertEqual(result.returncode, 0, result.stderr)

    def test_no_source_reaches_terrain_truth_or_sensors(self):
        for header in self.HEADERS:
            self.assertTrue((ROOT / "src" / header).is_file(), f"{header} is gone")
        for module, source in self.sources():
            for header in self.HEADERS:
                with self.subTest(source=source.name, header=header):
                    result = compile_source(module, ["-include", header, str(source)])
                    self.assertNotEqual(result.returncode, 0)
                    self.assertRegex(result.stderr, rf"{header}.*(No such file|file not found)")


class CheatingEyes(unittest.TestCase):
    """On-board code and the renderer, whose scene is the true terrain."""

    HEADERS = ("rendering/image_scene.h", "rendering/row_renderer.h", "rendering/imager_params.h")

    def compile_include(self, module, header):
        return compile_source(module, [], f'#include "{header}"\n')

    def test_control_sensing_may_render(self):
        every = "".join(f'#include "{header}"\n' for header in self.HEADERS)
        result = compile_source("sensing", [], every)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_control_on_board_code_may_include_cameras(self):
        for module, header in (("vision", "vision/lens.h"), ("perception", "vision/lens.h"),
                               ("navigation", "messages/camera.h")):
            with self.subTest(module=module):
                result = self.compile_include(module, header)
                self.assertEqual(result.returncode, 0, result.stderr)

    def test_no_on_board_code_renders(self):
        for module in ("vision", "perception", "localization", "navigation"):
            for header in self.HEADERS:
                with self.subTest(module=module, header=header):
                    result = self.compile_include(module, header)
                    self.assertNotEqual(result.returncode, 0, f"{module} could include {header}")
                    self.assertRegex(result.stderr, rf"{header}.*(No such file|file not found)")


class Reach(unittest.TestCase):
    """Every module sees the headers that the table of src/README.md allows, and no other.

    A header that may be included brings what it includes itself, so this is the closure of the
    table (behind scenario, of the parameters alone); for navigation and perception the closure is the
    table. scripts/check_layers.py checks the table itself.
    """

    def visible(self, module, headers):
        """Which of `headers` code of `module` can include."""
        probe = "".join(f'#if __has_include("{header}")\n#warning sees {header}\n#endif\n'
                        for header in headers)
        result = compile_source(module, [], probe)
        self.assertEqual(result.returncode, 0, result.stderr)
        return {header for header in headers if f"sees {header}" in result.stderr}

    def test_no_module_sees_beyond_the_table(self):
        rules = read_rules(ROOT / "src" / "README.md")
        modules = [folder for folder in rules.allowed if (ROOT / "src" / folder).is_dir()]
        for module in INCLUDE_PATHS:
            allowed = reachable(rules, module)
            # Parameters are composed of others', and bring these.
            brought = {other for gate in allowed & rules.params_only for other in reachable(rules, gate)}
            forbidden = [header for other in modules if other not in allowed
                         for header in headers_of(other)
                         if other not in brought or not header.endswith("_params.h")]
            if module in rules.params_only:
                forbidden += [header for other in allowed - {module, "core", "math", "messages"}
                              for header in headers_of(other) if not header.endswith("_params.h")]
            with self.subTest(module=module):
                self.assertEqual(self.visible(module, forbidden), set())

    def test_modules_see_themselves_and_core(self):
        for module in INCLUDE_PATHS:
            wanted = headers_of(module) + headers_of("math")
            with self.subTest(module=module):
                self.assertEqual(self.visible(module, wanted), set(wanted))

    def test_on_board_modules_reach_messages_and_images_only(self):
        rules = read_rules(ROOT / "src" / "README.md")
        common = {"messages", "core", "math"}
        self.assertEqual(reachable(rules, "vision"), common | {"vision"})
        for module, more in (("navigation", set()), ("localization", set()), ("perception", {"vision"})):
            self.assertIn(module, INCLUDE_PATHS)
            self.assertEqual(reachable(rules, module), common | more | {module})


if __name__ == "__main__":
    COMPILER = sys.argv[1]
    INCLUDE_PATHS = read_include_paths(Path(sys.argv[2]))
    unittest.main(argv=sys.argv[:1], verbosity=2)
