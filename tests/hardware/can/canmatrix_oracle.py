#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Encodes and decodes frames by canmatrix: what another implementation makes of a DBC file.

usage: canmatrix_oracle.py FILE.dbc < QUESTIONS > ANSWERS

A question is a line of JSON: {"frame": NAME, "raw": {SIGNAL: TEXT, ...}}, an answer {"bytes": HEX,
"raw": {SIGNAL: TEXT, ...}, "physical": {SIGNAL: TEXT, ...}}, of the signals that canmatrix finds in
the bytes. A raw value is a decimal integer; that of a float is "f" and the number as Python writes
it. Another question is {"id": NUMBER, "bytes": HEX}, of an extended frame on a network of J1939;
its answer has the "frame" of the file in addition. Exit code 77: there is no canmatrix.
"""
import json
import logging
import sys

try:
    import canmatrix.formats
except ImportError:
    sys.exit(77)


def raw_of(signal, text):
    return float(text[1:]) if signal.is_float else int(text)


def text_of(signal, raw):
    return "f" + repr(float(raw)) if signal.is_float else str(raw)


def texts_of(decoded):
    return {
        "raw": {name: text_of(one.signal, one.raw_value) for name, one in decoded.items()},
        "physical": {name: repr(float(one.phys_value)) for name, one in decoded.items()},
    }


def answer_frame(matrix, question):
    arbitration = canmatrix.ArbitrationId(question["id"], extended=True)
    frame = matrix.frame_by_id(arbitration) or matrix.frame_by_pgn(arbitration.pgn)
    decoded = matrix.decode(arbitration, bytes.fromhex(question["bytes"]))
    return {"frame": frame.name if frame else "", **texts_of(decoded)}


def answer(frame, question):
    signals = {name: frame.signal_by_name(name) for name in question["raw"]}
    values = {}
    for name, text in question["raw"].items():
        signal = signals[name]
        raw = raw_of(signal, text)
        # Integers go through their physical value and back.
        values[name] = raw if signal.is_float else signal.phys2raw(signal.raw2phys(raw))
    data = bytes(frame.encode(values))
    return {"bytes": data.hex(), **texts_of(frame.decode(data))}


def main():
    logging.disable(logging.CRITICAL)
    matrix = canmatrix.formats.loadp_flat(sys.argv[1])
    frames = {frame.name: frame for frame in matrix.frames}
    for line in sys.stdin:
        question = json.loads(line)
        if "id" in question:
            print(json.dumps(answer_frame(matrix, question)))
        else:
            print(json.dumps(answer(frames[question["frame"]], question)))


main()
