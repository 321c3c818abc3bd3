// SPDX-License-Identifier: Apache-2.0
// Who may write a signal, and from whom it has its values when several may.
#include "NodeFixtures.h"
#include "ScriptedNode.h"

#include <QtTest/QtTest>

namespace {

/// "speed" has three writers, "alone" one.
QPlcSignalTable writersTable()
{
    return QPlcSignalTable::fromIni("[alone]\ntype = Real64\nwriter = Source\n[free]\ntype = Real32\n[speed]\ntype = "
                                    "Real64\nmin = -10\nmax = 10\nsafe = -1\nhold = 8\nwriter = A > B > C\n");
}

class Pilot : public QPlcCompactSlaveNode
{
public:
    explicit Pilot(const QString &name, double value)
        : QPlcCompactSlaveNode(name)
        , m_value(value)
    {
    }
    std::function<double(quint64)> idea;

private:
    void reset() override { m_speed = m_value; }
    void step(const QPlcCycle &cycle) override { m_speed = idea ? idea(cycle.number()) : m_value; }
    double m_value;
    QPlcOutput<double> m_speed{this, "speed"};
};

class Winch : public QPlcCompactSlaveNode
{
public:
    Winch()
        : QPlcCompactSlaveNode(QStringLiteral("Winch"))
    {
        setReceivesQuality(true);
    }
    QStringList record;

private:
    void step(const QPlcCycle &) override
    {
        record << QStringLiteral("%1 %2").arg(m_speed.value()).arg(m_speed.quality().toString());
    }
    QPlcInput<double> m_speed{this, "speed", QPlcInputTiming::SameCycle};
};

}  // namespace

class tst_Writers : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void unlistedWriterIsRefused();
    void theFirstWriterThatIsFreshIsTheSource();
    void writerWithInvalidValuesIsReplacedImmediately();
    void viewersSeeQualityAndSource();
};

void tst_Writers::unlistedWriterIsRefused()
{
    class Writer : public QPlcCompactSlaveNode
    {
    public:
        explicit Writer(const QString &name)
            : QPlcCompactSlaveNode(name)
        {
        }
        QPlcOutput<double> m_alone{this, "alone"};
    };
    TestMaster master(QPlcClock::lockstep(), writersTable());
    QVERIFY(master.listen());
    Writer stranger("Stranger");
    Writer named("Source");
    LogCapture log;
    QVERIFY(!master.admit(stranger, "tcp"));
    QVERIFY2(stranger.errorString().contains("signal 'alone' cannot be written by node 'Stranger'")
                 && stranger.errorString().contains("'writer = Source'"),
             qPrintable(stranger.errorString()));
    QVERIFY(!master.addLocalNode(&stranger));
    QVERIFY(master.admit(named, "tcp"));
    QCOMPARE(master.writer("alone"), QString("Source"));
    named.disconnectFromMaster();
}

void tst_Writers::theFirstWriterThatIsFreshIsTheSource()
{
    LogCapture log;
    TestMaster master(QPlcClock::lockstep(), writersTable());
    Pilot b("B", 2.0);
    Pilot c("C", 3.0);
    Winch winch;
    QVERIFY(master.addLocalNode(&c) && master.addLocalNode(&b) && master.addLocalNode(&winch));
    QVERIFY(master.listen());
    ScriptedNode a("A");
    a.table = writersTable();
    a.inputs.clear();
    a.outputs = QStringList{"speed"};
    a.initialValues = QPlcValue(1.0).toBytes();
    a.cyclic = "tcp";
    a.onRequest = [&](const ScriptedNode::Request &request) {
        if (request.cycle < 10)
            a.answer(request.cycle, QPlcValue(1.0).toBytes());
        else if (request.cycle == 10) {
            a.control.close();
            a.stream.abort();
            while (master.statistics().cycles < 20)  // before the master hears that the node is gone
                QThread::msleep(1);
        }
    };
    QVERIFY(a.registerAt(master.serverPort()));
    QCOMPARE(master.writer("speed"), QString("A > B > C"));
    master.setCycleLimit(20);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QStringList expected;
    for (int cycle = 0; cycle < 20; ++cycle)
        expected << (cycle < 10       ? QString("1 good")
                         : cycle < 15 ? QString("1 held %1").arg(cycle - 9)
                                      : QString("2 good"));
    QCOMPARE(winch.record, expected);
    QCOMPARE(log.matching("speed: its source is now B, instead of A").size(), 1);
}

void tst_Writers::writerWithInvalidValuesIsReplacedImmediately()
{
    TestMaster master(QPlcClock::lockstep(), writersTable());
    Pilot a("A", 1.0);
    Pilot b("B", 2.0);
    Winch winch;
    a.idea = [](quint64 cycle) { return cycle == 3 ? qQNaN() : cycle >= 6 ? 11.0 : 1.0; };
    b.idea = [](quint64 cycle) { return cycle >= 8 ? qInf() : 2.0; };
    QVERIFY(master.addLocalNode(&a) && master.addLocalNode(&b) && master.addLocalNode(&winch));
    master.setCycleLimit(20);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(winch.record.mid(0, 9),
             (QStringList{"1 good", "1 good", "1 good", "2 good", "1 good", "1 good", "2 good", "2 good", "2 held 1"}));
    QCOMPARE(winch.record.mid(15), (QStringList{"2 held 8", "-1 safe", "-1 safe", "-1 safe", "-1 safe"}));
}

void tst_Writers::viewersSeeQualityAndSource()
{
    TestMaster master(QPlcClock::lockstep(), writersTable());
    Pilot a("A", 1.0);
    Pilot b("B", 2.0);
    a.idea = [](quint64) { return qQNaN(); };
    QVERIFY(master.addLocalNode(&a) && master.addLocalNode(&b));
    QVERIFY(master.listen());
    master.setCycleLimit(5);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    ScriptedNode viewer("Viewer");
    QVERIFY(viewer.connectTo(master.serverPort()));
    viewer.send(QPlcMessage::Hello, viewer.helloFields());
    QCOMPARE(viewer.next().kind(), QPlcMessage::Hello);
    viewer.send(QPlcMessage::GetSignals, {{"names", QJsonArray{"speed", "free"}}});
    const QJsonArray answered = viewer.next().fields().value("signals").toArray();
    QCOMPARE(answered.size(), 2);
    const QJsonObject speed = answered.at(0).toObject();
    QCOMPARE(speed.value("quality").toInt(-1), 0);
    QCOMPARE(speed.value("writer").toString(), QString("A > B"));
    QCOMPARE(speed.value("source").toString(), QString("B"));
    QCOMPARE(answered.at(1).toObject().value("quality").toInt(-1), 254);
    QVERIFY(!answered.at(1).toObject().contains("source"));
}

QTEST_GUILESS_MAIN(tst_Writers)
#include "tst_Writers.moc"
