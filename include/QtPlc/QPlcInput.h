// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPort.h"

/// A value that a node reads: `QPlcInput<double> m_tetherSpeed{this, "tetherSpeed"};  // [m/s]`
///
/// T is a number, bool, std::array or fixed-size Eigen vector of numbers. A double reads Real32 and Real64 signals, an integer its own and narrower types.
/// Before the first cycle the value is T{}.
template<typename T>
class QPlcInput final : public QPlcPortDetail::VariablePort<T>
{
public:
    QPlcInput(QPlcCompactSlaveNode *node, const char *name)
        : QPlcPortDetail::VariablePort<T>(node, name, QPlcPort::Input, &m_value)
    {
    }
    const T &value() const { return m_value; }
    operator const T &() const { return m_value; }

private:
    T m_value{};
};

/// A variable that exists already (of an exported Simulink model, say) and is set from a signal before each step:
/// `QPlcBoundInput<double> m_speed{this, "tetherSpeed", &LaweModel_U.tetherSpeed};`. T may also be a C array: QPlcBoundInput<double[3]>.
template<typename T>
class QPlcBoundInput final : public QPlcPortDetail::VariablePort<T>
{
public:
    /// \param variable  outlives the port
    QPlcBoundInput(QPlcCompactSlaveNode *node, const char *name, T *variable)
        : QPlcPortDetail::VariablePort<T>(node, name, QPlcPort::Input, variable)
    {
    }
};
