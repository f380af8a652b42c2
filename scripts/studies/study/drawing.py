"""Curves with intervals, as SVG."""

import math
from pathlib import Path

COLOURS = ("#1b6ca8", "#c0392b", "#2e8b57", "#8e5ea2")
PANEL_W, PANEL_H, MARGIN = 300, 190, 55


def _panel(title, series, x_label, left, top):
    """One diagram: series of (name, [(x, value, low, high)])."""
    points = [point for _, values in series for point in values if not math.isnan(point[1])]
    x0, x1 = min(p[0] for p in points), max(p[0] for p in points)
    y1 = max(p[3] for p in points) or 1.0
    place = lambda x, y: (left + (x - x0) / ((x1 - x0) or 1.0) * PANEL_W,
                          top + PANEL_H - y / y1 * PANEL_H)
    parts = [f'<rect x="{left}" y="{top}" width="{PANEL_W}" height="{PANEL_H}" fill="none" '
             'stroke="#888"/>',
             f'<text x="{left}" y="{top - 8}">{title}</text>',
             f'<text x="{left + PANEL_W / 2:.0f}" y="{top + PANEL_H + 32}" '
             f'text-anchor="middle">{x_label}</text>']
    for share in (0.0, 0.5, 1.0):
        parts.append(f'<text x="{left - 6}" y="{top + PANEL_H * (1 - share) + 4:.0f}" '
                     f'text-anchor="end">{share * y1:.3g}</text>')
        parts.append(f'<text x="{left + share * PANEL_W:.0f}" y="{top + PANEL_H + 16}" '
                     f'text-anchor="middle">{x0 + share * (x1 - x0):.3g}</text>')
    for index, (name, values) in enumerate(series):
        colour = COLOURS[index % len(COLOURS)]
        good = [value for value in values if not math.isnan(value[1])]
        line = " ".join("{:.1f},{:.1f}".format(*place(x, y)) for x, y, _, _ in good)
        parts.append(f'<polyline points="{line}" fill="none" stroke="{colour}"/>')
        for x, _, low, high in good:
            (px, bottom), (_, above) = place(x, max(0.0, low)), place(x, high)
            parts.append(f'<line x1="{px:.1f}" x2="{px:.1f}" y1="{bottom:.1f}" y2="{above:.1f}" '
                         f'stroke="{colour}"/>')
        above_frame = top - 8 - 15 * (len(series) - 1 - index)
        parts.append(f'<text x="{left + PANEL_W}" y="{above_frame}" '
                     f'text-anchor="end" fill="{colour}">{name}</text>')
    return parts


def write_svg(path, panels, x_label):
    """Diagrams two beside each other, with 95 % intervals: panels of (title, series)."""
    rows = (len(panels) + 1) // 2
    width, height = 2 * (PANEL_W + 2 * MARGIN), rows * (PANEL_H + 2 * MARGIN)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
             'font-family="sans-serif" font-size="12">',
             f'<rect width="{width}" height="{height}" fill="white"/>']
    for index, (title, series) in enumerate(panels):
        parts += _panel(title, series, x_label, MARGIN + (index % 2) * (PANEL_W + 2 * MARGIN),
                        MARGIN + (index // 2) * (PANEL_H + 2 * MARGIN))
    Path(path).write_text("\n".join([*parts, "</svg>"]) + "\n", encoding="utf-8")
