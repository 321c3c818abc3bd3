// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeFixtures.h"
#include "gui/plant/PlantList.h"

/// A plant in real time at 100 Hz, in this process. It goes on when the computer stalls: windows
/// are tested here.
class RunningMaster : public TestMaster
{
    Q_OBJECT
public:
    explicit RunningMaster(const QPlcSignalTable &table = testTable())
        : TestMaster(QPlcClock::realTime(), table)
    {
        setInterval(std::chrono::milliseconds(10));
        setGapLimit(std::chrono::nanoseconds(0));
        if (listen() && table.contains(QStringLiteral("count")))
            addLocalNode(&counter);
    }
    ~RunningMaster() override { removeLocalNode(&counter); }
    QString address() const { return QStringLiteral("127.0.0.1:%1").arg(serverPort()); }

    CounterNode counter;
};

/// A plant whose signal "echo" is written by a node.
class FlyingMaster : public RunningMaster
{
    Q_OBJECT
public:
    FlyingMaster() { addLocalNode(&echoNode); }
    ~FlyingMaster() override { removeLocalNode(&echoNode); }
    double valueOf(const QString &signal) const { return signalValue(signal).toReal(); }

    EchoNode echoNode;
};

/// A port of the loopback where nobody listens.
inline quint16 freePort()
{
    TestMaster master;
    return master.listen() ? master.serverPort() : quint16(0);
}
