// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPort.h"

/// A variable that exists already (of an exported Simulink model, say) and is sent as a signal after each step:
/// `QPlcBoundOutput<double[3]> m_position{this, "bodyPosition_earth", &LaweModel_Y.bodyPosition_earth};`
template<typename T>
class QPlcBoundOutput final : public QPlcPortDetail::VariablePort<T>
{
public:
    /// \param variable  outlives the port
    QPlcBoundOutput(QPlcCompactSlaveNode *node, const char *name, T *variable)
        : QPlcPortDetail::VariablePort<T>(node, name, QPlcPort::Output, variable)
    {
    }
    ~QPlcBoundOutput() override { this->leaveNode(); }
    /// Says how far the value can be trusted: Good until something else is said. Held: the value is that many cycles old. Safe or Invalid: there is no value, and the
    /// signal keeps its last good one for `hold` cycles, then its safe one. Told to others if the node sends qualities (QPlcCompactSlaveNode::setSendsQuality()).
    void setQuality(QPlcQuality quality) { this->giveQuality(quality); }
};
