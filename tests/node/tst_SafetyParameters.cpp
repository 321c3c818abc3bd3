// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "SafeNode.h"
#include "ScriptedNode.h"

namespace {

/// The table of the tests, with more keys of one signal.
QPlcSignalTable tableWith(const QString &name, const QByteArray &keys)
{
    const QByteArray section = '[' + name.toUtf8() + "]\n";
    const QByteArray usual = "hold = 1000\n";
    QByteArray text = testTable().toIni();
    const int begin = text.indexOf(section) + section.size();
    if (keys.startsWith("hold"))
        text.remove(text.indexOf(usual, begin), usual.size());
    text.insert(begin, keys);
    QVector<QPlcParseError> errors;
    const auto table = QPlcSignalTable::fromIni(text, &errors);
    Q_ASSERT_X(errors.isEmpty(), "tableWith", qPrintable(QPlcParseError::toString(errors)));
    return table;
}

/// Remembers the input that it was given when it was made safe.
class Brake : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    Brake()
        : QPlcCompactSlaveNode("Brake", ErrorZeroOrderHold)
    {
        setReconnectPolicy(ReconnectAlways);
    }
    std::atomic<double> safeInput{0.0};

protected:
    void step(const QPlcCycle &) override { m_echo = double(m_free); }
    void safeState(SafeStateReason) override { safeInput = double(m_free); }

private:
    QPlcInput<float> m_free{this, "free"};
    QPlcOutput<double> m_echo{this, "echo"};
};

}  // namespace

// What safe, min, max, hold, nan, slope and writer of the table are is agreed upon when a node
// registers.
class tst_SafetyParameters : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void cleanup() { QPlcSignalIndexTable::setCurrent({}); }
    void otherParametersAreRefusedWithTheirSignals_data();
    void otherParametersAreRefusedWithTheirSignals();
    void signalsThatTheNodeDoesNotUseMayDiffer();
    void manySignalsAreCounted();
    void nodeThatNamesNoParametersTakesThoseOfTheMaster();
    void nodeThatStayedTakesTheParametersOfANewMaster_data();
    void nodeThatStayedTakesTheParametersOfANewMaster();
    void nodeWithATableOfItsOwnIsRefusedByANewMaster();
    void tableWithOtherSignalsIsNotReplaced();
};

void tst_SafetyParameters::otherParametersAreRefusedWithTheirSignals_data()
{
    QTest::addColumn<QByteArray>("keys");
    for (const char *keys : {"safe = 1", "min = -1", "max = 1", "nan = allowed", "slope = 5 per second",
                             "writer = Brake > Counter", "hold = 7"})
        QTest::newRow(keys) << QByteArray(keys) + '\n';
}

void tst_SafetyParameters::otherParametersAreRefusedWithTheirSignals()
{
    QFETCH(QByteArray, keys);
    TestMaster master;
    QVERIFY(master.listen());
    Brake node;
    node.setSignalTable(tableWith("free", keys));
    QVERIFY(!node.connectToMasterAndWaitForConnected(master.protocol("udp")));
    QCOMPARE(node.error(), QPlcSlaveNode::RegistrationError);
    for (const char *word : {"'Brake'", "'free'", "safety parameters"})
        QVERIFY2(node.errorString().contains(word), qPrintable(node.errorString()));
    QVERIFY2(!node.errorString().contains("'echo'"), qPrintable(node.errorString()));
    QVERIFY(master.nodes().isEmpty());
}

void tst_SafetyParameters::signalsThatTheNodeDoesNotUseMayDiffer()
{
    TestMaster master;
    QVERIFY(master.listen());
    Brake node;
    node.setSignalTable(tableWith("vector", "safe = 1\n"));
    QVERIFY2(node.connectToMasterAndWaitForConnected(master.protocol("udp")), qPrintable(node.errorString()));
}

void tst_SafetyParameters::manySignalsAreCounted()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode node;
    node.inputs = QStringList{"time", "jitter", "workload", "setpoint", "count", "vector"};
    QVERIFY(node.connectTo(master.serverPort()));
    node.send(QPlcMessage::Hello, node.helloFields());
    QCOMPARE(node.next().kind(), QPlcMessage::Hello);
    QJsonObject fields = node.registerFields();
    for (const char *direction : {"inputs", "outputs"}) {
        QJsonArray declared = fields.value(direction).toArray();
        for (auto &&signal : declared) {
            QJsonObject changed = signal.toObject();
            changed.insert("safety", QPlcMessage::fromHex64(1));
            signal = changed;
        }
        fields.insert(direction, declared);
    }
    node.send(QPlcMessage::Register, fields);
    const QPlcMessage answer = node.next();
    QCOMPARE(answer.kind(), QPlcMessage::Rejected);
    QCOMPARE(answer.text("error"), QString("SafetyMismatch"));
    QVERIFY2(answer.text("text").contains("'time', 'jitter', 'workload', 'setpoint', 'count' and 2 more"),
             qPrintable(answer.text("text")));
}

void tst_SafetyParameters::nodeThatNamesNoParametersTakesThoseOfTheMaster()
{
    TestMaster master(QPlcClock::lockstep(), tableWith("count", "safe = 3\n"));
    QVERIFY(master.listen());
    ScriptedNode node;
    QVERIFY(node.registerAt(master.serverPort()));
}

void tst_SafetyParameters::nodeThatStayedTakesTheParametersOfANewMaster_data()
{
    QTest::addColumn<bool>("isOfProcess");
    QTest::newRow("table of the process") << true;
    QTest::newRow("table of the node") << false;
}

void tst_SafetyParameters::nodeThatStayedTakesTheParametersOfANewMaster()
{
    QFETCH(bool, isOfProcess);
    auto master = std::make_unique<TestMaster>(QPlcClock::realTime(), tableWith("free", "safe = 1\n"));
    QVERIFY(master->listen());
    const quint16 port = master->serverPort();
    Brake node;
    if (!isOfProcess)
        node.setSignalTable(QPlcSignalTable::fromMaster(tableWith("free", "safe = 1\n").toIni()));
    QVERIFY(node.connectToMasterAndWaitForConnected(master->protocol("udp")));
    QVERIFY(master->startRealTime());
    QVERIFY(master->waitForCycles(3));
    master.reset();
    QTRY_COMPARE(node.safeInput.load(), 1.0);

    const QPlcSignalTable changed = tableWith("free", "safe = 2\n");
    master = std::make_unique<TestMaster>(QPlcClock::realTime(), changed);
    QVERIFY(master->startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, port)));
    QVERIFY(waitUntil([&] { return !master->nodes().isEmpty(); }));
    QVERIFY(master->startRealTime());
    QVERIFY(master->waitForCycles(3));
    master.reset();
    QTRY_COMPARE(node.safeInput.load(), 2.0);
    QCOMPARE(node.signalTable().hash(), changed.hash());
}

void tst_SafetyParameters::nodeWithATableOfItsOwnIsRefusedByANewMaster()
{
    auto master = std::make_unique<TestMaster>();
    QVERIFY(master->listen());
    const quint16 port = master->serverPort();
    Brake node;
    node.setSignalTable(testTable());
    QVERIFY(node.connectToMasterAndWaitForConnected(master->protocol("udp")));
    master.reset();
    master = std::make_unique<TestMaster>(QPlcClock::lockstep(), tableWith("free", "safe = 2\n"));
    QVERIFY(master->startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, port)));
    QVERIFY(waitUntil([&] { return node.errorString().contains("safety parameters"); }));
    QCOMPARE(node.signalTable().hash(), testTable().hash());
    QVERIFY(master->nodes().isEmpty());
}

void tst_SafetyParameters::tableWithOtherSignalsIsNotReplaced()
{
    const auto former = QPlcSignalTable::fromMaster(testTable().toIni() + "\n[last]\ntype = Real\n");
    QPlcSignalIndexTable::setCurrent(former);
    TestMaster master;
    QVERIFY(master.listen());
    Brake node;
    QVERIFY2(node.connectToMasterAndWaitForConnected(master.protocol("udp")), qPrintable(node.errorString()));
    QCOMPARE(QPlcSignalIndexTable::current().hash(), former.hash());  // lists have its indices
}

QTEST_GUILESS_MAIN(tst_SafetyParameters)
#include "tst_SafetyParameters.moc"
