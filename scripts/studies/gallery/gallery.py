#!/usr/bin/env python3
"""Makes the pictures of docs/gallery.md and the moving one of the README, from runs, in a browser.

    scripts/studies/gallery/gallery.py --rockyard build/test/bin/rockyard --web build/test/web [--out docs/pictures]

Needs chromium, node and the npm packages of the pages (a build with -DROCKYARD_PAGE_TOOLS=ON), and Pillow. Takes some
minutes where graphics are drawn in software. Pictures are WebP; their commands stand in the gallery. Equal builds do
not give equal bytes on every machine (fonts, graphics), so no test compares them: look at them.
"""

import argparse
import json
import shutil
import subprocess
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[3]
QUALITY = 72
WIDTH, FILM_WIDTH = 1080, 600  # px, so that all of them together stay below 2 MB
FRAMES, FRAME_MS, FILM_QUALITY = 48, 125, 45
WIDE = {"width": 1440, "height": 900}
PHONE = {"width": 390, "height": 844}


def commands(rockyard):
    """What is run first, in the folder of the pictures' runs."""
    quick = ["--set", "rover.fidelity=quasi_static"]
    nominal = str(ROOT / "scenarios/pathfinder/nominal.json")
    yield [rockyard, "run", nominal, *quick, "--trials", "100", "--out", "run"]
    yield [rockyard, "run", nominal, *quick, "--trials", "100", "--set", "sensors.gyro.scale=1", "--out", "gyro"]
    yield [rockyard, "report", "run"]
    yield [rockyard, "report", "run", "gyro", "--out", "both.html"]
    yield [rockyard, "sweep", str(ROOT / "scenarios/sweeps/abundance.json"), "--trials", "60", "--out", "sweep"]
    yield [rockyard, "report", "sweep"]
    yield [rockyard, "run", str(ROOT / "scenarios/pathfinder/vl2.json"), "--trials", "40", "--out", "vl2"]
    yield [rockyard, "replay", "vl2", "--trial", "17", "--out", "stuck.html"]
    yield [rockyard, "replay", "run", "--trial", "3", "--with", "gyro", "--out", "pair.html"]
    yield [rockyard, "replay", str(ROOT / "scenarios/mars/mfex_nominal.json"), "--trial", "0", *quick, "--out",
           "mars.html"]
    yield [rockyard, "replay", str(ROOT / "scenarios/gestalt/viking_lander_2.json"), "--trial", "0", "--out",
           "gestalt.html"]
    wall = str(ROOT / "scenarios/sites/crater_wall.json")
    yield [rockyard, "run", wall, "--trials", "40", "--out", "wall"]
    yield [rockyard, "report", "wall"]
    yield [rockyard, "replay", "wall", "--trial", "3", "--out", "wall.html"]
    yield [rockyard, "render", wall, "--out", "look"]


def shots(folder):
    """Each picture: page, window, and the moment of a replay."""
    def shot(page, name, **what):
        return {"page": str(folder / page), "file": str(folder / f"{name}.png"), **WIDE, **what}
    return [
        shot("run/report.html", "report"),
        shot("run/report.html", "report_phone", **PHONE),
        shot("both.html", "comparison", scheme="dark"),
        shot("sweep/report.html", "sweep"),
        shot("stuck.html", "ending", seek=1.0),
        shot("pair.html", "pair", seek=0.6),
        shot("mars.html", "mars", seek=0.55),
        shot("gestalt.html", "gestalt", seek=0.3),
        shot("gestalt.html", "plan", seek=1.0, keys=["6"]),
        shot("wall/report.html#map", "site"),
        shot("wall.html", "site_replay", seek=0.4),
        {**shot("mars.html", "film", seek=0.0, frames=FRAMES), "width": 1100, "height": 900},
    ]


def small(path, width):
    """The picture, no wider than that."""
    picture = Image.open(path).convert("RGB")
    scale = min(1.0, width / picture.width)
    return picture.resize((round(picture.width * scale), round(picture.height * scale)), Image.LANCZOS)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rockyard", default=str(ROOT / "build/test/bin/rockyard"))
    parser.add_argument("--web", default=str(ROOT / "build/test/web"))
    parser.add_argument("--out", default=str(ROOT / "docs/pictures"))
    parser.add_argument("--chromium", default=shutil.which("chromium-headless-shell") or shutil.which("chromium"))
    arguments = parser.parse_args()
    out = Path(arguments.out)
    out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for command in commands(str(Path(arguments.rockyard).resolve())):
            subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        subprocess.run(["node", str(ROOT / "scripts/studies/gallery/screenshots.mjs"), arguments.web, arguments.chromium],
                       input=json.dumps(shots(folder)), text=True, check=True)
        shutil.copy(folder / "look/left.png", folder / "site_view.png")
        film = sorted(folder.glob("film-*.png"))
        for picture in sorted(set(folder.glob("*.png")) - set(film)):
            small(picture, WIDTH).save(out / f"{picture.stem}.webp", quality=QUALITY, method=6)
        frames = [small(frame, FILM_WIDTH) for frame in film]
        frames[0].save(out / "film.webp", save_all=True, append_images=frames[1:], duration=FRAME_MS, loop=0,
                       quality=FILM_QUALITY, method=6)
    for picture in sorted(out.glob("*.webp")):
        print(f"{picture.stat().st_size / 1000:8.0f} kB  {picture}")


if __name__ == "__main__":
    main()
