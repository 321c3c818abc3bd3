// SPDX-License-Identifier: Apache-2.0
// The qualities of signals from their writer to the code of their reader: with real nodes, and with
// scripted ones that break the rules.
#include "../common/Waiting.h"
#include "QualityFixtures.h"
#include "ScriptedMaster.h"

#include <QtCore/QProcess>

#include <atomic>

namespace {

void addKinds()
{
    QTest::addColumn<QString>("kind");
    for (const char *kind : {"local", "tcp", "udp"})
        QTest::newRow(kind) << QString(kind);
}

}  // namespace

class tst_Quality : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aBadValueNeverReachesTheActuator_data() { addKinds(); }
    void aBadValueNeverReachesTheActuator();
    void aSameCycleReaderSeesTheGuardedValue_data() { addKinds(); }
    void aSameCycleReaderSeesTheGuardedValue();
    void nodesWithoutQualityGetSafeValuesToo_data() { addKinds(); }
    void nodesWithoutQualityGetSafeValuesToo();
    void unwrittenSignalIsInvalidUntilItIsSet();
    void aWriterThatIsLostIsHeldAndThenSafe_data();
    void aWriterThatIsLostIsHeldAndThenSafe();
    void aWriterThatIsKilledIsHeldAndThenSafe_data();
    void aWriterThatIsKilledIsHeldAndThenSafe();
    void valueOfAListenerIsGoodUntilItLeaves();
    void theNextPhaseBeginsWithoutOldValues();
    void nodeRefusesInputsOutsideItsOwnLimits();
    void refusedValuesAreCountedAndRaiseAnAlarm();
    void initialOutputsOutOfRangeEndTheInitialization();
};

void tst_Quality::aBadValueNeverReachesTheActuator()
{
    QFETCH(QString, kind);
    TestMaster master(QPlcClock::lockstep(), qualityTable());
    QVERIFY(master.listen());
    Source source;
    source.idea = [](quint64 cycle) {
        const double bad[] = {qQNaN(), qInf(), -qInf(), 100.5, -1e9, qQNaN()};
        return cycle >= 4 && cycle < 10 ? bad[cycle - 4] : double(cycle);
    };
    Actuator actuator;
    QVERIFY(master.admit(source, kind) && master.admit(actuator, kind));
    master.setCycleLimit(14);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.error(), QPlcMasterNode::NoError);
    QCOMPARE(actuator.record,
             (QStringList{"0.5 good", "0 good", "1 good", "2 good", "3 good", "3 held 1", "3 held 2", "3 held 3",
                          "-5 safe", "-5 safe", "-5 safe", "10 good", "11 good", "12 good"}));
    source.disconnectFromMaster();
    actuator.disconnectFromMaster();
}

void tst_Quality::aSameCycleReaderSeesTheGuardedValue()
{
    QFETCH(QString, kind);
    TestMaster master(QPlcClock::lockstep(), qualityTable());
    QVERIFY(master.listen());
    Source source;
    source.idea = [](quint64 cycle) { return cycle == 2 || cycle == 4 ? qQNaN() : double(cycle); };
    Actuator actuator(QPlcInputTiming::SameCycle);
    QVERIFY(master.admit(source, kind) && master.admit(actuator, kind));
    master.setCycleLimit(6);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(actuator.record, (QStringList{"0 good", "1 good", "1 held 1", "3 good", "3 held 1", "5 good"}));
    source.disconnectFromMaster();
    actuator.disconnectFromMaster();
}

void tst_Quality::nodesWithoutQualityGetSafeValuesToo()
{
    QFETCH(QString, kind);
    TestMaster master(QPlcClock::lockstep(), qualityTable());
    QVERIFY(master.listen());
    Source source;
    source.idea = [](quint64 cycle) { return cycle < 2 ? double(cycle) : qQNaN(); };
    Actuator actuator(QPlcInputTiming::LastCycle, false);
    QVERIFY(master.admit(source, kind) && master.admit(actuator, kind));
    master.setCycleLimit(8);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(actuator.record,
             (QStringList{"0.5 invalid", "0 invalid", "1 invalid", "1 invalid", "1 invalid", "1 invalid", "-5 invalid",
                          "-5 invalid"}));
    source.disconnectFromMaster();
    actuator.disconnectFromMaster();
}

void tst_Quality::unwrittenSignalIsInvalidUntilItIsSet()
{
    TestMaster master(QPlcClock::lockstep(), qualityTable());
    QVERIFY(master.listen());
    Actuator actuator;
    QVERIFY(master.addLocalNode(&actuator));
    QCOMPARE(master.signalQuality("free").kind(), QPlcQuality::Invalid);
    master.setCycleLimit(3);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(actuator.seenFree, QString("3 invalid"));
    QCOMPARE(actuator.record.last(), QString("0 invalid"));
    QVERIFY(master.setSignalValue("free", 4.0));
    master.setCycleLimit(8);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(actuator.seenFree, QString("4 good"));
    QCOMPARE(master.signalQuality("free").kind(), QPlcQuality::Good);
    QCOMPARE(master.signalQuality("nonsense").kind(), QPlcQuality::Invalid);
}

void tst_Quality::aWriterThatIsLostIsHeldAndThenSafe_data()
{
    QTest::addColumn<QString>("cyclic");
    QTest::addColumn<bool>("isSameCycle");
    for (const char *cyclic : {"udp", "tcp"}) {
        QTest::addRow("%s", cyclic) << QString(cyclic) << false;
        QTest::addRow("%s, same cycle", cyclic) << QString(cyclic) << true;
    }
}

/// In lockstep the master waits for the writer until it is gone: the actuator's own record has each
/// step of the way.
void tst_Quality::aWriterThatIsLostIsHeldAndThenSafe()
{
    QFETCH(QString, cyclic);
    QFETCH(bool, isSameCycle);
    TestMaster master(QPlcClock::lockstep(), qualityTable());
    Actuator actuator(isSameCycle ? QPlcInputTiming::SameCycle : QPlcInputTiming::LastCycle);
    QVERIFY(master.addLocalNode(&actuator));
    QVERIFY(master.listen());
    ScriptedNode writer;
    writer.table = qualityTable();
    writer.cyclic = cyclic;
    writer.onRequest = [&](const ScriptedNode::Request &request) {
        if (request.cycle < 20)
            writer.answer(request.cycle, QPlcValue(double(request.cycle)).toBytes());
        else if (request.cycle == 20) {
            writer.control.close();
            writer.stream.abort();
        }
    };
    QVERIFY(writer.registerAt(master.serverPort()));
    master.setCycleLimit(40);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    const int first = actuator.record.indexOf("19 held 1");
    QCOMPARE(first, isSameCycle ? 20 : 21);
    QCOMPARE(actuator.record.mid(first - 1, 6),
             (QStringList{"19 good", "19 held 1", "19 held 2", "19 held 3", "-5 safe", "-5 safe"}));
    QCOMPARE(actuator.record.last(), QString("-5 safe"));
    QCOMPARE(master.signalQuality("echo").kind(), QPlcQuality::Safe);
}

void tst_Quality::aWriterThatIsKilledIsHeldAndThenSafe_data()
{
    QTest::addColumn<QString>("kind");
    for (const char *kind : {"tcp", "udp", "local"})
        QTest::newRow(kind) << QString(kind);
}

/// The process gets no chance to say goodbye.
void tst_Quality::aWriterThatIsKilledIsHeldAndThenSafe()
{
    QFETCH(QString, kind);
    TestMaster master(QPlcClock::lockstep(), qualityTable());
    Actuator actuator;
    QVERIFY(master.addLocalNode(&actuator));
    QVERIFY(master.listen());
    QProcess writer;
    writer.start(QCoreApplication::applicationFilePath(),
                 {"--writer", QStringLiteral("%1://127.0.0.1:%2").arg(kind).arg(master.serverPort())});
    QTRY_COMPARE(master.writer("echo"), QString("Source"));
    QTRY_COMPARE(master.nodes().size(), 2);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(50));
    writer.kill();
    QVERIFY(writer.waitForFinished());
    QTRY_COMPARE(master.signalQuality("echo").kind(), QPlcQuality::Safe);
    QVERIFY(master.waitForCycles(master.statistics().cycles + 3));
    master.stop();
    int last = actuator.record.size() - 1;
    while (last >= 0 && !actuator.record.at(last).endsWith("good"))
        --last;
    QVERIFY(last > 40 && last + 6 < actuator.record.size());
    const QString value = actuator.record.at(last).section(' ', 0, 0);
    QCOMPARE(actuator.record.mid(last + 1, 5),
             (QStringList{value + " held 1", value + " held 2", value + " held 3", "-5 safe", "-5 safe"}));
    QCOMPARE(actuator.record.mid(0, last).filter("good").size(), last);
}

void tst_Quality::valueOfAListenerIsGoodUntilItLeaves()
{
    TestMaster master(QPlcClock::lockstep(), qualityTable());
    Actuator actuator;
    QVERIFY(master.addLocalNode(&actuator));
    QVERIFY(master.listen());
    ScriptedNode window;
    window.table = qualityTable();
    window.listener = true;
    window.initialValues = QPlcValue(8.0).toBytes();
    QVERIFY(window.registerAt(master.serverPort()));
    QVERIFY(master.initializeAllStates());
    QVERIFY(window.waitForMessage(QPlcMessage::InitializeWithValues));
    QVERIFY(master.startRealTime());
    QVERIFY(window.waitForRequests(1));
    QVERIFY(master.waitForCycles(master.statistics().cycles + 1000));  // not one of which it has answered
    QCOMPARE(master.signalQuality("echo").kind(), QPlcQuality::Good);
    window.control.close();
    QTRY_COMPARE(master.signalQuality("echo").kind(), QPlcQuality::Safe);
    master.stop();
    QVERIFY(actuator.record.contains("8 held 3"));
    QCOMPARE(actuator.record.last(), QString("-5 safe"));
}

void tst_Quality::theNextPhaseBeginsWithoutOldValues()
{
    TestMaster master(QPlcClock::lockstep(), qualityTable());
    Actuator actuator;
    QVERIFY(master.addLocalNode(&actuator));
    {
        Source source;
        QVERIFY(master.addLocalNode(&source));
        master.setCycleLimit(10);
        QVERIFY(master.startRealTime());
        QVERIFY(master.waitForState(QPlcMasterNode::Off));
        QCOMPARE(master.signalQuality("echo").kind(), QPlcQuality::Good);
    }
    master.setCycleLimit(10);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(actuator.record.size(), 10);
    QCOMPARE(actuator.record.count("-5 safe"), 10);
}

void tst_Quality::nodeRefusesInputsOutsideItsOwnLimits()
{
    ScriptedMaster master(qualityTable());  // takes no care of limits
    Actuator actuator;
    actuator.setSignalTable(qualityTable());
    QVERIFY(master.beginWith(actuator));
    const auto echo = [](double value) { return QPlcValue(value).toBytes() + QPlcValue(0.0f).toBytes(); };
    for (int cycle = 0; cycle < 5; ++cycle) {
        master.request(quint64(cycle), echo(cycle == 3 ? 500.0 : 1.0));
        QVERIFY(master.waitForAnswers(cycle + 1));
    }
    QCOMPARE(actuator.record, (QStringList{"1 good", "1 good", "1 good", "1 held 1", "1 good"}));
    QCOMPARE(actuator.counters().refused, quint64(1));
    master.send(QPlcMessage::RealTimeStopped);
    master.send(QPlcMessage::SendYourInitialOutputStates);
    QCOMPARE(master.next().kind(), QPlcMessage::ReceiveMyInitialOutputStates);
    master.send(QPlcMessage::InitializeWithValues, {{"values", QPlcMessage::fromBytes(echo(1.0))}});
    QCOMPARE(master.next().kind(), QPlcMessage::Initialized);
    master.first += 10;
    QVERIFY(master.start(QStringLiteral("Lockstep")));  // each phase counts its own
    master.request(0, echo(1.0));
    QVERIFY(master.waitForAnswers(6));
    QCOMPARE(actuator.counters().refused, quint64(0));
    actuator.disconnectFromMaster();
}

void tst_Quality::refusedValuesAreCountedAndRaiseAnAlarm()
{
    LogCapture log;
    TestMaster master(QPlcClock::lockstep(), qualityTable());
    Source source;
    source.idea = [](quint64 cycle) { return cycle == 2 ? qQNaN() : cycle >= 5 ? 112.5 : 1.0; };
    QVERIFY(master.addLocalNode(&source));
    master.setCycleLimit(20);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    const QPlcCycleStatistics statistics = master.cycleStatistics();
    QCOMPARE(statistics.nodes.size(), 1);
    QCOMPARE(statistics.nodes.at(0).nonFinite, quint64(1));
    QCOMPARE(statistics.nodes.at(0).outOfRange, quint64(15));
    QCOMPARE(log.matching("echo of Source: nan is not a finite number; held").size(), 1);
    QCOMPARE(log.matching("echo of Source: no more values are refused; refused: 16, "
                          "the last one: 112.5 is above its maximum 100, after ")
                 .size(),
             1);
    QCOMPARE(log.matching("safe values: echo = -5").size(), 1);
    QCOMPARE(log.matching("echo").size(), 3);
}

void tst_Quality::initialOutputsOutOfRangeEndTheInitialization()
{
    TestMaster master(QPlcClock::lockstep(), qualityTable());
    ScriptedNode writer;
    writer.table = qualityTable();
    writer.initialValues = QPlcValue(101.0).toBytes();
    QVERIFY(master.listen() && writer.registerAt(master.serverPort()));
    LogCapture log;
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(master.error(), QPlcMasterNode::InitializationError);
    QVERIFY2(master.errorString().contains(
                 "node 'Scripted': the initial value of signal 'echo': 101 is above its maximum 100"),
             qPrintable(master.errorString()));
}

namespace {

/// The process that is killed: a node that writes "echo" until it dies.
int runWriter(const QString &master)
{
    QPlcSignalIndexTable::setCurrent(qualityTable());
    Source source;
    source.idea = [](quint64 cycle) { return double(cycle % 100); };
    return source.connectToMasterAndWaitForConnected(QPlcUnderlyingProtocol::fromString(master))
        ? QCoreApplication::exec()
        : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char **argv)
{
    QCoreApplication application(argc, argv);
    if (argc == 3 && QByteArray(argv[1]) == "--writer")
        return runWriter(QString::fromLocal8Bit(argv[2]));
    tst_Quality test;
    return QTest::qExec(&test, argc, argv);
}

#include "tst_Quality.moc"
