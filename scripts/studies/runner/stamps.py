"""Stamps of studies (results/stamps), and the changes of results that they know."""

import hashlib
import json
import re

from .declarations import ROOT, StudyError

STAMPS, CHANGELOG = "results/stamps", "CHANGELOG.md"


def write_whole(path, text):
    """Leaves the old file or the new one, whatever happens."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(path.name + ".part")
    part.write_text(text, encoding="utf-8")
    part.replace(path)


def read(root=ROOT):
    """Stamps by the name of the study."""
    return {path.stem: json.loads(path.read_text(encoding="utf-8"))
            for path in sorted((root / STAMPS).glob("*.json"))}


def write(stamp, root=ROOT):
    write_whole(root / STAMPS / f"{stamp['study']}.json", json.dumps(stamp, indent=1) + "\n")


def entries(root=ROOT):
    """Entries under "Changes results": id by its first words, and patterns of scenarios that they touch.

    An entry names these in its last words, "(touches: scenarios/gestalt/*, scenarios/mars/*)"; one that names
    none touches all.
    """
    text = (root / CHANGELOG).read_text(encoding="utf-8")
    found = {}
    for section in re.findall(r"^### Changes results\n(.*?)(?=^##|\Z)", text, re.S | re.M):
        for entry in re.split(r"^- ", section, flags=re.M)[1:]:
            words = " ".join(entry.split())
            touches = re.search(r"\(touches: ([^)]*)\)", words)
            name = hashlib.sha256(words[:60].encode()).hexdigest()[:12]
            if name in found:
                raise StudyError(f"{CHANGELOG}: two changes of results begin with \"{words[:60]}\"")
            found[name] = [part.strip() for part in touches[1].split(",")] if touches else ["all"]
    return found


def later_changes(study, stamp, root=ROOT):
    """Whether an entry that the stamp does not know touches what the study drives."""
    noted = [cell["file"] for cell in stamp["cells"] if "file" in cell]
    old = stamp["changes"].split()
    return any(study.touched_by(patterns, noted, root) for name, patterns in entries(root).items() if name not in old)


def is_stale(study, stamps, root=ROOT):
    """As far as can be told without driving."""
    stamp = stamps.get(study.name)
    return stamp is None or stamp.get("differs", False) or later_changes(study, stamp, root)
