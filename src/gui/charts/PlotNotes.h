// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPanelContext.h"

#include <QtCore/QPersistentModelIndex>

#include <vector>

namespace qplc {

/// The notes that people have written about plants, as the event log has them: for marks in a plot.
/// Of very many notes, the newest MostKept ones.
class PlotNotes
{
public:
    using Time = QPlcPanelContext::Time;
    static constexpr std::size_t MostKept = 2000;

    struct Note
    {
        Time time;  // [ns]
        QString text;
    };

    /// Looks whether the log has other notes. \return whether it has
    bool update(const QPlcPanelContext &context);
    /// Those of these plants in \a begin to \a end, oldest first, at most \a most: the newest ones.
    std::vector<Note> between(Time begin, Time end, const QStringList &plants, int most) const;

private:
    struct Entry
    {
        Note note;
        QString plant;
    };
    bool add(Entry entry);

    std::vector<Entry> m_entries;    // oldest first
    QPersistentModelIndex m_newest;  // event that was looked at
};

}  // namespace qplc
