#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Changes the sources of the core at many places, each chosen at run time, and looks which changes no test notices.
docs/design/mutation.md says how. Called by scripts/mutate."""
import argparse
import hashlib
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

ROOMS = ("protocol", "transport", "node")
COMPARISONS = {"==": "!=", "!=": "==", "<": "<=", "<=": "<", ">": ">=", ">=": ">"}
FLAGS = "-O1 -DNDEBUG"
MOST_REPAIRS = 12  # builds in which sites that do not compile are left out
LONGEST_ADDED = 10.0  # [s] given to a test beside five times its own duration

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


def masked(text):
    """The text with blanks in the place of comments, texts, characters and lines of the preprocessor."""
    pattern = r'//[^\n]*|/\*.*?\*/|R"\(.*?\)"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\'|^[ \t]*#(?:\\\n|[^\n])*'
    blank = lambda match: re.sub(r"[^\n]", " ", match.group()) if match.group()[0] in "/# \t" else re.sub(r"[^\n]", "_", match.group())
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
    """Places of operators outside of brackets; all have blanks around them, as the format of the code wants it."""
    found, i = [], start
    while i < end:
        if text[i] in "([{":
            i = closing(text, i) + 1
            continue
        for operator in operators:
            if text.startswith(operator, i) and text[i - 1].isspace() and text[i + len(operator):i + len(operator) + 1].isspace():
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
                self.add("return", start, end, "(qplc_mutant::on(@) != ", ")", "return " + ("false" if value == "true" else "true"))
            elif end > start:
                self.condition(start, end, False)
        for match in re.finditer(r"(?<=[\w)\]]) ([+-]) (?=[\w(])", self.code):
            sign = match.group(1)
            start = match.end()
            end = re.match(r"[\w.:>-]*", self.code[start:]).end() + start
            self.add("arithmetic", start, max(end, start + 1), "qplc_mutant::sign(@) * ", "", f"{'-' if sign == '+' else '+'} instead of {sign}")
        for match in re.finditer(r"^ {4,}((?:Q_EMIT )?[A-Za-z_][\w.:]*(?:(?:->|\.)\w+|\(\)|\[\w+\])*)\(", self.code, re.M):
            self.call(match)
        return [site for site in self.sites if not self.is_constant(site.start)]

    def call(self, match):
        start, end = match.start(1), statement_end(self.code, match.start(1))
        earlier = self.code[:start].rstrip()
        name = match.group(1)
        if end < 0 or not earlier.endswith((";", "{", "}", ")", "else", ":")) or self.code[end - 1] != ")":
            return
        if re.match(r"(if|for|while|switch|return|sizeof|static_assert|Q_UNUSED|Q_ASSERT\w*|assert|catch)$", name):
            return
        self.add("call", start, end + 1, "{ if (!qplc_mutant::on(@)) { ", " } }", "left out")

    def condition(self, start, end, is_whole):
        start, end = trimmed(self.code, start, end)
        part = self.code[start:end]
        if end <= start or ";" in part or "?" in part or "[" in part and "{" in part or top_level(self.code, start, end, ("=",)) or part.startswith("const "):
            return
        terms = []
        for first, last, _ in split(self.code, start, end, "||"):
            terms += split(self.code, first, last, "&&", outer="||" if len(split(self.code, start, end, "||")) > 1 else "")
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
        changed = " ".join((self.text[start:place] + other + self.text[place + len(operator):end]).split())
        self.add("comparison", start, end, f"(qplc_mutant::on(@) ? ({changed}) : (", "))", changed)

    def is_constant(self, place):
        """Whether a statement must be known to the compiler."""
        begin = max(self.code.rfind(mark, 0, place) for mark in ";{}")
        statement = re.sub(r"\b(case\b[^;]*?[^:]|default):(?!:)", "", self.code[begin + 1:place])  # behind a label
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
    for number, site in enumerate(sites, 1):
        site.number = number
    return sites


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


class Plant:
    """The build folder: mutated sources, their build, and what is known of it."""

    def __init__(self, root, folder, rooms_of_tests):
        self.root, self.folder, self.source, self.build = root, folder, folder / "source", folder / "build"
        self.rooms = rooms_of_tests
        names = sorted(str(p.relative_to(root)) for room in ROOMS for p in (root / "src" / room).rglob("*.cpp"))
        self.sites = find_sites(root, names)
        self.names = names
        content = subprocess.run(["git", "ls-files", "-z", "src", "include", "tests", "cmake", "scripts/lib/mutate.py"],
                                 cwd=root, capture_output=True, check=True).stdout.decode().split("\0")
        digest = hashlib.sha256()
        for name in filter(None, content):
            if (root / name).is_file():
                digest.update(name.encode() + (root / name).read_bytes())
        self.digest = digest.hexdigest()
        self.state_file = folder / "state.json"
        self.state = {}
        if self.state_file.exists():
            self.state = json.loads(self.state_file.read_text())
        if self.state.get("digest") != self.digest or self.state.get("rooms") != self.rooms:
            self.state = {"digest": self.digest, "rooms": self.rooms, "left_out": [], "built": False, "tests": {}, "results": {}}

    def keep(self):
        temporary = self.state_file.with_suffix(".new")
        temporary.write_text(json.dumps(self.state, indent=1))
        temporary.replace(self.state_file)

    def valid(self):
        left_out = set(self.state["left_out"])
        return [site for site in self.sites if site.number not in left_out]

    def write(self):
        for name in self.names:
            text = mutated((self.root / name).read_text(), [s for s in self.valid() if s.file == name])
            target = self.source / name
            if not target.exists() or target.read_text() != text:
                target.write_text(text)

    def make(self):
        if self.state["built"]:
            return
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=self.root, capture_output=True, check=True).stdout.decode().split("\0")
        for name in filter(None, listed):
            target = self.source / name
            if name in self.names or not (self.root / name).is_file():
                continue
            target.parent.mkdir(parents=True, exist_ok=True)
            if not target.exists() or target.read_bytes() != (self.root / name).read_bytes():
                shutil.copy2(self.root / name, target)
        helper = self.folder / "mutant.h"
        if not helper.exists() or helper.read_text() != header(self.sites):
            helper.write_text(header(self.sites))
        self.write()
        subprocess.run(["cmake", "-S", self.source, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DCMAKE_CXX_FLAGS_RELEASE=" + FLAGS, f"-DCMAKE_CXX_FLAGS=-include {helper} -w", "-DCMAKE_UNITY_BUILD=OFF",
                        "-DQTPLC_WARNINGS_AS_ERRORS=OFF", "-DQTPLC_BUILD_GUI=OFF", "-DQTPLC_BUILD_BENCHMARKS=OFF",
                        "-DQTPLC_BUILD_EXAMPLES=OFF"], check=True, stdout=subprocess.DEVNULL)
        self.compile("QtPlcCore")
        targets = [name for name in self.tests()]
        self.compile(*targets)
        self.state["built"] = True
        self.keep()

    def compile(self, *targets):
        for _ in range(MOST_REPAIRS):
            run = subprocess.Popen(["cmake", "--build", self.build, "--target", *targets, "--", "-k", "0"], stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True)
            lines = []
            for line in run.stdout:
                lines.append(line)
                if re.match(r"\[\d+/\d+\]", line):
                    print(line, end="", flush=True)
            if run.wait() == 0:
                return
            bad = set(re.findall(r"source/(src/\S+?):(\d+):\d+: (?:error|  required)", "".join(lines)))
            dropped = [s.number for s in self.valid() if any(s.file == f and s.line <= int(n) <= s.last for f, n in bad)]
            if not dropped:
                sys.exit("mutate: the mutated sources do not compile:\n" + "".join(lines[-60:]))
            print(f"mutate: {len(dropped)} sites are left out, they do not compile", flush=True)
            self.state["left_out"] += dropped
            self.keep()
            self.write()
        sys.exit("mutate: the mutated sources do not compile")

    def tests(self):
        listed = json.loads(subprocess.run(["ctest", "--show-only=json-v1"], cwd=self.build, capture_output=True, check=True).stdout)
        tests = {}
        for test in listed["tests"]:
            folder = next((p["value"] for p in test.get("properties", []) if p["name"] == "WORKING_DIRECTORY"), "")
            room = Path(folder).name
            if room in self.rooms and test["name"].startswith("tst_"):
                tests[test["name"]] = self.build / "bin" / test["name"]
        return tests

    def run(self, program, timeout, **variables):
        environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen", **variables}
        test = subprocess.Popen([str(program)], env=environment, cwd=self.build, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL, start_new_session=True)
        try:
            return test.wait(timeout)
        except subprocess.TimeoutExpired:
            return None
        finally:
            try:
                os.killpg(test.pid, signal.SIGKILL)  # and what it has started; the session is ours
            except ProcessLookupError:
                pass
            test.wait()

    def record(self):
        tests = self.tests()
        for number, (name, program) in enumerate(tests.items(), 1):
            print(f"progress: {number} of {len(tests)}", flush=True)
            if name in self.state["tests"]:
                continue
            bitmap = self.folder / "reached"
            bitmap.write_bytes(bytes(len(self.sites) + 1))
            begin = time.monotonic()
            code = self.run(program, 300, QTPLC_MUTANT_REACHED=str(bitmap), QTPLC_MUTANT="0")
            seconds = time.monotonic() - begin
            reached = [i for i, byte in enumerate(bitmap.read_bytes()) if byte] if code == 0 else []
            if code != 0:
                print(f"mutate: {name} fails without a mutation, it is not used", flush=True)
            self.state["tests"][name] = {"seconds": seconds, "reached": reached}
            self.keep()

    def judge(self, site):
        """How a mutant ends: what killed it, or nothing, and which tests reached it."""
        tests = {n: t for n, t in self.state["tests"].items() if site.number in t["reached"]}
        programs = self.tests_known
        for name in sorted(tests, key=lambda n: tests[n]["seconds"]):
            code = self.run(programs[name], 5 * tests[name]["seconds"] + LONGEST_ADDED, QTPLC_MUTANT=str(site.number))
            if code != 0:
                return {"killer": name, "how": "time-out" if code is None else "failed", "tests": sorted(tests)}
        return {"killer": None, "how": "survived" if tests else "not reached", "tests": sorted(tests)}

    def hunt(self, sites):
        self.tests_known = self.tests()
        for number, site in enumerate(sites, 1):
            print(f"progress: {number} of {len(sites)}", flush=True)
            if str(site.number) not in self.state["results"]:
                self.state["results"][str(site.number)] = self.judge(site)
                self.keep()


def some(tests):
    """The first names; a place at the heart of the product is reached by all tests."""
    others = f" and {len(tests) - 5} others" if len(tests) > 5 else ""
    return ", ".join(tests[:5]) + others or "no test"


def table(sites, results):
    lines, survivors = [], 0
    for site in sites:
        result = results.get(str(site.number))
        if result is None or result["killer"]:
            continue
        survivors += 1
        lines.append(f"{site.file}:{site.line}: {site.kind} {site.number}, {result['how']}: {site.original}\n    -> {site.mutation}\n"
                     f"    reached by: {some(result['tests'])}")
    judged = sum(str(site.number) in results for site in sites)
    return "\n".join(lines + [f"{survivors} of {judged} mutants survived"])


def main():
    parser = argparse.ArgumentParser(prog="mutate")
    parser.add_argument("--root", type=Path, required=True)
    parser.add_argument("--build", type=Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--only", default="")
    parser.add_argument("--tests", default="protocol,transport,node,states")
    parser.add_argument("step", choices=("make", "record", "hunt", "table"))
    arguments = parser.parse_args()
    folder = (arguments.build or arguments.root / "build" / "mutate").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    plant = Plant(arguments.root.resolve(), folder, arguments.tests.split(","))
    chosen = [site for site in plant.valid() if site.file.startswith(arguments.only)]
    chosen = random.Random(arguments.seed).sample(chosen, min(arguments.count, len(chosen)))
    if arguments.step == "table":
        print(table(chosen, plant.state["results"]))
    else:
        {"make": plant.make, "record": plant.record, "hunt": lambda: plant.hunt(chosen)}[arguments.step]()


if __name__ == "__main__":
    main()
