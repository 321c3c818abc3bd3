#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The reader of typed.py finds what is wrong with a page."""
import tempfile
import unittest
from pathlib import Path

from typed import Broken, Expectation, Reader, Terminal, commands, without_comment


class Typed(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)
        self.terminal = Terminal(self.folder)
        self.addCleanup(self.terminal.close)

    def follow(self, text, **how):
        page = self.folder / "page.md"
        page.write_text(text)
        Reader(page, self.folder, self.terminal, **how).follow()

    def test_files_are_created_and_commands_are_typed_in_order(self):
        self.follow(
            "<!-- begin of: code/a.txt -->\n```text\none\n```\n"
            "<!-- end of: code/a.txt -->\n```text\ntwo\n```\n\n"
            "```sh\ncp a.txt b.txt  # a copy\n```\n"
        )
        self.assertEqual((self.folder / "b.txt").read_text(), "one\n\ntwo\n")

    def test_a_file_that_comes_later_is_missed(self):
        with self.assertRaisesRegex(Broken, r"page.md:1: 'cat later.txt' gives 1"):
            self.follow("```sh\ncat later.txt\n```\n\n<!-- file: code/later.txt -->\n```text\none\n```\n")

    def test_a_block_that_no_test_runs_fails(self):
        for language in ("cpp", "cmake", "ini", ""):
            with self.assertRaisesRegex(Broken, "run by no test"):
                self.follow(f"```{language}\nanything\n```\n")

    def test_what_a_command_shows_is_compared(self):
        with self.assertRaisesRegex(Broken, "'echo 4' does not show '5'"):
            self.follow("```sh\necho 4\n```\n", expected={"echo 4": Expectation(shows="5")})

    def test_an_expectation_that_the_page_does_not_show_fails(self):
        with self.assertRaisesRegex(Broken, "does not show .*'echo 6'"):
            self.follow("```sh\necho 4\n```\n", expected={"echo 6": Expectation()})
        with self.assertRaisesRegex(Broken, "does not show .*'reboot'"):
            self.follow("```sh\necho 4\n```\n", not_typed={"reboot": "a good reason"})

    def test_keys_are_pressed_when_the_pattern_is_seen(self):
        self.follow(
            '```sh\nread name; echo "hello $name"\n```\n',
            expected={'read name; echo "hello $name"': Expectation(shows="hello kite", keys=("", b"kite\n"))},
        )

    def test_commands_are_cut_at_lines_and_comments(self):
        self.assertEqual(
            list(commands("# nothing\n\none # two\nthree \\\n    four\n")), ["one # two", "three \\\n    four"]
        )
        self.assertEqual(without_comment("qtplc list   # all 'signals'"), "qtplc list")


if __name__ == "__main__":
    unittest.main()
