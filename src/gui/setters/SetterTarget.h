// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/models/SteadyPrefix.h"
#include "gui/panel/SignalControl.h"
#include "gui/panel/ValueStream.h"

#include <limits>
#include <optional>

namespace qplc {

/// The signal that a setter writes: its limits, its actual value, and the ways to write it.
class SetterTarget : public QObject
{
    Q_OBJECT
public:
    explicit SetterTarget(QObject *parent = nullptr);

    void setContext(QPlcPanelContext *context) { m_control.setContext(context); }
    void setPlants(PlantList *plants) { m_control.setPlants(plants); }
    /// \param reference  invalid: none
    void setSignal(const SignalReference &reference);
    SignalReference reference() const { return m_control.references().value(0); }
    /// Limits of this setter, within those of the table; empty: those of the table.
    void setLimits(std::optional<double> minimum, std::optional<double> maximum);
    SignalControl &control() { return m_control; }
    const SignalControl &control() const { return m_control; }

    /// What is written; false: it is not there.
    PlantList::Signal signal() const { return m_control.resolved().value(0); }
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
    /// Of the range 1 %; without one of the size of \a value, at least of 1.
    double smallStep(double value) const;
    /// As near to \a value as the limits allow. \param message what was wrong with it, else
    /// untouched
    double clamped(double value, QString *message = nullptr) const;

    QPlcValue actual() const { return signal().value(); }
    /// NaN: it is none, or not known yet.
    double actualNumber() const;
    double neutral() const;

    /// Sends one value, each time it is called.
    void sendOnce(const QPlcValue &value);
    /// \return false: it is no value of the type of the signal
    bool sendOnce(double number);
    /// Sends the newest of values that change quickly.
    void stream(double number);

    /// Begins to write for a while. A signal that nobody writes is held meanwhile, so that it goes
    /// to neutral when this window is lost. \return false: this window may not write
    bool beginAction(double number);
    /// Ends that: neutral, as the last that is sent.
    void endAction();
    bool isActing() const { return m_isActing; }

Q_SIGNALS:
    /// Signal, limits, who writes, or whether the plant is there.
    void changed();
    /// There may be a new actual value.
    void updated();
    /// This window cannot write any more, and acted.
    void actionLost();
    /// The signal is that of another plant in a moment; what was begun has ended.
    void leaving();
    void failed(const QString &sentence);

private:
    void check();
    void leave();
    QString name() const { return signal().definition().name; }

    SignalControl m_control;
    ValueStream m_stream;
    SteadyPrefix m_prefix;  // of actual values
    std::optional<double> m_minimum;
    std::optional<double> m_maximum;
    bool m_isActing = false;
    bool m_holdsForAction = false;
};

}  // namespace qplc
