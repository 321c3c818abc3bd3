// SPDX-License-Identifier: Apache-2.0
#include "LimitWatch.h"

#include "gui/LimitOf.h"

#include <algorithm>
#include <limits>

namespace qplc {

double LimitWatch::Watched::excess(double value) const
{
    return std::max(double(minimum) - value, value - double(maximum));
}

void LimitWatch::setTable(const QPlcSignalTable &table, const ChannelMap &channels, const SignalStore *store)
{
    constexpr double none = std::numeric_limits<double>::infinity();
    m_watched.clear();
    m_next = store ? store->endRow() : 0;
    for (int i = 0; i < table.size(); ++i) {
        const auto signal = QPlcSignalIndex(i);
        const QPlcSignalDefinition &definition = table.at(signal);
        if (!definition.minimum.isValid() && !definition.maximum.isValid())
            continue;
        for (int element = 0; element < definition.type.count(); ++element) {
            Watched watched{};
            watched.signal = signal;
            watched.element = element;
            watched.channel = channels.channel(signal, element);
            watched.minimum = float(limitOf(definition.minimum).value_or(-none));
            watched.maximum = float(limitOf(definition.maximum).value_or(none));
            m_watched.push_back(watched);
        }
    }
}

std::vector<LimitWatch::Change> LimitWatch::check(const SignalStore &store)
{
    std::vector<Change> changes;
    const SignalStore::Row begin = std::max(m_next, store.firstRow());
    if (begin >= store.endRow())
        return changes;
    m_next = store.endRow();
    const Time newest = store.time(store.endRow() - 1);
    for (Watched &watched : m_watched) {
        if (watched.isBeyond(store.range(watched.channel, begin, store.endRow())))
            look(store, &watched, begin, &changes);
        if (watched.isOutside && newest - watched.lastOutside >= CalmTime) {
            watched.isOutside = false;
            const SignalStore::Row back = store.rowAt(watched.lastOutside + 1);
            changes.push_back(
                {watched.signal, watched.element, false, store.time(back), watched.since, watched.farthest});
        }
    }
    return changes;
}

/// Something of these rows is outside: which of them is not known yet.
void LimitWatch::look(const SignalStore &store, Watched *watched, SignalStore::Row begin, std::vector<Change> *changes)
{
    for (SignalStore::Row row = begin; row < store.endRow(); ++row) {
        const auto value = double(store.value(watched->channel, row));
        if (!(watched->excess(value) > 0.0))
            continue;
        watched->lastOutside = store.time(row);
        if (!watched->isOutside) {
            watched->isOutside = true;
            watched->since = store.time(row);
            watched->farthest = value;
            changes->push_back({watched->signal, watched->element, true, watched->since, watched->since, value});
        } else if (watched->excess(value) > watched->excess(watched->farthest)) {
            watched->farthest = value;
        }
    }
}

}  // namespace qplc
