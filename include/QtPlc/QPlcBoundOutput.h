// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPort.h"

/// An output of a node that sends an existing variable after each step, for example of an exported
/// Simulink model.
///
/// \code
/// static struct { double position[3]; } model;  // of the exported code
///
/// class Model : public QPlcCompactSlaveNode
/// {
/// public:
///     Model() : QPlcCompactSlaveNode("Model") {}
///
/// private:
///     QPlcBoundOutput<double[3]> m_position{this, "position", &model.position};  // [m]
/// };
/// \endcode
///
/// T is as for QPlcOutput, or a C array of numbers or of enums.
///
/// \threadsafe no: the cycle thread reads the variable while cycles run; see QPlcPort
///
/// \ingroup nodes
template<typename T>
class QPlcBoundOutput final : public QPlcPortDetail::VariablePort<T>
{
public:
    /// Registers the output at its node.
    /// \param node  outlives the port; not null, and not registered at a master yet
    /// \param name  of the signal; copied
    /// \param variable  outlives the port, which does not own it
    QPlcBoundOutput(QPlcCompactSlaveNode *node, const char *name, T *variable)
        : QPlcPortDetail::VariablePort<T>(node, name, QPlcPort::Output, variable)
    {
    }
    ~QPlcBoundOutput() override { this->leaveNode(); }
    /// Sets the quality of the value, as QPlcOutput::setQuality() does.
    void setQuality(QPlcQuality quality) { this->giveQuality(quality); }
};
