"""What the compiler refuses, with the include paths that each module is really compiled with.

Usage: must_not_compile_test.py COMPILER INCLUDE_PATHS
INCLUDE_PATHS has one line per module: its name and its include directories, separated by tabs.
"""

import os
import re
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
            else:
                todo += rules.params_only[folder]  # what it may include whole, its headers may name
    return reached


class UnstatedTraits(unittest.TestCase):
    """A navigator that leaves open what it reads, costs or tolerates."""

    GIVEN = ("LookReading", "DecisionCost", "GoalTolerance")

    def test_none_may_be_left_out(self):
        fewer = [", ".join(name for name in self.GIVEN if name != left_out) for left_out in self.GIVEN]
        result = compile_source("navigation", [], f"""
            #include "navigation/navigator_traits_params.h"
            namespace rockyard::navigation {{
            template <class... Given>
            constexpr bool kSuffice = requires(Given... given) {{ NavigatorTraits{{given...}}; }};
            static_assert(kSuffice<{", ".join(self.GIVEN)}>);
            {"".join(f"static_assert(!kSuffice<{names}>);" for names in fewer)}
            }}""")
        self.assertEqual(result.returncode, 0, result.stderr)


class CheatingSources(unittest.TestCase):
    """What decides on board, as it is and with one include more: a navigator, and a source of localization. Include
    paths belong to a module, so that one source stands for all."""

    SOURCES = (("navigation", HERE / "navigator.cc"), ("localization", ROOT / "src/localization/aid_fixes.cc"))
    HEADERS = ("terrain/terrain.h", "truth/rover_state.h", "rover/rover.h",
               "rendering/image_scene.h", "sensing/stereo_sensor.h", "trial/drive/drive.h")

    def test_control_compiles(self):
        for module, source in self.SOURCES:
            result = compile_source(module, [str(source)])
            self.assertEqual(result.returncode, 0, result.stderr)

    def test_none_reaches_terrain_truth_or_sensors(self):
        for module, source in self.SOURCES:
            for header in self.HEADERS:
                with self.subTest(source=source.name, header=header):
                    self.assertTrue((ROOT / "src" / header).is_file(), f"{header} is gone: name another one")
                    result = compile_source(module, ["-include", header, str(source)])
                    self.assertNotEqual(result.returncode, 0, f"{module} could include {header}")
                    self.assertRegex(result.stderr, rf"{header}.*(No such file|file not found)")


class SidesOfADrive(unittest.TestCase):
    """World, rover and referee of src/trial: what stands in the world knows no belief, what runs on board no truth."""

    ON_BOARD = [path for name in ("drive/onboard", "drive/vehicle_guard", "sight/stripe_reader", "sight/stereo_reader",
                                  "sight/visual_reader", "sight/terrain_sensing", "aids/aid_suite", "aids/visual_aid")
                for path in (name + ".h", name + ".cc")] + ["sight/look.h", "aids/slip_alarms.h"]
    WORLD = [path for name in ("drive/world", "drive/aid_sensors", "eyes/stripe_eyes", "eyes/stereo_eyes",
                               "eyes/visual_eyes", "eyes/rover_cameras")
             for path in (name + ".h", name + ".cc")] + ["eyes/terrain_sensor.h"]

    TRUTH = r"\bstate\(\)|\bX_WR\b|RoverState|Terrain\b"
    BELIEF = r"\bestimate\(\)|\bPoseEstimate\b|\bEstimator\b|\bRemember\("

    def names(self, side, *files):
        """Those of `files` whose code, comments apart, names a side."""
        texts = ((name, (ROOT / "src/trial" / name).read_text(encoding="utf-8")) for name in files)
        return [name for name, text in texts if re.search(side, re.sub("//.*", "", text))]

    def test_only_those_who_referee_name_truth_and_belief(self):
        self.assertEqual(self.names(self.TRUTH, *self.ON_BOARD), [])
        self.assertEqual(self.names(self.BELIEF, *self.WORLD), [])
        self.assertEqual(self.names(self.BELIEF, "drive/drive.h", "drive/drive.cc", "drive/drive_looks.cc"), [])

    def included(self, file):
        """What a source of trial includes, with what these include in turn."""
        result = compile_source("trial", ["-MM", str(ROOT / "src/trial" / file)])
        self.assertEqual(result.returncode, 0, result.stderr)
        return {word.split("/src/")[-1].split("/include/")[-1] for word in result.stdout.split()}

    def test_what_runs_on_board_includes_no_truth(self):
        truth = re.compile(r"(^|/)(terrain/terrain|truth/rover_state|rover/rover|trial/drive/world)\.h$")
        for file in self.ON_BOARD:
            with self.subTest(file=file):
                self.assertEqual([name for name in self.included(file) if truth.search(name)], [])
        self.assertTrue(any(truth.search(name) for name in self.included("drive/world.cc")))

    def test_control_they_do(self):
        referees = ("drive/drive_observer.cc", "drive/drive_tracer.cc", "drive/operators.h")
        for side in (self.TRUTH, self.BELIEF):
            self.assertEqual(self.names(side, *referees), list(referees))

    def test_a_part_says_what_it_does_when_the_rover_is_put_down(self):
        for body, compiles in (("void OnPlaced() {}", True), ("", False)):
            result = compile_source("trial", [], f"""
                #include "trial/drive/part_set.h"
                struct Part {{ {body} }};
                void Placed(rockyard::trial::PartSet<Part>& parts) {{ parts.OnPlaced(); }}""")
            self.assertEqual(result.returncode == 0, compiles, result.stderr)


class Reach(unittest.TestCase):
    """Every module sees the headers that the table of src/README.md allows, and no other.

    A header that may be included brings what it includes itself, so this is the closure of the
    table (behind scenario, of the parameters alone); for navigation and perception the closure is the
    table. scripts/check_layers.py checks the table itself.
    """

    # The renderer's scene is the true terrain.
    RENDERING = {"rendering/image_scene.h", "rendering/row_renderer.h", "rendering/imager_params.h"}

    def visible(self, module, headers):
        """Which of `headers` code of `module` can include."""
        probe = "".join(f'#if __has_include("{header}")\n#warning sees {header}\n#endif\n' for header in headers)
        result = compile_source(module, [], probe)
        self.assertEqual(result.returncode, 0, result.stderr)
        return {header for header in headers if f"sees {header}" in result.stderr}

    def test_on_board_modules_see_cameras_and_no_renderer(self):
        for module, camera in (("vision", "vision/lens.h"), ("perception", "vision/lens.h"),
                               ("localization", "messages/camera.h"), ("navigation", "messages/camera.h")):
            with self.subTest(module=module):
                self.assertEqual(self.visible(module, self.RENDERING | {camera}), {camera})
        self.assertEqual(self.visible("sensing", self.RENDERING), self.RENDERING)

    def test_no_module_sees_beyond_the_table(self):
        rules = read_rules(ROOT / "src" / "README.md")
        modules = [folder for folder in rules.allowed if (ROOT / "src" / folder).is_dir()]
        for module in INCLUDE_PATHS:
            allowed = reachable(rules, module)
            # Parameters are composed of others', and bring these.
            brought = {other for gate in allowed & rules.params_only.keys() for other in reachable(rules, gate)}
            forbidden = [header for other in modules if other not in allowed
                         for header in headers_of(other)
                         if other not in brought or not header.endswith("_params.h")]
            if module in rules.params_only:
                whole = {other for gate in rules.params_only[module] for other in reachable(rules, gate)}
                forbidden += [header for other in allowed - {module, "core", "math", "messages"} - whole
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
