// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ProcessPlant.h"

#include <QtNetwork/QTcpSocket>
#include <QtNetwork/QUdpSocket>

#include <csignal>
#include <poll.h>
#include <random>
#include <unistd.h>

// Programs of a plant that are killed, stopped and shouted at while cycles run.
class tst_PlantFaults : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_plant = std::make_unique<ProcessPlant>(); }
    void cleanup() { m_plant.reset(); }
    void stoppedNodeIsLateAndResumes_data();
    void stoppedNodeIsLateAndResumes();
    void stoppedMasterSkipsMissedCycles_data();
    void stoppedMasterSkipsMissedCycles();
    void killedNodeIsReportedAndReplaced();
    void garbageOnEveryPortChangesNothing();
    void injectedFaultsAreReportedByAllPrograms();
    void masterWhoseLogNobodyReadsAnswersAndEnds();

private:
    bool start(const QStringList &autopilotOptions = {}, const QStringList &masterOptions = {})
    {
        return m_plant->start(masterOptions) && m_plant->startNodes(autopilotOptions)
            && m_plant->qtplc(QStringLiteral("start")).exitCode == 0 && waitForCycles(20);
    }
    QJsonObject state() const { return jsonOf(m_plant->qtplc(QStringLiteral("state --json")).output).object(); }
    double counter(const char *name) const
    {
        return state().value(QStringLiteral("counters")).toObject().value(QLatin1String(name)).toDouble();
    }
    QJsonObject node(const QString &name) const
    {
        const QJsonArray nodes = state().value(QStringLiteral("nodes")).toArray();
        for (const QJsonValue &node : nodes) {
            if (node.toObject().value(QStringLiteral("name")).toString() == name)
                return node.toObject();
        }
        return {};
    }
    bool hasBothNodes() const
    {
        return !node(QStringLiteral("Model")).isEmpty() && !node(QStringLiteral("Autopilot")).isEmpty();
    }
    double late(const QString &name) const { return node(name).value(QStringLiteral("lateAnswers")).toDouble(); }
    /// Waits for so many cycles more.
    bool waitForCycles(int count) const
    {
        const double before = counter("cycles");
        return waitUntil([&] { return counter("cycles") >= before + count; });
    }
    QString events() const { return m_plant->qtplc(QStringLiteral("events")).output; }

    std::unique_ptr<ProcessPlant> m_plant;
};

void tst_PlantFaults::stoppedNodeIsLateAndResumes_data()
{
    QTest::addColumn<int>("milliseconds");
    QTest::newRow("0.3 s") << 300;
    QTest::newRow("2 s") << 2000;
}

void tst_PlantFaults::stoppedNodeIsLateAndResumes()
{
    QFETCH(int, milliseconds);
    QVERIFY(start());
    const double lateBefore = late("Autopilot");
    m_plant->autopilot().sendSignal(SIGSTOP);
    QTest::qWait(milliseconds);
    QVERIFY(waitForCycles(10));  // the others go on
    m_plant->autopilot().sendSignal(SIGCONT);
    const double lateAfter = late("Autopilot");
    QVERIFY2(lateAfter - lateBefore >= 5, qPrintable(QString::number(lateAfter - lateBefore)));
    // It computes the newest cycle, and then each one: punctual again for many cycles in a row.
    QVERIFY(waitUntil([&] {
        const double before = late("Autopilot");
        return waitForCycles(20) && late("Autopilot") - before < 15;
    }));
    QCOMPARE(state().value("state").toString(), QString("RealTime"));
    QVERIFY(hasBothNodes());
}

void tst_PlantFaults::stoppedMasterSkipsMissedCycles_data()
{
    QTest::addColumn<QString>("profile");
    QTest::addColumn<QString>("endsIn");
    QTest::newRow("simulation") << "simulation"
                                << "RealTime";
    QTest::newRow("plant") << "plant"
                           << "SafeStop";
}

void tst_PlantFaults::stoppedMasterSkipsMissedCycles()
{
    QFETCH(QString, profile);
    QFETCH(QString, endsIn);
    QVERIFY(start({}, {QStringLiteral("--profile"), profile}));
    const double skippedBefore = counter("skippedCycles");
    m_plant->master().sendSignal(SIGSTOP);
    QTest::qWait(2000);
    m_plant->master().sendSignal(SIGCONT);
    QTRY_VERIFY(counter("skippedCycles") - skippedBefore >= 150);  // of about 200
    QVERIFY(waitForCycles(10));
    const QJsonObject all = state();
    QCOMPARE(all.value("state").toString(), endsIn);
    const QJsonObject counters = all.value("counters").toObject();
    const QByteArray cycle = all.value("cycle").toString().toLatin1();
    QVERIFY(counters.value("overruns").toDouble() >= 1);
    // None is lost, and none is computed twice to catch up.
    QVERIFY(std::abs(double(cycle.toULongLong(nullptr, 16)) + 1 - counters.value("cycles").toDouble()
                     - counters.value("skippedCycles").toDouble())
            <= 2);
    QTRY_VERIFY(hasBothNodes());  // those of a plant have left and come back
}

void tst_PlantFaults::killedNodeIsReportedAndReplaced()
{
    QVERIFY(start());
    m_plant->autopilot().sendSignal(SIGKILL);
    QTRY_VERIFY(node("Autopilot").isEmpty());
    QVERIFY2(events().contains("node Autopilot is gone in the middle of its work"), qPrintable(events()));
    QCOMPARE(node("Model").value("name").toString(), QString("Model"));
    Program another(programPath("awe_autopilot"), {m_plant->address()});
    QVERIFY(another.waitForErrors(QStringLiteral("registered")));
    QTRY_VERIFY(!node("Autopilot").isEmpty());
}

void tst_PlantFaults::garbageOnEveryPortChangesNothing()
{
    QVERIFY(start({QStringLiteral("--faults=delay=0s,jitter=1ns"), QStringLiteral("--enable-fault-injection")}));
    const auto port = quint16(m_plant->port.toUInt());
    std::mt19937 random(1);
    const auto garbage = [&random](int size) {
        QByteArray bytes(size, '\0');
        for (char &byte : bytes)
            byte = char(random());
        return bytes;
    };
    const double cyclesBefore = counter("cycles");
    QUdpSocket udp;
    for (int i = 0; i < 5000; ++i) {
        udp.writeDatagram(garbage(int(random() % 1500)), QHostAddress::LocalHost, port);
        if (i % 100 == 0) {
            QTcpSocket tcp;
            tcp.connectToHost(QHostAddress::LocalHost, port);
            if (tcp.waitForConnected(1000)) {
                tcp.write(garbage(2000));
                tcp.waitForBytesWritten(1000);
            }
        }
        if (i % 10 == 0)
            QTest::qWait(1);
    }
    QTRY_VERIFY(counter("strangers") > 1000);
    QVERIFY(counter("cycles") > cyclesBefore + 10);
    QVERIFY(waitForCycles(20));
    const QJsonObject after = state();
    QCOMPARE(after.value("state").toString(), QString("RealTime"));
    QVERIFY(hasBothNodes());
    QCOMPARE(node("Model").value("rejected").toDouble(), 0.0);
    QVERIFY(!udp.hasPendingDatagrams());  // nobody is told that somebody is there
}

void tst_PlantFaults::injectedFaultsAreReportedByAllPrograms()
{
    const QString enabled = QStringLiteral("--enable-fault-injection");
    QVERIFY(m_plant->start({enabled, QStringLiteral("--faults=delay=100us")}));
    QVERIFY(m_plant->startNodes({enabled, QStringLiteral("--faults=duplicate=50%,seed=9")}));
    QVERIFY(m_plant->autopilot().waitForErrors("node Autopilot injects faults on purpose: duplicate=50%,seed=9"));
    QVERIFY(m_plant->autopilot().waitForErrors("injects faults on purpose: delay=100us"));
    QVERIFY2(m_plant->master().waitForErrors("the master injects faults on purpose: delay=100us"),
             qPrintable(m_plant->master().errors()));
    const QString shown = m_plant->qtplc(QStringLiteral("state")).output;
    QVERIFY2(shown.contains("FAULTS    injected on purpose by Master (delay=100us), Autopilot (duplicate=50%,seed=9)"),
             qPrintable(shown));
    QCOMPARE(m_plant->qtplc(QStringLiteral("start")).exitCode, 0);
    QTRY_VERIFY(node("Autopilot").value("duplicates").toDouble() > 5);
}

void tst_PlantFaults::masterWhoseLogNobodyReadsAnswersAndEnds()
{
    int ends[2];
    QCOMPARE(::pipe(ends), 0);
    Program master(QStringLiteral("/usr/bin/env"),
                   {QStringLiteral("QT_LOGGING_RULES=qtplc.control.debug=true"), programPath("awe_master"),
                    QStringLiteral("--port=0")},
                   ends[1]);
    QVERIFY(master.waitForOutput(QStringLiteral("\n")));
    m_plant->port = master.output().section(QLatin1Char('\n'), 0, 0).section(QLatin1Char(' '), 1);
    const auto isFull = [&] {
        pollfd pipe = {ends[1], POLLOUT, 0};
        return ::poll(&pipe, 1, 0) == 0;
    };
    for (int i = 0; i < 100 && !isFull(); ++i)
        QCOMPARE(m_plant->qtplc(QStringLiteral("list")).exitCode, 0);
    QVERIFY(isFull());
    for (int i = 0; i < 5; ++i)
        QCOMPARE(m_plant->qtplc(QStringLiteral("list")).exitCode, 0);
    master.sendSignal(SIGTERM);
    QCOMPARE(master.waitForEnd(), 0);
    ::close(ends[0]);
    ::close(ends[1]);
}

QTEST_GUILESS_MAIN(tst_PlantFaults)
#include "tst_PlantFaults.moc"
