// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"

#include <QtCore/QLoggingCategory>

// The log at its debug level shows the exact bytes of what travels, and nothing of it otherwise.
class tst_Logging : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void cleanup() { QLoggingCategory::setFilterRules(QString()); }
    void normalOperationLogsNothing();
    void everyControlMessageIsLoggedByteByByte();
    void everyCyclicFrameIsLoggedByteByByte_data();
    void everyCyclicFrameIsLoggedByteByByte();
    void aFloodOfFramesIsCutAndDoesNotStopThePlant();
    void statesAreLogged();
};

void tst_Logging::normalOperationLogsNothing()
{
    LogCapture log;
    {
        TestMaster master;
        master.setCycleLimit(10);
        QVERIFY(master.listen());
        CounterNode counter;
        counter.setSignalTable(testTable());
        QVERIFY(counter.connectToMasterAndWaitForConnected(master.protocol("udp")));
        QVERIFY(master.startRealTime());
        QVERIFY(master.waitForState(QPlcMasterNode::Off));
        counter.disconnectFromMaster();
    }
    QVERIFY2(log.matching("qtplc.control").isEmpty() && log.matching("qtplc.cyclic").isEmpty(),
             qPrintable(log.all().join('\n')));
}

void tst_Logging::everyControlMessageIsLoggedByteByByte()
{
    QLoggingCategory::setFilterRules("qtplc.control.debug=true");
    LogCapture log;
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedTool tool;
    QVERIFY(tool.greetAt(master.serverPort()));
    QCOMPARE(tool.ask(QPlcMessage::Stop).kind(), QPlcMessage::Done);
    const QString stop = QString::fromLatin1(qplc::encodeControlFrame(QPlcMessage(QPlcMessage::Stop)).toHex(' '));
    const QString done = QString::fromLatin1(qplc::encodeControlFrame(QPlcMessage(QPlcMessage::Done)).toHex(' '));
    QVERIFY(!log.matching("to 127.0.0.1").filter("Stop " + stop).isEmpty());    // as sent by the tool
    QVERIFY(!log.matching("from 127.0.0.1").filter("Stop " + stop).isEmpty());  // as received by the master
    QVERIFY(!log.matching("to 127.0.0.1").filter("Done " + done).isEmpty());
    QVERIFY(!log.matching("from 127.0.0.1").filter("Done " + done).isEmpty());
    QVERIFY(log.matching("qtplc.cyclic").isEmpty());
}

void tst_Logging::everyCyclicFrameIsLoggedByteByByte_data()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("udp") << "udp";
    QTest::newRow("tcp") << "tcp";
}

void tst_Logging::everyCyclicFrameIsLoggedByteByByte()
{
    QFETCH(QString, kind);
    QLoggingCategory::setFilterRules("qtplc.cyclic.debug=true");
    LogCapture log;
    TestMaster master;
    QVERIFY(master.listen());
    CounterNode counter;  // its log shows the other end
    QVERIFY(counter.connectToMasterAndWaitForConnected(master.protocol(kind)));
    ScriptedNode node;
    node.cyclic = kind;
    QVERIFY(node.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QVERIFY(node.waitForRequests(1));
    const QVector<QByteArray> answer = node.answerFrames(node.requests.at(0).cycle, QPlcValue(1.0).toBytes());
    node.sendFrame(answer.at(0));
    QVERIFY(node.waitForRequests(2));
    const QString id = node.registered.fields().value("node").toVariant().toString();
    const QString sent = QString("qtplc.cyclic: Master sent for node %1 %2")
                             .arg(id, QString::fromLatin1(node.requests.at(0).bytes.toHex(' ')));
    const QString received
        = QString("qtplc.cyclic: Master received for node %1 %2").arg(id, QString::fromLatin1(answer.at(0).toHex(' ')));
    QTRY_COMPARE(log.matching(sent).size(), 1);
    QTRY_COMPARE(log.matching(received).size(), 1);
    QTRY_VERIFY(!log.matching("Counter received for node").isEmpty());
    QTRY_VERIFY(!log.matching("Counter sent for node").isEmpty());
    QVERIFY(log.matching("qtplc.control").isEmpty());
    master.stop();
    counter.disconnectFromMaster();
}

void tst_Logging::aFloodOfFramesIsCutAndDoesNotStopThePlant()
{
    QLoggingCategory::setFilterRules("qtplc.cyclic.debug=true");
    LogCapture log;
    TestMaster master;
    master.setCycleLimit(5000);
    QVERIFY(master.listen());
    CounterNode counter;
    QVERIFY(counter.connectToMasterAndWaitForConnected(master.protocol("udp")));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.statistics().cycles, quint64(5000));
    QVERIFY(!log.matching("Master sent").isEmpty());
    QVERIFY(log.matching("Master sent").size() <= 5100);
    counter.disconnectFromMaster();
}

void tst_Logging::statesAreLogged()
{
    QLoggingCategory::setFilterRules("qtplc.master.debug=true\nqtplc.slave.debug=true");
    LogCapture log;
    TestMaster master;
    QVERIFY(master.listen());
    CounterNode counter;
    QVERIFY(counter.connectToMasterAndWaitForConnected(master.protocol("tcp")));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    counter.disconnectFromMaster();
    master.stop();
    QVERIFY(!log.matching("qtplc.master").filter("Real time").isEmpty());
    QVERIFY(!log.matching("qtplc.slave").filter("Counter").filter("RealTime").isEmpty());
}

QTEST_GUILESS_MAIN(tst_Logging)
#include "tst_Logging.moc"
