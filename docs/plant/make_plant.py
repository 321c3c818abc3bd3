#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Flies the options of the plant and shows what they cost, for docs/plant.md.

    docs/plant/make_plant.py --fly --bin build/release/bin   flies the options: flights.json
    docs/plant/make_plant.py --fly-mast                      flies from and to a mast: mast.json
    docs/plant/make_plant.py --write                         tables and pictures from both
    docs/plant/make_plant.py --check                         whether they are up to date

The flights run in lockstep, so their figures are the same on every machine.
"""
import argparse
import csv
import json
import math
import re
import subprocess
import sys
import tempfile
import textwrap
from pathlib import Path

import plots

HERE = Path(__file__).resolve().parent
PAGE = HERE.parent / "plant.md"
FLIGHTS = HERE / "flights.json"
MAST = HERE / "mast.json"
BEGIN, END = "<!-- flights: made by docs/plant/make_plant.py -->", "<!-- end of the flights -->"
MAST_BEGIN, MAST_END = "<!-- mast: made by docs/plant/make_plant.py -->", "<!-- end of the mast -->"
MAST_PLANTS = {
    "spring": "spring tether, yaw speed as command",
    "turn-rate": "the same with turn-rate steering",
    "realistic": "realistic",
    "drag": "turbines on board, spring tether",
}
DURATION = 1860  # [s]: a minute that does not count, and half an hour
THESIS_WIND = (5.0, 3.0, 0.0)  # [m/s]
SEEDS = range(10, 18)
TURBULENCE = {
    "first-order": "[kite]\nturbulenceModel = first-order\n",
    "kaimal": "[kite]\nturbulenceModel = kaimal\nlengthScale = 35\n",
}
SPEEDS = (5, 6, 7, 8, 9, 10, 12, 14)  # [m/s]
FIGURES = (
    "mean_power_W",
    "electrical_power_W",
    "turbine_power_W",
    "min_altitude_m",
    "max_tether_force_N",
    "recoveries",
    "crashed",
)

# Name, text of the plant file or name of a plant, more options.
OPTIONS = [
    ("the plant of the thesis", "thesis", ()),
    ("wind profile log", "[wind]\nprofile = log\n", ()),
    ("density falling", "[wind]\ndensity = falling\n", ()),
    ("tether straight", "[tether]\nkind = straight\n", ()),
    ("tether in 6 segments", "[tether]\nkind = segments\n", ()),
    ("machine at the winch", "[winch]\nkind = machine\n", ()),
    ("turn-rate steering", "[steering]\nkind = turn-rate\n", ()),
    ("realistic: all of these", "realistic", ()),
    ("realistic, tuned gains", "realistic", ("--gains=tuned",)),
    ("turbines on board", "drag", ()),
    ("turbines on board, tuned gains", "drag", ("--gains=tuned",)),
]


# ---- flights ----


class Hangar:
    """Flies with the programs of a folder."""

    def __init__(self, programs):
        self.programs = programs

    def run(self, program, *arguments):
        try:
            done = subprocess.run(
                [str(self.programs / program), *arguments], capture_output=True, text=True, timeout=600, check=False
            )
        except (OSError, subprocess.TimeoutExpired) as error:
            sys.exit(f"make_plant.py: {error}; remedy: cmake --build --preset release, or --bin FOLDER")
        if done.returncode != 0:
            sys.exit(f"make_plant.py: {program} {' '.join(arguments)} gives {done.returncode}: {done.stderr}")
        return done.stdout

    def fly(self, plant, *arguments, duration=DURATION):
        with tempfile.TemporaryDirectory() as folder:
            report = Path(folder) / "flight.json"
            if plant.startswith("["):
                file = Path(folder) / "plant.ini"
                file.write_text(plant)
                plant = str(file)
            self.run("awe_sil", "--plant", plant, f"--duration={duration}", f"--report={report}", *arguments)
            flight = json.loads(report.read_text())
        return {figure: rounded(flight[figure]) for figure in FIGURES if figure in flight}

    def curves(self, plant, signals, begin, end, every):
        """Rows of values from a recorded flight, time first."""
        with tempfile.TemporaryDirectory() as folder:
            recording, table = Path(folder) / "flight.mcap", Path(folder) / "flight.csv"
            self.run("awe_sil", "--plant", plant, f"--duration={end}", f"--record={recording}")
            self.run(
                "qtplc",
                "export",
                str(recording),
                "-o",
                str(table),
                f"--signals={signals}",
                f"--from={begin}",
                f"--every={every}",
                "--values-only",
            )
            with table.open(newline="") as file:
                rows = list(csv.DictReader(file))
        return {
            name.split(" ")[0]: [rounded(float(row[name])) for row in rows]
            for name in rows[0]
            if name not in ("cycle", "number")
        }


def rounded(value):
    return value if isinstance(value, (bool, int)) else float(f"{value:.6g}")


def wind(speed):
    scale = speed / math.hypot(*THESIS_WIND)
    return "--wind=" + ",".join(repr(scale * component) for component in THESIS_WIND)


def fly_turbulence(hangar):
    """The plant of the thesis in both kinds of turbulence."""
    return {
        model: {str(seed): hangar.fly(plant, "--turbulence=0.15", f"--seed={seed}") for seed in SEEDS}
        for model, plant in TURBULENCE.items()
    }


def fly_all(programs):
    hangar = Hangar(programs)
    flights = {
        "options": {name: hangar.fly(plant, *more) for name, plant, more in OPTIONS},
        "winds": {
            plant: {str(speed): hangar.fly(plant, wind(speed)) for speed in SPEEDS}
            for plant in ("thesis", "realistic", "drag")
        },
        "turbulent": {str(seed): hangar.fly("realistic", "--turbulence=0.15", f"--seed={seed}") for seed in SEEDS},
        "turbulence": fly_turbulence(hangar),
        "cycle": hangar.curves(
            "realistic", "power,electricalPower,tetherLength,winchTension,wingTension", 300, 400, 20
        ),
        "eight": hangar.curves("realistic", "steering,steeringCommand", 320, 340, 5),
        "nodes": hangar.curves("realistic", "bodyPosition_earth,tetherNode*", 300, 400, 2000),
        "air": hangar.curves("realistic", "windVelocity*,bodyPosition_earth", 300, 400, 20),
        "turbines": hangar.curves("drag", "turbinePower,turbineCoefficient,tetherLength", 60, 100, 20),
    }
    FLIGHTS.write_text(shown_json(flights))


def fly_mast(programs):
    MAST.write_text(Hangar(programs).run("awe_mast_flights"))


def shown_json(flights):
    """With the numbers of a list beside each other."""
    numbers = re.compile(r"\[[^][{}]*\]")
    return (
        numbers.sub(lambda found: textwrap.fill(" ".join(found[0].split()), 110), json.dumps(flights, indent=1)) + "\n"
    )


# ---- pictures ----


def series(table, name, factor=1.0):
    begin = table["time"][0]
    return [(time - begin, factor * value) for time, value in zip(table["time"], table[name])]


def highest(*lists):
    return max(value for each in lists for _, value in each)


def lowest(*lists):
    return min(value for each in lists for _, value in each)


def profile(height, kind):
    if kind == "log":
        return math.log(height / 0.03) / math.log(50 / 0.03)
    return (height / 50) ** (1 / 7) if kind == "power" else 1.0


def draw_profile():
    heights = [2 + 2 * step for step in range(100)]
    lines = [
        (kind, [(profile(height, kind), height) for height in heights], dash)
        for kind, dash in (("uniform", ""), ("power", "6 3"), ("log", ""))
    ]
    return plots.curves(
        "Wind over the height, as part of the wind at 50 m", ("w / w(50 m)", 0, 1.4), ("height [m]", 0, 200), lines
    )


def draw_spectrum():
    """f S / sigma^2 of both kinds of turbulence, along the wind of the thesis."""
    speed = math.hypot(*THESIS_WIND)
    decades = [-4 + step / 20 for step in range(101)]

    def first_order(frequency):
        time = 60 / speed  # [s]
        return 4 * time * frequency / (1 + (2 * math.pi * time * frequency) ** 2)

    def kaimal(frequency):
        reduced = frequency * 8.1 * 35 / speed
        return 4 * reduced / (1 + 6 * reduced) ** (5 / 3)

    lines = [
        (name, [(decade, spectrum(10**decade)) for decade in decades], "")
        for name, spectrum in (("first-order, 60 m", first_order), ("kaimal, 35 m", kaimal))
    ]
    return plots.curves(
        "Turbulence along the wind of 5.83 m/s: f S(f) / variance",
        ("logarithm of the frequency in Hz", -4, 1),
        ("f S / variance", 0, 0.4),
        lines,
    )


def draw_cycle(flights):
    cycle = flights["cycle"]
    mechanical, electrical = series(cycle, "power", 1e-3), series(cycle, "electricalPower", 1e-3)
    low, high = lowest(mechanical, electrical), highest(mechanical, electrical)
    return plots.curves(
        "Realistic plant: what the tether brings, and what the machine makes of it",
        ("time [s]", 0, 100),
        ("power [kW]", low, high),
        [("mechanical", mechanical, ""), ("electrical", electrical, "")],
    )


def draw_steering(flights):
    eight = flights["eight"]
    return plots.curves(
        "Realistic plant: steering on the eight",
        ("time [s]", 0, 20),
        ("steering [-]", -0.8, 0.8),
        [("command", series(eight, "steeringCommand"), "4 3"), ("position", series(eight, "steering"), "")],
    )


def downwind(x, y):
    """Of a position, along the mean wind [m]."""
    length = math.hypot(*THESIS_WIND)
    return (x * THESIS_WIND[0] + y * THESIS_WIND[1]) / length


def draw_nodes(flights):
    table = flights["nodes"]
    lines = []
    for row, time in enumerate(table["time"]):
        points = [(0.0, 0.0)]
        names = [f"tetherNode{number}_earth" for number in range(1, 6)] + ["bodyPosition_earth"]
        for name in names:
            x, y, z = (table[f"{name}[{element}]"][row] for element in range(3))
            points.append((downwind(x, y), z))
        lines.append((f"{time:.0f} s", points, ""))
    across = max(x for _, points, _ in lines for x, _ in points)
    up = max(z for _, points, _ in lines for _, z in points)
    return plots.curves(
        "Realistic plant: the tether from the side",
        ("along the wind [m]", 0, 10 * math.ceil(across / 10)),
        ("height [m]", 0, 10 * math.ceil(up / 10)),
        lines[:4],
        marks=True,
        same_scale=True,
    )


def draw_tension(flights):
    cycle = flights["cycle"]
    winch, wing = series(cycle, "winchTension", 1e-3), series(cycle, "wingTension", 1e-3)
    return plots.curves(
        "Realistic plant: tension at both ends of the tether",
        ("time [s]", 0, 100),
        ("tension [kN]", 0, highest(winch, wing)),
        [("at the wing", wing, ""), ("at the winch", winch, "")],
    )


def draw_winds(flights):
    def line_of(plant, figure):
        flown = flights["winds"][plant]
        return [(float(speed), flight[figure] * 1e-3) for speed, flight in flown.items() if not flight["crashed"]]

    lines = [
        ("thesis", line_of("thesis", "mean_power_W"), ""),
        ("realistic, mechanical", line_of("realistic", "mean_power_W"), ""),
        ("realistic, electrical", line_of("realistic", "electrical_power_W"), ""),
        ("turbines on board", line_of("drag", "turbine_power_W"), "6 3"),
    ]
    high = highest(*(points for _, points, _ in lines))
    return plots.curves(
        "Mean power of half an hour over the wind at 50 m",
        ("wind [m/s]", 5, 14),
        ("power [kW]", 0, high),
        lines,
        marks=True,
    )


def draw_options(flights):
    rows = [
        (name, [flight["mean_power_W"], flight.get("electrical_power_W")])
        if "turbine_power_W" not in flight
        else (name, [None, flight["turbine_power_W"]])
        for name, flight in flights["options"].items()
    ]
    return plots.bars("Mean power of half an hour, wind 5.83 m/s", "W", rows, ("of the winch", "electrical"))


def draw_turbines(flights):
    table = flights["turbines"]
    power = series(table, "turbinePower", 1e-3)
    return plots.curves(
        "Turbines on board: power on the eight",
        ("time [s]", 0, 40),
        ("power [kW]", 0, highest(power)),
        [("turbines", power, "")],
    )


def flights_of(mast, plant, is_turbulent):
    return [
        flight for flight in mast["flights"] if flight["plant"] == plant and (flight["turbulence"] > 0) == is_turbulent
    ]


def docked(flights):
    return [flight for flight in flights if flight["docked"]]


def fastest(flights):
    """Points (wind, fastest docking)."""
    landed = docked(flights)
    winds = sorted({flight["wind"] for flight in landed})
    return [(wind, max(each["dockingSpeed"] for each in landed if each["wind"] == wind)) for wind in winds]


def draw_dockings(mast):
    lines = [
        (f"{name}{', turbulent' if is_turbulent else ', calm'}", fastest(flights_of(mast, plant, is_turbulent)), dash)
        for plant, name in (("spring", "spring tether"), ("realistic", "realistic"))
        for is_turbulent, dash in ((False, ""), (True, "6 3"))
    ]
    high = highest(*(points for _, points, _ in lines))
    return plots.curves(
        "Fastest docking over the wind", ("wind [m/s]", 6, 12), ("speed [m/s]", 0, high), lines, marks=True
    )


def draw_day(mast):
    minutes = [(time / 60, wind, length) for time, wind, length in mast["day"]]
    return plots.curves(
        "A calm day at the mast",
        ("time [min]", 0, 40),
        ("wind [m/s], tether [10 m]", 0, 21),
        [
            ("wind", [(time, wind) for time, wind, _ in minutes], ""),
            ("tether length / 10", [(time, 0.1 * length) for time, _, length in minutes], ""),
        ],
    )


# ---- table ----


def of_all(flights, all_flights):
    return f"{len(flights)} of {len(all_flights)}"


def mast_row(mast, plant, is_turbulent):
    flown = flights_of(mast, plant, is_turbulent)
    winds = ", ".join(f"{wind:g}" for wind in sorted({flight["wind"] for flight in flown}))
    speeds = ", ".join(f"{speed:.2f}" for _, speed in fastest(flown))
    air = "turbulent" if is_turbulent else "calm"
    return f"| {MAST_PLANTS[plant]} | {air} | {winds} | {of_all(docked(flown), flown)} | {speeds} |"


def mast_table(mast):
    turbulent = [day for day in mast["days"] if day["turbulence"] > 0]
    calm = next(day for day in mast["days"] if day["turbulence"] == 0)
    speeds = [day["dockingSpeed"] for day in docked(turbulent)]
    cycles = [day["cycles"] for day in turbulent]
    return "\n".join(
        [
            MAST_BEGIN,
            "",
            "| plant | air | wind [m/s] | docked | fastest docking at these winds [m/s] |",
            "|---|---|---|---|---|",
            *(mast_row(mast, plant, is_turbulent) for plant in MAST_PLANTS for is_turbulent in (False, True)),
            "",
            f"A calm day: {calm['cycles']} pumping cycles, {calm['energy'] / 3.6e6:.2f} kWh, docking at "
            f"{calm['dockingSpeed']:.2f} m/s. Turbulent days:",
            f"{of_all(speeds, turbulent)} end on the mast, after {min(cycles)} to {max(cycles)} cycles, with dockings "
            f"at {min(speeds):.2f} to {max(speeds):.2f} m/s.",
            "",
            MAST_END,
        ]
    )


def turbulence_row(model, flown):
    powers = [flight["mean_power_W"] for flight in flown]
    crashes = sum(flight["crashed"] for flight in flown)
    mean = sum(powers) / len(powers)
    return f"| {model} | {min(powers):.0f} W to {max(powers):.0f} W | {mean:.0f} W | {crashes} |"


def table(flights):
    thesis = flights["options"]["the plant of the thesis"]["mean_power_W"]
    lines = [
        BEGIN,
        "",
        "| option | mean power | of the thesis | electrical | lowest altitude | greatest force | recoveries |",
        "|---|---|---|---|---|---|---|",
    ]
    for name, flight in flights["options"].items():
        power = flight.get("turbine_power_W", flight["mean_power_W"])
        electrical = flight.get("electrical_power_W")
        shown = f"{electrical:.0f} W ({100 * electrical / flight['mean_power_W']:.0f} %)" if electrical else "-"
        lines.append(
            f"| {name} | {power:.0f} W | {100 * power / thesis:.0f} % | {shown} "
            f"| {flight['min_altitude_m']:.1f} m | {flight['max_tether_force_N']:.0f} N | {flight['recoveries']} |"
        )
    turbulent = list(flights["turbulent"].values())
    powers = [flight["mean_power_W"] for flight in turbulent]
    electrical = [flight["electrical_power_W"] for flight in turbulent]
    crashes = sum(flight["crashed"] for flight in turbulent)
    lines += [
        "",
        f"In turbulence of 15 % (seeds {SEEDS[0]} to {SEEDS[-1]}) the realistic plant has {min(powers):.0f} W to "
        f"{max(powers):.0f} W,",
        f"of which {min(electrical):.0f} W to {max(electrical):.0f} W are electrical, and {crashes} crashes.",
        "",
        "| turbulence of 15 %, plant of the thesis, same seeds | mean power | mean of the seeds | crashes |",
        "|---|---|---|---|",
        *(turbulence_row(model, list(flown.values())) for model, flown in flights["turbulence"].items()),
        "",
        "| wind at 50 m | thesis | realistic | electrical | of the mechanical | turbines on board |",
        "|---|---|---|---|---|---|",
    ]
    for speed in SPEEDS:
        plants = {plant: flown[str(speed)] for plant, flown in flights["winds"].items()}
        realistic = plants["realistic"]
        part = realistic["electrical_power_W"] / realistic["mean_power_W"]
        drag = "crash" if plants["drag"]["crashed"] else f"{plants['drag']['turbine_power_W']:.0f} W"
        lines.append(
            f"| {speed} m/s | {plants['thesis']['mean_power_W']:.0f} W | {realistic['mean_power_W']:.0f} W "
            f"| {realistic['electrical_power_W']:.0f} W | {100 * part:.1f} % | {drag} |"
        )
    return "\n".join([*lines, "", END])


# ---- files ----


def replaced(page, begin, end, text):
    return page[: page.index(begin)] + text + page[page.index(end) + len(end) :]


def made():
    """What each file should hold."""
    flights, mast = json.loads(FLIGHTS.read_text()), json.loads(MAST.read_text())
    files = {
        "dockings.svg": draw_dockings(mast),
        "day.svg": draw_day(mast),
        "profile.svg": draw_profile(),
        "spectrum.svg": draw_spectrum(),
        "cycle.svg": draw_cycle(flights),
        "steering.svg": draw_steering(flights),
        "nodes.svg": draw_nodes(flights),
        "tension.svg": draw_tension(flights),
        "winds.svg": draw_winds(flights),
        "options.svg": draw_options(flights),
        "turbines.svg": draw_turbines(flights),
    }
    page = replaced(PAGE.read_text(), BEGIN, END, table(flights))
    page = replaced(page, MAST_BEGIN, MAST_END, mast_table(mast))
    return {**{HERE / name: text for name, text in files.items()}, PAGE: page}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fly", action="store_true")
    parser.add_argument("--fly-mast", action="store_true")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--bin", type=Path, default=HERE.parent.parent / "build/release/bin")
    arguments = parser.parse_args()
    if arguments.fly:
        fly_all(arguments.bin)
    if arguments.fly_mast:
        fly_mast(arguments.bin)
    if arguments.write:
        for file, text in made().items():
            file.write_text(text)
    if arguments.check:
        stale = [file.name for file, text in made().items() if not file.exists() or file.read_text() != text]
        if stale:
            sys.exit(
                f"{', '.join(stale)}: not as flights.json and mast.json say; remedy: docs/plant/make_plant.py --write"
            )
    if not (arguments.fly or arguments.fly_mast or arguments.write or arguments.check):
        parser.print_help()


if __name__ == "__main__":
    main()
