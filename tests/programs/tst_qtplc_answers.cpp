// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ProcessPlant.h"
#include "signals/PayloadLayout.h"

#include <QtPlcCore>

#include <QtNetwork/QTcpServer>

namespace {

/// A master that answers each kind of request with what the test says, and nothing else.
class AnsweringMaster : public QObject
{
    Q_OBJECT
public:
    AnsweringMaster()
    {
        m_server.listen(QHostAddress::LocalHost);
        connect(&m_server, &QTcpServer::newConnection, this, [this] {
            auto *socket = new QPlcSlaveSocket(m_server.nextPendingConnection(), this);
            connect(socket, &QPlcAbstractSocket::messageReceived, this,
                    [this, socket](const QPlcMessage &message) { answer(socket, message); });
        });
    }
    QStringList withMaster(const QString &command) const
    {
        return QStringList{QStringLiteral("--master=127.0.0.1:%1").arg(m_server.serverPort())}
        + command.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    }
    /// Runs qtplc while this master answers.
    Outcome qtplc(const QString &command) { return run(withMaster(command)); }
    Outcome run(const QStringList &arguments)
    {
        Program program(programPath("qtplc"), arguments);
        (void)waitUntil([&program] { return program.state() == QProcess::NotRunning; });
        return {program.waitForEnd(), program.output(), program.errors()};
    }

    QMap<int, QPlcMessage> answers;  // by kind of the request; others are answered as a master that does not know them
    QMap<int, QPlcMessage> further;  // by kind of the request: what follows the answer
    QVector<QPlcMessage> requests;
    std::function<void(const QPlcMessage &request)> prepare = [](const QPlcMessage &) {};

private:
    void answer(QPlcSlaveSocket *socket, const QPlcMessage &message)
    {
        if (message.kind() == QPlcMessage::Hello) {
            socket->sendMessage(QPlcMessage(
                QPlcMessage::Hello, {{"protocol", 2}, {"name", "Master"}, {"table", "[power]\ntype = Real32\n"}}));
            return;
        }
        requests << message;
        prepare(message);
        const QPlcMessage unknown(QPlcMessage::Failed,
                                  {{"error", "MalformedMessage"}, {"text", "a master does not handle it"}});
        socket->sendMessage(answers.value(message.kind(), unknown));
        if (further.contains(message.kind()))
            socket->sendMessage(further.value(message.kind()));
    }
    QTcpServer m_server;
};

QJsonObject numbers(double scale, bool hasBins = false)
{
    QJsonObject object{{"count", 1000},     {"minimum", scale},    {"mean", 2.5 * scale},
                       {"p50", 2 * scale},  {"p01", 1.5 * scale},  {"p001", 1.25 * scale},
                       {"p99", 30 * scale}, {"p999", 400 * scale}, {"maximum", 5000 * scale}};
    if (hasBins)
        object.insert("bins",
                      QJsonArray{QJsonArray{2 * scale, 900}, QJsonArray{30 * scale, 99}, QJsonArray{5000 * scale, 1}});
    return object;
}

QJsonObject distribution(double scale, bool hasBins = false)
{
    return {{"sinceStart", numbers(scale, hasBins)}, {"last10s", numbers(10 * scale, hasBins)}};
}

QPlcMessage statistics(bool hasBins = false)
{
    const QJsonObject master{{"lateness", distribution(1000, hasBins)},
                             {"roundTrip", distribution(2000, hasBins)},
                             {"execution", distribution(10, hasBins)},
                             {"slack", distribution(100'000, hasBins)},
                             {"counters", QJsonObject{{"overruns", 3}}}};
    const QJsonObject node{{"name", "Wi\033nch"},
                           {"execution", distribution(10, hasBins)},
                           {"counters", QJsonObject{{"late", 7}, {"lost", 8}}}};
    const QJsonObject worst{
        {"cycle", 4711},     {"lateness", 1000},
        {"roundTrip", 2000}, {"execution", 3000},
        {"slack", -4000},    {"stages", QJsonArray{QJsonObject{{"name", "send"}, {"duration", 1500}}}}};
    return QPlcMessage(QPlcMessage::Statistics,
                       {{"master", master}, {"nodes", QJsonArray{node}}, {"worst", QJsonArray{worst}}});
}

QPlcMessage leases()
{
    const auto lease = [](const char *signal, const char *state) {
        return QJsonObject{{"signal", signal}, {"holder", "An\033na"}, {"lease", state}, {"timeout", 5e8}};
    };
    return QPlcMessage(QPlcMessage::Leases, {{"leases", QJsonArray{lease("power", "held"), lease("speed", "lost")}}});
}

QPlcMessage events(int first, int last, bool more)
{
    QJsonArray array;
    for (int i = first; i <= last; ++i)
        array << QJsonObject{{"sequence", i},
                             {"time", QPlcMessage::fromHex64(1'000'000'000ull * quint64(i))},
                             {"severity", i % 2 ? "info" : "warning"},
                             {"kind", "node"},
                             {"source", "Winch"},
                             {"text", QString("te\033xt %1").arg(i)}};
    return QPlcMessage(QPlcMessage::Events, {{"events", array}, {"more", more}});
}

}  // namespace

/// qtplc jitter, schedule, leases and events, against a master whose answers are known.
class tst_qtplc_answers : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_master.reset(new AnsweringMaster); }
    void jitterShowsBothWindowsOfMasterAndNodes();
    void jitterNamesCountersAndWorstCycles();
    void jitterDrawsHistograms();
    void jitterAsksForHistogramsOnlyWhenTheyAreWanted();
    void jitterReportsMissingStatistics();
    void scheduleShowsStagesAndLinks();
    void scheduleReportsAnEmptySchedule();
    void leasesShowHoldersAndLostOnes();
    void leasesReportsThatThereAreNone();
    void eventsArePrintedInTheirOrder();
    void eventsAreAskedForUntilThereAreNoMore();
    void anEndlessListOfEventsEnds();
    void eventsAsJsonAreALineEach();
    void jsonIsTheAnswerOfTheMaster_data();
    void jsonIsTheAnswerOfTheMaster();
    void olderMasterIsReported_data();
    void olderMasterIsReported();
    void otherRefusalIsShownAsItIs();
    void echoShowsTheValuesWhenAPhaseEndsWhileItJoins();
    void answerOfAnotherKindIsRefused();
    void malformedAnswersDoNotCrash_data();
    void malformedAnswersDoNotCrash();

private:
    QScopedPointer<AnsweringMaster> m_master;
};

void tst_qtplc_answers::jitterShowsBothWindowsOfMasterAndNodes()
{
    m_master->answers.insert(QPlcMessage::GetStatistics, statistics());
    const Outcome outcome = m_master->qtplc("jitter");
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.errors, QString());
    const auto row = [&outcome](const char *pattern) {
        return outcome.output.contains(QRegularExpression(QString(pattern), QRegularExpression::MultilineOption));
    };
    QVERIFY(row("^since start +count +mean +p50 +worst 1 % +worst 0\\.1 % +worst$"));
    QVERIFY2(row("^Master +lateness +1000 +2\\.50 µs +2\\.00 µs +30\\.0 µs +400 µs +5\\.00 ms$"),
             qPrintable(outcome.output));
    QVERIFY(row("^Master +lateness +1000 +25\\.0 µs +20\\.0 µs +300 µs +4\\.00 ms +50\\.0 ms$"));  // last 10 s
    QVERIFY(row("^Master +round trip +1000 +5\\.00 µs"));
    // Of slack the least that was left: 1 %, 0.1 %, minimum.
    QVERIFY(row("^Master +slack +1000 +250 µs +200 µs +150 µs +125 µs +100 µs$"));
    QVERIFY(row("^Wi\\\\x1bnch +execution +1000 +25 ns +20 ns +300 ns +4\\.00 µs +50\\.0 µs$"));
    QVERIFY(!outcome.output.contains('\033'));
    const QStringList table = outcome.output.section("\n\n", 0, 0).split('\n');
    for (const QString &line : table)
        QCOMPARE(line.size(), table.first().size());  // a character of two bytes shifts no column
}

void tst_qtplc_answers::jitterNamesCountersAndWorstCycles()
{
    m_master->answers.insert(QPlcMessage::GetStatistics, statistics());
    const QString output = m_master->qtplc("jitter").output;
    QVERIFY2(output.contains("\nMaster: overruns 3\nWi\\x1bnch: late 7, lost 8\n"), qPrintable(output));
    QVERIFY(
        output.contains(QRegularExpression("\n +4711 +1\\.00 µs +2\\.00 µs +3\\.00 µs +-4\\.00 µs +send 1\\.50 µs\n")));
}

void tst_qtplc_answers::jitterDrawsHistograms()
{
    m_master->answers.insert(QPlcMessage::GetStatistics, statistics(true));
    const Outcome outcome = m_master->qtplc("jitter --hist");
    QCOMPARE(outcome.exitCode, 0);
    QVERIFY2(
        outcome.output.startsWith("Master lateness, since start: 1000 values, p50 2.00 µs, p99 30.0 µs, max 5.00 ms\n"),
        qPrintable(outcome.output));
    QVERIFY(outcome.output.contains(QRegularExpression("<=  2\\.00 µs +900 +90\\.000 %  \u2588+\n")));
    QCOMPARE(outcome.output.count("since start"), 5);  // four of the master, one of the node
}

void tst_qtplc_answers::jitterAsksForHistogramsOnlyWhenTheyAreWanted()
{
    m_master->answers.insert(QPlcMessage::GetStatistics, statistics());
    m_master->qtplc("jitter");
    m_master->qtplc("jitter --hist");
    QCOMPARE(m_master->requests.size(), 2);
    QCOMPARE(m_master->requests.at(0).fields().value("histograms").toBool(), false);
    QCOMPARE(m_master->requests.at(1).fields().value("histograms").toBool(), true);
}

void tst_qtplc_answers::jitterReportsMissingStatistics()
{
    m_master->answers.insert(QPlcMessage::GetStatistics, QPlcMessage(QPlcMessage::Statistics));
    QVERIFY(m_master->qtplc("jitter").output.contains("no statistics yet"));
}

void tst_qtplc_answers::scheduleShowsStagesAndLinks()
{
    const auto step = [](const char *node, const char *phase) { return QJsonObject{{"node", node}, {"phase", phase}}; };
    const QJsonArray stages{QJsonArray{step("Model", "outputs")},
                            QJsonArray{step("Autopilot", "step"), step("View", "step")},
                            QJsonArray{step("Model", "update")}};
    const QJsonArray links{
        QJsonObject{{"signal", "speed"}, {"from", "Autopilot"}, {"to", "Model"}, {"age", 0}, {"sameCycle", true}},
        QJsonObject{{"signal", "free"}, {"from", ""}, {"to", "Model"}, {"age", 1}, {"sameCycle", false}}};
    m_master->answers.insert(QPlcMessage::GetSchedule,
                             QPlcMessage(QPlcMessage::Schedule, {{"stages", stages}, {"links", links}}));
    const Outcome outcome = m_master->qtplc("schedule");
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.output,
             QString("stage  node       phase\n"
                     "    1  Model      outputs\n"
                     "    2  Autopilot  step\n"
                     "    2  View       step\n"
                     "    3  Model      update\n"
                     "\n"
                     "signal  from       to     age [cycles]  same cycle\n"
                     "speed   Autopilot  Model             0  yes\n"
                     "free    -          Model             1  -\n"));
}

void tst_qtplc_answers::scheduleReportsAnEmptySchedule()
{
    m_master->answers.insert(QPlcMessage::GetSchedule, QPlcMessage(QPlcMessage::Schedule));
    QCOMPARE(m_master->qtplc("schedule").output, QString("no nodes\n"));
}

void tst_qtplc_answers::leasesShowHoldersAndLostOnes()
{
    m_master->answers.insert(QPlcMessage::GetLeases, leases());
    const Outcome outcome = m_master->qtplc("leases");
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.output,
             QString("signal  holder    lease  timeout [s]\n"
                     "power   An\\x1bna  held           0.5\n"
                     "speed   An\\x1bna  lost           0.5\n"));
}

void tst_qtplc_answers::leasesReportsThatThereAreNone()
{
    m_master->answers.insert(QPlcMessage::GetLeases, QPlcMessage(QPlcMessage::Leases));
    QCOMPARE(m_master->qtplc("leases").output, QString("no leases\n"));
}

void tst_qtplc_answers::eventsArePrintedInTheirOrder()
{
    m_master->answers.insert(QPlcMessage::GetEvents, events(1, 2, false));
    const Outcome outcome = m_master->qtplc("events");
    QCOMPARE(outcome.exitCode, 0);
    const QString time = QDateTime::fromMSecsSinceEpoch(1000).toString("yyyy-MM-dd HH:mm:ss.zzz");
    const QStringList lines = outcome.output.split('\n');
    QCOMPARE(lines.size(), 3);
    QCOMPARE(lines.at(0), time + "  info     node     Winch  te\\x1bxt 1");
    QVERIFY2(lines.at(1).endsWith("  warning  node     Winch  te\\x1bxt 2"), qPrintable(lines.at(1)));
}

void tst_qtplc_answers::eventsAreAskedForUntilThereAreNoMore()
{
    m_master->answers.insert(QPlcMessage::GetEvents, events(1, 3, true));  // the same again and again: it must end
    const Outcome outcome = m_master->qtplc("events");
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.output.count('\n'), 3);
    QCOMPARE(m_master->requests.size(), 2);
    QCOMPARE(m_master->requests.at(0).fields().value("since").toInt(-1), 0);
    QCOMPARE(m_master->requests.at(1).fields().value("since").toInt(-1), 3);
}

void tst_qtplc_answers::anEndlessListOfEventsEnds()
{
    m_master->prepare = [this](const QPlcMessage &request) {
        const int next = request.fields().value("since").toInt() + 1;
        m_master->answers.insert(QPlcMessage::GetEvents, events(next, next, true));
    };
    const Outcome outcome = m_master->qtplc("events");
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(outcome.output.count('\n'), m_master->requests.size());
    QVERIFY(m_master->requests.size() > 5);  // more than a real master has
}

void tst_qtplc_answers::eventsAsJsonAreALineEach()
{
    const QPlcMessage answer = events(7, 8, false);
    m_master->answers.insert(QPlcMessage::GetEvents, answer);
    const QStringList lines = m_master->qtplc("events --json").output.split('\n', Qt::SkipEmptyParts);
    QCOMPARE(lines.size(), 2);
    for (int i = 0; i < 2; ++i)
        QCOMPARE(QJsonDocument::fromJson(lines.at(i).toUtf8()).object(),
                 answer.fields().value("events").toArray().at(i).toObject());
}

void tst_qtplc_answers::jsonIsTheAnswerOfTheMaster_data()
{
    QTest::addColumn<QString>("command");
    QTest::addColumn<int>("request");
    QTest::addColumn<QPlcMessage>("answer");
    QTest::newRow("jitter") << "jitter --json" << int(QPlcMessage::GetStatistics) << statistics();
    QTest::newRow("leases") << "leases --json" << int(QPlcMessage::GetLeases) << leases();
    QTest::newRow("schedule") << "schedule --json" << int(QPlcMessage::GetSchedule)
                              << QPlcMessage(QPlcMessage::Schedule, {{"stages", QJsonArray()}, {"later", 1}});
}

void tst_qtplc_answers::jsonIsTheAnswerOfTheMaster()
{
    QFETCH(QString, command);
    QFETCH(int, request);
    QFETCH(QPlcMessage, answer);
    m_master->answers.insert(request, answer);
    const Outcome outcome = m_master->qtplc(command);
    QCOMPARE(outcome.exitCode, 0);
    QCOMPARE(jsonOf(outcome.output).object(), answer.fields());
}

void tst_qtplc_answers::olderMasterIsReported_data()
{
    QTest::addColumn<QString>("command");
    QTest::addColumn<QString>("kind");
    QTest::newRow("jitter") << "jitter"
                            << "GetStatistics";
    QTest::newRow("histogram") << "jitter --hist"
                               << "GetStatistics";
    QTest::newRow("schedule") << "schedule --json"
                              << "GetSchedule";
    QTest::newRow("leases") << "leases"
                            << "GetLeases";
    QTest::newRow("events") << "events"
                            << "GetEvents";
    QTest::newRow("following") << "events --follow"
                               << "GetEvents";
}

void tst_qtplc_answers::olderMasterIsReported()
{
    QFETCH(QString, command);
    QFETCH(QString, kind);
    const Outcome outcome = m_master->qtplc(command);
    QCOMPARE(outcome.exitCode, 1);
    QCOMPARE(outcome.output, QString());
    QVERIFY2(outcome.errors.contains(QString("does not know %1; it is older than this tool: update it").arg(kind)),
             qPrintable(outcome.errors));
    QCOMPARE(outcome.errors.count('\n'), 1);
}

void tst_qtplc_answers::otherRefusalIsShownAsItIs()
{
    m_master->answers.insert(QPlcMessage::GetStatistics,
                             QPlcMessage(QPlcMessage::Failed, {{"error", "TooLong"}, {"text", "too many nodes"}}));
    const Outcome outcome = m_master->qtplc("jitter");
    QCOMPARE(outcome.exitCode, 1);
    QCOMPARE(outcome.errors, QString("qtplc: the master refuses: too many nodes\n"));
}

void tst_qtplc_answers::answerOfAnotherKindIsRefused()
{
    m_master->answers.insert(QPlcMessage::GetSchedule, QPlcMessage(QPlcMessage::Done));
    QCOMPARE(m_master->qtplc("schedule").exitCode, 1);
}

void tst_qtplc_answers::malformedAnswersDoNotCrash_data()
{
    QTest::addColumn<QJsonObject>("fields");
    QTest::newRow("texts") << QJsonObject{{"master", "x"}, {"nodes", "y"},  {"worst", "z"}, {"stages", "a"},
                                          {"links", 1},    {"leases", "b"}, {"events", 2},  {"more", true}};
    QTest::newRow("wrong elements") << QJsonObject{
        {"master", QJsonObject{{"lateness", QJsonObject{{"sinceStart", 3}}}}},
        {"nodes", QJsonArray{1, QJsonArray(), QJsonValue()}},
        {"worst", QJsonArray{1, "x"}},
        {"stages", QJsonArray{1, QJsonArray{1, "x"}}},
        {"links", QJsonArray{1, QJsonObject{{"age", "x"}}}},
        {"leases", QJsonArray{1, QJsonObject{{"timeout", "x"}}}},
        {"events", QJsonArray{1, "x", QJsonObject{{"sequence", "x"}, {"time", 3}}}},
        {"more", true}};
    QTest::newRow("wrong bins") << QJsonObject{
        {"master",
         QJsonObject{
             {"lateness", QJsonObject{{"sinceStart", QJsonObject{{"bins", QJsonArray{1, "x", QJsonArray{-1, 3}}}}}}}}}};
}

void tst_qtplc_answers::malformedAnswersDoNotCrash()
{
    QFETCH(QJsonObject, fields);
    m_master->answers.insert(QPlcMessage::GetStatistics, QPlcMessage(QPlcMessage::Statistics, fields));
    m_master->answers.insert(QPlcMessage::GetSchedule, QPlcMessage(QPlcMessage::Schedule, fields));
    fields.insert("more", true);
    m_master->answers.insert(QPlcMessage::GetLeases, QPlcMessage(QPlcMessage::Leases, fields));
    m_master->answers.insert(QPlcMessage::GetEvents, QPlcMessage(QPlcMessage::Events, fields));
    for (const char *command : {"jitter", "jitter --hist", "schedule", "leases", "events"})
        QCOMPARE(m_master->qtplc(command).exitCode, 0);
}

/// It is registered while cycles run, and hears nothing more: the phase has ended before it could
/// begin for this listener.
void tst_qtplc_answers::echoShowsTheValuesWhenAPhaseEndsWhileItJoins()
{
    const QPlcSignalTable table = QPlcSignalTable::fromIni("[power]\ntype = Real32\n");
    const auto hash = [&table](const QVector<QPlcSignalIndex> &signalList) {
        return QPlcMessage::fromHex64(qplc::PayloadLayout(table, signalList).hash());
    };
    m_master->answers[QPlcMessage::Register] = QPlcMessage(
        QPlcMessage::Registered,
        {{"node", 1}, {"inputsHash", hash({0})}, {"outputsHash", hash({})}, {"token", QPlcMessage::fromHex64(1)}});
    m_master->further[QPlcMessage::Register] = QPlcMessage(QPlcMessage::CyclicChannelAttached, {});
    m_master->answers[QPlcMessage::GetSignals]
        = QPlcMessage(QPlcMessage::Signals,
                      {{"signals", QJsonArray{QJsonObject{{"name", "power"}, {"value", "42"}, {"quality", 0}}}}});
    int questions = 0;
    m_master->prepare = [&](const QPlcMessage &request) {
        if (request.kind() != QPlcMessage::GetState)
            return;
        const bool runs = ++questions <= 3;  // before it joins, when it has joined, and a little later
        m_master->answers[QPlcMessage::GetState]
            = QPlcMessage(QPlcMessage::State, {{"state", runs ? "RealTime" : "Off"}, {"period", 1e7}});
    };
    QStringList arguments = m_master->withMaster("echo power --count 1");
    arguments.first().replace("--master=", "--master=udp://");
    const Outcome outcome = m_master->run(arguments);
    QCOMPARE(outcome.errors, QString());
    QCOMPARE(outcome.exitCode, 0);
    QVERIFY2(outcome.output.contains("42"), qPrintable(outcome.output));
    QCOMPARE(questions, 4);
}

QTEST_GUILESS_MAIN(tst_qtplc_answers)
#include "tst_qtplc_answers.moc"
