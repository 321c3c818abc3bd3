// SPDX-License-Identifier: Apache-2.0
#include "PastValue.h"

#include <cmath>
#include <optional>

namespace qplc {

QPlcValue pastValue(const PlantList::Signal &signal, SignalStore::Time time)
{
    if (!signal || !signal.definition().type.isNumeric() || !signal.plant->store())
        return {};
    const std::optional<SignalStore::Row> row = signal.plant->store()->rowHoldingAt(time);
    if (!row)
        return {};
    const QPlcSignalType type = signal.definition().type;
    const bool isWhole = signal.element == SignalReference::Whole;
    const int count = isWhole ? type.count() : 1;
    const ChannelMap &channels = signal.plant->values().channels();
    std::vector<double> elements;
    for (int i = 0; i < count; ++i) {
        const int channel = channels.channel(signal.index, isWhole ? i : signal.element);
        const double element = double(signal.plant->store()->value(channel, *row));
        if (std::isnan(element) && !type.isReal())
            return {};
        elements.push_back(element);
    }
    const QPlcSignalType shown(type.scalar(), count);
    return QPlcValue::fromBytes(QPlcSignalType(QPlcSignalType::Real64, count), elements.data()).convertedTo(shown);
}

QPlcValue pastValue(const SignalStore &store, int channel, SignalStore::Time time)
{
    const std::optional<SignalStore::Row> row = store.rowHoldingAt(time);
    return row ? QPlcValue(double(store.value(channel, *row))) : QPlcValue();
}

}  // namespace qplc
