// SPDX-License-Identifier: Apache-2.0
#include "nodes.h"

Doubler::Doubler()
    : QPlcCompactSlaveNode("Doubler")
{
}

void Doubler::step(const QPlcCycle &)
{
    m_out = 2.0 * m_in;
}
