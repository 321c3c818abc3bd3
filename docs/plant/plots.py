# SPDX-License-Identifier: Apache-2.0
"""Curves and bars as SVG, as calm as those of benchmarks/comparison/picture.py."""
from xml.sax.saxutils import escape

INK, FAINT, GRID = "#30363b", "#7b858d", "#e3e7ea"
COLORS = ["#2a6f97", "#c8553d", "#588157", "#8d6a9f"]
WIDTH, HEIGHT = 760, 320  # [px]
LEFT, RIGHT, TOP, BOTTOM = 70, 20, 62, 46
ROW = 24


def text(x, y, words, size=12, color=INK, anchor="start", weight="normal"):
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" fill="{color}" '
        f'text-anchor="{anchor}" font-weight="{weight}">{escape(words)}</text>'
    )


def line(x1, y1, x2, y2, color, width=1.0, dash=""):
    dashed = f' stroke-dasharray="{dash}"' if dash else ""
    return (
        f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{color}" '
        f'stroke-width="{width:g}"{dashed}/>'
    )


def polyline(points, color, width=1.8, dash=""):
    shown = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    dashed = f' stroke-dasharray="{dash}"' if dash else ""
    return f'<polyline points="{shown}" fill="none" stroke="{color}" stroke-width="{width:g}"{dashed}/>'


def circle(x, y, color):
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{color}"/>'


def picture(height, title, parts):
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" '
            f'height="{height}" font-family="Helvetica, Arial, sans-serif" role="img">',
            f"<title>{escape(title)}</title>",
            f'<rect width="{WIDTH}" height="{height}" fill="#ffffff"/>',
            text(16, 26, title, 15, weight="bold"),
            *parts,
            "</svg>",
            "",
        ]
    )


def ticks(low, high, most=6):
    """Round numbers from low to high."""
    decade = 1e-6
    while True:
        for step in (1, 2, 5):
            if (high - low) / (step * decade) <= most:
                first = -int(-low // (step * decade))
                last = int(high // (step * decade) + 1e-9)
                return [number * step * decade for number in range(first, last + 1)]
        decade *= 10


class Axis:
    """From numbers to pixels."""

    def __init__(self, low, high, begin, end):
        self.low, self.high, self.begin, self.end = low, high, begin, end

    def __call__(self, number):
        return self.begin + (number - self.low) / (self.high - self.low) * (self.end - self.begin)


def curves(title, x, y, lines, marks=False, same_scale=False):
    """x, y: (label, lowest, highest) of an axis; lines: [(name, [(x, y)], dash)]."""
    height = HEIGHT
    across = Axis(x[1], x[2], LEFT, WIDTH - RIGHT)
    if same_scale:
        height = TOP + BOTTOM + round((WIDTH - RIGHT - LEFT) * (y[2] - y[1]) / (x[2] - x[1]))
    up = Axis(y[1], y[2], height - BOTTOM, TOP)
    parts = []
    for number in ticks(x[1], x[2]):
        parts.append(line(across(number), TOP, across(number), height - BOTTOM, GRID))
        parts.append(text(across(number), height - BOTTOM + 17, f"{number:g}", 11, FAINT, "middle"))
    for number in ticks(y[1], y[2]):
        parts.append(line(LEFT, up(number), WIDTH - RIGHT, up(number), GRID))
        parts.append(text(LEFT - 8, up(number) + 4, f"{number:g}", 11, FAINT, "end"))
    parts.append(text((LEFT + WIDTH - RIGHT) / 2, height - 10, x[0], 12, FAINT, "middle"))
    parts.append(text(16, TOP - 12, y[0], 12, FAINT))
    legend = WIDTH - RIGHT
    for index, (name, points, dash) in reversed(list(enumerate(lines))):
        color = COLORS[index % len(COLORS)]
        seen = [(across(a), up(b)) for a, b in points]
        parts.append(polyline(seen, color, dash=dash))
        if marks:
            parts += [circle(a, b, color) for a, b in seen]
        parts.append(text(legend, TOP - 12, name, 12, color, "end", "bold"))
        legend -= 7.2 * len(name) + 18
    return picture(height, title, parts)


def bars(title, unit, rows, names):
    """rows: [(label, [value or None])], a value for each of the names."""
    longest = max(value for _, values in rows for value in values if value is not None)
    left, top = 236, 54
    group = ROW * len(names) // 2 + 14
    length = Axis(0.0, longest, left, WIDTH - 90)
    parts = []
    begin = left
    for index, name in enumerate(names):
        parts.append(text(begin, 45, f"{name} [{unit}]", 12, COLORS[index], weight="bold"))
        begin += 7.2 * len(name) + 60
    for number, (label, values) in enumerate(rows):
        y = top + group * number
        shown = [(index, value) for index, value in enumerate(values) if value is not None]
        parts.append(text(left - 10, y + 6 * len(shown) + 4, label, 12, INK, "end"))
        for place, (index, value) in enumerate(shown):
            bar = y + 12 * place
            parts.append(
                f'<rect x="{left}" y="{bar}" width="{length(value) - left:.1f}" height="10" fill="{COLORS[index]}"/>'
            )
            parts.append(text(length(value) + 6, bar + 9, f"{value:.0f}", 11))
    return picture(top + group * len(rows) + 8, title, parts)
