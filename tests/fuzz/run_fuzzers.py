#!/usr/bin/env python3
"""Runs the fuzzer of every reader from its corpus: does one crash, hang, leak or throw what is no refusal?

Usage: tests/fuzz/run_fuzzers.py [--runs 1000000] [--slow-runs 100000] [--seed 1] [--jobs 1] [--keep] [READER]...
Wants the preset fuzz: cmake --preset fuzz && cmake --build --preset fuzz --target reader_fuzz
What is found new goes to build/fuzz/corpus/READER, inputs that fail to build/fuzz/findings. --keep then adds to
tests/data/readers what of it reaches code that nothing there reaches. At the end: how many lines of each source of the
readers were reached (with --runs 0 --slow-runs 0 by the inputs alone).
Exit code: 0, or 1 with any finding, or where all readers reach fewer than nine lines of ten.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FUZZER = ROOT / "build/fuzz/tests/fuzz/reader_fuzz"
KEPT = ROOT / "tests/data/readers"
SLOW = ("scenario", "sweep", "urdf")  # a resolved scenario has a thousand parameters, a rover is written back
LONGEST = {"image": 16384, "reference": 16384, "scenario": 16384, "sweep": 16384, "urdf": 40960}  # bytes; 4096 of the others
# What turns bytes into values or refusals, of all that the readers call.
SOURCES = ("campaign/odometry/pair_reader.cc", "campaign/odometry/path_journal.cc",
           "campaign/odometry/pose_text.cc", "campaign/site/rock_catalogue.cc", "campaign/site/rock_table.cc", "core/field_archive.cc", "core/files.cc", "core/json_file.cc",
           "core/json_parse.cc", "core/text.cc", "image_files/elevation_raster.cc", "image_files/float_files.cc", "image_files/header_text.cc",
           "image_files/jpeg_reader.cc", "image_files/npy_raster.cc", "image_files/planetary.cc", "image_files/png_reader.cc",
           "image_files/pnm_reader.cc", "image_files/read_image.cc", "report/baseline.cc",
           "report/comparison_reference.cc", "rover/urdf_reader/urdf_arms.cc", "rover/urdf_reader/urdf_bodies.cc",
           "rover/urdf_reader/urdf_body.cc", "rover/urdf_reader/urdf_elements.cc", "rover/urdf_reader/urdf_joints.cc",
           "rover/urdf_reader/urdf_links.cc", "rover/urdf_reader/urdf_masses.cc", "rover/urdf_reader/urdf_model.cc",
           "rover/urdf_reader/urdf_skeleton.cc", "rover/urdf_reader/urdf_wheels.cc", "rover/urdf_reader/urdf_xml.cc",
           "scenario/load.cc", "scenario/sweep.cc", "scenario/sweep_axes.cc", "scenario/sweep_cell.cc",
           "scenario/sweep_keys.cc", "scenario/sweep_parts.cc", "vision/calibration/target_file.cc",
           "vision/cameras/camera_fields.cc", "vision/cameras/camera_file.cc", "vision/cameras/camera_text.cc")
ENOUGH = 0.9
# One input: bounds of what is read, not of a quick machine.
LIMITS = ["-timeout=120", "-rss_limit_mb=3000", "-malloc_limit_mb=1500"]


def profile(reader):
    return FUZZER.with_name(f"{reader}.profraw")


def fuzzer(reader, *words, counts=True):
    environment = {**os.environ, "ROCKYARD_READER": reader,
                   "ASAN_OPTIONS": "allocator_may_return_null=1:detect_leaks=1",
                   "LLVM_PROFILE_FILE": str(profile(reader)) if counts else os.devnull}
    return subprocess.run([FUZZER, *map(str, words)], cwd=ROOT, env=environment, text=True, errors="replace",
                          capture_output=True, check=False)


def run(reader, options):
    """What is said of a reader, and whether nothing was found."""
    grown = ROOT / "build/fuzz/corpus" / reader
    findings = ROOT / "build/fuzz/findings"
    grown.mkdir(parents=True, exist_ok=True)
    findings.mkdir(parents=True, exist_ok=True)
    runs = options.slow_runs if reader in SLOW else options.runs
    longest = f"-max_len={LONGEST.get(reader, 4096)}"
    profile(reader).unlink(missing_ok=True)  # a reader that crashes leaves none
    start = time.monotonic()
    done = fuzzer(reader, f"-runs={runs}", f"-seed={options.seed}", longest, *LIMITS,
                  f"-artifact_prefix={findings}/{reader}-", grown, KEPT / reader)
    count = re.findall(r"Done (\d+) runs", done.stderr)
    told = f"{reader}: {count[-1] if count else 'not all'} runs, {time.monotonic() - start:.0f} s"
    if done.returncode != 0:
        return f"{told}, FOUND\n{done.stderr[-3000:]}", False
    if options.keep:
        fuzzer(reader, "-merge=1", longest, *LIMITS, KEPT / reader, grown, counts=False)
    return f"{told}, nothing found, {len(list(KEPT.joinpath(reader).iterdir()))} inputs kept", True


def coverage(readers):
    """Prints how many lines of SOURCES the runs and inputs of these readers have reached, and returns their share."""
    merged = FUZZER.with_name("all.profdata")
    if missing := [reader for reader in readers if not profile(reader).is_file()]:
        print(f"lines not counted: no profile of {', '.join(missing)}")
        return 0.0
    subprocess.run(["llvm-profdata", "merge", *map(profile, readers), "-o", merged], check=True)
    told = subprocess.run(["llvm-cov", "export", "-summary-only", FUZZER, f"-instr-profile={merged}",
                           *(ROOT / "src" / source for source in SOURCES)], capture_output=True, text=True, check=True)
    files = {str(Path(file["filename"]).relative_to(ROOT / "src")): file["summary"]["lines"]
             for file in json.loads(told.stdout)["data"][0]["files"]}
    for source in SOURCES:
        print(f"{source}: {files[source]['covered']} of {files[source]['count']} lines")
    reached, lines = (sum(files[source][part] for source in SOURCES) for part in ("covered", "count"))
    print(f"{reached} of {lines} lines, {100 * reached / lines:.1f} %")
    return reached / lines


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=1_000_000)
    parser.add_argument("--slow-runs", type=int, default=100_000, help=f"of {', '.join(SLOW)}")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("readers", metavar="READER", nargs="*")
    options = parser.parse_args(arguments)
    known = sorted(folder.name for folder in KEPT.iterdir())
    if unknown := set(options.readers) - set(known):
        parser.error(f"no reader {', '.join(sorted(unknown))}; there are {', '.join(known)}")
    if not all(map(shutil.which, ("llvm-profdata", "llvm-cov"))):
        parser.error("llvm-profdata and llvm-cov are not there (scripts/install_dependencies.sh tsan)")
    if not FUZZER.is_file():
        parser.error(f"{FUZZER} is not there (see --help)")
    readers = options.readers or known
    good = True
    with ThreadPoolExecutor(options.jobs) as pool:
        for told, passed in pool.map(lambda reader: run(reader, options), readers):
            print(told, flush=True)
            good = good and passed
    enough = coverage(readers) >= ENOUGH or readers != known
    return 0 if good and enough else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
