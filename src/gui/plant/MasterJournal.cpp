// SPDX-License-Identifier: Apache-2.0
#include "MasterJournal.h"

#include "node/Logging.h"

#include <QtCore/QJsonArray>

namespace qplc {

namespace {

QJsonArray eventsOf(const QPlcMessage &message)
{
    return message.fields().value(QStringLiteral("events")).toArray();
}

double sequenceOf(const QJsonValue &event)
{
    return event[QStringLiteral("sequence")].toDouble();
}

PlantEvent::Severity severityOf(const QString &name)
{
    return name == QLatin1String("error")  ? PlantEvent::Error
        : name == QLatin1String("warning") ? PlantEvent::Warning
                                           : PlantEvent::Information;
}

}  // namespace

MasterJournal::MasterJournal(ControlChannel &control, QObject *parent)
    : QObject(parent)
    , m_control(control)
{
}

void MasterJournal::begin(quint64 session, bool hasFeature)
{
    if (session != m_session) {
        m_newest = 0.0;
        endAlarms();
    }
    m_session = session;
    m_hasFeature = hasFeature;
    if (hasFeature)
        fetch();
}

void MasterJournal::end()
{
    m_hasFeature = false;
    m_pushed.clear();
    endFetching();
}

void MasterJournal::fetch()
{
    m_isFetching = true;
    m_control.ask(QPlcMessage(QPlcMessage::GetEvents, {{QStringLiteral("since"), m_newest}}),
                  [this](const QPlcMessage &answer) { takeFetched(answer); });
}

void MasterJournal::takeFetched(const QPlcMessage &answer)
{
    if (!m_isFetching)
        return;  // of a connection that is gone
    const double before = m_newest;
    if (answer.kind() == QPlcMessage::Events)
        tellNew(answer);
    if (answer.fields().value(QStringLiteral("more")).toBool() && m_newest > before)
        fetch();
    else
        endFetching();
}

void MasterJournal::endFetching()
{
    if (!m_isFetching)
        return;
    m_isFetching = false;
    const QVector<QPlcMessage> pushed = m_pushed;
    m_pushed.clear();
    for (const QPlcMessage &message : pushed)
        tellNew(message);
    Q_EMIT fetched();
}

void MasterJournal::take(const QPlcMessage &message)
{
    if (!m_hasFeature)
        return;
    const QJsonArray events = eventsOf(message);
    const bool isBehind = !events.isEmpty() && sequenceOf(events.first()) > m_newest + 1.0;
    if (m_isFetching || isBehind)
        m_pushed.append(message);
    if (!m_isFetching && isBehind)
        fetch();  // this window took nothing in for a while: what it missed comes first
    else if (!m_isFetching)
        tellNew(message);
}

void MasterJournal::tellNew(const QPlcMessage &message)
{
    const QJsonArray events = eventsOf(message);
    for (const QJsonValue &event : events) {
        if (sequenceOf(event) <= m_newest)
            continue;
        m_newest = sequenceOf(event);
        tell(event.toObject());
    }
}

void MasterJournal::tell(const QJsonObject &event)
{
    const auto text = [&](const char *field) { return printable(event.value(QLatin1String(field)).toString()); };
    const quint64 time = text("time").toULongLong(nullptr, 16);  // [ns since 1970]
    const QString source = text("source");
    PlantEvent told{QDateTime::fromMSecsSinceEpoch(qint64(time / 1'000'000)), severityOf(text("severity")),
                    source == QLatin1String("Master") ? QString() : source, text("text"), false};
    told.alarm = text("alarm");
    told.isStateChange = text("kind") == QLatin1String("state");
    if (!told.alarm.isEmpty())
        told.stage = event.value(QStringLiteral("active")).toBool() ? PlantEvent::Begins : PlantEvent::Ends;
    if (told.stage == PlantEvent::Begins)
        m_alarms.insert(told.alarm, told);
    else
        m_alarms.remove(told.alarm);
    Q_EMIT happened(told);
}

/// A master that begins anew knows nothing of what lasted before.
void MasterJournal::endAlarms()
{
    for (PlantEvent event : qAsConst(m_alarms)) {
        event.time = QDateTime::currentDateTime();
        event.severity = PlantEvent::Information;
        event.text = tr("%1: over, the master has begun anew").arg(event.alarm);
        event.stage = PlantEvent::Ends;
        Q_EMIT happened(event);
    }
    m_alarms.clear();
}

}  // namespace qplc
