#!/usr/bin/env python3
"""Inputs and numbers in forms that people meet and no test of a reader thinks of: is a result ever another one?

Two matrices. Files: each input of each command, in each form of its content and of its name. Numbers: each
numeric option of each command, in each spelling that is no decimal number. A cell is right where the command
gives what it gives undisturbed, bit for bit, or where it ends with exit code 2, names the input, prints no
result and writes nothing.

Usage: input_forms_test.py ROCKYARD PROJECT [--share N] [PATTERN]
    --share N  one cell of N, by its name
    PATTERN    only cells whose name it matches
Exit code: 0 if all cells are right.
"""

import argparse
import dataclasses
import functools
import json
import os
import re
import shutil
import sys
import tempfile
import zlib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/long"))
from fuzzing import harness  # noqa: E402

AT_LEAST = 300  # cells of either matrix
# Names under which a file has to give what it gives undisturbed; of others it may be refused.
PLAIN_NAMES = ("two slashes", "back and forth", "a link", "500 characters", "blanks and quotes", "Chinese")
HANG_S = 600
SHORT = ["--set", "rover.fidelity=quasi_static", "--set", "referee.time_limit_s=2"]
NUMBER = re.compile(rb"(?<=[\s:\[,])\d+(?:\.\d+)?(?=[\s,\]}])")  # a whole token, without its sign


# ---- Forms of content

def on_first_number(change):
    def changed(data):
        match = NUMBER.search(data)
        return data[:match.start()] + change(match.group()) + data[match.end():]
    return changed


def long_fraction(number):
    return number + (b"" if b"." in number else b".") + b"0" * 300


def twice_the_first_key(data):
    key = re.search(rb'"\w+":', data).group()
    return data.replace(key, key + b" 1, " + key, 1)


WORDS = {
    "mark at its head": lambda data: b"\xef\xbb\xbf" + data,
    "lines as of Windows": lambda data: data.replace(b"\n", b"\r\n"),
    "lines as of old Macs": lambda data: data.replace(b"\n", b"\r"),
    "UTF-16": lambda data: data.decode().encode("utf-16"),
    "a byte of Latin-1": lambda data: data + b"\xe9",
    "a zero byte": lambda data: data + b"\0",
    "cut": lambda data: data[:data.rstrip().rindex(b" ")],  # within its last line
    "empty": lambda data: b"",
    "text after its end": lambda data: data.rstrip() + b" end\n",
}
TEXT = WORDS | {
    "zeros before a number": on_first_number(lambda number: b"00" + number),
    "a sign before a number": on_first_number(lambda number: b"+" + number),
    "hexadecimal": on_first_number(lambda number: b"0x1p3"),
    "decimal comma": on_first_number(lambda number: number + b",5"),
    "300 digits": on_first_number(long_fraction),
    "beyond the largest": on_first_number(lambda number: b"1e400"),
    "not a number": on_first_number(lambda number: b"nan"),
    "infinite": on_first_number(lambda number: b"inf"),
    "a unit": on_first_number(lambda number: number + b"m"),
}
JSON = TEXT | {
    "a key twice": twice_the_first_key,
    "ten thousand levels": lambda data: b"[" * 10000,
    "a list of it": lambda data: b"[" + data + b"]",
}
BYTES = {
    "cut": lambda data: data[:len(data) * 2 // 3],
    "empty": WORDS["empty"],
    "a text": lambda data: b"lost\n",
    "half of it zero": lambda data: data[:len(data) // 2] + bytes(len(data) - len(data) // 2),
    "mark at its head": WORDS["mark at its head"],
    "lines as of Windows": WORDS["lines as of Windows"],
}
CONTENTS = {"json": JSON, "numbers": TEXT, "list": WORDS, "bytes": BYTES, "store": BYTES}


# ---- Forms of names: how the command is given what lies at `path`, a copy in the empty folder `place`

def copied(path, place, name):
    """A copy below `place`; `name` is text, or bytes that are none."""
    to = os.path.join(os.fsencode(place), os.fsencode(name))
    os.makedirs(os.path.dirname(to), exist_ok=True)
    if path.is_dir():
        shutil.copytree(os.fsencode(path), to)
    else:
        shutil.copy(os.fsencode(path), to)
    return to


def linked(path, place):
    (place / ("link" + path.suffix)).symlink_to(path)
    return place / ("link" + path.suffix)


NAMES = {
    "two slashes": lambda path, place: f"{path.parent}//{path.name}",
    "two slashes at its head": lambda path, place: f"/{path}",
    "back and forth": lambda path, place: f"{path.parent}/../{path.parent.name}/{path.name}",
    "a link": linked,
    "500 characters": lambda path, place: copied(path, place, "/".join(["n" * 60] * 8 + [path.name])),
    "blanks and quotes": lambda path, place: copied(path, place, f"it's \"a\" $(b) ;c {path.name}"),
    "Chinese": lambda path, place: copied(path, place, f"漫游车{path.suffix}"),
    "no UTF-8": lambda path, place: copied(path, place, b"caf\xe9" + path.suffix.encode()),
    "two lines": lambda path, place: copied(path, place, f"a\nb{path.suffix}"),
    "a folder of its name": lambda path, place: place,
    "nothing there": lambda path, place: place / ("none" + path.suffix),
    "without end": lambda path, place: "/dev/zero",
}


# ---- What is given

@dataclasses.dataclass
class Use:
    """A command with one of its inputs: "@" in `words` is the path of it."""
    name: str
    kind: str  # of CONTENTS
    path: str  # of the input, in the folder of what is given
    words: list
    results: tuple = ()  # files that it writes below out; none: its standard output
    same: str = ""  # of these, only what this expression matches: the rest has names and times


def chessboard(tilt, turn, width=160, height=120, columns=9, rows=6, spacing=0.03, focal=150.0):
    """The board of `columns` by `rows` inner corners, 0.4 m away, turned by `tilt` about x and `turn` about y, rad."""
    cx, sx, cy, sy = np.cos(tilt), np.sin(tilt), np.cos(turn), np.sin(turn)
    R = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]]) @ np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    fine = 4  # samples a pixel and direction
    v, u = np.mgrid[0:height * fine, 0:width * fine] / fine + 0.5 / fine - 0.5
    rays = np.stack([(u - width / 2) / focal, (v - height / 2) / focal, np.ones_like(u)], axis=-1)
    center = np.array([0.0, 0.0, 0.42])
    depth = (R[:, 2] @ center) / (rays @ R[:, 2])
    on_board = (rays * depth[..., None] - center) @ R[:, :2] / spacing
    x, y = on_board[..., 0] + (columns + 1) / 2, on_board[..., 1] + (rows + 1) / 2
    inside = (x >= 0) & (x < columns + 1) & (y >= 0) & (y < rows + 1)
    value = np.where(inside, np.where((np.floor(x) + np.floor(y)) % 2 == 0, 40.0, 210.0), 230.0)
    return value.reshape(height, fine, width, fine).mean(axis=(1, 3)).round().astype(np.uint8)


def pgm(path, image):
    """PGM, or PPM of colours."""
    form = b"P5" if image.ndim == 2 else b"P6"
    path.write_bytes(b"%s\n%d %d\n255\n" % (form, image.shape[1], image.shape[0]) + image.tobytes())


def prepared(rockyard, given):
    """Makes one of each input in the folder, and gives back how they are used."""
    nominal = ROOT / "scenarios/pathfinder/nominal.json"

    def make(*words):
        end = harness.run([rockyard, *map(str, words)], given, HANG_S)
        if end.code != 0:
            sys.exit(f"{words}: exit code {end.code}: {end.err}")

    def write(name, content):
        (given / name).write_text(content if isinstance(content, str) else json.dumps(content, indent=1) + "\n",
                                  encoding="utf-8")

    write("scene.json", {"name": "scene", "extends": str(nominal), "course": {"goal_x_m": 4.5},
                         "referee": {"time_limit_s": 2.0}, "rover": {"fidelity": "quasi_static"}})
    write("heir.json", {"name": "heir", "extends": str(given / "scene.json"), "referee": {"time_limit_s": 1.8}})
    make("rover", given / "scene.json", "--out", "mine.urdf")
    write("sweep.json", {"name": "sweep", "scenario": str(given / "scene.json"), "trials": 2, "seed": 3, "axes": [
        {"name": "limit", "levels": [{"name": "one", "set": {"referee.time_limit_s": 1.5}}]}]})
    run = ["run", given / "scene.json", "--threads", 1, "--quiet"]
    make(*run, "--trials", 2, "--out", "kept7")
    make(*run, "--trials", 2, "--seed", 5, "--out", "other")
    for i in (1, 2):
        make(*run, "--trials", 2, "--shard", f"{i}/2", "--out", f"shard{i}")
    make("baseline", "kept7", "--reason", "a test", "--out", "baseline.json")
    small = ["sensors.stereo.columns=96", "sensors.stereo.rows=80", "sensors.stereo.images.pyramid_level=0",
             "sensors.stereo.max_disparity_px=24"]
    make("render", ROOT / "scenarios/gestalt/abundance.json", "--pairs", 3, "--step-m", 0.1, "--out", "way",
         *(word for value in small for word in ("--set", value)))
    write("list.txt", "".join(f"{given}/way/left/{i:06}.png {given}/way/right/{i:06}.png\n" for i in range(3)))
    for i, (tilt, turn) in enumerate([(0, 0), (0.4, 0.1), (-0.4, 0.2), (0.1, 0.45), (-0.1, -0.45), (0.3, -0.3)]):
        pgm(given / f"board{i}.pgm", chessboard(tilt, turn))
    colours = np.random.default_rng(1).integers(0, 256, (2, 80, 96, 3), dtype=np.uint8)
    for eye, image in zip(("left", "right"), colours):
        pgm(given / f"{eye}.ppm", image)
    write("board.json", {"rows": 6, "columns": 9, "spacing_m": 0.03})
    shutil.copy(given / "way/left/000000.png", given / "left.png")
    shutil.copy(given / "way/right/000000.png", given / "right.png")
    shutil.copy(given / "way/cameras.json", given / "cameras.json")
    shutil.copy(given / "way/poses.txt", given / "poses.txt")
    make("stereo", "left.png", "right.png", "--cameras", "cameras.json", "--out", "known")
    shutil.copy(given / "known/disparity.pfm", given / "known.pfm")
    return uses_of(given)


def uses_of(given):
    reference = ROOT / "results/reference"
    shutil.copy(reference / "matthies1995.json", given / "reference.json")
    drive = ["--trials", 2, "--threads", 1, "--quiet", "--out", "out"]
    stereo = ["stereo", given / "left.png", given / "right.png"]
    cameras = ["--cameras", given / "cameras.json"]
    boards = [given / f"board{i}.pgm" for i in range(1, 6)]
    target = ["--target", given / "board.json", "--out", "out"]
    vo = ["vo", given / "list.txt", "--out", "out", "--quiet"]
    path, disparity = ("trajectory.csv",), ("disparity.pfm",)
    page = ["--data", "out/data.json", "--out", "out/page.html"]
    check = ["check", given / "kept7", "--against"]
    return [
        Use("run", "json", "scene.json", ["run", "@", *drive], ("trials.csv",)),
        Use("run of an heir", "json", "heir.json", ["run", "@", *drive], ("trials.csv",)),
        Use("run of a resolved scenario", "json", "kept7/scenario.resolved.json", ["run", "@", *drive],
            ("trials.csv",)),
        Use("sweep", "json", "sweep.json", ["sweep", "@", "--threads", 1, "--quiet", "--out", "out"],
            ("trials.csv",)),
        Use("validate", "json", "scene.json", ["validate", "@"], same=r"fingerprint \w+"),
        Use("parameters", "json", "scene.json", ["parameters", "@", "--csv"]),
        Use("rover", "json", "scene.json", ["rover", "@", "--out", "out/r.urdf"], ("r.urdf",)),
        Use("rover, URDF", "numbers", "mine.urdf", ["rover", "@", "--out", "out/r.json"], ("r.json",)),
        Use("terrain", "json", "scene.json", ["terrain", "@", "--out", "out/t.csv"], ("t.csv",)),
        Use("trace of a scenario", "json", "scene.json", ["trace", "@", "--trial", 1, "--csv", "out/t.csv"],
            ("t.csv",)),
        Use("vo, list", "list", "list.txt", ["vo", "@", *cameras, *vo[2:]], path),
        Use("vo, cameras", "json", "cameras.json", [*vo, "--cameras", "@"], path),
        Use("vo, truth", "numbers", "poses.txt", [*vo, *cameras, "--truth", "@"], ("errors.csv",)),
        Use("vo, predict", "numbers", "poses.txt", [*vo, *cameras, "--predict", "@"], path),
        Use("stereo, left", "bytes", "left.png", ["stereo", "@", given / "right.png", "--out", "out"], disparity),
        Use("stereo, right", "bytes", "right.png", ["stereo", given / "left.png", "@", "--out", "out"], disparity),
        Use("stereo, cameras", "json", "cameras.json", [*stereo, "--cameras", "@", "--out", "out"], disparity),
        Use("stereo, reference", "bytes", "known.pfm", [*stereo, *cameras, "--reference", "@", "--out", "out"],
            disparity),
        Use("cylinder, cameras", "json", "cameras.json",
            ["cylinder", given / "left.ppm", given / "right.ppm", "--cameras", "@", "--json"]),
        Use("calibrate, image", "bytes", "board0.pgm", ["calibrate", "@", *boards, *target], ("cameras.json",)),
        Use("calibrate, target", "json", "board.json",
            ["calibrate", given / "board0.pgm", *boards, "--target", "@", "--out", "out"], ("cameras.json",)),
        Use("check, baseline", "json", "baseline.json", [*check, "@", "--csv", "out/c.csv"], ("c.csv",)),
        Use("check, reference", "json", "reference.json", [*check, "@", "--csv", "out/c.csv"], ("c.csv",)),
        Use("check, run", "store", "kept7", ["check", "@", "--against", given / "baseline.json", "--csv", "out/c.csv"],
            ("c.csv",)),
        Use("compare", "store", "kept7", ["compare", "@", given / "other", "--csv", "out/c.csv"], ("c.csv",)),
        Use("report", "store", "kept7", ["report", "@", "--replays", 0, "--tracks", 0, *page], ("data.json",),
            r'"trial_hash":"\w+"|"rate":[^,]*'),
        Use("trace of a run", "store", "kept7", ["trace", "@", "--trial", 1, "--csv", "out/t.csv"], ("t.csv",)),
        Use("replay", "store", "kept7", ["replay", "@", "--trial", 1, "--svg", "out/plan.svg", *page], ("plan.svg",)),
        Use("baseline", "store", "kept7", ["baseline", "@", "--reason", "a test", "--name", "b", "--out",
                                         "out/b.json"], ("b.json",)),
        Use("merge", "store", "shard1", ["merge", "@", given / "shard2", "--quiet", "--out", "out"], ("trials.csv",)),
        Use("run again", "store", "kept7", ["run", "@", *drive], ("trials.csv",)),
    ]


# ---- Cells

def outcome(rockyard, use, argument, place):
    """How the command ends with that argument, and what it wrote."""
    words = [argument if word == "@" else str(word) for word in use.words]
    if any("out/" in str(word) for word in use.words):
        (place / "out").mkdir()
    end = harness.run([rockyard, *words], place, HANG_S)
    files = {str(file.relative_to(place / "out")): file.read_bytes()
             for file in sorted((place / "out").rglob("*")) if file.is_file()}
    return end, files


def told(use, end, files):
    """What has to be the same."""
    texts = [files.get(name, b"").decode("utf-8", "replace") for name in use.results] or [end.out]
    return [re.findall(use.same, text) if use.same else text for text in texts]


def verdict(use, form, right, found, argument, place):
    """"" where the cell is right."""
    end, files = found
    fault = harness.problem_of(end)
    if fault:
        return fault
    if end.code == harness.BAD_INPUT:
        if form in PLAIN_NAMES and (use.kind, form) != ("store", "500 characters"):  # SQLite ends at 512
            return f"is refused: {end.err.strip()}"
        if end.out:
            return "refused with a result"
        if files:
            return f"refused and wrote {', '.join(files)}"
        stem = os.path.basename(os.fsdecode(argument)).split(".")[0]
        plain = re.sub(r"[^\x20-\x7e]", "", stem)
        if not any(part in end.err for part in (plain, place.name) if part):
            return f"does not name the input: {end.err.strip()}"
        return ""
    if end.code != right[0].code:
        return f"ends with {end.code}: {end.err.strip()[-200:]}"
    if told(use, *found) != right[2]:
        return "gives another result"
    return ""


def cells_of(use, given):
    """Names and makers of (argument) of all cells of an input."""
    source = given / use.path
    for form, change in CONTENTS[use.kind].items():
        def make(place, change=change):
            to = Path(os.fsdecode(copied(source, place, source.name)))
            file = to / "results.sqlite" if use.kind == "store" else to
            file.write_bytes(change(file.read_bytes()))
            return to
        yield form, make
    for form, name in NAMES.items():
        yield form, functools.partial(lambda place, name: name(source, place), name=name)


def of_files(rockyard, given, scratch):
    """Cells as (name, function that gives its fault)."""
    for use in prepared(rockyard, given):
        # Undisturbed once, when it is first asked for.
        @functools.cache
        def right(use=use):
            place = Path(tempfile.mkdtemp(dir=scratch))
            path = given / use.path
            end, files = outcome(rockyard, use, path, place)
            if end.code not in (harness.DONE, harness.DIFFERS, harness.INCONCLUSIVE):
                sys.exit(f"{use.name}, undisturbed: exit code {end.code}: {end.err}")
            return end, files, told(use, end, files)

        for form, make in cells_of(use, given):
            def fault(use=use, form=form, make=make, right=right):
                place = Path(tempfile.mkdtemp(dir=scratch))
                argument = make(place)
                found = verdict(use, form, right(), outcome(rockyard, use, argument, place), argument, place)
                shutil.rmtree(os.fsencode(place))
                return found
            yield f"{use.name}: {form}", fault


# ---- Numbers

NO_NUMBERS = ["", " ", "0x5", "1e400", "-1e400", "nan", "inf", "5,0", "5 0", "5m", "٥", "--5", "5\n6", "1" * 301 + "x"]
OPTION = re.compile(r"^\| `(--[\w-]+)` \| `(?:INT|UINT|FLOAT)\b", re.M)


def of_numbers(rockyard, project, scratch):
    """Each numeric option in each spelling that is no number: refused by name before anything is done."""
    for page in sorted((project / "docs/commands").glob("*.md")):
        for title, text in sections(page):
            for option in dict.fromkeys(OPTION.findall(text)):
                for spelling in NO_NUMBERS:
                    def fault(words=(*title.split(), f"{option}={spelling}"), option=option):
                        end = harness.run([rockyard, *words], scratch, HANG_S)
                        if end.code != harness.BAD_INPUT or end.out:
                            return f"ends with {end.code}: {end.out[:100]}"
                        if option not in end.err:
                            return f"does not name {option}: {end.err.strip()}"
                        return harness.problem_of(end)
                    yield f"{title} {option}={spelling!r}", fault


def sections(page):
    """Names of the command of a page and of those below it, with the text of each."""
    parts = re.split(r"^rockyard ([a-z-]+(?: [a-z-]+)?) \[OPTIONS\].*$", page.read_text(encoding="utf-8"), flags=re.M)
    return zip(parts[1::2], parts[2::2])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("rockyard", type=Path)
    parser.add_argument("project", type=Path)
    parser.add_argument("--share", type=int, default=1)
    parser.add_argument("pattern", nargs="?", default="", type=re.compile)
    options = parser.parse_args()
    rockyard = str(options.rockyard.resolve())
    with tempfile.TemporaryDirectory() as folder:
        given, scratch = Path(folder) / "given", Path(folder) / "scratch"
        given.mkdir()
        scratch.mkdir()
        files = list(of_files(rockyard, given, scratch))
        numbers = list(of_numbers(rockyard, options.project, scratch))
        chosen = [(name, fault) for name, fault in files + numbers
                  if re.search(options.pattern, name) and zlib.crc32(name.encode()) % options.share == 0]
        with ThreadPoolExecutor(2) as pool:
            faults = [f"{name}: {fault}" for (name, _), fault in
                      zip(chosen, pool.map(lambda cell: cell[1](), chosen)) if fault]
    print(f"{len(files)} cells of files, {len(numbers)} of numbers; {len(chosen)} tried, {len(faults)} wrong")
    if min(len(files), len(numbers)) < AT_LEAST:
        faults.append(f"less than {AT_LEAST} cells of files or of numbers")
    sys.exit("\n".join(faults) if faults else 0)


if __name__ == "__main__":
    main()
