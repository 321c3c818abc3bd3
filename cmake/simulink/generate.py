#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a node program around code that Simulink has exported: qtplc_add_simulink_node() calls it.

Reads names only: which variables are inputs and outputs, and which functions to call. The compiler
finds the types by decltype, so a wrong guess does not compile. The same export gives the same text.
"""
import argparse
import re
import sys
from pathlib import Path

from headers import Refusal
from model import PARAMETERS, Reader, seconds

MOST_ERRORS = 10  # of MAP that one message shows
MOST_TEXT = 60  # [characters] of a line in a message
STANDARD = "assert ctype errno float inttypes limits math setjmp stdarg stddef stdint stdio stdlib string time".split()


# ---------------------------------------------------------------- names of signals


class Entry:
    """A line of MAP: signal = field, or field[3x4] for a matrix."""

    def __init__(self, line, signal, text):
        found = re.fullmatch(r"(.+?)(?:\[\s*(\d{1,6})\s*x\s*(\d{1,6})\s*\])?", text)
        self.line, self.signal, self.field = line, signal, found[1].strip()
        self.rows, self.columns = (int(found[2]), int(found[3])) if found[2] else (None, None)


def refuse(file_name, errors, remedy=""):
    """All that is wrong with MAP, in one sentence."""
    if errors:
        raise Refusal(f"MAP '{file_name}', " + "; ".join(errors[:MOST_ERRORS] + [remedy] * bool(remedy)))


def read_map(file_name):
    """The entries of the section [signals]."""
    try:
        text = Path(file_name).read_text(encoding="utf-8-sig")
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "it is not a text in UTF-8"
        raise Refusal(f"MAP '{file_name}' cannot be read: {reason}")
    entries, errors, lines, is_in_section = [], [], {}, None
    for number, line in enumerate(text.split("\n"), 1):
        line = re.split(r"[;#]", line)[0].strip()
        signal, equals, field = (part.strip() for part in line.partition("="))
        if line.startswith("["):
            is_in_section = line == "[signals]"
            if not is_in_section:
                errors.append(f"line {number}: unknown section {line[:MOST_TEXT]}; it can have [signals] only")
        elif not line or is_in_section is False:
            continue
        elif is_in_section is None:
            errors.append(f"line {number}: '{line[:MOST_TEXT]}' stands before the section [signals]")
        elif not equals or not signal or not field:
            errors.append(f"line {number}: '{line[:MOST_TEXT]}' is not 'signal = field of the model'")
        elif signal in lines:
            errors.append(f"line {number}: signal '{signal[:MOST_TEXT]}' is there twice, first in line {lines[signal]}")
        else:
            lines[signal] = number
            entries.append(Entry(number, signal, field))
    refuse(file_name, errors)
    return entries


def give_names(model, prefix, entries, file_name):
    leaves = {f"inputs.{leaf.path}": leaf for leaf in model.ins}
    leaves.update({f"outputs.{leaf.path}": leaf for leaf in model.outs})
    for leaf in leaves.values():
        leaf.signal = prefix + re.sub(r"\[(\d+)\]", r".\1", leaf.path)
    errors, is_unknown, lines = [], False, {}
    for entry in entries:
        names = [name for name in leaves if entry.field in (name, name.split(".", 1)[1])]
        where = f"line {entry.line}: '{entry.field[:MOST_TEXT]}' of signal '{entry.signal[:MOST_TEXT]}'"
        if len(names) > 1:
            errors.append(f"{where} is both an input and an output; write inputs.NAME or outputs.NAME")
        elif not names:
            errors.append(f"{where} is no input or output of the model")
            is_unknown = True
        elif names[0] in lines:
            errors.append(f"{where} has a signal already, in line {lines[names[0]]}")
        else:
            lines[names[0]] = entry.line
            errors += rename(leaves[names[0]], entry)
    refuse(file_name, errors, "its inputs and outputs: " + ", ".join(leaves) if is_unknown else "")
    signals = [leaf.signal for leaf in leaves.values() if leaf in model.outs]
    repeated = sorted({signal for signal in signals if signals.count(signal) > 1})
    if repeated:
        raise Refusal(f"two outputs have the signal '{repeated[0]}'; give them names of their own with MAP")


def rename(leaf, entry):
    """Returns what is wrong."""
    leaf.signal = entry.signal
    if entry.rows is None:
        return []
    leaf.rows, leaf.columns = entry.rows, entry.columns
    if len(leaf.dims) == 1 and leaf.dims[0] == leaf.rows * leaf.columns:
        return []
    return [f"line {entry.line}: '{leaf.path}' has {leaf.dims or 1} elements, which is not {leaf.rows}x{leaf.columns}"]


# ---------------------------------------------------------------- C++


def quoted(text):
    text = "".join(c if c.isprintable() else " " for c in text)
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("??", "?\\?") + '"'


class Port:
    def __init__(self, leaf, struct, is_input):
        self.leaf, self.is_input = leaf, is_input
        self.variable = f"{struct}.{leaf.path}"
        self.name = ("m_in_" if is_input else "m_out_") + re.sub(r"\W+", "_", leaf.path).strip("_")
        self.type = f"Type<decltype(({self.variable}))>"
        self.is_copied = leaf.is_bool or leaf.rows > 0 or len(leaf.dims) > 1

    def value_type(self):
        if not self.is_copied:
            return self.type
        if self.leaf.is_bool:
            return f"Truths<{self.type}>" if self.leaf.dims else "bool"
        return f"Values<{self.type}>"

    def declaration(self):
        direction = "Input" if self.is_input else "Output"
        signal = quoted(self.leaf.signal)
        if self.is_copied:
            return f"QPlc{direction}<{self.value_type()}> {self.name}{{this, {signal}}};"
        return f"QPlcBound{direction}<{self.type}> {self.name}{{this, {signal}, &{self.variable}}};"

    def copy(self):
        leaf = self.leaf
        if not leaf.dims:  # a truth value
            if self.is_input:
                return [f"{self.variable} = {self.name};"]
            return [f"{self.name} = {self.variable} != 0;"]
        if self.is_input:
            if leaf.is_bool:
                return [f"fromTruths({self.variable}, {self.name}.value());"]
            if leaf.rows:
                return [f"transpose({self.variable}, {self.name}.value(), {leaf.rows}, {leaf.columns});"]
            return [f"copy({self.variable}, {self.name}.value());"]
        if leaf.is_bool:
            return [f"{self.name} = toTruths({self.variable});"]
        if leaf.rows:
            call = f"transpose(rows, {self.variable}, {leaf.columns}, {leaf.rows});"
        else:
            call = f"copy(rows, {self.variable});"
        return ["{", f"    {self.value_type()} rows{{}};", f"    {call}", f"    {self.name} = rows;", "}"]

    def description(self):
        values = ", ".join(f"{number}: {name}" for name, number in self.leaf.enum)
        description = self.leaf.description if self.leaf.description != self.leaf.signal else ""
        texts = [quoted(self.leaf.signal), quoted(description)] + ([quoted(values)] if values else [])
        return f"addSignal<{self.value_type()}>({', '.join(texts)});"


class Node:
    """The text of the generated node."""

    def __init__(self, model, options):
        self.model, self.options = model, options
        self.ports = [Port(leaf, model.inputs, True) for leaf in model.ins]
        self.ports += [Port(leaf, model.outputs, False) for leaf in model.outs]
        self.is_two_phase = "output" in model.functions

    def call(self, role):
        name = self.model.functions.get(role)
        if not name:
            return []
        if self.model.form == "class":
            return [f"m_model->{name}();"]
        arguments = ", ".join("&" + member for member in self.model.arguments.get(role, []))
        return [f"{name}({arguments});"]

    def check(self):
        model = self.model
        if not (model.has_error or model.has_stop):
            return []
        error = f"rtmGetErrorStatus({model.rtm})" if model.has_error else "nullptr"
        stop = f"rtmGetStopRequested({model.rtm}) != 0" if model.has_stop else "false"
        return [f"requireGoingOn({error}, {stop});"]

    def initialize(self):
        """The body of initializeModel()."""
        model = self.model
        lines = []
        if model.form == "class":
            lines.append("m_model.emplace();")
        lines += [f"{member} = {type_name}();" for type_name, member in model.owned if not PARAMETERS.match(type_name)]
        lines += [f"m_model.{link} = &{member};" for link, member, _ in model.links]
        if model.form == "globals" and model.inputs:
            lines.append(f"{model.inputs} = {model.input_type}();")
        if model.sets_inputs:
            lines.append(f"m_inputs = {model.input_type}();")
        if model.parameters:
            lines.append("setParameters();")
        lines += self.call("initialize")
        if model.has_final_time:
            lines.append(f"rtmGetTFinal({model.rtm}) = -1;  // the master ends it, and not the model")
        return lines + self.check()

    def compute(self, role):
        lines = []
        if self.model.sets_inputs and self.model.input_type:
            lines.append("m_model->setExternalInputs(&m_inputs);")
        lines += self.call(role)
        if self.model.sets_inputs and self.model.output_type:
            lines.append("m_outputs = m_model->getExternalOutputs();")
        return lines

    def functions(self):
        reads = [line for port in self.ports if port.is_input and port.is_copied for line in port.copy()]
        writes = [line for port in self.ports if not port.is_input and port.is_copied for line in port.copy()]
        read, write = (["readInputs();"] if reads else []), (["writeOutputs();"] if writes else [])
        parts = [("void initializeModel()", self.initialize())]
        if reads:
            parts.append(("void readInputs()", reads))
        if writes:
            parts.append(("void writeOutputs()", writes))
        if self.is_two_phase:
            step = ["requirePeriod(cycle);", *read, *self.compute("output"), *self.call("update"), *self.check()]
            parts.append(("void reset() override", ["initializeModel();"]))
            parts.append(("void outputs() override", [*self.compute("output"), *write]))
            parts.append(("void update(const QPlcCycle &cycle) override", step))
        else:
            step = ["requirePeriod(cycle);", *read, *self.compute("step"), *self.check(), *write]
            parts.append(("void reset() override", [*self.reset(), *write]))
            parts.append(("void step(const QPlcCycle &cycle) override", step))
        return parts

    def reset(self):
        lines = ["initializeModel();", *self.compute("step")]
        if not self.model.output_type:
            return [*lines, "initializeModel();"]
        lines[-1] += "  // the outputs of the initial state; this also moves the state on ..."
        lines.append(f"const auto initialOutputs = {self.model.outputs};")
        lines.append("initializeModel();  // ... so go back to it")
        return [*lines, f"{self.model.outputs} = initialOutputs;"]

    def constructor(self):
        lines = ["setTwoPhase(true);"] if self.is_two_phase else []
        if self.options.workload:
            lines.append(f"activateWorkloadMeasurement(QStringLiteral({quoted(self.options.workload)}));")
        lines += [port.description() for port in self.ports]
        return lines + [f"addParameter({quoted(n)}, {expression});" for n, expression in self.model.parameters]

    def members(self):
        model = self.model
        lines = [f"{type_name} {member} = {type_name}();" for type_name, member in model.owned]
        if model.form == "class":
            lines.append(f"std::optional<{model.class_name}> m_model{{std::in_place}};")
        if model.sets_inputs:
            lines += [f"{model.input_type} m_inputs = {model.input_type}();"] if model.input_type else []
            lines += [f"{model.output_type} m_outputs = {model.output_type}();"] if model.output_type else []
        return lines + [port.declaration() for port in self.ports]

    def text(self):
        model, target = self.model, self.options.target
        nanoseconds = round(seconds(self.options.period) * 1e9)
        lines = [*header(self.options, model), f'#include "{target}.h"', ""]
        lines += [f"#include <{name}.h>" for name in STANDARD]
        lines += ["#include <optional>", ""]
        include = f'#include "{model.header.name}"'
        lines += ['extern "C" {', include, "}"] if model.is_c else [include]
        if model.form == "globals":
            symbol = f"only_one_node_of_{model.name}_because_its_variables_are_global"
            lines += ["", "// A second node of this model in the same program does not link.", 'extern "C" {']
            lines += [f"extern const int {symbol};", f"const int {symbol} = 1;", "}"]
        lines += ["", "namespace {", "", "template<typename T>", "using Type = std::remove_reference_t<T>;", ""]
        lines += [f"class Node_{target} : public QPlcSimulinkNode", "{", "public:", f"    Node_{target}()"]
        name = f"QStringLiteral({quoted(self.options.node_name or model.name)})"
        lines += [f"        : QPlcSimulinkNode({name}, std::chrono::nanoseconds({nanoseconds}))", "    {"]
        lines += [f"        {line}" for line in self.constructor()] + ["    }"]
        if "terminate" in model.functions:
            lines += [f"    ~Node_{target}() override {{ {self.call('terminate')[0]} }}"]
        lines += ["", "private:"]
        for signature, body in self.functions():
            lines += [f"    {signature}", "    {", *(f"        {line}" for line in body), "    }", ""]
        lines += [f"    {line}" for line in self.members()] + ["};", "", "}  // namespace", ""]
        lines += [f"std::unique_ptr<QPlcSimulinkNode> make_{target}()", "{"]
        return "\n".join([*lines, f"    return std::make_unique<Node_{target}>();", "}", ""])


def header(options, model):
    return [
        f"// Generated by qtplc_add_simulink_node({options.target}) from {model.header.name}. Changes are lost: it is",
        "// written again when the export changes.",
    ]


def write(path, text):
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def cmake_list(name, paths):
    return f"set({name}" + "".join(f"\n    [==[{Path(path).as_posix()}]==]" for path in paths) + ")\n"


def generate(options):
    model = Reader(options).read()
    give_names(model, options.prefix, read_map(options.map) if options.map else [], options.map)
    output = Path(options.output)
    output.mkdir(parents=True, exist_ok=True)
    node = Node(model, options)
    declaration = f"std::unique_ptr<QPlcSimulinkNode> make_{options.target}();"
    first = header(options, model)
    write(
        output / f"{options.target}.h",
        "\n".join([*first, "#pragma once", "", "#include <QtPlcCore>", "", "#include <memory>", ""])
        + f"\n/// Makes a node of the model {model.name}. Each has a state of its own, unless the model has global\n"
        f"/// variables: then one at a time.\n{declaration}\n",
    )
    write(output / f"{options.target}_node.cpp", node.text())
    run = f"return QPlcSimulinkNode::run(argc, argv, make_{options.target});"
    write(
        output / f"{options.target}_main.cpp",
        "\n".join([*first, f'#include "{options.target}.h"', "", "int main(int argc, char **argv)", "{", f"    {run}"])
        + "\n}\n",
    )
    write(
        output / f"{options.target}.cmake",
        cmake_list("sources", model.sources)
        + cmake_list("folders", model.folders)
        + cmake_list("files", [*model.files, *model.sources, *([options.map] if options.map else [])]),
    )
    return model


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("target", "dir", "period", "output"):
        parser.add_argument(f"--{name}", required=True)
    for name in ("node-name", "prefix", "map", "model", "initialize", "step", "terminate", "workload"):
        parser.add_argument(f"--{name}", default="")
    parser.add_argument("--include", action="append", default=[])
    parser.add_argument("--define", action="append", default=[])
    try:
        generate(parser.parse_args())
    except Refusal as refusal:
        sys.exit(str(refusal))


if __name__ == "__main__":
    main()
