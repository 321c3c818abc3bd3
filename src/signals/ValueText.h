// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

namespace qplc {

/// The shortest text that realFromText() reads back with the same bits ("nan" for every NaN).
QString realText(double value);
QString realText(float value);
/// Reads "-1.5", "2e-3", "nan", "inf", "-inf" (the words in any case). False for anything else; a
/// number that is too large becomes an infinity, and then \a tooLarge is true.
bool realFromText(const QString &text, double *value, bool *tooLarge);

/// Reads an integer with an optional sign. False for anything else.
bool isIntegerText(const QString &text);

/// ISO 8601 in UTC with as many of nine fractional digits as are needed: "2026-01-31T12:00:00.5Z".
/// \param time  ns since 1970-01-01 UTC
QString timeText(qint64 time);
/// \return false when \a text is no such time, or none that 64 bits of nanoseconds can hold (1677
///         ... 2262)
bool timeFromText(const QString &text, qint64 *time);

}  // namespace qplc
