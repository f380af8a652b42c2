"""Each kind of violation, planted in a small tree that is otherwise in order, must be reported."""

import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import check_layers  # noqa: E402  (the path comes first)
from layers import rules as layer_rules  # noqa: E402

README = """# Map

| folder | may also include |
|---|---|
| core | |
| math | |
| messages | |
| truth | messages |
| terrain | |
| rover | truth, terrain |
| navigation | messages |
| scenario | terrain, navigation (only their `*_params.h`) |
| batch | scenario |
| web | |

2. **Heavy libraries stay in the `.cc` files of one folder**: Bullet in rover, OpenMP and SQLite in
   batch, nlohmann-json in core's archive.
3. **Parameters** live with their module.
4. **One hash on every processor.** Of the functions of the C library
   only web and batch
   may call them.
"""

FILES = {
    "core/check.h": "#pragma once\n#include <string>\n",
    "core/archive.cc": '#include "core/check.h"\n#include <nlohmann/json.hpp>\n',
    "math/pose.h": "#pragma once\n#include <Eigen/Core>\n",
    "messages/commands.h": '#pragma once\n#include "math/pose.h"\n',
    "truth/state.h": '#pragma once\n#include "messages/commands.h"\n',
    "terrain/terrain.h": '#pragma once\n#include "core/check.h"\n',
    "terrain/terrain_params.h": '#pragma once\n#include "core/check.h"\n',
    "rover/bullet_rover.cc": '#include "truth/state.h"\n#include "rover/part_shapes.h"\n'
                             "#include <btBulletDynamicsCommon.h>\n",
    "rover/part_shapes.h": '#pragma once\n#include "terrain/terrain.h"\n',
    "rover/multibody/wheel.h": '#pragma once\n#include "rover/part_shapes.h"\n',
    "rover/multibody/wheel.cc": '#include "rover/multibody/wheel.h"\n',
    "rover/quasi_static/balance.h": '#pragma once\n#include "rover/multibody/wheel.h"\n',
    "navigation/pathfinder/pathfinder.h": '#pragma once\n#include "messages/commands.h"\n',
    "navigation/pathfinder/pathfinder_params.h": '#pragma once\n#include "core/check.h"\n',
    "scenario/scenario.h": '#pragma once\n#include "terrain/terrain_params.h"\n'
                           '#include "navigation/pathfinder/pathfinder_params.h"\n#include "core/check.h"\n',
    "batch/store.cc": '#include "scenario/scenario.h"\n#include <omp.h>\n#include <sqlite3.h>\n'
                      "#pragma omp parallel\n",
    "web/page.cc": "#include <string>\n",
    "web/shared/dom.ts": "export type Child = Node | string;\n",
    "web/report/main.ts": 'import { type Child } from "../shared/dom";\nimport * as Plot from "plot";\n'
                          'import "./report.css";\n',
}

PATHFINDER = "navigation/pathfinder/pathfinder.h:3"  # a line more
LINKS = {
    "truth": "DEPENDS messages", "rover": "DEPENDS truth terrain PRIVATE_LIBRARIES PkgConfig::BULLET",
    "navigation": "DEPENDS messages", "scenario": "DEPENDS core PARAMS_OF terrain navigation",
    "batch": "DEPENDS scenario PRIVATE_LIBRARIES OpenMP::OpenMP_CXX",
}


class Tree:
    """A source tree in a temporary folder."""

    def __init__(self, folder):
        self.root = Path(folder)
        self.write("README.md", README)
        for name, text in FILES.items():
            self.write(name, text)
        for folder in {name.split("/")[0] for name in FILES}:
            self.write(f"{folder}/README.md", "what it is\n")
            self.link(folder, LINKS.get(folder, ""))

    def write(self, name, text):
        path = self.root / "src" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def write_source(self, name, text):
        """Writes a .cc file and lists it."""
        self.write(name, text)
        folder = name.split("/")[0]
        self.link(folder, LINKS.get(folder, ""))

    def add_line(self, name, line):
        path = self.root / "src" / name
        path.write_text(path.read_text(encoding="utf-8") + line + "\n", encoding="utf-8")

    def link(self, folder, arguments):
        """Writes the CMakeLists.txt of a module with all of its sources."""
        place = self.root / "src" / folder
        sources = sorted(path.relative_to(place).as_posix() for path in place.rglob("*.cc"))
        lines = "".join(f"    {source}\n" for source in sources)
        self.write(f"{folder}/CMakeLists.txt", f"rockyard_module({folder}\n  SOURCES\n{lines}  {arguments})\n")

    def replace(self, name, old, new):
        text = (self.root / "src" / name).read_text(encoding="utf-8")
        assert old in text, f"{name} has no {old}"
        self.write(name, text.replace(old, new))

    def violations(self):
        return check_layers.check_tree(self.root)[0]


class InATree(unittest.TestCase):
    def setUp(self):
        self.tree = Tree(self.enterContext(tempfile.TemporaryDirectory()))

    def assert_caught(self, where, why):
        """Exactly one violation, at the planted place, for the planted reason."""
        found = self.tree.violations()
        self.assertEqual(len(found), 1, found)
        self.assertIn(where, found[0])
        self.assertIn(why, found[0])

    def assert_in_order(self):
        self.assertEqual(self.tree.violations(), [])


class PlantedViolations(InATree):
    def test_control_tree_is_in_order(self):
        self.assert_in_order()

    def test_includes_that_none_may_have(self):
        for place, line, why in (
                (PATHFINDER, '#include "terrain/terrain.h"', "navigation may not include terrain"),
                (PATHFINDER, '  #  include "truth/state.h"', "navigation may not include truth"),
                (PATHFINDER, '#include "../terrain/terrain.h"', "never with .."),
                (PATHFINDER, '#include "core/../terrain/terrain.h"', "never with .."),
                (PATHFINDER, "#include <terrain/terrain.h>", 'included with "..."'),
                (PATHFINDER, '#include "pathfinder_params.h"', "no folder of the table"),
                (PATHFINDER, '#include "messages/gone.h"', "no such header"),
                (PATHFINDER, '#if __has_include("terrain/terrain.h")', "__has_include"),
                ("scenario/scenario.h:5", '#include "terrain/terrain.h"', "only *_params.h of terrain")):
            with self.subTest(place=place, line=line):
                self.setUp()
                self.tree.add_line(place.split(":")[0], line)
                self.assert_caught(f"src/{place}", why)

    def test_heavy_library_in_a_header_of_its_folder(self):
        self.tree.write("core/archive.h", "#pragma once\n#include <nlohmann/json.hpp>\n")
        self.assert_caught("src/core/archive.h:2", "nlohmann-json stays in .cc files")

    def test_heavy_library_in_a_header_that_no_other_folder_may_include(self):
        self.tree.write("rover/bullet_rover.h", "#pragma once\n#include <btBulletDynamicsCommon.h>\n")
        self.assert_in_order()

    def test_libraries_out_of_their_folders(self):
        for name, text, why in (
                ("terrain/mesh.cc", "#include <bullet/LinearMath/btVector3.h>\n", "Bullet belongs to rover"),
                ("core/cache.cc", "#include <sqlite3.h>\n", "SQLite belongs to batch"),
                ("terrain/rays.cc", "#include <embree3/rtcore.h>\n", "gives Embree to no folder"),
                ("terrain/image.cc", "#include <opencv2/core.hpp>\n", "does not list"),
                ("terrain/loop.cc", "#pragma omp parallel for\n", "OpenMP belongs to batch")):
            with self.subTest(name=name):
                self.setUp()
                self.tree.write_source(name, text)
                self.assert_caught(f"src/{name}:1", why)

    def test_link_beyond_the_table(self):
        self.tree.link("navigation", "DEPENDS messages terrain")
        self.assertTrue(any("DEPENDS terrain" in line for line in self.tree.violations()))

    def test_link_past_the_function(self):
        self.tree.add_line("navigation/CMakeLists.txt",
                           "target_link_libraries(rockyard_navigation PRIVATE rockyard_truth)")
        self.assert_caught("src/navigation/CMakeLists.txt", "names rockyard_truth")

    def test_parameters_folder_links_a_whole_module(self):
        self.tree.link("scenario", "DEPENDS core terrain PARAMS_OF navigation")
        self.assert_caught("src/scenario/CMakeLists.txt", "parameters only")

    def test_heavy_library_linked_elsewhere(self):
        self.tree.link("terrain", "PRIVATE_LIBRARIES PkgConfig::BULLET")
        self.assert_caught("src/terrain/CMakeLists.txt", "links Bullet")

    def test_folder_that_is_not_in_the_table(self):
        self.tree.write("cloud/README.md", "new\n")
        self.tree.link("cloud", "")
        self.assert_caught("src/cloud", "not in the table")

    def test_folder_without_a_readme(self):
        (self.tree.root / "src/terrain/README.md").unlink()
        self.assert_caught("src/terrain", "has no README.md")

    def test_source_file_outside_every_folder(self):
        self.tree.write("main.cc", "int main() {}\n")
        self.assert_caught("src/main.cc", "belong to a folder")

    def test_file_over_the_limit(self):
        self.tree.write_source("terrain/long.cc", "\n" * (check_layers.MAX_LINES + 1))
        self.assert_caught("src/terrain/long.cc", "601 lines")

    def assert_one(self, where, why):
        """Among the violations there is exactly one of this kind at this place."""
        found = [line for line in self.tree.violations() if where in line and why in line]
        self.assertEqual(len(found), 1, self.tree.violations())

    def test_row_with_an_arrow_up(self):
        self.tree.replace("README.md", "| terrain | |", "| terrain | truth, rover |")
        self.tree.add_line("terrain/terrain.h", '#include "truth/state.h"')
        self.assert_caught("src/README.md", "terrain may include rover, whose row stands above")

    def test_math_of_the_first_row_may_not_include_core(self):
        self.tree.replace("README.md", "| core | |\n| math | |", "| math | |\n| core | |")
        self.assert_in_order()
        self.tree.add_line("math/pose.h", '#include "core/check.h"')
        self.assert_caught("src/math/pose.h:3", "math may not include core")

    def test_row_that_allows_too_much(self):
        self.tree.replace("README.md", "| navigation | messages |", "| navigation | messages, truth |")
        self.assert_caught("src/README.md", "navigation may include truth, which nothing there includes")

    def test_row_of_no_folder(self):
        self.tree.replace("README.md", "| batch |", "| rendering | |\n| batch |")
        self.assert_caught("src/README.md", "a row for rendering, which is no folder")

    def test_circle_of_modules(self):
        self.tree.replace("README.md", "| messages | |", "| messages | truth |")
        self.tree.write("messages/seen.h", '#pragma once\n#include "truth/state.h"\n')
        self.assert_one("src/README.md", "messages may include truth, whose row stands above")
        self.assert_one("src/messages/seen.h", "circle of modules messages -> truth -> messages")
        self.assertEqual(len(self.tree.violations()), 2)

    def test_circle_of_rooms(self):
        self.tree.write("rover/multibody/solver.h", '#pragma once\n#include "rover/quasi_static/ground.h"\n')
        self.tree.write("rover/quasi_static/ground.h", "#pragma once\n")
        self.assert_caught("src/rover/multibody/solver.h",
                           "circle of rooms rover/multibody -> rover/quasi_static -> rover/multibody")

    def test_circle_of_typescript_by_types_alone(self):
        self.tree.add_line("web/shared/dom.ts", 'export type { Page } from "../report/page";')
        self.tree.write("web/report/page.ts", 'import type { X } from "./parts";\n')
        self.tree.write("web/report/parts/index.ts", 'const x = await import("../../shared/dom");\n')
        self.assert_caught("src/web/report/page.ts", "import cycle web/report/page.ts -> "
                           "web/report/parts/index.ts -> web/shared/dom.ts -> web/report/page.ts")

    def test_source_that_is_not_compiled(self):
        self.tree.write("navigation/pathfinder/turn.cc", "#include <cmath>\n")
        self.assert_caught("src/navigation/CMakeLists.txt", "pathfinder/turn.cc is in no list")

    def test_source_of_a_room_listed_without_its_room(self):
        self.tree.replace("rover/CMakeLists.txt", "multibody/wheel.cc", "wheel.cc")
        self.assert_one("src/rover/CMakeLists.txt", "lists wheel.cc, which is no file")
        self.assert_one("src/rover/CMakeLists.txt", "multibody/wheel.cc is in no list")

    def test_source_in_a_comment_is_not_listed(self):
        self.tree.replace("rover/CMakeLists.txt", "multibody/wheel.cc", "# multibody/wheel.cc")
        self.assert_caught("src/rover/CMakeLists.txt", "multibody/wheel.cc is in no list")

    def test_file_of_tests_that_is_not_compiled(self):
        tests = self.tree.root / "tests/rover"
        (tests / "room").mkdir(parents=True)
        (tests / "room/wheel_test.cc").touch()
        (tests / "helper.cc").touch()
        self.assert_caught("tests/rover/room/wheel_test.cc", "in no list of rover/CMakeLists.txt")
        lists = tests / "CMakeLists.txt"
        lists.write_text("rockyard_test(rover_test UNIT room/wheel_test.cc)\n", encoding="utf-8")
        self.assert_in_order()
        lists.write_text("rockyard_test(rover_test\n  UNIT\n    wheel_test.cc)\n", encoding="utf-8")
        self.assert_caught("tests/rover/room/wheel_test.cc", "in no list of rover/CMakeLists.txt")

    def test_source_listed_twice(self):
        self.tree.add_line("core/CMakeLists.txt", "add_executable(tool archive.cc)")
        self.assert_caught("src/core/CMakeLists.txt", "lists archive.cc 2 times")

    def test_two_sources_on_a_line(self):
        self.tree.replace("rover/CMakeLists.txt", "bullet_rover.cc\n", "bullet_rover.cc")
        self.assert_one("src/rover/CMakeLists.txt", "SOURCES bullet_rover.cc: one file a line")
        self.assert_one("src/rover/CMakeLists.txt", "SOURCES multibody/wheel.cc: one file a line")

    def test_link_that_no_include_needs(self):
        self.tree.link("terrain", "DEPENDS core math")
        self.assert_caught("src/terrain/CMakeLists.txt", "DEPENDS math: nothing in terrain includes it")

    def test_parameters_that_no_include_needs(self):
        self.tree.replace("scenario/scenario.h", "navigation/pathfinder/pathfinder_params.h", "core/check.h")
        self.assert_one("src/README.md", "scenario may include navigation, which nothing there includes")
        self.assert_one("src/scenario/CMakeLists.txt", "PARAMS_OF navigation: nothing in scenario includes")

    def test_cycle_of_three_headers(self):
        for name, other in (("a", "b"), ("b", "c"), ("c", "a")):
            self.tree.write(f"terrain/{name}.h", f'#pragma once\n#include "terrain/{other}.h"\n')
        self.assert_caught("terrain/a.h", "include cycle terrain/a.h -> terrain/b.h -> terrain/c.h")

    def test_elementary_functions_of_the_c_library(self):
        for line in ("double a = std::sin(1.0);", "double a = std::hypot(1.0, 2.0);", "auto a = std::expint(1.0);",
                     "Eigen::AngleAxisd a;", "auto a = p.slerp(0.5, q);"):
            with self.subTest(line=line):
                self.tree.write_source("rover/plus.cc", f"\n{line}\n")
                self.assert_caught("src/rover/plus.cc:2", "its bits depend on the processor")
        self.tree.write_source("rover/plus.cc", "double a = std::sqrt(2.0) + math::Sin(1.0);  // no std::sin\n")
        self.tree.write_source("web/plus.cc", "double a = std::sin(1.0);\n")
        self.assertEqual(self.tree.violations(), [])


class NoFalseAlarm(InATree):
    def test_includes_in_comments_do_not_count(self):
        self.tree.add_line("navigation/pathfinder/pathfinder.h", '// #include "terrain/terrain.h"')
        self.tree.add_line("navigation/pathfinder/pathfinder.h", '/*\n#include "truth/state.h"\n*/')
        self.assert_in_order()

    def test_file_at_the_limit(self):
        self.tree.write_source("terrain/long.cc", "\n" * check_layers.MAX_LINES)
        self.assert_in_order()

    def test_rooms_may_include_each_other_in_one_direction(self):
        self.tree.write_source("rover/quasi_static/balance.cc", '#include "rover/quasi_static/balance.h"\n'
                               '#include "rover/multibody/wheel.h"\n')
        self.assert_in_order()

    def test_files_beside_rooms_may_know_them(self):
        self.tree.add_line("rover/bullet_rover.cc", '#include "rover/multibody/wheel.h"')
        self.assert_in_order()

    def test_import_in_a_comment(self):
        self.tree.add_line("web/shared/dom.ts", '// import { page } from "../report/main";')
        self.assert_in_order()

    def test_source_that_a_function_of_cmake_names(self):
        self.tree.replace("web/CMakeLists.txt", "page.cc\n", "page.cc\n    ${pages}\n")
        self.tree.write("web/no_pages.cc", "#include <string>\n")
        self.assertEqual(len(self.tree.violations()), 1)
        self.tree.write("../scripts/cmake/Pages.cmake", "set(pages no_pages.cc)\n")
        self.assert_in_order()
        self.tree.replace("web/CMakeLists.txt", "    ${pages}\n", "")
        self.assertEqual(len(self.tree.violations()), 1, "nothing holds what the function names")

    def test_posix_and_standard_headers(self):
        self.tree.write_source("batch/signals.cc", "#include <csignal>\n#include <unistd.h>\n")
        self.assert_in_order()


class PublicHeaders(InATree):
    """The list of what is installed, in a tree that is otherwise in order."""

    PUBLIC = {
        "core/check.h": "/// @file\n/// Contracts.\n#pragma once\n#include <string>\n",
        "messages/commands.h": """/// @file
/// Commands: see https://example.org.
#pragma once

#include "core/check.h"

namespace rockyard::messages {

class Wheel;

/// A motion.
struct Motion {
  double speed_m_s = 0.0;  ///< along x
  // NOLINTNEXTLINE(a-check): reason
  const char* where = "http://example.org";
};

}  // namespace rockyard::messages
""",
        "truth/state.h": '/// @file\n/// Truth.\n#pragma once\n#include "messages/commands.h"\n',
    }
    LISTED = "# what is installed\nonboard core/check.h\nonboard messages/commands.h\nworld truth/state.h\n"

    def setUp(self):
        super().setUp()
        for name, text in self.PUBLIC.items():
            self.tree.write(name, text)
        self.tree.write("public_headers.txt", self.LISTED)

    def test_control_is_in_order(self):
        self.assert_in_order()

    def test_include_of_a_header_that_is_not_listed(self):
        self.tree.replace("public_headers.txt", "onboard core/check.h\n", "")
        self.assert_caught("src/messages/commands.h:5", "not in public_headers.txt")

    def test_on_board_header_includes_the_world(self):
        self.tree.replace("public_headers.txt", "onboard core/check.h", "world core/check.h")
        self.assert_caught("src/messages/commands.h:5", "the side onboard does not see world")

    def test_too_many(self):
        for number in range(44):
            self.tree.write(f"math/extra{number}.h", "/// @file\n/// More.\n#pragma once\n")
            if number == 43:
                self.assertEqual(self.tree.violations(), [], "46 are allowed")
            self.tree.add_line("public_headers.txt", f"onboard math/extra{number}.h")
        self.assert_caught("src/public_headers.txt", "lists 47 headers, more than 46")

    def test_lines_that_name_no_header(self):
        for line, why in (("onboard core/gone.h", "no header"), ("world core/check.h", "twice"),
                          ("ground core/check.h", "is not"), ("core/check.h", "is not")):
            with self.subTest(line=line):
                self.tree.write("public_headers.txt", self.LISTED + line + "\n")
                self.assert_caught("src/public_headers.txt", why)

    def test_comments_that_a_generator_misses(self):
        for old, new, line in (("/// A motion.", "// A motion.", 11), ("///< along x", "// along x", 13),
                               ("/// @file\n", "", 1), ("/// A motion.\n", "", 11)):
            with self.subTest(old=old, new=new):
                self.tree.write("messages/commands.h", self.PUBLIC["messages/commands.h"])
                self.tree.replace("messages/commands.h", old, new)
                found = [message for message in self.tree.violations() if "///" in message]
                self.assertIn(f"src/messages/commands.h:{line}: ", " ".join(found))

    def test_comments_of_other_headers_are_free(self):
        self.tree.write("terrain/terrain.h", '// Ground.\n#pragma once\n#include "core/check.h"\n')
        self.assert_in_order()

    def test_the_project_has_such_a_list(self):
        self.assertTrue((ROOT / "src" / "public_headers.txt").is_file())


class Rules(unittest.TestCase):
    def test_missing_table_is_an_error(self):
        with self.assertRaises(layer_rules.RulesError):
            layer_rules.read_table("# Map\n")

    def test_unknown_folder_in_the_table_is_an_error(self):
        with self.assertRaises(layer_rules.RulesError):
            layer_rules.read_table(README.replace("| truth | messages |", "| truth | mesages |"))

    def test_two_rows_of_a_folder_are_an_error(self):
        with self.assertRaisesRegex(layer_rules.RulesError, "two rows for truth"):
            layer_rules.read_table(README.replace("| batch |", "| truth | messages |\n| batch |"))

    def test_missing_second_rule_is_an_error(self):
        with self.assertRaises(layer_rules.RulesError):
            layer_rules.read_heavy(README.split("2. **")[0], ["rover"])

    def test_libraries_and_folders_of_the_second_rule(self):
        rules = layer_rules.read_heavy(README, ["rover", "batch", "core"])
        self.assertEqual(rules, {"Bullet": {"rover"}, "OpenMP": {"batch"}, "SQLite": {"batch"},
                                 "nlohmann-json": {"core"}})

    def test_the_project_forbids_truth_and_terrain_on_board(self):
        rules = layer_rules.read_rules(ROOT / "src" / "README.md")
        for module in ("vision", "perception", "localization", "navigation"):
            self.assertFalse(rules.allowed[module] & {"truth", "terrain", "rover", "rendering", "sensing"})


if __name__ == "__main__":
    unittest.main()
