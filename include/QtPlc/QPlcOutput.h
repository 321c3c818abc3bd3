// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPort.h"

/// A value that a node, and no other, writes: `QPlcOutput<double> m_tetherLength{this, "tetherLength"};  // [m]`
///
/// T is a number, bool, std::array or fixed-size Eigen vector of numbers. A double writes Real32 (rounded) and Real64 signals, an integer its own and wider types.
/// The value stays until it is assigned again.
template<typename T>
class QPlcOutput final : public QPlcPortDetail::VariablePort<T>
{
public:
    QPlcOutput(QPlcCompactSlaveNode *node, const char *name)
        : QPlcPortDetail::VariablePort<T>(node, name, QPlcPort::Output, &m_value)
    {
    }
    ~QPlcOutput() override { this->leaveNode(); }
    QPlcOutput &operator=(const T &value)
    {
        m_value = value;
        return *this;
    }
    QPlcOutput &operator=(const QPlcOutput &other) { return *this = other.m_value; }
    const T &value() const { return m_value; }
    /// Says how far the value can be trusted: Good until something else is said. Held: the value is that many cycles old. Safe or Invalid: there is no value, and the
    /// signal keeps its last good one for `hold` cycles, then its safe one. Told to others if the node sends qualities (QPlcCompactSlaveNode::setSendsQuality()).
    void setQuality(QPlcQuality quality) { this->giveQuality(quality); }
    operator const T &() const { return m_value; }

private:
    T m_value{};
};
