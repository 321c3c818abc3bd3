// SPDX-License-Identifier: Apache-2.0
#include "PlotNotes.h"

#include "gui/models/EventLogModel.h"

#include <algorithm>

namespace qplc {

namespace {

constexpr PlotNotes::Time nanosecondsOfTime = 1'000'000;
constexpr std::size_t mostKeptNotes = 2000;

}  // namespace

/// The log only grows at its end; events that it forgets stay here.
bool PlotNotes::update(const QPlcPanelContext &context)
{
    const QAbstractItemModel *events = context.eventModel();
    if (!events || events->rowCount() == 0)
        return false;
    if (m_newest.isValid() && m_newest.model() != events) {
        m_newest = QPersistentModelIndex();
        m_entries.clear();
    }
    const std::size_t before = m_entries.size();
    for (int row = m_newest.isValid() ? m_newest.row() + 1 : 0; row < events->rowCount(); ++row) {
        const QModelIndex index = events->index(row, 0);
        if (!index.data(QPlcPanelContext::NoteRole).toBool() || m_entries.size() >= mostKeptNotes)
            continue;
        const QString source = index.siblingAtColumn(EventLogModel::Source).data().toString();
        m_entries.push_back({{index.data(QPlcPanelContext::EventTimeRole).toLongLong() * nanosecondsOfTime,
                              index.siblingAtColumn(EventLogModel::Text).data().toString()},
                             source.section(QLatin1Char('/'), 0, 0)});
    }
    m_newest = events->index(events->rowCount() - 1, 0);
    return m_entries.size() != before;
}

std::vector<PlotNotes::Note> PlotNotes::between(Time begin, Time end, const QStringList &plants, int most) const
{
    std::vector<Note> found;
    for (const Entry &entry : m_entries) {
        if (entry.note.time >= begin && entry.note.time <= end && plants.contains(entry.plant))
            found.push_back(entry.note);
    }
    std::stable_sort(found.begin(), found.end(), [](const Note &a, const Note &b) { return a.time < b.time; });
    if (found.size() > std::size_t(most))
        found.erase(found.begin(), found.end() - most);
    return found;
}

}  // namespace qplc
