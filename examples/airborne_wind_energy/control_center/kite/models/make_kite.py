#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes kite.obj: an arched ram-air kite with cells, open noses and bridle lines, 8 m wide along
its arch.

usage: make_kite.py FILE

Axes as in the example's plant: x to the tail, y along the span, z out of the top side; metres; the
origin is the middle of the wing. Vertices carry colours behind their coordinates (v x y z r g b),
which many programs know; bridle lines are elements "l".
"""
import math
import sys

CELLS = 12
SLICES = 3  # between two ribs, so that cells bulge
ARCH_Y, ARCH_Z = 3.3, 1.9  # half axes of the ellipse along which the wing is bent [m]
ARCH_END = math.radians(74)  # of its ends
ROOT_CHORD, TIP_CHORD = 2.0, 0.95  # [m]
THICKNESS = 0.15  # of the chord
UPPER = [0.0, 0.015, 0.05, 0.11, 0.2, 0.32, 0.46, 0.62, 0.8, 1.0]  # places along the chord
LOWER = [0.82, 0.6, 0.4, 0.22, 0.1, 0.035]
BRIDLE = (0.1, 0.0, -4.6)  # where the lines meet [m]
LINES_AT = (0.08, 0.6)  # places along the chord where lines begin
WHITE, ORANGE, BLUE, DARK = (0.96, 0.96, 0.94), (0.95, 0.45, 0.13), (0.13, 0.33, 0.58), (0.16, 0.17, 0.2)
STRIPES = (BLUE, BLUE, WHITE, ORANGE, ORANGE, WHITE)  # of one half, from the tip; the other half is its mirror image


def half_thickness(x):
    """Of the aerofoil at place x, a blunt nose and a sharp tail (NACA, 4 digits) [chords]."""
    return 5 * THICKNESS * (0.2969 * math.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)


def camber(x):
    return 0.045 * math.sin(math.pi * min(1.0, x**0.75))


def profile():
    """Places (x, z) around the aerofoil [chords], from the nose over the top to the tail and back
    below."""
    top = [(x, camber(x) + half_thickness(x)) for x in UPPER]
    return top + [(x, camber(x) - 0.55 * half_thickness(x)) for x in LOWER]


def frame(station):
    """Middle line, unit vector out of the top side and chord at a station -1 ... 1 along the
    span."""
    angle = ARCH_END * station
    place = (0.0, ARCH_Y * math.sin(angle), ARCH_Z * (math.cos(angle) - 0.8))
    length = math.hypot(ARCH_Z * math.sin(angle), ARCH_Y * math.cos(angle))
    up = (0.0, ARCH_Z * math.sin(angle) / length, ARCH_Y * math.cos(angle) / length)
    chord = TIP_CHORD + (ROOT_CHORD - TIP_CHORD) * math.sqrt(max(0.0, 1 - station**2)) ** 0.8
    return place, up, chord


def point(station, x, z, bulge):
    place, up, chord = frame(station)
    height = chord * (z + bulge * (0.02 if z > 0.02 else -0.012))
    return (chord * (x - 0.35) + 0.16 * station**2, place[1] + height * up[1], place[2] + height * up[2])


def minus(a, b):
    return tuple(p - q for p, q in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(sum(p * p for p in a))
    return tuple(p / length for p in a) if length > 0 else (0.0, 0.0, 1.0)


class Model:
    def __init__(self):
        self.vertices, self.normals, self.faces, self.lines = [], [], [], []

    def add_vertex(self, place, color, normal=None):
        self.vertices.append((place, color))
        if normal is not None:
            self.normals.append(normal)
        return len(self.vertices)

    def add_cell(self, index):
        around = profile()
        stripe = index if index < CELLS // 2 else CELLS - 1 - index
        rows = []
        for part in range(SLICES + 1):
            station = 2 * (index + part / SLICES) / CELLS - 1
            bulge = math.sin(math.pi * part / SLICES)
            rows.append([point(station, x, z, bulge) for x, z in around])
        numbers = []
        for part, row in enumerate(rows):
            one, other = rows[min(part + 1, SLICES)], rows[max(part - 1, 0)]
            line = []
            for i, place in enumerate(row):
                along = minus(row[(i + 1) % len(row)], row[i - 1])
                normal = unit(cross(along, minus(one[i], other[i])))
                is_nose = i == 0 or i == len(row) - 1
                line.append(self.add_vertex(place, DARK if is_nose else STRIPES[stripe], normal))
            numbers.append(line)
        for a, b in zip(numbers, numbers[1:]):
            for i in range(len(a)):
                j = (i + 1) % len(a)
                self.faces.append((a[i], a[j], b[j], b[i]))

    def add_bridle(self):
        end = self.add_vertex(BRIDLE, DARK)
        for side in (-1, 1):
            for first in (1, 4):
                knot = self.add_vertex((0.15, side * (0.35 + 0.28 * first), BRIDLE[2] + 1.9), DARK)
                self.lines.append((end, knot))
                for cell in range(first, first + 3, 2):
                    for x in LINES_AT:
                        z = camber(x) - 0.55 * half_thickness(x)
                        self.lines.append((knot, self.add_vertex(point(side * 2 * cell / CELLS, x, z, 0), DARK)))

    def text(self):
        out = ["# SPDX-License-Identifier: Apache-2.0", "# Made by make_kite.py: change that, not this.", "o kite"]
        out += [
            "v " + " ".join(f"{p:.3f}" for p in place) + " " + " ".join(f"{p:g}" for p in color)
            for place, color in self.vertices
        ]
        out += ["vn " + " ".join(f"{p + 0.0:.3f}" for p in normal) for normal in self.normals]
        out += ["f " + " ".join(f"{i}//{i}" for i in face) for face in self.faces]
        out += [f"l {a} {b}" for a, b in self.lines]
        return "\n".join(out) + "\n"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    model = Model()
    for index in range(CELLS):
        model.add_cell(index)
    model.add_bridle()
    with open(sys.argv[1], "w", encoding="ascii", newline="\n") as file:
        file.write(model.text())


if __name__ == "__main__":
    main()
