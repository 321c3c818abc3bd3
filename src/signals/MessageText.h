// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QStringList>

namespace qplc {

/// 'text' for a message: a long text is shortened, control characters become '?'.
QString quoted(const QString &text);

/// Those of \a candidates that look like \a name, closest first, at most \a count: few letters differ (upper and lower
/// case are the same here), and hardly more than in the closest; when there are none, those that begin like it.
QStringList closeNames(const QString &name, const QStringList &candidates, int count = 3);

/// "; did you mean 'a' or 'b'?"; empty when \a names is empty.
QString didYouMean(const QStringList &names);

/// "; known are: a, b and 3 more": the first of \a names, sorted; "; there is none" when it is empty.
QString knownAre(QStringList names);

}  // namespace qplc
