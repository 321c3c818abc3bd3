#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the rooms of the sources, and who includes whom, as docs/design/rooms.svg.

The arrows come from the include lines. One that follows from others is left out. What the picture
does not place stops the tool.

usage: draw_rooms.py --write | --check
"""
import math
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/layers"))
import layers  # noqa: E402

# Room: column, row, and what lives there. A group is drawn around the rooms of its folder.
PLACES = {
    "gui3d": (2, 0, "3D view"),
    "gui/window": (2, 1.4, "Control Center"),
    "gui/layout": (0, 2.7, "pages, docking"),
    "gui/charts": (1, 2.7, "plots, export"),
    "gui/gauges": (2, 2.7, "instruments"),
    "gui/setters": (3, 2.7, "sliders, keys"),
    "gui/tables": (4, 2.7, "trees, lists"),
    "gui/panel": (2, 4.1, "shared by panels"),
    "gui/models": (1.5, 5.3, "rows for views"),
    "gui/plot": (2.5, 5.3, "curves, spectra"),
    "gui/plant": (2, 6.5, "a master, seen"),
    "gui/store": (2, 7.7, "past of values"),
    "tools": (6.0, 0, "qtplc"),
    "recording": (7.1, 0, "files of cycles"),
    "replay": (6.0, 1.4, "nodes again"),
    "hardware": (8.2, 0, "drivers, wires"),
    "models": (9.4, 0, "FMUs"),
    "export": (9.4, 1.4, "FMU, DISCON"),
    "formulas": (9.4, 2.7, "of signals"),
    "test_support": (9.4, 5.3, "simulator"),
    "node/api": (7.1, 1.4, "master, node, ports"),
    "node/session": (7.1, 2.7, "control channel"),
    "node/security": (6.0, 4.1, "keys, rights"),
    "node/statistics": (8.2, 4.1, "journal, figures"),
    "node/state": (7.1, 4.1, "tables of states"),
    "node/cycle": (8.2, 5.3, "what a cycle does"),
    "protocol": (6.0, 6.7, "frames, messages"),
    "transport": (8.2, 6.7, "udp, tcp, memory"),
    "signals": (6.0, 7.7, "values, tables"),
    "realtime": (8.2, 7.7, "clock, thread"),
}
GROUPS = ("gui", "node")
COLUMN, ROW, WIDTH, HEIGHT, LEFT, TOP = 118, 72, 110, 44, 32, 20
PALETTE = {"gui": ("#f4f8f1", "#7d9c67"), "node": ("#eef3f8", "#5b7fa6"), "": ("#fbf6ec", "#b59452")}


def room_of(check, path):
    """The room of a source file; public headers belong to their folder."""
    return placed(check.room(path)) if path.parent != check.public else None


def placed(room):
    """The room that the picture shows: a small one belongs to its folder."""
    return room.split("/")[0] if room and room not in PLACES and room.split("/")[0] in PLACES else room


def arrows():
    """Room: the rooms that it includes. Includes of public headers count for the folder that they
    belong to."""
    check = layers.Check(ROOT)
    found = {}
    for path in layers.files(check.source):
        room = room_of(check, path)
        for _, line in layers.code_of(path.read_text()):
            match = re.match(r'\s*#\s*include\s+"([^"]+)"', line)
            target = match and next(
                (f for f in (d / match[1] for d in (path.parent, check.source, check.public)) if f.is_file()), None
            )
            other = placed(check.room(target.resolve())) if target else None
            if not other or other == "all" or group(other) == group(room) and target.parent == check.public:
                continue
            found.setdefault(room, set()).add(other)
    return found


def group(room):
    return room.split("/")[0]


def reduced(found):
    """Without arrows that follow from others."""

    def reaches(begin, end, seen):
        return any(n == end or n not in seen and (seen.add(n) or reaches(n, end, seen)) for n in found.get(begin, ()))

    found = {room: {o for o in others if not runs_up(room, o)} for room, others in found.items()}
    result = set()
    for room, others in found.items():
        for other in others - {room}:
            if not any(reaches(step, other, {room}) for step in others - {room, other}):
                result.add((room, other))
    return result


def runs_up(begin, end):
    return begin in PLACES and end in PLACES and PLACES[begin][1] > PLACES[end][1]


def shown(found):
    """The arrows to draw, between rooms and whole groups."""
    inside, between = {}, {}
    for room, others in found.items():
        for other in others:
            if group(room) == group(other):
                if room != other and room in PLACES and other in PLACES:
                    inside.setdefault(room, set()).add(other)
            else:
                between.setdefault(group(room), set()).add(group(other))
    up = {(room, other) for room, others in inside.items() for other in others if runs_up(room, other)}
    return reduced(inside) | reduced(between) | up


def box(name):
    """Left, top, right and bottom of a room or group."""
    if name in PLACES:
        column, row, _ = PLACES[name]
        x, y = LEFT + column * COLUMN, TOP + row * ROW
        return x, y, x + WIDTH, y + HEIGHT
    boxes = [box(room) for room in PLACES if group(room) == name]
    return (
        min(b[0] for b in boxes) - 12,
        min(b[1] for b in boxes) - 26,
        max(b[2] for b in boxes) + 12,
        max(b[3] for b in boxes) + 12,
    )


def way(begin, end):
    """The corners of an arrow, which goes by the sides of the boxes that face each other."""
    a, b = box(begin), box(end)
    low, high = max(a[0], b[0]), min(a[2], b[2])
    if runs_up(begin, end):
        side, first, last = max(a[2], b[2]) + 8, (a[1] + a[3]) / 2, (b[1] + b[3]) / 2
        return [(a[2], first), (side, first), (side, last), (b[2], last)]
    if low + 20 < high:
        return [((low + high) / 2, a[3]), ((low + high) / 2, b[1])]
    if b[1] >= a[3]:
        return [((a[0] + a[2]) / 2, a[3]), ((b[0] + b[2]) / 2, b[1])]
    y = (max(a[1], b[1]) + min(a[3], b[3])) / 2
    return [(a[2], y), (b[0], y)] if a[2] <= b[0] else [(a[0], y), (b[2], y)]


def arrow(begin, end):
    corners = way(begin, end)
    (x1, y1), (x2, y2) = corners[-2:]
    length = math.hypot(x2 - x1, y2 - y1)
    dx, dy = (x2 - x1) / length, (y2 - y1) / length
    color = "#b3261e" if runs_up(begin, end) else "#4a5a6a"
    tip = [(x2, y2), (x2 - 9 * dx - 4 * dy, y2 - 9 * dy + 4 * dx), (x2 - 9 * dx + 4 * dy, y2 - 9 * dy - 4 * dx)]
    corners[-1] = (x2 - 8 * dx, y2 - 8 * dy)
    return [
        f'<polyline points="{points(corners)}" fill="none" stroke="{color}" stroke-width="1.2"/>',
        f'<polygon points="{points(tip)}" fill="{color}"/>',
    ]


def points(corners):
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in corners)


def rectangle(name):
    x, y, right, bottom = box(name)
    fill, edge = PALETTE.get(group(name), PALETTE[""])
    if name in GROUPS:
        return [
            f'<rect x="{x:g}" y="{y:g}" width="{right - x:g}" height="{bottom - y:g}" rx="8" '
            f'fill="{fill}" stroke="{edge}"/>',
            f'<text x="{x + 12:g}" y="{y + 18:g}" font-weight="bold" fill="#24435f">{name}</text>',
        ]
    middle = (x + right) / 2
    fill = "#ffffff" if group(name) in GROUPS else fill
    title = name.split("/")[-1]
    return [
        f'<rect x="{x:g}" y="{y:g}" width="{WIDTH}" height="{HEIGHT}" rx="5" fill="{fill}" stroke="{edge}"/>',
        f'<text x="{middle:g}" y="{y + 19:g}" text-anchor="middle" font-weight="bold" fill="#24435f">{title}</text>',
        f'<text x="{middle:g}" y="{y + 36:g}" text-anchor="middle" font-size="12" fill="#3c4a57">'
        f"{PLACES[name][2]}</text>",
    ]


def picture():
    found = arrows()
    unknown = {room for room in found if room not in PLACES and room not in GROUPS}
    if unknown:
        sys.exit(f"draw_rooms.py: no place in the picture for {', '.join(sorted(unknown))}; give it one in PLACES")
    names = list(GROUPS) + list(PLACES)
    width, height = max(box(n)[2] for n in names) + 24, max(box(n)[3] for n in names) + 24
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" '
        f'width="{width:g}" height="{height:g}" font-family="Helvetica, Arial, sans-serif" font-size="14" role="img">',
        "<title>The rooms of the sources</title>",
        "<desc>An arrow goes from a room to one that it includes; one that follows from others is left out.</desc>",
        f'<rect width="{width:g}" height="{height:g}" fill="#ffffff"/>',
    ]
    for name in names:
        parts += rectangle(name)
    for begin, end in sorted(shown(found)):
        parts += arrow(begin, end)
    return "\n".join(parts) + "\n</svg>\n"


def main():
    file = ROOT / "docs/design/rooms.svg"
    if sys.argv[1:] == ["--write"]:
        file.write_text(picture())
    elif sys.argv[1:] == ["--check"]:
        if not file.exists() or file.read_text() != picture():
            sys.exit(
                "docs/design/rooms.svg does not show the sources as they are; remedy: docs/design/draw_rooms.py --write"
            )
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
