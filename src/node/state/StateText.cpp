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

QString recorderText(const messages::RecorderEntry &recorder)
{
    using messages::RecorderState;
    const QString error = recorder.error.isEmpty() ? QString() : QStringLiteral(": ") + recorder.error;
    switch (recorder.state) {
    case RecorderState::None:
        return QStringLiteral("nobody records");
    case RecorderState::Recording:
        return QStringLiteral("recording, %1 kB/s, %2 GB free")
            .arg(recorder.bytesPerSecond / 1e3, 0, 'f', 1)
            .arg(double(recorder.freeBytes) / 1e9, 0, 'f', 1);
    case RecorderState::DiskFull:
        return QStringLiteral("the disk of the recorder is full; it tries again each second") + error;
    case RecorderState::Failing:
        return QStringLiteral("the recorder cannot write; it tries again each second") + error;
    case RecorderState::Stalled:
        return QStringLiteral("the recorder makes no progress; its disk may stall");
    case RecorderState::Gone:
        return QStringLiteral("the recorder has ended without a word; start it again, the ring keeps the cycles until "
                              "then, as long as it has room");
    case RecorderState::Stopped:
        return QStringLiteral("recording is stopped; qtplc record start FOLDER goes on with it");
    case RecorderState::Unknown:
        break;
    }
    return QStringLiteral("unknown");
}

}  // namespace qplc
