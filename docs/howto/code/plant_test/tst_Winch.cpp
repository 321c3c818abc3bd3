// SPDX-License-Identifier: Apache-2.0
#include "Winch.h"

#include <QtPlcTest>
#include <QtTest/QTest>
using namespace std::chrono_literals;

/// A master and a winch. \return whether the winch moves
static bool begin(QPlcSimulator &simulator, QPlcSimulatedHost &masterHost, QPlcSimulatedHost &winchHost)
{
    auto *master = masterHost.start<QPlcMasterNode>();
    masterHost.call([&] {
        master->setSignalTable(QPlcSignalTable::fromIni("[tetherLength]\ntype = Real64\n"));
        master->setProfile(QPlcProfile::Plant);  // a node that hears nothing becomes safe
        master->startServer(masterHost.place());
    });
    winchHost.call([&, winch = winchHost.start<Winch>()] { winch->connectToMaster(masterHost.place()); });
    simulator.runUntil([&] { return master->nodes().size() == 1; }, 5s);
    masterHost.call([&] { master->initializeAllStates(); });
    simulator.runUntil([&] { return master->state() == QPlcMasterNode::Ready; }, 5s);
    masterHost.call([&] { master->startRealTime(); });
    return simulator.runUntil([&] { return winchHost.program<Winch>()->speed == 1.0; }, 5s);
}

class tst_Winch : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void reelsOutForAMinute()
    {
        QPlcSimulator::run(1, [](QPlcSimulator &simulator) {
            QPlcSimulatedHost masterHost(simulator, "master"), winchHost(simulator, "winch");
            QVERIFY(begin(simulator, masterHost, winchHost));
            simulator.runFor(60s);  // takes some milliseconds
            const double length = masterHost.program<QPlcMasterNode>()->signalValue("tetherLength").toReal();
            QVERIFY(length > 359.9 && length < 360.1);
        });
    }
    void winchStandsStillAfterLossOfTheMaster()
    {
        QPlcSimulator::run(2, [](QPlcSimulator &simulator) {
            QPlcSimulatedHost masterHost(simulator, "master"), winchHost(simulator, "winch");
            QVERIFY(begin(simulator, masterHost, winchHost));
            masterHost.kill(QPlcSimulatedHost::Power);
            QVERIFY(simulator.runUntil([&] { return winchHost.program<Winch>()->speed == 0.0; }, 70ms));
        });
    }
};
QTEST_GUILESS_MAIN(tst_Winch)
#include "tst_Winch.moc"
