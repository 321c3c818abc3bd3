// SPDX-License-Identifier: Apache-2.0
#include "EventKeeper.h"

#include "node/Logging.h"
#include "node/cycle/NodeRegistry.h"
#include "protocol/messages/StoredEvent.h"

#include <QtCore/QDateTime>
#include <QtCore/QFileInfo>

namespace qplc {

namespace {

QString alarmName()
{
    return QStringLiteral("event file");
}

messages::StoredEvent storedOf(const JournalEvent &event, quint64 session)
{
    messages::StoredEvent stored;
    static_cast<messages::EventEntry &>(stored) = toEntry(event);
    stored.utc = QDateTime::fromMSecsSinceEpoch(event.time / 1'000'000, Qt::UTC).toString(Qt::ISODateWithMs);
    stored.monotonic = double(event.monotonic / 1000) * 1e-6;
    stored.run = session;
    stored.address = event.address;
    return stored;
}

}  // namespace

EventKeeper::EventKeeper(Journal &journal, Master master)
    : m_journal(journal)
    , m_master(std::move(master))
    , m_report(std::make_shared<EventFile::SharedReport>())
{
    m_timer.setInterval(1000);
    connect(&m_timer, &QTimer::timeout, this, &EventKeeper::check);
    connect(&journal, &Journal::appended, this, &EventKeeper::keep);
}

void EventKeeper::setFile(const QString &path)
{
    m_isSet = true;
    m_writer.reset();
    m_timer.stop();
    m_path.clear();
    if (!path.isEmpty())
        begin({QFileInfo(path).absoluteFilePath(), false});
}

void EventKeeper::begin(const EventFile::Place &place)
{
    m_path = place.path;
    m_report = std::make_shared<EventFile::SharedReport>();
    m_lostTold = m_written = 0;
    m_removedTold = 0;
    setOutput(std::make_unique<EventFile>(place, m_report));
}

void EventKeeper::setOutput(std::unique_ptr<LogOutput> output)
{
    m_writer = std::make_unique<LogWriter>(std::move(output));
    m_timer.start();
    keep();
}

QString EventKeeper::file() const
{
    const QString open = m_report->report().path;
    return m_writer && !open.isEmpty() ? open : m_path;
}

void EventKeeper::keep()
{
    if (!m_writer && !m_isSet) {
        if (const std::optional<EventFile::Place> usual = m_master.usualPlace())
            begin(*usual);
        return;  // begin() has kept them
    }
    if (!m_writer)
        return;
    const quint64 newest = m_journal.events().newest();
    for (const JournalEvent &event : m_journal.events().after(m_kept, EventLog::Capacity)) {
        messages::StoredEvent stored = storedOf(event, m_master.session);
        if (event.sequence == newest)
            stored.cycle = m_master.cycle();  // older ones are of another time
        m_writer->write(stored.toLine());
    }
    m_kept = newest;
}

/// Whether the disk does not take what waits for it.
bool EventKeeper::isStuck()
{
    const quint64 written = m_writer->written();
    const bool isResting = !m_writer->flush(0) && written == m_written;
    m_rests = isResting ? m_rests + 1 : 0;
    m_written = written;
    return m_rests >= mostRests;
}

/// Why events are not in the file; empty: all of them are.
QString EventKeeper::trouble(const EventFile::Report &report, quint64 lost)
{
    if (isStuck())
        return QStringLiteral("%1: the disk takes nothing").arg(m_path);
    if (report.fails)
        return report.problem;
    if (lost == m_lostTold || m_isRaised)
        return {};
    return report.problem.isEmpty() ? QStringLiteral("%1: the disk was too slow").arg(m_path) : report.problem;
}

void EventKeeper::check()
{
    const EventFile::Report report = m_report->report();
    const quint64 lost = report.lost + m_writer->dropped();
    const QString problem = trouble(report, lost);
    if (report.removed > std::exchange(m_removedTold, report.removed))
        m_journal.tell(JournalEvent::Warning, JournalEvent::State, NodeRegistry::masterName(),
                       QStringLiteral("the last event in %1 was incomplete and was removed (%2 bytes): computer or "
                                      "master ended while it was written")
                           .arg(report.path)
                           .arg(report.removed));
    if (!problem.isEmpty() && !std::exchange(m_isRaised, true)) {
        m_journal.raise(alarmName(), JournalEvent::Warning, JournalEvent::State, NodeRegistry::masterName(),
                        QStringLiteral("events are lost when the master ends, because their file cannot be written: %1")
                            .arg(problem));
    } else if (problem.isEmpty() && std::exchange(m_isRaised, false)) {
        m_journal.clear(
            alarmName(),
            QStringLiteral("events are written to %1 again; %2 are missing in it").arg(file()).arg(lost - m_lostTold));
        m_lostTold = lost;
    }
}

}  // namespace qplc
