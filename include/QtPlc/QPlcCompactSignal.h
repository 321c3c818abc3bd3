// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPort.h"
#include "QPlcValue.h"

/// A port without a type of its own: it has the type of its signal. Use it like a variable.
///
/// \code
/// class Winch : public QPlcCompactSlaveNode
/// {
/// public:
///     Winch() : QPlcCompactSlaveNode("Winch") {}
///
/// private:
///     QPlcCompactSignal m_speed{"tetherSpeed", QPlcCompactSignal::Input, this};     // [m/s]
///     QPlcCompactSignal m_length{"tetherLength", QPlcCompactSignal::Output, this};  // [m]
///     void step(const QPlcCycle &cycle) override { m_length = m_length + m_speed * cycle.dt(); }
/// };
/// \endcode
///
/// A value that does not fit the signal (three numbers for one, a text for a number) is a fault of
/// the node: the cycle fails, the node goes to its safe state, and QPlcSlaveNode::errorString()
/// says why. Arrays of more than 24 bytes and texts allocate memory in each cycle: use QPlcInput
/// and QPlcOutput for them.
///
/// \threadsafe no: see QPlcPort
///
/// \ingroup nodes
class QTPLC_EXPORT QPlcCompactSignal final : public QPlcPort
{
public:
    /// Registers the port at its node.
    /// \param name  of the signal; copied
    /// \param direction  Input or Output
    /// \param node  outlives the port; not null, and not registered at a master yet
    /// \param timing  which value an input reads: of the last cycle (default) or of the same cycle
    QPlcCompactSignal(const char *name, Direction direction, QPlcCompactSlaveNode *node,
                      QPlcInputTiming::Value timing = QPlcInputTiming::LastCycle);
    /// Ends the cycles of the node and removes the port from it.
    ~QPlcCompactSignal() override;

    /// Sets the value. It is converted to the type of the signal when the node answers.
    QPlcCompactSignal &operator=(const QPlcValue &value)
    {
        m_value = value;
        return *this;
    }
    /// Sets the value from a number, an array or a text: see the constructors of QPlcValue.
    template<typename T>
    QPlcCompactSignal &operator=(const T &value)
    {
        m_value = QPlcValue(value);
        return *this;
    }
    /// Sets the value to that of \a other; the port keeps its own signal.
    QPlcCompactSignal &operator=(const QPlcCompactSignal &other) { return *this = other.m_value; }

    /// Returns the value as a number, of an array the first element; 0 for a text.
    operator double() const { return m_value.toReal(); }
    /// Returns an element of an array, from 0; 0 when there is no such element.
    double operator[](int element) const { return m_value.toReal(element); }
    /// Returns the value. It is invalid before the node is registered.
    const QPlcValue &value() const { return m_value; }

private:
    QString variableType() const override;
    bool accepts(QPlcSignalType type) const override;
    void attach(QPlcSignalType type) override;
    void load(const char *bytes) override;
    void store(char *bytes) const override;

    QPlcSignalType m_type;
    QPlcValue m_value;
};
