// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPanelContext.h"
#include "QPlcSignalControl.h"
#include "gui/models/SteadyPrefix.h"

#include <optional>

namespace qplc {

/// The signal that a setter writes: its limits, its actual value, and the ways to write it.
class SetterTarget : public QObject
{
    Q_OBJECT
public:
    /// \param context  of the panel; outlives this
    explicit SetterTarget(QPlcPanelContext *context, QObject *parent = nullptr);

    /// \param reference  empty: none
    void setSignal(const QString &reference);
    QString reference() const { return m_control.signalNames().value(0); }
    /// Limits of this setter, within those of the table; empty: those of the table.
    void setLimits(std::optional<double> minimum, std::optional<double> maximum);
    QPlcSignalControl &control() { return m_control; }
    const QPlcSignalControl &control() const { return m_control; }

    /// What is written; false: it is not there.
    const QPlcPanelContext::Signal &signal() const { return m_signal; }
    /// The plant of the signal.
    QPlcPanelContext::Plant plant() const { return m_context->plant(m_signal.plant); }
    bool isNumber() const;
    /// Of the table, as people read it: what is typed has it.
    QString unit() const;
    /// A number to read, with its unit: "15.00 kN". The prefix is that of the range; without one,
    /// that of the actual values.
    QString reading(double number, int digits) const;
    /// Call it for each text of an actual value.
    void renewPrefix();
    std::optional<double> minimum() const;
    std::optional<double> maximum() const;
    bool hasRange() const { return minimum() && maximum(); }
    /// Of the range 1 %; without one of the size of \a value, at least of 1.
    double smallStep(double value) const;
    /// As near to \a value as the limits allow. \param message what was wrong with it, else
    /// untouched
    double clamped(double value, QString *message = nullptr) const;

    QPlcValue actual() const { return m_signal.value; }
    /// NaN: it is none, or not known yet.
    double actualNumber() const;
    double neutral() const;

    /// Sends one value, each time it is called. \return false: it is no value of the type of the
    /// signal
    bool sendOnce(const QPlcValue &value) { return m_control.send(reference(), value); }
    bool sendOnce(double number) { return sendOnce(QPlcValue(clamped(number))); }
    /// Sends the newest of values that change quickly.
    void stream(double number) { m_control.set(reference(), clamped(number)); }

    /// Begins to write for a while. \return false: this window may not write
    bool beginAction(double number) { return isNumber() && m_control.hold(reference(), clamped(number)); }
    /// Ends that: neutral, as the last that is sent.
    void endAction() { m_control.endHold(); }
    bool isActing() const { return m_control.isHolding(); }

Q_SIGNALS:
    /// Signal, limits, who writes, or whether the plant is there.
    void changed();
    /// There may be a new actual value.
    void updated();

private:
    void look() { m_signal = m_context->signal(reference()); }

    QPlcPanelContext *m_context;
    QPlcSignalControl m_control;
    QPlcPanelContext::Signal m_signal;
    SteadyPrefix m_prefix;  // of actual values
    std::optional<double> m_minimum;
    std::optional<double> m_maximum;
};

}  // namespace qplc
