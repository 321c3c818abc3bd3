// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "HeldKeys.h"
#include "ManualBindings.h"
#include "gui/panel/SignalControl.h"
#include "gui/panel/ValueStream.h"

#include <map>
#include <memory>

namespace qplc {

/// Flies by keys and axes: while they are held or deflected, signals have their values; else they
/// are neutral. Writes only while this window has control of all of the signals.
///
/// A dead man's handle: letGo() is to be called when the keyboard goes elsewhere or nobody sees
/// what is done. When control or the connection is lost, everything counts as let go, and the
/// master itself sets neutral.
class ManualControl : public QObject
{
    Q_OBJECT
public:
    explicit ManualControl(QObject *parent = nullptr);

    void setContext(QPlcPanelContext *context) { m_control.setContext(context); }
    void setPlants(PlantList *plants) { m_control.setPlants(plants); }
    void setBindings(const ManualBindings &bindings);
    const ManualBindings &bindings() const { return m_bindings; }
    SignalControl &control() { return m_control; }
    const SignalControl &control() const { return m_control; }
    bool isFlying() const { return m_control.state() == SignalControl::Mine; }

    /// Counts while this window has control. \return whether the key is one of the bindings
    /// \param place  as for HeldKeys
    bool press(int key, bool isAutoRepeat, quint32 place = 0);
    bool release(int key, bool isAutoRepeat, quint32 place = 0);
    bool isHeld(int key) const { return m_keys.contains(key); }
    bool isBound(int key) const;

    /// \param deflection  -1 ... 1, to the right and upwards; counts while the axes are armed
    void moveAxis(const QString &axis, double deflection);
    double deflection(const QString &axis) const;
    void setArmed(bool armed);
    bool isArmed() const { return m_isArmed; }

    /// All keys count as released until they are pressed again, and the axes are not armed any
    /// more.
    void letGo();

    /// What the signal should have now: the sum of keys and axes, within its limits; neutral
    /// without any.
    double wanted(const SignalReference &reference) const;

Q_SIGNALS:
    /// Keys, axes, or whether they are armed.
    void moved();

private:
    void controlChanged();
    void write();
    static bool isMine(const PlantList::Signal &signal);
    QPlcValue wholeOf(const PlantList::Signal &signal) const;
    ValueStream &streamTo(Plant *plant);

    ManualBindings m_bindings;
    SignalControl m_control;
    HeldKeys m_keys;
    std::map<QString, double> m_deflections;
    bool m_isArmed = false;
    bool m_wasFlying = false;
    QHash<QString, double> m_sent;  // by reference
    std::map<Plant *, std::unique_ptr<ValueStream>> m_streams;
};

}  // namespace qplc
