"""The pages of the project keep the rules of pages.py, and each kind of violation, planted in a
small tree that is otherwise in order, is reported."""

import tempfile
import unittest
from pathlib import Path

import pages

ROOT = Path(__file__).resolve().parent.parent.parent

FILES = {
    "README.md": "[how](CONTRIBUTING.md#how-to-add-a-file) [web](https://example.org/none)\n",
    "CONTRIBUTING.md": "## How to add `a file`!\n\n[map](src/README.md) [above](#how-to-add-a-file)\n",
    "CHANGELOG.md": "`[](no link)`\n\n```cpp\nf = [](int) {};\n```\n",
    "src/README.md": "| folder | what |\n|---|---|\n| terrain | [here](terrain/README.md) |\n",
    "src/terrain/README.md": "| file | what |\n|---|---|\n"
                             "| `rock.h`, `field` | `src/terrain/rock.h`, `core/check.h`, `Field` |\n"
                             "| `*_params`, `deep/` | parameters |\n\n"
                             "| law | where |\n|---|---|\n| `moore` | `deep/law.h` |\n\n"
                             "```md\n| file | what |\n|---|---|\n| `none` | |\n```\n",
    "src/terrain/rock.h": "",
    "src/terrain/field.h": "",
    "src/terrain/field.cc": "",
    "src/terrain/rock_params.h": "",
    "src/terrain/deep/law.h": "",
    "src/terrain/deep/README.md": "| file | what |\n|---|---|\n| `law` | laws |\n",
    "src/core/README.md": "| files | what |\n|---|---|\n| `check.h` | checks |\n",
    "src/core/check.h": "",
    "scenarios/mars/README.md": "[up](../../README.md)\n",
    "tests/README.md": "[up](..)\n",
    "results/trial.md": "[root](../README.md)\n",
    "docs/commands/run.md": "[root](../../README.md)\n",
}


def faults_of(changes):
    """The faults of the small tree with other files; None takes a file away."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**FILES, **changes}.items():
            if text is None:
                continue
            path = Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return [fault.replace(f"{folder}/", "") for fault in pages.check_project(folder)]


class PagesTest(unittest.TestCase):
    def expect(self, changes, *faults):
        self.assertEqual(faults_of(changes), list(faults))

    def test_the_project_keeps_the_rules(self):
        self.assertEqual(pages.check_project(ROOT), [])

    def test_the_front_page_is_short(self):
        self.assertLessEqual(len((ROOT / "README.md").read_text(encoding="utf-8").split()), 700)

    def test_the_small_tree_keeps_the_rules(self):
        self.expect({})

    def test_links_lead_to_files_from_every_kind_of_page(self):
        for page in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "results/trial.md",
                     "docs/commands/run.md",
                     "src/core/README.md", "src/terrain/deep/README.md",
                     "scenarios/mars/README.md", "tests/README.md"):
            text = FILES[page].replace("#how", "") + "\n## How to add a file\n[x](gone.md)\n"
            with self.subTest(page):
                self.assertIn(f"{page}: link to gone.md, which does not exist", faults_of({page: text}))

    def test_links_lead_to_headings(self):
        self.expect({"CONTRIBUTING.md": "## How to remove a file\n"},
                    "README.md: link to CONTRIBUTING.md#how-to-add-a-file, "
                    "but there is no such heading")

    def test_headings_in_code_are_none(self):
        self.expect({"CONTRIBUTING.md": "```sh\n## How to add a file\n```\n"},
                    "README.md: link to CONTRIBUTING.md#how-to-add-a-file, "
                    "but there is no such heading")

    def test_tables_of_files_name_files_that_are_there(self):
        for name in ("stone", "stone.h", "stone*", "deep/rock", "shallow/", "core/stone.h"):
            text = FILES["src/terrain/README.md"].replace("`rock.h`", f"`rock.h`, `{name}`")
            with self.subTest(name):
                self.expect({"src/terrain/README.md": text},
                            f"src/terrain/README.md: a table names {name}, which does not exist")

    def test_sources_that_any_table_names_are_there(self):
        for old in ("`Field`", "`deep/law.h`"):
            text = FILES["src/terrain/README.md"].replace(old, "`stone.cc`")
            with self.subTest(old):
                self.expect({"src/terrain/README.md": text},
                            "src/terrain/README.md: a table names stone.cc, which does not exist")

    def test_what_is_removed_is_named_no_longer(self):
        self.expect({"src/terrain/rock_params.h": None},
                    "src/terrain/README.md: a table names *_params, which does not exist")

    def test_every_header_is_in_a_table_of_files(self):
        for name in ("stone.h", "deep/stone.h", "rock_param.h"):
            with self.subTest(name):
                self.expect({f"src/terrain/{name}": ""},
                            f"src/terrain/{name}: in no table of files of terrain/README.md")

    def test_a_header_in_prose_or_in_another_table_is_in_none(self):
        text = FILES["src/core/README.md"]
        for other in ("`check.h` checks.\n", text.replace("files", "law")):
            with self.subTest(other):
                self.expect({"src/core/README.md": other}, "src/core/check.h: in no table of files of core/README.md")


if __name__ == "__main__":
    unittest.main()
