// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "LaweModel.h"
#include "Program.h"

#include <QtPlcCore>

#include <QtCore/QJsonArray>
#include <QtCore/QTemporaryDir>
#include <QtCore/QThread>
#include <QtCore/QUuid>
#include <QtNetwork/QTcpServer>
#include <QtNetwork/QTcpSocket>

#include <cmath>
#include <csignal>
#include <vector>

namespace {

using Values = QHash<QString, QPlcValue>;

const char masterSilent[] = "no frame of the master for 15 ms";
// What the test sets, as the signals of type Real have it.
const double pitchSpeed = -0.5;                        // [deg/s]
const double yawSpeed = 2.5;                           // [deg/s]
const double tetherSpeed = double(1.9F);               // [m/s]
const double tetherLengthOfStep = 0.01 * tetherSpeed;  // [m]

QString path(const QString &variant, const QString &program)
{
    return QStringLiteral(THESIS_PROGRAMS "/%1/bin/%2").arg(variant, program);
}

void addModels()
{
    QTest::addColumn<QString>("program");
    QTest::newRow("model") << "model";
    QTest::newRow("compact model") << "compact_model";
}

/// A copy of a program at a place where it does not find its signal table.
QString copyWithoutTable(const QTemporaryDir &folder, const QString &program)
{
    const QString copy = folder.filePath(QStringLiteral("plain/bin/") + program);
    QDir(folder.path()).mkpath(QStringLiteral("plain/bin"));
    return QFile::copy(path(QStringLiteral("plain"), program), copy) ? copy : QString();
}

/// The outputs after as many steps as a node does: the first one with initial inputs.
LaweModel_Outputs kiteAfter(int steps)
{
    LaweModel_initialize();
    for (int step = 0; step < steps; ++step) {
        LaweModel_U.bodyControlPitchSpeed = step > 0 ? pitchSpeed : 0.0;
        LaweModel_U.bodyControlYawSpeed = step > 0 ? yawSpeed : 0.0;
        LaweModel_U.tetherSpeed = step > 0 ? tetherSpeed : 0.0;
        LaweModel_step();
    }
    return LaweModel_Y;
}

}  // namespace

/// Programs with the calls of the thesis's listings: a master (4.12) with a model (4.14) or a
/// compact model (4.16), told by a tool, ended by their ids.
class tst_ThesisPrograms : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void cleanup();
    void modelFollowsTheMaster_data();
    void modelFollowsTheMaster();
    void silentPartnersAreReported_data();
    void silentPartnersAreReported();
    void pausesOfFortyMillisecondsDoNotStopTheFlight_data();
    void pausesOfFortyMillisecondsDoNotStopTheFlight();
    void masterWithoutItsTableEndsWithAMessage();
    void modelWithoutItsTableUsesTheTableOfTheMaster_data();
    void modelWithoutItsTableUsesTheTableOfTheMaster();
    void masterOnAPortInUseEndsWithAMessage();
    void modelWithoutAMasterEndsWithAMessage_data();
    void modelWithoutAMasterEndsWithAMessage();

private:
    bool startMaster(const QString &variant);
    bool connectTool();
    bool startModel(const QString &program);
    bool ask(QPlcMessage::Kind kind, const QJsonObject &fields = {}, QPlcMessage *answer = nullptr);
    QPlcMessage state();
    Values values();
    bool showsKiteAfter(int steps);
    double tetherLength() { return values().value(QStringLiteral("tetherLength")).toReal(); }
    bool setControls();
    bool isFlying(double *tetherLength);

    std::unique_ptr<Program> m_master, m_model;
    std::unique_ptr<QPlcMasterSocket> m_tool;
    QList<QPlcMessage> m_answers;
    quint16 m_port = 0;
};

// ---- the plant ----

void tst_ThesisPrograms::cleanup()
{
    m_tool.reset();
    m_model.reset();
    m_master.reset();
    QCOMPARE(childrenOf(QCoreApplication::applicationPid()), QList<qint64>());
}

bool tst_ThesisPrograms::startMaster(const QString &variant)
{
    m_master = std::make_unique<Program>(path(variant, QStringLiteral("master")), QStringList{QStringLiteral("0")});
    const QRegularExpression listening(QStringLiteral("listening on 127\\.0\\.0\\.1 port (\\d+) security none\n"));
    if (!waitUntil([&] { return listening.match(m_master->errors()).hasMatch(); }))
        return false;
    m_port = listening.match(m_master->errors()).captured(1).toUShort();
    return connectTool();
}

/// Joins the master as a tool: a control connection without a node.
bool tst_ThesisPrograms::connectTool()
{
    m_answers.clear();
    m_tool = std::make_unique<QPlcMasterSocket>();
    connect(m_tool.get(), &QPlcAbstractSocket::messageReceived, this, [this](const QPlcMessage &message) {
        if (message.kind() != QPlcMessage::StatesInitialized)  // for all; who asked gets an answer of its own
            m_answers.append(message);
    });
    QSignalSpy connected(m_tool.get(), &QPlcAbstractSocket::connected);
    m_tool->connectToMaster(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, m_port));
    return connected.wait(Program::patience)
        && ask(QPlcMessage::Hello,
               {{QStringLiteral("protocol"), 2},
                {QStringLiteral("name"), QStringLiteral("tst_ThesisPrograms")},
                {QStringLiteral("uuid"), QUuid::createUuid().toString(QUuid::WithoutBraces)},
                {QStringLiteral("role"), QStringLiteral("tool")},
                {QStringLiteral("features"), QJsonArray()}});
}

bool tst_ThesisPrograms::startModel(const QString &program)
{
    m_model = std::make_unique<Program>(program, QStringList{QString::number(m_port)});
    return m_model->waitForErrors(QStringLiteral("registered"));
}

/// Asks the master and waits for its answer. \return false when it refused, or did not answer
bool tst_ThesisPrograms::ask(QPlcMessage::Kind kind, const QJsonObject &fields, QPlcMessage *answer)
{
    QSignalSpy messages(m_tool.get(), &QPlcAbstractSocket::messageReceived);
    bool alive = m_tool->sendMessage(QPlcMessage(kind, fields));
    while (alive && m_answers.isEmpty())
        alive = messages.wait(Program::patience);
    const QPlcMessage received = alive ? m_answers.takeFirst() : QPlcMessage();
    if (answer)
        *answer = received;
    const bool refused = received.kind() == QPlcMessage::Failed || received.kind() == QPlcMessage::Rejected;
    if (!alive || refused)
        qWarning().noquote() << QPlcMessage::kindName(kind) << "failed:" << received.text(QStringLiteral("text"))
                             << m_tool->errorString();
    return alive && !refused;
}

QPlcMessage tst_ThesisPrograms::state()
{
    QPlcMessage answer;
    ask(QPlcMessage::GetState, {}, &answer);
    return answer;
}

Values tst_ThesisPrograms::values()
{
    QPlcMessage answer;
    ask(QPlcMessage::GetSignals, {}, &answer);
    Values values;
    for (const QJsonValue &field : answer.fields().value(QStringLiteral("signals")).toArray()) {
        const auto text = [&field](const char *name) { return field[QLatin1String(name)].toString(); };
        values.insert(text("name"), QPlcValue::fromString(QPlcSignalType::fromName(text("type")), text("value")));
    }
    return values;
}

/// Whether the master has, bit by bit, what the model gives after \a steps.
bool tst_ThesisPrograms::showsKiteAfter(int steps)
{
    const Values shown = values();
    const LaweModel_Outputs expected = kiteAfter(steps);
    const std::pair<const char *, QPlcValue> outputs[]
        = {{"bodyPosition_earth", expected.bodyPosition_earth},
           {"bodyVelocity_earth", expected.bodyVelocity_earth},
           {"windVelocity_earth", expected.windVelocity_earth},
           {"bodyControlOrientation", expected.bodyControlOrientation},
           {"bodyPositionOrientation", expected.bodyPositionOrientation},
           {"angleOfAttack", expected.angleOfAttack},
           {"dragCoefficient", expected.dragCoefficient},
           {"liftCoefficient", expected.liftCoefficient},
           {"aweCoefficient", expected.aweCoefficient},
           {"aerodynamicForce_earth", expected.aerodynamicForce_earth},
           {"tetherForce_earth", expected.tetherForce_earth},
           {"gravitationalForce_earth", expected.gravitationalForce_earth},
           {"tetherLength", expected.tetherLength},
           {"power", expected.power},
           {"averagePower", expected.averagePower},
           {"energy", expected.energy}};
    for (const auto &[name, value] : outputs) {
        const QPlcValue seen = shown.value(QString::fromLatin1(name));
        if (seen == value.convertedTo(seen.type()))
            continue;
        qWarning().noquote() << name << "after" << steps << "steps:" << seen.toString() << "instead of"
                             << value.toString();
        return false;
    }
    return true;
}

bool tst_ThesisPrograms::setControls()
{
    const QJsonObject inputs{{QStringLiteral("bodyControlPitchSpeed"), QString::number(pitchSpeed)},
                             {QStringLiteral("bodyControlYawSpeed"), QString::number(yawSpeed)},
                             {QStringLiteral("tetherSpeed"), QStringLiteral("1.9")}};
    return ask(QPlcMessage::SetSignals, {{QStringLiteral("values"), inputs}});
}

// ---- together ----

void tst_ThesisPrograms::modelFollowsTheMaster_data()
{
    QTest::addColumn<QString>("variant");
    QTest::addColumn<QString>("program");
    QTest::addColumn<QString>("node");
    for (const char *variant : {"plain", "no_keywords"}) {
        QTest::addRow("model, %s", variant) << variant << "model"
                                            << "Model";
        QTest::addRow("compact model, %s", variant) << variant << "compact_model"
                                                    << "CompactModel";
    }
}

void tst_ThesisPrograms::modelFollowsTheMaster()
{
    QFETCH(QString, variant);
    QFETCH(QString, program);
    QFETCH(QString, node);
    QVERIFY(startMaster(variant));
    QVERIFY2(startModel(path(variant, program)), qPrintable(m_model->errors()));
    QVERIFY2(m_model->errors().contains(QStringLiteral("node %1 registered").arg(node)), qPrintable(m_model->errors()));

    QVERIFY(ask(QPlcMessage::InitializeAllStates));
    QVERIFY(showsKiteAfter(1));
    QVERIFY(setControls());

    const QDateTime before = QDateTime::currentDateTimeUtc();
    QVERIFY(ask(QPlcMessage::StartRealTime));
    const QDateTime after = QDateTime::currentDateTimeUtc();
    for (const char *measured : {"masterWorkload", "masterJitter", "modelWorkload"}) {
        const auto isMeasured = [&] { return values().value(QString::fromLatin1(measured)).toReal() > 0.0; };
        QVERIFY2(waitUntil(isMeasured), measured);
    }
    QTRY_VERIFY(tetherLength() > 100.2);
    const qint64 early = values().value(QStringLiteral("masterTime")).toInt64();
    QTRY_VERIFY(values().value(QStringLiteral("masterTime")).toInt64() > early);
    QVERIFY(ask(QPlcMessage::Stop));
    const QPlcMessage off = state();
    QCOMPARE(off.text(QStringLiteral("state")), QStringLiteral("Off"));

    const Values stopped = values();
    // Step 1 is that of the initialization; the tether of step 2 has its initial length still.
    const double reeledOut = stopped.value(QStringLiteral("tetherLength")).toReal() - 100.0;
    QVERIFY(showsKiteAfter(qRound(reeledOut / tetherLengthOfStep) + 2));
    // The time is that of the start and a period for each cycle.
    const qint64 late = stopped.value(QStringLiteral("masterTime")).toInt64();
    const qint64 period = 10000000;
    QCOMPARE((late - early) % period, 0);
    const qint64 start = (late - qint64(off.hex64(QStringLiteral("cycle"))) * period) / 1000000;
    QVERIFY2(start >= before.toMSecsSinceEpoch() && start <= after.toMSecsSinceEpoch(),
             qPrintable(QString::number(start)));

    QTest::qWait(50);  // some periods in which nothing may happen
    QVERIFY(values() == stopped);
}

void tst_ThesisPrograms::silentPartnersAreReported_data()
{
    addModels();
}

void tst_ThesisPrograms::silentPartnersAreReported()
{
    QFETCH(QString, program);
    QVERIFY(startMaster(QStringLiteral("plain")));
    QVERIFY2(startModel(path(QStringLiteral("plain"), program)), qPrintable(m_model->errors()));
    QVERIFY(setControls());
    QVERIFY(ask(QPlcMessage::StartRealTime));
    const auto lateAnswers
        = [this] { return state().fields().value(QStringLiteral("nodes"))[0][QStringLiteral("lateAnswers")].toInt(); };
    QTRY_VERIFY(tetherLength() > 100.0);

    // The watchdog of the model informs: the model goes on where it was.
    const double before = tetherLength();
    m_master->sendSignal(SIGSTOP);
    const bool barked = m_model->waitForErrors(QString::fromLatin1(masterSilent));
    m_master->sendSignal(SIGCONT);
    QVERIFY2(barked, qPrintable(m_model->errors()));
    const double after = tetherLength();
    QVERIFY2(after >= before, qPrintable(QStringLiteral("%1 m after %2 m").arg(after).arg(before)));
    QTRY_VERIFY(tetherLength() > after);
    QCOMPARE(m_model->errors().count(QStringLiteral("registered")), 1);

    // ErrorZeroOrderHold: the master reports a late model and goes on with its last values, however
    // long.
    m_model->sendSignal(SIGSTOP);
    QVERIFY2(m_master->waitForErrors(QStringLiteral("was late in cycle")), qPrintable(m_master->errors()));
    int late = lateAnswers();
    QTRY_VERIFY(lateAnswers() > late + 1);  // nothing is on its way any more
    const double held = tetherLength();
    QVERIFY(held > 100.0);
    late = lateAnswers();
    QTRY_VERIFY(lateAnswers() > late + 10);
    QCOMPARE(tetherLength(), held);
    m_model->sendSignal(SIGCONT);
    QTRY_VERIFY(tetherLength() > held);
    QCOMPARE(m_model->errors().count(QStringLiteral("registered")), 1);
    QVERIFY(ask(QPlcMessage::Stop));
}

/// Stops a program as an ordinary kernel may do it.
static void halt(Program &program)
{
    program.sendSignal(SIGSTOP);
    QThread::msleep(40);
    program.sendSignal(SIGCONT);
}

/// Whether no signal of the flight has fallen back since \a tetherLength, which becomes that of
/// now.
bool tst_ThesisPrograms::isFlying(double *tetherLength)
{
    const Values now = values();
    const auto value = [&now](const char *name, int i = 0) { return now.value(QString::fromLatin1(name)).toReal(i); };
    const bool isKept = value("tetherLength") >= *tetherLength && value("tetherSpeed") > 1.8
        && value("windVelocity_earth", 0) == 5.0 && value("windVelocity_earth", 1) == 3.0
        && value("gravitationalForce_earth", 2) < -49.0 && value("dragCoefficient") > 0.0
        && std::hypot(value("bodyPosition_earth", 0), value("bodyPosition_earth", 1), value("bodyPosition_earth", 2))
            > 90.0;
    if (!isKept) {
        for (auto signal = now.begin(); signal != now.end(); ++signal)
            qWarning().noquote() << signal.key() << "=" << signal.value().toString();
    }
    *tetherLength = value("tetherLength");
    return isKept;
}

void tst_ThesisPrograms::pausesOfFortyMillisecondsDoNotStopTheFlight_data()
{
    addModels();
}

/// Every second the model and then the master stand still for 40 ms: the watchdog of 15 ms informs,
/// and the flight goes on where it was. THESIS_SECONDS is the time [s], THESIS_LOAD the number of
/// programs that only compute beside it.
void tst_ThesisPrograms::pausesOfFortyMillisecondsDoNotStopTheFlight()
{
    QFETCH(QString, program);
    const int seconds = qMax(1, qEnvironmentVariable("THESIS_SECONDS", QStringLiteral("5")).toInt());
    std::vector<std::unique_ptr<Program>> load;
    for (int i = 0; i < qEnvironmentVariableIntValue("THESIS_LOAD"); ++i)
        load.push_back(std::make_unique<Program>(
            QStringLiteral("/bin/sh"), QStringList{QStringLiteral("-c"), QStringLiteral("while :; do :; done")}));
    QVERIFY(startMaster(QStringLiteral("plain")));
    QVERIFY2(startModel(path(QStringLiteral("plain"), program)), qPrintable(m_model->errors()));
    QVERIFY(setControls());
    QVERIFY(ask(QPlcMessage::StartRealTime));
    QTRY_VERIFY(tetherLength() > 100.1);

    double length = 100.0;
    for (int second = 0; second < seconds; ++second) {
        for (Program *halted : {m_model.get(), m_master.get()}) {
            halt(*halted);
            for (int look = 0; look < 5; ++look) {
                QVERIFY2(isFlying(&length), qPrintable(m_model->errors() + m_master->errors()));
                QTest::qWait(90);
            }
        }
    }
    QVERIFY(ask(QPlcMessage::Stop));
    load.clear();
    QVERIFY2(length > 100.0 + 0.3 * seconds * tetherSpeed, qPrintable(QString::number(length)));
    QVERIFY2(m_model->errors().contains(QString::fromLatin1(masterSilent)), qPrintable(m_model->errors()));
    QVERIFY2(m_master->errors().contains(QStringLiteral("was late in cycle")), qPrintable(m_master->errors()));
    QCOMPARE(m_model->errors().count(QStringLiteral("registered")), 1);
    // Bit by bit the flight that the model has computed without a break.
    QVERIFY(showsKiteAfter(qRound((tetherLength() - 100.0) / tetherLengthOfStep) + 2));
}

// ---- what is missing ----

void tst_ThesisPrograms::masterWithoutItsTableEndsWithAMessage()
{
    const QTemporaryDir folder;
    const Outcome outcome = runProgram(copyWithoutTable(folder, QStringLiteral("master")), {QStringLiteral("0")});
    QCOMPARE(outcome.exitCode, 2);
    QVERIFY2(outcome.errors.contains(QStringLiteral("the master has no signals; read a table with")),
             qPrintable(outcome.errors));
    QVERIFY2(!outcome.errors.contains(QStringLiteral("listening")), qPrintable(outcome.errors));
}

void tst_ThesisPrograms::modelWithoutItsTableUsesTheTableOfTheMaster_data()
{
    addModels();
}

void tst_ThesisPrograms::modelWithoutItsTableUsesTheTableOfTheMaster()
{
    QFETCH(QString, program);
    const QTemporaryDir folder;
    QVERIFY(startMaster(QStringLiteral("plain")));
    QVERIFY2(startModel(copyWithoutTable(folder, program)), qPrintable(m_model->errors()));
    QVERIFY(ask(QPlcMessage::InitializeAllStates));
    QVERIFY(showsKiteAfter(1));
}

void tst_ThesisPrograms::masterOnAPortInUseEndsWithAMessage()
{
    QTcpServer server;
    QVERIFY(server.listen(QHostAddress::LocalHost));
    const QString port = QString::number(server.serverPort());
    const Outcome outcome = runProgram(path(QStringLiteral("plain"), QStringLiteral("master")), {port});
    QCOMPARE(outcome.exitCode, 2);
    QVERIFY2(outcome.errors.contains(port) && outcome.errors.contains(QStringLiteral("in use")),
             qPrintable(outcome.errors));
}

void tst_ThesisPrograms::modelWithoutAMasterEndsWithAMessage_data()
{
    addModels();
}

void tst_ThesisPrograms::modelWithoutAMasterEndsWithAMessage()
{
    QFETCH(QString, program);
    QTcpSocket nobody;  // has the port, but does not listen
    QVERIFY2(nobody.bind(QHostAddress::LocalHost, 0, QAbstractSocket::DontShareAddress),
             qPrintable(nobody.errorString()));
    const QString port = QString::number(nobody.localPort());
    const Outcome outcome = runProgram(path(QStringLiteral("plain"), program), {port});
    QCOMPARE(outcome.exitCode, 2);
    QVERIFY2(outcome.errors.contains(QStringLiteral("127.0.0.1:") + port), qPrintable(outcome.errors));
}

QTEST_GUILESS_MAIN(tst_ThesisPrograms)
#include "tst_ThesisPrograms.moc"
