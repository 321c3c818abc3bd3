#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the byte vectors of the QtPLC protocol out of docs/protocol.md alone.

It shares nothing with the C++ code, not even the CRC-32C, so that each tests the other. The vectors are the protocol:
a change of them is a change of the protocol and needs a new version number.

    make_vectors.py --check    says whether vectors/ holds what this script makes (exit code 1 when not)
    make_vectors.py --write    writes vectors/
"""
import base64
import json
import pathlib
import struct
import sys

FOLDER = pathlib.Path(__file__).resolve().parent / "vectors"

INPUTS, OUTPUTS, GROUP_INPUTS = 1, 2, 3
RESENT, FAULT, SAFE_STOP, PART = 0x01, 0x02, 0x04, 0x80
VERSION = 1
SESSION = 0x8F3A61C2D4E5B097


# ---- checksums ------------------------------------------------------------------------------------------------------

def crc32c(data, crc=0):
    """Bit by bit: slow, and easy to compare with the definition."""
    crc ^= 0xFFFFFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc >> 1) ^ (0x82F63B78 if crc & 1 else 0)
    return crc ^ 0xFFFFFFFF


def fnv1a64(data):
    result = 0xCBF29CE484222325
    for byte in data:
        result = ((result ^ byte) * 0x100000001B3) & 0xFFFFFFFFFFFFFFFF
    return result


def hex64(number):
    return format(number, "016x")


# ---- ChaCha20-Poly1305, by RFC 8439 -----------------------------------------------------------------------------------

def chacha20_block(key, counter, nonce):
    def rotated(x, bits):
        return ((x << bits) | (x >> (32 - bits))) & 0xFFFFFFFF

    def quarter(x, a, b, c, d):
        for to, other, turned, bits in ((a, b, d, 16), (c, d, b, 12), (a, b, d, 8), (c, d, b, 7)):
            x[to] = (x[to] + x[other]) & 0xFFFFFFFF
            x[turned] = rotated(x[turned] ^ x[to], bits)

    start = list(struct.unpack("<16I", b"expand 32-byte k" + key + struct.pack("<I", counter) + nonce))
    x = list(start)
    for _ in range(10):
        for column in range(4):
            quarter(x, column, 4 + column, 8 + column, 12 + column)
        for row in range(4):
            quarter(x, row, 4 + (row + 1) % 4, 8 + (row + 2) % 4, 12 + (row + 3) % 4)
    return struct.pack("<16I", *((a + b) & 0xFFFFFFFF for a, b in zip(x, start)))


def chacha20(key, counter, nonce, data):
    blocks = b"".join(chacha20_block(key, counter + i, nonce) for i in range((len(data) + 63) // 64))
    return bytes(a ^ b for a, b in zip(data, blocks))


def poly1305(key, data):
    r = int.from_bytes(key[:16], "little") & 0x0FFFFFFC0FFFFFFC0FFFFFFC0FFFFFFF
    total = 0
    for i in range(0, len(data), 16):
        total = (total + int.from_bytes(data[i:i + 16] + b"\1", "little")) * r % (2**130 - 5)
    return ((total + int.from_bytes(key[16:], "little")) % 2**128).to_bytes(16, "little")


def aead(key, nonce, plain, header):
    """What is sealed, then the tag."""
    def padded(data):
        return data + bytes(-len(data) % 16)

    sealed = chacha20(key, 1, nonce, plain)
    told = padded(header) + padded(sealed) + struct.pack("<QQ", len(header), len(sealed))
    return sealed + poly1305(chacha20_block(key, 0, nonce)[:32], told)


def check_aead():
    """The example of RFC 8439, section 2.8.2."""
    plain = (b"Ladies and Gentlemen of the class of '99: If I could offer you only one tip for the future, sunscreen would be it.")
    result = aead(bytes(range(0x80, 0xA0)), bytes.fromhex("070000004041424344454647"), plain, bytes.fromhex("50515253c0c1c2c3c4c5c6c7"))
    assert result[:16].hex() == "d31a8d34648e60db7b86afbc53ef7ec2" and result[-16:].hex() == "1ae10b594f09e26a7e902ecbd0600691"


# ---- layouts and values ---------------------------------------------------------------------------------------------

SIZES = {"Int8": 1, "Int16": 2, "Int32": 4, "Int64": 8, "UInt8": 1, "UInt16": 2, "UInt32": 4, "UInt64": 8,
         "Real32": 4, "Real64": 8, "DateTime": 8}


def size_of(type_name):
    if type_name.startswith("String("):
        return 2 + int(type_name[7:-1])
    if type_name.endswith("]"):
        scalar, count = type_name[:-1].split("[")
        return SIZES[scalar] * int(count)
    return SIZES[type_name]


def layout(name, fields, table=None, maximum=1456, qualities=False):
    """fields: (signal, canonical type); table: type names as written in the signal table, where they differ; qualities: they follow the values."""
    table = table or {}
    offset, lines, placed, borders = 0, [], [], [0]
    for signal, type_name in fields:
        size = size_of(type_name)
        if offset + size - borders[-1] > maximum:
            borders.append(offset)
        lines.append(f"{signal}:{type_name}@{offset}\n")
        placed.append({"name": signal, "type": type_name, "offset": offset})
        offset += size
    if qualities and fields:
        lines.append(f"qualities@{offset}\n")
        for _ in fields:  # one byte each
            if offset + 1 - borders[-1] > maximum:
                borders.append(offset)
            offset += 1
    borders.append(offset)
    text = "".join(lines)
    ini = "".join(f"[{signal}]\ntype = {table.get(signal, type_name)}\n" for signal, type_name in fields)
    return {"name": name, "table": ini, "fields": placed, "text": text, "hash": hex64(fnv1a64(text.encode())),
            "size": offset, "maximum": maximum, "borders": borders, "qualities": qualities}


def make_layouts():
    many = [(f"signal{i}", "Real64") for i in range(400)]
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
        layout("qualities that fill a part", [("a", "Real64"), ("b", "Real32"), ("c", "Int8"), ("d", "Int8")], maximum=18, qualities=True),
        layout("qualities that are parted", [("a", "Real64"), ("b", "Real32"), ("c", "Int8"), ("d", "Int8")], maximum=16, qualities=True),
        layout("qualities in a part of their own", [("a", "Real64"), ("b", "Real64")], maximum=16, qualities=True),
        layout("qualities of three datagrams", many, qualities=True),
    ]
    values = [
        ("Int8", "-128", b"\x80"), ("Int8", "true", b"\x01"), ("UInt8", "255", b"\xff"),
        ("Int16", "-2", b"\xfe\xff"), ("UInt16", "258", b"\x02\x01"), ("Int32", "-2147483648", struct.pack("<i", -2**31)),
        ("UInt32", "4294967295", b"\xff" * 4), ("Int64", "-9223372036854775808", struct.pack("<q", -2**63)),
        ("UInt64", "18446744073709551615", b"\xff" * 8), ("Real32", "0.5", struct.pack("<f", 0.5)),
        ("Real32", "-0", struct.pack("<f", -0.0)), ("Real64", "0.1", struct.pack("<d", 0.1)),
        ("Real64", "5e-324", struct.pack("<d", 5e-324)), ("Real64", "1.7976931348623157e+308", struct.pack("<d", sys.float_info.max)),
        ("Real32[3]", "1, -2.5, 3", struct.pack("<3f", 1, -2.5, 3)), ("Int16[2]", "7, -7", struct.pack("<2h", 7, -7)),
        ("String(5)", "", b"\0" * 7), ("String(5)", "kite", b"\x04\0kite\0"),
        ("String(6)", "Höhe", b"\x05\0H\xc3\xb6he\0"), ("DateTime", "1970-01-01T00:00:00Z", b"\0" * 8),
        ("DateTime", "2026-01-31T12:00:00.5Z", struct.pack("<q", 1769860800500000000)),
    ]
    return {"layouts": layouts,
            "values": [{"type": t, "text": text, "hex": value.hex()} for t, text, value in values]}


# ---- cyclic frames --------------------------------------------------------------------------------------------------

class Channel:
    """One direction of one node."""

    def __init__(self, kind, node, layout_hash, borders, session=SESSION, key=None):
        self.kind, self.node, self.layout_hash, self.borders, self.session, self.key = kind, node, layout_hash, borders, session, key
        self.seed = crc32c(struct.pack("<QHQ", session, node, layout_hash))

    def part(self, number, cycle, info, payload, flags=0, version=VERSION):
        if number > 0:
            flags, info = flags | PART, number
        body = struct.pack("<BBHII", version << 4 | self.kind, flags, self.session & 0xFFFF, cycle & 0xFFFFFFFF, info)
        if self.key:
            nonce = struct.pack("<QH", cycle ^ self.session, number ^ self.node) + body[:2]
            return body + aead(self.key, nonce, payload[self.borders[number]:self.borders[number + 1]], body)
        body += payload[self.borders[number]:self.borders[number + 1]]
        return body + struct.pack("<I", crc32c(body, self.seed))

    def parts(self, cycle, info, payload, flags=0):
        return [self.part(i, cycle, info, payload, flags) for i in range(len(self.borders) - 1)]

    def json(self):
        return {"kind": {INPUTS: "Inputs", OUTPUTS: "Outputs", GROUP_INPUTS: "GroupInputs"}[self.kind], "session": hex64(self.session),
                "node": self.node, "layoutHash": hex64(self.layout_hash), "borders": self.borders, **({"key": self.key.hex()} if self.key else {})}


def good_frame(name, channel, cycle, info, payload, flags=0):
    return {"name": name, "channel": channel.json(), "flags": flags, "cycle": cycle, "info": info,
            "payload": payload.hex(), "frames": [frame.hex() for frame in channel.parts(cycle, info, payload, flags)]}


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
        ("a header alone", good[:12], "WrongLength"),
        ("one byte short", good[:-1], "WrongLength"),
        ("one byte long", good + b"\0", "WrongLength"),
        ("two frames in one datagram", good + good, "WrongLength"),
        ("the length of part 1 in part 0", sealed(good[:12] + long_part[12:-4]), "WrongLength"),
        ("part number 0", sealed(good[:1] + bytes([PART]) + good[2:8] + struct.pack("<I", 0) + good[12:-4]), "WrongLength"),
        ("a part number beyond the last", sealed(long_part[:8] + struct.pack("<I", 2) + long_part[12:-4]), "WrongLength"),
        ("part number 2^32 - 1", sealed(long_part[:8] + b"\xff" * 4 + long_part[12:-4]), "WrongLength"),
        ("version 0", channel.part(0, 42, 1000, payload, version=0), "WrongVersion"),
        ("version 2", channel.part(0, 42, 1000, payload, version=2), "WrongVersion"),
        ("the kind of the other direction", Channel(OUTPUTS, channel.node, channel.layout_hash, channel.borders)
            .part(0, 42, 1000, payload), "WrongVersion"),
        ("other low 16 bits of the session", Channel(INPUTS, channel.node, channel.layout_hash, channel.borders, SESSION + 1)
            .part(0, 42, 1000, payload), "WrongSession"),
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
    """steps: (frame, status, (cycle, payload) that is visible afterwards or None before the first)"""
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
    broken[13] ^= 4
    one, two, wrap = (lambda c: seen(single, c)), (lambda c: seen(double, c)), 1 << 32
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


def make_cyclic():
    reals = layout("", [("bodyControlPitchSpeed", "Real32"), ("bodyControlYawSpeed", "Real32"), ("tetherSpeed", "Real32")])
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
        good_frame("the answer", answer, 42, 25000, struct.pack("<d", 1234.5)),
        good_frame("the answer of a node with a fault", answer, 43, 0, struct.pack("<d", 1234.5), FAULT),
        good_frame("the master stops safely", example, 44, 1000, bytes(12), SAFE_STOP),
        good_frame("the answer of a node in its safe state", answer, 44, 0, bytes(8), SAFE_STOP),
        good_frame("the answer of a node in its safe state, with a fault", answer, 45, 0, bytes(8), SAFE_STOP | FAULT),
        good_frame("no signal", Channel(OUTPUTS, 1, fnv1a64(b""), [0, 0], 1), 0, 0, b""),
        good_frame("largest numbers", example, 0xFFFFFFFF, 0xFFFFFFFF, b"\xff" * 12, 0x7F),
        good_frame("one byte", Channel(INPUTS, 3, 5, [0, 1]), 1, 2, b"\x5a"),
        good_frame("two parts", split, 9, 77, bytes(range(13)), RESENT),
        good_frame("three datagrams of the largest size", largest, 1, 5, largest_payload),
        good_frame("part 1 of a multicast group, with the inputs of nodes 7 and 9",
                   Channel(GROUP_INPUTS, 0, fnv1a64(b"7:12@2\n9:4@14\n"), [0, 18]), 42, 1000, struct.pack("<H", 1) + payload + struct.pack("<f", 8.0)),
    ]
    refused = make_refused(Channel(INPUTS, 7, layout_hash, [0, 12, 20]), payload + bytes(8))
    return {"frames": frames, "refused": refused,
            "sequences": make_sequences(Channel(INPUTS, 7, layout_hash, [0, 4]), split)}


# ---- sealed cyclic frames -------------------------------------------------------------------------------------------

def make_sealed_refused(channel, payload):
    good = channel.part(0, 42, 1000, payload)

    def by(**change):
        arguments = dict(kind=INPUTS, node=channel.node, layout_hash=channel.layout_hash, borders=channel.borders, key=channel.key)
        return Channel(**{**arguments, **change})

    plain = by(key=None).part(0, 42, 1000, payload)
    rows = [
        ("a header alone", good[:12], "WrongLength"),
        ("a tag cut short", good[:-1], "WrongLength"),
        ("one byte long", good + b"\0", "WrongLength"),
        ("a frame that is not sealed", plain, "WrongLength"),
        ("a frame that is not sealed, of the right length", plain + bytes(12), "Forged"),
        ("version 2", channel.part(0, 42, 1000, payload, version=2), "WrongVersion"),
        ("the kind of the other direction", by(kind=OUTPUTS).part(0, 42, 1000, payload), "WrongVersion"),
        ("other low 16 bits of the session", by(session=SESSION + 1).part(0, 42, 1000, payload), "WrongSession"),
        ("another session with the same low 16 bits", by(session=SESSION ^ 0x10000).part(0, 42, 1000, payload), "Forged"),
        ("another node", by(node=channel.node + 1).part(0, 42, 1000, payload), "Forged"),
        ("another key", by(key=bytes(reversed(channel.key))).part(0, 42, 1000, payload), "Forged"),
        ("the other direction, made to look like this one", good[:1] + by(kind=OUTPUTS).part(0, 42, 1000, payload)[1:], "Forged"),
        ("another cycle with the same low 32 bits", channel.part(0, 42 + (1 << 32), 1000, payload), "Forged"),
        ("the cycle changed on the way", good[:4] + bytes([43]) + good[5:], "Forged"),
        ("a flag set on the way", good[:1] + bytes([RESENT]) + good[2:], "Forged"),
        ("the time changed on the way", good[:8] + bytes([good[8] ^ 1]) + good[9:], "Forged"),
        ("a bit of the payload", good[:12] + bytes([good[12] ^ 1]) + good[13:], "Forged"),
        ("a bit of the tag", good[:-1] + bytes([good[-1] ^ 0x80]), "Forged"),
        ("a tag of zeros", good[:-16] + bytes(16), "Forged"),
        ("part 1 as part 0", good[:12] + channel.part(1, 42, 0, payload)[12:], "Forged"),
    ]
    return {"channel": channel.json(), "frames": [{"name": n, "hex": f.hex(), "status": s} for n, f, s in rows]}


def make_sealed():
    check_aead()
    key = bytes(range(0x40, 0x60))
    reals = layout("", [("bodyControlPitchSpeed", "Real32"), ("bodyControlYawSpeed", "Real32"), ("tetherSpeed", "Real32")])
    layout_hash = int(reals["hash"], 16)
    payload = struct.pack("<3f", 0.5, -1.25, 1.5)
    example = Channel(INPUTS, 7, layout_hash, [0, 12], key=key)
    answer = Channel(OUTPUTS, 7, fnv1a64(b"tetherForce:Real64@0\n"), [0, 8], key=bytes(range(0xC0, 0xE0)))
    split = Channel(INPUTS, 2, 0x1122334455667788, [0, 8, 13], key=key)
    largest = Channel(OUTPUTS, 65535, 0xFFFFFFFFFFFFFFFF, [0, 1444, 2888, 2900], 0xFFFFFFFFFFFFFFFF, key=bytes([0xFF]) * 32)
    largest_payload = bytes((i * 7 + i // 256) & 0xFF for i in range(2900))
    frames = [
        good_frame("the worked example, sealed", example, 42, 1000, payload),
        good_frame("the same, resent", example, 42, 1000, payload, RESENT),
        good_frame("the next cycle", example, 43, 1000, payload),
        good_frame("the answer", answer, 42, 25000, struct.pack("<d", 1234.5)),
        good_frame("the answer of a node with a fault", answer, 43, 0, struct.pack("<d", 1234.5), FAULT),
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

    sequences = [
        sequence("the 32 bits of the wire run over", single, wrap - 1, [
            (whole(wrap - 1), "Complete", seen(wrap - 1)), (whole(wrap), "Complete", seen(wrap)), (whole(wrap - 1), "Old", seen(wrap)),
            (whole(wrap + 1), "Complete", seen(wrap + 1))]),
        sequence("frames of 2^32 cycles ago", single, wrap + 5, [
            (whole(5), "Forged", None), (whole(wrap + 5), "Complete", seen(wrap + 5)), (whole(6), "Forged", seen(wrap + 5))]),
        sequence("frames that come again", single, 5, [
            (whole(5), "Complete", seen(5)), (whole(5), "Duplicate", seen(5)), (whole(5, RESENT), "Duplicate", seen(5)), (whole(4), "Old", seen(5)),
            (whole(6), "Complete", seen(6)), (whole(5), "Old", seen(6))]),
    ]
    refused = make_sealed_refused(Channel(INPUTS, 7, layout_hash, [0, 12, 24], key=key), payload + bytes(range(12)))
    return {"frames": frames, "refused": refused, "sequences": sequences}


# ---- control frames -------------------------------------------------------------------------------------------------

def control(kind, body):
    return struct.pack("<IB", 1 + len(body), kind) + body


def compact(fields):
    return json.dumps(fields, sort_keys=True, separators=(",", ":"), ensure_ascii=False).encode()


def example_messages():
    table = "[tetherSpeed]\ntype = Real\nunit = m/s\n"
    uuid, master = "6f1f6f5a-7a5e-4b57-9d0c-3a2f4cf0b1d2", "0b8b1e9e-52c4-4f0e-8a44-1c5b1f2f9a10"
    values = base64.b64encode(struct.pack("<f", 1.5)).decode()
    return [
        (1, "Hello", dict(protocol=1, name="Winch", uuid=uuid, role="node", features=[])),
        (1, "Hello", dict(protocol=1, name="Master", uuid=master, session=hex64(SESSION), tableHash=hex64(fnv1a64(b"x")),
                          table=table, state="Off", period=10000000, features=[])),
        (2, "Register", dict(name="Winch", uuid=uuid, policy="ErrorZeroOrderHold", listener=False, cyclic="udp", udpPort=40123,
                             inputs=[dict(name="tetherSpeed", type="Real32", unit="m/s")],
                             outputs=[dict(name="tetherLength", type="Real64", unit="m")])),
        (3, "Registered", dict(node=7, inputsHash=hex64(fnv1a64(b"tetherSpeed:Real32@0\n")),
                               outputsHash=hex64(fnv1a64(b"tetherLength:Real64@0\n")), state="Off", token="00000000075bcd15")),
        (3, "Registered", dict(node=7, inputsHash=hex64(fnv1a64(b"tetherSpeed:Real32@0\n")),
                               outputsHash=hex64(fnv1a64(b"tetherLength:Real64@0\n")), state="Off", token="00000000075bcd15",
                               seal=dict(inputs=base64.b64encode(bytes(range(32))).decode(), outputs=base64.b64encode(bytes(range(32, 64))).decode()))),
        (4, "Rejected", dict(error="SignalHasWriter", text="signal 'tetherLength' is written by node 'Model'; stop it first")),
        (5, "AttachCyclicChannel", dict(node=7, token="00000000075bcd15")),
        (6, "CyclicChannelAttached", {}),
        (7, "MasterEnds", {}),
        (10, "InitializeAllStates", {}),
        (11, "SendYourInitialOutputStates", {}),
        (12, "ReceiveMyInitialOutputStates", dict(values=base64.b64encode(struct.pack("<d", 300)).decode())),
        (13, "InitializeWithValues", dict(values=values)),
        (14, "Initialized", {}),
        (15, "StatesInitialized", dict(ok=False, text="node 'Winch' did not answer within 2000 ms; is it running?")),
        (20, "StartRealTime", dict(cycles=1000)),
        (21, "RealTimeStarted", dict(period=10000000, clock="Scaled", scale=0.5, firstCycle=hex64(0))),
        (22, "RealTimeReady", {}),
        (23, "Stop", {}),
        (24, "RealTimeStopped", dict(reason="stopped by 'Control Center'")),
        (30, "GetState", {}),
        (31, "State", dict(state="RealTime", cycle=hex64(2**40 + 1), period=10000000, clock="RealTime", scale=1,
                           session=hex64(SESSION), counters=dict(cycles=12, overruns=0), digest=hex64(2**64 - 1),
                           nodes=[dict(name="Winch", id=7, inputs=1, outputs=1, listener=False, every=1, policy="ErrorZeroOrderHold",
                                       transport="udp", address="127.0.0.1:41000", lateAnswers=0, duplicates=0, rejected=0, forged=0, resent=0)])),
        (32, "GetSignals", dict(names=["tetherSpeed"])),
        (33, "Signals", dict(signals=[dict(name="tetherSpeed", type="Real32", unit="m/s", description="Höhe \"quoted\"",
                                           value="1.5", writer="")])),
        (34, "SetSignals", dict(values=dict(tetherSpeed="-1.5"))),
        (34, "SetSignals", dict(values=dict(tetherSpeed="-1.5"), duration=2500000000)),
        (35, "Done", {}),
        (36, "Failed", dict(error="WrongState", text="cannot start in state 'RealTime'; send Stop first")),
        (40, "NodeFault", dict(text="step() threw std::runtime_error: 'sensor lost'")),
        (1, "Hello", dict(protocol=1, name="Model", uuid=uuid, role="node", features=["sameCycle"])),
        (2, "Register", dict(name="Model", uuid=uuid, policy="ErrorZeroOrderHold", listener=False, cyclic="tcp", twoPhase=True,
                             inputs=[dict(name="tetherSpeed", type="Real32", unit="m/s", sameCycle=True)],
                             outputs=[dict(name="tetherLength", type="Real64", unit="m")])),
        (1, "Hello", dict(protocol=1, name="Viewer", uuid=uuid, role="node", features=["quality"])),
        (2, "Register", dict(name="Viewer", uuid=uuid, policy="SilentZeroOrderHold", listener=True, cyclic="tcp", quality=True,
                             inputs=[dict(name="tetherSpeed", type="Real32", unit="m/s")], outputs=[])),
        (3, "Registered", dict(node=8, inputsHash=hex64(fnv1a64(b"tetherSpeed:Real32@0\nqualities@4\n")),
                               outputsHash=hex64(fnv1a64(b"")), state="Off", token="00000000075bcd16")),
        (4, "Rejected", dict(error="WriterNotNamed", text="signal 'tetherSpeed' cannot be written by node 'Model': the table of the master has 'writer = Autopilot'")),
        (33, "Signals", dict(signals=[dict(name="tetherSpeed", type="Real32", unit="m/s", description="", value="0", writer="Autopilot > Pilot",
                                           source="Pilot", quality=253)])),
        (2, "Register", dict(name="Control Center", uuid=uuid, policy="SilentZeroOrderHold", listener=True, every=10, cyclic="tcp",
                             inputs=[dict(name="tetherSpeed", type="Real32", unit="m/s")], outputs=[])),
        (52, "GetSchedule", {}),
        (53, "Schedule", dict(
            stages=[[dict(node="Model", phase="outputs")], [dict(node="Autopilot", phase="step")], [dict(node="Model", phase="update")]],
            links=[{"signal": "tetherSpeed", "from": "Autopilot", "to": "Model", "age": 0, "sameCycle": True},
                   {"signal": "tetherLength", "from": "Model", "to": "Autopilot", "age": 1, "sameCycle": False}])),
        (60, "TakeLease", dict(signals=["tetherSpeed"], values=dict(tetherSpeed="0.5"), whoever="Anna at desk 3", timeout=500000000, takeOver=True)),
        (60, "TakeLease", dict(signals=["tetherSpeed", "tetherLength"])),
        (61, "ReleaseLease", dict(signals=["tetherSpeed"])),
        (61, "ReleaseLease", {}),
        (62, "GetLeases", {}),
        (63, "Leases", dict(leases=[dict(signal="tetherSpeed", holder="Anna at desk 3", lease="held", timeout=500000000)])),
        (64, "LeasesChanged", dict(leases=[dict(signal="tetherSpeed", holder="Anna at desk 3", lease="lost", timeout=500000000)])),
        (33, "Signals", dict(signals=[dict(name="tetherSpeed", type="Real32", unit="m/s", description="", value="0.5", writer="Winch",
                                           holder="Anna at desk 3", lease="held")])),
        (36, "Failed", dict(error="LeaseHeld", text="signal 'tetherSpeed' is taken over by 'Anna'; ask for its release, or take it over")),
        (65, "GetEvents", dict(since=41)),
        (66, "Events", dict(more=False, events=[dict(sequence=42, time=hex64(1767225600123456789), severity="warning", kind="node", source="Winch",
                                                     text="node Winch has left: it closed the connection")])),
        (25, "SafeStop", dict(reason="smoke at the winch")),
        (25, "SafeStop", {}),
        (26, "Reset", {}),
        (27, "Arm", {}),
        (28, "Armed", dict(token="00f1e2d3c4b5a697", validFor=5000000000)),
        (20, "StartRealTime", dict(cycles=1000, token="00f1e2d3c4b5a697")),
        (2, "Register", dict(name="Winch", uuid=uuid, policy="SafeStopWhenLate", listener=False, critical=True, cyclic="udp", udpPort=40123,
                             inputs=[dict(name="tetherSpeed", type="Real32", unit="m/s")], outputs=[])),
        (31, "State", dict(state="SafeStop", reason="critical node 'Winch' has left: it closed the connection", remains="node 'Winch' is not back; start it again",
                           armed=False, armingRequired=True, cycle=hex64(4711), period=10000000, clock="RealTime", scale=1,
                           session=hex64(SESSION), counters=dict(cycles=4711), digest=hex64(1),
                           nodes=[dict(name="Model", id=8, inputs=1, outputs=1, listener=False, critical=False, state="SafeStop", policy="ErrorZeroOrderHold",
                                       transport="udp", address="127.0.0.1:41000", lateAnswers=0, duplicates=0, rejected=0, resent=0)])),
        (50, "GetStatistics", {}),
        (50, "GetStatistics", dict(histograms=True)),
        (51, "Statistics", example_statistics()),
    ]


def example_statistics():
    def distribution(count, least, most, bins=None):
        mean = (least + most) // 2 if (least + most) % 2 == 0 else (least + most) / 2
        figures = dict(count=count, minimum=least, mean=mean, p001=least, p01=least, p50=least,
                       p99=most, p999=most, maximum=most)
        return dict(figures, bins=bins) if bins else figures

    def duration(least, most):
        return dict(sinceStart=distribution(12, least, most, [[least, 11], [most, 1]]), last10s=distribution(5, least, least, [[least, 5]]))

    nothing = dict(sinceStart=distribution(0, 0, 0), last10s=distribution(0, 0, 0))
    return dict(
        master=dict(lateness=duration(5000, 80001), execution=duration(21000, 40000), roundTrip=duration(90000, 300000),
                    slack=duration(9000000, 9900000),
                    counters=dict(cycles=12, overruns=1, skippedCycles=2, caughtUpCycles=0, shiftedTime=0, lateAnswers=1, incompleteCycles=1, strangers=0)),
        nodes=[dict(name="Winch", execution=duration(11000, 12000), roundTrip=duration(90000, 25300000), slack=duration(0, 9900000),
                    counters=dict(answers=11, late=1, lost=0, duplicated=0, reordered=0, rejected=0, forged=0, resent=0)),
               dict(name="View", execution=nothing, roundTrip=nothing, slack=nothing,
                    counters=dict(answers=0, late=0, lost=0, duplicated=0, reordered=0, rejected=0, forged=0, resent=0))],
        worst=[dict(cycle=7, skipped=2, lateness=80001, roundTrip=300000, execution=40000, slack=9600000,
                    stages=[dict(name="commands", duration=1000), dict(name="ask", duration=15000),
                            dict(name="local nodes", duration=0), dict(name="collect", duration=300000),
                            dict(name="finish", duration=4000)])])


def make_control():
    good = [dict(name=f"{name} {i}", kind=kind, kindName=name, fields=fields, hex=control(kind, compact(fields)).hex(), canonical=True)
            for i, (kind, name, fields) in enumerate(example_messages())]

    def accepted(name, kind, kind_name, fields, body):
        good.append(dict(name=name, kind=kind, kindName=kind_name, fields=fields, hex=control(kind, body).hex(), canonical=False))

    accepted("an empty body", 23, "Stop", {}, b"")
    accepted("spaces and line ends", 20, "StartRealTime", {"cycles": 3}, b' {\r\n\t"cycles" : 3 } \n')
    accepted("an unknown kind", 77, "unknown kind 77", {"a": 1}, b'{"a":1}')
    accepted("kind 255", 255, "unknown kind 255", {}, b"{}")
    accepted("an unknown field", 23, "Stop", {"why": "lunch"}, b'{"why":"lunch"}')
    accepted("escapes", 40, "NodeFault", {"text": "a\"\\{[ü\n\U0001F642"}, b'{"text":"a\\"\\\\{[\\u00fc\\n\\ud83d\\ude42"}')
    accepted("depth 16", 23, "Stop", {"a": json.loads("[" * 15 + "]" * 15)}, b'{"a":' + b"[" * 15 + b"]" * 15 + b"}")
    accepted("neighbours are no depth", 23, "Stop", {"a": [[], {}] * 20}, b'{"a":[' + b",".join([b"[],{}"] * 20) + b"]}")
    accepted("one name in several objects", 23, "Stop", {"a": {"a": [{"a": "a"}, {"a": "a"}]}}, b'{"a":{"a":[{"a":"a"},{"a":"a"}]}}')
    accepted("brackets in a text are no depth", 23, "Stop", {"a": "[" * 40 + '"' + "{" * 40},
             b'{"a":"' + b"[" * 40 + b'\\"' + b"{" * 40 + b'"}')
    bad = [
        ("length 0", struct.pack("<I", 0), "FrameTooShort"),
        ("length 1 MiB + 1", struct.pack("<I", 1024 * 1024 + 1), "FrameTooLong"),
        ("length 2^31", struct.pack("<I", 2**31), "FrameTooLong"),
        ("length 2^32 - 1", b"\xff" * 4, "FrameTooLong"),
        ("a length in big-endian order", struct.pack(">IB", 3, 23) + b"{}", "FrameTooLong"),
        ("a line of HTTP", b"GET / HTTP/1.1\r\n", "FrameTooLong"),
        ("depth 17 of arrays", control(23, b'{"a":' + b"[" * 16 + b"]" * 16 + b"}"), "NestedTooDeep"),
        ("depth 17 of objects", control(23, b'{"a":' * 17 + b"1" + b"}" * 17), "NestedTooDeep"),
        ("open brackets without end", control(23, b"[" * 1000), "NestedTooDeep"),
        ("an array", control(23, b"[]"), "InvalidJson"),
        ("a number", control(23, b"1"), "InvalidJson"),
        ("a text", control(23, b'"Stop"'), "InvalidJson"),
        ("spaces alone", control(23, b"  "), "InvalidJson"),
        ("half an object", control(23, b'{"a":'), "InvalidJson"),
        ("a text without end", control(23, b'{"a":"b}'), "InvalidJson"),
        ("bytes behind the object", control(23, b"{}x"), "InvalidJson"),
        ("two objects", control(23, b"{}{}"), "InvalidJson"),
        ("a comma at the end", control(23, b'{"a":1,}'), "InvalidJson"),
        ("NaN", control(23, b'{"a":NaN}'), "InvalidJson"),
        ("a single-quoted name", control(23, b"{'a':1}"), "InvalidJson"),
        ("a zero byte", control(23, b"{}\0"), "InvalidJson"),
        ("Latin-1", control(23, b'{"a":"\xfc"}'), "InvalidJson"),
        ("UTF-8 cut off", control(23, b'{"a":"\xe2\x82"}'), "InvalidJson"),
        ("UTF-8 longer than needed", control(23, b'{"a":"\xc0\xaf"}'), "InvalidJson"),
        ("a surrogate in UTF-8", control(23, b'{"a":"\xed\xa0\x80"}'), "InvalidJson"),
        ("beyond Unicode", control(23, b'{"a":"\xf5\x80\x80\x80"}'), "InvalidJson"),
        ("a name twice", control(23, b'{"a":[1],"a":[2]}'), "InvalidJson"),
        ("a name twice, once with an escape", control(23, b'{"b":{"a/":[1],"x":1,"\\u0061\\/" :[2]}}'), "InvalidJson"),
        ("UTF-16", control(23, '{"a":1}'.encode("utf-16-le")), "InvalidJson"),
    ]
    return {"good": good, "bad": [dict(name=n, hex=f.hex(), error=e) for n, f, e in bad]}


def beacon(port, name, flags=0, table_hash=0, magic=b"QPLB", version=1, length=None):
    text = name if isinstance(name, bytes) else name.encode()
    body = struct.pack("<4sBBHQB", magic, version, flags, port, table_hash, len(text) if length is None else length) + text
    return body + struct.pack("<I", crc32c(body))


def make_beacons():
    longest = "Höhenwindkraftanlage der Versuchsstation am Meer, Mast 3, unten"
    good = [dict(name=n, port=p, secured=bool(f), tableHash=hex64(h), text=t, hex=beacon(p, t, f, h).hex()) for n, p, t, f, h in [
        ("insecure", 50000, "awe_master", 0, 0x0123456789ABCDEF), ("secured", 50000, "kite", 1, 2**64 - 1),
        ("the least", 1, "a", 0, 0), ("the most", 65535, longest, 1, 2**63)]]
    assert len(longest.encode()) == 64
    one = beacon(50000, "kite")
    bad = [
        ("nothing", b""), ("one byte", one[:1]), ("the last byte is missing", one[:-1]), ("one byte too many", one + b"\0"),
        ("another magic", beacon(50000, "kite", magic=b"QPLC")), ("version 0", beacon(50000, "kite", version=0)),
        ("version 2", beacon(50000, "kite", version=2)), ("an unknown flag", beacon(50000, "kite", flags=2)),
        ("the highest flag", beacon(50000, "kite", flags=0x81)), ("port 0", beacon(0, "kite")), ("no name", beacon(50000, "")),
        ("a name of 65 bytes", beacon(50000, "x" * 65)), ("a name of 255 bytes", beacon(50000, "x" * 255)),
        ("a name that is longer than said", beacon(50000, "kite", length=3)), ("a name that is shorter than said", beacon(50000, "kite", length=5)),
        ("a name in Latin-1", beacon(50000, b"H\xf6he")), ("a surrogate in the name", beacon(50000, b"\xed\xa0\x80")),
        ("a wrong checksum", one[:-1] + bytes([one[-1] ^ 1])), ("a bit of the port", one[:6] + bytes([one[6] ^ 1]) + one[7:]),
        ("200 zeros", bytes(200)),
    ]
    return {"good": good, "bad": [dict(name=n, hex=d.hex()) for n, d in bad]}


def make_crc32c():
    rows = [("nothing", b""), ("the check value of all lists of CRCs", b"123456789"), ("one zero", b"\0"),
            ("RFC 3720: 32 zeros", bytes(32)), ("RFC 3720: 32 ones", b"\xff" * 32),
            ("RFC 3720: rising", bytes(range(32))), ("RFC 3720: falling", bytes(range(31, -1, -1))),
            ("a length that is no multiple of 8", bytes(range(200, 200 + 37)))]
    return {"vectors": [dict(name=n, hex=d.hex(), crc=format(crc32c(d), "08x")) for n, d in rows]}


def main():
    files = {"crc32c.json": make_crc32c(), "layouts.json": make_layouts(), "cyclic_frames.json": make_cyclic(),
             "sealed_frames.json": make_sealed(), "control_frames.json": make_control(), "beacons.json": make_beacons()}
    if sys.argv[1:] not in (["--check"], ["--write"]):
        sys.exit(__doc__)
    different = []
    for name, content in files.items():
        text = json.dumps(content, indent=1, ensure_ascii=False) + "\n"
        path = FOLDER / name
        if sys.argv[1] == "--write":
            path.write_text(text, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != text:
            different.append(name)
    if different:
        sys.exit(f"vectors/{', vectors/'.join(different)}: not what this script makes; the protocol is changed by intent only")


if __name__ == "__main__":
    main()
