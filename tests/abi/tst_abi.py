#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does abi.py see what is lost, gained and private? It looks at small libraries made for the
purpose.

usage: tst_abi.py CXX_COMPILER
"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import abi

COMPILER = sys.argv[1]
PUBLIC = """#include <vector>
#define API __attribute__((visibility("default")))
struct API QPlcThing { QPlcThing(); virtual ~QPlcThing(); void one(); std::vector<int> m_values; };
QPlcThing::QPlcThing() { m_values.push_back(1); }
QPlcThing::~QPlcThing() = default;
void QPlcThing::one() {}
namespace qplc { void inside() {} struct Inside { virtual void call(); }; void Inside::call() {} }
"""


class Lists(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        (self.root / "abi").mkdir()
        self.library = self.root / "libQtPlcThing.so.1"
        self.build(PUBLIC)
        abi.main(["--renew", self.root, self.library])

    def build(self, text, *options):
        subprocess.run(
            [COMPILER, "-x", "c++", "-", "-shared", "-fPIC", "-fvisibility=hidden", *options, "-o", self.library],
            input=text,
            text=True,
            check=True,
        )

    def report(self):
        return abi.compare(self.root, self.library)

    def test_the_same_library_is_as_listed(self):
        self.assertEqual(self.report(), [])

    def test_the_list_is_the_public_api_alone(self):
        names = (self.root / "abi/QtPlcThing.txt").read_text().splitlines()
        self.assertIn("QPlcThing::QPlcThing()", names)
        self.assertEqual([name for name in names if "QPlcThing" not in name], [])

    def test_lost_and_gained_names_are_told_apart(self):
        self.build(PUBLIC.replace("one()", "two()"))
        report = self.report()
        self.assertEqual(report[0], "QtPlcThing has lost QPlcThing::one()")
        self.assertEqual(report[1], "QtPlcThing has gained QPlcThing::two()")

    def test_private_names_are_found(self):
        self.build(PUBLIC, "-fvisibility=default")
        report = self.report()
        self.assertIn("QtPlcThing exports the private qplc::inside()", report)
        self.assertIn("QtPlcThing exports the private vtable for qplc::Inside", report)

    def test_private_classes_of_public_ones_are_found(self):
        self.build(
            PUBLIC.replace("void one();", "void one(); struct Private { void call(); };")
            + "void QPlcThing::Private::call() {}"
        )
        self.assertIn("QtPlcThing exports the private QPlcThing::Private::call()", self.report())

    def test_arguments_may_be_private(self):
        self.build(
            PUBLIC.replace("void one();", "void one(); void three(qplc::Inside &);").replace(
                "#define", "namespace qplc { struct Inside; }\n#define"
            )
            + "void QPlcThing::three(qplc::Inside &) {}"
        )
        self.assertEqual(self.report()[0], "QtPlcThing has gained QPlcThing::three(qplc::Inside&)")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
