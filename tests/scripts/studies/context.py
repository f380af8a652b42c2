"""Where tests of studies find them. All: `python3 -m unittest discover -s tests/scripts/studies -p "*_test.py"`."""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "scripts/studies"), str(ROOT / "scripts"), str(ROOT / "tests/scripts")]
