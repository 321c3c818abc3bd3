// SPDX-License-Identifier: Apache-2.0
#include "ManualControl.h"

#include <algorithm>
#include <cmath>

namespace qplc {

ManualControl::ManualControl(QPlcPanelContext *context, QObject *parent)
    : QObject(parent)
    , m_context(context)
    , m_control(context)
{
    m_control.setKeepsControl(true);  // a panel that is closed or set up anew does not stop what a person steers
    m_control.setBeginning(QPlcSignalControl::Neutral);  // a key that is not held means neutral
    connect(&m_control, &QPlcSignalControl::changed, this, &ManualControl::controlChanged);
    connect(&m_control, &QPlcSignalControl::leaving, this, [this] {
        endHold();
        m_sent.clear();
    });
}

void ManualControl::setBindings(const ManualBindings &bindings)
{
    endHold();  // neutral, while it is known of what
    m_sent.clear();
    m_bindings = bindings;
    QStringList names;
    const QVector<SignalReference> references = bindings.signalReferences();
    for (const SignalReference &reference : references)
        names << reference.toString();
    m_control.setSignals(names);
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

void ManualControl::endHold()
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
    if (!isFlying()) {
        endHold();
        m_control.setNeutral();  // what this window still holds, if another person has taken only some of it
    }
    m_sent.clear();
}

double ManualControl::wanted(const SignalReference &reference) const
{
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
    const QPlcPanelContext::Signal signal = m_context->signal(reference.toString());
    if (!signal)
        return sum;
    if (!isMoved)
        return m_control.neutral(reference.toString());
    const QPlcSignalDefinition &definition = signal.definition;
    if (definition.minimum.isValid())
        sum = std::max(sum, definition.minimum.toReal());
    return definition.maximum.isValid() ? std::min(sum, definition.maximum.toReal()) : sum;
}

/// All signals at once: the plant may not show yet what was sent of other elements of an array.
void ManualControl::write()
{
    QHash<QString, double> values;
    bool isNew = false;
    const QVector<SignalReference> references = m_bindings.signalReferences();
    for (const SignalReference &reference : references) {
        const QString name = reference.toString();
        const double neutral = m_control.neutral(name);
        if (std::isnan(neutral))  // not a number
            continue;
        values.insert(name, wanted(reference));
        isNew = isNew || m_sent.value(name, neutral) != values.value(name);
    }
    if (isNew && isFlying() && m_control.set(values))
        m_sent = values;
    Q_EMIT moved();
}

}  // namespace qplc
