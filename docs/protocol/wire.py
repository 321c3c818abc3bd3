# SPDX-License-Identifier: Apache-2.0
"""The wire format of QtPLC by docs/protocol.md alone. It shares nothing with the C++ code, not even
the CRC-32C, so that each tests the other."""
import struct

INPUTS, OUTPUTS, GROUP_INPUTS = 1, 2, 3
RESENT, FAULT, SAFE_STOP, PART = 0x01, 0x02, 0x04, 0x80
VERSION = 2
HEADER = 12
SESSION = 0x8F3A61C2D4E5B097


# ---- checksums -----------------------------------------------------------------------------------


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


# ---- ChaCha20-Poly1305, by RFC 8439 --------------------------------------------------------------


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
        total = (total + int.from_bytes(data[i : i + 16] + b"\1", "little")) * r % (2**130 - 5)
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
    plain = (
        b"Ladies and Gentlemen of the class of '99: If I could offer you only one tip for the future, "
        b"sunscreen would be it."
    )
    result = aead(
        bytes(range(0x80, 0xA0)),
        bytes.fromhex("070000004041424344454647"),
        plain,
        bytes.fromhex("50515253c0c1c2c3c4c5c6c7"),
    )
    assert (
        result[:16].hex() == "d31a8d34648e60db7b86afbc53ef7ec2"
        and result[-16:].hex() == "1ae10b594f09e26a7e902ecbd0600691"
    )


# ---- layouts and values --------------------------------------------------------------------------

SIZES = {
    "Int8": 1,
    "Int16": 2,
    "Int32": 4,
    "Int64": 8,
    "UInt8": 1,
    "UInt16": 2,
    "UInt32": 4,
    "UInt64": 8,
    "Real32": 4,
    "Real64": 8,
    "DateTime": 8,
}


def size_of(type_name):
    if type_name.startswith("String("):
        return 2 + int(type_name[7:-1])
    if type_name.endswith("]"):
        scalar, count = type_name[:-1].split("[")
        return SIZES[scalar] * int(count)
    return SIZES[type_name]


def layout(name, fields, table=None, maximum=1456, qualities=False):
    """fields: (signal, canonical type); table: type names as written in the signal table, where
    they differ; qualities: they follow the values."""
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
    return {
        "name": name,
        "table": ini,
        "fields": placed,
        "text": text,
        "hash": hex64(fnv1a64(text.encode())),
        "size": offset,
        "maximum": maximum,
        "borders": borders,
        "qualities": qualities,
    }


def digest(image, before=0):
    """Of all values, after a cycle."""

    def mix(state, word):
        state = (state ^ word) * 0x9E3779B97F4A7C15 & 0xFFFFFFFFFFFFFFFF
        return state ^ state >> 32

    lanes = [1, 2, 3, 4]
    for words in struct.iter_unpack("<4Q", image + bytes(-len(image) % 32)):
        lanes = [mix(lane, word) for lane, word in zip(lanes, words)]
    result = mix(before, len(image))
    for lane in lanes:
        result = mix(result, lane)
    return mix(result, result >> 29)


def table_lines(name, type_name, unit="", minimum=b"", maximum=b"", safe=b"", hold="", nan="", slope=None, writer=""):
    """The two lines of a signal in the text of the table hash; the second one is that of its safety
    hash. Values are their bytes in a payload."""
    slope = struct.pack("<d", slope).hex() if slope else ""
    return (
        f"{name}:{type_name}:{unit}\n",
        ":".join([minimum.hex(), maximum.hex(), safe.hex(), hold, nan, slope, writer]) + "\n",
    )


# ---- cyclic frames -------------------------------------------------------------------------------


def short_time(time):
    """5 bits exponent, 11 bits fraction; what does not fit is cut."""
    exponent = max(0, time.bit_length() - 11)
    return exponent << 11 | (time >> exponent - 1) & 0x7FF if exponent else time


class Channel:
    """One direction of one node."""

    def __init__(self, kind, node, layout_hash, borders, session=SESSION, key=None):
        self.kind, self.node, self.layout_hash, self.borders, self.session, self.key = (
            kind,
            node,
            layout_hash,
            borders,
            session,
            key,
        )
        self.seed = crc32c(struct.pack("<QHQ", session, node, layout_hash))

    def part(self, number, cycle, info, payload, flags=0, version=VERSION, before=0):
        if number > 0:
            flags, info = flags | PART, number
        body = struct.pack(
            "<BBHIHH",
            version << 4 | self.kind,
            flags,
            self.session & 0xFFFF,
            cycle & 0xFFFFFFFF,
            info if flags & PART else short_time(info),
            before,
        )
        if self.key:
            nonce = struct.pack("<QH", cycle ^ self.session, number ^ self.node) + body[:2]
            return body + aead(self.key, nonce, payload[self.borders[number] : self.borders[number + 1]], body)
        body += payload[self.borders[number] : self.borders[number + 1]]
        return body + struct.pack("<I", crc32c(body, self.seed))

    def parts(self, cycle, info, payload, flags=0, before=0):
        return [self.part(i, cycle, info, payload, flags, before=before) for i in range(len(self.borders) - 1)]

    def json(self):
        return {
            "kind": {INPUTS: "Inputs", OUTPUTS: "Outputs", GROUP_INPUTS: "GroupInputs"}[self.kind],
            "session": hex64(self.session),
            "node": self.node,
            "layoutHash": hex64(self.layout_hash),
            "borders": self.borders,
            **({"key": self.key.hex()} if self.key else {}),
        }


# ---- control frames and beacons ------------------------------------------------------------------


def control(kind, body):
    return struct.pack("<IB", 1 + len(body), kind) + body


def beacon(port, name, flags=0, table_hash=0, magic=b"QPLB", version=1, length=None):
    text = name if isinstance(name, bytes) else name.encode()
    body = (
        struct.pack("<4sBBHQB", magic, version, flags, port, table_hash, len(text) if length is None else length) + text
    )
    return body + struct.pack("<I", crc32c(body))
