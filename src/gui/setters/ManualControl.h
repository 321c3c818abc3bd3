// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "HeldKeys.h"
#include "ManualBindings.h"
#include "QPlcPanelContext.h"
#include "QPlcSignalControl.h"

#include <map>

namespace qplc {

/// Flies by keys and axes: while they are held or deflected, signals have their values; else they
/// are neutral. Writes only while this window has control of all of the signals.
///
/// A dead man's handle: endHold() is to be called when the keyboard goes elsewhere or nobody sees
/// what is done. When control or the connection is lost, everything counts as let go, and the
/// master itself sets neutral.
class ManualControl : public QObject
{
    Q_OBJECT
public:
    /// \param context  of the panel; outlives this
    explicit ManualControl(QPlcPanelContext *context, QObject *parent = nullptr);

    void setBindings(const ManualBindings &bindings);
    const ManualBindings &bindings() const { return m_bindings; }
    QPlcSignalControl &control() { return m_control; }
    const QPlcSignalControl &control() const { return m_control; }
    QPlcPanelContext *context() const { return m_context; }
    bool isFlying() const { return m_control.state() == QPlcSignalControl::Mine; }

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
    void endHold();

    /// What the signal should have now: the sum of keys and axes, within its limits; neutral
    /// without any.
    double wanted(const SignalReference &reference) const;

Q_SIGNALS:
    /// Keys, axes, or whether they are armed.
    void moved();

private:
    void controlChanged();
    void write();

    QPlcPanelContext *m_context;
    ManualBindings m_bindings;
    QPlcSignalControl m_control;
    HeldKeys m_keys;
    std::map<QString, double> m_deflections;
    bool m_isArmed = false;
    bool m_wasFlying = false;
    QHash<QString, double> m_sent;  // by reference
};

}  // namespace qplc
