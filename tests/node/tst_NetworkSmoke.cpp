// SPDX-License-Identifier: Apache-2.0
#include "NodeFixtures.h"

#include <QtTest/QtTest>

class tst_NetworkSmoke : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void sameDigestOverEveryTransport_data()
    {
        QTest::addColumn<QString>("kind");
        QTest::newRow("tcp") << "tcp";
        QTest::newRow("udp") << "udp";
    }
    void sameDigestOverEveryTransport()
    {
        QFETCH(QString, kind);
        const quint64 expected = flyInProcess();
        QPlcMasterNode master;
        master.setSignalTable(testTable());
        master.setClock(QPlcClock::lockstep());
        master.setCycleLimit(1000);
        QVERIFY(master.setTimeSignal("time"));
        QVERIFY2(master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)), qPrintable(master.errorString()));
        CounterNode counter;
        EchoNode echo;
        const auto address = kind == "tcp" ? QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, master.serverPort())
                                           : QPlcUnderlyingProtocol::udp(QHostAddress::LocalHost, master.serverPort());
        QVERIFY2(counter.connectToMasterAndWaitForConnected(address), qPrintable(counter.errorString()));
        QVERIFY2(echo.connectToMasterAndWaitForConnected(address), qPrintable(echo.errorString()));
        QSignalSpy stopped(&master, &QPlcMasterNode::realTimeHasStopped);
        QVERIFY2(master.startRealTime(), qPrintable(master.errorString()));
        QVERIFY(stopped.wait(5000));
        QCOMPARE(master.statistics().cycles, quint64(1000));
        QCOMPARE(master.signalValue("count").toInt(), 1000);
        QCOMPARE(master.statistics().imageDigest, expected);
        counter.disconnectFromMaster();
        echo.disconnectFromMaster();
    }

private:
    quint64 flyInProcess()
    {
        QPlcMasterNode master;
        master.setSignalTable(testTable());
        master.setClock(QPlcClock::lockstep());
        master.setCycleLimit(1000);
        master.setTimeSignal("time");
        CounterNode counter;
        EchoNode echo;
        if (!master.addLocalNode(&echo) || !master.addLocalNode(&counter))
            qFatal("%s", qPrintable(master.errorString()));
        QSignalSpy stopped(&master, &QPlcMasterNode::realTimeHasStopped);
        master.startRealTime();
        stopped.wait(5000);
        const quint64 digest = master.statistics().imageDigest;
        master.removeLocalNode(&echo);
        master.removeLocalNode(&counter);
        return digest;
    }
};

QTEST_GUILESS_MAIN(tst_NetworkSmoke)
#include "tst_NetworkSmoke.moc"
