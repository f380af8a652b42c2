"""Matthies 1995, figure 7: a run among three rocks in plan view."""

from .three_rock_course import PLAN as FIGURE  # noqa: F401
