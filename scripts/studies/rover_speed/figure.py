"""The figure of scripts/studies/rover_speed/rover_speed.py: metres per hour by computer, on a scale of powers, as SVG."""

import math
from dataclasses import dataclass

WIDTH, LEFT, RIGHT, TOP, ROW, GAP = 900, 250, 30, 64, 30, 96
X_LOW, X_HIGH = 3.0, 350.0
TICKS = (5, 10, 20, 50, 100, 200)


@dataclass(frozen=True)
class Series:
    name: str
    colour: str


@dataclass(frozen=True)
class Panel:
    """Rows of (name, one range for each series or none); lines of (m/h, what is written above)."""
    title: str
    rows: tuple
    lines: tuple


def x_of(m_per_h):
    share = math.log(m_per_h / X_LOW) / math.log(X_HIGH / X_LOW)
    return LEFT + share * (WIDTH - LEFT - RIGHT)


def _text(x, y, text, anchor="start", style=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{style}>{text}</text>'


def _mark(span, y, series):
    x = x_of(span.value)
    return [f'<line x1="{x_of(max(span.low, X_LOW)):.1f}" x2="{x_of(span.high):.1f}" y1="{y:.1f}" y2="{y:.1f}" '
            f'stroke="{series.colour}" stroke-width="2" stroke-opacity="0.35"/>',
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{series.colour}"/>']


def _panel(panel, series, top):
    bottom = top + ROW * len(panel.rows)
    parts = [_text(10, top - 30, panel.title, style=' font-weight="bold"'),
             f'<rect x="{LEFT}" y="{top}" width="{WIDTH - LEFT - RIGHT}" height="{bottom - top}" fill="none" '
             'stroke="#888"/>']
    for tick in TICKS:
        x = x_of(tick)
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{top}" y2="{bottom}" stroke="#ddd"/>')
        parts.append(_text(x, bottom + 16, str(tick), "middle"))
    parts.append(_text((LEFT + WIDTH - RIGHT) / 2, bottom + 34, "metres per hour", "middle"))
    for m_per_h, label in panel.lines:
        x = x_of(m_per_h)
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{top - 4}" y2="{bottom}" stroke="#000" '
                     'stroke-dasharray="4 3"/>')
        parts.append(_text(x, top - 9, label, "middle", ' font-size="11"'))
    for index, (name, spans) in enumerate(panel.rows):
        y = top + ROW * index
        parts.append(_text(LEFT - 8, y + ROW / 2 + 4, name, "end"))
        for place, (span, one) in enumerate(zip(spans, series, strict=True)):
            if span is not None:
                parts += _mark(span, y + ROW * (place + 1) / (len(series) + 1), one)
    return parts, bottom


def draw(panels, series, foot):
    """SVG of the panels below each other, with the series' names on top."""
    parts, top = [], TOP + 18 * len(series)
    for index, one in enumerate(series):
        y = 24 + 18 * index
        parts += [f'<circle cx="20" cy="{y - 4}" r="4" fill="{one.colour}"/>', _text(32, y, one.name)]
    for panel in panels:
        drawn, bottom = _panel(panel, series, top)
        parts += drawn
        top = bottom + GAP
    height = bottom + 44 + 16 * len(foot)
    parts += [_text(10, bottom + 54 + 16 * index, line, style=' font-size="11"') for index, line in enumerate(foot)]
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height + 16}" '
                      'font-family="sans-serif" font-size="13">',
                      f'<rect width="{WIDTH}" height="{height + 16}" fill="white"/>', *parts, "</svg>"]) + "\n"
