#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the inputs that the fuzzers begin with, and the words that they put into them, out of
docs/protocol/vectors, signals, examples, tests/hardware and tests/models.

    make_corpus.py --check    says whether corpus/ and the dictionaries hold what this script makes
                              (exit code 1 when not)
    make_corpus.py --write    writes them
"""
import json
import pathlib
import re
import struct
import sys
import zlib

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
VECTORS = ROOT / "docs/protocol/vectors"
KINDS = {"Inputs": 1, "Outputs": 2, "GroupInputs": 3}


def vectors(name):
    return json.loads((VECTORS / f"{name}.json").read_text(encoding="utf-8"))


def file_name(text):
    return re.sub(r"[^a-z0-9]+", "_", text.lower().replace("+", "plus").replace("-", " minus ")).strip("_")


# ---- signal tables: the text as it is ------------------------------------------------------------

ODD_TABLES = {
    "every key": "[a]\ntype = Real\nunit = m/s ; of the wind\n"
    'description = "two\\nlines \\"quoted\\""\nmin = -1e3\nmax = 1e3\ninitial = 0.5\nsafe = 0\nhold = 3\n',
    "byte order mark and crlf": "\ufeff; winch\r\n[a.b_1]\r\ntype = UInt8\r\nmax = 3\r\n\r\n# end\r\n",
    "arrays and texts": "[m]\ntype = Real64[9]\ninitial = 1, 0, 0, 0, 1, 0, 0, 0, 1\n"
    '[t]\ntype = String(6)\ninitial = "H\u00f6he"\n[n]\n'
    "type = DateTime\ninitial = 2026-01-31T12:00:00.5Z\n",
    "everything wrong": "[]\n[a\n[a]\ntype\ntype = Reel\n[a]\ntype = Real\ntype = Real\nmin = 2\nmax = 1\n"
    "colour = red\n[\u00e4]\ntype = Real[1]\n[b]\ntype = Int8\ninitial = 300\n",
}


def signal_tables():
    files = {row["name"]: row["table"].encode() for row in vectors("layouts")["layouts"] if len(row["fields"]) < 100}
    files.update({path.stem: path.read_bytes() for path in (ROOT / "signals").glob("*.ini")})
    files.update({name: text.encode() for name, text in ODD_TABLES.items()})
    return files


# ---- manifests: the text as it is ----------------------------------------------------------------

MANIFESTS = {
    "every key": "; the kite\nprofile = Plant\n\n[Emergency stop]\nneed = critical\ntransport = udp, tcp\n"
    "watchdog = 500 ms ; at most\nidentity = stop-1\n[Camera]\nneed = optional\n",
    "names alone": "\ufeff[Winch]\r\n[#1; x = y]\r\n[\u00e4]\r\n",
    "durations": "[a]\nwatchdog = 1e-3 s\n[b]\nwatchdog = 24 h\n[c]\nwatchdog = 1000001 ns\n"
    '[d]\nwatchdog = "0.5 min"\n',
    "everything wrong": "need = x\nprofile = y\n[A\n[]\n[A]\nneed = vital\nneed = required\n"
    "watchdog = 0\ntransport = upd,\nidentity = a b\ncolour = red\n[A]\n[Master]\n",
}


def manifests():
    files = {name: text.encode() for name, text in MANIFESTS.items()}
    files["example"] = (ROOT / "examples/airborne_wind_energy/manifest.ini").read_bytes()
    return files


# ---- files with keys and with rights: the text as it is ------------------------------------------

KEY = "".join(f"{byte:02x}" for byte in range(32))
KEY_FILES = {
    "keys": f"; of the plant\n[Winch]\nkey = {KEY}\nrole = Node\n[anna]\nkey = {KEY[::-1]}\nrole = Operator\n",
    "keys and crlf": f"\ufeff[a.b-1_]\r\nrole = Engineer\r\nkey = {KEY.upper()}\r\n",
    "short key": f"[Winch]\nkey = {KEY[:62]}\nrole = Node\n",
    "no key": "[Winch]\nrole = Node\n",
    "key as a role": f"[Winch]\nkey = {KEY}\nrole = {KEY[1:]}\n",
    "twice": f"[Winch]\nkey = {KEY}\nrole = Node\n[Winch]\nkey = {KEY}\nkey = {KEY}\n",
    "rights": "[Winch]\nrole = Node\nwrites = tetherLength, tether*, [a-z]?, *\n[anna]\nrole = Observer\n",
    "rights of nothing": "[Winch]\nrole = Node\nwrites =\n",
    "many stars": "[Winch]\nrole = Node\nwrites = " + "*a" * 60 + "\n",
    "everything wrong": "key = 1\n[-x]\n[]\n[a\nrole = King\ncolour = red\n",
}


# ---- beacons: the datagram as it is --------------------------------------------------------------


def beacons():
    rows = vectors("beacons")
    return {row["name"]: bytes.fromhex(row["hex"]) for row in rows["good"] + rows["bad"]}


# ---- control frames: the stream as it is ---------------------------------------------------------


def control_frames():
    rows = vectors("control_frames")
    files = {row["name"]: bytes.fromhex(row["hex"]) for row in rows["good"] + rows["bad"]}
    files["several frames"] = b"".join(bytes.fromhex(row["hex"]) for row in rows["good"][:8])
    return files


# ---- cyclic frames: a channel, then frames -------------------------------------------------------


def channel(row, first_cycle=0):
    seal = 0x80 if "key" in row else 0
    sizes = [end - begin for begin, end in zip(row["borders"], row["borders"][1:])]
    head = struct.pack(
        "<BQHQQB",
        KINDS[row["kind"]] - 1 | seal,
        int(row["session"], 16),
        row["node"],
        int(row["layoutHash"], 16),
        first_cycle,
        len(sizes) - 1,
    )
    return head + b"".join(struct.pack("<H", size) for size in sizes)


def frame(text, repair=0):
    data = bytes.fromhex(text)
    return struct.pack("<BH", repair, len(data)) + data


def cyclic_frames():
    """Sealed ones are sealed again (repair 1) with the key of the fuzzer."""
    files = {}
    for name, repairs in ("cyclic_frames", (0, 1)), ("sealed_frames", (1,)):
        rows = vectors(name)
        kind = name.split("_")[0]
        for row in rows["frames"]:
            files[f"{kind} {row['name']}"] = channel(row["channel"]) + b"".join(
                frame(f, repairs[0]) for f in row["frames"]
            )
        refused = rows["refused"]
        for repair in repairs:
            files[f"{kind} refused {repair}"] = channel(refused["channel"]) + b"".join(
                frame(row["hex"], repair) for row in refused["frames"]
            )
        for row in rows["sequences"]:
            files[f"{kind} {row['name']}"] = channel(row["channel"], int(row["firstCycle"], 16)) + b"".join(
                frame(step["hex"], repairs[0]) for step in row["steps"]
            )
    return files


# ---- sessions: records of what, who, length, bytes -----------------------------------------------

MESSAGE, RAW, CONNECT, CLOSE, ANSWER, ATTACH, TIME_OUT, BECOME, EVENTS = range(9)
NUMBERS = {row["kindName"]: row["kind"] for row in vectors("control_frames")["good"]}


def record(what, who=0, data=b""):
    return struct.pack("<BBH", what, who, len(data)) + data


def message(who, kind, **fields):
    body = json.dumps(fields, sort_keys=True, separators=(",", ":"), ensure_ascii=False).encode() if fields else b""
    return record(MESSAGE, who, bytes([NUMBERS[kind]]) + body)


def hello(who, name, role="node", **more):
    return record(CONNECT) + message(
        who,
        "Hello",
        protocol=2,
        name=name,
        uuid=f"6f1f6f5a-7a5e-4b57-9d0c-3a2f4cf0b1d{who}",
        role=role,
        features=["sameCycle", "leases", "events"],
        **more,
    )


def register(
    who,
    name,
    cyclic="udp",
    inputs=(("tetherSpeed", "Real32", "m/s"),),
    outputs=(("tetherLength", "Real64", "m"),),
    **more,
):
    def described(rows):
        return [dict(name=n, type=t, unit=u) for n, t, u in rows]

    return message(
        who,
        "Register",
        **dict(
            dict(
                name=name,
                policy="ErrorZeroOrderHold",
                listener=False,
                cyclic=cyclic,
                udpPort=40000 + who,
                inputs=described(inputs),
                outputs=described(outputs),
            ),
            **more,
        ),
    )


def give_outputs(who, values="AAAAAADAckA="):
    return message(who, "ReceiveMyInitialOutputStates", values=values)


def sessions():
    winch = hello(0, "Winch") + register(0, "Winch")
    other = hello(1, "Model") + register(
        1, "Model", inputs=[("tetherLength", "Real64", "m")], outputs=[("position", "Real32[3]", "")]
    )
    tool = hello(2, "Anna", "tool")
    start = (
        message(0, "StartRealTime")
        + give_outputs(0)
        + message(0, "Initialized")
        + message(0, "RealTimeReady")
        + record(EVENTS)
    )
    values = struct.pack("<BIId", 0, 0, 1000, 300.0)
    commands = (
        message(2, "GetState")
        + message(2, "GetSignals")
        + message(2, "GetSignals", names=["tetherSpeed"])
        + message(2, "GetSchedule")
        + message(2, "GetStatistics", histograms=True)
        + message(2, "GetEvents", since=1)
        + message(2, "GetLeases")
    )
    settings = (
        message(2, "SetSignals", values=dict(tetherSpeed="-1.5", mode="2"))
        + message(2, "SetSignals", values=dict(tetherSpeed="2"), duration=2500000000)
        + message(2, "SetSignals", values=dict(title="kite", now="2026-01-31T12:00:00Z", position="1, -2.5, 3"))
    )
    leases = (
        message(
            2,
            "TakeLease",
            signals=["tetherLength"],
            values=dict(tetherLength="5"),
            whoever="Anna at desk 3",
            timeout=500000000,
        )
        + message(0, "TakeLease", signals=["tetherLength"], takeOver=True)
        + message(2, "ReleaseLease", signals=["tetherLength"])
        + message(0, "ReleaseLease")
    )
    good = vectors("control_frames")["good"]
    every = b"".join(record(RAW, 0, bytes.fromhex(row["hex"])) for row in good)
    tools_all = record(CONNECT) + record(CONNECT) + tool
    return {
        "register and leave": winch + record(CLOSE, 0),
        "initialize": winch + message(0, "InitializeAllStates") + give_outputs(0) + message(0, "Initialized"),
        "start and stop": winch + start + message(0, "GetState") + message(0, "Stop"),
        "answers": winch
        + record(ANSWER, 0, values)
        + record(ANSWER, 0, struct.pack("<BIId", 2, 1, 0, float("nan")))
        + record(ANSWER, 0, values),
        "tcp": hello(0, "Winch") + register(0, "Winch", "tcp") + record(ATTACH),
        "auto": hello(0, "Winch")
        + register(0, "Winch", "auto")
        + record(ATTACH)
        + message(0, "AttachCyclicChannel", node=1, token="0" * 16, cyclic="udp"),
        "local": hello(0, "Winch") + register(0, "Winch", "local") + start,
        "multicast": hello(0, "Winch") + register(0, "Winch", "udp-multicast") + start,
        "listener": hello(0, "View") + register(0, "View", listener=True, outputs=[]) + start,
        "two nodes": winch
        + other
        + message(1, "StartRealTime")
        + give_outputs(0)
        + give_outputs(1, "AAAAAAAAAAAAAAAA")
        + message(0, "Initialized")
        + message(1, "Initialized")
        + message(0, "RealTimeReady")
        + message(1, "RealTimeReady")
        + message(0, "NodeEvent", severity="warning", text="sensor noisy", alarm="sensor", active=True)
        + message(0, "NodeEvent", text="sensor quiet", alarm="sensor", active=False)
        + message(0, "NodeFault", text="sensor lost"),
        "joins while others run": winch
        + start
        + other
        + give_outputs(1, "AAAAAAAAAAAAAAAA")
        + message(1, "Initialized")
        + message(1, "RealTimeReady"),
        "a node that does not answer": winch + message(0, "InitializeAllStates") + record(TIME_OUT),
        "outputs of a wrong size": winch + message(0, "InitializeAllStates") + give_outputs(0, "AAAA"),
        "the same node again": winch
        + record(CONNECT)
        + message(
            1, "Hello", protocol=2, name="Winch", uuid="6f1f6f5a-7a5e-4b57-9d0c-3a2f4cf0b1d0", role="node", features=[]
        )
        + register(1, "Winch", uuid="6f1f6f5a-7a5e-4b57-9d0c-3a2f4cf0b1d0"),
        "the same output": winch + hello(1, "Model") + register(1, "Model"),
        "a loop": winch
        + hello(1, "Model")
        + message(
            1,
            "Register",
            name="Model",
            policy="SilentWait",
            listener=False,
            cyclic="udp",
            udpPort=4,
            twoPhase=True,
            inputs=[dict(name="tetherLength", type="Real64", unit="m", sameCycle=True)],
            outputs=[dict(name="tetherSpeed", type="Real32", unit="m/s")],
        ),
        "commands": winch + start + tools_all + commands,
        "settings": tools_all + settings + record(CLOSE, 2),
        "leases": winch + tools_all + leases + record(CLOSE, 2),
        "every message before hello": every,
        "every message of a tool": hello(0, "Anna", "tool") + every[:3000],
        "an observer": record(BECOME, 1) + winch + start + commands + settings,
        "every role": b"".join(
            record(BECOME, 8 * role + 1)
            + record(CONNECT)
            + message(role, "Hello", protocol=2, name="Winch", role="node", features=[])
            + message(role, "Stop")
            + message(role, "SetSignals", values=dict(tetherSpeed="1", mode="2"))
            for role in range(4)
        ),
        "garbage": record(RAW, 0, b"GET / HTTP/1.1\r\n\r\n") + record(CONNECT) + record(RAW, 1, b"\xff" * 64),
    }


# ---- local links: what a master passes, then what both ends do -----------------------------------


def passed(kinds=(0, 1, 2), change=0, length=8, frames=(0, 0)):
    return bytes((*frames, change, length, len(kinds), *kinds))


def local_links():
    poke = lambda offset, value: struct.pack("<BII", 0, offset, value)
    node_takes, master_takes = b"\x01", b"\x02"
    answer = lambda data: struct.pack("<BH", 3, len(data)) + data
    ask = lambda data: struct.pack("<BH", 4, len(data)) + data
    return {
        "frames both ways": passed() + ask(b"question") + node_takes + answer(b"answer") + master_takes,
        "large rings": passed(frames=(63, 40))
        + (ask(bytes(1472)) + node_takes) * 2
        + answer(bytes(1472))
        + master_takes,
        "nothing": passed(kinds=()),
        "too few": passed(kinds=(0, 1)),
        "too many": passed(kinds=(0, 1, 2, 3, 4, 5, 0)),
        "another order": passed(kinds=(1, 0, 2)),
        "memory without seals": passed(kinds=(4, 1, 2)),
        "pipe to read": passed(kinds=(0, 1, 3)),
        "another key": passed(change=1),
        "short": passed(length=7),
        "long": passed(length=9),
        "empty": passed(length=0),
        "tail far away": passed() + poke(64, 0xFFFFFFFF) + node_takes + ask(b"next") + node_takes,
        "head far away": passed() + poke(0, 0x80000000) + ask(b"question") + node_takes + ask(b"next"),
        "long block": passed() + ask(b"question") + poke(128, 0xFFFFFFFF) + node_takes + ask(b"next") + node_takes,
        "block beyond the end": passed() + poke(64, 65540) + poke(0, 65530) + node_takes,
        "head of the outputs": passed() + poke(65664, 7) + answer(b"answer") + master_takes,
    }


# ---- shared memory: what the other end writes, and what this one does meanwhile ------------------


def shared_memory():
    poke = lambda offset, value, head=1: struct.pack("<BBII", 0, head, offset, value)
    knock = lambda offset, value: struct.pack("<BBII", 1, 1, offset, value)
    pop, ring = b"\x02", b"\x04"
    push = lambda data: struct.pack("<BH", 3, len(data)) + data
    want = lambda count: bytes((5, count))
    return {
        "frames": (push(b"question") + pop) * 3,
        "full": push(bytes(2047)) * 33 + pop * 34,
        "tail far away": poke(64, 0xFFFFFFFF) + pop + push(b"next") + pop,
        "tail in front of the head": push(b"question") + poke(0, 100) + pop + push(b"next"),
        "head far away": poke(0, 0x80000000) + push(b"question") + pop,
        "long block": push(b"question") + poke(128, 0xFFFFFFFF) + pop + pop,
        "block beyond the end": poke(64, 65540) + poke(0, 65530) + pop + poke(65650, 0x7FFFFFFF, 0) + pop,
        "block of nothing": push(b"question") + poke(128, 0) + pop,
        "bell": want(2) + ring + ring + want(1) + ring,
        "bell of a stranger": want(2)
        + knock(0, 0xFFFFFFFF)
        + ring
        + knock(4, 0x80000000)
        + ring
        + knock(8, 7)
        + want(0)
        + ring,
    }


# ---- recordings: a kind, then a file, the records of its only chunk, or a ring -------------------


def packed(plain):
    """A frame of Zstandard with one block that is not compressed."""
    head = b"\x28\xb5\x2f\xfd\xa0" + struct.pack("<I", len(plain))
    return head + struct.pack("<I", len(plain) << 3 | 1)[:3] + plain


def recordings():
    field = lambda data: struct.pack("<I", len(data)) + data
    mcap = lambda opcode, data: struct.pack("<BQ", opcode, len(data)) + data
    channel = lambda number, topic: mcap(4, struct.pack("<HH", number, 0) + field(topic) + field(b"json") + field(b""))
    said = lambda number, time, data: mcap(5, struct.pack("<HIQQ", number, time, time, time) + data)
    body = lambda number, x, text: struct.pack("<QqQId", number, 0, 0, 0, x) + field(text) + b"\0\1"
    text = b"format: qtplc-ring-1\nperiod_ns: 1\n\n[x]\ntype = Real64\n[t]\ntype = String(3)\n"
    described = struct.pack("<QQ", 0, 0) + field(b"recording.txt") + field(b"") + struct.pack("<Q", len(text)) + text
    head = b"\x89MCAP0\r\n" + mcap(1, field(b"") + field(b"QtPLC"))
    attached = mcap(9, described + struct.pack("<I", zlib.crc32(described)))
    metadata = mcap(12, field(b"qtplc") + field(field(b"plant") + field(b"kite")))
    topics = channel(1, b"/plant") + channel(2, b"/gaps") + channel(3, b"/digest")

    def chunk(plain, begin, end, name=b"zstd"):
        data = packed(plain) if name else plain
        sizes = struct.pack("<QQQI", begin, end, len(plain), zlib.crc32(plain))
        return mcap(6, sizes + field(name) + struct.pack("<Q", len(data)) + data)

    first = topics + said(1, 0, body(0, 1.5, b"abc")) + said(1, 1, body(1, 2.5, b""))
    gap = b'{"first":2,"last":4,"cycles":2,"skipped":1,"digest":"0123456789abcdef"}'
    second = topics + said(2, 4, gap) + said(3, 4, b'{"next":5,"digest":"0123456789abcdef","end":true}')
    file = head + attached + metadata + chunk(first, 0, 1) + chunk(second, 4, 4)
    rows = struct.pack("<QqqQQIIIIII", 7, 0, 0, 0, 0, 0, 1, 16, 16, 8, 0)
    node = struct.pack("<QqIHHII", 7, 0, 0, 3, 131, 8, 0)
    whole = rows + node + bytes(16) + bytes(16) + bytes(8)
    ring = struct.pack("<QIHH", 0, 16 + len(whole), 1, 0) + whole
    ring += struct.pack("<QIHH5Q", len(ring), 56, 2, 0, 8, 9, 2, 0, 5)
    places = lambda head, oldest=0, read=0: b"\2" + struct.pack("<QQQB", head, oldest, read, 0)
    told = b'{"text":"it burns"}\0\0\0\0\0'
    texts = struct.pack("<QIHH4QIHH", 0, 80, 7, 0, 1, 0, 0, 0, 19, 1, 0) + told
    happened = topics + channel(4, b"/events") + channel(5, b"/commands") + channel(6, b"/leases")
    happened += said(4, 0, b'{"cycle":0,"severity":"error","kind":"fault","source":"Winch","text":"it\\nburns"}')
    happened += said(5, 1, b'{"cycle":1,"by":"Anna","role":"Operator","signal":"x","from":"0","to":"1","count":3}')
    happened += said(5, 2, b'{"cycle":1,"by":"Anna","command":"Stop"}')
    happened += said(6, 3, b'{"cycle":1,"by":"Anna","what":"taken","signals":["x","t"],"from":["Bert"]}')
    return {
        "file": b"\0" + file,
        "file that is cut": b"\0" + file[:-20],
        "file that is not compressed": b"\0" + head + attached + chunk(first, 0, 1, b""),
        "damaged chunk": b"\0" + head + attached + chunk(first, 0, 1)[:-1] + b"x" + chunk(second, 4, 4),
        "wrong times": b"\0" + head + attached + chunk(first, 5, 1),
        "records": b"\1" + first,
        "records with a gap": b"\1" + second,
        "records that are cut": b"\1" + first[:-5],
        "records of what has happened": b"\1" + happened,
        "ring with texts": places(len(ring)) + ring.ljust(4096, b"\0") + b"\0" + struct.pack("<QQQ", 80, 0, 0) + texts,
        "ring": places(len(ring)) + ring + b"\0",
        "ring that is cut": places(len(ring) - 8) + ring,
        "ring ahead of itself": places(8, 1 << 40, 1 << 63) + ring,
        "ring of nothing": places(1 << 63) + bytes(64),
    }


# ---- layouts: the text as it is ------------------------------------------------------------------


def layouts():
    def panel(name, share=1, **more):
        return dict(id=name, type="Gauge", settings={}, share=share, **more)

    def split(orientation, *children, share=1):
        return dict(share=share, split=orientation, children=list(children))

    def layout(tree, **more):
        return dict(
            dict(
                format="QtPLC layout", version=1, currentTab="a", windows=[], tabs=[dict(id="a", name="A", tree=tree)]
            ),
            **more,
        )

    window = dict(
        id="w",
        geometry=dict(x=1, y=-2, width=300, height=200),
        tree=panel("q"),
        home=dict(tab="a", first="p", last="p", side="below", share=0.3333),
    )
    deep = panel("p")
    for level in range(40):
        deep = split("horizontal" if level % 2 else "vertical", panel(f"p{level}", 0.5), dict(deep, share=0.5))
    files = {
        "one panel": layout(panel("p")),
        "a split": layout(split("horizontal", panel("p", 0.25), panel("q", 0.75))),
        "other keys": layout(panel("p", later=[1, 2.5, None]), later=9007199254740991),
        "a window": layout(panel("p"), windows=[window]),
        "maximized": layout(panel("p"), tabs=[dict(id="a", name="A", maximized="p", tree=panel("p"))]),
        "an empty tab": layout(panel("p"), tabs=[dict(id="a", name="A")]),
        "deep": layout(deep),
        "the same panel twice": layout(split("vertical", panel("p"), panel("p"))),
        "odd shares": layout(split("vertical", panel("p", 1e308), panel("q", -1), panel("r", 0), panel("s", "x"))),
        "a newer version": layout(panel("p"), version=2),
        "no tabs": layout(panel("p"), tabs=[]),
    }
    return dict(
        {name: json.dumps(value, indent=1).encode() for name, value in files.items()},
        **{"no json": b'{"format": "QtPLC layout"', "an array": b"[1, 2]", "text": "\u00e4".encode("latin-1")},
    )


# ---- sentences of NMEA 0183: what comes from a serial line ---------------------------------------


def sentence(body):
    total = 0
    for byte in body.encode():
        total ^= byte
    return f"${body}*{total:02X}\r\n".encode()


def nmea():
    good = [
        "WIMWV,214.8,R,5.1,M,A",
        "WIMWV,045,T,36,N,A",
        "WIMWV,0,R,,K,V",
        "IIMWV,359.9,R,100,S,A",
        "IIVWR,45,L,10.1,N,5.2,M,18.7,K",
        "IIVWT,45,R,36,N,,M,,K",
        "WIMDA,29.92,I,1.0132,B,21.5,C,,C,55,,12.1,C,90,T,87,M,10,N,5.14,M",
        "WIXDR,C,21.5,C,AIR,H,55,P,0,P,1.0132,B,0",
        "GPGGA,120000,5130.0,N,00007.0,W,1,08,0.9,10,M,47,M,,",
        "PGRMZ,93,f,3",
        "GNGGA,123519.25,4807.038,N,01131.000,E,4,12,0.9,545.4,M,46.9,M,1.5,0001",
        "GPGGA,123519,,,,,0,00,99.99,,,,,,",
        "GPRMC,123519.00,A,4807.038,S,01131.000,W,022.4,084.4,230394,003.1,W,A",
        "GNRMC,235960,V,,,,,,,311216,,,N",
        "GPVTG,054.7,T,034.4,M,005.5,N,010.2,K,D",
    ]
    every = b"".join(map(sentence, good))
    files = {body: sentence(body) for body in good}
    files.update(
        {
            "several": every,
            "without checksum": b"$WIMWV,214.8,R,5.1,M,A\r\n!AIVDM,1,1,,A,15,0\n",
            "wrong checksum": every.replace(b"*", b"*0"),
            "cut off": every[7:40] + every[60:],
            "wrong rate": bytes((b * 37 + 11) % 256 for b in every),
            "without end": b"$WIMWV," + b"1" * 600 + every,
            "odd numbers": sentence("WIMWV,-0,R,1e5,M,A")
            + sentence("WIMWV,+.5,R,999999999999999999999,N,A")
            + sentence("WIMWV,--1,R,1.2.3,K,A"),
        }
    )
    return files


# ---- lines of text from a serial line ------------------------------------------------------------


def serial_lines():
    return {
        "two numbers": b"1.5, -2e3\r\n",
        "several lines": b"1,2\n\n3,4\r\n+ 5 , six\n",
        "without end": b"1,2",
        "too long": b"1" * 600 + b",2\n7,8\n",
        "odd numbers": b"1.2.3,nan\n1e999,inf\n,\n",
        "bytes": b"\x00\xff\x80,\x02\n",
        "control characters": b"W\\r\\n\\t\\\\\\x02\\xfF",
        "half of one": b"\\x2",
        "template": b"SP {setpoint:07.2} {{{ramp}}}\r\n",
        "long template": b"{a:99}{b:099.9}" + b"x" * 50 + b"{a}",
    }


# ---- files of sysfs: bits of a count, and the text, or a scan of IIO -----------------------------


def sysfs():
    good = b"a3 01 4b 46 7f ff 0d 10 ce"
    line = good + b" : crc=ce YES\n" + good + b" t=26187\n"
    texts = {
        "a number": b"0.000598550\n",
        "a negative one": b"-16384\n",
        "a count": b"18446744073709551615\n",
        "nothing": b"",
        "not finite": b"1e999\n",
        "two numbers": b"0.1 0.2\n",
        "a channel": b"voltage0-voltage1",
        "a channel of an axis": b"accel_x",
        "a thermometer": line,
        "wrong checksum": line.replace(b"YES", b"NO"),
        "no conversion": line.replace(good, b"50 05 4b 46 7f ff 0c 10 1c").replace(b"26187", b"85000"),
        "held low": line.replace(good, b"00 " * 8 + b"00").replace(b"26187", b"0"),
        "cut off": line[:50],
        "too hot": line.replace(b"26187", b"125063"),
        "a type": b"7 le:s12/16>>4\n\n\x00\x80",
        "a scan": b"0 le:s16/16>>0\n1 be:u24/32>>8\n2 le:s16/16X2>>0\n9 le:s64/64>>0\n\n" + bytes(range(24)),
        "a scan of floats": b"0 le:f32/32>>0\n1 be:f64/64>>0\n\n" + b"\xff" * 16,
        "an index twice": b"1 le:u8/8>>0\n1 le:u8/8>>0\n\n\x01\x02",
        "a size of six": b"1 le:u16/16X3>>0\n\n123456",
        "too long a scan": b"\n".join(b"%d le:u64/64X64>>0" % index for index in range(9)) + b"\n\n",
        "more bits than bytes": b"0 le:u17/16>>0\n\n\x01\x02",
        "too large a shift": b"0 le:u12/16>>5\n\n\x01\x02",
        "storage of 24": b"0 be:s24/24>>0\n\n\x01\x02\x03",
    }
    return {name: bytes([8]) + text for name, text in texts.items()}


# ---- DBC files: the text as it is ----------------------------------------------------------------

DBC_HEAD = 'VERSION ""\nNS_ :\n\tCM_\n\tBA_\nBS_:\nBU_: A B\n'
ODD_DBC_FILES = {
    "one message": 'BO_ 1 A: 8 X\n SG_ S : 0|16@1- (0.1,0) [0|0] "" X\n',
    "multiplexed": 'BO_ 1 A: 8 X\n SG_ P M : 0|8@1+ (1,0) [0|0] "" X\n'
    ' SG_ Q m3 : 15|16@0- (0.5,-1) [-1|1] "m" X\nSG_MUL_VAL_ 1 Q P 3-3;\n',
    "extended multiplexing": 'BO_ 1 A: 8 X\n SG_ P M : 0|8@1+ (1,0) [0|0] "" X\n'
    ' SG_ Q m0M : 8|8@1+ (1,0) [0|0] "" X\nSG_MUL_VAL_ 1 Q P 0-2, 5-7;\n',
    "several multiplexors": 'BO_ 1 A: 8 X\n SG_ P M : 0|8@1+ (1,0) [0|0] "" X\n'
    ' SG_ Q m0M : 8|8@1+ (1,0) [0|0] "" X\n SG_ R M : 16|8@0+ (1,0) [0|0] "" X\n'
    ' SG_ S m1 : 24|8@1+ (1,0) [0|0] "" X\n SG_ T m1 : 24|16@1- (1,0) [0|0] "" X\n'
    "SG_MUL_VAL_ 1 Q P 0-0;\nSG_MUL_VAL_ 1 S Q 1-1, 3-7;\nSG_MUL_VAL_ 1 T R 1-2;\n",
    "J1939": 'BO_ 2566844926 Speed: 8 X\n SG_ S : 0|16@1+ (0.125,0) [0|0] "" X\nBO_ 2566844670 Long: 39 X\n'
    'BA_DEF_DEF_ "GenMsgDelayTime" 5;\nBA_ "ProtocolType" "J1939";\nBA_ "VFrameFormat" BO_ 2566844926 3;\n',
    "attributes": DBC_HEAD
    + 'BO_ 2566840318 A: 64 X\n SG_ F : 0|32@1- (1,0) [0|0] "" X\nBA_DEF_ BO_ "GenMsgCycleTime" INT 0 9;\n'
    'BA_DEF_DEF_ "GenMsgCycleTime" 5;\n'
    'BA_ "GenMsgCycleTime" BO_ 2566840318 10;\n'
    'BA_ "GenSigStartValue" SG_ 2566840318 F 1e3;\nBA_ "VFrameFormat" BO_ 2566840318 15;\n'
    'BA_ "CANFD_BRS" BO_ 2566840318 "0";\n'
    'SIG_VALTYPE_ 2566840318 F : 1;\nVAL_ 2566840318 F -1 "off" 1 "on";\n',
    "independent signals": "BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX\n"
    ' SG_ S : 0|8@1- (1,0) [0|0] "" X\nBO_ 7 B: 39 X\n',
    "everything wrong": 'BO_ x\nBO_ 1 A: 8 X\n SG_ S : 60|8@1+ (0,x) [0|0\nSG_ S\nCM_ "no end\n',
}


def dbc_files():
    files = {"winch drive": (ROOT / "tests/hardware/can/winch_drive.dbc").read_bytes()}
    files.update({name: text.encode() for name, text in ODD_DBC_FILES.items()})
    return files


# fmt: off
DBC_WORDS = ["BO_ ", "SG_ ", "VAL_ ", "SIG_VALTYPE_ ", "SG_MUL_VAL_ ", "BA_ ", "BA_DEF_DEF_ ", "CM_ ", "NS_", "BS_:",
             "BU_:", "VERSION", "VAL_TABLE_", "EV_ ", " M : ", " m1 : ", " m0M : ", "0|8@1+ ", "7|16@0- ", "(1,0) ",
             "[0|0] ", "\"\" ", "GenMsgCycleTime", "GenSigStartValue", "VFrameFormat", "CANFD_BRS", "1e308",
             "18446744073709551615", "2147483648"]
# fmt: on


# ---- CANopen: EDS files as they are, and what devices send ---------------------------------------

EDS_HEAD = "[DeviceInfo]\nVendorNumber=0x29C\nProductNumber=7\n"
EDS_FILES = {
    "variables": EDS_HEAD + "[1000]\nParameterName=Device type\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\n"
    "DefaultValue=0x00020192\n[6060]\nParameterName=Modes\nDataType=0x0002\nAccessType=rww\nDefaultValue=-1\n",
    "record": "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=2\n"
    "[1018sub0]\nDataType=5\nDefaultValue=1\n[1018Sub1]\nParameterName=Vendor-ID\nDataType=7\nAccessType=ro\n",
    "pdo": "[1800sub1]\nDataType=0x0007\nDefaultValue=$NODEID+0x180\n[1A00sub0]\nDataType=0x5\nDefaultValue=1\n"
    "[1A00sub1]\nDataType=0x0007\nDefaultValue=0x60410010\nParameterValue=0x60640020\n",
    "compact": "[2001]\nParameterName=Inputs\nObjectType=0x8\nCompactSubObj=3\nDataType=0x0004\nAccessType=ro\n",
    "texts and floats": "[1008]\nDataType=0x0009\nDefaultValue=drive\n[2002]\nDataType=0x0008\nDefaultValue=1.5\n",
    "everything wrong": "[1000]\nDataType=0x10000\nDefaultValue=twelve\n[1000]\nx\n[1018sub1]\nCompactSubObj=999\n",
}
# fmt: off
EDS_WORDS = ["[1000]", "[1018sub1]", "sub", "DeviceInfo", "VendorNumber", "ParameterName", "ObjectType", "DataType",
             "AccessType", "DefaultValue", "ParameterValue", "CompactSubObj", "SubNumber", "PDOMapping", "$NODEID",
             "$NODEID+0x180", "0x0007", "0x0002", "const", "ro", "=", "-1", "18446744073709551615", "0xFFFFFFFF"]
# fmt: on


def eds_files():
    return {name: text.encode() for name, text in EDS_FILES.items()}


def sdo():
    """What was asked for (a byte), and frames of 8 bytes that the device answers."""
    read, write, neither = bytes([0]), bytes([1 | 20 << 2]), bytes([2])
    address = bytes([0x08, 0x10, 0x00])
    return {
        "expedited": read + b"\x4b" + address + b"\x37\x02\0\0",
        "in segments": read + b"\x41" + address + b"\x0a\0\0\0" + b"\0abcdefg" + b"\x19hij\0\0\0\0",
        "without size": read + b"\x40" + address + bytes(4) + b"\x01abcdefg",
        "aborted": read + b"\x80" + address + b"\0\0\x02\x06",
        "of another object": read + b"\x43\x41\x60\0" + bytes(4) + b"\x43" + address + bytes(4),
        "wrong toggle": read + b"\x41" + address + b"\x0e\0\0\0" + b"\0abcdefg" * 2,
        "too large": read + b"\x41" + address + b"\xff" * 4,
        "written in segments": write
        + b"\x60"
        + address
        + bytes(4)
        + b"".join(bytes([command]) + bytes(7) for command in (0x20, 0x30, 0x20)),
        "a master": neither
        + b"".join(
            id_.to_bytes(2, "little") + bytes([len(data)]) + data
            for id_, data in (
                (0x605, bytes.fromhex("2300180185010080")),
                (0x605, bytes.fromhex("2300 1a01 2001 0020".replace(" ", ""))),
                (0x605, bytes.fromhex("2f001a0001000000")),
                (0x605, bytes.fromhex("2300180185010000")),
                (0x000, b"\1\5"),
                (0x080, b""),
                (0x605, bytes.fromhex("2100200214000000")),
                (0x605, b"\0abcdefg"),
            )
        ),
        "heartbeats": neither + b"\x05\x07\x01\x05" + b"\x05\x07\x01\x00" + b"\x85\0\x08\x10\x23\x03" + bytes(5),
    }


# ---- descriptions of FMUs: the text as it is -----------------------------------------------------


def description(version, variables, more=""):
    return (
        f'<fmiModelDescription fmiVersion="{version}.0" modelName="M" guid="g"><CoSimulation modelIdentifier="m"/>'
        f"{more}<ModelVariables>{variables}</ModelVariables></fmiModelDescription>"
    )


ODD_DESCRIPTIONS = {
    "arrays of fmi2": description(
        2,
        "".join(
            f'<ScalarVariable name="A[{i},{j}]" valueReference="{i}{j}"><Real/></ScalarVariable>'
            for i in (2, 1)
            for j in (1, 2)
        ),
    ),
    "dimensions of fmi3": description(
        3,
        '<UInt64 name="n" valueReference="1" causality="structuralParameter" start="2"/>'
        '<Float32 name="A" valueReference="2"><Dimension valueReference="1"/><Dimension start="0"/><Alias name="B"/>'
        "</Float32>",
    ),
    "texts and clocks": description(
        3, '<String name="s" valueReference="1"><Start value="&#65;"/></String><Clock name="c" valueReference="2"/>'
    ),
    "comments": description(2, "<!-- ' = --><![CDATA[' = ]]><?a ' = ?>"),
    "entities": '<!DOCTYPE a [<!ENTITY b "&c;">]><fmiModelDescription>&b;</fmiModelDescription>',
    "everything wrong": '<fmiModelDescription fmiVersion="2.0"><CoSimulation modelIdentifier="../m"/><ModelVariables>'
    '<ScalarVariable name="" valueReference="-1" causality="x"><Real start="',
}


def fmu_descriptions():
    files = {path.stem: path.read_bytes() for path in (ROOT / "tests/models/fmu").glob("*.xml")}
    files.update({name: text.encode() for name, text in ODD_DESCRIPTIONS.items()})
    return files


# fmt: off
FMU_WORDS = ["<ScalarVariable ", "</ScalarVariable>", "<Real/>", "<Enumeration/>", "<Item ", "<Float64 ",
             "<UInt64 ", "<Dimension ", "<Start ", "<Alias ", "<CoSimulation ", "<ModelExchange ",
             "<ModelVariables>", "</ModelVariables>", "<TypeDefinitions>", "<SimpleType ", "<DefaultExperiment ",
             "name=", "valueReference=", "causality=", "variability=", "start=", "declaredType=",
             "structuralParameter", "fmiVersion=", "3.0", "<!--", "-->", "<![CDATA[", "<!DOCTYPE ", "&#65;",
             "1e308", "4294967296", "[1,2]"]
# fmt: on


# ---- words that inputs are made of ---------------------------------------------------------------

# fmt: off
KEYS = ["type", "unit", "description", "min", "max", "initial", "safe", "hold", "Bool", "Byte", "Int", "Int64",
        "UInt16", "Real", "Real64", "RealTriple", "String", "String(", "DateTime", " = ", " ; ", "\\n", "\\\"",
        "1e308", "2026-01-31T12:00:00Z"]


MANIFEST_WORDS = ["profile", "need", "transport", "watchdog", "identity", "critical", "required", "optional", "Plant",
                  "Simulation", "Automatic", "udp", "tcp", "local", "udp-multicast", "inprocess", "Master", " ms",
                  " h", " = ", " ; "]


RIGHTS_WORDS = ["key", "role", "writes", "Observer", "Operator", "Node", "Engineer", "tether*", "[a-z]", " = ", " ; ",
                KEY]
LAYOUT_WORDS = ["format", "QtPLC layout", "version", "currentTab", "tabs", "windows", "id", "name", "tree", "type",
                "settings", "share", "split", "children", "horizontal", "vertical", "geometry", "width", "height",
                "home", "first", "last", "side", "below", "above", "left", "right", "maximized", "1e308", "null", "{}",
                "[]"]
# fmt: on


def texts_of(value):
    """Names and short texts of a JSON value."""
    if isinstance(value, dict):
        return set(value).union(*(texts_of(v) for v in value.values()))
    if isinstance(value, list):
        return set().union(*(texts_of(v) for v in value))
    return {value} if isinstance(value, str) and re.fullmatch(r"[!-~]{1,24}", value) and value.isalpha() else set()


def dictionary(words):
    escaped = (word.replace("\\", "\\\\").replace('"', '\\"') for word in words)
    return "".join(f'"{word}"\n' for word in escaped).encode()


def dictionaries():
    fields = set().union(*(texts_of(row["fields"]) for row in vectors("control_frames")["good"]))
    return {
        "keys.dict": dictionary(KEYS),
        "dbc.dict": dictionary(DBC_WORDS),
        "eds.dict": dictionary(EDS_WORDS),
        "fmu.dict": dictionary(FMU_WORDS),
        "manifest.dict": dictionary(MANIFEST_WORDS),
        "rights.dict": dictionary(RIGHTS_WORDS),
        "layout.dict": dictionary(LAYOUT_WORDS),
        "fields.dict": dictionary(sorted(word for word in fields if word.isascii())),
    }


# ---- files ---------------------------------------------------------------------------------------


def main():
    if sys.argv[1:] not in (["--check"], ["--write"]):
        sys.exit(__doc__)
    wanted = {HERE / name: data for name, data in dictionaries().items()}
    for folder, files in (
        ("signal_table", signal_tables()),
        ("manifest", manifests()),
        ("control_frames", control_frames()),
        ("cyclic_frames", cyclic_frames()),
        ("session", sessions()),
        ("local_link", local_links()),
        ("dbc_file", dbc_files()),
        ("fmu_description", fmu_descriptions()),
        ("eds_file", eds_files()),
        ("sdo", sdo()),
        ("nmea", nmea()),
        ("serial_lines", serial_lines()),
        ("sysfs", sysfs()),
        ("key_file", {name: text.encode() for name, text in KEY_FILES.items()}),
        ("beacon", beacons()),
        ("shared_memory", shared_memory()),
        ("layout", layouts()),
        ("recording", recordings()),
    ):
        for name, data in files.items():
            path = HERE / "corpus" / folder / file_name(name)
            assert path not in wanted, f"two inputs are called {path}"
            wanted[path] = data
    found = {path: path.read_bytes() for path in [*HERE.glob("*.dict"), *HERE.glob("corpus/*/*")] if path.is_file()}
    if sys.argv[1] == "--check":
        different = sorted(
            str(path.relative_to(HERE)) for path in wanted.keys() | found.keys() if wanted.get(path) != found.get(path)
        )
        if different:
            sys.exit(
                f"{', '.join(different[:10])}: not what this script makes; " "remedy: tests/fuzz/make_corpus.py --write"
            )
        return
    for path in found.keys() - wanted.keys():
        path.unlink()
    for path, data in wanted.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


if __name__ == "__main__":
    main()
