// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPort.h"

/// An input of a node that sets an existing variable before each step, for example of an exported
/// Simulink model.
///
/// \code
/// static struct { double tetherSpeed; double wind[3]; } model;  // of the exported code
///
/// class Model : public QPlcCompactSlaveNode
/// {
/// public:
///     Model() : QPlcCompactSlaveNode("Model") {}
///
/// private:
///     QPlcBoundInput<double> m_speed{this, "tetherSpeed", &model.tetherSpeed};  // [m/s]
///     QPlcBoundInput<double[3]> m_wind{this, "wind", &model.wind};              // [m/s]
/// };
/// \endcode
///
/// T is as for QPlcInput, or a C array of numbers or of enums.
///
/// \threadsafe no: the cycle thread writes the variable while cycles run; see QPlcPort
///
/// \ingroup nodes
template<typename T>
class QPlcBoundInput final : public QPlcPortDetail::VariablePort<T>
{
public:
    /// Registers the input at its node.
    /// \param node  outlives the port; not null, and not registered at a master yet
    /// \param name  of the signal; copied
    /// \param variable  outlives the port, which does not own it
    /// \param timing  which value is read: of the last cycle (default) or of the same cycle
    QPlcBoundInput(QPlcCompactSlaveNode *node, const char *name, T *variable,
                   QPlcInputTiming::Value timing = QPlcInputTiming::LastCycle)
        : QPlcPortDetail::VariablePort<T>(node, name, QPlcPort::Input, variable, timing)
    {
    }
    ~QPlcBoundInput() override { this->leaveNode(); }
};
