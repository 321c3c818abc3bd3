#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Finds the places of C++ sources that a mutant changes, and writes all changes into one text.
docs/design/mutation.md says which changes there are. Used by mutate.py."""
import hashlib
import re
from dataclasses import dataclass

COMPARISONS = {"==": "!=", "!=": "==", "<": "<=", "<=": "<", ">": ">=", ">=": ">"}

HEADER = """#pragma once
#ifdef __cplusplus
#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>
namespace qplc_mutant {
struct Choice
{
    Choice() noexcept
    {
        if (const char *number = std::getenv("QTPLC_MUTANT"))
            chosen = std::atoi(number);
        const char *file = std::getenv("QTPLC_MUTANT_REACHED");
        const int descriptor = file ? ::open(file, O_RDWR | O_CLOEXEC) : -1;
        if (descriptor < 0)
            return;
        void *memory = ::mmap(nullptr, @SIZE@, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
        reached = memory == MAP_FAILED ? nullptr : static_cast<volatile char *>(memory);
        ::close(descriptor);
    }
    int chosen = 0;
    volatile char *reached = nullptr;
};
inline bool on(int number) noexcept
{
    static const Choice choice;
    if (choice.reached)
        choice.reached[number] = 1;
    return choice.chosen == number;
}
inline int sign(int number) noexcept { return on(number) ? -1 : 1; }
}
#endif
"""


@dataclass
class Site:
    file: str
    line: int
    kind: str
    original: str
    mutation: str
    start: int
    end: int
    before: str  # what is put in front; @ is the number
    after: str
    last: int = 0  # line
    number: int = 0
    identity: str = ""  # the same in later versions of the file, wherever the line is


def masked(text):
    """The text with blanks in the place of comments, texts, characters and lines of the
    preprocessor."""
    pattern = (
        r'//[^\n]*|/\*.*?\*/|R"\(.*?\)"|"(?:\\.|[^"\\\n])*"'
        r"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\'|^[ \t]*#(?:\\\n|[^\n])*"
    )
    blank = lambda match: re.sub(r"[^\n]", " " if match.group()[0] in "/# \t" else "_", match.group())
    return re.sub(pattern, blank, text, flags=re.S | re.M)


def closing(text, begin):
    """Where the bracket at begin is closed."""
    depth = 0
    for i in range(begin, len(text)):
        depth += (text[i] in "([{") - (text[i] in ")]}")
        if depth == 0:
            return i
    return len(text)


def statement_end(text, begin):
    """The semicolon that ends the statement."""
    i = begin
    while i < len(text) and text[i] != ";":
        if text[i] in ")]}":
            return -1
        i = closing(text, i) + 1 if text[i] in "([{" else i + 1
    return i


def top_level(text, start, end, operators):
    """Places of operators outside of brackets; all have blanks around them, as the format of the
    code wants it."""
    found, i = [], start
    while i < end:
        if text[i] in "([{":
            i = closing(text, i) + 1
            continue
        for operator in operators:
            if (
                text.startswith(operator, i)
                and text[i - 1].isspace()
                and text[i + len(operator) : i + len(operator) + 1].isspace()
            ):
                found.append((i, operator))
        i += 1
    return found


def trimmed(text, start, end):
    while start < end and text[start].isspace():
        start += 1
    while end > start and text[end - 1].isspace():
        end -= 1
    return start, end


class Finder:
    def __init__(self, name, text):
        self.name, self.text, self.code, self.sites = name, text, masked(text), []

    def add(self, kind, start, end, before, after, mutation):
        original = " ".join(self.text[start:end].split())
        line, last = (self.text.count("\n", 0, place) + 1 for place in (start, end))
        self.sites.append(Site(self.name, line, kind, original, mutation, start, end, before, after, last))

    def find(self):
        for match in re.finditer(r"\b(if|while) \(", self.code):
            begin = match.end()
            self.condition(begin, closing(self.code, begin - 1), True)
        for match in re.finditer(r"\bfor \(", self.code):
            end = closing(self.code, match.end() - 1)
            parts = top_level_semicolons(self.code, match.end(), end)
            if len(parts) == 2:
                self.condition(parts[0] + 1, parts[1], False)
        for match in re.finditer(r"\breturn\b", self.code):
            end = statement_end(self.code, match.end())
            start, end = trimmed(self.code, match.end(), end)
            value = self.code[start:end]
            if value in ("true", "false"):
                self.add(
                    "return",
                    start,
                    end,
                    "(qplc_mutant::on(@) != ",
                    ")",
                    "return " + ("false" if value == "true" else "true"),
                )
            elif end > start:
                self.condition(start, end, False)
        for match in re.finditer(r"(?<=[\w)\]]) ([+-]) (?=[\w(])", self.code):
            sign = match.group(1)
            start = match.end()
            end = re.match(r"[\w.:>-]*", self.code[start:]).end() + start
            self.add(
                "arithmetic",
                start,
                max(end, start + 1),
                "qplc_mutant::sign(@) * ",
                "",
                f"{'-' if sign == '+' else '+'} instead of {sign}",
            )
        for match in re.finditer(
            r"^ {4,}((?:Q_EMIT )?[A-Za-z_][\w.:]*(?:(?:->|\.)\w+|\(\)|\[\w+\])*)\(", self.code, re.M
        ):
            self.call(match)
        return [site for site in self.sites if not self.is_constant(site.start)]

    def call(self, match):
        start, end = match.start(1), statement_end(self.code, match.start(1))
        earlier = self.code[:start].rstrip()
        name = match.group(1)
        if end < 0 or not earlier.endswith((";", "{", "}", ")", "else", ":")) or self.code[end - 1] != ")":
            return
        if re.match(
            r"(if|for|while|switch|return|sizeof|static_assert|Q_UNUSED|Q_ASSERT\w*|assert|catch|__asm__)$", name
        ):
            return
        self.add("call", start, end + 1, "{ if (!qplc_mutant::on(@)) { ", " } }", "left out")

    def condition(self, start, end, is_whole):
        start, end = trimmed(self.code, start, end)
        part = self.code[start:end]
        if (
            end <= start
            or ";" in part
            or "?" in part
            or "[" in part
            and "{" in part
            or top_level(self.code, start, end, ("=",))
            or part.startswith("const ")
        ):
            return
        terms = []
        for first, last, _ in split(self.code, start, end, "||"):
            terms += split(
                self.code, first, last, "&&", outer="||" if len(split(self.code, start, end, "||")) > 1 else ""
            )
        if is_whole:
            self.add("condition", start, end, "qplc_mutant::on(@) != bool(", ")", "negated")
        for first, last, chain in terms:
            first, last = trimmed(self.code, first, last)
            if chain == "&&":
                self.add("operand", first, last, "(qplc_mutant::on(@) || (", "))", "left out of &&")
            elif chain == "||":
                self.add("operand", first, last, "(!qplc_mutant::on(@) && (", "))", "left out of ||")
            self.comparison(first, last)

    def comparison(self, start, end):
        found = top_level(self.code, start, end, COMPARISONS)
        others = top_level(self.code, start, end, ("<<", ">>", "&", "|", "^"))
        if len(found) != 1 or others or "//" in self.text[start:end]:
            return
        place, operator = found[0]
        other = COMPARISONS[operator]
        changed = " ".join((self.text[start:place] + other + self.text[place + len(operator) : end]).split())
        self.add("comparison", start, end, f"(qplc_mutant::on(@) ? ({changed}) : (", "))", changed)

    def is_constant(self, place):
        """Whether a statement must be known to the compiler."""
        begin = max(self.code.rfind(mark, 0, place) for mark in ";{}")
        statement = re.sub(r"\b(case\b[^;]*?[^:]|default):(?!:)", "", self.code[begin + 1 : place])  # behind a label
        return bool(re.search(r"\b(constexpr|static_assert|case|enum|template|noexcept ?\(|using)\b", statement))


def top_level_semicolons(text, start, end):
    found, i = [], start
    while i < end:
        if text[i] in "([{":
            i = closing(text, i)
        elif text[i] == ";":
            found.append(i)
        i += 1
    return found


def split(text, start, end, operator, outer=""):
    """Operands of a chain: first, last, operator of the chain that they are in."""
    places = [place for place, _ in top_level(text, start, end, (operator,))]
    borders = [start] + [place + 2 for place in places]
    ends = places + [end]
    return [(first, last, operator if places else outer) for first, last in zip(borders, ends)]


def find_sites(root, names):
    sites = []
    for name in names:
        sites += Finder(name, (root / name).read_text()).find()
    known = {}
    for number, site in enumerate(sites, 1):
        what = f"{site.file} {site.kind}: {site.original} -> {site.mutation}"
        known[what] = known.get(what, 0) + 1
        site.number, site.identity = number, f"{what} #{known[what]}"
    return sites


def drawn(sites, seed, count):
    """As many of them as that. A change somewhere else in the sources draws the same ones."""
    return sorted(sites, key=lambda site: hashlib.sha256(f"{seed} {site.identity}".encode()).digest())[:count]


def mutated(text, sites):
    """The text with all sites in it; it has as many lines as before."""
    inserts = []
    for order, site in enumerate(sorted(sites, key=lambda s: (s.start, -s.end, s.number))):
        number = str(site.number)
        inserts.append((site.start, 1, order, site.before.replace("@", number)))
        inserts.append((site.end, 0, -order, site.after.replace("@", number)))
    result, last = [], 0
    for place, _, _, insert in sorted(inserts):
        result += [text[last:place], insert]
        last = place
    return "".join(result) + text[last:]


def header(sites):
    return HEADER.replace("@SIZE@", str(len(sites) + 1))
