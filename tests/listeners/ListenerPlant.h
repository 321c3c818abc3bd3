// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcCore>

/// A plant that listeners look at: 300 numbers, the time, and a worker that is waited for.
namespace ListenerPlant {

constexpr int Values = 300;

inline QPlcSignalTable table()
{
    QByteArray ini = "[time]\ntype = DateTime\n[request]\ntype = Real64\n[echo]\ntype = Real64\n";
    for (int i = 0; i < Values; ++i)
        ini += "[value" + QByteArray::number(i) + "]\ntype = Real64\n";
    return QPlcSignalTable::fromIni(ini);
}

}  // namespace ListenerPlant
