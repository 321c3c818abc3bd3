// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"

namespace {

constexpr int Count = 16000;
constexpr int Patience = 60000;  // [ms]

QString nameOf(int signal)
{
    return QStringLiteral("signal_%1").arg(signal);
}

/// Its text, a Register with all signals, and their values have more than the usual 1 MiB each.
QPlcSignalTable largeTable()
{
    QByteArray ini;
    for (int i = 0; i < Count; ++i)
        ini += '[' + nameOf(i).toUtf8() + "]\ntype = Real64[8]\nunit = m/s\ndescription = " + QByteArray(60, 'x')
            + '\n';
    return QPlcSignalTable::fromIni(ini);
}

}  // namespace

// A table that does not fit into a control frame of usual size: all that works with small ones
// works with it, too.
class tst_LargeTables : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void nodeWithAllSignalsBothWaysStarts();
    void tableComesOnlyWhenItIsWanted();
    void messageBeyondTheLimitOfTheMasterEndsItsConnection();
    void messageThatNeedNotBeLongHasTheUsualLimit();
    void tableThatIsTooLongForAMessageIsRefusedWithTheRemedy();

private:
    /// \return the greeting of the master
    QPlcMessage greet(ScriptedNode &client, bool wantsTable) const;

    std::unique_ptr<TestMaster> m_master;
};

void tst_LargeTables::init()
{
    static const QPlcSignalTable table = largeTable();
    QCOMPARE(table.size(), Count);
    m_master = std::make_unique<TestMaster>(QPlcClock::realTime(), table);
    QVERIFY(m_master->setInterval(std::chrono::seconds(1)));
    QVERIFY(m_master->setInitializationTimeout(std::chrono::milliseconds(Patience)));
    QVERIFY(m_master->listen());
}

QPlcMessage tst_LargeTables::greet(ScriptedNode &client, bool wantsTable) const
{
    if (!client.connectTo(m_master->serverPort()))
        return {};
    client.control.setMessageLimit(qplc::MaximumControlFrame);
    QJsonObject fields = client.helloFields();
    fields.insert("wantsTable", wantsTable);
    client.send(QPlcMessage::Hello, fields);
    const QPlcMessage hello = client.next(Patience);
    client.control.setSendLimit(quint32(hello.fields().value("longestMessage").toDouble()));
    return hello;
}

void tst_LargeTables::nodeWithAllSignalsBothWaysStarts()
{
    ScriptedNode node;
    node.table = m_master->signalTable();
    node.cyclic = "tcp";
    node.inputs.clear();
    for (int i = 0; i < Count; ++i)
        node.inputs << nameOf(i);
    node.outputs = node.inputs;
    node.initialValues.clear();
    for (int i = 0; i < Count; ++i)
        node.initialValues += QPlcValue(double(i)).toBytes().repeated(8);
    QVERIFY(node.initialValues.toBase64().size() > int(qplc::UsualControlFrame));
    node.session = greet(node, false).hex64("session");
    node.send(QPlcMessage::Register, node.registerFields());
    QVERIFY(node.takeRegistered(node.next(Patience)));
    QVERIFY(node.attach());
    node.stream.disconnect();  // tst_LargeFrames has frames of many parts
    QVERIFY2(m_master->startRealTime(), qPrintable(m_master->errorString()));
    QVERIFY(waitUntil([&] { return m_master->state() == QPlcMasterNode::RealTime; }, Patience));
    const auto given = std::find_if(node.messages.begin(), node.messages.end(), [](const QPlcMessage &message) {
        return message.kind() == QPlcMessage::InitializeWithValues;
    });
    QVERIFY(given != node.messages.end());
    QCOMPARE(given->bytes("values"), node.initialValues);
    QCOMPARE(m_master->error(), QPlcMasterNode::NoError);
    m_master->stop();
}

void tst_LargeTables::tableComesOnlyWhenItIsWanted()
{
    for (bool isWanted : {true, false}) {
        ScriptedTool tool;
        const QPlcMessage hello = greet(tool, isWanted);
        QCOMPARE(hello.kind(), QPlcMessage::Hello);
        QCOMPARE(hello.fields().contains("table"), isWanted);
        if (isWanted)
            QCOMPARE(hello.text("table").toUtf8(), m_master->signalTable().toIni());
        tool.send(QPlcMessage::GetSignals, {{"names", QJsonArray{nameOf(Count - 1)}}});
        QCOMPARE(tool.next(Patience).kind(), QPlcMessage::Signals);
    }
}

void tst_LargeTables::messageBeyondTheLimitOfTheMasterEndsItsConnection()
{
    ScriptedTool tool;
    const quint32 longest = quint32(greet(tool, false).fields().value("longestMessage").toDouble());
    QVERIFY(longest > qplc::UsualControlFrame && longest <= qplc::MaximumControlFrame);
    tool.control.setSendLimit(qplc::MaximumControlFrame);
    tool.send(QPlcMessage::SetSignals, {{"padding", QString(int(longest) - 20, 'x')}});
    QCOMPARE(tool.next(Patience).text("error"), QString("MalformedMessage"));  // read, and refused
    tool.forgetMessages();
    tool.send(QPlcMessage::SetSignals, {{"padding", QString(int(longest), 'x')}});
    QVERIFY(waitUntil([&] { return !tool.control.isConnected(); }, Patience));
    QVERIFY(tool.messages.isEmpty() || tool.messages.first().kind() == QPlcMessage::Rejected);
}

/// Only what grows with the table may be longer than usual.
void tst_LargeTables::messageThatNeedNotBeLongHasTheUsualLimit()
{
    ScriptedTool tool;
    greet(tool, false);
    tool.control.setSendLimit(qplc::MaximumControlFrame);
    tool.send(QPlcMessage::GetState, {{"padding", QString(int(qplc::UsualControlFrame) - 20, 'x')}});
    QCOMPARE(tool.next(Patience).kind(), QPlcMessage::State);
    tool.forgetMessages();
    tool.send(QPlcMessage::GetState, {{"padding", QString(int(qplc::UsualControlFrame), 'x')}});
    QVERIFY(waitUntil([&] { return !tool.control.isConnected(); }, Patience));
    QVERIFY(tool.messages.isEmpty() || tool.messages.first().kind() == QPlcMessage::Rejected);
}

/// A table of a file has at most 64 MiB of text; one that a program makes may have more.
void tst_LargeTables::tableThatIsTooLongForAMessageIsRefusedWithTheRemedy()
{
    QPlcSignalTable table;
    QPlcSignalDefinition signal;
    signal.type = QPlcSignalType(QPlcSignalType::Real64);
    signal.description = QString(4000, 'x');
    constexpr int many = int(qplc::MaximumControlFrame / 4000) + 1;
    for (int i = 0; i < many; ++i) {
        signal.name = nameOf(i);
        QVERIFY(table.append(signal));
    }
    m_master = std::make_unique<TestMaster>(QPlcClock::realTime(), table);
    QVERIFY(m_master->listen());
    LogCapture log;
    ScriptedTool wanting;
    const QPlcMessage refusal = greet(wanting, true);
    QCOMPARE(refusal.kind(), QPlcMessage::Rejected);
    QCOMPARE(refusal.text("error"), QString("TooLong"));
    QVERIFY2(refusal.text("text").contains("the signal table is too long to be sent; give"),
             qPrintable(refusal.text("text")));
    ScriptedTool content;  // with its own table, or none
    QCOMPARE(greet(content, false).kind(), QPlcMessage::Hello);
}

QTEST_GUILESS_MAIN(tst_LargeTables)
#include "tst_LargeTables.moc"
