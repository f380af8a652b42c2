"""The package `rockyard` of the build whose program a study calls, as `ry`.

It is taken from PYTHONPATH (scripts/studies.py sets it), or from the build of --rockyard, else from build/release or
build/test.
"""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]


def places(words):
    """Folders of builds that have it, those of the program that the words name first."""
    named = [after for word, after in zip(words, words[1:]) if word == "--rockyard"]
    builds = [Path(program).resolve().parents[1] for program in named] + [ROOT / "build/release", ROOT / "build/test"]
    return [str(build / "python") for build in builds if list(build.glob("python/rockyard/_core.*.so"))]


sys.path += places(sys.argv)
try:
    import rockyard as ry  # noqa: F401
except ImportError as missing:
    sys.exit(f"the package rockyard cannot be had ({missing}): build it for {sys.executable} with\n"
             "cmake --build --preset release --target rockyard_python_module, or name its folder, BUILD/python, in PYTHONPATH")
