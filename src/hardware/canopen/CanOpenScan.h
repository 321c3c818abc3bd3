// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanOpenIds.h"

#include <QtCore/QVector>

#include <chrono>

namespace qplc {

/// Looks for the devices of a CANopen bus: asks each node id for its type, and listens to
/// heartbeats. It changes nothing at the devices.
class CanOpenScan
{
public:
    /// A device that has answered, or told a heartbeat.
    struct Device
    {
        int node = 0;
        NmtState state = NmtState::Unknown;  // it has told no heartbeat meanwhile
        bool hasAnswered = false;            // else only its heartbeat was heard
        quint32 type = 0;                    // object 1000h
        quint32 vendor = 0;                  // object 1018h, as the next ones
        quint32 product = 0;
        quint32 revision = 0;
        quint32 serial = 0;
        QString name;  // object 1008h; empty: it has none
    };

    /// \param device  the bus \param time  to listen
    /// \return false, with the reason in \a error, when the bus cannot be used
    static bool run(const QString &device, std::chrono::nanoseconds time, QVector<Device> *devices, QString *error);

    /// "Servo drive" of the low half of a type; the number of the profile when it has no name here.
    static QString profileText(quint32 type);
};

}  // namespace qplc
