// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtTest/QtTest>

#include <cmath>

/// Fails the test, with both numbers, unless |actual - expected| <= tolerance.
#define COMPARE_NEAR(actual, expected, tolerance)                                                                      \
    do {                                                                                                               \
        const double actualValue = (actual), expectedValue = (expected);                                               \
        QVERIFY2(std::abs(actualValue - expectedValue) <= (tolerance),                                                 \
                 qPrintable(QStringLiteral(#actual " is %1, expected %2")                                              \
                                .arg(actualValue, 0, 'g', 12)                                                          \
                                .arg(expectedValue, 0, 'g', 12)));                                                     \
    } while (false)

/// Fails the test unless the text contains the part; shows the text.
#define VERIFY_CONTAINS(text, part)                                                                                    \
    do {                                                                                                               \
        const std::string wholeText = (text);                                                                          \
        QVERIFY2(wholeText.find(part) != std::string::npos, wholeText.c_str());                                        \
    } while (false)
