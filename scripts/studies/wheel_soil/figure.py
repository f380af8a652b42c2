"""Curves of laws with the points that were measured, as SVG."""

import math
from pathlib import Path

COLOURS = ("#888888", "#8e5ea2", "#2e8b57", "#c0392b", "#1b6ca8", "#c9a227")
WIDTH, HEIGHT, MARGIN, COLUMNS = 270, 170, 52, 3


def _ticks(low, high):
    step = 10.0 ** math.floor(math.log10(max(high - low, 1e-9) / 2.0))
    step = next(step * factor for factor in (1, 2, 5, 10) if (high - low) / (step * factor) <= 5)
    return [step * k for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


def _panel(panel, left, top):
    """A panel: (title, label of x, points [(x, y, scatter)], curves [(x, y)] by law in the order of the colours)."""
    title, x_label, points, curves = panel
    good = [(x, y) for x, y, *_ in points if math.isfinite(y)]
    xs = [x for x, _ in good] + [x for curve in curves for x, _ in curve]
    ys = [y for _, y in good] + [y for curve in curves for _, y in curve if math.isfinite(y)] + [0.0]
    x0, x1, y0, y1 = min(xs), max(xs), min(ys), max(ys)
    y0, y1 = y0 - 0.05 * (y1 - y0), y1 + 0.05 * (y1 - y0)
    place = lambda x, y: (left + (x - x0) / ((x1 - x0) or 1.0) * WIDTH, top + HEIGHT - (y - y0) / (y1 - y0) * HEIGHT)
    parts = [f'<rect x="{left}" y="{top}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#888"/>',
             f'<text x="{left}" y="{top - 8}">{title}</text>',
             f'<text x="{left + WIDTH / 2:.0f}" y="{top + HEIGHT + 30}" text-anchor="middle">{x_label}</text>']
    for tick in _ticks(y0, y1):
        _, y = place(x0, tick)
        parts += [f'<line x1="{left}" x2="{left + WIDTH}" y1="{y:.1f}" y2="{y:.1f}" stroke="#e6e6e6"/>',
                  f'<text x="{left - 5}" y="{y + 4:.1f}" text-anchor="end">{tick:.3g}</text>']
    for tick in _ticks(x0, x1):
        x, _ = place(tick, y0)
        parts.append(f'<text x="{x:.1f}" y="{top + HEIGHT + 15}" text-anchor="middle">{tick:.3g}</text>')
    for colour, curve in zip(COLOURS, curves):
        line = " ".join("{:.1f},{:.1f}".format(*place(x, y)) for x, y in curve if math.isfinite(y))
        dashes = ' stroke-dasharray="4 3"' if colour == COLOURS[-1] else ""
        parts.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="1.5"{dashes}/>')
    for x, y, scatter in points:
        if math.isfinite(y):
            px, py = place(x, y)
            reach = scatter / (y1 - y0) * HEIGHT if math.isfinite(scatter) else 0.0
            parts += [f'<line x1="{px:.1f}" x2="{px:.1f}" y1="{py - reach:.1f}" y2="{py + reach:.1f}" stroke="#000"/>',
                      f'<circle cx="{px:.1f}" cy="{py:.1f}" r="3" fill="#000"/>']
    return parts


def write(path, panels, names):
    """Panels three beside each other, below the names of the curves."""
    rows = (len(panels) + COLUMNS - 1) // COLUMNS
    width, height = COLUMNS * (WIDTH + 2 * MARGIN), rows * (HEIGHT + 1.6 * MARGIN) + 50
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" font-family="sans-serif" '
             'font-size="12">', f'<rect width="{width:.0f}" height="{height:.0f}" fill="white"/>']
    for index, name in enumerate(names):
        x = MARGIN + index * (width - MARGIN) / len(names)
        dashes = ' stroke-dasharray="4 3"' if index == len(COLOURS) - 1 else ""
        parts += [f'<line x1="{x:.0f}" x2="{x + 24:.0f}" y1="18" y2="18" stroke="{COLOURS[index]}" stroke-width="2"{dashes}/>',
                  f'<text x="{x + 30:.0f}" y="22">{name}</text>']
    for index, panel in enumerate(panels):
        parts += _panel(panel, MARGIN + (index % COLUMNS) * (WIDTH + 2 * MARGIN),
                        round(60 + (index // COLUMNS) * (HEIGHT + 1.6 * MARGIN)))
    Path(path).write_text("\n".join([*parts, "</svg>"]) + "\n", encoding="utf-8")
