// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "EventFile.h"
#include "Journal.h"

namespace qplc {

/// Writes the events of a master to a file, so that they survive it: docs/design/event-files.md.
///
/// Threads: that of the master. The file has one of its own, so nothing here waits for a disk.
class EventKeeper : public QObject
{
public:
    static constexpr int mostRests = 5;  // [s] without a written line before the disk counts as hanging

    /// What a master says of itself.
    struct Master
    {
        quint64 session = 0;
        std::function<std::optional<EventFile::Place>()> usualPlace;  // nothing: it needs no file now
        std::function<std::optional<quint64>()> cycle;                // nothing: no cycle runs
    };

    /// \param journal  outlives this object
    EventKeeper(Journal &journal, Master master);

    /// From now on the events go to this file; empty: to none. Until it is called, the usual place
    /// counts.
    void setFile(const QString &path);
    /// Writes to \a output in place of a file. For tests.
    void setOutput(std::unique_ptr<LogOutput> output);
    /// Where the events go; empty: to no file.
    QString file() const;
    /// Writes what was not written yet. Called for each event; also when a file may have become
    /// necessary.
    void keep();
    /// Tells whether the file can be written to. The time calls it, too.
    void check();

private:
    void begin(const EventFile::Place &place);
    QString trouble(const EventFile::Report &report, quint64 lost);
    bool isStuck();

    Journal &m_journal;
    const Master m_master;
    bool m_isSet = false;  // somebody has set a file, or none
    std::unique_ptr<LogWriter> m_writer;
    std::shared_ptr<EventFile::SharedReport> m_report;
    QString m_path;
    QTimer m_timer;
    quint64 m_kept = 0;      // number of the newest event that the writer has
    quint64 m_lostTold = 0;  // lines
    qint64 m_removedTold = 0;
    quint64 m_written = 0;  // at the last check
    int m_rests = 0;        // checks at which nothing had been written
    bool m_isRaised = false;
};

}  // namespace qplc
