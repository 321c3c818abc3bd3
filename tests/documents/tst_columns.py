#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants long lines into a folder; columns.py has to name each of them, and no other line."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

COLUMNS = Path(__file__).with_name("columns.py")
PYTHON = "#!/usr/bin/env python3\n"


def words(length, begin=""):
    """So many columns of words."""
    return (begin + "word " * length)[: length - 1] + "s"


def code(length, character="x"):
    return 'a = "' + character * (length - 6) + '"'


class Columns(unittest.TestCase):
    def check(self, name, text):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
            return subprocess.run([sys.executable, "-B", COLUMNS, folder], capture_output=True, text=True)

    def assert_named(self, name, text, where):
        run = self.check(name, text)
        self.assertEqual(run.stdout.splitlines(), [f"{name}:{where}"])
        self.assertEqual(run.returncode, 1)

    def assert_clean(self, name, text):
        run = self.check(name, text)
        self.assertEqual((run.stdout, run.returncode), ("1 files have lines that are short enough\n", 0))

    def test_code_has_120_columns(self):
        for name in ("a.cpp", "QtPlc/Header", "a.py", "CMakeLists.txt", "a.cmake", "a.sh", "a.yml", "scripts/run"):
            with self.subTest(name):
                self.assert_clean(name, f"\n{code(120)}\n")
                self.assert_named(name, f"\n{code(121)}\n", "2: 121 columns; wrap code at 120")

    def test_comments_have_100_columns(self):
        for name, begin in (
            ("a.h", "    /// "),
            ("a.cpp", "// "),
            ("a.py", "# "),
            ("CMakeLists.txt", "  # "),
            ("run", "# "),
        ):
            with self.subTest(name):
                self.assert_clean(name, words(100, begin))
                self.assert_named(name, words(101, begin), "1: 101 columns; wrap comments and documents at 100")

    def test_docstrings_have_100_columns(self):
        for name in ("a.py", "benchmarks/figures"):
            for text in ('"""{}"""\n', '"""A module.\n\n{}\n"""\n', 'def f():\n    """{}"""\n'):
                with self.subTest(name=name, text=text):
                    self.assert_clean(name, PYTHON + text.format(words(90)))
                    run = self.check(name, PYTHON + text.format(words(115)))
                    self.assertRegex(run.stdout, rf"{name}:\d: 1\d\d columns; wrap comments and documents at 100")

    def test_prose_has_100_columns(self):
        self.assert_clean("a.md", words(100))
        self.assert_named("a.md", f"# Title\n\n{words(101)}", "3: 101 columns; wrap comments and documents at 100")

    def test_what_cannot_be_wrapped_is_left_alone(self):
        long = words(150)
        self.assert_clean("a.md", f"| {long} |\n\n```text\n{long}\n```\n\n[a link](https://{long.replace(' ', '/')})\n")
        self.assert_clean("a.h", f'#error "{long}"\n')
        self.assert_clean("a.h", words(120, "///    "))

    def test_columns_are_counted_and_not_bytes(self):
        self.assert_clean("a.py", code(120, "\u00e4"))

    def test_an_excused_file_is_not_read(self):
        run = self.check("docs/protocol/vectors/a.json", words(200))
        self.assertEqual((run.stdout, run.returncode), ("0 files have lines that are short enough\n", 1))


if __name__ == "__main__":
    unittest.main()
