#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads a recording as its format says, with nothing of QtPLC: structure, checksums, summary,
indexes, the message description, the digest of the images.

usage: tst_other_reader.py MAKE_RECORDING
"""
import json
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

MAGIC = b"\x89MCAP0\r\n"
SIZES = {
    "int8": "b",
    "int16": "h",
    "int32": "i",
    "int64": "q",
    "uint8": "B",
    "uint16": "H",
    "uint32": "I",
    "uint64": "Q",
}
SIZES |= {"float32": "f", "float64": "d"}
MASK = (1 << 64) - 1


class Fields:
    """Reads fields of a record."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def number(self, code):
        (value,) = struct.unpack_from("<" + code, self.data, self.at)
        self.at += struct.calcsize("<" + code)
        return value

    def bytes(self, size):
        assert self.at + size <= len(self.data), "a field is cut"
        self.at += size
        return self.data[self.at - size : self.at]

    def text(self):
        return self.bytes(self.number("I"))

    def left(self):
        return len(self.data) - self.at


def records(data, at=0, end=None):
    """Offset, opcode and content of each record."""
    end = len(data) if end is None else end
    while at < end:
        opcode, length = struct.unpack_from("<BQ", data, at)
        assert at + 9 + length <= end, f"the record at {at} is cut"
        yield at, opcode, data[at + 9 : at + 9 + length]
        at += 9 + length
    assert at == end


def chunk(content):
    fields = Fields(content)
    begin, end, size, crc = fields.number("Q"), fields.number("Q"), fields.number("Q"), fields.number("I")
    assert fields.text() == b"zstd"
    packed = fields.bytes(fields.number("Q"))
    assert fields.left() == 0
    plain = subprocess.run(["zstd", "-dc"], input=packed, stdout=subprocess.PIPE, check=True).stdout
    assert len(plain) == size and zlib.crc32(plain) == crc, "a chunk is damaged"
    return begin, end, plain


def description(text):
    """Fields of the message of a ROS description: type, number of elements (None: one), name."""
    found = []
    for line in text.decode().split("=" * 80)[0].splitlines():
        match = re.match(r"(\w+(?:/\w+)?)(?:\[(\d+)\])? (\w+)", line)
        if match:
            found.append((match[1], int(match[2]) if match[2] else None, match[3]))
    return found


def decode(body, layout):
    fields, message = Fields(body), {}
    for kind, count, name in layout:
        if kind == "qtplc/Cycle":
            message[name] = [fields.number(code) for code in "QqQI"]
        elif kind == "string":
            message[name] = fields.text()
        else:
            values = [fields.number(SIZES[kind]) for _ in range(count or 1)]
            message[name] = values if count else values[0]
    assert fields.left() == 0, "the message is longer than its description"
    return message


def mixed(state, word):
    state = ((state ^ word) * 0x9E3779B97F4A7C15) & MASK
    return state ^ (state >> 32)


def digest(before, values):
    padded = values + bytes(32 - len(values) % 32)
    states = [1, 2, 3, 4]
    for at in range(0, len(values), 32):
        words = struct.unpack_from("<4Q", padded, at)
        states = [mixed(state, word) for state, word in zip(states, words)]
    result = mixed(before, len(values))
    for state in states:
        result = mixed(result, state)
    return mixed(result, result >> 29)


def image(message):
    """The values as they lie in the memory of the master: tests/recording/RecordedFlight.h."""
    text = message["phase"]
    return (
        struct.pack("<qd3fh", message["time"], message["position_x"], *message["force"], message["position_x_2"])
        + struct.pack("<H12s", len(text), text)
        + bytes([message["on"]])
    )


def check(data, flight_digest):
    assert data.startswith(MAGIC) and data.endswith(MAGIC)
    channels, schemas, times, result, following = {}, {}, [], 0, 0
    chunks, indexes = {}, {}
    values, commands = {}, []
    data_end = None
    for at, opcode, content in records(data, len(MAGIC), len(data) - len(MAGIC)):
        if data_end is not None:
            continue
        if opcode == 0x0F:
            data_end = at
        elif opcode == 0x09:
            assert zlib.crc32(content[:-4]) == struct.unpack("<I", content[-4:])[0], "the attachment is damaged"
        elif opcode == 0x07:
            fields = Fields(content)
            indexes[at] = (fields.number("H"), fields.text())
        elif opcode == 0x06:
            begin, end, plain = chunk(content)
            chunks[at] = (begin, end, plain)
            for offset, inside, body in records(plain):
                fields = Fields(body)
                if inside == 0x03:
                    number, name, encoding, text = fields.number("H"), fields.text(), fields.text(), fields.text()
                    schemas[number] = (name, encoding, description(text))
                elif inside == 0x04:
                    number, schema, topic = fields.number("H"), fields.number("H"), fields.text()
                    channels[number] = (topic, schema)
                elif inside == 0x05:
                    number, sequence, time = fields.number("H"), fields.number("I"), fields.number("Q")
                    fields.number("Q")
                    topic, schema = channels[number]
                    assert begin <= time <= end
                    times.append(time)
                    if topic == b"/plant":
                        message = decode(body[22:], schemas[schema][2])
                        assert message["cycle"][0] == following == sequence
                        assert message["position_x_2"] == following
                        result = digest(result, image(message))
                        values[following] = message["position_x_2"]
                        following += 1
                    elif topic == b"/commands":
                        commands.append((time, json.loads(body[22:])))
    assert times == sorted(times)
    assert [command["cycle"] for _, command in commands] == [0, 200, 400, 600]
    for time, command in commands:
        assert time == command["cycle"] * 10_000_000 and command["by"] == "Anna"
        assert values[command["cycle"]] == int(command["to"]), f"{command} is not what the cycle has adopted"
    assert f"{result:016x}" == flight_digest, "the digest of the images is not that of the flight"
    return check_summary(data, data_end, chunks, indexes, channels), following


def check_summary(data, data_end, chunks, indexes, channels):
    footer = Fields(data[-len(MAGIC) - 29 :])
    assert footer.number("B") == 0x02 and footer.number("Q") == 20
    summary, offsets, crc = footer.number("Q"), footer.number("Q"), footer.number("I")
    assert summary == data_end + 13
    assert zlib.crc32(data[summary : len(data) - len(MAGIC) - 4]) == crc, "the summary is damaged"
    seen, groups, messages = {}, {}, 0
    for at, opcode, content in records(data, summary, len(data) - len(MAGIC) - 29):
        groups.setdefault(opcode, [at, at])[1] = at + 9 + len(content)
        fields = Fields(content)
        if opcode == 0x04:
            assert (fields.number("H"), fields.number("H")) and fields.text() in [c[0] for c in channels.values()]
        elif opcode == 0x0B:
            messages = fields.number("Q")
        elif opcode == 0x08:
            begin, end, offset = fields.number("Q"), fields.number("Q"), fields.number("Q")
            fields.number("Q")
            assert chunks[offset][:2] == (begin, end)
            places = Fields(fields.text())
            while places.left():
                channel, place = places.number("H"), places.number("Q")
                assert indexes[place][0] == channel
                check_index(chunks[offset][2], channel, indexes[place][1])
            seen[offset] = True
        elif opcode == 0x0E:
            group, begin, length = fields.number("B"), fields.number("Q"), fields.number("Q")
            assert at >= offsets and groups[group] == [begin, begin + length]
    assert set(seen) == set(chunks), "the summary does not have each chunk"
    return messages


def check_index(plain, channel, entries):
    fields, places = Fields(entries), []
    while fields.left():
        time, offset = fields.number("Q"), fields.number("Q")
        assert plain[offset] == 0x05
        assert struct.unpack_from("<HIQ", plain, offset + 9)[::2] == (channel, time)
        places.append(offset)
    wanted = [at for at, opcode, body in records(plain) if opcode == 5 and struct.unpack_from("<H", body)[0] == channel]
    assert places == wanted, "an index does not have each message"


def main():
    if not shutil.which("zstd"):
        print("SKIPPED: zstd is missing (Debian: zstd)")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "flight.mcap"
        flight = subprocess.run([sys.argv[1], str(file)], stdout=subprocess.PIPE, check=True, text=True)
        data = file.read_bytes()
        messages, cycles = check(data, flight.stdout.strip())
    assert cycles == 800, f"{cycles} cycles instead of 800"
    print(f"{len(data)} bytes, {messages} messages, {cycles} cycles, digest {flight.stdout.strip()}: as it should be")
    return 0


if __name__ == "__main__":
    sys.exit(main())
