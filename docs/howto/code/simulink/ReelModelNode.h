// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcCore>

#include <stdexcept>

extern "C" {
#include "ReelModel.h"
}

class ReelModelNode : public QPlcCompactSlaveNode
{
public:
    ReelModelNode() : QPlcCompactSlaveNode(QStringLiteral("Winch"))
    {
        m_model.inputs = &m_inputs;
        m_model.outputs = &m_outputs;
        m_model.dwork = &m_states;
    }

private:
    static constexpr std::chrono::nanoseconds sampleTime = std::chrono::milliseconds(10);  // of the exported model

    ExtU_ReelModel_T m_inputs = {};
    ExtY_ReelModel_T m_outputs = {};
    DW_ReelModel_T m_states = {};
    RT_MODEL_ReelModel_T m_model = {};

    QPlcBoundInput<double> m_tetherSpeed{this, "tetherSpeed", &m_inputs.tetherSpeed};       // [m/s]
    QPlcBoundOutput<double> m_tetherLength{this, "tetherLength", &m_outputs.tetherLength};  // [m]

    void reset() override  // before every real-time phase
    {
        ReelModel_initialize(&m_model);
        ReelModel_step(&m_model);
        const ExtY_ReelModel_T initialOutputs = m_outputs;
        ReelModel_initialize(&m_model);
        m_outputs = initialOutputs;
    }
    void step(const QPlcCycle &cycle) override  // once per cycle, real-time
    {
        if (cycle.period() != sampleTime)
            throw std::runtime_error("the sample time of the model is 10 ms; set the period of the master to it");
        ReelModel_step(&m_model);
        if (rtmGetErrorStatus(&m_model))
            throw std::runtime_error(rtmGetErrorStatus(&m_model));
    }
};
