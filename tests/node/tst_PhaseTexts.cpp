// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "RingFixtures.h"
#include "SameCycleFixtures.h"
#include "SecurityFixtures.h"
#include "node/cycle/RingDescription.h"

#include <QtTest/QtTest>

using namespace qplc;

// What the ring of a phase tells recorders of people and programs.
class tst_PhaseTexts : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void cleanup();
    void whoSetsAValueIsTold();
    void theProgramOfTheMasterIsToldToo();
    void notesAreToldWithTheirCycle();
    void leasesAreTold();
    void aPhaseBeginsWithWhatHasLedToIt();
    void whoStopsAPhaseIsTold();
    void aFloodOfValuesIsToldTogether();
    void statisticsAreToldWhileSomebodyRecords();
    void theDescriptionHasTheParametersOfTheMaster();
    void noSecretIsTold();

private:
    struct Told
    {
        RecordedText head;
        QJsonObject text;
    };

    bool listen();
    bool start();
    void take();
    /// The texts of \a topic that have \a value under \a key.
    std::vector<Told> find(RecordedText::Topic topic, const char *key, const QJsonValue &value);
    QPlcMessage set(ScriptedTool &tool, const QString &signal, const QString &value)
    {
        return tool.answerTo(QPlcMessage::SetSignals, {{"values", QJsonObject{{signal, value}}}});
    }

    QScopedPointer<QTemporaryDir> m_folder;
    QScopedPointer<TestMaster> m_master;
    QScopedPointer<ScriptedTool> m_anna;
    QScopedPointer<RingReader> m_recorder;
    std::vector<Told> m_told;
    bool m_isOver = false;
};

void tst_PhaseTexts::init()
{
    m_folder.reset(new QTemporaryDir("/dev/shm/qtplc-test-XXXXXX"));
    QVERIFY(m_folder->isValid());
    qputenv("QTPLC_RING_DIR", m_folder->path().toUtf8());
    m_recorder.reset();
    m_told.clear();
    m_isOver = false;
    m_master.reset(new TestMaster(QPlcClock::realTime()));
    m_master->setProfile(QPlcProfile::Simulation);
    m_master->setInterval(0.002);
    m_anna.reset(new ScriptedTool("Anna"));
    connect(m_master.data(), &QPlcMasterNode::ringIsReady, this, [this](const QString &file) {
        m_recorder.reset(new RingReader);
        m_isOver = false;
        QString error;
        QVERIFY2(m_recorder->open(file.toUtf8(), &error), qPrintable(error));
        QVERIFY(m_recorder->attach());
    });
}

void tst_PhaseTexts::cleanup()
{
    m_anna.reset();
    m_master.reset();
}

bool tst_PhaseTexts::listen()
{
    return m_master->listen() && m_anna->greetAt(m_master->serverPort());
}

bool tst_PhaseTexts::start()
{
    return listen() && m_anna->answerTo(QPlcMessage::StartRealTime).kind() == QPlcMessage::Done
        && m_master->waitForCycles(3);
}

void tst_PhaseTexts::take()
{
    RegionReader &texts = m_recorder->texts();
    while (texts.next() == RegionReader::Found) {
        Told told;
        std::memcpy(&told.head, texts.body(), sizeof told.head);
        told.text
            = QJsonDocument::fromJson(QByteArray(texts.body() + sizeof told.head, int(told.head.textSize))).object();
        m_isOver = m_isOver || texts.kind() == RecordKind::LastText;
        m_told.push_back(told);
    }
    m_recorder->release();
}

std::vector<tst_PhaseTexts::Told> tst_PhaseTexts::find(RecordedText::Topic topic, const char *key,
                                                       const QJsonValue &value)
{
    take();
    std::vector<Told> found;
    std::copy_if(m_told.begin(), m_told.end(), std::back_inserter(found), [&](const Told &told) {
        return told.head.topic == topic && told.text.value(QLatin1String(key)) == value;
    });
    return found;
}

void tst_PhaseTexts::whoSetsAValueIsTold()
{
    QVERIFY(start());
    QCOMPARE(set(*m_anna, "free", "2.5").kind(), QPlcMessage::Done);
    QCOMPARE(set(*m_anna, "free", "4").kind(), QPlcMessage::Done);
    const std::vector<Told> told = find(RecordedText::Command, "signal", "free");
    QCOMPARE(told.size(), std::size_t(2));
    QCOMPARE(told[0].text.value("by").toString(), QString("Anna"));
    QCOMPARE(told[0].text.value("from").toString(), QString("0"));
    QCOMPARE(told[0].text.value("to").toString(), QString("2.5"));
    QCOMPARE(told[0].text.value("how").toString(), QString("set"));
    QVERIFY2(told[0].text.value("address").toString().startsWith("127.0.0.1"),
             QJsonDocument(told[0].text).toJson().constData());
    QVERIFY(!told[0].text.value("client").toString().isEmpty());
    QVERIFY(!told[0].text.contains("role"));  // nobody has proven anything
    QVERIFY(told[0].head.settings > 0);
    QVERIFY(told[1].head.settings > told[0].head.settings);
    QCOMPARE(told[1].text.value("from").toString(), QString("2.5"));
    QVERIFY(told[1].head.cycle != RecordedText::BeforePhase);
}

void tst_PhaseTexts::theProgramOfTheMasterIsToldToo()
{
    QVERIFY(start());
    QVERIFY(m_master->setSignalValue("setpoint", QPlcValue(3.0)));
    const std::vector<Told> told = find(RecordedText::Command, "signal", "setpoint");
    QCOMPARE(told.size(), std::size_t(1));
    QCOMPARE(told[0].text.value("how").toString(), QString("program"));
    QCOMPARE(told[0].text.value("to").toString(), QString("3"));
    QVERIFY(!told[0].text.contains("address"));
}

void tst_PhaseTexts::notesAreToldWithTheirCycle()
{
    QVERIFY(start());
    QCOMPARE(m_anna->ask(QPlcMessage::Note, {{"text", "gust"}}).kind(), QPlcMessage::Done);
    const std::vector<Told> told = find(RecordedText::Event, "kind", "note");
    QCOMPARE(told.size(), std::size_t(1));
    QCOMPARE(told[0].text.value("text").toString(), QString("gust"));
    QCOMPARE(told[0].text.value("source").toString(), QString("Anna"));
    QVERIFY(told[0].text.value("address").toString().startsWith("127.0.0.1"));
    QVERIFY(told[0].head.cycle != RecordedText::BeforePhase);
    QVERIFY(find(RecordedText::Command, "command", "Note").empty());  // it is told once
}

void tst_PhaseTexts::leasesAreTold()
{
    QVERIFY(start());
    const QJsonArray both{"free", "setpoint"};
    QCOMPARE(m_anna
                 ->ask(QPlcMessage::TakeLease,
                       {{"signals", both}, {"timeout", 3.6e12}, {"values", QJsonObject{{"free", "1"}}}})
                 .kind(),
             QPlcMessage::Done);
    {
        ScriptedTool bert("Bert");
        QVERIFY(bert.greetAt(m_master->serverPort()));
        QCOMPARE(bert.ask(QPlcMessage::TakeLease,
                          {{"signals", QJsonArray{"setpoint"}}, {"timeout", 3.6e12}, {"takeOver", true}})
                     .kind(),
                 QPlcMessage::Done);
    }
    QCOMPARE(m_anna->ask(QPlcMessage::ReleaseLease, {{"signals", QJsonArray{"free"}}}).kind(), QPlcMessage::Done);
    const std::vector<Told> taken = find(RecordedText::Lease, "what", "taken");
    QCOMPARE(taken.size(), std::size_t(2));
    QCOMPARE(taken[0].text.value("by").toString(), QString("Anna"));
    QCOMPARE(taken[0].text.value("signals").toArray(), both);
    QVERIFY(!taken[0].text.contains("from"));
    QCOMPARE(taken[1].text.value("by").toString(), QString("Bert"));
    QCOMPARE(taken[1].text.value("from").toArray(), QJsonArray{"Anna"});
    QCOMPARE(find(RecordedText::Command, "how", "lease").size(), std::size_t(1));
    QCOMPARE(find(RecordedText::Lease, "what", "released").size(), std::size_t(1));
    QTRY_COMPARE(find(RecordedText::Lease, "what", "lost").size(), std::size_t(1));
    const std::vector<Told> lost = find(RecordedText::Lease, "what", "lost");
    QCOMPARE(lost[0].text.value("by").toString(), QString("Bert"));
    QVERIFY(lost[0].text.value("reason").toString().contains("lost the connection"));
}

void tst_PhaseTexts::aPhaseBeginsWithWhatHasLedToIt()
{
    QVERIFY(listen());
    QCOMPARE(set(*m_anna, "free", "2").kind(), QPlcMessage::Done);
    QCOMPARE(m_anna->ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"count"}}, {"timeout", 3.6e12}}).kind(),
             QPlcMessage::Done);
    for (int phase = 1; phase <= 2; ++phase) {
        m_told.clear();
        QCOMPARE(m_anna->answerTo(QPlcMessage::StartRealTime).kind(), QPlcMessage::Done);
        QVERIFY(m_master->waitForCycles(3));
        const std::vector<Told> set = find(RecordedText::Command, "signal", "free");
        QCOMPARE(set.size(), std::size_t(1));
        QCOMPARE(set[0].text.value("to").toString(), QString("2"));
        QVERIFY(set[0].head.cycle == RecordedText::BeforePhase && set[0].head.settings == 0);
        QCOMPARE(find(RecordedText::Command, "command", "StartRealTime").size(), std::size_t(1));
        QCOMPARE(find(RecordedText::Lease, "by", "Anna").size(), std::size_t(1));
        QVERIFY(!find(RecordedText::Event, "kind", "state").empty());
        m_master->stop();
        QVERIFY(m_master->waitForState(QPlcMasterNode::Off));
    }
}

void tst_PhaseTexts::whoStopsAPhaseIsTold()
{
    QVERIFY(start());
    QCOMPARE(m_anna->ask(QPlcMessage::Stop).kind(), QPlcMessage::Done);
    QCOMPARE(find(RecordedText::Command, "command", "Stop").size(), std::size_t(1));
    QVERIFY(m_isOver);
    QVERIFY(m_told.back().head.number == quint64(m_told.size()));  // none is missing
    const std::vector<Told> states = find(RecordedText::Event, "kind", "state");
    QVERIFY2(states.back().text.value("text").toString().contains("'Anna' asked for it"),
             qPrintable(states.back().text.value("text").toString()));
    QVERIFY(states.back().head.cycle != RecordedText::BeforePhase);
    QVERIFY(std::any_of(m_told.begin(), m_told.end(),
                        [](const Told &told) { return told.head.topic == RecordedText::Statistics; }));
}

void tst_PhaseTexts::aFloodOfValuesIsToldTogether()
{
    QVERIFY(start());
    constexpr int values = 3000;
    QElapsedTimer timer;
    timer.start();
    for (int i = 1; i <= values; ++i) {
        QVERIFY(m_master->setSignalValue("free", QPlcValue(float(i))));
        if (i % 200 == 0)  // a cycle takes 256 of them
            QVERIFY(m_master->waitForCycles(m_master->statistics().cycles + 2));
    }
    double told = 0.0;
    QTRY_VERIFY2_WITH_TIMEOUT(
        [&] {
            told = 0.0;
            for (const Told &each : find(RecordedText::Command, "signal", "free"))
                told += each.text.value("count").toDouble(1.0);
            return told == values;
        }(),
        qPrintable(QString::number(told)), 30000);
    const std::vector<Told> texts = find(RecordedText::Command, "signal", "free");
    QVERIFY(texts.size() <= std::size_t(1000 + 50 * (timer.elapsed() / 1000 + 1)));
    QCOMPARE(texts.back().text.value("to").toString(), QString::number(values));
    for (std::size_t i = 1; i < texts.size(); ++i)
        QCOMPARE(texts[i].text.value("from"), texts[i - 1].text.value("to"));
}

void tst_PhaseTexts::statisticsAreToldWhileSomebodyRecords()
{
    CounterNode counter;
    QVERIFY(m_master->addLocalNode(&counter));
    QVERIFY(start());
    const auto isStatistics = [](const Told &told) { return told.head.topic == RecordedText::Statistics; };
    QTRY_VERIFY((take(), std::any_of(m_told.begin(), m_told.end(), isStatistics)));
    const QJsonObject text = std::find_if(m_told.begin(), m_told.end(), isStatistics)->text;
    QVERIFY(text.value("counters").toObject().value("cycles").toDouble() > 0.0);
    QVERIFY(text.value("lateness").toObject().contains("p99"));
    QCOMPARE(text.value("nodes").toArray().at(0).toObject().value("name").toString(), QString("Counter"));
    m_master->stop();
}

void tst_PhaseTexts::theDescriptionHasTheParametersOfTheMaster()
{
    QVERIFY(start());
    RingDescription description;
    QVERIFY(RingDescription::fromText(m_recorder->memory().description(), &description));
    QCOMPARE(description.profile, QString("Simulation"));
    QCOMPARE(description.parameters.value("security"), QString("none"));
    QCOMPARE(description.parameters.value("qt_version"), QString(qVersion()));
    QVERIFY(description.parameters.contains("hold_cycles"));
    QVERIFY(!description.table.isEmpty());
}

/// Keys of the master and of its clients, in the forms in which somebody could write them.
void tst_PhaseTexts::noSecretIsTold()
{
    const SecurityFiles files;
    m_master->setSecurity(QPlcSecurity::preSharedKeys(files.masterKeys()));
    QVERIFY(m_master->listen());
    SecuredTool anna(files.anna());
    QVERIFY(anna.greetAt(m_master->serverPort()));
    QVERIFY(m_master->startArmed());
    QVERIFY(m_master->waitForCycles(3));
    QCOMPARE(set(anna, "free", "2").kind(), QPlcMessage::Done);
    QTRY_COMPARE(find(RecordedText::Command, "signal", "free").size(), std::size_t(1));
    const std::vector<Told> told = find(RecordedText::Command, "by", "anna as \"Tool\"");
    QVERIFY2(!told.empty(), QJsonDocument(m_told.back().text).toJson().constData());
    QCOMPARE(told.back().text.value("role").toString().toLower(), QString("operator"));
    m_master->stop();
    QFile file(QFile::decodeName(m_recorder->memory().file()));
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray ring = file.readAll();
    QVERIFY(ring.contains("\"signal\":\"free\""));
    for (const char digit : {'a', 'b', 'c', 'd', 'e'}) {
        const QByteArray key = SecurityFiles::key(digit).left(16);  // also a part of it
        QVERIFY(!ring.contains(key));
        QVERIFY(!ring.contains(QByteArray::fromHex(key)));
        QVERIFY(!ring.contains(QByteArray::fromHex(key).toBase64().left(8)));
    }
    QVERIFY(!ring.contains(files.path({}).toUtf8()));
}

QTEST_GUILESS_MAIN(tst_PhaseTexts)
#include "tst_PhaseTexts.moc"
