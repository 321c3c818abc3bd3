// SPDX-License-Identifier: Apache-2.0
#include "ManualControl.h"

#include <algorithm>

namespace qplc {

ManualControl::ManualControl(QObject *parent)
    : QObject(parent)
{
    m_control.setBeginning(SignalControl::Neutral);  // a key that is not held means neutral
    connect(&m_control, &SignalControl::changed, this, &ManualControl::controlChanged);
    connect(&m_control, &SignalControl::leaving, this, [this] {
        letGo();
        for (const auto &stream : m_streams)
            stream.second->flush();  // neutral, for the plant that is left
    });
    connect(&m_control, &SignalControl::signalsChanged, this, [this] {
        m_streams.clear();  // some of their plants may be gone
        letGo();
        m_sent.clear();
    });
}

void ManualControl::setBindings(const ManualBindings &bindings)
{
    letGo();  // neutral, while it is known of what
    m_bindings = bindings;
    m_control.setSignals(bindings.signalReferences());
    Q_EMIT moved();
}

bool ManualControl::isBound(int key) const
{
    return key != 0 && std::any_of(m_bindings.keys.begin(), m_bindings.keys.end(), [key](const KeyBinding &binding) {
               return binding.key == key;
           });
}

bool ManualControl::press(int key, bool isAutoRepeat, quint32 place)
{
    if (!isBound(key))
        return false;
    if (isFlying() && m_keys.press(key, isAutoRepeat, place))
        write();
    return true;
}

bool ManualControl::release(int key, bool isAutoRepeat, quint32 place)
{
    const bool wasHeld = m_keys.release(key, isAutoRepeat, place);
    if (wasHeld)
        write();
    return wasHeld || isBound(key);
}

void ManualControl::moveAxis(const QString &axis, double deflection)
{
    m_deflections[axis] = deflection;
    write();
}

double ManualControl::deflection(const QString &axis) const
{
    const auto found = m_deflections.find(axis);
    return found == m_deflections.end() ? 0.0 : found->second;
}

void ManualControl::setArmed(bool armed)
{
    const bool isWanted = armed && isFlying();
    if (isWanted == m_isArmed)
        return;
    m_isArmed = isWanted;
    write();
}

void ManualControl::letGo()
{
    const bool held = m_keys.releaseAll();
    if (!held && !m_isArmed)
        return;
    m_isArmed = false;
    write();
}

void ManualControl::controlChanged()
{
    if (isFlying() == m_wasFlying)
        return;
    m_wasFlying = isFlying();
    if (isFlying())
        m_sent.clear();
    else
        letGo();  // also of what this window still holds, if somebody has taken only some of it
}

double ManualControl::wanted(const SignalReference &reference) const
{
    const PlantList::Signal signal = m_control.resolved().value(m_control.references().indexOf(reference));
    double sum = 0.0;
    bool isMoved = false;
    for (const KeyBinding &binding : m_bindings.keys) {
        if (binding.signal != reference || !m_keys.contains(binding.key))
            continue;
        sum += binding.value;
        isMoved = true;
    }
    for (const AxisBinding &binding : m_bindings.axes) {
        const double share = binding.signal == reference && m_isArmed ? binding.shaped(deflection(binding.axis)) : 0.0;
        sum += share * binding.value;
        isMoved = isMoved || share != 0.0;
    }
    if (!signal)
        return sum;
    if (!isMoved)
        return neutralValue(signal).toReal();
    const QPlcSignalDefinition &definition = signal.definition();
    if (definition.minimum.isValid())
        sum = std::max(sum, definition.minimum.toReal());
    return definition.maximum.isValid() ? std::min(sum, definition.maximum.toReal()) : sum;
}

ValueStream &ManualControl::streamTo(Plant *plant)
{
    std::unique_ptr<ValueStream> &stream = m_streams[plant];
    if (!stream) {
        stream = std::make_unique<ValueStream>();
        stream->setPlant(plant);
        connect(stream.get(), &ValueStream::failed, &m_control, &SignalControl::failed);
    }
    return *stream;
}

bool ManualControl::isMine(const PlantList::Signal &signal)
{
    if (!signal || !signal.plant->isConnected())
        return false;
    const std::optional<LeaseStatus> lease = signal.plant->lease(signal.definition().name);
    return lease && lease->isMine;
}

/// The value of the whole signal: all elements that are steered here as they are wanted now, as
/// what the plant has may be older than what was sent; the others as the plant has them.
QPlcValue ManualControl::wholeOf(const PlantList::Signal &signal) const
{
    QPlcValue whole = signal.plant->value(signal.index);
    for (int i = 0; i < m_control.resolved().size(); ++i) {
        const PlantList::Signal &other = m_control.resolved().at(i);
        if (other.plant != signal.plant || other.index != signal.index)
            continue;
        const QPlcValue with = wholeValue(other, wanted(m_control.references().at(i)), whole);
        if (with.isValid())
            whole = with;
    }
    return whole;
}

void ManualControl::write()
{
    std::map<Plant *, ValueStream::Values> values;
    for (int i = 0; i < m_control.resolved().size(); ++i) {
        const PlantList::Signal &signal = m_control.resolved().at(i);
        if (!isMine(signal))
            continue;
        const QString name = m_control.references().at(i).toString();
        const double number = wanted(m_control.references().at(i));
        const QPlcValue value = wholeOf(signal);
        if (m_sent.value(name, neutralValue(signal).toReal()) == number || !value.isValid())
            continue;
        m_sent[name] = number;
        values[signal.plant].insert(signal.definition().name, value);
    }
    for (const auto &of : values)
        streamTo(of.first).send(of.second);
    Q_EMIT moved();
}

}  // namespace qplc
