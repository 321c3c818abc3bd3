// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedMaster.h"
#include "node/session/ControlClient.h"

using qplc::ControlClient;
namespace messages = qplc::messages;

// The client side of the control channel, at a master that says what the test tells it.
class tst_ControlClient : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void clientGreetsTheMaster();
    void theCallerIsAskedWhenTheConnectionIsThere();
    void aNodeWaitsForItsGreetingBehindOtherMessages();
    void whatIsToldWaitsForNoAnswer();
    void theLossNamesTheErrorOfTheSocket();
    void answerIsDeliveredAsAStruct();
    void refusalIsDeliveredInPlaceOfTheAnswer();
    void aQuestionIsAnsweredWhileACommandWaits();
    void stopIsSentWithoutWaitingForOtherCommands();
    void stopAnswersTellWhatBecameOfTheSequence_data();
    void stopAnswersTellWhatBecameOfTheSequence();
    void stopIsDoneAtOnceBehindACommandThatIsNoSequence();
    void armCountsAsACommand();
    void oversizedCommandDelaysNoOtherCommand();
    void anAnswerOfAnotherKindFails();
    void messagesThatAnswerNoRequestAreIgnored_data();
    void messagesThatAnswerNoRequestAreIgnored();
    void unaskedMessagesAnswerNoRequest();
    void otherProtocolVersionEndsTheConnection();
    void rejectedGreetingEndsTheConnectionWithItsReason();
    void otherFirstMessageEndsTheConnection();
    void aMasterThatEndsIsLostAndItsRequestsFail();
    void aMasterThatDoesNotAnswerIsLost();
    void commandWithoutAnswerEndsAfterItsOwnTime();
    void closeFailsRequestsWithoutReportingALoss();
    void aRequestWithoutAConnectionFails();

private:
    bool greet()
    {
        m_client->connectToMaster(m_master->tcp());
        if (m_master->next().kind() != QPlcMessage::Hello)
            return false;
        m_master->send(QPlcMessage::Hello, m_master->helloFields());
        return waitUntil([&] { return m_client->isGreeted(); }, 5000);
    }
    bool isLost()
    {
        return waitUntil([&] { return m_losses.size() > 0; }, 5000);
    }
    /// Writes down the kind of the answer, or the error of the refusal.
    template<typename Request>
    void note(const Request &request)
    {
        m_client->request(request, [this](const ControlClient::Reply<Request> &reply) {
            const auto *failed = std::get_if<messages::Failed>(&reply);
            m_notes << (failed ? failed->error : QPlcMessage::kindName(Request::Answer::kind));
        });
    }

    QScopedPointer<ScriptedMaster> m_master;
    QScopedPointer<ControlClient> m_client;
    QStringList m_notes;
    QVector<QPair<ControlClient::Loss, QString>> m_losses;
};

void tst_ControlClient::init()
{
    m_client.reset();
    m_master.reset(new ScriptedMaster);
    m_client.reset(new ControlClient({"anna@lab", messages::Part::Tool, {"events"}}));
    m_notes.clear();
    m_losses.clear();
    connect(m_client.data(), &ControlClient::lost, this, [this](ControlClient::Loss loss, const QString &reason) {
        m_losses.append({loss, reason});
    });
}

void tst_ControlClient::clientGreetsTheMaster()
{
    m_client->offer("leases");
    m_client->connectToMaster(m_master->tcp());
    const QPlcMessage hello = m_master->next();
    QCOMPARE(hello.kind(), QPlcMessage::Hello);
    QCOMPARE(hello.fields().value("protocol").toInt(), 2);
    QCOMPARE(hello.text("name"), QString("anna@lab"));
    QCOMPARE(hello.text("role"), QString("tool"));
    QCOMPARE(hello.fields().value("features").toArray(), (QJsonArray{"events", "leases"}));
    QVERIFY(!QUuid(hello.text("uuid")).isNull());
    QVERIFY(!m_client->isGreeted());
    QJsonObject fields = m_master->helloFields();
    fields["identity"] = "anna";
    fields["state"] = "SafeStop";
    m_master->send(QPlcMessage::Hello, fields);
    QTRY_VERIFY(m_client->isGreeted());
    QCOMPARE(quint64(m_client->master().session), ScriptedMaster::Session);
    QCOMPARE(m_client->master().identity, QString("anna"));
    QCOMPARE(m_client->master().state, messages::MasterState::SafeStop);
    QCOMPARE(m_client->master().table.toUtf8(), m_master->table.toIni());
}

void tst_ControlClient::theCallerIsAskedWhenTheConnectionIsThere()
{
    connect(m_client.data(), &ControlClient::connected, this, [this] {
        m_client->setCaller({"pump", messages::Part::Node, {}, "the uuid", messages::Hex64(7)});
    });
    m_client->connectToMaster(m_master->tcp());
    const QPlcMessage hello = m_master->next();
    QCOMPARE(hello.text("name"), QString("pump"));
    QCOMPARE(hello.text("role"), QString("node"));
    QCOMPARE(hello.text("uuid"), QString("the uuid"));
    QCOMPARE(hello.text("tableHash"), QString("0000000000000007"));
}

void tst_ControlClient::aNodeWaitsForItsGreetingBehindOtherMessages()
{
    m_client.reset(new ControlClient({"pump", messages::Part::Node, {}}));
    QSignalSpy unasked(m_client.data(), &ControlClient::unasked);
    QSignalSpy lost(m_client.data(), &ControlClient::lost);
    m_client->connectToMaster(m_master->tcp());
    QCOMPARE(m_master->next().kind(), QPlcMessage::Hello);
    m_master->send(QPlcMessage::RealTimeStopped);
    m_master->send(QPlcMessage::Hello, m_master->helloFields());
    QTRY_VERIFY(m_client->isGreeted());
    QCOMPARE(unasked.size(), 1);
    QCOMPARE(lost.size(), 0);
}

void tst_ControlClient::whatIsToldWaitsForNoAnswer()
{
    QVERIFY(greet());
    QStringList unasked;
    connect(m_client.data(), &ControlClient::unasked, this,
            [&](const QPlcMessage &message) { unasked << message.kindName(); });
    m_client->tell(messages::toMessage(messages::InitializeAllStates()));
    QVERIFY(!m_client->isBusy());
    QCOMPARE(m_master->next().kind(), QPlcMessage::InitializeAllStates);
    m_master->send(QPlcMessage::Done);
    QTRY_COMPARE(unasked, QStringList{"Done"});
}

void tst_ControlClient::theLossNamesTheErrorOfTheSocket()
{
    QVERIFY(greet());
    QVERIFY(m_client->connection());
    m_master->control->close();
    QVERIFY(isLost());
    QCOMPARE(m_losses.at(0).first, ControlClient::Loss::Gone);
    QCOMPARE(m_client->socketError(), QPlcAbstractSocket::ConnectionLostError);
    QVERIFY(!m_client->connection());
}

void tst_ControlClient::answerIsDeliveredAsAStruct()
{
    QVERIFY(greet());
    messages::State state;
    m_client->request(messages::GetState(), [&](const ControlClient::Reply<messages::GetState> &reply) {
        state = std::get<messages::State>(reply);
    });
    QCOMPARE(m_master->next().kind(), QPlcMessage::GetState);
    m_master->send(QPlcMessage::State, {{"state", "RealTime"}, {"period", 2e6}, {"new field", 1}});
    QTRY_COMPARE(state.state, messages::MasterState::RealTime);
    QCOMPARE(state.period, std::chrono::nanoseconds(2'000'000));
}

void tst_ControlClient::refusalIsDeliveredInPlaceOfTheAnswer()
{
    QVERIFY(greet());
    messages::Failed failed;
    m_client->request(messages::Reset(), [&](const ControlClient::Reply<messages::Reset> &reply) {
        failed = std::get<messages::Failed>(reply);
    });
    QCOMPARE(m_master->next().kind(), QPlcMessage::Reset);
    m_master->send(QPlcMessage::Failed, {{"error", "NotReady"}, {"text", "not now"}});
    QTRY_COMPARE(failed.error, QString("NotReady"));
    QCOMPARE(failed.text, QString("not now"));
    QVERIFY(m_client->isGreeted());
}

void tst_ControlClient::aQuestionIsAnsweredWhileACommandWaits()
{
    QVERIFY(greet());
    note(messages::InitializeAllStates());
    note(messages::GetState());
    QVERIFY(m_client->isBusy());
    QCOMPARE(m_master->next().kind(), QPlcMessage::InitializeAllStates);
    QCOMPARE(m_master->next().kind(), QPlcMessage::GetState);
    m_master->send(QPlcMessage::State);
    QTRY_COMPARE(m_notes, QStringList{"State"});
    QVERIFY(m_client->isBusy());
    m_master->send(QPlcMessage::Done);
    QTRY_COMPARE(m_notes, (QStringList{"State", "Done"}));
    QVERIFY(!m_client->isBusy());
}

void tst_ControlClient::stopIsSentWithoutWaitingForOtherCommands()
{
    QVERIFY(greet());
    note(messages::InitializeAllStates());
    note(messages::StartRealTime());
    note(messages::Stop());
    QCOMPARE(m_master->next().kind(), QPlcMessage::InitializeAllStates);
    QCOMPARE(m_master->next().kind(), QPlcMessage::Stop);
    m_master->send(QPlcMessage::Failed, {{"error", "first"}});
    m_master->send(QPlcMessage::Done);
    QTRY_COMPARE(m_notes, (QStringList{"first", "Done"}));
    QCOMPARE(m_master->next().kind(), QPlcMessage::StartRealTime);
    m_master->send(QPlcMessage::Done);
    QTRY_COMPARE(m_notes, (QStringList{"first", "Done", "Done"}));
}

void tst_ControlClient::stopAnswersTellWhatBecameOfTheSequence_data()
{
    QTest::addColumn<QStringList>("answers");
    QTest::addColumn<QString>("sequence");
    QTest::newRow("stopped, told first") << QStringList{"Failed", "Done", "Done"} << "stopped";
    QTest::newRow("stopped, told in between") << QStringList{"Done", "Failed", "Done"} << "stopped";
    QTest::newRow("stopped, told last") << QStringList{"Done", "Done", "Failed"} << "stopped";
    QTest::newRow("done before the stop came") << QStringList{"Done", "Done", "Done"} << "Done";
}

void tst_ControlClient::stopAnswersTellWhatBecameOfTheSequence()
{
    QFETCH(QStringList, answers);
    QFETCH(QString, sequence);
    QVERIFY(greet());
    QMap<QString, QString> outcomes;
    const auto noteAs = [&](const QString &name) {
        return [&outcomes, name](const std::variant<messages::Done, messages::Failed> &reply) {
            const auto *failed = std::get_if<messages::Failed>(&reply);
            outcomes.insert(name, failed ? failed->error : QString("Done"));
        };
    };
    m_client->request(messages::InitializeAllStates(), noteAs("sequence"));
    m_client->request(messages::Stop(), noteAs("stop"));
    m_client->request(messages::SafeStop(), noteAs("safe stop"));
    for (const QString &answer : answers)
        m_master->send(answer == "Done" ? QPlcMessage::Done : QPlcMessage::Failed, {{"error", "stopped"}});
    QTRY_COMPARE(outcomes.size(), 3);
    QCOMPARE(outcomes.value("sequence"), sequence);
    QCOMPARE(outcomes.value("stop"), QString("Done"));
    QCOMPARE(outcomes.value("safe stop"), QString("Done"));
    QVERIFY(!m_client->isBusy());
}

void tst_ControlClient::stopIsDoneAtOnceBehindACommandThatIsNoSequence()
{
    QVERIFY(greet());
    note(messages::Reset());
    note(messages::GetState());
    note(messages::Stop());
    m_master->send(QPlcMessage::Done);
    QTRY_COMPARE(m_notes, QStringList{"Done"});
    m_master->send(QPlcMessage::Done);
    QTRY_COMPARE(m_notes, (QStringList{"Done", "Done"}));
}

void tst_ControlClient::armCountsAsACommand()
{
    QVERIFY(greet());
    note(messages::InitializeAllStates());
    note(messages::Arm());
    QCOMPARE(m_master->next().kind(), QPlcMessage::InitializeAllStates);
    m_master->send(QPlcMessage::Failed, {{"error", "first"}});
    QCOMPARE(m_master->next().kind(), QPlcMessage::Arm);
    QVERIFY(m_client->isBusy());
    m_master->send(QPlcMessage::Armed, {{"token", "0000000000000001"}});
    QTRY_COMPARE(m_notes, (QStringList{"first", "Armed"}));
}

void tst_ControlClient::oversizedCommandDelaysNoOtherCommand()
{
    QVERIFY(greet());
    note(messages::InitializeAllStates());
    note(messages::SafeStop{QString(2 * 1024 * 1024, 'x')});
    messages::SetSignals tooLong;
    tooLong.values.insert("sum", QString(2 * 1024 * 1024, '1'));
    note(tooLong);
    note(messages::Reset());
    QCOMPARE(m_master->next().kind(), QPlcMessage::InitializeAllStates);
    m_master->send(QPlcMessage::Done);
    QCOMPARE(m_master->next().kind(), QPlcMessage::Reset);
    m_master->send(QPlcMessage::Done);
    QTRY_COMPARE(m_notes, (QStringList{"MalformedMessage", "MalformedMessage", "Done", "Done"}));
}

void tst_ControlClient::messagesThatAnswerNoRequestAreIgnored_data()
{
    QTest::addColumn<int>("kind");
    QTest::newRow("a kind of a newer master") << 200;
    QTest::newRow("a second greeting") << int(QPlcMessage::Hello);
    QTest::newRow("of nodes") << int(QPlcMessage::RealTimeStopped);
    QTest::newRow("a question") << int(QPlcMessage::GetState);
}

void tst_ControlClient::messagesThatAnswerNoRequestAreIgnored()
{
    QFETCH(int, kind);
    QVERIFY(greet());
    note(messages::Reset());
    QCOMPARE(m_master->next().kind(), QPlcMessage::Reset);
    m_master->send(QPlcMessage::Kind(kind));
    m_master->send(QPlcMessage::Done);
    QTRY_COMPARE(m_notes, QStringList{"Done"});
    QVERIFY(m_losses.isEmpty());
}

void tst_ControlClient::anAnswerOfAnotherKindFails()
{
    QVERIFY(greet());
    note(messages::GetLeases());
    QCOMPARE(m_master->next().kind(), QPlcMessage::GetLeases);
    m_master->send(QPlcMessage::Done);
    QTRY_COMPARE(m_notes, QStringList{"MalformedMessage"});
}

void tst_ControlClient::unaskedMessagesAnswerNoRequest()
{
    QVERIFY(greet());
    QStringList told;
    connect(m_client.data(), &ControlClient::unasked, this,
            [&](const QPlcMessage &message) { told << message.kindName(); });
    note(messages::GetEvents{7});
    QCOMPARE(m_master->next().fields(), (QJsonObject{{"since", 7}}));
    m_master->send(QPlcMessage::LeasesChanged, {{"leases", QJsonArray{QJsonObject{{"signal", "sum"}}}}});
    const QJsonArray events{QJsonObject{{"sequence", 8}, {"text", "hot"}}};
    m_master->send(QPlcMessage::Events, {{"events", events}});
    m_master->send(QPlcMessage::StatesInitialized, {{"ok", false}, {"text", "too late"}});
    m_master->send(QPlcMessage::Invalid);
    QTRY_COMPARE(told.size(), 4);
    QCOMPARE(told.mid(0, 3), (QStringList{"LeasesChanged", "Events", "StatesInitialized"}));
    QVERIFY(m_notes.isEmpty());
    m_master->send(QPlcMessage::Events, {{"events", events}, {"more", false}});
    QTRY_COMPARE(m_notes, QStringList{"Events"});
    QCOMPARE(told.size(), 4);
}

void tst_ControlClient::otherProtocolVersionEndsTheConnection()
{
    m_client->connectToMaster(m_master->tcp());
    QCOMPARE(m_master->next().kind(), QPlcMessage::Hello);
    m_master->send(QPlcMessage::Hello, {{"protocol", 3}});
    QVERIFY(isLost());
    QCOMPARE(m_losses.at(0), qMakePair(ControlClient::Loss::OtherVersion, QString("3")));
    QVERIFY(!m_client->isGreeted());
}

void tst_ControlClient::rejectedGreetingEndsTheConnectionWithItsReason()
{
    m_client->connectToMaster(m_master->tcp());
    QCOMPARE(m_master->next().kind(), QPlcMessage::Hello);
    m_master->send(QPlcMessage::Rejected, {{"error", "VersionMismatch"}, {"text", "too old"}});
    QVERIFY(isLost());
    QCOMPARE(m_losses.at(0), qMakePair(ControlClient::Loss::Rejected, QString("too old")));
    QCOMPARE(m_client->rejection().error, QString("VersionMismatch"));
}

void tst_ControlClient::otherFirstMessageEndsTheConnection()
{
    m_client->connectToMaster(m_master->tcp());
    QCOMPARE(m_master->next().kind(), QPlcMessage::Hello);
    m_master->send(QPlcMessage::Done);
    QVERIFY(isLost());
    QCOMPARE(m_losses.at(0), qMakePair(ControlClient::Loss::NoGreeting, QString("Done")));
}

void tst_ControlClient::aMasterThatEndsIsLostAndItsRequestsFail()
{
    QVERIFY(greet());
    note(messages::Reset());
    note(messages::Reset());
    QCOMPARE(m_master->next().kind(), QPlcMessage::Reset);
    m_master->send(QPlcMessage::MasterEnds);
    QVERIFY(isLost());
    QCOMPARE(m_losses.at(0), qMakePair(ControlClient::Loss::MasterEnded, QString("the master has ended")));
    QCOMPARE(m_notes, (QStringList{"Lost", "Lost"}));
}

void tst_ControlClient::aMasterThatDoesNotAnswerIsLost()
{
    QVERIFY(greet());
    m_client->setAnswerTimes(std::chrono::milliseconds(50), std::chrono::hours(1));
    note(messages::GetState());
    QVERIFY(isLost());
    QCOMPARE(m_losses.at(0), qMakePair(ControlClient::Loss::Gone, QString("no answer within 0.05 s")));
    QCOMPARE(m_notes, QStringList{"Lost"});
    m_client->connectToMaster(m_master->tcp());  // which does not greet
    QTRY_COMPARE(m_losses.size(), 2);
}

void tst_ControlClient::commandWithoutAnswerEndsAfterItsOwnTime()
{
    QVERIFY(greet());
    m_client->setAnswerTimes(std::chrono::hours(1), std::chrono::milliseconds(70));
    note(messages::Reset());
    QVERIFY(isLost());
    QCOMPARE(m_losses.at(0), qMakePair(ControlClient::Loss::Gone, QString("no answer within 0.07 s")));
}

void tst_ControlClient::closeFailsRequestsWithoutReportingALoss()
{
    QVERIFY(greet());
    note(messages::GetState());
    m_client->close();
    QCOMPARE(m_notes, QStringList{"Lost"});
    QVERIFY(!m_client->isGreeted());
    QCOMPARE(m_losses.size(), 0);
}

void tst_ControlClient::aRequestWithoutAConnectionFails()
{
    note(messages::GetState());
    QCOMPARE(m_notes, QStringList{"Lost"});
}

QTEST_GUILESS_MAIN(tst_ControlClient)
#include "tst_ControlClient.moc"
