// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcCore>

#include <stdexcept>

extern "C" {
#include "WinchModel.h"
}

class WinchModelNode : public QPlcCompactSlaveNode
{
public:
    WinchModelNode() : QPlcCompactSlaveNode(QStringLiteral("Winch")) {}

private:
    static constexpr std::chrono::nanoseconds sampleTime = std::chrono::milliseconds(10);  // of the exported model

    QPlcBoundInput<double> m_tetherSpeed{this, "tetherSpeed", &WinchModel_U.tetherSpeed};      // [m/s]
    QPlcBoundOutput<double> m_tetherLength{this, "tetherLength", &WinchModel_Y.tetherLength};  // [m]

    void reset() override  // before every real-time phase
    {
        WinchModel_initialize();
        WinchModel_step();  // computes the outputs of the initial state, and moves on by a sample time ...
        const ExtY_WinchModel_T initialOutputs = WinchModel_Y;
        WinchModel_initialize();  // ... so go back to the initial state
        WinchModel_Y = initialOutputs;
    }
    void step(const QPlcCycle &cycle) override  // once per cycle, real-time
    {
        if (cycle.period() != sampleTime)
            throw std::runtime_error("the sample time of the model is 10 ms; set the period of the master to it");
        WinchModel_step();
    }
};
