// SPDX-License-Identifier: Apache-2.0
#include "SignalReference.h"

#include <QtCore/QRegularExpression>

namespace qplc {

SignalReference SignalReference::fromString(const QString &text, QString *error)
{
    // The name of a plant may be an address, and hold "/" itself; that of a signal does not.
    static const QRegularExpression form(
        QStringLiteral("^(?:(.+)/)?([\\p{L}_][\\p{L}\\p{N}_.]{0,62})(?:\\[([0-9]{1,4})\\])?$"));
    const QRegularExpressionMatch match = form.match(text.trimmed());
    if (error)
        error->clear();
    if (!match.hasMatch()) {
        if (error)
            *error
                = QStringLiteral("'%1' is not the name of a signal; write signal, signal[2] or plant/signal").arg(text);
        return {};
    }
    SignalReference reference;
    reference.plant = match.captured(1);
    reference.signal = match.captured(2);
    if (match.capturedLength(3) > 0)
        reference.element = match.captured(3).toInt();
    return reference;
}

QString SignalReference::toString() const
{
    const QString prefix = plant.isEmpty() ? QString() : plant + QLatin1Char('/');
    const QString suffix = element == Whole ? QString() : QStringLiteral("[%1]").arg(element);
    return prefix + signal + suffix;
}

}  // namespace qplc
