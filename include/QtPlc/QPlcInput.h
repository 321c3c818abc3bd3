// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPort.h"

/// A value that a node reads, used like a variable of type T.
///
/// \code
/// class Brake : public QPlcCompactSlaveNode
/// {
/// public:
///     Brake() : QPlcCompactSlaveNode("Brake") {}
///
/// private:
///     QPlcInput<double> m_tetherSpeed{this, "tetherSpeed"};             // [m/s]
///     QPlcInput<std::array<double, 3>> m_position{this, "position"};    // [m], axes of the earth
///     QPlcOutput<bool> m_closed{this, "brakeClosed"};
///     void step(const QPlcCycle &) override
///     {
///         m_closed = m_tetherSpeed > 8.0 || m_position.value()[2] < 50.0;
///     }
/// };
/// \endcode
///
/// T is a number, `bool`, an enum, a `std::array` of them, or a fixed-size Eigen vector of numbers.
/// A real type reads Real32 and Real64 signals; an integer type reads its own signal type and
/// narrower ones with the same sign; `bool` reads Int8 and UInt8; `qint64` reads DateTime, too. An
/// enum reads what its underlying type reads, also numbers that none of its enumerators has: set
/// `min` and `max` of the signal, and have a `default` in each `switch`. Before the first
/// initialization the value is T{}.
///
/// \threadsafe no: see QPlcPort
///
/// \ingroup nodes
template<typename T>
class QPlcInput final : public QPlcPortDetail::VariablePort<T>
{
public:
    /// Registers the input at its node.
    /// \param node  outlives the port; not null, and not registered at a master yet
    /// \param name  of the signal; copied
    /// \param timing  which value is read: of the last cycle (default) or of the same cycle
    QPlcInput(QPlcCompactSlaveNode *node, const char *name, QPlcInputTiming::Value timing = QPlcInputTiming::LastCycle)
        : QPlcPortDetail::VariablePort<T>(node, name, QPlcPort::Input, &m_value, timing)
    {
    }
    ~QPlcInput() override { this->leaveNode(); }
    /// Returns the newest value, in the unit of the signal. It is the safe value when there is no
    /// good one.
    const T &value() const { return m_value; }
    /// Returns value().
    operator const T &() const { return m_value; }

private:
    T m_value{};
};
