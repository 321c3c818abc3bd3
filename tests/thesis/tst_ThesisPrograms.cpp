// SPDX-License-Identifier: Apache-2.0
#include "Program.h"
#include "TankModel.h"

#include <QtPlcCore>

#include <QtCore/QJsonArray>
#include <QtCore/QTemporaryDir>
#include <QtCore/QUuid>
#include <QtNetwork/QTcpServer>
#include <QtNetwork/QTcpSocket>
#include <QtTest/QtTest>

#include <csignal>

namespace {

using Values = QHash<QString, QPlcValue>;

const char masterSilent[] = "no frame of the master for 150 ms";
const double speed = 2.5;  // what the test sets [1/s]
const double valve = 0.5;

QString path(const QString &variant, const QString &program)
{
    return QStringLiteral(THESIS_PROGRAMS "/%1/%2").arg(variant, program);
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
    const QString copy = folder.filePath(QStringLiteral("bin/") + program);
    QDir(folder.path()).mkdir(QStringLiteral("bin"));
    return QFile::copy(path(QStringLiteral("plain"), program), copy) ? copy : QString();
}

/// The outputs after as many steps as a node does: the first one with initial inputs.
TankModel_Outputs tanksAfter(int steps)
{
    TankModel_initialize();
    for (int step = 0; step < steps; ++step) {
        TankModel_U.speed = step > 0 ? speed : 0.0;
        TankModel_U.valve = step > 0 ? valve : 0.0;
        TankModel_step();
    }
    return TankModel_Y;
}

}  // namespace

/// Programs in the form of the thesis's listings: a master (4.12) with a model (4.14) or a compact model (4.16), told by
/// a tool, ended by their ids.
class tst_ThesisPrograms : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void cleanup();
    void modelFollowsTheMaster_data();
    void modelFollowsTheMaster();
    void silentPartnersAreReported_data();
    void silentPartnersAreReported();
    void masterWithoutItsTableEndsWithAMessage();
    void modelWithoutItsTableTakesThatOfTheMaster_data();
    void modelWithoutItsTableTakesThatOfTheMaster();
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
    bool showsTanksAfter(int steps);

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
    if (!QTest::qWaitFor([&] { return listening.match(m_master->errors()).hasMatch(); }, Program::patience))
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
               {{QStringLiteral("protocol"), 1},
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
bool tst_ThesisPrograms::showsTanksAfter(int steps)
{
    const Values shown = values();
    const TankModel_Outputs expected = tanksAfter(steps);
    const std::pair<const char *, QPlcValue> outputs[] = {
        {"level", expected.level}, {"flow", expected.flow}, {"volume", expected.volume}, {"modelTime", expected.time}};
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
    QVERIFY(showsTanksAfter(1));
    const QJsonObject inputs{{QStringLiteral("speed"), QString::number(speed)},
                             {QStringLiteral("valve"), QString::number(valve)}};
    QVERIFY(ask(QPlcMessage::SetSignals, {{QStringLiteral("values"), inputs}}));

    const QDateTime before = QDateTime::currentDateTimeUtc();
    QVERIFY(ask(QPlcMessage::StartRealTime));
    const QDateTime after = QDateTime::currentDateTimeUtc();
    for (const char *measured : {"masterWorkload", "masterJitter", "modelWorkload", "modelTime"}) {
        const QString name = QString::fromLatin1(measured);
        const double floor = name == QLatin1String("modelTime") ? 0.1 : 0.0;
        QVERIFY2(QTest::qWaitFor([&] { return values().value(name).toReal() > floor; }, Program::patience), measured);
    }
    const qint64 early = values().value(QStringLiteral("masterTime")).toInt64();
    QTRY_VERIFY_WITH_TIMEOUT(values().value(QStringLiteral("masterTime")).toInt64() > early, Program::patience);
    QVERIFY(ask(QPlcMessage::Stop));
    const QPlcMessage off = state();
    QCOMPARE(off.text(QStringLiteral("state")), QStringLiteral("Off"));

    const Values stopped = values();
    QVERIFY(showsTanksAfter(qRound(stopped.value(QStringLiteral("modelTime")).toReal() * 100.0)));
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
    QVERIFY(ask(QPlcMessage::StartRealTime));
    const auto modelTime = [this] { return values().value(QStringLiteral("modelTime")).toReal(); };
    const auto lateAnswers
        = [this] { return state().fields().value(QStringLiteral("nodes"))[0][QStringLiteral("lateAnswers")].toInt(); };
    QTRY_VERIFY_WITH_TIMEOUT(modelTime() > 0.02, Program::patience);

    // The watchdog of the model.
    m_master->sendSignal(SIGSTOP);
    const bool barked = m_model->waitForErrors(QString::fromLatin1(masterSilent));
    m_master->sendSignal(SIGCONT);
    QVERIFY2(barked, qPrintable(m_model->errors()));
    QTRY_VERIFY_WITH_TIMEOUT(m_model->errors().count(QStringLiteral("registered")) > 1,
                             Program::patience);  // it is back
    QTRY_VERIFY_WITH_TIMEOUT(modelTime() > 0.02, Program::patience);

    // ErrorZeroOrderHold: the master reports a late model and goes on with its last values.
    m_model->sendSignal(SIGSTOP);
    QVERIFY2(m_master->waitForErrors(QStringLiteral("was late in cycle")), qPrintable(m_master->errors()));
    int late = lateAnswers();
    QTRY_VERIFY_WITH_TIMEOUT(lateAnswers() > late + 1, Program::patience);  // nothing is on its way any more
    const double held = modelTime();
    late = lateAnswers();
    QTRY_VERIFY_WITH_TIMEOUT(lateAnswers() > late + 2, Program::patience);
    QCOMPARE(modelTime(), held);
    m_model->sendSignal(SIGCONT);
    QTRY_VERIFY_WITH_TIMEOUT(modelTime() > held, Program::patience);
    QVERIFY(ask(QPlcMessage::Stop));
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

void tst_ThesisPrograms::modelWithoutItsTableTakesThatOfTheMaster_data()
{
    addModels();
}

void tst_ThesisPrograms::modelWithoutItsTableTakesThatOfTheMaster()
{
    QFETCH(QString, program);
    const QTemporaryDir folder;
    QVERIFY(startMaster(QStringLiteral("plain")));
    QVERIFY2(startModel(copyWithoutTable(folder, program)), qPrintable(m_model->errors()));
    QVERIFY(ask(QPlcMessage::InitializeAllStates));
    QVERIFY(showsTanksAfter(1));
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
