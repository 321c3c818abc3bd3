#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Changes the sources of the core at many places, each chosen at run time, and looks which changes
no test notices. docs/design/mutation.md says how. Called by scripts/mutate."""
import argparse
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from threading import Lock

from mutation_sites import drawn, find_sites, header, mutated
from mutation_tests import Batch, Function, Locks, Program, Verdict, batches

ROOMS = ("protocol", "transport", "node")
FLAGS = (
    "-w;-O1;-include;{helper}"  # of sources with mutants; all others are compiled as every day, so ccache knows them
)
MOST_REPAIRS = 12  # builds in which sites that do not compile are left out
LONGEST = 120.0  # [s] a function without a mutation


class Plant:
    """The build folder: mutated sources, their build, and what is known of it."""

    def __init__(self, root, folder, rooms_of_tests, wanted):
        """wanted: from sites to those that are drawn of them."""
        self.root, self.folder, self.source, self.build = (
            root,
            folder,
            folder / "source",
            folder / "source" / "build" / "dev",
        )
        self.rooms, self.wanted, self.writing = rooms_of_tests, wanted, Lock()
        self.names = sorted(str(p.relative_to(root)) for room in ROOMS for p in (root / "src" / room).rglob("*.cpp"))
        self.sites = find_sites(root, self.names)
        sources = self.digest("src", "include", "cmake", "scripts/lib/mutation_sites.py")
        self.everything = self.digest("src", "include", "cmake", "scripts/lib/mutation_sites.py", "tests")
        self.state_file = folder / "state.json"
        self.state = json.loads(self.state_file.read_text()) if self.state_file.exists() else {}
        if self.state.get("sources") != sources:
            killers = {
                **self.state.get("killers", {}),
                **{i: r["killer"] for i, r in self.state.get("results", {}).items() if r["killer"]},
            }
            self.state = {
                "sources": sources,
                "left_out": [],
                "built": "",
                "programs": {},
                "results": {},
                "killers": killers,
            }

    def digest(self, *folders):
        listed = subprocess.run(
            ["git", "ls-files", "-z", *folders], cwd=self.root, capture_output=True, check=True
        ).stdout.decode()
        digest = hashlib.sha256()
        for name in filter(None, listed.split("\0")):
            if (self.root / name).is_file():
                digest.update(name.encode() + (self.root / name).read_bytes())
        return digest.hexdigest()

    def keep(self):
        temporary = self.state_file.with_suffix(".new")
        temporary.write_text(json.dumps(self.state, indent=1))
        temporary.replace(self.state_file)

    def chosen(self):
        left_out = set(self.state["left_out"])
        return self.wanted([site for site in self.sites if site.number not in left_out])

    def made(self):
        """What a build was made of."""
        return hashlib.sha256(
            "\n".join([self.everything, *self.rooms, *(s.identity for s in self.chosen())]).encode()
        ).hexdigest()

    def write(self):
        """Copies the sources. The changed files have options of their own."""
        chosen = self.chosen()
        files = {site.file for site in chosen}
        helper = self.folder / "mutant.h"
        contents = {helper: header(self.sites).encode()}
        listed = (
            subprocess.run(["git", "ls-files", "-z"], cwd=self.root, capture_output=True, check=True)
            .stdout.decode()
            .split("\0")
        )
        for name in filter(None, listed):
            if (self.root / name).is_file():
                contents[self.source / name] = (self.root / name).read_bytes()
        for name in files:
            contents[self.source / name] = mutated(
                (self.root / name).read_text(), [s for s in chosen if s.file == name]
            ).encode()
        sources = "\n    ".join(sorted(name.removeprefix("src/") for name in files))
        flags = FLAGS.format(helper=helper)
        options = f'\nset_source_files_properties(\n    {sources}\n    PROPERTIES COMPILE_OPTIONS "{flags}")\n'
        contents[self.source / "src" / "CMakeLists.txt"] += options.encode()
        for target, content in contents.items():
            target.parent.mkdir(parents=True, exist_ok=True)
            if not target.exists() or target.read_bytes() != content:
                target.write_bytes(content)
                shutil.copymode(self.root / target.relative_to(self.source), target) if target != helper else None

    def make(self):
        if self.state["built"] == self.made():
            return
        self.write()
        subprocess.run(
            ["cmake", "--preset", "dev", "-DCMAKE_CXX_FLAGS_DEBUG=-O0"],
            cwd=self.source,
            check=True,
            stdout=subprocess.DEVNULL,
        )
        self.compile("QtPlcCore")
        self.compile(*self.tests())
        if self.state.get("chosen") != [site.identity for site in self.chosen()]:
            self.state["programs"] = {}  # nobody knows yet what reaches the new ones
        self.state["chosen"] = [site.identity for site in self.chosen()]
        self.state["built"] = self.made()
        self.keep()

    def compile(self, *targets):
        for _ in range(MOST_REPAIRS):
            run = subprocess.Popen(
                ["cmake", "--build", self.build, "--target", *targets, "--", "-k", "0"],
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
            )
            lines = []
            for line in run.stdout:
                lines.append(line)
                if re.match(r"\[\d+/\d+\]", line):
                    print(line, end="", flush=True)
            if run.wait() == 0:
                return
            bad = set(re.findall(r"(?:^|[/ ])(src/\S+?\.cpp):(\d+):\d+: (?:error|  required)", "".join(lines), re.M))
            dropped = [
                s.number for s in self.chosen() if any(s.file == f and s.line <= int(n) <= s.last for f, n in bad)
            ]
            if not dropped:
                sys.exit("mutate: the mutated sources do not compile:\n" + "".join(lines[-60:]))
            print(f"mutate: {len(dropped)} sites are left out, they do not compile", flush=True)
            self.state["left_out"] += dropped
            self.keep()
            self.write()
        sys.exit("mutate: the mutated sources do not compile")

    def tests(self):
        listed = json.loads(
            subprocess.run(["ctest", "--show-only=json-v1"], cwd=self.build, capture_output=True, check=True).stdout
        )
        tests = {}
        for test in listed["tests"]:
            properties = {p["name"]: p["value"] for p in test.get("properties", [])}
            name = test["name"]
            if Path(properties.get("WORKING_DIRECTORY", "")).name in self.rooms and name.startswith("tst_"):
                lock = "".join(properties.get("RESOURCE_LOCK", [])) or name
                tests[name] = Program(name, self.build / "bin" / name, lock)
        return tests

    def bitmap(self, program, function):
        return self.folder / "reached" / f"{program}.{function}"

    def record(self, jobs):
        """Runs each function of each new or changed program, and notes the places that it
        reaches."""
        (self.folder / "reached").mkdir(exist_ok=True)
        known, waiting = {}, []
        for name, program in self.tests().items():
            digest = hashlib.sha256(program.path.read_bytes()).hexdigest()
            old = self.state["programs"].get(name)
            known[name] = old if old and old["digest"] == digest else {"digest": digest, "functions": {}}
            waiting += [
                (program, f, known[name]["functions"]) for f in program.functions() if f not in known[name]["functions"]
            ]
        self.state["programs"] = known
        self.each(self.record_function, sorted(waiting, key=lambda w: w[1]), jobs)

    def record_function(self, waiting):
        program, name, functions = waiting
        bitmap = self.bitmap(program.name, name)
        for _ in range(2):
            bitmap.write_bytes(bytes(len(self.sites) + 1))
            outcome = program.run([name], LONGEST, LONGEST, QTPLC_MUTANT_REACHED=str(bitmap), QTPLC_MUTANT="0")
            if outcome.how == "passed":
                break
        else:
            print(f"mutate: {program.name} {name} fails without a mutation, it is not used", flush=True)
        with self.writing:
            functions[name] = {"passed": outcome.how == "passed", "seconds": outcome.seconds, "cpu": outcome.cpu}
            self.keep()

    def hunt(self, jobs):
        programs = self.tests()
        self.functions = [
            Function(programs[p], f, about["seconds"], about["cpu"], self.bitmap(p, f).read_bytes())
            for p, known in self.state["programs"].items()
            for f, about in known["functions"].items()
            if about["passed"]
        ]
        self.locks = Locks()
        self.each(self.judge, [site for site in self.chosen() if not self.is_judged(site)], jobs)

    def is_judged(self, site):
        """A killer must be the same program still, and a survivor must have been tried with all of
        today's programs."""
        result = self.state["results"].get(site.identity)
        digests = {name: program["digest"] for name, program in self.state["programs"].items()}
        return (
            result
            and all(digests.get(name) == digest for name, digest in result["tried"].items())
            and (result["killer"] or len(result["tried"]) == len(digests))
        )

    def judge(self, site):
        """How a mutant ends: what killed it, or nothing, and which tests reached it."""
        old = self.state["results"].get(site.identity, {"tried": {}, "killer": ""})
        programs = self.state["programs"]
        fresh = [
            f
            for f in self.functions
            if old["killer"] or old["tried"].get(f.program.name) != programs[f.program.name]["digest"]
        ]
        reaching = [f for f in fresh if f.reached[site.number]]
        hint = self.state["killers"].get(site.identity)
        waiting = [Batch([f]) for f in reaching if f"{f.program.name} {f.name}" == hint] + batches(reaching)
        verdict = Verdict()
        while waiting and not verdict.killer:
            batch = self.locks.take_first(waiting)
            waiting.remove(batch)
            try:
                batch.judge(verdict, QTPLC_MUTANT=str(site.number))
            finally:
                self.locks.give_back(batch)
        tried = [verdict.killer.split()[0]] if verdict.killer else programs
        tests = sorted({f.program.name for f in self.functions if f.reached[site.number]})
        how = verdict.how if tests else "not reached"
        with self.writing:
            self.state["results"][site.identity] = {
                **vars(verdict),
                "how": how,
                "tests": tests,
                "tried": {name: programs[name]["digest"] for name in tried},
            }
            if verdict.killer:
                self.state["killers"][site.identity] = verdict.killer
            self.keep()

    def each(self, function, items, jobs):
        """Most tests wait, so more of them run side by side than there are processors."""
        with ThreadPoolExecutor(jobs) as pool:
            for number, done in enumerate(as_completed([pool.submit(function, item) for item in items]), 1):
                done.result()
                print(f"progress: {number} of {len(items)}", flush=True)


def some(tests):
    """The first names; a place at the heart of the product is reached by all tests."""
    others = f" and {len(tests) - 5} others" if len(tests) > 5 else ""
    return ", ".join(tests[:5]) + others or "no test"


def table(sites, results):
    lines, survivors = [], 0
    for site in sites:
        result = results.get(site.identity)
        if result is None or result["killer"]:
            continue
        survivors += 1
        lines.append(
            f"{site.file}:{site.line}: {site.kind} {site.number}, {result['how']}: {site.original}\n"
            f"    -> {site.mutation}\n"
            f"    reached by: {some(result['tests'])}"
        )
    judged = [results[site.identity] for site in sites if site.identity in results]
    unsteady = sorted({name for result in judged for name in result["unsteady"]})
    lines += [f"failed once, and passed the second time: {', '.join(unsteady)}"] if unsteady else []
    cpu = sum(result["cpu"] for result in judged) / max(len(judged), 1)
    return "\n".join(lines + [f"{survivors} of {len(judged)} mutants survived; {cpu:.1f} s of a processor for each"])


def main():
    parser = argparse.ArgumentParser(prog="mutate")
    parser.add_argument("--root", type=Path, required=True)
    parser.add_argument("--build", type=Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--only", default="")
    parser.add_argument("--tests", default="protocol,transport,node,states,test_support")
    parser.add_argument("--jobs", type=int, default=6 * (os.cpu_count() or 1))
    parser.add_argument("step", choices=("make", "record", "hunt", "table"))
    arguments = parser.parse_args()
    for room in arguments.tests.split(","):
        if not (arguments.root / "tests" / room).is_dir():
            sys.exit(f"mutate: there is no folder tests/{room}; name others with --tests")
    folder = (arguments.build or arguments.root / "build" / "mutate").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    plant = Plant(
        arguments.root.resolve(),
        folder,
        arguments.tests.split(","),
        lambda sites: drawn([s for s in sites if s.file.startswith(arguments.only)], arguments.seed, arguments.count),
    )
    if not plant.chosen():
        sys.exit(
            f"mutate: no place to change in '{arguments.only}'; --only is the begin of names like "
            "src/protocol/Crc32c.cpp, and --count 1 or more"
        )
    if arguments.step == "make":
        plant.make()
    elif arguments.step == "record":
        plant.record(arguments.jobs)
    elif arguments.step == "hunt":
        plant.hunt(arguments.jobs)
    else:
        print(table(plant.chosen(), plant.state["results"]))


if __name__ == "__main__":
    main()
