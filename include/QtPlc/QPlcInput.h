// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPort.h"

/// A value that a node reads: `QPlcInput<double> m_tetherSpeed{this, "tetherSpeed"};  // [m/s]`
///
/// T is a number, bool, std::array or fixed-size Eigen vector of numbers. A double reads Real32 and Real64 signals, an integer its own and narrower types.
/// Before the first cycle the value is T{}. The value is that of the cycle before unless the third argument is QPlcInputTiming::SameCycle.
template<typename T>
class QPlcInput final : public QPlcPortDetail::VariablePort<T>
{
public:
    QPlcInput(QPlcCompactSlaveNode *node, const char *name, QPlcInputTiming::Value timing = QPlcInputTiming::LastCycle)
        : QPlcPortDetail::VariablePort<T>(node, name, QPlcPort::Input, &m_value, timing)
    {
    }
    ~QPlcInput() override { this->leaveNode(); }
    const T &value() const { return m_value; }
    operator const T &() const { return m_value; }

private:
    T m_value{};
};
