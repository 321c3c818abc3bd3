// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPort.h"
#include "QPlcValue.h"

/// A port without a type of its own: it takes that of the signal. Used like a variable:
///
/// ```cpp
/// QPlcCompactSignal m_speed  = QPlcCompactSignal("tetherSpeed", QPlcCompactSignal::Input, this);
/// QPlcCompactSignal m_length = QPlcCompactSignal("tetherLength", QPlcCompactSignal::Output, this);
/// ...
/// m_length = m_length + m_speed * 0.01;
/// ```
///
/// A value that does not fit the signal (three numbers for one, a text for a number) is an error of the node: the cycle fails, and errorString() says why.
class QTPLC_EXPORT QPlcCompactSignal final : public QPlcPort
{
public:
    /// \param timing  of an input
    QPlcCompactSignal(const char *name, Direction direction, QPlcCompactSlaveNode *node,
                      QPlcInputTiming::Value timing = QPlcInputTiming::LastCycle);
    ~QPlcCompactSignal() override;

    QPlcCompactSignal &operator=(const QPlcValue &value)
    {
        m_value = value;
        return *this;
    }
    template<typename T>
    QPlcCompactSignal &operator=(const T &value)
    {
        m_value = QPlcValue(value);
        return *this;
    }
    QPlcCompactSignal &operator=(const QPlcCompactSignal &other) { return *this = other.m_value; }

    /// The value, of an array the first element.
    operator double() const { return m_value.toReal(); }
    double operator[](int element) const { return m_value.toReal(element); }
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
