#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Mutates a small program and runs it: each kind of mutation, and what is left out.

usage: mutation.py FOLDER_OF_SCRIPTS
"""
import os
import subprocess
import sys
import tempfile
import unittest
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
        subprocess.run(["c++", "-std=c++17", "-include", "mutant.h", "mutated.cpp", "-o", "sample"], cwd=cls.folder, check=True)

    def site(self, kind, original, mutation):
        found = [s for s in self.sites if (s.kind, s.original, s.mutation) == (kind, original, mutation)]
        self.assertEqual(len(found), 1, f"{kind} {original} -> {mutation}: {self.sites}")
        return found[0]

    def output(self, site, **variables):
        number = str(site.number) if site else "0"
        return subprocess.run([self.folder / "sample"], env={**os.environ, "QTPLC_MUTANT": number, **variables}, capture_output=True,
                              text=True, check=True).stdout

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
                ("call", 'note("eight");', "left out", "small a < b 000")):
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
        text = mutate.table([site], {str(site.number): {"killer": None, "how": "survived", "tests": ["tst_Small"]}})
        self.assertIn("sample.cpp:9: comparison", text)
        self.assertIn("reached by: tst_Small", text)
        self.assertIn("1 of 1 mutants survived", text)


if __name__ == "__main__":
    sys.path.insert(0, str(Path(sys.argv.pop(1)) / "lib"))
    import mutate
    unittest.main()
