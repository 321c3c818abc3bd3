#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Mutates a small program and runs it: each kind of mutation, and what is left out. Then judges
mutants with a program of tests.

usage: mutation.py FOLDER_OF_SCRIPTS
"""
import os
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

SAMPLE = """#include <cstdio>
#include <cstdlib>
#define TWICE(x) ((x) + (x))
constexpr int Fixed = 3 + 4;
static_assert(Fixed > 2, "a > b && c");
// if (a > b) in a comment
bool isSmall(int a)
{
    return a < 3;
}
bool isInside(int a, int b)
{
    return a > 0 && b > 0;
}
bool isOutside(int a, int b)
{
    if (a == 9 || b == 9)
        return true;
    return false;
}
int sum(int a, int b)
{
    return a + b;
}
void note(const char *text)
{
    std::printf("%s ", text);
}
int main()
{
    if (isSmall(2))
        note("small a < b");
    else
        note("large");
    switch (sum(5, 3)) {
    case 4 + 4:
        note("eight");
        break;
    default:
        note("other");
        break;
    }
    std::printf("%d%d%d", isSmall(3), isInside(1, 0), isOutside(1, 2));
    return 0;
}
"""
ORIGINAL = "small a < b eight 000"


class Mutation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        (cls.folder / "sample.cpp").write_text(SAMPLE)
        cls.sites = mutate.find_sites(cls.folder, ["sample.cpp"])
        cls.text = mutate.mutated(SAMPLE, cls.sites)
        (cls.folder / "mutated.cpp").write_text(cls.text)
        (cls.folder / "mutant.h").write_text(mutate.header(cls.sites))
        subprocess.run(
            ["c++", "-std=c++17", "-include", "mutant.h", "mutated.cpp", "-o", "sample"], cwd=cls.folder, check=True
        )

    def site(self, kind, original, mutation):
        found = [s for s in self.sites if (s.kind, s.original, s.mutation) == (kind, original, mutation)]
        self.assertEqual(len(found), 1, f"{kind} {original} -> {mutation}: {self.sites}")
        return found[0]

    def output(self, site, **variables):
        number = str(site.number) if site else "0"
        return subprocess.run(
            [self.folder / "sample"],
            env={**os.environ, "QTPLC_MUTANT": number, **variables},
            capture_output=True,
            text=True,
            check=True,
        ).stdout

    def test_no_choice_is_the_original(self):
        self.assertEqual(self.output(None), ORIGINAL)

    def test_each_kind_is_chosen_at_run_time(self):
        for kind, original, mutation, expected in (
            ("comparison", "a < 3", "a <= 3", "small a < b eight 100"),
            ("condition", "isSmall(2)", "negated", "large eight 000"),
            ("operand", "b > 0", "left out of &&", "small a < b eight 010"),
            ("comparison", "a == 9", "a != 9", "small a < b eight 001"),
            ("return", "false", "return true", "small a < b eight 001"),
            ("arithmetic", "b", "- instead of +", "small a < b other 000"),
            ("call", 'note("eight");', "left out", "small a < b 000"),
        ):
            with self.subTest(kind=kind, original=original):
                self.assertEqual(self.output(self.site(kind, original, mutation)), expected)

    def test_what_the_compiler_must_know_is_left_out(self):
        lines = SAMPLE.split("\n")
        for number in (3, 4, 5, 6, 35):  # macro, constexpr, static_assert, comment, label
            self.assertEqual([s for s in self.sites if s.line == number], [], lines[number - 1])

    def test_lines_keep_their_numbers(self):
        self.assertEqual(self.text.count("\n"), SAMPLE.count("\n"))

    def test_places_that_were_reached_are_noted(self):
        bitmap = self.folder / "reached"
        bitmap.write_bytes(bytes(len(self.sites) + 1))
        self.output(None, QTPLC_MUTANT_REACHED=str(bitmap))
        reached = bitmap.read_bytes()
        self.assertTrue(reached[self.site("call", 'note("eight");', "left out").number])
        self.assertFalse(reached[self.site("call", 'note("other");', "left out").number])

    def test_a_survivor_is_shown_with_its_tests(self):
        site = self.site("comparison", "a < 3", "a <= 3")
        text = mutate.table(
            [site],
            {site.identity: {"killer": "", "how": "survived", "tests": ["tst_Small"], "unsteady": [], "cpu": 1.0}},
        )
        self.assertIn("sample.cpp:9: comparison", text)
        self.assertIn("reached by: tst_Small", text)
        self.assertIn("1 of 1 mutants survived", text)

    def test_the_same_sites_are_drawn_when_other_code_changes(self):
        drawn = mutate.drawn(self.sites, 1, 5)
        self.assertEqual(len(drawn), 5)
        self.assertNotEqual([s.identity for s in drawn], [s.identity for s in mutate.drawn(self.sites, 2, 5)])
        (self.folder / "sample.cpp").write_text("int before(int a)\n{\n    return a + 1;\n}\n" + SAMPLE)
        later = mutate.drawn(mutate.find_sites(self.folder, ["sample.cpp"]), 1, 5)
        self.assertGreaterEqual(
            len({s.identity for s in drawn} & {s.identity for s in later}), 4
        )  # the new one may be among them


# A program that looks like Qt Test from outside. It notes each function that it runs.
PROGRAM = """#!/bin/sh
[ "$1" = -functions ] && { printf 'fine()\\nbroken()\\nstuck()\\nunsteady()\\nendless()\\nbusy()\\n'; exit; }
for function in "$@"; do
    echo $function >> ran
    [ "$QTPLC_MUTANT" = 0 ] && [ $function != busyMachine ] && { echo "PASS   : tst_Sample::$function()"; continue; }
    case $function in
    broken) echo "FAIL!  : tst_Sample::broken() Compared values are not the same"; continue ;;
    stuck) echo "FAIL!  : tst_Sample::stuck() Compared values are not the same"; sleep 100 ;;
    unsteady) [ -f again ] || { touch again; echo "FAIL!  : tst_Sample::unsteady(row) 'late'"; exit 1; } ;;
    endless) sleep 100 ;;
    busyMachine) echo "FAIL!  : tst_Sample::busyMachine() 'in time'"; exit 1 ;;
    busy) while :; do :; done ;;
    esac
    echo "PASS   : tst_Sample::$function()"
done
"""


class Options(unittest.TestCase):
    def refusal(self, *options):
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.run(
                [sys.executable, "-B", SCRIPTS / "lib" / "mutate.py", "--root", SCRIPTS.parent]
                + ["--build", folder, *options, "make"],
                capture_output=True,
                text=True,
            )
        self.assertEqual(run.returncode, 1)
        return run.stderr

    def test_a_folder_of_tests_that_is_not_there_is_named(self):
        self.assertIn("there is no folder tests/protcol", self.refusal("--tests", "node,protcol"))

    def test_files_without_a_place_to_change_are_named(self):
        self.assertIn("no place to change in 'src/gui'", self.refusal("--only", "src/gui"))


class Tests(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        path = self.folder / "tst_Sample"
        path.write_text(PROGRAM)
        path.chmod(0o755)
        self.program = tests.Program("tst_Sample", path, "tst_Sample")

    def judged(self, *names, seconds=0.0, cpu=0.0):
        functions = [tests.Function(self.program, name, seconds, cpu, b"\1") for name in names]
        verdict = tests.Verdict()
        tests.Batch(functions).judge(verdict, QTPLC_MUTANT="1")
        return verdict

    def ran(self):
        return (self.folder / "ran").read_text().split()

    def test_functions_are_listed(self):
        self.assertEqual(self.program.functions(), ["fine", "broken", "stuck", "unsteady", "endless", "busy"])

    def test_what_passes_kills_nothing(self):
        self.assertEqual(self.judged("fine").killer, "")

    def test_the_first_failure_ends_the_program_and_is_repeated(self):
        verdict = self.judged("fine", "stuck", "endless")
        self.assertEqual((verdict.killer, verdict.how), ("tst_Sample stuck", "failed"))
        self.assertEqual(self.ran(), ["fine", "stuck", "stuck", "stuck"])  # with the mutant, again, and without it

    def test_what_fails_without_the_mutant_too_kills_nothing(self):
        verdict = self.judged("busyMachine", "fine")
        self.assertEqual((verdict.killer, verdict.unsteady), ("", ["tst_Sample busyMachine"]))

    def test_what_passes_behind_the_first_failure_excuses_nothing(self):
        self.assertEqual(self.judged("broken", "fine").killer, "tst_Sample broken")

    def test_what_fails_once_kills_nothing_and_the_others_go_on(self):
        verdict = self.judged("unsteady", "fine")
        self.assertEqual((verdict.killer, verdict.unsteady), ("", ["tst_Sample unsteady"]))
        self.assertEqual(self.ran(), ["unsteady", "unsteady", "fine"])
        self.assertEqual(self.judged("unsteady", "broken").killer, "tst_Sample broken")

    def test_a_time_out_kills(self):
        with unittest.mock.patch.object(tests, "LONGEST_ADDED", 0.2):
            verdict = self.judged("fine", "endless")
        self.assertEqual((verdict.killer, verdict.how), ("tst_Sample fine", "time-out"))

    def test_a_loop_ends_when_its_processor_time_is_over(self):
        with unittest.mock.patch.object(tests, "CPU_ADDED", 0):
            verdict = self.judged("busy", seconds=5.0)
        self.assertEqual((verdict.killer, verdict.how), ("tst_Sample busy", "failed"))

    def test_what_reaches_few_places_runs_first_and_what_has_killed_too(self):
        other = tests.Program("tst_Other", self.program.path, "tst_Other")
        narrow = tests.Function(self.program, "fine", 0.05, 0.0, bytes(1000) + b"\1" * 10)
        wide = tests.Function(other, "fine", 0.05, 0.0, b"\1" * 1000)
        self.assertEqual([b.program.name for b in tests.batches([wide, narrow])], ["tst_Sample", "tst_Other"])
        wide.tried = wide.killed = 100
        self.assertEqual([b.program.name for b in tests.batches([wide, narrow])], ["tst_Other", "tst_Sample"])

    def test_a_program_runs_once_at_a_time(self):
        one = tests.Batch([tests.Function(self.program, "fine", 0.0, 0.0, b"")])
        two = tests.Batch(
            [tests.Function(tests.Program("tst_Other", self.program.path, "tst_Other"), "fine", 0.0, 0.0, b"")]
        )
        locks = tests.Locks()
        self.assertIs(locks.take_first([one, two]), one)
        self.assertIs(locks.take_first([one, two]), two)
        locks.give_back(one)
        self.assertIs(locks.take_first([two, one]), one)


if __name__ == "__main__":
    SCRIPTS = Path(sys.argv.pop(1)).resolve()
    sys.path.insert(0, str(SCRIPTS / "lib"))
    import mutate
    import mutation_tests as tests

    unittest.main()
