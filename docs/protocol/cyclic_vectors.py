# SPDX-License-Identifier: Apache-2.0
"""Vectors of layouts, of cyclic frames, and of sealed ones."""
import math
import struct
import sys

from wire import (
    FAULT,
    GROUP_INPUTS,
    HEADER,
    INPUTS,
    OUTPUTS,
    PART,
    RESENT,
    SAFE_STOP,
    SESSION,
    Channel,
    check_aead,
    crc32c,
    digest,
    fnv1a64,
    hex64,
    layout,
    short_time,
    table_lines,
)


def make_layouts():
    many = [(f"signal{i}", "Real64") for i in range(400)]
    # fmt: off
    layouts = [
        layout("no signal", []),
        layout("three reals", [("bodyControlPitchSpeed", "Real32"), ("bodyControlYawSpeed", "Real32"),
                               ("tetherSpeed", "Real32")], {"tetherSpeed": "Real"}),
        layout("every type", [
            ("brake", "Int8"), ("mode", "UInt8"), ("a", "Int16"), ("b", "UInt16"), ("c", "Int32"), ("d", "UInt32"),
            ("e", "Int64"), ("f", "UInt64"), ("g", "Real32"), ("h", "Real64"), ("position", "Real32[3]"),
            ("velocity", "Real64[3]"), ("matrix", "Int16[9]"), ("title", "String(64)"), ("tag", "String(5)"),
            ("now", "DateTime")],
            {"brake": "Bool", "mode": "Byte", "c": "Int", "d": "UInt", "g": "Real", "position": "RealTriple",
             "velocity": "Real64Triple", "title": "String"}),
        layout("the border before a signal that fits no more", [("a", "Int32"), ("b", "Real64"), ("c", "Int8"),
                                                                ("d", "Real64")], maximum=16),
        layout("a part that is exactly full", [("a", "Real64"), ("b", "Real64"), ("c", "Int8")], maximum=16),
        layout("three datagrams", many),
        layout("qualities behind the values", [("bodyControlPitchSpeed", "Real32"), ("bodyControlYawSpeed", "Real32"),
                                               ("tetherSpeed", "Real32")], qualities=True),
        layout("qualities of no signal", [], qualities=True),
        layout("qualities that fill a part", [("a", "Real64"), ("b", "Real32"), ("c", "Int8"), ("d", "Int8")],
               maximum=18, qualities=True),
        layout("qualities that are parted", [("a", "Real64"), ("b", "Real32"), ("c", "Int8"), ("d", "Int8")],
               maximum=16, qualities=True),
        layout("qualities in a part of their own", [("a", "Real64"), ("b", "Real64")], maximum=16, qualities=True),
        layout("qualities of three datagrams", many, qualities=True),
    ]
    # fmt: on
    # fmt: off
    values = [
        ("Int8", "-128", b"\x80"), ("Int8", "true", b"\x01"), ("UInt8", "255", b"\xff"),
        ("Int16", "-2", b"\xfe\xff"), ("UInt16", "258", b"\x02\x01"),
        ("Int32", "-2147483648", struct.pack("<i", -2**31)),
        ("UInt32", "4294967295", b"\xff" * 4), ("Int64", "-9223372036854775808", struct.pack("<q", -2**63)),
        ("UInt64", "18446744073709551615", b"\xff" * 8), ("Real32", "0.5", struct.pack("<f", 0.5)),
        ("Real32", "-0", struct.pack("<f", -0.0)), ("Real64", "0.1", struct.pack("<d", 0.1)),
        ("Real64", "5e-324", struct.pack("<d", 5e-324)),
        ("Real64", "1.7976931348623157e+308", struct.pack("<d", sys.float_info.max)),
        ("Real32[3]", "1, -2.5, 3", struct.pack("<3f", 1, -2.5, 3)), ("Int16[2]", "7, -7", struct.pack("<2h", 7, -7)),
        ("String(5)", "", b"\0" * 7), ("String(5)", "kite", b"\x04\0kite\0"),
        ("String(6)", "Höhe", b"\x05\0H\xc3\xb6he\0"), ("DateTime", "1970-01-01T00:00:00Z", b"\0" * 8),
        ("DateTime", "2026-01-31T12:00:00.5Z", struct.pack("<q", 1769860800500000000)),
    ]
    # fmt: on
    return {
        "layouts": layouts,
        "tables": make_tables(),
        "digests": make_digests(),
        "values": [{"type": t, "text": text, "hex": value.hex()} for t, text, value in values],
    }


def make_digests():
    def phase(ini, *images):
        digests = [0]
        for image in images:
            digests.append(digest(image, digests[-1]))
        return {
            "table": ini,
            "cycles": [{"image": image.hex(), "digest": hex64(after)} for image, after in zip(images, digests[1:])],
        }

    return [
        phase("[force]\ntype = Real64\n", struct.pack("<d", 0.5), struct.pack("<d", 1.5)),
        phase("[brake]\ntype = Bool\n[position]\ntype = RealTriple\n", b"\x01" + struct.pack("<3f", 1, 2, 3)),
        phase("[block]\ntype = UInt8[64]\n", bytes(range(64)), bytes(64), bytes(range(64))),
    ]


def make_tables():
    def real(number):
        return struct.pack("<f", number)

    def table(ini, *lines):
        text = "".join(first + second for first, second in lines)
        return {
            "table": ini,
            "text": text,
            "hash": hex64(fnv1a64(text.encode())),
            "safety": [hex64(fnv1a64(second.encode())) for _, second in lines],
        }

    return [
        table(
            "[tetherSpeed]\ntype = Real\nunit = m/s\ndescription = reels out\ninitial = 1\n",
            table_lines("tetherSpeed", "Real32", "m/s"),
        ),
        table(
            "[tetherSpeed]\ntype = Real\nunit = m/s\nmin = -10\nmax = 10\nsafe = 0\nhold = 5\nnan = allowed\n"
            "slope = 2.5 per second\nwriter = Winch > Model\n[flightPhase]\ntype = Int8\nmax = 2\n"
            "values = 0: Launch, 1: Power\n",
            table_lines(
                "tetherSpeed", "Real32", "m/s", real(-10), real(10), real(0), "5", "allowed", 2.5, "Winch > Model"
            ),
            table_lines("flightPhase", "Int8", maximum=b"\x02"),
        ),
        table(
            "[position]\ntype = RealTriple\nunit = m\nmin = 0\nsafe = 1, 2, 3\n"
            "[limit]\ntype = Real64[2]\nsafe = 0.1\nhold = 0\n"
            "[title]\ntype = String(5)\nsafe = kite\nwriter = Model\n"
            "[now]\ntype = DateTime\nsafe = 1970-01-01T00:00:01Z\n"
            "[force]\ntype = Real64\nunit = N\nmax = inf\nnan = allowed\n",
            table_lines("position", "Real32[3]", "m", minimum=real(0), safe=struct.pack("<3f", 1, 2, 3)),
            table_lines("limit", "Real64[2]", safe=struct.pack("<2d", 0.1, 0.1), hold="0"),
            table_lines("title", "String(5)", safe=b"\x04\0kite\0", writer="Model"),
            table_lines("now", "DateTime", safe=struct.pack("<q", 10**9)),
            table_lines("force", "Real64", "N", maximum=struct.pack("<d", math.inf), nan="allowed"),
        ),
    ]


def good_frame(name, channel, cycle, info, payload, flags=0, before=0):
    return {
        "name": name,
        "channel": channel.json(),
        "flags": flags,
        "cycle": cycle,
        "info": info,
        "before": before,
        "payload": payload.hex(),
        "frames": [frame.hex() for frame in channel.parts(cycle, info, payload, flags, before)],
    }


def make_refused(channel, payload):
    good = channel.part(0, 42, 1000, payload)
    long_part = channel.part(1, 42, 0, payload)

    def sealed(body):
        return body + struct.pack("<I", crc32c(body, channel.seed))

    other = [
        ("another session with the same low 16 bits", dict(session=SESSION ^ 0x10000)),
        ("another node", dict(node=channel.node + 1)),
        ("another layout", dict(layout_hash=channel.layout_hash ^ 1)),
    ]
    rows = [
        ("no byte", b"", "WrongLength"),
        ("a header alone", good[:HEADER], "WrongLength"),
        ("one byte short", good[:-1], "WrongLength"),
        ("one byte long", good + b"\0", "WrongLength"),
        ("two frames in one datagram", good + good, "WrongLength"),
        ("the length of part 1 in part 0", sealed(good[:HEADER] + long_part[HEADER:-4]), "WrongLength"),
        (
            "part number 0",
            sealed(good[:1] + bytes([PART]) + good[2:8] + struct.pack("<H", 0) + good[10:-4]),
            "WrongLength",
        ),
        (
            "a part number beyond the last",
            sealed(long_part[:8] + struct.pack("<H", 2) + long_part[10:-4]),
            "WrongLength",
        ),
        ("part number 2^16 - 1", sealed(long_part[:8] + b"\xff" * 2 + long_part[10:-4]), "WrongLength"),
        ("version 0", channel.part(0, 42, 1000, payload, version=0), "WrongVersion"),
        ("version 1", channel.part(0, 42, 1000, payload, version=1), "WrongVersion"),
        (
            "the kind of the other direction",
            Channel(OUTPUTS, channel.node, channel.layout_hash, channel.borders).part(0, 42, 1000, payload),
            "WrongVersion",
        ),
        (
            "other low 16 bits of the session",
            Channel(INPUTS, channel.node, channel.layout_hash, channel.borders, SESSION + 1).part(0, 42, 1000, payload),
            "WrongSession",
        ),
        ("a wrong checksum", good[:-1] + bytes([good[-1] ^ 1]), "WrongChecksum"),
        ("a checksum without the seed", good[:-4] + struct.pack("<I", crc32c(good[:-4])), "WrongChecksum"),
        ("a checksum in big-endian order", good[:-4] + good[:-5:-1], "WrongChecksum"),
        ("a flag set on the way", good[:1] + bytes([RESENT]) + good[2:], "WrongChecksum"),
    ]
    for name, change in other:
        arguments = dict(kind=INPUTS, node=channel.node, layout_hash=channel.layout_hash, borders=channel.borders)
        rows.append((name, Channel(**{**arguments, **change}).part(0, 42, 1000, payload), "WrongChecksum"))
    return {"channel": channel.json(), "frames": [{"name": n, "hex": f.hex(), "status": s} for n, f, s in rows]}


def sequence(name, channel, first_cycle, steps):
    """steps: (frame, status, (cycle, payload) that is visible afterwards or None before the
    first)"""
    rows = []
    for frame, status, visible in steps:
        row = {"hex": frame.hex(), "status": status}
        if visible:
            row["cycle"], row["payload"] = hex64(visible[0]), visible[1].hex()
        rows.append(row)
    return {"name": name, "channel": channel.json(), "firstCycle": hex64(first_cycle), "steps": rows}


def make_sequences(single, double):
    def values(channel, cycle):
        return bytes((cycle * 31 + i) & 0xFF for i in range(channel.borders[-1]))

    def whole(cycle, flags=0):
        return single.part(0, cycle & 0xFFFFFFFF, 0, values(single, cycle), flags)

    def part(number, cycle, flags=0):
        return double.part(number, cycle & 0xFFFFFFFF, 0, values(double, cycle), flags)

    def seen(channel, cycle):
        return cycle, values(channel, cycle)

    broken = bytearray(whole(8))
    broken[HEADER + 1] ^= 4
    one, two, wrap = (lambda c: seen(single, c)), (lambda c: seen(double, c)), 1 << 32
    # fmt: off
    return [
        sequence("cycles in order", single, 0, [(whole(c), "Complete", one(c)) for c in range(3)]),
        sequence("a gap, a duplicate, a resent one and an old one", single, 5, [
            (whole(4), "Old", None), (whole(5), "Complete", one(5)), (whole(7), "Complete", one(7)),
            (whole(7), "Duplicate", one(7)), (whole(7, RESENT), "Duplicate", one(7)), (whole(6), "Old", one(7)),
            (bytes(broken), "WrongChecksum", one(7)), (whole(8, RESENT), "Complete", one(8))]),
        sequence("the 32 bits of the wire run over", single, wrap - 2, [
            (whole(wrap - 3), "Old", None), (whole(wrap - 2), "Complete", one(wrap - 2)),
            (whole(wrap - 1), "Complete", one(wrap - 1)), (whole(wrap), "Complete", one(wrap)),
            (whole(wrap - 1), "Old", one(wrap)), (whole(wrap + 1), "Complete", one(wrap + 1))]),
        sequence("the farthest cycle ahead, and one farther", single, 0, [
            (whole(2**31 + 1), "Old", None), (whole(1), "Complete", one(1)), (whole(2**31 + 1), "Old", one(1)),
            (whole(2**31), "Complete", one(2**31))]),
        sequence("parts in any order", double, 0, [
            (part(1, 0), "Incomplete", None), (part(0, 0), "Complete", two(0)),
            (part(0, 1), "Incomplete", two(0)), (part(1, 1), "Complete", two(1))]),
        sequence("a part twice completes nothing", double, 0, [
            (part(0, 0), "Incomplete", None), (part(0, 0), "Duplicate", None), (part(0, 0, RESENT), "Duplicate", None),
            (part(1, 0, RESENT), "Complete", two(0)), (part(1, 0), "Duplicate", two(0))]),
        sequence("a newer cycle discards an incomplete one", double, 0, [
            (part(0, 0), "Incomplete", None), (part(1, 0), "Complete", two(0)), (part(0, 1), "Incomplete", two(0)),
            (part(1, 2), "Incomplete", two(0)), (part(1, 1), "Old", two(0)), (part(0, 0), "Duplicate", two(0)),
            (part(0, 2), "Complete", two(2)), (part(0, 1), "Old", two(2)), (part(0, 0), "Old", two(2))]),
    ]
    # fmt: on


def make_times():
    """What a time in `info` is on the wire, and what it is behind it."""

    def row(time):
        wire = short_time(time)
        exponent, fraction = wire >> 11, wire & 0x7FF
        return {
            "time": time,
            "hex": struct.pack("<H", wire).hex(),
            "read": (0x800 | fraction) << exponent - 1 if exponent else fraction,
        }

    # fmt: off
    return [row(time) for time in (0, 1, 2047, 2048, 2049, 4095, 4096, 4097, 4098, 8191, 8192, 25001, 1000000,
                                   123456789, 2**31 - 1, 2**31, 2**32 - 1)]
    # fmt: on


def make_cyclic():
    reals = layout(
        "", [("bodyControlPitchSpeed", "Real32"), ("bodyControlYawSpeed", "Real32"), ("tetherSpeed", "Real32")]
    )
    layout_hash = int(reals["hash"], 16)
    payload = struct.pack("<3f", 0.5, -1.25, 1.5)
    example = Channel(INPUTS, 7, layout_hash, [0, 12])
    answer = Channel(OUTPUTS, 7, fnv1a64(b"tetherForce:Real64@0\n"), [0, 8])
    split = Channel(INPUTS, 2, 0x1122334455667788, [0, 8, 13])
    largest = Channel(OUTPUTS, 65535, 0xFFFFFFFFFFFFFFFF, [0, 1456, 2912, 2920], 0xFFFFFFFFFFFFFFFF)
    largest_payload = bytes((i * 7 + i // 256) & 0xFF for i in range(2920))
    frames = [
        good_frame("the worked example", example, 42, 1000, payload),
        good_frame("the same, resent", example, 42, 1000, payload, RESENT),
        good_frame("three cycles were not sent before", example, 46, 1000, payload, before=3),
        good_frame("the answer, after that to cycle 39", answer, 42, 25000, struct.pack("<d", 1234.5), before=3),
        good_frame("the first answer of a phase", answer, 42, 25000, struct.pack("<d", 1234.5)),
        good_frame("the answer of a node with a fault", answer, 43, 0, struct.pack("<d", 1234.5), FAULT, before=1),
        good_frame("the master stops safely", example, 44, 1000, bytes(12), SAFE_STOP),
        good_frame("the answer of a node in its safe state", answer, 44, 0, bytes(8), SAFE_STOP),
        good_frame("the answer of a node in its safe state, with a fault", answer, 45, 0, bytes(8), SAFE_STOP | FAULT),
        good_frame("no signal", Channel(OUTPUTS, 1, fnv1a64(b""), [0, 0], 1), 0, 0, b""),
        good_frame("largest numbers", example, 0xFFFFFFFF, 0xFFF00000, b"\xff" * 12, 0x7F, before=0xFFFF),
        good_frame("one byte", Channel(INPUTS, 3, 5, [0, 1]), 1, 2, b"\x5a"),
        good_frame("two parts", split, 9, 77, bytes(range(13)), RESENT),
        good_frame("three datagrams of the largest size", largest, 1, 5, largest_payload),
        good_frame(
            "part 1 of a multicast group, with the inputs of nodes 7 and 9",
            Channel(GROUP_INPUTS, 0, fnv1a64(b"7:12@2\n9:4@14\n"), [0, 18]),
            42,
            1000,
            struct.pack("<H", 1) + payload + struct.pack("<f", 8.0),
        ),
    ]
    refused = make_refused(Channel(INPUTS, 7, layout_hash, [0, 12, 20]), payload + bytes(8))
    return {
        "frames": frames,
        "refused": refused,
        "times": make_times(),
        "sequences": make_sequences(Channel(INPUTS, 7, layout_hash, [0, 4]), split),
    }


# ---- sealed cyclic frames ------------------------------------------------------------------------


def make_sealed_refused(channel, payload):
    good = channel.part(0, 42, 1000, payload)

    def by(**change):
        arguments = dict(
            kind=INPUTS, node=channel.node, layout_hash=channel.layout_hash, borders=channel.borders, key=channel.key
        )
        return Channel(**{**arguments, **change})

    plain = by(key=None).part(0, 42, 1000, payload)
    rows = [
        ("a header alone", good[:HEADER], "WrongLength"),
        ("a tag cut short", good[:-1], "WrongLength"),
        ("one byte long", good + b"\0", "WrongLength"),
        ("a frame that is not sealed", plain, "WrongLength"),
        ("a frame that is not sealed, of the right length", plain + bytes(12), "Forged"),
        ("version 1", channel.part(0, 42, 1000, payload, version=1), "WrongVersion"),
        ("the kind of the other direction", by(kind=OUTPUTS).part(0, 42, 1000, payload), "WrongVersion"),
        ("other low 16 bits of the session", by(session=SESSION + 1).part(0, 42, 1000, payload), "WrongSession"),
        (
            "another session with the same low 16 bits",
            by(session=SESSION ^ 0x10000).part(0, 42, 1000, payload),
            "Forged",
        ),
        ("another node", by(node=channel.node + 1).part(0, 42, 1000, payload), "Forged"),
        ("another key", by(key=bytes(reversed(channel.key))).part(0, 42, 1000, payload), "Forged"),
        (
            "the other direction, made to look like this one",
            good[:1] + by(kind=OUTPUTS).part(0, 42, 1000, payload)[1:],
            "Forged",
        ),
        ("another cycle with the same low 32 bits", channel.part(0, 42 + (1 << 32), 1000, payload), "Forged"),
        ("the cycle changed on the way", good[:4] + bytes([43]) + good[5:], "Forged"),
        ("a flag set on the way", good[:1] + bytes([RESENT]) + good[2:], "Forged"),
        ("the time changed on the way", good[:8] + bytes([good[8] ^ 1]) + good[9:], "Forged"),
        ("the number of cycles before it changed on the way", good[:10] + bytes([good[10] ^ 1]) + good[11:], "Forged"),
        ("a bit of the payload", good[:HEADER] + bytes([good[HEADER] ^ 1]) + good[HEADER + 1 :], "Forged"),
        ("a bit of the tag", good[:-1] + bytes([good[-1] ^ 0x80]), "Forged"),
        ("a tag of zeros", good[:-16] + bytes(16), "Forged"),
        ("part 1 as part 0", good[:HEADER] + channel.part(1, 42, 0, payload)[HEADER:], "Forged"),
    ]
    return {"channel": channel.json(), "frames": [{"name": n, "hex": f.hex(), "status": s} for n, f, s in rows]}


def make_sealed():
    check_aead()
    key = bytes(range(0x40, 0x60))
    reals = layout(
        "", [("bodyControlPitchSpeed", "Real32"), ("bodyControlYawSpeed", "Real32"), ("tetherSpeed", "Real32")]
    )
    layout_hash = int(reals["hash"], 16)
    payload = struct.pack("<3f", 0.5, -1.25, 1.5)
    example = Channel(INPUTS, 7, layout_hash, [0, 12], key=key)
    answer = Channel(OUTPUTS, 7, fnv1a64(b"tetherForce:Real64@0\n"), [0, 8], key=bytes(range(0xC0, 0xE0)))
    split = Channel(INPUTS, 2, 0x1122334455667788, [0, 8, 13], key=key)
    largest = Channel(
        OUTPUTS, 65535, 0xFFFFFFFFFFFFFFFF, [0, 1444, 2888, 2900], 0xFFFFFFFFFFFFFFFF, key=bytes([0xFF]) * 32
    )
    largest_payload = bytes((i * 7 + i // 256) & 0xFF for i in range(2900))
    frames = [
        good_frame("the worked example, sealed", example, 42, 1000, payload),
        good_frame("the same, resent", example, 42, 1000, payload, RESENT),
        good_frame("the next cycle", example, 43, 1000, payload),
        good_frame("the answer, after that to cycle 39", answer, 42, 25000, struct.pack("<d", 1234.5), before=3),
        good_frame("the answer of a node with a fault", answer, 43, 0, struct.pack("<d", 1234.5), FAULT, before=1),
        good_frame("no signal", Channel(OUTPUTS, 1, fnv1a64(b""), [0, 0], 1, key=key), 0, 0, b""),
        good_frame("two parts", split, 9, 77, bytes(range(13)), RESENT),
        good_frame("three datagrams of the largest size", largest, 1, 5, largest_payload),
    ]
    single, wrap = Channel(INPUTS, 7, layout_hash, [0, 4], key=key), 1 << 32

    def values(cycle):
        return bytes((cycle * 31 + i) & 0xFF for i in range(4))

    def whole(cycle, flags=0):
        return single.part(0, cycle, 0, values(cycle), flags)

    def seen(cycle):
        return cycle, values(cycle)

    # fmt: off
    sequences = [
        sequence("the 32 bits of the wire run over", single, wrap - 1, [
            (whole(wrap - 1), "Complete", seen(wrap - 1)), (whole(wrap), "Complete", seen(wrap)),
            (whole(wrap - 1), "Old", seen(wrap)),
            (whole(wrap + 1), "Complete", seen(wrap + 1))]),
        sequence("frames of 2^32 cycles ago", single, wrap + 5, [
            (whole(5), "Forged", None), (whole(wrap + 5), "Complete", seen(wrap + 5)),
            (whole(6), "Forged", seen(wrap + 5))]),
        sequence("frames that come again", single, 5, [
            (whole(5), "Complete", seen(5)), (whole(5), "Duplicate", seen(5)), (whole(5, RESENT), "Duplicate", seen(5)),
            (whole(4), "Old", seen(5)),
            (whole(6), "Complete", seen(6)), (whole(5), "Old", seen(6))]),
    ]
    # fmt: on
    refused = make_sealed_refused(Channel(INPUTS, 7, layout_hash, [0, 12, 24], key=key), payload + bytes(range(12)))
    return {"frames": frames, "refused": refused, "sequences": sequences}
