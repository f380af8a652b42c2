"""What scripts/check_tidy.py runs clang-tidy on, when it runs it again, and that a batch hides nothing."""

import contextlib
import io
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import check_tidy  # noqa: E402  (the path comes first)

# Stands for clang-tidy: writes down what it was given and finds fault with every "BAD".
FAKE = """#!/bin/sh
if [ "$1" = --version ]; then echo "fake ${VERSION:-1}"; exit 0; fi
file="$3"
echo "$*" >> "$CALLS"
grep -n BAD "$file" | sed "s|^\\([0-9]*\\):.*|$file:\\1:1: error: bad [bad]|" | grep . && exit 1
exit 0
"""
FINDING = re.compile(r"^(\S+?):(\d+):\d+: (?:error|warning): .* \[([\w.,-]+)\]$", re.M)

HEADER = """#pragma once
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>
namespace rockyard::plant {
struct bad_name {};
struct Uninitialized { Uninitialized() {} int value; };
struct Base { virtual ~Base() = default; virtual int F() const { return 1; } };
struct Implicit { Implicit(int v) : value(v) {} int value = 0; };
inline bool None(const std::string& s) { return s.size() == 0; }
}  // namespace rockyard::plant
"""

# {x} sets the names of the files apart: what is compiled together may not define a name twice.
PLANTED = """#include "plant/plant.h"
#include <algorithm>
#include <math.h>
#include <cstdlib>
#include <algorithm>

namespace rockyard::plant {{
namespace {{
constexpr double badConstant{x} = 2.0;
class Member{x} {{ public: int Get() {{ return value; }} private: int value = 0; }};
struct Derived{x} : Base {{ int F() const {{ return 9; }} int extra = 0; }};
struct Nothing{x} {{ Nothing{x}() {{}} ~Nothing{x}() {{}} }};
}}  // namespace
namespace alias_{x} = std;
using namespace std;
int bad_function_{x}(int unused) {{ int later; later = 1; return later; }}
void Slice{x}() {{ Derived{x} derived; Base base = derived; (void)base.F(); }}
int Throw{x}() {{ try {{ throw std::runtime_error("x"); }} catch (std::runtime_error e) {{ return 1; }} }}
int Loop{x}(const std::vector<int>& v) {{ int s = 0; for (std::size_t i = 0; i < v.size(); ++i) s += v[i]; return s; }}
std::string Empty{x}() {{ std::string s = ""; return s; }}
bool Size{x}(const std::vector<int>& v) {{ return v.size() == 0; }}
int Number{x}(const char* text) {{ return atoi(text); }}
int Same{x}(int a, int b) {{ return (a + b) - (a + b); }}
bool Equal{x}(const std::string& a, const std::string& b) {{ return a.compare(b) == 0; }}
std::unique_ptr<Base> Make{x}() {{ return std::unique_ptr<Base>(new Base()); }}
void Copies{x}(const std::vector<std::string>& v) {{ for (auto s : v) (void)s.size(); }}
void Branches{x}(int a) {{ if (a) {{ ++a; }} else {{ ++a; }} }}
double Half{x}(int a) {{ double d = a / 2; return d; }}
int Moved{x}() {{ std::string s; std::string t = std::move(s); return int(s.size() + t.size()); }}
namespace {{
const int kNobody{x} = 1;
int Nobody{x}() {{ return 1; }}
}}  // namespace
}}  // namespace rockyard::plant
"""


class Project(unittest.TestCase):
    """A small project: two rooms of one module in a batch, and a program by itself."""

    FILES = {
        "src/plant/plant.h": "#pragma once\n",
        "src/plant/one.cc": '#include "plant/plant.h"\nint one;\n',
        "src/plant/room/two.cc": '#include "plant/plant.h"\nint two;\nint more;\n',
        "src/plant/room/three.cc": "int three;",
        "src/app/main.cc": "int main() {}\n",
        ".clang-tidy": "Checks: '*'\n",
    }

    BATCH = ["src/plant/one.cc", "src/plant/room/two.cc", "src/plant/room/three.cc"]

    def setUp(self):
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        self.build = self.root / "build"
        for name, text in self.FILES.items():
            self.write(name, text)
        self.write_database(self.BATCH)
        for name, value in (("ROOT", self.root), ("CLANG_TIDY", check_tidy.CLANG_TIDY)):
            self.addCleanup(setattr, check_tidy, name, getattr(check_tidy, name))
            setattr(check_tidy, name, value)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        check_tidy.read.cache_clear()

    def write_database(self, batch, options="-std=c++20 -Wall"):
        unity = "build/src/plant/CMakeFiles/rockyard_plant.dir/Unity/unity_0_cxx.cxx"
        self.write(unity, "".join(f'#include "{self.root / name}"\n\n' for name in batch))
        include = self.build / "include" / "plant"
        include.mkdir(parents=True, exist_ok=True)
        if not (include / "plant").is_symlink():
            (include / "plant").symlink_to(self.root / "src" / "plant")
        entries = [{"directory": str(self.build), "file": str(self.root / file),
                    "command": f"{program} -I{include} {options} -o x.o -c {self.root / file}"}
                   for program, file in (("c++", unity), ("/usr/bin/ccache c++", "src/app/main.cc"))]
        self.write("build/compile_commands.json", json.dumps(entries))

    def check(self, *arguments):
        """The exit code, and what is printed."""
        check_tidy.read.cache_clear()
        output = io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
            code = check_tidy.main([str(self.build), *arguments])
        return code, output.getvalue()


class Runs(Project):
    """With something in place of clang-tidy that is quick and tells how it was called."""

    def setUp(self):
        super().setUp()
        self.write("fake-tidy", FAKE)
        (self.root / "fake-tidy").chmod(0o755)
        check_tidy.CLANG_TIDY = str(self.root / "fake-tidy")
        self.calls = self.root / "calls"
        self.calls.touch()
        self.set_variable("CALLS", str(self.calls))
        self.set_variable("VERSION", "1")

    def set_variable(self, name, value):
        os.environ[name] = value
        self.addCleanup(os.environ.pop, name, None)

    def runs(self):
        """The files that it ran on since the last question."""
        lines = self.calls.read_text(encoding="utf-8").splitlines()
        self.calls.write_text("", encoding="utf-8")
        return sorted(Path(line.split()[2]).name for line in lines)

    def test_a_batch_is_one_run_and_a_program_by_itself_another(self):
        self.assertEqual(self.check("plant")[0], 0)
        self.assertEqual(self.runs(), ["rockyard_plant_unity_0_cxx.cc"])
        code, output = self.check("plant", "app")
        self.assertEqual((code, self.runs()), (0, ["main.cc"]))
        self.assertIn("4 files in 2 runs, 0 runs with findings", output)

    def test_options_of_the_compiler_without_programs_input_and_output(self):
        self.check("app")
        self.assertEqual(self.calls.read_text(encoding="utf-8").split(" -- ")[1],
                         f"-I{self.build / 'include' / 'plant'} -std=c++20 -Wall "
                         f"{check_tidy.ONE_INSTRUCTION_SET}\n")

    def test_what_is_not_below_src_is_not_checked(self):
        self.write("build/generated.cc", "int BAD;\n")
        self.write_database(["build/generated.cc", "src/plant/one.cc"])
        self.assertEqual(self.check("plant")[0], 0)
        self.assertEqual(self.runs(), ["one.cc"])

    def test_findings_are_told_by_the_place_in_the_real_file(self):
        self.write("src/plant/room/two.cc", '#include "plant/plant.h"\nint two;\nint BAD;\n')
        self.write("src/plant/room/three.cc", "int BAD;")
        code, output = self.check("plant")
        self.assertEqual(code, 1)
        places = [(Path(file).name, int(line)) for file, line, _ in FINDING.findall(output)]
        self.assertEqual(places, [("two.cc", 3), ("three.cc", 1)])
        self.assertNotIn("unity_0", output)
        self.runs()
        self.assertEqual(self.check("plant")[0], 1, "what failed runs again")
        self.assertEqual(len(self.runs()), 1)

    def test_runs_again_when_anything_changed_that_it_depends_on(self):
        changes = (("src/plant/plant.h", "#pragma once\nint h;\n"), ("src/plant/one.cc", "int other;\n"),
                   (".clang-tidy", "Checks: 'x*'\n"))
        for name, text in changes:
            self.check("plant", "app")
            self.runs()
            self.check("plant")
            self.assertEqual(self.runs(), [], "nothing changed")
            self.write(name, text)
            self.check("plant")
            self.assertEqual(self.runs(), ["rockyard_plant_unity_0_cxx.cc"], name)
        self.set_variable("VERSION", "2")
        self.check("plant")
        self.assertEqual(len(self.runs()), 1, "version")
        self.write_database(self.BATCH, "-std=c++20")
        self.check("plant")
        self.assertEqual(len(self.runs()), 1, "options")
        self.write_database(["src/plant/one.cc"])
        self.check("plant")
        self.assertEqual(self.runs(), ["one.cc"], "other batches")

    def test_all_batches_without_a_folder(self):
        self.check()
        self.assertEqual(len(self.runs()), 2)

    def test_what_is_not_there_is_wrong_use(self):
        for arguments in (["cloud"], ["--changed", "no-such-commit"], ["--changed", "a", "b"]):
            with self.subTest(arguments=arguments):
                self.assertEqual(self.check(*arguments)[0], 2)
        (self.build / "compile_commands.json").unlink()
        self.assertEqual(self.check("plant")[0], 2)
        self.assertEqual(self.runs(), [])

    def git(self, *arguments):
        subprocess.run(["git", "-C", str(self.root), "-c", "user.name=n", "-c", "user.email=e@e",
                        *arguments], check=True, capture_output=True)

    def commit(self):
        self.git("add", "src")
        self.git("commit", "-m", "m")

    def start_repository(self):
        self.git("init", "-b", "main")
        self.commit()

    def test_changed_files_one_by_one(self):
        self.start_repository()
        self.git("checkout", "-b", "work")
        self.write("src/plant/room/three.cc", "int committed;\n")
        self.commit()
        self.write("src/app/main.cc", "int main() { return 0; }\n")
        self.assertEqual(self.check("--changed")[0], 0)
        self.assertEqual(self.runs(), ["main.cc", "three.cc"])
        self.check("--changed")
        self.assertEqual(self.runs(), [], "they passed")
        self.write("src/app/main.cc", "int main() { return BAD; }\n")
        code, output = self.check("--changed", "HEAD")
        self.assertEqual((code, self.runs()), (1, ["main.cc"]))
        self.assertIn("main.cc:1:1", output)

    def test_changes_since_all_files_were_clean(self):
        self.start_repository()
        for name in ("one", "room/two"):
            self.write(f"src/plant/{name}.cc", f"int {Path(name).name}_other;\n")
            self.commit()
        clean = check_tidy.git("rev-parse", "HEAD~2")[0][:12]
        row = "| tidy | every source | `x` | {}, 2026-01-01, commit {}, 9.0 min |\n"
        for told, files in (("passed", ["rockyard_plant_unity_0_cxx_changed.cc"]),
                            ("FAILED with exit code 1", ["two.cc"])):
            with self.subTest(told=told):
                self.write("tests/long/README.md", row.format(told, clean))
                self.check("--changed")
                self.assertEqual(self.runs(), files)

    def test_a_branch_that_has_not_left_is_compared_with_the_commit_before(self):
        self.start_repository()
        self.write("src/plant/one.cc", "int other;\n")
        self.commit()
        self.check("--changed")
        self.assertEqual(self.runs(), ["one.cc"])

    def test_a_changed_header_is_seen_through_a_source(self):
        self.start_repository()
        self.write("src/plant/plant.h", "#pragma once\nint h;\n")
        self.check("--changed", "HEAD")
        self.assertEqual(self.runs(), ["one.cc"], "the first that includes it")
        self.write("src/app/main.h", "#pragma once\n")
        self.check("--changed", "HEAD")
        self.assertEqual(self.runs(), ["main.cc"], "that of its name; git does not know the header yet")

    def test_a_source_that_is_not_compiled_is_told(self):
        self.start_repository()
        self.write("src/plant/lost.cc", "int BAD;\n")
        (self.root / "src/plant/one.cc").unlink()
        code, output = self.check("--changed", "HEAD")
        self.assertEqual((code, self.runs()), (0, []))
        self.assertRegex(output, "lost.cc: not compiled")


class Findings(Project):
    """With clang-tidy itself and the checks of this project."""

    def findings(self, batch):
        self.write_database(batch)
        code, output = self.check("plant")
        return code, {(Path(file).name, int(line), check.replace(",-warnings-as-errors", ""))
                      for file, line, check in FINDING.findall(output)}

    def plant(self, text):
        self.write(".clang-tidy", (ROOT / ".clang-tidy").read_text(encoding="utf-8"))
        names = ("one.cc", "room/two.cc")
        for name, letter in zip(names, "ab"):
            self.write(f"src/plant/{name}", text.format(x=letter))
        return [f"src/plant/{name}" for name in names]

    def test_a_batch_finds_what_its_files_have_by_themselves(self):
        self.write("src/plant/plant.h", HEADER)
        files = self.plant(PLANTED)
        alone = set.union(*(self.findings([file])[1] for file in files))
        code, together = self.findings(files)
        self.assertEqual(code, 1)
        self.assertEqual(together, alone)
        for name in ("one.cc", "two.cc"):
            self.assertGreaterEqual(len({check for file, _, check in alone if file == name}), 26, sorted(alone))
            lines = [number for number, text in enumerate(PLANTED.splitlines(), 1) if "obody" in text]
            self.assertEqual([check for file, line, check in sorted(alone) if file == name and line in lines],
                             ["clang-diagnostic-unused-const-variable", "clang-diagnostic-unused-function"])

    def test_control_without_a_planted_violation_passes(self):
        files = self.plant('#include "plant/plant.h"\n#include <string>\n'
                           "namespace rockyard::plant {{\nint Good{x}() {{ return 1; }}\n}}\n")
        self.assertEqual(self.findings(files), (0, set()))


if __name__ == "__main__":
    unittest.main()
