// SPDX-License-Identifier: Apache-2.0
#include "StateText.h"

#include <QtCore/QDateTime>

namespace qplc {

QString stateText(const QString &name)
{
    if (name == QLatin1String("WaitingForLateSlaves"))
        return QStringLiteral("Waiting for late nodes");
    QString words;
    for (const QChar letter : name) {
        const bool isNextWord = letter.isUpper() && !words.isEmpty();
        words += isNextWord ? QLatin1Char(' ') + QString(letter.toLower()) : QString(letter);
    }
    return words;
}

QString stateText(messages::MasterState state)
{
    return state == messages::MasterState::Unknown ? QStringLiteral("Unknown")
                                                   : stateText(QString::fromLatin1(messages::nameOf(state)));
}

QString stateText(messages::ClockKind clock)
{
    return stateText(QString::fromLatin1(messages::nameOf(clock)));
}

QString transportText(const QPlcNodeInfo &node)
{
    return node.fallback ? QStringLiteral("%1 (fallback)").arg(node.transport) : node.transport;
}

QString evictedText(const messages::EvictedEntry &entry, const QDate &today)
{
    const QDateTime time = QDateTime::fromMSecsSinceEpoch(qint64(entry.time / 1'000'000));
    const QString format = time.date() == today ? QStringLiteral("HH:mm:ss") : QStringLiteral("yyyy-MM-dd HH:mm");
    return QStringLiteral("evicted by %1 at %2").arg(entry.by, time.toString(format));
}

}  // namespace qplc
