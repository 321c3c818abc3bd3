// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QHash>
#include <QtCore/QObject>
#include <QtCore/QTimer>

#include <cstdint>
#include <functional>

namespace qplc {

class Journal;

/// Signals of which the master refuses values: an alarm for each, from the first refused value
/// until none has been refused for a second. However often that is, the journal gets two lines.
///
/// Threads: that of the master. What the cycle thread counts is looked at a few times a second,
/// while there is an alarm.
class RefusedValues : public QObject
{
public:
    static constexpr std::int64_t CalmTime = 1'000'000'000;  // [ns]

    /// Values of a signal that were refused since the phase began.
    using Count = std::function<std::uint64_t(QPlcSignalIndex signal)>;

    RefusedValues(Journal &journal, Count count);

    /// \param node  that wrote it \param what  "12 is above its maximum 10"
    void refused(QPlcSignalIndex signal, const QString &name, const QString &node, const QString &what);
    /// The phase is over, and all counts begin anew.
    void end();

private:
    struct Row
    {
        QString name;
        QString node;
        QString last;         // what was wrong
        std::uint64_t count;  // at the last look
        std::int64_t since;   // [ns] when it was another one
    };

    void look();
    void clear(QPlcSignalIndex signal, const Row &row);

    Journal &m_journal;
    Count m_count;
    QHash<QPlcSignalIndex, Row> m_rows;            // that last
    QHash<QPlcSignalIndex, std::uint64_t> m_told;  // counts of rows that are over
    QTimer m_timer;
};

}  // namespace qplc
