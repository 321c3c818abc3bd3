// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

namespace qplc {

/// How well a text fits what a person types: the letters have to occur in this order, in any case,
/// and what is typed with blanks, word by word.
/// \return greater for a better fit (whole runs, begins of words, short texts); < 0: no fit.
///         Everything fits an empty pattern.
int fuzzyScore(const QString &pattern, const QString &text);

}  // namespace qplc
