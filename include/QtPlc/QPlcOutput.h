// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPort.h"

/// A value that a node writes, used like a variable of type T. No other node writes the signal,
/// unless the signal table names several writers.
///
/// \code
/// class Thermometer : public QPlcCompactSlaveNode
/// {
/// public:
///     Thermometer() : QPlcCompactSlaveNode("Thermometer") { setSendsQuality(true); }
///
/// private:
///     QPlcOutput<double> m_temperature{this, "temperature"};  // [degC]
///     void step(const QPlcCycle &) override
///     {
///         m_temperature = 21.5;
///         m_temperature.setQuality(QPlcQuality::Good);
///     }
/// };
/// \endcode
///
/// T is a number, `bool`, an enum, a `std::array` of them, or a fixed-size Eigen vector of numbers.
/// A real type writes Real32 (rounded) and Real64 signals; an integer type writes its own signal
/// type and wider ones with the same sign; `bool` writes Int8 and UInt8; `qint64` writes DateTime,
/// too; an enum writes what its underlying type writes (`enum class Phase : qint8` a signal of the
/// type Int8, whose `values` give the numbers their names). The value stays until the node assigns
/// another one. The master does not take a value that is NaN, infinite, or outside of the limits of
/// the signal table.
///
/// \threadsafe no: see QPlcPort
///
/// \ingroup nodes
template<typename T>
class QPlcOutput final : public QPlcPortDetail::VariablePort<T>
{
public:
    /// Registers the output at its node. Its value is T{}.
    /// \param node  outlives the port; not null, and not registered at a master yet
    /// \param name  of the signal; copied
    QPlcOutput(QPlcCompactSlaveNode *node, const char *name)
        : QPlcPortDetail::VariablePort<T>(node, name, QPlcPort::Output, &m_value)
    {
    }
    ~QPlcOutput() override { this->leaveNode(); }
    /// Sets the value, in the unit of the signal. The node sends it with the answer to this cycle.
    QPlcOutput &operator=(const T &value)
    {
        m_value = value;
        return *this;
    }
    /// Sets the value to that of \a other; the port keeps its own signal.
    QPlcOutput &operator=(const QPlcOutput &other) { return *this = other.m_value; }
    /// Returns the value that was assigned last.
    const T &value() const { return m_value; }
    /// Sets the quality of the value. It is Good until you set another one, and it stays until the
    /// next call. Held means that the value is that many cycles old. Safe or Invalid mean that
    /// there is no value: the signal then keeps its last good value for `hold` cycles and gets its
    /// safe value after that. The master learns it only if the node sends qualities
    /// (QPlcCompactSlaveNode::setSendsQuality()).
    void setQuality(QPlcQuality quality) { this->giveQuality(quality); }
    /// Returns value().
    operator const T &() const { return m_value; }

private:
    T m_value{};
};
