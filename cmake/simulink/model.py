# SPDX-License-Identifier: Apache-2.0
"""Finds in an unpacked export what a node needs: the form of the code, inputs, outputs, parameters
and functions. Whatever it cannot use it refuses in one sentence, with the remedy."""
import re
from dataclasses import dataclass, field
from pathlib import Path

from headers import MATLAB_HEADERS, Declarations, Headers, Refusal

PACKAGE = "tick 'Package code and artifacts' in the code generation settings of the model and export it again"
BASIC = re.compile(
    r"(real(32|64)?|u?int(8|16|32|64)?|boolean|char|uchar|byte|ulong|ulonglong|long|longlong|time|pointer)_T$"
    r"|u?int(8|16|32|64|ptr)_t$|((char|short|int|long|signed|unsigned|float|double|bool)\b ?)+$"
)
INPUTS = re.compile(r"(\w+::)*(ExtU|ExternalInputs)(_|$)\w*$")
OUTPUTS = re.compile(r"(\w+::)*(ExtY|ExternalOutputs)(_|$)\w*$")
PARAMETERS = re.compile(r"(\w+::)*(P|Parameters)(_\w*)?$")
# Members of RT_MODEL that the caller of a reusable function provides.
PROVIDED = {"blockIO", "contStates", "defaultParam", "dwork", "inputs", "outputs", "prevZCSigState", "zcSignal"}
MODEL_HEADER = re.compile(r"External inputs \(root inport|External outputs \(root outport|Model entry point functions")
UNSUPPORTED = (
    (re.compile(r"\bRte_\w+\s*\("), "is AUTOSAR code"),
    (re.compile(r"\bssSetNumSFcnParams\b|\bmdlOutputs\b"), "is the code of an S-function"),
)


@dataclass(eq=False)
class Leaf:
    """A port: one number, array or enum of the model."""

    path: str  # wind.speed
    dims: list
    description: str
    is_bool: bool
    enum: list  # (name, number) of its enumerators
    signal: str = ""
    rows: int = 0  # of a matrix, stored column by column
    columns: int = 0


@dataclass
class Model:
    name: str  # LaweModel
    header: Path
    form: str  # globals, reusable, class
    is_c: bool
    functions: dict  # initialize, step, terminate, output, update -> name; no entry: there is none
    arguments: dict  # function -> [(member of the node, by pointer?)]
    owned: list  # (type, member) that a node of the form "reusable" has
    links: list  # (member of RT_MODEL, member of the node)
    inputs: str = ""  # expression of the struct
    outputs: str = ""
    input_type: str = ""
    output_type: str = ""
    ins: list = field(default_factory=list)
    outs: list = field(default_factory=list)
    parameters: list = field(default_factory=list)  # (name, expression)
    rtm: str = ""  # expression of a pointer to RT_MODEL
    has_error: bool = False
    has_stop: bool = False
    has_final_time: bool = False
    class_name: str = ""
    sets_inputs: bool = False  # by setExternalInputs(), and getExternalOutputs()
    sources: list = field(default_factory=list)
    folders: list = field(default_factory=list)
    files: list = field(default_factory=list)  # all that were read


def seconds(text):
    found = re.match(r"\s*(\d+(?:\.\d*)?(?:[eE][-+]?\d+)?)\s*(ns|us|ms|s)\s*$", text)
    if not found or float(found[1]) <= 0.0:
        raise Refusal(f"PERIOD '{text}' is not a duration; write it as in 10ms, 250us, 0.1s")
    time = float(found[1]) * {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}[found[2]]
    if not 0.99999e-5 < time < 10.00001:
        raise Refusal(f"PERIOD '{text}' is out of range; use 10us to 10s")
    return time


class Export:
    """The folder of an unpacked export."""

    def __init__(self, folder, includes):
        self.folder = Path(folder).resolve()
        if not self.folder.is_dir():
            raise Refusal(f"DIR '{folder}' is not a folder; name the folder of the unpacked export")
        extra = [Path(include).resolve() for include in includes]
        for include in extra:
            if not include.is_dir():
                raise Refusal(f"INCLUDE '{include}' is not a folder; name the folder of the headers that are missing")
        builds = [path.parent for path in self.folder.rglob("CMakeCache.txt")]
        files = (path for path in self.folder.rglob("*") if path.is_file())
        self.files = sorted(path for path in files if not any(build in path.parents for build in builds))
        headers = [path for path in self.files if path.suffix in (".h", ".hpp")]
        self.folders = list(dict.fromkeys([self.folder, *(path.parent for path in headers), *extra]))
        self.headers = headers

    def header_of(self, name):
        """The header of the model."""
        candidates = []
        for path in self.headers:
            if path.stem.endswith(("_private", "_types", "_data")) or path.name in ("rtmodel.h", "autobuild.h"):
                continue
            text = path.read_text(encoding="utf-8", errors="replace")
            if path.stem == name or (not name and (MODEL_HEADER.search(text) or re.search(r"\w_step\s*\(", text))):
                candidates.append(path)
        if len(candidates) == 1:
            return candidates[0]
        if candidates:
            names = ", ".join(path.stem for path in candidates)
            raise Refusal(f"'{self.folder}' has several models ({names}); name one of them with MODEL")
        if name:
            raise Refusal(
                f"'{self.folder}' has no header '{name}.h'; name the model with MODEL as its header is called"
            )
        self._refuse_unsupported(self.headers)
        raise Refusal(
            f"no header in '{self.folder}' declares a model; name the folder of the unpacked export of Embedded Coder "
            "or Simulink Coder (targets ert, ert_shrlib, grt)"
        )

    @staticmethod
    def _refuse_unsupported(paths):
        for path in paths:
            text = path.read_text(encoding="utf-8", errors="replace")
            for pattern, what in UNSUPPORTED:
                if pattern.search(text):
                    raise Refusal(
                        f"'{path.name}' {what}; export the model with the system target file ert.tlc or grt.tlc"
                    )

    def sources_of(self, header):
        """What is compiled: all sources but examples of main() and what belongs to MATLAB."""
        sources = []
        for path in self.files:
            if path.suffix not in (".c", ".cpp", ".cc", ".cxx"):
                continue
            text = re.sub(r"/\*.*?\*/|//[^\n]*", "", path.read_text(encoding="utf-8", errors="replace"), flags=re.S)
            is_foreign = re.search(r'\bmain\s*\(|#\s*include\s*["<](mex|simstruc|ext_work)\.h[">]', text)
            is_ours = path.parent == header.parent or "/rtw/c/" not in path.as_posix()
            if is_ours and not is_foreign and not path.name.startswith("rt_logging"):
                sources.append(path)
        return sources


class Reader:
    """Reads one model."""

    def __init__(self, options):
        self.options = options
        self.export = Export(options.dir, options.include)
        self.header = self.export.header_of(options.model)
        self.sources = self.export.sources_of(self.header)
        headers = Headers(self.header, self.export.folders, self.options.define)
        self.files = headers.files
        self.macros = headers.macros
        self._refuse_missing(self._all_missing(headers))
        self.declared = Declarations(headers.tokens)

    # ------------------------------------------------------------ headers

    def _all_missing(self, headers):
        missing = list(headers.missing)
        for source in self.sources:
            if source.parent == self.header.parent:
                for name in Headers(source, self.export.folders, self.options.define).missing:
                    if name not in missing:
                        missing.append(name)
        return missing

    def _refuse_missing(self, missing):
        matlab = [name for name in missing if name in MATLAB_HEADERS]
        if matlab:
            raise Refusal(f"headers of MATLAB are missing in '{self.export.folder}': {', '.join(matlab)}; {PACKAGE}")
        if missing:
            raise Refusal(
                f"headers that the model includes are missing: {', '.join(missing)}; name their folder with INCLUDE"
            )

    # ------------------------------------------------------------ the form

    def read(self):
        classes = [s for s in self.declared.structs.values() if s.is_class and "step" in s.functions]
        names = {"initialize": self.options.initialize, "step": self.options.step, "terminate": self.options.terminate}
        if classes:
            model = self._class_model(classes[0])
        else:
            model = self._function_model(names)
        model.sources, model.folders, model.files = self.sources, self.export.folders, self.files
        model.has_final_time = bool(model.rtm) and "rtmGetTFinal" in self.macros
        model.has_error = bool(model.rtm) and "->" in self.macros.get("rtmGetErrorStatus", "")
        model.has_stop = bool(model.rtm) and "->" in self.macros.get("rtmGetStopRequested", "")
        model.ins = self._leaves(model.input_type)
        model.outs = self._leaves(model.output_type)
        if not model.ins and not model.outs:
            raise Refusal(
                f"'{self.header.name}' declares no inputs and outputs (structs ExtU and ExtY); give the model root "
                "inports and outports, and leave their storage class at 'Auto'"
            )
        self._check_period()
        return model

    def _function_model(self, names):
        functions = self._functions(names)
        step = functions.get("step") or functions["output"]
        name = re.sub(r"_(step|output)$", "", step)
        arguments = {f: self.declared.functions[n] for f, n in functions.items()}
        is_reusable = any(arguments.values())
        model = Model(
            name, self.header, "reusable" if is_reusable else "globals", self._is_c(step), functions, {}, [], []
        )
        if is_reusable:
            self._provide(model, arguments)
        else:
            self._find_globals(model)
        return model

    def _functions(self, given):
        known = self.declared.functions
        for role, name in given.items():
            if name and name not in known:
                raise Refusal(
                    f"'{self.header.name}' has no function '{name}'; name one of its functions with {role.upper()}: "
                    + ", ".join(sorted(known))
                )
        own = self.header.read_text(encoding="utf-8", errors="replace")  # and not what it includes
        steps = [name for name in known if name.endswith("_step") and re.search(rf"\b{name}\s*\(", own)]
        several = sorted(name for name in known if re.search(r"_step\d+$", name))
        if several:
            raise self._two_rates(", ".join(several))
        functions = {role: name for role, name in given.items() if name}
        if "step" not in functions:
            outputs = [n for n in known if n.endswith("_output") and n[:-7] + "_update" in known]
            if len(steps) == 1:
                functions["step"] = steps[0]
            elif len(outputs) == 1:
                functions["output"], functions["update"] = outputs[0], outputs[0][:-7] + "_update"
            else:
                self._refuse_form(steps)
        self._refuse_tasks(functions)
        base = re.sub(r"_(step|output)$", "", functions.get("step") or functions["output"])
        for role in ("initialize", "terminate"):
            if role not in functions and f"{base}_{role}" in known:
                functions[role] = f"{base}_{role}"
        if "initialize" not in functions:
            raise Refusal(
                f"'{self.header.name}' has no function '{base}_initialize'; name the function that initializes the "
                "model with INITIALIZE, one of: " + ", ".join(sorted(known))
            )
        return functions

    def _two_rates(self, which):
        return Refusal(
            f"'{self.header.name}' has several rates ({which}); give all blocks of the model one sample time, or "
            "untick 'Treat each discrete rate as a separate task' in the solver settings, and export it again"
        )

    def _refuse_tasks(self, functions):
        for role in ("step", "output"):
            arguments = self.declared.functions.get(functions.get(role, ""), [])
            if any(argument[-1].lower() == "tid" for argument in arguments):
                raise self._two_rates(f"{functions[role]} takes the number of a task")

    def _refuse_form(self, steps):
        Export._refuse_unsupported([self.header, *self.sources])
        if len(steps) > 1:
            raise Refusal(
                f"'{self.header.name}' has several step functions ({', '.join(steps)}); name one of them with STEP"
            )
        functions = ", ".join(sorted(self.declared.functions)) or "none"
        raise Refusal(
            f"'{self.header.name}' has no function that computes a step; name it with STEP if it has a name of its own "
            f"(functions: {functions}), or export the model with the system target file ert.tlc or grt.tlc"
        )

    def _is_c(self, function):
        for source in self.sources:
            text = source.read_text(encoding="utf-8", errors="replace")
            if re.search(rf"\b{function}\s*\([^;{{]*\)\s*{{", text):
                return source.suffix == ".c"
        return True

    def _find_globals(self, model):
        for variable in self.declared.variables:
            if INPUTS.match(variable.type) and not variable.is_pointer:
                model.inputs, model.input_type = variable.name, variable.type
            elif OUTPUTS.match(variable.type) and not variable.is_pointer:
                model.outputs, model.output_type = variable.name, variable.type
            elif variable.type.startswith("RT_MODEL") and variable.is_pointer:
                model.rtm = variable.name
            elif PARAMETERS.match(variable.type) and not variable.is_const and not variable.is_pointer:
                self._add_parameters(model, variable.type, variable.name)

    def _provide(self, model, arguments):
        """The structs that a node of this form has, and how they reach the functions."""
        rtm_type = ""
        for role, list_of_arguments in arguments.items():
            model.arguments[role] = []
            for words in list_of_arguments:
                type_name = " ".join(w for w in words[:-1] if w not in ("*", "const", "struct", "volatile"))
                if "*" not in words or "[" in words or not self._struct_of(type_name):
                    call = f"{model.functions[role]}({' '.join(words)}, ...)"
                    raise Refusal(
                        f"{call} takes single values; set 'Pass root-level I/O as' to 'Part of model data structure' "
                        "in the settings of the code interface, and export the model again"
                    )
                if type_name.startswith("RT_MODEL"):
                    rtm_type = type_name
                model.arguments[role].append(self._own(model, type_name))
        rtm = self._struct_of(rtm_type) if rtm_type else None
        if rtm_type:
            model.rtm = f"&{self._own(model, rtm_type)}"
        for member in rtm.members if rtm else []:
            if member.name in PROVIDED and member.is_pointer and self._struct_of(member.type):
                model.links.append((member.name, self._own(model, member.type), member.type))
        for variable in self.declared.variables:
            if PARAMETERS.match(variable.type) and not variable.is_const and not variable.is_pointer:
                self._add_parameters(model, variable.type, variable.name)

    def _own(self, model, type_name):
        for known, member in model.owned:
            if known == type_name:
                return member
        kinds = (("RT_MODEL", "m_model"), ("DW", "m_states"), ("D_Work", "m_states"), ("PrevZC", "m_zeroCrossings"))
        member = next((m for start, m in kinds if type_name.startswith(start)), f"m_{type_name}")
        if INPUTS.match(type_name):
            member, model.inputs, model.input_type = "m_inputs", "m_inputs", type_name
        elif OUTPUTS.match(type_name):
            member, model.outputs, model.output_type = "m_outputs", "m_outputs", type_name
        model.owned.append((type_name, member))
        if PARAMETERS.match(type_name):
            self._add_parameters(model, type_name, member)
        return member

    def _class_model(self, struct):
        functions = {role: role for role in ("initialize", "step", "terminate") if role in struct.functions}
        if struct.functions["step"]:
            raise self._two_rates(f"{struct.name}::step takes an argument")
        if "initialize" not in functions:
            raise Refusal(f"class '{struct.name}' has no function initialize(); {PACKAGE}")
        name = re.sub(r"ModelClass$", "", struct.name.split("::")[-1])
        model = Model(name, self.header, "class", False, functions, {}, [], [], class_name=struct.name)
        for member in struct.members:
            self._class_member(model, member)
        if not model.inputs and not model.outputs:
            self._accessors(model, struct)
        if "getRTM" in struct.functions:
            model.rtm = "m_model->getRTM()"
        return model

    def _class_member(self, model, member):
        if not member.is_public or member.is_pointer:
            return
        if INPUTS.match(member.type):
            model.inputs, model.input_type = f"m_model->{member.name}", member.type
        elif OUTPUTS.match(member.type):
            model.outputs, model.output_type = f"m_model->{member.name}", member.type
        elif PARAMETERS.match(member.type) and not member.is_const:
            self._add_parameters(model, member.type, f"m_model->{member.name}")

    def _accessors(self, model, struct):
        """Newer releases keep inputs and outputs private, behind two functions."""
        if "setExternalInputs" in struct.functions or "getExternalOutputs" in struct.functions:
            for member in struct.members:
                if INPUTS.match(member.type):
                    model.inputs, model.input_type = "m_inputs", self._full_name(struct, member.type)
                elif OUTPUTS.match(member.type):
                    model.outputs, model.output_type = "m_outputs", self._full_name(struct, member.type)
            model.sets_inputs = True

    def _full_name(self, struct, type_name):
        return f"{struct.name}::{type_name}" if f"{struct.name}::{type_name}" in self.declared.structs else type_name

    # ------------------------------------------------------------ inputs, outputs, parameters

    def _resolved(self, type_name):
        """The name behind typedefs."""
        for _ in range(20):
            if type_name in self.declared.structs or type_name == "boolean_T" or type_name not in self.declared.aliases:
                return type_name
            type_name = self.declared.aliases[type_name]
        return type_name

    def _struct_of(self, type_name):
        name = self._resolved(type_name)
        found = self.declared.structs.get(name)
        if found:
            return found
        matching = [s for n, s in self.declared.structs.items() if n.split("::")[-1] == name.split("::")[-1]]
        return matching[0] if matching else None

    def _leaves(self, type_name, path="", description=""):
        struct = self._struct_of(type_name) if type_name else None
        leaves = []
        for member in struct.members if struct else []:
            here = f"{path}.{member.name}" if path else member.name
            leaves += self._leaves_of(member, here, member.comment or description)
        return leaves

    def _leaves_of(self, member, path, description):
        if member.is_pointer or member.is_bit_field:
            what = "a pointer" if member.is_pointer else "a bit field"
            raise Refusal(f"'{path}' in '{self.header.name}' is {what}; give this port of the model the storage 'Auto'")
        inner = member.struct or self._struct_of(member.type)
        if inner:
            name = inner.name
            self.declared.structs.setdefault(name, inner)
            leaves = []
            for index in indices([self._number(dim, path) for dim in member.dims]):
                leaves += self._leaves(name, path + index, description)
            return leaves
        resolved = self._resolved(member.type)
        enum = self.declared.enums.get(resolved)
        if not enum and not BASIC.match(resolved):
            raise Refusal(
                f"the type '{member.type}' of '{path}' is declared in no header that '{self.header.name}' includes; "
                "name the folder of its header with INCLUDE"
            )
        dims = [self._number(dim, path) for dim in member.dims]
        is_bool = resolved in ("boolean_T", "bool")
        return [Leaf(path, dims, description, is_bool, enum.values if enum else [])]

    def _number(self, dim, path):
        text = self.macros.get(dim, dim).strip("()uUlL ")
        if not text.isdigit():
            raise Refusal(f"the size [{dim}] of '{path}' is not a number; export the model with fixed sizes")
        return int(text)

    def _add_parameters(self, model, type_name, expression):
        struct = self._struct_of(type_name)
        for member in struct.members if struct else []:
            self._add_parameter(model, member, member.name, f"{expression}.{member.name}")

    def _add_parameter(self, model, member, name, expression):
        inner = member.struct or self._struct_of(member.type)
        if member.is_pointer or member.is_bit_field or (inner and member.dims):
            return
        for part in inner.members if inner else []:
            self._add_parameter(model, part, f"{name}.{part.name}", f"{expression}.{part.name}")
        if not inner:
            model.parameters.append((name, expression))

    # ------------------------------------------------------------ the period

    def _check_period(self):
        period = seconds(self.options.period)
        for source in self.sources:
            text = source.read_text(encoding="utf-8", errors="replace")
            found = re.search(r"\bstepSize0?\s*=\s*\(?\s*([0-9.]+(?:[eE][-+]?\d+)?)", text)
            if found and source.parent == self.header.parent and abs(float(found[1]) - period) > 1e-9 * period:
                raise Refusal(
                    f"PERIOD is {self.options.period}, and the model has the sample time {found[1]} s "
                    f"({source.name}); write PERIOD {duration(float(found[1]))}, or export the model with another "
                    "fixed step"
                )


def duration(value):
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9)):
        number = value / size
        if abs(number - round(number)) < 1e-6 * number and round(number) >= 1:
            return f"{round(number)}{unit}"
    return f"{value}s"


def indices(dims):
    """[2, 2] -> .0.0, .0.1, .1.0, .1.1 as C++: [0][0], ..."""
    texts = [""]
    for dim in dims:
        texts = [text + f"[{i}]" for text in texts for i in range(dim)]
    return texts
