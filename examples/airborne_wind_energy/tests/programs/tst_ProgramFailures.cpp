// SPDX-License-Identifier: Apache-2.0
#include "ExampleOptions.h"
#include "Program.h"

#include <QtCore/QFile>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

#include <csignal>
#include <limits>

namespace {

/// Looks like the model to the master, until its power is no number any more.
class BrokenModel : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    /// \param soundCycles  in which all is well
    explicit BrokenModel(quint64 soundCycles)
        : QPlcCompactSlaveNode(QStringLiteral("Model"))
        , m_soundCycles(soundCycles)
    {
    }

private:
    void step(const QPlcCycle &cycle) override
    {
        m_power = cycle.number() < m_soundCycles ? 1.0 : std::numeric_limits<double>::quiet_NaN();
    }

    quint64 m_soundCycles;
    QPlcOutput<double> m_power{this, "power"};  // [W]
};

}  // namespace

/// Programs that meet what they cannot work with: another program, another table, a node that
/// fails.
class tst_ProgramFailures : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void portInUseIsRefused();
    void secondNodeOfOneNameIsRefused_data();
    void secondNodeOfOneNameIsRefused();
    void nodeThatDoesNotFitTheMasterIsRefused_data();
    void nodeThatDoesNotFitTheMasterIsRefused();
    void nodeThatWantsAMissingMulticastGroupIsRefused();
    void masterWhoseTableLacksItsOwnSignalDoesNotBegin();
    void nodesEndWithTheirMasterUnlessTheyAreToStay();
    void nodesWaitForTheNextMasterWhenTheirsIsLost();
    void notANumberValueEndsTheFlight();
    void lostNodeEndsTheFlight();
    void bothModelsFlyTheSameFlight_data();
    void bothModelsFlyTheSameFlight();
    void signalEndsAManuallyStartedMasterDuringAFlight();
    void flightWithoutModelReportsNoCrash();

private:
    static QString path(const char *program) { return QStringLiteral(AWE_PROGRAMS "/") + QString::fromLatin1(program); }
    /// Waits for the first line of a master. \return "--master=127.0.0.1:PORT"; empty when it does
    /// not come
    static QString address(Program &master);
    /// A table made of the built-in one. \return its file name
    QString table(const char *name, const QByteArray &from, const QByteArray &to);
    QJsonObject flyWith(const char *model, const QStringList &order);

    QTemporaryDir m_folder;
    QByteArray m_builtIn;
};

void tst_ProgramFailures::initTestCase()
{
    QFile file(awe::builtInSignals());
    QVERIFY(file.open(QIODevice::ReadOnly));
    m_builtIn = file.readAll();
}

QString tst_ProgramFailures::address(Program &master)
{
    if (!master.waitForOutput(QStringLiteral("\n")))
        return {};
    return QStringLiteral("--master=127.0.0.1:%1")
        .arg(master.output().section(QLatin1Char('\n'), 0, 0).section(QLatin1Char(' '), 1));
}

QString tst_ProgramFailures::table(const char *name, const QByteArray &from, const QByteArray &to)
{
    QByteArray text = m_builtIn;
    if (!text.contains(from))
        qFatal("the built-in table does not contain '%s'", from.constData());
    QFile file(m_folder.filePath(QString::fromLatin1(name)));
    file.open(QIODevice::WriteOnly);
    file.write(text.replace(from, to));
    return file.fileName();
}

void tst_ProgramFailures::portInUseIsRefused()
{
    Program first(path("awe_master"), {QStringLiteral("--port=0")});
    const QString port = address(first).section(QLatin1Char(':'), 1);
    QVERIFY(!port.isEmpty());
    const Outcome second = runProgram(path("awe_master"), {QStringLiteral("--port=") + port});
    QCOMPARE(second.exitCode, 2);
    QCOMPARE(second.output, QString());
    QVERIFY2(second.errors.contains(QStringLiteral("cannot listen on 127.0.0.1:%1").arg(port)),
             qPrintable(second.errors));
    QCOMPARE(second.errors.count(QLatin1Char('\n')), 1);
}

void tst_ProgramFailures::secondNodeOfOneNameIsRefused_data()
{
    QTest::addColumn<QString>("program");
    for (const char *program : {"awe_model", "awe_compact_model"})
        QTest::newRow(program) << path(program);
}

void tst_ProgramFailures::secondNodeOfOneNameIsRefused()
{
    QFETCH(QString, program);
    Program master(path("awe_master"), {QStringLiteral("--port=0")});
    const QString where = address(master);
    Program first(path("awe_model"), {where});
    QVERIFY(first.waitForErrors(QStringLiteral("registered")));
    const Outcome second = runProgram(program, {where});
    QCOMPARE(second.exitCode, 2);
    QVERIFY2(second.errors.contains(QLatin1String("'Model'")), qPrintable(second.errors));
    QCOMPARE(second.errors.count(QLatin1Char('\n')), 1);
    QCOMPARE(first.state(), QProcess::Running);
    // Under another name it still writes the same signals.
    const Outcome renamed = runProgram(program, {where, QStringLiteral("--name=Twin")});
    QCOMPARE(renamed.exitCode, 2);
    QVERIFY2(renamed.errors.contains(QLatin1String("node 'Model' writes it")), qPrintable(renamed.errors));
}

void tst_ProgramFailures::nodeThatDoesNotFitTheMasterIsRefused_data()
{
    QTest::addColumn<QString>("program");
    QTest::addColumn<QString>("masterTable");
    QTest::addColumn<QString>("nodeTable");
    QTest::addColumn<QString>("signal");
    const QString plain = table("plain.ini", "[power]", "[power]");
    const QString noLift = table("no_lift.ini", "[liftCoefficient]", "[liftOfTheWing]");
    const QString wideLength
        = table("wide_length.ini", "[tetherLength]\ntype = Real\n", "[tetherLength]\ntype = Real64\n");
    const QString feet
        = table("feet.ini", "[tetherLength]\ntype = Real\nunit = m\n", "[tetherLength]\ntype = Real\nunit = ft\n");
    for (const char *program : {"awe_model", "awe_compact_model"}) {
        QTest::addRow("%s: unknown to itself", program)
            << path(program) << plain << noLift << QStringLiteral("'liftCoefficient'");
        QTest::addRow("%s: unknown to the master", program)
            << path(program) << noLift << plain << QStringLiteral("'liftCoefficient'");
        QTest::addRow("%s: other type", program)
            << path(program) << plain << wideLength << QStringLiteral("'tetherLength'");
        QTest::addRow("%s: other unit", program) << path(program) << feet << plain << QStringLiteral("'tetherLength'");
    }
    QTest::addRow("awe_autopilot: other type")
        << path("awe_autopilot") << wideLength << plain << QStringLiteral("'tetherLength'");
}

void tst_ProgramFailures::nodeThatDoesNotFitTheMasterIsRefused()
{
    QFETCH(QString, program);
    QFETCH(QString, masterTable);
    QFETCH(QString, nodeTable);
    QFETCH(QString, signal);
    Program master(path("awe_master"), {QStringLiteral("--port=0"), QStringLiteral("--signals"), masterTable});
    const QString where = address(master);
    QVERIFY2(!where.isEmpty(), qPrintable(master.errors()));
    const Outcome node = runProgram(program, {where, QStringLiteral("--signals"), nodeTable});
    QCOMPARE(node.exitCode, 2);
    QVERIFY2(node.errors.contains(signal), qPrintable(node.errors));
    QCOMPARE(node.errors.count(QLatin1Char('\n')), 1);
    QCOMPARE(node.output, QString());
    QCOMPARE(master.state(), QProcess::Running);
}

void tst_ProgramFailures::nodeThatWantsAMissingMulticastGroupIsRefused()
{
    Program master(path("awe_master"), {QStringLiteral("--port=0")});
    const QString where
        = address(master).replace(QStringLiteral("--master="), QStringLiteral("--master=udp-multicast://"));
    const Outcome node = runProgram(path("awe_model"), {where});
    QCOMPARE(node.exitCode, 2);
    QVERIFY2(node.errors.contains(QLatin1String("this master has no multicast group; give it one, or use udp")),
             qPrintable(node.errors));
    QCOMPARE(node.errors.count(QLatin1Char('\n')), 1);
}

void tst_ProgramFailures::masterWhoseTableLacksItsOwnSignalDoesNotBegin()
{
    const QString file = table("no_time.ini", "[masterTime]", "[clockTime]");
    for (const char *program : {"awe_master", "awe_sil"}) {
        const Outcome outcome = runProgram(path(program), {QStringLiteral("--signals"), file});
        QCOMPARE(outcome.exitCode, 2);
        QCOMPARE(outcome.output, QString());
        QVERIFY2(outcome.errors.contains(QLatin1String("unknown signal 'masterTime'")), qPrintable(outcome.errors));
        QCOMPARE(outcome.errors.count(QLatin1Char('\n')), 1);
    }
}

void tst_ProgramFailures::nodesEndWithTheirMasterUnlessTheyAreToStay()
{
    Program master(path("awe_master"), {QStringLiteral("--port=0")});
    const QString where = address(master);
    Program model(path("awe_model"), {where});
    Program autopilot(path("awe_autopilot"),
                      {QStringLiteral("--stay"),
                       QString(where).replace(QStringLiteral("--master="), QStringLiteral("--master=udp://"))});
    QVERIFY(model.waitForErrors(QStringLiteral("registered")) && autopilot.waitForErrors(QStringLiteral("registered")));
    master.sendSignal(SIGTERM);
    QCOMPARE(model.waitForEnd(), 0);
    QVERIFY2(model.errors().contains(QLatin1String("the master has ended")), qPrintable(model.errors()));
    QVERIFY(autopilot.waitForErrors(QStringLiteral("cannot reach a master")));
    autopilot.sendSignal(SIGTERM);
    QCOMPARE(autopilot.waitForEnd(), 0);
}

void tst_ProgramFailures::nodesWaitForTheNextMasterWhenTheirsIsLost()
{
    Program master(path("awe_master"), {QStringLiteral("--port=0")});
    const QString where = address(master);
    Program model(path("awe_model"), {where});
    QVERIFY(model.waitForErrors(QStringLiteral("registered")));
    master.sendSignal(SIGKILL);
    QVERIFY(model.waitForErrors(QStringLiteral("has lost the master")));
    master.waitForEnd();
    Program next(path("awe_master"), {QStringLiteral("--port=%1").arg(where.section(QLatin1Char(':'), -1))});
    QVERIFY(next.waitForErrors(QStringLiteral("node Model registered")));
    next.sendSignal(SIGTERM);
    QCOMPARE(model.waitForEnd(), 0);
}

void tst_ProgramFailures::notANumberValueEndsTheFlight()
{
    Program master(path("awe_master"),
                   {QStringLiteral("--port=0"), QStringLiteral("--start-with=Model"), QStringLiteral("--duration=60")});
    const QString where = address(master).section(QLatin1Char('='), 1);
    QPlcSignalIndexTable table;
    QVERIFY(table.initializeFromIniFile(awe::builtInSignals()));
    BrokenModel model(10);
    QVERIFY(model.connectToMasterAndWaitForConnected(QPlcUnderlyingProtocol::fromString(where)));
    QTRY_VERIFY_WITH_TIMEOUT(master.state() == QProcess::NotRunning, Program::patience);
    QCOMPARE(master.waitForEnd(), 2);
    QVERIFY2(master.errors().contains(QLatin1String("power of Model: nan is not a finite number; held"))
                 && master.errors().contains(QLatin1String("node 'Model' gives values that are not finite numbers")),
             qPrintable(master.errors()));
    model.disconnectFromMaster();
}

void tst_ProgramFailures::lostNodeEndsTheFlight()
{
    const QString reportFile = m_folder.filePath(QStringLiteral("lost.json"));
    Program master(path("awe_master"),
                   {QStringLiteral("--port=0"), QStringLiteral("--real-time"),
                    QStringLiteral("--start-with=Model,Autopilot"), QStringLiteral("--report"), reportFile});
    const QString where = address(master);
    Program model(path("awe_compact_model"), {where});
    Program autopilot(path("awe_autopilot"), {where});
    QVERIFY(model.waitForErrors(QStringLiteral("registered")) && autopilot.waitForErrors(QStringLiteral("registered")));
    model.sendSignal(SIGKILL);
    QCOMPARE(master.waitForEnd(), 1);
    QVERIFY2(master.errors().contains(QLatin1String("node 'Model' is gone")), qPrintable(master.errors()));
    QCOMPARE(autopilot.waitForEnd(), 0);
}

QJsonObject tst_ProgramFailures::flyWith(const char *model, const QStringList &order)
{
    QFile report(m_folder.filePath(QString::fromLatin1(model) + QStringLiteral(".json")));
    Program master(path("awe_master"),
                   {QStringLiteral("--port=0"), QStringLiteral("--lockstep"),
                    QStringLiteral("--start-with=Model,Autopilot"), QStringLiteral("--duration=30"),
                    QStringLiteral("--report"), report.fileName()});
    const QString where = address(master);
    Program modelProgram(path(model), order + QStringList{where, QStringLiteral("--turbulence=0.1")});
    Program autopilot(path("awe_autopilot"), order + QStringList{where});
    if (master.waitForEnd() != 0 || modelProgram.waitForEnd() != 0 || autopilot.waitForEnd() != 0
        || !report.open(QIODevice::ReadOnly)) {
        qWarning() << master.errors() << modelProgram.errors() << autopilot.errors();
        return {};
    }
    return QJsonDocument::fromJson(report.readAll()).object();
}

void tst_ProgramFailures::bothModelsFlyTheSameFlight_data()
{
    QTest::addColumn<QStringList>("order");
    QTest::addColumn<int>("deadTime");
    QTest::newRow("default") << QStringList() << 2;
    QTest::newRow("same cycle") << QStringList{QStringLiteral("--same-cycle")} << 0;
}

void tst_ProgramFailures::bothModelsFlyTheSameFlight()
{
    QFETCH(QStringList, order);
    QFETCH(int, deadTime);
    const QJsonObject lists = flyWith("awe_model", order);
    const QJsonObject ports = flyWith("awe_compact_model", order);
    QCOMPARE(lists.value(QStringLiteral("dead_time_cycles")).toInt(-1), deadTime);
    QCOMPARE(lists.value(QStringLiteral("cycles")).toInt(), 3000);
    QVERIFY(!lists.value(QStringLiteral("image_digest")).toString().isEmpty());
    QCOMPARE(lists.value(QStringLiteral("image_digest")), ports.value(QStringLiteral("image_digest")));
    QCOMPARE(lists.value(QStringLiteral("energy_J")), ports.value(QStringLiteral("energy_J")));
}

void tst_ProgramFailures::signalEndsAManuallyStartedMasterDuringAFlight()
{
    const QString reportFile = m_folder.filePath(QStringLiteral("hand.json"));
    Program master(path("awe_master"), {QStringLiteral("--port=0"), QStringLiteral("--report"), reportFile});
    const QString where = address(master).section(QLatin1Char('='), 1);
    BrokenModel operatorNode(std::numeric_limits<quint64>::max());  // any node may command
    operatorNode.setName(QStringLiteral("Operator"));
    bool isDone = false;  // the answer to the start: the master flies
    connect(&operatorNode, &QPlcSlaveNode::messageReceived, this,
            [&isDone](const QPlcMessage &message) { isDone = isDone || message.kind() == QPlcMessage::Done; });
    QVERIFY(operatorNode.connectToMasterAndWaitForConnected(QPlcUnderlyingProtocol::fromString(where)));
    operatorNode.startRealTime();
    QTRY_VERIFY_WITH_TIMEOUT(isDone, Program::patience);
    master.sendSignal(SIGINT);
    QTRY_VERIFY_WITH_TIMEOUT(master.state() == QProcess::NotRunning, Program::patience);
    QCOMPARE(master.waitForEnd(), 0);
    QVERIFY2(master.output().contains(QLatin1String("Flight of ")), qPrintable(master.output()));
    QVERIFY(QFile::exists(reportFile));
    operatorNode.disconnectFromMaster();
}

void tst_ProgramFailures::flightWithoutModelReportsNoCrash()
{
    Program master(
        path("awe_master"),
        {QStringLiteral("--port=0"), QStringLiteral("--start-with=Autopilot"), QStringLiteral("--duration=1")});
    Program autopilot(path("awe_autopilot"), {address(master)});
    QCOMPARE(master.waitForEnd(), 0);
    QVERIFY2(master.output().contains(QLatin1String("Flight of 1.0 s")), qPrintable(master.output()));
    QVERIFY2(!master.output().contains(QLatin1String("CRASHED")), qPrintable(master.output()));
    QVERIFY2(master.output().contains(QLatin1String("There was no kite")), qPrintable(master.output()));
}

QTEST_GUILESS_MAIN(tst_ProgramFailures)
#include "tst_ProgramFailures.moc"
