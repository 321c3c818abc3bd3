#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Exports a recording with qtplc and reads the tables with other programs: CSV with Python, Parquet
as its format says, MATLAB with h5py, MATLAB and CSV with Octave, where these are installed. Writes
reports with plots of a layout, and with pictures.

usage: tst_export.py QTPLC MAKE_RECORDING
"""
import base64
import csv
import json
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

QTPLC, MAKE_RECORDING = sys.argv[1:3]
CYCLES = 800
MAT = """
import sys, h5py, numpy
with h5py.File(sys.argv[1], "r") as file:
    for name in sorted(file):
        if name != "quality":
            texts = {k: v.decode() if isinstance(v, bytes) else v for k, v in file[name].attrs.items()}
            attributes = " ".join(f"{k}={texts[k]}" for k in sorted(texts))
            print(name, file[name].dtype, file[name].shape, attributes)
    print("class", file["quality"].attrs["MATLAB_class"].decode(), sorted(file["quality"]))
    number = numpy.arange(file["cycle"].shape[1])
    assert (file["cycle"][0] == number).all() and (file["position_x_2"][0] == number).all()
    assert abs(file["position_x"][0] - numpy.sin(0.1 * number)).max() < 1e-14
    assert abs(file["time"][0] - 0.01 * number).max() < 1e-12
    texts = ["".join(map(chr, column)).rstrip() for column in file["phase"][()].T]
    assert texts == ["a" * (n % 7) for n in number]
    assert (file["quality/position_x"][0] == 0).all() and file["force"].shape == (3, len(number))
"""

OCTAVE = """
f = load(argv(){1});
n = (0:799)';
assert(double(f.cycle(:)), n);
assert(double(f.position_x_2(:)), n);
assert(max(abs(f.position_x(:) - sin(0.1 * n))) < 1e-14);
assert(max(abs(f.time(:) - 0.01 * n)) < 1e-12);
assert(all(f.quality.position_x(:) == 0));
t = dlmread(argv(){2}, ",", 1, 0);
assert(t(:, 2), n);
assert(max(abs(t(2:end, 5) - sin(0.1 * n(2:end)))) < 1e-14);
assert(all(t(:, 6) == 0));
"""


def run(*arguments, code=0):
    done = subprocess.run([QTPLC, "export", *map(str, arguments)], capture_output=True, text=True, timeout=60)
    assert done.returncode == code, f"{arguments}: {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


class Thrift:
    """Reads the compact protocol: structs as dictionaries by the number of the field."""

    def __init__(self, data, at=0):
        self.data, self.at = data, at

    def varint(self):
        value = shift = 0
        while True:
            byte = self.data[self.at]
            self.at += 1
            value |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                return value

    def integer(self):
        value = self.varint()
        return value >> 1 ^ -(value & 1)

    def bytes(self):
        size = self.varint()
        self.at += size
        return self.data[self.at - size : self.at]

    def value(self, kind):
        if kind in (1, 2):
            return kind == 1
        if kind in (5, 6):
            return self.integer()
        if kind == 8:
            return self.bytes()
        if kind == 12:
            return self.struct()
        assert kind == 9, f"type {kind}"
        head = self.data[self.at]
        self.at += 1
        count = head >> 4 if head >> 4 < 15 else self.varint()
        return [self.value(head & 15) for _ in range(count)]

    def struct(self):
        fields, number = {}, 0
        while self.data[self.at]:
            head = self.data[self.at]
            self.at += 1
            number += head >> 4
            fields[number] = self.value(head & 15)
        self.at += 1
        return fields


def parquet(data):
    """Columns by name, each a list, and the schema."""
    assert data[:4] == data[-4:] == b"PAR1"
    (size,) = struct.unpack("<I", data[-8:-4])
    meta = Thrift(data[-8 - size : -8]).struct()
    schema = {element[4].decode(): element for element in meta[2][1:]}
    columns = {name: [] for name in schema}
    for group in meta[4]:
        for chunk in group[1]:
            about = chunk[3]
            assert about[4] == 6 and about[2] == [0]
            reader = Thrift(data, about[9])
            page = reader.struct()
            packed = data[reader.at : reader.at + page[3]]
            assert about[7] == reader.at - about[9] + page[3]
            plain = subprocess.run(["zstd", "-dc"], input=packed, stdout=subprocess.PIPE, check=True).stdout
            assert len(plain) == page[2] and page[5][1] == about[5] == group[3]
            columns[about[3][0].decode()] += values(plain, about[1], about[5])
    assert all(len(column) == meta[3] for column in columns.values())
    return columns, schema


def values(plain, kind, count):
    if kind == 6:
        found, at = [], 0
        for _ in range(count):
            (size,) = struct.unpack_from("<I", plain, at)
            found.append(plain[at + 4 : at + 4 + size].decode())
            at += 4 + size
        return found
    return list(struct.unpack(f"<{count}{'?iq?fd'[kind]}", plain))


class Exports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        cls.file = cls.folder / "flight.mcap"
        subprocess.run([MAKE_RECORDING, str(cls.file)], check=True, stdout=subprocess.DEVNULL)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def output(self, name):
        path = self.folder / name
        path.unlink(missing_ok=True)
        return path

    def rows(self, *arguments):
        output = self.output("table.csv")
        run(self.file, "-o", output, *arguments)
        with open(output, newline="") as file:
            return list(csv.reader(file))

    def test_csv_has_each_cycle_with_its_qualities(self):
        rows = self.rows()
        self.assertEqual(
            rows[0],
            "time [s],cycle,time,time.quality,position.x [m],position.x.quality,force[0] [N],force[1] [N],force[2] [N],"
            "force.quality,position_x,position_x.quality,phase,phase.quality,on,on.quality".split(","),
        )
        self.assertEqual(len(rows), CYCLES + 1)
        for number, row in enumerate(rows[1:]):
            self.assertEqual(float(row[4]), math.sin(0.1 * number) if number else 0.0)
            self.assertEqual([row[1], row[5], row[10], row[12]], [str(number), "0", str(number), "a" * (number % 7)])
            self.assertAlmostEqual(float(row[0]), 0.01 * number)

    def test_a_selection_has_its_signals_times_and_cycles_only(self):
        rows = self.rows("--signals", "pos*", "--from", "1", "--to", "2", "--every", "20", "--values-only")
        self.assertEqual(rows[0], ["time [s]", "cycle", "position.x [m]", "position_x"])
        self.assertEqual([row[1] for row in rows[1:]], ["100", "120", "140", "160", "180", "200"])
        self.assertEqual([row[0] for row in rows[1:3]], ["0", "0.2"])

    def test_parquet_has_the_values_of_the_csv(self):
        output = self.output("table.parquet")
        self.assertIn("800 rows", run(self.file, "-o", output))
        columns, schema = parquet(output.read_bytes())
        self.assertEqual(columns["cycle"], list(range(CYCLES)))
        self.assertEqual(columns["position_x"], list(range(CYCLES)))
        self.assertEqual(schema["position_x"][6], 16)
        self.assertEqual(columns["position.x"][1:], [math.sin(0.1 * n) for n in range(1, CYCLES)])
        self.assertEqual(columns["phase"], ["a" * (n % 7) for n in range(CYCLES)])
        self.assertEqual(columns["time.quality"], [0] * CYCLES)
        self.assertEqual(schema["time"][1], 5, "seconds, and not the signal of the same name")

    def test_matlab_has_the_values_of_the_csv(self):
        if "mat" not in run(self.file, "-o", self.output("table.txt"), code=2):
            self.skipTest("this qtplc was built without HDF5")
        output = self.output("table.mat")
        run(self.file, "-o", output)
        head = output.read_bytes()[:128]
        self.assertTrue(head.startswith(b"MATLAB 7.3 MAT-file"))
        self.assertEqual(head[124:], b"\0\2IM")
        if subprocess.run(["/usr/bin/python3", "-c", "import h5py"], capture_output=True).returncode:
            self.skipTest("h5py is missing (Debian: python3-h5py)")
        read = subprocess.run(["/usr/bin/python3", "-c", MAT, output], capture_output=True, text=True)
        self.assertEqual(read.returncode, 0, read.stderr)
        self.assertIn("position_x float64 (1, 800) MATLAB_class=double description=of the kite", read.stdout)
        self.assertIn("phase uint16 (12, 800) MATLAB_class=char MATLAB_int_decode=2", read.stdout)
        self.assertIn("class struct ['force', 'on', 'phase', 'position_x', 'position_x_2', 's_time']", read.stdout)

    def test_octave_reads_the_tables(self):
        octave = shutil.which("octave-cli")
        if not octave:
            self.skipTest("octave-cli is missing (Debian: octave)")
        matlab, table = self.output("table.mat"), self.output("table.csv")
        run(self.file, "-o", table)
        if "mat" not in run(self.file, "-o", self.output("table.txt"), code=2):
            self.skipTest("this qtplc was built without HDF5")
        run(self.file, "-o", matlab)
        script = self.folder / "read.m"
        script.write_text(OCTAVE)
        read = subprocess.run([octave, "--no-gui", "-q", script, matlab, table], capture_output=True, text=True)
        self.assertEqual(read.returncode, 0, read.stderr)

    def test_a_file_that_is_there_is_replaced_by_force_only(self):
        output = self.output("there.csv")
        output.write_text("mine")
        self.assertIn("is there already", run(self.file, "-o", output, code=2))
        self.assertEqual(output.read_text(), "mine")
        run(self.file, "-o", output, "--force")
        self.assertGreater(output.stat().st_size, 1000)
        self.assertEqual(output.stat().st_mode & 0o777, 0o666 & ~os.umask(os.umask(0o22)))

    def test_a_full_disk_is_an_error_and_leaves_no_file(self):
        for name in ("full.csv", "full.parquet", "full.mat"):
            output = self.output(name)
            command = f"ulimit -f 8; exec '{QTPLC}' export '{self.file}' -o '{output}'"
            done = subprocess.run(["bash", "-c", f"trap '' XFSZ; {command}"], capture_output=True, text=True)
            if "without HDF5" in done.stderr:
                continue
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("cannot write", done.stderr)
            self.assertFalse(output.exists())
        self.assertEqual(list(self.folder.glob(".qtplc*")), [])

    def test_what_is_not_there_is_said(self):
        output = self.output("no.csv")
        self.assertIn("did you mean", run(self.file, "-o", output, "--signals", "positon.x", code=2))
        self.assertIn("no signal matches", run(self.file, "-o", output, "--signals", "wing*", code=2))
        self.assertIn("is not a time", run(self.file, "-o", output, "--from", "noon", code=2))
        self.assertIn("no cycle of these times", run(self.file, "-o", output, "--from", "100", code=2))
        self.assertIn("is not a format", run(self.file, "-o", self.output("no.xls"), code=2))
        self.assertIn("cannot open", run(self.folder / "nothing.mcap", "-o", output, code=2))
        self.assertIn("use --output", run(self.file, code=2))
        self.assertFalse(output.exists())

    def test_a_damaged_recording_gives_the_rest_and_an_error(self):
        data = bytearray(self.file.read_bytes())
        at = data.index(b"zstd") + 60
        data[at] ^= 1
        damaged = self.folder / "damaged.dat"
        damaged.write_bytes(data)
        output = self.output("rest.csv")
        self.assertIn("1 places of the recording are damaged", run(damaged, "-o", output, code=1))
        self.assertEqual(len(output.read_text().splitlines()), CYCLES - 200 + 1)


LAYOUT = {
    "format": "QtPLC layout",
    "tabs": [
        {
            "tree": {
                "split": "vertical",
                "children": [
                    {
                        "type": "Time plot",
                        "settings": {
                            "title": "Places",
                            "curves": [
                                {"signal": "position.x"},
                                {"signal": "force[1]", "gain": -2, "offset": 1, "name": "drag"},
                                {"signal": "force[2]"},
                                {"signal": "= norm(force)"},
                                {"signal": "= derivative(position.x)", "name": "speed"},
                                {"signal": "= 2*wind"},
                                {"signal": "wind"},
                                {"signal": "on", "visible": False},
                            ],
                        },
                    },
                    {"type": "Gauge", "settings": {"signal": "time"}},
                ],
            }
        }
    ],
}
PNG = b"\x89PNG\r\n\x1a\n" + bytes(16)


class Reports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        subprocess.run([MAKE_RECORDING, str(cls.folder / "flight.mcap")], check=True, stdout=subprocess.DEVNULL)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def report(self, *arguments, code=0):
        """The page, or what is said in place of it."""
        page = self.folder / "report.html"
        page.unlink(missing_ok=True)
        command = [QTPLC, "report", "flight.mcap", "-o", page.name, *arguments]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(page.exists(), code == 0)
        return done.stderr if code else page.read_text()

    def write(self, name, content):
        (self.folder / name).write_bytes(content)
        return name

    def test_the_plots_are_those_of_the_layout(self):
        page = self.report("--layout", self.write("layout.json", json.dumps(LAYOUT).encode()))
        plots = page[page.index("Signals over time") : page.index("<h2>Events")]
        captions = re.findall(r"<figcaption>(.*?)</figcaption>", plots)
        self.assertEqual(captions[0], "Places: position.x [m]")
        self.assertEqual(
            captions[1],
            'Places [N] <span class="c0">drag</span> <span class="c1">force[2]</span> '
            '<span class="c2">norm(force)</span>',
            "one axis for a unit",
        )
        self.assertEqual(captions[2:], ["Places: speed [m/s]", "Places"])
        self.assertIn("Not drawn: = 2*wind: the recording has no signal wind (at character 5 of", plots)
        self.assertIn("Not drawn: wind: the recording has no number of this name.", plots)
        self.assertEqual(plots.count('class="curve'), 5)

    def test_gain_and_offset_are_those_of_the_layout(self):
        settings = LAYOUT["tabs"][0]["tree"]["children"][0]["settings"]
        plain = {"signal": "position_x"}

        def labels(curve):
            layout = dict(LAYOUT, tabs=[{"tree": {"type": "Time plot", "settings": dict(settings, curves=[curve])}}])
            page = self.report("--layout", self.write("one.json", json.dumps(layout).encode()))
            plots = page[page.index("Signals over time") : page.index("<h2>Events")]
            return [float(n) for n in re.findall(r'text-anchor="end">(.*?)<', plots)]

        self.assertEqual(labels(plain), [0, 200, 400, 600, 800])
        self.assertEqual(labels(dict(plain, gain=-1, offset=100)), [-600, -400, -200, 0])

    def labels(self, formula, *arguments):
        """The numbers at the axis of values."""
        settings = {"curves": [{"signal": formula}]}
        layout = {"format": "QtPLC layout", "tabs": [{"tree": {"type": "Time plot", "settings": settings}}]}
        page = self.report("--layout", self.write("formula.json", json.dumps(layout).encode()), *arguments)
        plots = page[page.index("Signals over time") : page.index("<h2>Events")]
        return [float(n) for n in re.findall(r'text-anchor="end">(.*?)<', plots)]

    def test_formulas_are_those_of_a_window(self):
        # position_x counts the cycles, 100 in a second, from 0 to 799.
        self.assertEqual(self.labels("= 2*position_x - 800"), [-500, 0, 500])
        self.assertEqual(self.labels("= integral(position_x)/8"), [0, 100, 200, 300, 400])
        begun = self.labels("= integral(position_x)/8", "--from", "4")
        self.assertEqual(begun, [0, 100, 200, 300], "from the begin of the report on")
        product = "= position_x * derivative(position_x) / 100"
        self.assertEqual(self.labels(product), [0, 200, 400, 600, 800], "its derivative is 100")

    def test_formulas_that_cannot_be_calculated_are_named_with_the_reason(self):
        for formula, reason in {
            "= force": "is an array; choose an element, force[0], or take norm(force)",
            "= force[7]": "the recording has no element force[7]",
            "= phase": "phase is not a number",
            "= 1 +": "a value is missing",
            "= 3": "a formula needs a signal",
            "= sin(": "this parenthesis is not closed",
        }.items():
            settings = {"curves": [{"signal": formula}]}
            layout = {"format": "QtPLC layout", "tabs": [{"tree": {"type": "Time plot", "settings": settings}}]}
            page = self.report("--layout", self.write("formula.json", json.dumps(layout).encode()))
            self.assertIn(f"Not drawn: {formula}: ", page)
            self.assertIn(reason, page)

    def test_states_are_strips(self):
        curves = [{"signal": "position_x", "bands": True, "name": "phase"}, {"signal": "position.x"}]
        layout = {"format": "QtPLC layout", "tabs": [{"tree": {"type": "Time plot", "settings": {"curves": curves}}}]}
        page = self.report("--layout", self.write("bands.json", json.dumps(layout).encode()), "--to", "0.05")
        plots = page[page.index("Signals over time") : page.index("<h2>Events")]
        self.assertEqual(re.findall("<figcaption>(.*?)</figcaption>", plots), ["phase", "position.x [m]"])
        strip = plots[: plots.index("</svg>")]
        self.assertEqual(re.findall('class="state (.*?)"', strip), ["c0", "c1", "c2", "c3", "c4", "c5"])
        self.assertEqual(re.findall(r'y="30\.0" text-anchor="middle">(.*?)<', strip), list("012345"))
        page = self.report("--layout", "bands.json")
        self.assertIn('class="state several"', page, "more states than can be drawn")

    def test_pictures_are_part_of_the_page(self):
        page = self.report("--picture", self.write("kite.png", PNG))
        self.assertIn("<figcaption>kite</figcaption>", page)
        (data,) = re.findall(r'src="data:image/png;base64,([^"]+)"', page)
        self.assertEqual(base64.b64decode(data), PNG)

    def test_what_is_no_layout_or_picture_is_refused(self):
        text = self.write("text.txt", b"kite")
        self.assertIn("is not a picture; use PNG, JPEG or SVG", self.report("--picture", text, code=2))
        self.assertIn("cannot open 'none.png'", self.report("--picture", "none.png", code=2))
        self.assertIn("--layout 'text.txt': at byte", self.report("--layout", text, code=2))
        other = self.write("other.json", b"{}")
        self.assertIn("is not a layout of the Control Center", self.report("--layout", other, code=2))
        empty = self.write("empty.json", json.dumps(dict(LAYOUT, tabs=[])).encode())
        self.assertIn("has no time plot", self.report("--layout", empty, code=2))


class PeopleInAHurry(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = Path(self.scratch.name)
        self.flight = self.folder / "flight.mcap"
        subprocess.run([MAKE_RECORDING, str(self.flight)], check=True, stdout=subprocess.DEVNULL)
        self.bytes = self.flight.read_bytes()

    def tearDown(self):
        self.scratch.cleanup()

    def qtplc(self, *arguments, code):
        """What is said."""
        command = [QTPLC, *map(str, arguments)]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def test_a_recording_is_not_replaced_by_its_own_table_or_report(self):
        flights = self.folder / "flights"
        flights.mkdir()
        shutil.copy(self.flight, flights / "a.mcap")
        for recording, file in (
            (self.flight, self.flight),
            (self.flight, flights / "../flight.mcap"),
            (flights, flights / "a.mcap"),
        ):
            for command in (["export", recording, "--format", "csv"], ["report", recording]):
                said = self.qtplc(*command, "-o", file, "--force", code=2)
                self.assertIn("is a file of the recording, which would be lost", said)
                self.assertEqual(file.read_bytes(), self.bytes)

    def test_the_standard_output_gets_what_a_file_gets_and_nothing_else(self):
        for arguments in (["export", "--format", "csv"], ["export", "--format", "parquet"], ["report"]):
            command = [QTPLC, arguments[0], self.flight, *arguments[1:], "-o"]
            there = subprocess.run([*command, "-"], cwd=self.folder, capture_output=True, timeout=60)
            self.assertEqual((there.returncode, there.stderr), (0, b""))
            subprocess.run([*command, "file"], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
            self.assertEqual(there.stdout, (self.folder / "file").read_bytes())
            (self.folder / "file").unlink()
        self.assertFalse((self.folder / "-").exists())
        said = self.qtplc("export", self.flight, "-o", "-", "--format", "mat", code=2)
        self.assertIn("mat is not written in one go, so it needs a file", said)
        with open("/dev/full", "w") as full:
            lost = subprocess.run(
                [QTPLC, "export", self.flight, "-o", "-", "--format", "csv"],
                stdout=full,
                stderr=subprocess.PIPE,
                text=True,
                timeout=60,
            )
        self.assertEqual(lost.returncode, 1)
        self.assertIn("cannot write to the standard output: No space left on device", lost.stderr)

    def test_only_files_are_replaced(self):
        os.mkfifo(self.folder / "fifo.csv")
        (self.folder / "link.csv").symlink_to("/dev/stdout")
        (self.folder / "lost.csv").symlink_to(self.folder / "nowhere")
        (self.folder / "folder.csv").mkdir()
        for name, reason in {
            "fifo.csv": "it is not a file",
            "link.csv": "it is a link; name the file that it leads to",
            "lost.csv": "it is a link; name the file that it leads to",
            "folder.csv": "it is a folder",
        }.items():
            self.assertIn(reason, self.qtplc("export", self.flight, "-o", name, "--force", code=2))
            self.assertIn(reason, self.qtplc("report", self.flight, "-o", name, "--force", code=2))
        self.assertTrue((self.folder / "fifo.csv").is_fifo() and (self.folder / "link.csv").is_symlink())

    def test_half_a_pattern_matches_nothing(self):
        said = self.qtplc("export", self.flight, "-o", "x.csv", "--signals", "[", code=2)
        self.assertEqual(said, "qtplc: no signal matches '['; qtplc list shows all\n")

    def test_a_file_that_is_no_recording_does_not_hide_the_others(self):
        (self.folder / "odd.mcap").write_bytes(b"hello")
        said = self.qtplc("verify", self.folder, code=1)
        self.assertIn("as that of the flight: nothing is missing", said)
        self.assertIn("odd.mcap' is not a recording", said)
        facts = json.loads(self.qtplc("verify", self.folder, "--json", code=1))
        self.assertEqual((facts["complete"], len(facts["phases"]), len(facts["problems"])), (False, 1, 1))
        for command in (["export", self.folder, "-o", "x.csv"], ["report", self.folder, "-o", "x.html"]):
            said = self.qtplc(*command, code=1)
            self.assertIn("odd.mcap' is not a recording", said)
        with open(self.folder / "x.csv") as table:
            self.assertEqual(len(table.readlines()), 1 + CYCLES)
        self.assertIn("odd.mcap' is not a recording", self.qtplc("events", "--file", self.folder, code=1))
        (self.folder / "odd.mcap").unlink()
        self.assertEqual(json.loads(self.qtplc("verify", self.folder, "--json", code=0))["problems"], [])

    def test_a_file_with_nothing_whole_is_not_cut(self):
        begin = self.bytes[:100]
        (self.folder / "begin.mcap").write_bytes(begin)
        self.assertIn("nothing whole to finish", self.qtplc("recover", "begin.mcap", code=2))
        self.assertEqual((self.folder / "begin.mcap").read_bytes(), begin)

    def test_a_verb_without_a_folder_is_not_the_name_of_a_file(self):
        for verb in ("start", "stop", "status", "list"):
            self.assertIn("needs the FOLDER of a recorder", self.qtplc("record", verb, code=2))
            self.assertFalse((self.folder / verb).exists())

    def test_a_folder_that_cannot_be_read_is_not_called_empty(self):
        locked = self.folder / "locked"
        locked.mkdir(mode=0o700)
        other = {"user": 65534} if os.geteuid() == 0 else {}
        locked.chmod(0o700 if other else 0)
        self.folder.chmod(0o755)
        if subprocess.run([QTPLC, "--help"], stdout=subprocess.DEVNULL, **other).returncode != 0:
            self.skipTest("another user cannot start qtplc here")
        for command in (["verify"], ["export", "-o", "x.csv"], ["report", "-o", "x.html"], ["record", "list"]):
            done = subprocess.run([QTPLC, *command, locked], capture_output=True, text=True, cwd="/", **other)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(f"cannot read the folder '{locked}': permission denied", done.stderr)
        locked.chmod(0o700)

    def test_nobody_is_told_to_delete_what_is_no_ring(self):
        said = self.qtplc("record", "new.mcap", "--ring", self.flight, code=2)
        self.assertIn("is not a ring of this version of QtPLC and of this user", said)
        self.assertNotIn("delete", said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
