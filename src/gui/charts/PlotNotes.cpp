// SPDX-License-Identifier: Apache-2.0
#include "PlotNotes.h"

#include "gui/models/EventLogModel.h"

#include <algorithm>

namespace qplc {

namespace {

constexpr PlotNotes::Time nanosecondsOfTime = 1'000'000;

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
    bool isChanged = false;
    for (int row = m_newest.isValid() ? m_newest.row() + 1 : 0; row < events->rowCount(); ++row) {
        const QModelIndex index = events->index(row, 0);
        if (!index.data(QPlcPanelContext::NoteRole).toBool())
            continue;
        const QString source = index.siblingAtColumn(EventLogModel::Source).data().toString();
        const bool isAdded = add({{index.data(QPlcPanelContext::EventTimeRole).toLongLong() * nanosecondsOfTime,
                                   index.siblingAtColumn(EventLogModel::Text).data().toString()},
                                  source.section(QLatin1Char('/'), 0, 0)});
        isChanged = isChanged || isAdded;
    }
    m_newest = events->index(events->rowCount() - 1, 0);
    return isChanged;
}

/// A master may tell an older one later. \return false: it is older than all of very many
bool PlotNotes::add(Entry entry)
{
    const auto behind = std::upper_bound(m_entries.begin(), m_entries.end(), entry,
                                         [](const Entry &a, const Entry &b) { return a.note.time < b.note.time; });
    if (m_entries.size() == MostKept && behind == m_entries.begin())
        return false;
    m_entries.insert(behind, std::move(entry));
    if (m_entries.size() > MostKept)
        m_entries.erase(m_entries.begin());
    return true;
}

std::vector<PlotNotes::Note> PlotNotes::between(Time begin, Time end, const QStringList &plants, int most) const
{
    std::vector<Note> found;
    for (const Entry &entry : m_entries) {
        if (entry.note.time >= begin && entry.note.time <= end && plants.contains(entry.plant))
            found.push_back(entry.note);
    }
    if (found.size() > std::size_t(most))
        found.erase(found.begin(), found.end() - most);
    return found;
}

}  // namespace qplc
