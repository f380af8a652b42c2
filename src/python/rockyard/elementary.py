"""Sines, exponentials and their like with the bits that trials have, on every processor.

Python's `math` and NumPy take the C library's, which chooses code by the processor. A navigator or an estimator that
takes these instead drives the same records everywhere. All take floats or arrays, and return arrays where one was given;
angles are in radians. Nothing is raised: what has no answer is not a number.
"""

from . import _core

__all__ = ["atan2", "cos", "exp", "expm1", "hypot", "log", "sin", "tan"]

sin, cos, tan, atan2 = _core.sin, _core.cos, _core.tan, _core.atan2
exp, expm1, log, hypot = _core.exp, _core.expm1, _core.log, _core.hypot
