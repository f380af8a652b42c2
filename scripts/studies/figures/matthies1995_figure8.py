"""Matthies 1995, figure 8: the heading error along a run among three rocks."""

from .three_rock_course import HEADING as FIGURE  # noqa: F401
