// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcCore>

class Doubler : public QPlcCompactSlaveNode
{
public:
    Doubler();

private:
    QPlcInput<double> m_in{this, "in"};
    QPlcOutput<double> m_out{this, "out"};
    void step(const QPlcCycle &) override;
};
