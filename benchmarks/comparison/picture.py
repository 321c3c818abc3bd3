# SPDX-License-Identifier: Apache-2.0
"""A calm bar chart as SVG: one panel for each number of slaves, one row for each program."""
from xml.sax.saxutils import escape

ROW, LABELS, PANEL, GAP, TOP = 22, 132, 236, 16, 84  # [px]
OURS, THEIRS, INK, FAINT = "#2a6f97", "#c3c9ce", "#30363b", "#7b858d"


def text(x, y, words, size=12, colour=INK, anchor="start", weight="normal"):
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" fill="{colour}" '
        f'text-anchor="{anchor}" font-weight="{weight}">{escape(words)}</text>'
    )


def rectangle(x, y, width, height, colour):
    return f'<rect x="{x:.1f}" y="{y:.1f}" width="{max(width, 1):.1f}" height="{height}" fill="{colour}"/>'


def number(value):
    return f"{value:.1f}" if value < 99.95 else f"{value:.0f}"


def draw(title, subtitle, panels, reference):
    """panels: [(heading, {program: value [us]})]. Bars of a panel are as long as the value per that
    of the reference program, which a line marks."""
    names = sorted({name for _, values in panels for name in values}, key=lambda name: order(name, panels, reference))
    height = TOP + ROW * len(names) + 34
    width = LABELS + len(panels) * (PANEL + GAP)
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
        'font-family="Helvetica, Arial, sans-serif">',
        rectangle(0, 0, width, height, "#ffffff"),
        text(16, 26, title, 15, weight="bold"),
        text(16, 45, subtitle, 11, FAINT),
    ]
    for row, name in enumerate(names):
        ours = name.startswith("qtplc/")
        parts.append(
            text(LABELS - 8, TOP + ROW * row + 15, name, 12, OURS if ours else INK, "end", "bold" if ours else "normal")
        )
    for column, (heading, values) in enumerate(panels):
        parts += panel(LABELS + column * (PANEL + GAP), heading, values, names, reference)
    parts.append(
        text(16, height - 12, f"shorter is better; the line is {reference}; in brackets: times that", 11, FAINT)
    )
    return "\n".join([*parts, "</svg>", ""])


def order(name, panels, reference):
    """Programs from fast to slow, by their mean ratio."""
    ratios = [values[name] / values.get(reference, 1.0) for _, values in panels if name in values]
    return sum(ratios) / len(ratios)


def panel(left, heading, values, names, reference):
    scale = values.get(reference) or max(values.values())
    longest = max(values.values()) / scale
    unit = (PANEL - 84) / longest  # [px] of the reference; what is left is for the numbers
    bottom = TOP + ROW * len(names)
    parts = [text(left, TOP - 12, heading, 12, weight="bold")]
    for row, name in enumerate(names):
        if name not in values:
            continue
        y, length = TOP + ROW * row + 4, values[name] / scale * unit
        parts.append(rectangle(left, y, length, ROW - 8, OURS if name.startswith("qtplc/") else THEIRS))
        ratio = f" ({values[name] / scale:.2f})" if reference in values else ""
        parts.append(
            text(left + max(length, unit if length < unit else 0) + 5, y + 11, number(values[name]) + ratio, 11)
        )
    if reference in values:
        parts.append(
            f'<line x1="{left + unit:.1f}" y1="{TOP}" x2="{left + unit:.1f}" y2="{bottom}" '
            f'stroke="{FAINT}" stroke-dasharray="3 3"/>'
        )
    return parts
