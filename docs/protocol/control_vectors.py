# SPDX-License-Identifier: Apache-2.0
"""Vectors of control frames, beacons and checksums."""
import base64
import json
import struct

from wire import SESSION, beacon, control, crc32c, fnv1a64, hex64, table_lines


def compact(fields):
    return json.dumps(fields, sort_keys=True, separators=(",", ":"), ensure_ascii=False).encode()


def example_messages():
    table = "[tetherSpeed]\ntype = Real\nunit = m/s\n"
    uuid, master = "6f1f6f5a-7a5e-4b57-9d0c-3a2f4cf0b1d2", "0b8b1e9e-52c4-4f0e-8a44-1c5b1f2f9a10"
    values = base64.b64encode(struct.pack("<f", 1.5)).decode()
    # fmt: off
    return [
        (1, "Hello", dict(protocol=2, name="Winch", uuid=uuid, role="node", features=[])),
        (1, "Hello", dict(protocol=2, name="Master", uuid=master, session=hex64(SESSION),
                          tableHash=hex64(fnv1a64(b"x")), table=table, state="Off", period=10000000, features=[])),
        (2, "Register", dict(name="Winch", uuid=uuid, policy="ErrorZeroOrderHold", listener=False, cyclic="udp",
                             udpPort=40123, inputs=[dict(name="tetherSpeed", type="Real32", unit="m/s")],
                             outputs=[dict(name="tetherLength", type="Real64", unit="m")])),
        (3, "Registered", dict(node=7, inputsHash=hex64(fnv1a64(b"tetherSpeed:Real32@0\n")),
                               outputsHash=hex64(fnv1a64(b"tetherLength:Real64@0\n")), state="Off",
                               token="00000000075bcd15")),
        (3, "Registered", dict(node=7, inputsHash=hex64(fnv1a64(b"tetherSpeed:Real32@0\n")),
                               outputsHash=hex64(fnv1a64(b"tetherLength:Real64@0\n")), state="Off",
                               token="00000000075bcd15",
                               seal=dict(inputs=base64.b64encode(bytes(range(32))).decode(),
                                         outputs=base64.b64encode(bytes(range(32, 64))).decode()))),
        (4, "Rejected", dict(error="SignalHasWriter",
                             text="signal 'tetherLength' is written by node 'Model'; stop it first")),
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
                           nodes=[dict(name="Winch", id=7, inputs=1, outputs=1, listener=False, every=1,
                                       policy="ErrorZeroOrderHold",
                                       transport="udp", address="127.0.0.1:41000", lateAnswers=0, duplicates=0,
                                       rejected=0, forged=0, resent=0)])),
        (32, "GetSignals", dict(names=["tetherSpeed"])),
        (33, "Signals", dict(signals=[dict(name="tetherSpeed", type="Real32", unit="m/s", description="Höhe \"quoted\"",
                                           value="1.5", writer="")])),
        (34, "SetSignals", dict(values=dict(tetherSpeed="-1.5"))),
        (34, "SetSignals", dict(values=dict(tetherSpeed="-1.5"), duration=2500000000)),
        (1, "Hello", dict(protocol=2, name="Master", uuid=master, session=hex64(SESSION),
                          tableHash=hex64(fnv1a64(b"flightPhase:Int8:\n")),
                          table="[flightPhase]\ntype = Int8\nvalues = 0: Launch, 1: Power, 2: ReelOut\n", state="Off",
                          period=10000000, features=[])),
        (35, "Done", {}),
        (36, "Failed", dict(error="WrongState", text="cannot start in state 'RealTime'; send Stop first")),
        (40, "NodeFault", dict(text="step() threw std::runtime_error: 'sensor lost'")),
        (1, "Hello", dict(protocol=2, name="Model", uuid=uuid, role="node", features=["sameCycle"])),
        (2, "Register", dict(name="Model", uuid=uuid, policy="ErrorZeroOrderHold", listener=False, cyclic="tcp",
                             twoPhase=True,
                             inputs=[dict(name="tetherSpeed", type="Real32", unit="m/s", sameCycle=True)],
                             outputs=[dict(name="tetherLength", type="Real64", unit="m")])),
        (1, "Hello", dict(protocol=2, name="Viewer", uuid=uuid, role="node", features=["quality"])),
        (2, "Register", dict(name="Viewer", uuid=uuid, policy="SilentZeroOrderHold", listener=True, cyclic="tcp",
                             quality=True, inputs=[dict(name="tetherSpeed", type="Real32", unit="m/s")], outputs=[])),
        (3, "Registered", dict(node=8, inputsHash=hex64(fnv1a64(b"tetherSpeed:Real32@0\nqualities@4\n")),
                               outputsHash=hex64(fnv1a64(b"")), state="Off", token="00000000075bcd16")),
        (1, "Hello", dict(protocol=2, name="Sensor", uuid=uuid, role="node", features=["outputQuality"])),
        (2, "Register", dict(name="Sensor", uuid=uuid, policy="ErrorZeroOrderHold", listener=False, cyclic="tcp",
                             outputQuality=True,
                             inputs=[], outputs=[dict(name="tetherLength", type="Real64", unit="m")])),
        (3, "Registered", dict(node=9, inputsHash=hex64(fnv1a64(b"")),
                               outputsHash=hex64(fnv1a64(b"tetherLength:Real64@0\nqualities@8\n")), state="Off",
                               token="00000000075bcd17")),
        (4, "Rejected", dict(error="WriterNotNamed",
                             text="signal 'tetherSpeed' cannot be written by node 'Model': "
                                  "the table of the master has 'writer = Autopilot'")),
        (33, "Signals", dict(signals=[dict(name="tetherSpeed", type="Real32", unit="m/s", description="", value="0",
                                           writer="Autopilot > Pilot", source="Pilot", quality=253)])),
        (2, "Register", dict(name="Control Center", uuid=uuid, policy="SilentZeroOrderHold", listener=True, every=10,
                             cyclic="tcp", inputs=[dict(name="tetherSpeed", type="Real32", unit="m/s")], outputs=[])),
        (52, "GetSchedule", {}),
        (53, "Schedule", dict(
            stages=[[dict(node="Model", phase="outputs")], [dict(node="Autopilot", phase="step")],
                    [dict(node="Model", phase="update")]],
            links=[{"signal": "tetherSpeed", "from": "Autopilot", "to": "Model", "age": 0, "sameCycle": True},
                   {"signal": "tetherLength", "from": "Model", "to": "Autopilot", "age": 1, "sameCycle": False}])),
        (60, "TakeLease", dict(signals=["tetherSpeed"], values=dict(tetherSpeed="0.5"), whoever="Anna at desk 3",
                               timeout=500000000, takeOver=True)),
        (60, "TakeLease", dict(signals=["tetherSpeed", "tetherLength"])),
        (61, "ReleaseLease", dict(signals=["tetherSpeed"])),
        (61, "ReleaseLease", {}),
        (62, "GetLeases", {}),
        (63, "Leases", dict(leases=[dict(signal="tetherSpeed", holder="Anna at desk 3", lease="held",
                                         timeout=500000000)])),
        (64, "LeasesChanged", dict(leases=[dict(signal="tetherSpeed", holder="Anna at desk 3", lease="lost",
                                                timeout=500000000)])),
        (33, "Signals", dict(signals=[dict(name="tetherSpeed", type="Real32", unit="m/s", description="", value="0.5",
                                           writer="Winch", holder="Anna at desk 3", lease="held")])),
        (36, "Failed", dict(error="LeaseHeld",
                            text="signal 'tetherSpeed' is taken over by 'Anna'; ask for its release, or take it over")),
        (65, "GetEvents", dict(since=41)),
        (66, "Events", dict(more=False, events=[dict(sequence=42, time=hex64(1767225600123456789), severity="warning",
                                                     kind="node", source="Winch",
                                                     text="node Winch has left: it closed the connection")])),
        (23, "Stop", dict(whoever="Anna at desk 3", how="Esc Esc")),
        (1, "Hello", dict(protocol=2, name="Winch", uuid=uuid, role="node", features=["hardware"])),
        (4, "Rejected", dict(error="ProfileMismatch",
                             text="node 'Winch' drives real devices, and the phase at hand "
                                  "has the profile Simulation; stop it")),
        (11, "SendYourInitialOutputStates", dict(phase=hex64(4096))),
        (12, "ReceiveMyInitialOutputStates", dict(values=base64.b64encode(struct.pack("<d", 300)).decode(),
                                                  goesOn=True)),
        (21, "RealTimeStarted", dict(period=10000000, clock="RealTime", scale=1, profile="Plant", cycleZero=hex64(4096),
                                     firstCycle=hex64(4100))),
        (31, "State", dict(state="Ready", profile="Plant", profileReason="node 'Winch' drives real devices",
                           cycle=hex64(0), period=10000000, clock="RealTime", scale=1,
                           session=hex64(SESSION), counters=dict(cycles=0), digest=hex64(0), nodes=[])),
        (25, "SafeStop", dict(reason="smoke at the winch")),
        (25, "SafeStop", {}),
        (26, "Reset", dict(latch=1)),
        (27, "Arm", {}),
        (28, "Armed", dict(token="00f1e2d3c4b5a697", validFor=5000000000)),
        (20, "StartRealTime", dict(cycles=1000, token="00f1e2d3c4b5a697")),
        (2, "Register", dict(name="Winch", uuid=uuid, policy="SafeStopWhenLate", listener=False, critical=True,
                             cyclic="udp", udpPort=40123,
                             inputs=[dict(name="tetherSpeed", type="Real32", unit="m/s")], outputs=[])),
        (31, "State", dict(state="SafeStop", reason="critical node 'Winch' has left: it closed the connection",
                           remains="node 'Winch' is not back; start it again",
                           evicted=[dict(name="Winch", by="'anna'", time=hex64(1767225601000000000))],
                           recorder=dict(state="DiskFull", file="/var/lib/qtplc/kite.mcap.part", bytesPerSecond=0,
                                         freeBytes=4096, missing=7,
                                         error="cannot write 'kite.mcap.part': No space left on device"),
                           armed=False, armingRequired=True, cycle=hex64(4711), period=10000000, clock="RealTime",
                           scale=1, session=hex64(SESSION), counters=dict(cycles=4711), digest=hex64(1),
                           nodes=[dict(name="Model", id=8, inputs=1, outputs=1, listener=False, critical=False,
                                       state="SafeStop", policy="ErrorZeroOrderHold",
                                       transport="udp", address="127.0.0.1:41000", lateAnswers=0, duplicates=0,
                                       rejected=0, resent=0)])),
        (66, "Events", dict(more=False, events=[
            dict(sequence=43, time=hex64(1767225601000000000), severity="warning", kind="node", source="Winch",
                 alarm="node Winch",
                 active=True, text="node Winch is gone in the middle of its work: the connection ended"),
            dict(sequence=44, time=hex64(1767225604200000000), severity="info", kind="node", source="Winch",
                 alarm="node Winch", active=False, text="node Winch is back, after 3.2 s")])),
        (67, "Note", dict(text="the left steering line vibrates", whoever="anna")),
        (68, "GetRecords", {}),
        (68, "GetRecords", dict(ring="qtplc-ring-1000-kite-b1946ac92492d234-1", part="texts", saved=hex64(4096),
                                **{"from": hex64(8192)}, bytes=32768,
                                recorder=dict(state="Recording", file="ground:/data/kite.mcap", bytesPerSecond=14100,
                                              freeBytes=512000000, missing=0, error=""))),
        (68, "GetRecords", dict(ring="qtplc-ring-1000-kite-b1946ac92492d234-1", ends=True)),
        (69, "Records", dict(ring="qtplc-ring-1000-kite-b1946ac92492d234-1", part="texts", head=hex64(8208),
                             bytes=base64.b64encode(bytes(range(16))).decode(), capacity=hex64(1048576),
                             startTime=hex64(1767225600000000000), **{"from": hex64(8192)})),
        (50, "GetStatistics", {}),
        (50, "GetStatistics", dict(histograms=True)),
        (51, "Statistics", example_statistics()),
        (40, "NodeFault", dict(text="step() threw std::runtime_error: 'sensor lost'", phase=hex64(4096))),
        (2, "Register", dict(name="Winch", uuid=uuid, policy="ErrorZeroOrderHold", listener=False, cyclic="tcp",
                             inputs=[dict(name="tetherSpeed", type="Real32", unit="m/s",
                                          safety=hex64(fnv1a64(table_lines("", "", safe=bytes(4))[1].encode())))],
                                          outputs=[])),
        (4, "Rejected", dict(error="SafetyMismatch",
                             text="safety parameters (min, max, safe, hold, nan, slope, writer) "
                                  "of 'tetherSpeed' are other ones")),
        (70, "Evict", dict(name="Emergency stop")),
        (71, "Admit", dict(name="Emergency stop")),
        (4, "Rejected", dict(error="Evicted",
                             text="'Winch' was evicted by 'anna'; "
                                  "an operator can let it in again: qtplc admit 'Winch'")),
        (2, "Register", dict(name="Camera", uuid=uuid, policy="ErrorZeroOrderHold", listener=False, cyclic="auto",
                             udpPort=40124, inputs=[dict(name="tetherSpeed", type="Real32", unit="m/s")], outputs=[])),
        (3, "Registered", dict(node=10, inputsHash=hex64(fnv1a64(b"tetherSpeed:Real32@0\n")),
                               outputsHash=hex64(fnv1a64(b"")), state="Off", token="00000000075bcd18",
                               probe=dict(question="0123456789abcdef", answer="fedcba9876543210"))),
        (5, "AttachCyclicChannel", dict(node=10, token="00000000075bcd18", cyclic="udp")),
        (21, "RealTimeStarted", dict(period=10000000, clock="External", scale=0, profile="Simulation",
                                     cycleZero=hex64(8192), firstCycle=hex64(8192))),
        (41, "NodeEvent", dict(severity="warning", text="the battery of the wind vane is low")),
        (41, "NodeEvent", dict(severity="error", text="device 'drive' is lost", alarm="device drive", active=True)),
    ]
    # fmt: on


def example_statistics():
    def distribution(count, least, most, bins=None):
        mean = (least + most) // 2 if (least + most) % 2 == 0 else (least + most) / 2
        figures = dict(
            count=count, minimum=least, mean=mean, p001=least, p01=least, p50=least, p99=most, p999=most, maximum=most
        )
        return dict(figures, bins=bins) if bins else figures

    def duration(least, most):
        return dict(
            sinceStart=distribution(12, least, most, [[least, 11], [most, 1]]),
            last10s=distribution(5, least, least, [[least, 5]]),
        )

    nothing = dict(sinceStart=distribution(0, 0, 0), last10s=distribution(0, 0, 0))
    # fmt: off
    return dict(
        master=dict(lateness=duration(5000, 80001), execution=duration(21000, 40000), roundTrip=duration(90000, 300000),
                    slack=duration(9000000, 9900000),
                    counters=dict(cycles=12, overruns=1, skippedCycles=2, caughtUpCycles=0, shiftedTime=0,
                                  lateAnswers=1, incompleteCycles=1, strangers=0)),
        nodes=[dict(name="Winch", execution=duration(11000, 12000), roundTrip=duration(90000, 25300000),
                    slack=duration(0, 9900000),
                    counters=dict(answers=11, late=1, lost=0, duplicated=0, reordered=0, rejected=0, forged=0,
                                  resent=0)),
               dict(name="View", execution=nothing, roundTrip=nothing, slack=nothing,
                    counters=dict(answers=0, late=0, lost=0, duplicated=0, reordered=0, rejected=0, forged=0,
                                  resent=0))],
        worst=[dict(cycle=7, skipped=2, lateness=80001, roundTrip=300000, execution=40000, slack=9600000,
                    stages=[dict(name="commands", duration=1000), dict(name="ask", duration=15000),
                            dict(name="local nodes", duration=0), dict(name="collect", duration=300000),
                            dict(name="finish", duration=4000)])])
    # fmt: on


def make_control():
    good = [
        dict(
            name=f"{name} {i}",
            kind=kind,
            kindName=name,
            fields=fields,
            hex=control(kind, compact(fields)).hex(),
            canonical=True,
        )
        for i, (kind, name, fields) in enumerate(example_messages())
    ]

    def accepted(name, kind, kind_name, fields, body):
        good.append(
            dict(
                name=name, kind=kind, kindName=kind_name, fields=fields, hex=control(kind, body).hex(), canonical=False
            )
        )

    accepted("an empty body", 23, "Stop", {}, b"")
    accepted("spaces and line ends", 20, "StartRealTime", {"cycles": 3}, b' {\r\n\t"cycles" : 3 } \n')
    accepted("an unknown kind", 77, "unknown kind 77", {"a": 1}, b'{"a":1}')
    accepted("kind 255", 255, "unknown kind 255", {}, b"{}")
    accepted("an unknown field", 23, "Stop", {"why": "lunch"}, b'{"why":"lunch"}')
    accepted(
        "escapes", 40, "NodeFault", {"text": 'a"\\{[ü\n\U0001F642'}, b'{"text":"a\\"\\\\{[\\u00fc\\n\\ud83d\\ude42"}'
    )
    accepted("depth 16", 23, "Stop", {"a": json.loads("[" * 15 + "]" * 15)}, b'{"a":' + b"[" * 15 + b"]" * 15 + b"}")
    accepted(
        "neighbours are no depth", 23, "Stop", {"a": [[], {}] * 20}, b'{"a":[' + b",".join([b"[],{}"] * 20) + b"]}"
    )
    accepted(
        "one name in several objects",
        23,
        "Stop",
        {"a": {"a": [{"a": "a"}, {"a": "a"}]}},
        b'{"a":{"a":[{"a":"a"},{"a":"a"}]}}',
    )
    accepted(
        "brackets in a text are no depth",
        23,
        "Stop",
        {"a": "[" * 40 + '"' + "{" * 40},
        b'{"a":"' + b"[" * 40 + b'\\"' + b"{" * 40 + b'"}',
    )
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


def make_beacons():
    longest = "Höhenwindkraftanlage der Versuchsstation am Meer, Mast 3, unten"
    good = [
        dict(name=n, port=p, secured=bool(f), tableHash=hex64(h), text=t, hex=beacon(p, t, f, h).hex())
        for n, p, t, f, h in [
            ("insecure", 50000, "awe_master", 0, 0x0123456789ABCDEF),
            ("secured", 50000, "kite", 1, 2**64 - 1),
            ("the least", 1, "a", 0, 0),
            ("the most", 65535, longest, 1, 2**63),
        ]
    ]
    assert len(longest.encode()) == 64
    one = beacon(50000, "kite")
    bad = [
        ("nothing", b""),
        ("one byte", one[:1]),
        ("the last byte is missing", one[:-1]),
        ("one byte too many", one + b"\0"),
        ("another magic", beacon(50000, "kite", magic=b"QPLC")),
        ("version 0", beacon(50000, "kite", version=0)),
        ("version 2", beacon(50000, "kite", version=2)),
        ("an unknown flag", beacon(50000, "kite", flags=2)),
        ("the highest flag", beacon(50000, "kite", flags=0x81)),
        ("port 0", beacon(0, "kite")),
        ("no name", beacon(50000, "")),
        ("a name of 65 bytes", beacon(50000, "x" * 65)),
        ("a name of 255 bytes", beacon(50000, "x" * 255)),
        ("a name that is longer than said", beacon(50000, "kite", length=3)),
        ("a name that is shorter than said", beacon(50000, "kite", length=5)),
        ("a name in Latin-1", beacon(50000, b"H\xf6he")),
        ("a surrogate in the name", beacon(50000, b"\xed\xa0\x80")),
        ("a wrong checksum", one[:-1] + bytes([one[-1] ^ 1])),
        ("a bit of the port", one[:6] + bytes([one[6] ^ 1]) + one[7:]),
        ("200 zeros", bytes(200)),
    ]
    return {"good": good, "bad": [dict(name=n, hex=d.hex()) for n, d in bad]}


def make_crc32c():
    rows = [
        ("nothing", b""),
        ("the check value of all lists of CRCs", b"123456789"),
        ("one zero", b"\0"),
        ("RFC 3720: 32 zeros", bytes(32)),
        ("RFC 3720: 32 ones", b"\xff" * 32),
        ("RFC 3720: rising", bytes(range(32))),
        ("RFC 3720: falling", bytes(range(31, -1, -1))),
        ("a length that is no multiple of 8", bytes(range(200, 200 + 37))),
    ]
    return {"vectors": [dict(name=n, hex=d.hex(), crc=format(crc32c(d), "08x")) for n, d in rows]}
