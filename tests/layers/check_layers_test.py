"""Each kind of violation, planted in a small tree that is otherwise in order, must be reported."""

import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import check_layers  # noqa: E402  (the path comes first)

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

2. **Heavy libraries stay in the `.cc` files of one folder**: Bullet in rover, OpenMP and SQLite in
   batch, nlohmann-json in core's archive.
3. **Parameters** live with their module.
"""

FILES = {
    "core/check.h": "#pragma once\n#include <string>\n",
    "core/archive.cc": '#include "core/check.h"\n#include <nlohmann/json.hpp>\n',
    "math/pose.h": "#pragma once\n#include <Eigen/Core>\n",
    "messages/commands.h": '#pragma once\n#include "math/pose.h"\n',
    "truth/state.h": '#pragma once\n#include "messages/commands.h"\n',
    "terrain/terrain.h": '#pragma once\n#include "core/check.h"\n',
    "terrain/terrain_params.h": '#pragma once\n#include "core/check.h"\n',
    "rover/bullet_rover.cc": '#include "truth/state.h"\n#include <btBulletDynamicsCommon.h>\n',
    "navigation/pathfinder/pathfinder.h": '#pragma once\n#include "messages/commands.h"\n',
    "navigation/pathfinder/pathfinder_params.h": '#pragma once\n#include "core/check.h"\n',
    "scenario/scenario.h": '#pragma once\n#include "terrain/terrain_params.h"\n',
    "batch/store.cc": "#include <omp.h>\n#include <sqlite3.h>\n#pragma omp parallel\n",
}

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

    def add_line(self, name, line):
        path = self.root / "src" / name
        path.write_text(path.read_text(encoding="utf-8") + line + "\n", encoding="utf-8")

    def link(self, folder, arguments):
        self.write(f"{folder}/CMakeLists.txt", f"rockyard_module({folder}\n  {arguments})\n")

    def violations(self):
        return check_layers.check_tree(self.root)[0]


class PlantedViolations(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.tree = Tree(self.folder.name)

    def assert_caught(self, where, why):
        """Exactly one violation, at the planted place, for the planted reason."""
        found = self.tree.violations()
        self.assertEqual(len(found), 1, found)
        self.assertIn(where, found[0])
        self.assertIn(why, found[0])

    def test_control_tree_is_in_order(self):
        self.assertEqual(self.tree.violations(), [])

    def test_navigator_includes_terrain(self):
        self.tree.add_line("navigation/pathfinder/pathfinder.h", '#include "terrain/terrain.h"')
        self.assert_caught("src/navigation/pathfinder/pathfinder.h:3", "navigation may not include terrain")

    def test_navigator_includes_truth(self):
        self.tree.add_line("navigation/pathfinder/pathfinder.h", '  #  include "truth/state.h"')
        self.assert_caught("src/navigation/pathfinder/pathfinder.h:3", "navigation may not include truth")

    def test_way_around_by_parent_folder(self):
        self.tree.add_line("navigation/pathfinder/pathfinder.h", '#include "../terrain/terrain.h"')
        self.assert_caught("src/navigation/pathfinder/pathfinder.h:3", "never with ..")

    def test_way_around_inside_an_allowed_path(self):
        self.tree.add_line("navigation/pathfinder/pathfinder.h", '#include "core/../terrain/terrain.h"')
        self.assert_caught("src/navigation/pathfinder/pathfinder.h:3", "never with ..")

    def test_own_header_in_angle_brackets(self):
        self.tree.add_line("navigation/pathfinder/pathfinder.h", "#include <terrain/terrain.h>")
        self.assert_caught("src/navigation/pathfinder/pathfinder.h:3", 'included with "..."')

    def test_header_without_its_module(self):
        self.tree.add_line("navigation/pathfinder/pathfinder.h", '#include "pathfinder_params.h"')
        self.assert_caught("src/navigation/pathfinder/pathfinder.h:3", "no folder of the table")

    def test_header_that_does_not_exist(self):
        self.tree.add_line("navigation/pathfinder/pathfinder.h", '#include "messages/gone.h"')
        self.assert_caught("src/navigation/pathfinder/pathfinder.h:3", "no such header")

    def test_include_hidden_by_has_include(self):
        self.tree.add_line("navigation/pathfinder/pathfinder.h", '#if __has_include("terrain/terrain.h")')
        self.assert_caught("src/navigation/pathfinder/pathfinder.h:3", "__has_include")

    def test_scenario_includes_more_than_parameters(self):
        self.tree.add_line("scenario/scenario.h", '#include "terrain/terrain.h"')
        self.assert_caught("src/scenario/scenario.h:3", "only *_params.h of terrain")

    def test_heavy_library_in_a_header_of_its_folder(self):
        self.tree.write("rover/bullet_rover.h", "#pragma once\n#include <btBulletDynamicsCommon.h>\n")
        self.assert_caught("src/rover/bullet_rover.h:2", "Bullet stays in .cc files")

    def test_heavy_library_in_another_folder(self):
        self.tree.write("terrain/mesh.cc", "#include <bullet/LinearMath/btVector3.h>\n")
        self.assert_caught("src/terrain/mesh.cc:1", "Bullet belongs to rover")

    def test_second_library_of_a_pair(self):
        self.tree.write("core/cache.cc", "#include <sqlite3.h>\n")
        self.assert_caught("src/core/cache.cc:1", "SQLite belongs to batch")

    def test_heavy_library_without_a_folder(self):
        self.tree.write("terrain/rays.cc", "#include <embree3/rtcore.h>\n")
        self.assert_caught("src/terrain/rays.cc:1", "gives Embree to no folder")

    def test_library_that_nobody_announced(self):
        self.tree.write("terrain/image.cc", "#include <opencv2/core.hpp>\n")
        self.assert_caught("src/terrain/image.cc:1", "does not list")

    def test_openmp_pragma_outside_its_folder(self):
        self.tree.write("terrain/loop.cc", "#pragma omp parallel for\n")
        self.assert_caught("src/terrain/loop.cc:1", "OpenMP belongs to batch")

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
        self.tree.write("terrain/long.cc", "\n" * (check_layers.MAX_LINES + 1))
        self.assert_caught("src/terrain/long.cc", "601 lines")

    def test_cycle_of_three_headers(self):
        for name, other in (("a", "b"), ("b", "c"), ("c", "a")):
            self.tree.write(f"terrain/{name}.h", f'#pragma once\n#include "terrain/{other}.h"\n')
        self.assert_caught("terrain/a.h", "include cycle terrain/a.h -> terrain/b.h -> terrain/c.h")


class NoFalseAlarm(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.tree = Tree(self.folder.name)

    def test_includes_in_comments_do_not_count(self):
        self.tree.add_line("navigation/pathfinder/pathfinder.h", '// #include "terrain/terrain.h"')
        self.tree.add_line("navigation/pathfinder/pathfinder.h", '/*\n#include "truth/state.h"\n*/')
        self.assertEqual(self.tree.violations(), [])

    def test_file_at_the_limit(self):
        self.tree.write("terrain/long.cc", "\n" * check_layers.MAX_LINES)
        self.assertEqual(self.tree.violations(), [])

    def test_posix_and_standard_headers(self):
        self.tree.write("batch/signals.cc", "#include <csignal>\n#include <unistd.h>\n")
        self.assertEqual(self.tree.violations(), [])


class Rules(unittest.TestCase):
    def test_missing_table_is_an_error(self):
        with self.assertRaises(check_layers.RulesError):
            check_layers.read_table("# Map\n")

    def test_unknown_folder_in_the_table_is_an_error(self):
        with self.assertRaises(check_layers.RulesError):
            check_layers.read_table(README.replace("| truth | messages |", "| truth | mesages |"))

    def test_missing_second_rule_is_an_error(self):
        with self.assertRaises(check_layers.RulesError):
            check_layers.read_heavy(README.split("2. **")[0], ["rover"])

    def test_libraries_and_folders_of_the_second_rule(self):
        rules = check_layers.read_heavy(README, ["rover", "batch", "core"])
        self.assertEqual(rules, {"Bullet": {"rover"}, "OpenMP": {"batch"}, "SQLite": {"batch"},
                                 "nlohmann-json": {"core"}})

    def test_the_project_forbids_truth_and_terrain_on_board(self):
        rules = check_layers.read_rules(ROOT / "src" / "README.md")
        for module in ("navigation", "perception"):
            self.assertFalse(rules.allowed[module] & {"truth", "terrain", "rover", "sensing"})


if __name__ == "__main__":
    unittest.main()
