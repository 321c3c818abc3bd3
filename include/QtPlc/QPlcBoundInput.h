// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPort.h"

/// A variable that exists already (of an exported Simulink model, say) and is set from a signal before each step:
/// `QPlcBoundInput<double> m_speed{this, "tetherSpeed", &LaweModel_U.tetherSpeed};`. T may also be a C array: QPlcBoundInput<double[3]>.
template<typename T>
class QPlcBoundInput final : public QPlcPortDetail::VariablePort<T>
{
public:
    /// \param variable  outlives the port
    QPlcBoundInput(QPlcCompactSlaveNode *node, const char *name, T *variable,
                   QPlcInputTiming::Value timing = QPlcInputTiming::LastCycle)
        : QPlcPortDetail::VariablePort<T>(node, name, QPlcPort::Input, variable, timing)
    {
    }
    ~QPlcBoundInput() override { this->leaveNode(); }
};
