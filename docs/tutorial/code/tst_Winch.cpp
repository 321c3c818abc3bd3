// SPDX-License-Identifier: Apache-2.0
#include "Winch.h"

#include <QtTest/QtTest>

class tst_Winch : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void lengthIsTheIntegralOfTheSpeed_data()
    {
        QTest::addColumn<double>("speed");
        QTest::addColumn<double>("length");
        QTest::newRow("reels out") << 2.0 << 302.0;
        QTest::newRow("stands still") << 0.0 << 300.0;
        QTest::newRow("reels in") << -3.0 << 297.0;
    }
    void lengthIsTheIntegralOfTheSpeed()
    {
        QFETCH(double, speed);
        QFETCH(double, length);
        QPlcMasterNode master;  // in this process, without a network
        QVERIFY(master.setSignalTable(QPlcSignalTable::fromIniFile(WINCH_TABLE)));
        master.setClock(QPlcClock::lockstep());  // as fast as possible, and the same each time
        master.setCycleLimit(100);               // of 10 ms: 1 s
        Winch winch;
        QVERIFY2(master.addLocalNode(&winch), qPrintable(master.errorString()));

        QSignalSpy initialized(&master, &QPlcMasterNode::statesInitialized);
        QVERIFY2(master.initializeAllStates(), qPrintable(master.errorString()));
        QVERIFY(!initialized.isEmpty() || initialized.wait());
        QVERIFY(master.setSignalValue("tetherSpeed", speed));  // by hand, as no node writes it

        QSignalSpy stopped(&master, &QPlcMasterNode::realTimeHasStopped);
        QVERIFY2(master.startRealTime(), qPrintable(master.errorString()));
        QVERIFY(stopped.wait());

        QCOMPARE(master.signalValue("tetherLength").toReal(), length);
        master.removeLocalNode(&winch);
    }
};

QTEST_GUILESS_MAIN(tst_Winch)
#include "tst_Winch.moc"
