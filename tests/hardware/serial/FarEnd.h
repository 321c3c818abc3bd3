// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../DriverBench.h"
#include "../FakeDevices.h"
#include "PseudoTerminal.h"

/// The far end of a serial line, and the driver at the near end.
struct FarEnd
{
    /// \param kind  of the driver \param device  "fake:NAME" \param keys  the others of the section
    FarEnd(const char *kind, const QByteArray &device, const QByteArray &keys)
        : bench(QString::fromLatin1(kind), "device = " + device + "\n" + keys)
    {
        if (!far.plugIn(QString::fromLatin1(device)))
            qFatal("no pseudo-terminal");
    }
    /// The driver reads what the far end sends.
    bool say(const QByteArray &bytes) { return far.send(bytes) && bench.exchange(); }

    const FakeDevices devices;
    PseudoTerminal far;
    DriverBench bench;
};
