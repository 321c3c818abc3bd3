// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BenchDriver.h"
#include "NodeFixtures.h"
#include "QPlcHardwareNode.h"

#include <QtTest/QtTest>

inline QPlcSignalTable winchTable()
{
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni(R"(
[speed]
type = Real64
safe = -7
hold = 2
[torque]
type = Real64
safe = 3
hold = 1000
[brake]
type = Bool
safe = 1
hold = 1000
[small]
type = Int8
[pair]
type = Real32[2]
[online]
type = Bool
)",
                                                           &errors);
    Q_ASSERT_X(errors.isEmpty(), "winchTable", qPrintable(QPlcParseError::toString(errors)));
    return table;
}

inline const QByteArray wiring = "[node]\nname = Winch\n[drive]\ndriver = bench\ndevice = bench0\n"
                                 "[drive.read]\nspeed = speed * 2 + 1\nonline = @online\n"
                                 "[drive.write]\ntorque = torque * 10\nbrake = brake\n";

/// Rows "kind" and "pace" of a test: every transport and every pace of a driver.
inline void addKinds()
{
    QTest::addColumn<QString>("kind");
    QTest::addColumn<int>("pace");
    for (const char *kind : {"local", "tcp", "udp"}) {
        QTest::addRow("%s, every cycle", kind) << QString(kind) << int(QPlcDriver::EveryCycle);
        QTest::addRow("%s, own pace", kind) << QString(kind) << int(QPlcDriver::OwnPace);
    }
}

/// The device of a test, and its driver in the configuration: "bench".
class WinchBench
{
public:
    void init()
    {
        QPlcSignalIndexTable::setCurrent({});
        device = std::make_shared<BenchDevice>();
        pace = QPlcDriver::EveryCycle;
        QPlcHardwareNode::addDriverKind("bench", "memory of the test",
                                        [this] { return std::make_unique<BenchDriver>(device, pace); });
    }

    static bool start(TestMaster &master)
    {
        return master.startRealTime() && master.waitForState(QPlcMasterNode::RealTime);
    }

    std::shared_ptr<BenchDevice> device;
    QPlcDriver::Pace pace = QPlcDriver::EveryCycle;
};
