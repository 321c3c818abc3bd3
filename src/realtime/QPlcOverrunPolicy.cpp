// SPDX-License-Identifier: Apache-2.0
#include "QPlcOverrunPolicy.h"

namespace {

const QLatin1String CatchUpPrefix("catch-up:");

QPlcOverrunPolicy readCatchUp(const QString &text, QString *error)
{
    const QPlcOverrunPolicy policy = QPlcOverrunPolicy::catchUp(text.mid(CatchUpPrefix.size()).toInt());
    if (policy.isValid() && policy.toString() == text)  // toInt() alone would also read "+3" and " 3"
        return policy;
    *error = QStringLiteral("overrun policy '%1': use catch-up:N with N = 1 ... %2")
                 .arg(text)
                 .arg(QPlcOverrunPolicy::MaximumCatchUp);
    return {};
}

}  // namespace

QPlcOverrunPolicy QPlcOverrunPolicy::fromString(const QString &text, QString *error)
{
    QString unheard;
    QString &reason = error ? *error : unheard;
    reason.clear();
    for (const QPlcOverrunPolicy policy : {skipToGrid(), shift(), stop()}) {
        if (text == policy.toString())
            return policy;
    }
    if (text.startsWith(CatchUpPrefix))
        return readCatchUp(text, &reason);
    reason = QStringLiteral("overrun policy '%1': use skip, catch-up:N, shift or stop").arg(text);
    return {};
}

QString QPlcOverrunPolicy::toString() const
{
    switch (m_kind) {
    case SkipToGrid:
        return QStringLiteral("skip");
    case CatchUp:
        return CatchUpPrefix + QString::number(m_cycles);
    case Shift:
        return QStringLiteral("shift");
    case Stop:
        return QStringLiteral("stop");
    }
    return {};
}
