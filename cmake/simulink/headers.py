# SPDX-License-Identifier: Apache-2.0
"""Reads what C and C++ headers of Simulink declare: structs, enums, variables, functions. Names
only: the compiler knows the types."""
import re
from dataclasses import dataclass, field

MATLAB_HEADERS = {
    "rtwtypes.h",
    "rtw_continuous.h",
    "rtw_solver.h",
    "rtw_logging.h",
    "rtw_extmode.h",
    "rt_logging.h",
    "rt_nonfinite.h",
    "rtGetInf.h",
    "rtGetNaN.h",
    "simstruc.h",
    "simstruc_types.h",
    "sysran_types.h",
    "multiword_types.h",
    "tmwtypes.h",
    "builtin_typeid_types.h",
    "zero_crossing_types.h",
}
STANDARD_HEADERS = set(
    "assert ctype errno fenv float inttypes limits locale math setjmp signal stdarg stdbool stddef stdint stdio "
    "stdlib string time wchar".split()
)
QUALIFIERS = {"const", "volatile", "extern", "static", "struct", "enum", "union", "class", "mutable", "typename"}


class Refusal(Exception):
    """One sentence: what is wrong, and the remedy."""


@dataclass
class Member:
    type: str
    name: str
    dims: list = field(default_factory=list)  # texts: "3"
    is_pointer: bool = False
    is_bit_field: bool = False
    comment: str = ""
    struct: "Struct" = None  # of an unnamed one
    is_public: bool = True
    is_const: bool = False


@dataclass
class Struct:
    name: str
    members: list
    functions: dict = field(default_factory=dict)  # of a class: name -> arguments
    is_class: bool = False


@dataclass
class Enum:
    name: str
    values: list  # (name, number), empty when they are not plain


TOKEN = re.compile(
    r"""(?P<comment>/\*.*?\*/|//[^\n]*)|(?P<string>"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')"""
    r"""|(?P<word>[A-Za-z_]\w*)|(?P<number>\d[\w.]*)|(?P<newline>\n)|(?P<space>[^\S\n]+)|(?P<sign>::|.)""",
    re.S,
)


@dataclass
class Token:
    kind: str
    text: str
    line: int


class Headers:
    """One header with all that it includes, as tokens in the order of the compiler."""

    def __init__(self, path, folders, definitions=()):
        self.folders = folders
        self.macros = {"__cplusplus": "201703L"}
        for definition in definitions:  # "NAME" or "NAME=1"
            name, _, value = definition.partition("=")
            self.macros[name] = value or "1"
        self.missing, self.files, self.tokens = [], [], []
        self._line = 0
        self._expand(path)

    def _expand(self, path):
        if path in self.files:
            return
        self.files.append(path)
        text = path.read_text(encoding="utf-8", errors="replace").replace("\r\n", "\n").replace("\\\n", " ")
        # A comment is on one line, so that each line that begins with # is a directive.
        text = re.sub(r"/\*.*?\*/", lambda found: found.group().replace("\n", " "), text, flags=re.S)
        stack = []  # of [is it so (None: unknown), was one branch of it taken]
        for line in text.split("\n"):
            self._line += 1
            directive = re.match(r"\s*#\s*(\w+)\s*(.*)", line)
            if directive:
                self._direct(directive[1], re.sub(r"/\*.*?\*/|//.*", "", directive[2]).strip(), path, stack)
            elif all(state[0] is not False for state in stack):
                self._take(line)

    def _take(self, line):
        for found in TOKEN.finditer(line):
            kind = found.lastgroup
            if kind not in ("space", "newline"):
                self.tokens.append(Token(kind, found.group(), self._line))

    def _direct(self, word, rest, path, stack):
        if word in ("if", "ifdef", "ifndef"):
            state = self._holds(rest) if word == "if" else (rest.split()[0] in self.macros) == (word == "ifdef")
            stack.append([state, state is True])
        elif word in ("elif", "else") and stack:
            top = stack[-1]
            state = False if top[1] else True if word == "else" else self._holds(rest)
            if word == "else" and top[0] is None:
                state = None
            stack[-1] = [state, top[1] or state is True]
        elif word == "endif" and stack:
            stack.pop()
        elif any(state[0] is False for state in stack):
            return
        elif word == "define":
            found = re.match(r"(\w+)(\([^)]*\))?\s*(.*)", rest)
            if found:
                self.macros[found[1]] = found[3]
        elif word == "undef":
            self.macros.pop(rest, None)
        elif word == "include":
            self._include(rest, path, all(state[0] is True for state in stack))

    def _holds(self, condition):
        """None: cannot be said."""
        condition = re.sub(
            r"defined\s*\(?\s*(\w+)\s*\)?", lambda found: "1" if found[1] in self.macros else "0", condition
        )
        numbers = {name: value for name, value in self.macros.items() if value.isdigit()}
        condition = re.sub(r"[A-Za-z_]\w*", lambda found: numbers.get(found[0], found[0]), condition)
        condition = condition.replace("&&", " and ").replace("||", " or ")
        condition = re.sub(r"!(?!=)", " not ", condition)
        if re.search(r"[A-Za-z_]", re.sub(r"\b(and|or|not)\b", "", condition)) or not condition.strip():
            return None
        try:
            return bool(eval(condition, {"__builtins__": {}}))  # only digits and operators are left
        except Exception:
            return None

    def _include(self, rest, path, is_certain):
        found = re.match(r'(["<])([^">]+)[">]', rest)
        if not found:
            return
        name = found[2]
        for folder in [path.parent, *self.folders]:
            if (folder / name).is_file():
                self._expand((folder / name).resolve())
                return
        base = name.split("/")[-1]
        is_standard = base.endswith(".h") and base[:-2] in STANDARD_HEADERS
        if found[1] == '"' and is_certain and not is_standard and name not in self.missing:
            self.missing.append(name)


class Declarations:
    """What the tokens declare: structs, enums, types, variables, functions."""

    def __init__(self, tokens):
        self.structs, self.enums, self.aliases = {}, {}, {}
        self.variables, self.functions = [], {}
        self._tokens, self._at = tokens, 0
        self._scopes = []  # names of namespaces; "" for extern "C"
        self._read_all()

    def _peek(self, ahead=0):
        index = self._at + ahead
        return self._tokens[index] if index < len(self._tokens) else None

    def _read_all(self):
        while self._peek():
            text = self._peek().text
            if self._peek().kind == "comment" or text == ";":
                self._at += 1
            elif text == "}":
                self._at += 1
                if self._scopes:
                    self._scopes.pop()
            elif text == "extern" and self._peek(2) and self._peek(2).text == "{":
                self._at += 3
                self._scopes.append("")
            elif text == "namespace":
                start = self._at
                while self._peek() and self._peek().text not in ("{", ";"):
                    self._at += 1
                self._scopes.append("".join(token.text for token in self._tokens[start + 1 : self._at]))
                self._at += 1
            else:
                tokens, comment = self._declaration()
                self._classify(tokens, comment)

    def _scope(self):
        return "".join(scope + "::" for scope in self._scopes if scope)

    def _declaration(self):
        """The tokens up to the next ; outside of braces, or to the end of a function."""
        tokens, depth = [], 0
        while self._peek():
            token = self._peek()
            self._at += 1
            if token.kind == "comment":
                continue_inside = depth > 0
                if continue_inside:
                    tokens.append(token)
                continue
            tokens.append(token)
            if token.text == "{":
                depth += 1
            elif token.text == "}":
                depth -= 1
                before = [t.text for t in tokens if t.kind != "comment"]
                if depth < 0:  # the end of a scope
                    tokens.pop()
                    self._at -= 1
                    return tokens, ""
                if depth == 0 and is_function_body(before):
                    return tokens, ""
            elif token.text == ";" and depth == 0:
                following = self._peek()
                comment = ""
                if following and following.kind == "comment" and following.line == token.line:
                    comment = following.text
                    self._at += 1
                return tokens[:-1], comment
        return tokens, ""

    def _classify(self, tokens, comment):
        words = [token.text for token in tokens if token.kind != "comment"]
        if not words or words[0] in ("template", "using", "friend"):
            return
        if words[0] == "typedef":
            self._type_definition(tokens, words)
        elif "{" in words and words[0] in ("struct", "class", "enum", "union"):
            self._named_body(tokens, words)
        elif "(" in words and "{" not in words[: words.index("(")]:
            name, arguments = function_of(words)
            if name:
                self.functions[name] = arguments
        elif "{" not in words:
            member = member_of(words, comment)
            if member:
                self.variables.append(member)

    def _type_definition(self, tokens, words):
        if "{" not in words:
            if "(" not in words and len(words) >= 3:
                self.aliases[words[-1]] = plain_type(words[1:-1]) + ("*" if "*" in words else "")
            return
        opening, closing = braces(tokens)
        names = [token.text for token in tokens[closing + 1 :] if token.kind == "word"]
        tags = [token.text for token in tokens[1:opening] if token.kind == "word" and token.text not in QUALIFIERS]
        for name in names[:1] + tags[:1]:
            self._add_body(words[1], self._scope() + name, tokens[opening + 1 : closing])

    def _named_body(self, tokens, words):
        opening, _ = braces(tokens)
        names = [token.text for token in tokens[1:opening] if token.kind == "word"]
        names = [name for name in names if name not in ("class", "struct", "final")]
        if names:
            closing = braces(tokens)[1]
            self._add_body(words[0], self._scope() + names[0], tokens[opening + 1 : closing])

    def _add_body(self, kind, name, body):
        if kind == "enum":
            self.enums[name] = Enum(name, enumerators(body))
        else:
            self.structs[name] = self._struct(name, body, kind == "class")

    def _struct(self, name, body, is_class):
        struct = Struct(name, [], {}, is_class)
        inner = Declarations.__new__(Declarations)
        inner.structs, inner.enums, inner.aliases, inner.functions = self.structs, self.enums, self.aliases, {}
        inner.variables, inner._scopes, inner._tokens, inner._at = [], [name], body, 0
        is_public = not is_class
        while inner._peek():
            token = inner._peek()
            if token.text in ("public", "private", "protected") and inner._peek(1) and inner._peek(1).text == ":":
                is_public = token.text == "public"
                inner._at += 2
                continue
            if token.kind == "comment" or token.text in (";", "}"):
                inner._at += 1
                continue
            tokens, comment = inner._declaration()
            self._add_member(struct, inner, tokens, comment, is_public)
        return struct

    def _add_member(self, struct, inner, tokens, comment, is_public):
        words = [token.text for token in tokens if token.kind != "comment"]
        if not words:
            return
        if words[0] in ("struct", "union") and "{" in words:
            opening, closing = braces(tokens)
            rest = [token.text for token in tokens[closing + 1 :] if token.kind != "comment"]
            tag = [t.text for t in tokens[1:opening] if t.kind == "word"]
            body = self._struct(struct.name + "::" + (tag or rest or [""])[0], tokens[opening + 1 : closing], False)
            if tag:
                self.structs[body.name] = body
            if rest:
                member = member_of([struct.name + "::" + rest[0], *rest], comment)
                member.struct, member.is_public = body, is_public
                struct.members.append(member)
        elif words[0] in ("enum", "class", "typedef"):
            inner._classify(tokens, comment)
        elif "(" in words:
            name, arguments = function_of(words)
            if name and is_public:
                struct.functions[name] = arguments
        else:
            for part in comma_parts(words):
                member = member_of(part, comment)
                if member:
                    member.is_public = is_public
                    struct.members.append(member)


def is_function_body(words):
    opening = len(words) - 1
    depth = 0
    for index in range(len(words) - 1, -1, -1):
        depth += {"}": 1, "{": -1}.get(words[index], 0)
        if depth == 0:
            opening = index
            break
    before = words[:opening]
    while before and before[-1] in ("const", "noexcept", "override", "final"):
        before.pop()
    return bool(before) and before[-1] == ")"


def braces(tokens):
    depth, opening = 0, None
    for index, token in enumerate(tokens):
        if token.text == "{":
            opening = index if opening is None else opening
            depth += 1
        elif token.text == "}":
            depth -= 1
            if depth == 0:
                return opening, index
    raise Refusal("a header ends inside of braces; unpack the export again")


def plain_type(words):
    return " ".join(word for word in words if word not in QUALIFIERS and word not in ("*", "&")).replace(" :: ", "::")


def member_of(words, comment):
    """None when the words declare no variable."""
    is_bit_field = ":" in words
    if is_bit_field:
        words = words[: words.index(":")]
    if "=" in words:
        words = words[: words.index("=")]
    dims = []
    while words and words[-1] == "]":
        opening = len(words) - 1 - words[::-1].index("[")
        dims.insert(0, "".join(words[opening + 1 : -1]))
        words = words[:opening]
    if len(words) < 2 or not re.match(r"[A-Za-z_]\w*$", words[-1]):
        return None
    return Member(
        plain_type(words[:-1]), words[-1], dims, "*" in words, is_bit_field, text_of(comment), is_const="const" in words
    )


def comma_parts(words):
    """`real_T a, b[2]` as two declarations."""
    parts, depth, start = [], 0, 0
    for index, word in enumerate(words):
        depth += {"[": 1, "<": 1, "]": -1, ">": -1}.get(word, 0)
        if word == "," and depth == 0:
            parts.append(words[start:index])
            start = index + 1
    parts.append(words[start:])
    first = parts[0]
    end = first.index("[") if "[" in first else len(first)
    return [first] + [first[: end - 1] + part for part in parts[1:]]


def function_of(words):
    opening = words.index("(")
    name = words[opening - 1] if opening > 0 else ""
    if not re.match(r"[A-Za-z_]\w*$", name) or (opening > 1 and words[opening - 2] == "~"):
        return None, []
    depth, arguments, start = 0, [], opening + 1
    for index in range(opening, len(words)):
        depth += {"(": 1, ")": -1}.get(words[index], 0)
        if (words[index] == "," and depth == 1) or depth == 0:
            arguments.append(words[start:index])
            start = index + 1
        if depth == 0:
            break
    return name, [argument for argument in arguments if argument and argument != ["void"]]


def enumerators(body):
    values, following = [], 0
    for part in " ".join(token.text for token in body if token.kind != "comment").split(","):
        found = re.match(r"\s*(\w+)\s*(?:=\s*(-?)\s*(\d+)\s*)?$", part)
        if not found:
            if part.strip():
                return []
            continue
        number = int(found[2] + found[3]) if found[3] else following
        values.append((found[1], number))
        following = number + 1
    return values


def text_of(comment):
    """The path of a block, without what points to the root: "'<Root>/wind'" is "wind"."""
    text = re.sub(r"^/\*|\*/$|^//", "", comment).strip()
    text = re.sub(r"\s+", " ", text)
    found = re.match(r"'<Root>/([^']*)'$", text)
    return (found[1] if found else text).strip()
