// SPDX-License-Identifier: Apache-2.0
#include "NodeFixtures.h"

#include <QtPlcHardware>
#include <QtPlcTest>

#include <QtTest/QtTest>

using namespace std::chrono_literals;

// Devices belong to a real computer: a plant in virtual time has none.
class tst_SimulatedDevices : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void hardwareNodeRefusesToBeginOnASimulatedHost();
};

void tst_SimulatedDevices::hardwareNodeRefusesToBeginOnASimulatedHost()
{
    QPlcSimulator::run(1, [](QPlcSimulator &simulator) {
        const LogCapture log;
        QPlcSimulatedHost masterHost(simulator, "master"), winchHost(simulator, "winch");
        auto *master = masterHost.start<TestMaster>(QPlcClock::realTime());
        masterHost.call([&] { master->startServer(masterHost.place()); });
        auto *winch = winchHost.start<QPlcHardwareNode>(QStringLiteral("Winch"));
        winchHost.call([&] { winch->connectToMaster(masterHost.place()); });
        simulator.runUntil([&] { return master->nodes().size() == 1; }, 5s);
        masterHost.call([&] { master->initializeAllStates(); });
        const QString reason = QStringLiteral("a simulated computer has no devices");
        QVERIFY(simulator.runUntil([&] { return master->errorString().contains(reason); }, 5s));
        QVERIFY(winch->errorString().contains(reason));
    });
}

QTEST_GUILESS_MAIN(tst_SimulatedDevices)
#include "tst_SimulatedDevices.moc"
