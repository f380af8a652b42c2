"""What stands at the head of pages about the age of what studies wrote there."""

import hashlib
import re

from . import stamps as stamping
from .declarations import ROOT, carrier, file_of, has_table

BEGIN, END = "<!-- begin made -->", "<!-- end made -->"
HEAD = re.compile(rf"{BEGIN}\n.*?{END}\n\n?", re.S)
BUILD = re.compile(r"\b(\d+\.\d+\.\d+ [0-9a-f]{7,40}(?:-dirty)?)\b")


def content_hash(item, root=ROOT):
    """Of what a study wrote, without the head of its page; None where it is gone."""
    path = root / file_of(item)
    content = path.read_bytes() if path.is_file() else b""
    if "#" in item:
        table = has_table(content.decode(), item.split("#")[1])
        content = table[0].encode() if table else b""
    elif path.suffix == ".md":
        content = HEAD.sub("", content.decode()).encode()
    return hashlib.sha256(content).hexdigest()[:16] if content else None


def edited(studies, stamps, root=ROOT):
    """What stands otherwise than the study that has the stamp wrote it."""
    return [f"{item} is not as {name} wrote it: make it anew, or take the change back"
            for name, stamp in stamps.items() if name in studies
            for item, written in stamp["written"].items()
            if item in studies[name].writes and content_hash(item, root) != written]


def named_builds(item, root=ROOT):
    """The builds that a table or file names, or else the only one that its page names."""
    text = HEAD.sub("", (root / file_of(item)).read_text(encoding="utf-8", errors="replace"))
    own = list(dict.fromkeys(BUILD.findall(text)))
    if "#" not in item:
        return own
    table = has_table(text, item.split("#")[1])
    return list(dict.fromkeys(BUILD.findall(table[0]))) if table and BUILD.search(table[0]) else own[:len(own) == 1]


def build_of(study, items, stamps, root=ROOT):
    """Version and commit, of the stamp or as the items themselves name them."""
    if study.name in stamps:
        return f"rockyard {stamps[study.name]['version']} {stamps[study.name]['commit'][:12]}"
    found = list(dict.fromkeys(build for item in items for build in named_builds(item, root)))
    if len(found) > 3:
        return f"rockyard {found[0]} and {len(found) - 1} other builds"
    return "rockyard " + " and ".join(found) if found else "an unknown build"


def names_of(items):
    """Tables and files; a caption goes with its figure."""
    names = [item if item.startswith("README.md") else item.split("#")[-1].rsplit("/", 1)[-1] for item in items]
    return ", ".join(f"`{name}`" for name in names if f"{name}.svg" not in names)


def line(kind, made, found, alone):
    """What a page says of one kind and one build: items by study; `alone`: there is nothing else on the page."""
    items = names_of([item for own in found.values() for item in own])
    what = "" if alone else f" ({items})"
    run = f"`scripts/studies.py run {' '.join(found)}`"
    if kind == "current":
        return f"> Made by {made} by {run}{what}."
    again = f"{run} makes it anew." if kind == "stale" else "No script makes it anew."
    return f"> **Stale**{what}: made by {made}; today's program may give other numbers. {again}"


def pages(studies):
    """Items by page and study."""
    found = {}
    for study in studies.values():
        for item in study.writes:
            found.setdefault(carrier(item), {}).setdefault(study.name, []).append(item)
    return found


def head(written, studies, stamps, root=ROOT):
    """The head of a page: {study: items} that stand on it."""
    groups = {}
    for name, items in sorted(written.items()):
        study = studies[name]
        stale = stamping.is_stale(study, stamps, root)
        kind = "current" if not stale else "stale" if study.commands else "by hand"
        for item in items:
            own = groups.setdefault((kind, build_of(study, [item], stamps, root)), {})
            own.setdefault(name, []).append(item)
    lines = [line(*key, found, len(groups) == 1) for key, found in sorted(groups.items())]
    return f"{BEGIN}\n" + "\n>\n".join(lines) + f"\n{END}\n"


def with_head(text, wanted):
    """The page with this head, below its title where it has one."""
    bare = HEAD.sub("", text)
    title = re.match(r"# .*\n\n?", bare)
    if not title:
        return f"{wanted}\n{bare}"
    return f"{title[0].rstrip()}\n\n{wanted}\n{bare[title.end():]}"


def write(studies, stamps, root=ROOT, only=None):
    """Brings the heads of pages up to date (only: of these); those that were not."""
    changed = []
    for page, written in pages(studies).items():
        path = root / page
        if (only and page not in only) or not path.is_file():
            continue
        text = path.read_text(encoding="utf-8")
        mended = with_head(text, head(written, studies, stamps, root))
        if mended != text:
            stamping.write_whole(path, mended)
            changed.append(page)
    return changed


def faults(studies, stamps, root=ROOT):
    """Pages whose head does not say what is known, each with what it should say."""
    found = []
    for page, written in sorted(pages(studies).items()):
        path = root / page
        if not path.is_file():
            continue
        text = path.read_text(encoding="utf-8")
        wanted = head(written, studies, stamps, root)
        heads = HEAD.findall(text)
        if len(heads) == 1 and heads[0].rstrip("\n") == wanted.rstrip("\n"):
            continue
        said = heads[0].splitlines()[1:-1] if heads else []
        lines = [one for one in wanted.splitlines()[1:-1] if one != ">" and one not in said]
        found.append(f"{page} does not say at its head: {' / '.join(lines) or 'only what is true of it'}")
    return found
