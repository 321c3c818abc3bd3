// SPDX-License-Identifier: Apache-2.0
#include "RecordingName.h"

#include "node/cycle/RingDescription.h"

#include <QtCore/QDateTime>
#include <QtCore/QRegularExpression>

namespace qplc {

namespace {

const QString timeFormat = QStringLiteral("yyyyMMdd'T'HHmmss.zzz'Z'");

}  // namespace

RecordingName RecordingName::of(const RingDescription &phase, qint64 begin)
{
    QString plant = phase.plant.left(64);
    for (QChar &sign : plant) {
        if (!sign.isLetterOrNumber() || sign.unicode() > 127)
            sign = QLatin1Char('_');
    }
    if (plant.isEmpty())
        plant = QStringLiteral("plant");
    return {begin, plant, phase.session, phase.phase, false, true};
}

std::optional<RecordingName> RecordingName::parse(const QString &fileName)
{
    static const QRegularExpression pattern(
        QStringLiteral("^(\\d{8}T\\d{6}\\.\\d{3}Z)_(\\w+)_([0-9a-f]+)_phase(\\d+)(_marked)?\\.mcap(\\.part)?$"));
    const QRegularExpressionMatch match = pattern.match(fileName);
    QDateTime time = QDateTime::fromString(match.captured(1), timeFormat);
    time.setTimeSpec(Qt::UTC);
    if (!match.hasMatch() || !time.isValid() || time.toMSecsSinceEpoch() < 0)
        return std::nullopt;
    return RecordingName{time.toMSecsSinceEpoch(),
                         match.captured(2),
                         match.captured(3).toULongLong(nullptr, 16),
                         match.captured(4).toULongLong(),
                         !match.captured(5).isEmpty(),
                         !match.captured(6).isEmpty()};
}

QString RecordingName::toString() const
{
    return QStringLiteral("%1_%2_%3_phase%4")
               .arg(QDateTime::fromMSecsSinceEpoch(begin, Qt::UTC).toString(timeFormat), plant,
                    QString::number(session, 16), QString::number(phase))
        + QLatin1String(isMarked ? "_marked.mcap" : ".mcap") + QLatin1String(isUnfinished ? ".part" : "");
}

bool RecordingName::isOfSamePhase(const RecordingName &other) const
{
    return plant == other.plant && session == other.session && phase == other.phase;
}

}  // namespace qplc
