#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Takes one comment after the other away from a public header; headers.py has to name each of them.

usage: tst_headers.py SOURCE_FOLDER [DOXYGEN]
"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
DOXYGEN = sys.argv.pop(1) if len(sys.argv) > 1 else "doxygen"
HEADERS = Path(__file__).with_name("headers.py")
PAGE = """// SPDX-License-Identifier: Apache-2.0
/// A valve.
///
/// \\code
/// QPlcValve valve;
/// \\endcode
///
/// \\threadsafe no
///
/// \\ingroup nodes
class QPlcValve : public QPlcBase
{
public:
    /// How far it is open.
    enum State {
        Closed,  ///< no flow
        Open     ///< full flow
    };
    /// Opens the valve.
    void open();
    /// Returns how far it is open.
    virtual State state() const;
    ~QPlcValve() override;
    QPlcValve(const QPlcValve &) = delete;

    int turns = 0;  ///< of its wheel

Q_SIGNALS:
    /// Emitted when it has opened.
    void opened();

protected:
    /// Called when it leaks.
    virtual void leaked();

private:
    void close();
};
"""


class Headers(unittest.TestCase):
    def check(self, page, dropped=""):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            (root / "include/QtPlc").mkdir(parents=True)
            (root / "docs").mkdir()
            for name in ("Doxyfile.in", "reference.dox"):
                (root / "docs" / name).write_text((SOURCE / "docs" / name).read_text().replace(dropped, ""))
            (root / "include/QtPlc/QPlcValve.h").write_text(page)
            run = subprocess.run(
                [sys.executable, "-B", HEADERS, "check", root, root / "work", DOXYGEN], capture_output=True, text=True
            )
            self.assertEqual(run.stderr, "")
            return run.returncode, run.stdout

    def assert_named(self, comment, *words):
        self.assertIn(comment, PAGE)
        code, output = self.check(PAGE.replace(comment, ""))
        self.assertEqual(code, 1, output)
        for word in words:
            self.assertIn(word, output)

    def test_a_page_with_all_comments_passes(self):
        code, output = self.check(PAGE)
        self.assertEqual(code, 0, output)
        self.assertIn("9 of 9 public names have a comment", output)

    def test_each_comment_that_is_missing_is_named(self):
        for comment, name in (
            ("    /// How far it is open.\n", "QPlcValve::State"),
            ("  ///< no flow", "QPlcValve::Closed"),
            ("    /// Opens the valve.\n", "QPlcValve::open()"),
            ("    /// Returns how far it is open.\n", "QPlcValve::state() const"),
            ("  ///< of its wheel", "QPlcValve::turns"),
            ("    /// Emitted when it has opened.\n", "QPlcValve::opened()"),
            ("    /// Called when it leaks.\n", "QPlcValve::leaked()"),
        ):
            with self.subTest(name):
                self.assert_named(comment, f"{name} has no comment")

    def test_a_class_needs_an_example(self):
        self.assert_named("/// \\code\n/// QPlcValve valve;\n/// \\endcode\n", "QPlcValve has no example")

    def test_a_class_needs_a_thread_rule(self):
        self.assert_named("/// \\threadsafe no\n", "QPlcValve has no thread rule")

    def test_a_class_needs_a_group(self):
        self.assert_named("/// \\ingroup nodes\n", "QPlcValve belongs to no group")

    def test_the_first_page_names_each_group(self):
        code, output = self.check(PAGE, "- \\ref recording\n")
        self.assertEqual(code, 1, output)
        self.assertIn("the list of groups does not name recording", output)


if __name__ == "__main__":
    unittest.main()
