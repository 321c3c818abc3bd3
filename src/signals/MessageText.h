// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QStringList>

#include <functional>

namespace qplc {

/// \a text of somebody else, fit to be shown: characters that command a terminal, end a line, turn
/// or hide text, or mean nothing (as half of a pair does), have become what \a escape makes of
/// them.
QString printable(const QString &text, const std::function<QString(uint)> &escape);
/// Likewise; they have become '?'.
QString printable(const QString &text);

/// 'text' for a message: printable, and shortened when it is long.
QString quoted(const QString &text);

/// Those of \a candidates that look like \a name, closest first, at most \a count: few letters
/// differ (upper and lower case are the same here), and hardly more than in the closest; when there
/// are none, those that begin like it.
QStringList closeNames(const QString &name, const QStringList &candidates, int count = 3);

/// "; did you mean 'a' or 'b'?"; empty when \a names is empty.
QString didYouMean(const QStringList &names);

/// "a, b and 3 more": the first of \a names, at most \a most of them.
QString firstOf(const QStringList &names, int most = 8);

/// "; known are: a, b and 3 more": the first of \a names, sorted; "; there is none" when it is
/// empty.
QString knownAre(QStringList names);

}  // namespace qplc
