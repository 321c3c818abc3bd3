// SPDX-License-Identifier: Apache-2.0
#include "DerivedSignals.h"

#include <iterator>

namespace qplc {

DerivedSignals::DerivedSignals(PlantList *plants, QObject *parent)
    : QObject(parent)
    , m_plants(plants)
{
    m_filler.setInterval(0);
    connect(&m_filler, &QTimer::timeout, this, &DerivedSignals::fillSlice);
}

bool DerivedSignals::isTrue(const Entry &entry) const
{
    return !entry.derived.expired() && m_plants->indexOf(entry.plant) >= 0 && entry.plant->store() == entry.source
        && entry.plant->table().hash() == entry.tableHash;
}

DerivedSignals::Result DerivedSignals::find(const QString &text, const QString &pin)
{
    Result result;
    const Formula formula = Formula::read(text, m_plants->names(), &result.error);
    if (!formula.isValid())
        return result;
    const Operands operands = resolve(formula, pin);
    result.plant = operands.plant;
    result.error = operands.error;
    result.unit = formula.unit(operands.units);
    if (!result.error.isEmpty())
        return result;
    const auto known = m_entries.constFind({operands.plant, text});
    if (known != m_entries.constEnd() && isTrue(*known)) {
        result.derived = known->derived.lock();
        return result;
    }
    const SignalStore *source = operands.plant->store();
    result.derived = std::make_shared<DerivedSignal>(formula, operands.channels, *source);
    const bool isFilled = result.derived->follow(*source, sliceRows);
    m_entries.insert({operands.plant, text},
                     {result.derived, operands.plant, source, operands.plant->table().hash(), isFilled});
    if (!isFilled)
        m_filler.start();
    return result;
}

DerivedSignals::Operands DerivedSignals::resolve(const Formula &formula, const QString &pin) const
{
    Operands found;
    if (formula.operands().isEmpty())
        found.error = formula.errorAt(0, tr("a formula needs a signal, for its times"));
    for (const Formula::Operand &operand : formula.operands()) {
        const QString error = resolveOperand(formula, operand, pin, &found);
        if (!error.isEmpty()) {
            found.error = error;
            break;
        }
    }
    return found;
}

/// \return what is wrong
QString DerivedSignals::resolveOperand(const Formula &formula, const Formula::Operand &operand, const QString &pin,
                                       Operands *found) const
{
    const QString name = operand.reference.toString();
    const PlantList::Signal signal = m_plants->resolve(operand.reference, pin);
    if (!signal || !signal.plant->store())
        return formula.errorAt(operand.place, tr("there is no signal %1 at the moment").arg(name));
    if (found->plant && found->plant != signal.plant)
        return formula.errorAt(
            operand.place,
            tr("%1 is of plant %2, signals before it are of %3; all signals of a formula have to be of one plant")
                .arg(name, signal.plant->name(), found->plant->name()));
    found->plant = signal.plant;
    std::vector<int> channels;
    const bool isWhole = signal.channel() == ChannelMap::NoChannel && signal.definition().type.isNumeric();
    if (isWhole && operand.isNorm) {
        for (int element = 0; element < signal.definition().type.count(); ++element)
            channels.push_back(signal.plant->values().channels().channel(signal.index, element));
    } else if (isWhole) {
        return formula.errorAt(operand.place,
                               tr("%1 has %2 elements; choose one, %1[0], or take norm(%1)")
                                   .arg(name)
                                   .arg(signal.definition().type.count()));
    } else if (signal.channel() == ChannelMap::NoChannel) {
        return formula.errorAt(operand.place, tr("%1 is not a number").arg(name));
    } else {
        channels.push_back(signal.channel());
    }
    found->channels.push_back(channels);
    found->units << signal.definition().unit;
    return {};
}

void DerivedSignals::forget(const Plant *plant)
{
    for (auto entry = m_entries.begin(); entry != m_entries.end();)
        entry = entry->plant == plant ? m_entries.erase(entry) : std::next(entry);
}

void DerivedSignals::forgetStale()
{
    for (auto entry = m_entries.begin(); entry != m_entries.end();)
        entry = isTrue(*entry) ? std::next(entry) : m_entries.erase(entry);
}

int DerivedSignals::count() const
{
    int alive = 0;
    for (const Entry &entry : m_entries)
        alive += entry.derived.expired() ? 0 : 1;
    return alive;
}

void DerivedSignals::update(Plant *plant)
{
    forgetStale();
    for (Entry &entry : m_entries) {
        const std::shared_ptr<DerivedSignal> derived = entry.derived.lock();
        if (!derived || entry.plant != plant || !entry.isFilled)
            continue;
        entry.isFilled = derived->follow(*entry.source, sliceRows);
        if (!entry.isFilled)
            m_filler.start();
    }
}

/// One slice of the first that has not all of its past.
void DerivedSignals::fillSlice()
{
    forgetStale();
    for (Entry &entry : m_entries) {
        const std::shared_ptr<DerivedSignal> derived = entry.derived.lock();
        if (!derived || entry.isFilled)
            continue;
        entry.isFilled = derived->follow(*entry.source, sliceRows);
        Q_EMIT filled();
        return;
    }
    m_filler.stop();
}

}  // namespace qplc
