// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "PlantFixtures.h"

#include <QtNetwork/QTcpServer>
#include <QtNetwork/QTcpSocket>

using namespace qplc;

namespace {

/// All events of a plant, as text.
QStringList textsOf(const QSignalSpy &spy)
{
    QStringList texts;
    for (const QList<QVariant> &call : spy)
        texts << qvariant_cast<PlantEvent>(call.at(0)).text;
    return texts;
}

}  // namespace

class tst_Plant : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aPlantShowsWhatItsMasterHas_data();
    void aPlantShowsWhatItsMasterHas();
    void commandsChangeTheMasterStateAndReportTheirResult();
    void refusedCommandReportsTheReasonOfTheMaster();
    void commandsWithoutConnectionFailWithoutBlocking();
    void valuesComeWhileNoCycleRuns();
    void valuesComeAtMostFiftyTimesASecond();
    void rateLimitIncreasesTheRowSpacing();
    void rateLimitAppliesToWallClockTime();
    void aMasterThatComesLaterIsFound();
    void aLostMasterIsFoundAgainAndTheGapIsKept();
    void anotherTableReplacesSignalsAndStore();
    void silentPortTimesOutAndIsRetried();
    void nodeNameInUseIsReportedAndKeepsThePlantConnected();
    void nodeArrivalsAndDeparturesAreEvents();
    void aPlantIsClosedAndOpenedAgain();
    void pausesGrowFromAQuarterToFiveSeconds();
    void hostsAreLookedUpInTheBackground();
    void severalPlantsLiveSideBySide();
    void referencesFindTheirSignalsWhenTheyAppear();
};

void tst_Plant::aPlantShowsWhatItsMasterHas_data()
{
    QTest::addColumn<QString>("scheme");
    QTest::newRow("tcp") << "";
    QTest::newRow("udp") << "udp://";
    QTest::newRow("local") << "local://";
}

void tst_Plant::aPlantShowsWhatItsMasterHas()
{
    QFETCH(QString, scheme);
    RunningMaster master;
    QVERIFY(master.startRealTime());
    const QString address = scheme == QLatin1String("local://") ? scheme + QString::number(master.serverPort())
                                                                : scheme + master.address();
    Plant plant(address, QStringLiteral("tower"), QStringLiteral("Window"));
    QCOMPARE(plant.nextAction(), Plant::NoAction);
    QCOMPARE(plant.quality(), Plant::NoValue);
    QVERIFY(plant.age() < 0.0);
    plant.open();
    QTRY_VERIFY(plant.values().rows() > 10);
    QTRY_COMPARE(plant.stateText(), QStringLiteral("Real time"));
    QCOMPARE(plant.nextAction(), Plant::StopAction);
    QCOMPARE(plant.quality(), Plant::Good);
    QVERIFY(plant.age() < plant.staleAfter());
    QCOMPARE(plant.table().hash(), testTable().hash());
    const QPlcSignalIndex count = plant.table().indexOf(QStringLiteral("count"));
    QTRY_VERIFY(plant.value(count).toInt() > 10);
    const SignalStore &store = *plant.store();
    const auto last = store.endRow() - 1;
    const int channel = plant.values().channels().channel(count);
    QCOMPARE(store.value(channel, last) - store.value(channel, last - 1), 1.0F);
    QCOMPARE(qint64(store.time(last) - store.time(last - 1)), qint64(10'000'000));
    QTRY_COMPARE(plant.writer(count), QStringLiteral("Counter"));
    QTRY_VERIFY(plant.status().node(QStringLiteral("Window")));
    QVERIFY(plant.status().node(QStringLiteral("Window"))->info.listener);
    QTRY_VERIFY(plant.status().node(QStringLiteral("Counter"))->statistics.execution.sinceStart.count > 0);
    QTRY_VERIFY(!plant.status().schedule.stages.isEmpty());
    QTRY_VERIFY(plant.updateRate() > 50.0);
}

void tst_Plant::commandsChangeTheMasterStateAndReportTheirResult()
{
    RunningMaster master;
    Plant plant(master.address());
    plant.open();
    QTRY_COMPARE(plant.nextAction(), Plant::Start);
    QSignalSpy done(&plant, &Plant::commandDone);
    QSignalSpy failed(&plant, &Plant::commandFailed);
    const int first = plant.initialize();
    const int second = plant.setValues({{QStringLiteral("setpoint"), 2.5}});
    const int third = plant.perform(plant.nextAction());
    QTRY_COMPARE(done.size(), 3);
    QCOMPARE(done.at(0).at(0).toInt(), first);
    QCOMPARE(done.at(1).at(0).toInt(), second);
    QCOMPARE(done.at(2).at(0).toInt(), third);
    QTRY_COMPARE(plant.nextAction(), Plant::StopAction);
    QCOMPARE(master.signalValue(QStringLiteral("setpoint")).toReal(), 2.5);
    plant.perform(plant.nextAction());
    QTRY_COMPARE(done.size(), 4);
    QTRY_COMPARE(plant.stateText(), QStringLiteral("Off"));
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    plant.setValues({{QStringLiteral("setpoint"), 7.0}}, std::chrono::milliseconds(200));
    QTRY_COMPARE(done.size(), 5);
    QCOMPARE(master.signalValue(QStringLiteral("setpoint")).toReal(), 7.0);
    QTRY_COMPARE(master.signalValue(QStringLiteral("setpoint")).toReal(), 2.5);
    QVERIFY(failed.isEmpty());
}

void tst_Plant::refusedCommandReportsTheReasonOfTheMaster()
{
    RunningMaster master;
    Plant plant(master.address());
    plant.open();
    QTRY_VERIFY(plant.isConnected());
    QSignalSpy failed(&plant, &Plant::commandFailed);
    QSignalSpy events(&plant, &Plant::eventOccurred);
    const int command = plant.setValues({{QStringLiteral("setpoint"), 11.0}});
    QTRY_COMPARE(failed.size(), 1);
    QCOMPARE(failed.at(0).at(0).toInt(), command);
    QVERIFY2(failed.at(0).at(1).toString().contains(QStringLiteral("setpoint")),
             qPrintable(failed.at(0).at(1).toString()));
    QCOMPARE(textsOf(events).filter(QStringLiteral("SetSignals failed")).size(), 1);
}

void tst_Plant::commandsWithoutConnectionFailWithoutBlocking()
{
    Plant plant(QStringLiteral("127.0.0.1:%1").arg(freePort()));
    QSignalSpy failed(&plant, &Plant::commandFailed);
    const int command = plant.start();
    QVERIFY(failed.isEmpty());  // the caller knows the number first
    QTRY_COMPARE(failed.size(), 1);
    QCOMPARE(failed.at(0).at(0).toInt(), command);
    plant.open();
    QTRY_VERIFY(plant.stateText().startsWith(QStringLiteral("Disconnected: ")));
    QVERIFY(plant.stateText().size() > int(qstrlen("Disconnected: ")));
}

void tst_Plant::valuesComeWhileNoCycleRuns()
{
    RunningMaster master;
    QVERIFY(master.setSignalValue(QStringLiteral("setpoint"), 3.25));
    Plant plant(master.address());
    plant.open();
    const QPlcSignalIndex setpoint = testTable().indexOf(QStringLiteral("setpoint"));
    QTRY_COMPARE(plant.value(setpoint).toReal(), 3.25);
    QCOMPARE(plant.quality(), Plant::AtRest);
    QSignalSpy updated(&plant, &Plant::updated);
    QVERIFY(master.setSignalValue(QStringLiteral("setpoint"), -4.5));
    QTRY_COMPARE(plant.value(setpoint).toReal(), -4.5);
    QTRY_VERIFY(!updated.isEmpty());
    QVERIFY(plant.store()->isEmpty());
}

void tst_Plant::valuesComeAtMostFiftyTimesASecond()
{
    RunningMaster master;
    QVERIFY(master.setInterval(std::chrono::milliseconds(1)));
    QVERIFY(master.startRealTime());
    Plant plant(master.address());
    plant.open();
    QTRY_VERIFY(plant.values().rows() > 0);
    QSignalSpy updated(&plant, &Plant::updated);
    const quint64 rows = plant.values().rows();
    QElapsedTimer time;
    time.start();
    QTRY_VERIFY(plant.values().rows() > rows + 500);
    QVERIFY2(double(updated.size()) <= 50.0 * double(time.elapsed()) * 1e-3 + 2.0,
             qPrintable(QString::number(updated.size())));
}

void tst_Plant::rateLimitIncreasesTheRowSpacing()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    Plant plant(master.address(), QString(), QStringLiteral("Window"));
    plant.setRate(15.0);
    plant.open();
    QTRY_VERIFY(plant.values().rows() > 3);
    QCOMPARE(plant.every(), 7);  // at most 15: 14.3
    const auto newestDistance = [&] {
        const SignalStore &store = *plant.store();
        const SignalStore::Row last = store.endRow() - 1;
        return last > store.firstRow() && !store.beginsAnew(last) ? qint64(store.time(last) - store.time(last - 1)) : 0;
    };
    QTRY_COMPARE(newestDistance(), qint64(70'000'000));
    QCOMPARE(plant.quality(), Plant::Good);
    QTRY_VERIFY(plant.updateRate() > 5.0);
    QVERIFY(plant.updateRate() < 20.0);
    const quint64 rows = plant.values().rows();
    plant.setRate(0.0);  // while cycles run
    QCOMPARE(plant.every(), 1);
    QTRY_COMPARE(newestDistance(), qint64(10'000'000));
    QVERIFY(plant.store()->endRow() > SignalStore::Row(rows));  // and the past is still there
    QTRY_COMPARE(plant.status().nodes.size(), 2);
    QCOMPARE(plant.connectionState(), PlantConnection::Connected);
}

void tst_Plant::rateLimitAppliesToWallClockTime()
{
    RunningMaster master;
    master.setClock(QPlcClock::scaled(5.0));  // 500 cycles in a second
    QVERIFY(master.startRealTime());
    Plant plant(master.address());
    plant.setRate(50.0);
    plant.open();
    QTRY_COMPARE(plant.every(), 10);
    QTRY_VERIFY(plant.values().rows() > 3);
    master.stop();
    master.setInterval(std::chrono::milliseconds(5));
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(plant.every(), 20);
}

void tst_Plant::aMasterThatComesLaterIsFound()
{
    const quint16 port = freePort();
    Plant plant(QStringLiteral("127.0.0.1:%1").arg(port));
    plant.open();
    QTRY_COMPARE(plant.connectionState(), PlantConnection::Disconnected);
    TestMaster master;
    QVERIFY(master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, port)));
    QTRY_VERIFY_WITH_TIMEOUT(plant.isConnected(), 10000);
}

void tst_Plant::aLostMasterIsFoundAgainAndTheGapIsKept()
{
    auto master = std::make_unique<RunningMaster>();
    QVERIFY(master->startRealTime());
    const QPlcUnderlyingProtocol address = master->protocol("tcp");
    Plant plant(master->address());
    QSignalSpy events(&plant, &Plant::eventOccurred);
    QSignalSpy tables(&plant, &Plant::tableChanged);
    plant.open();
    QTRY_VERIFY(plant.values().rows() > 10);
    master.reset();
    QTRY_VERIFY(!plant.isConnected());
    QCOMPARE(plant.quality(), Plant::Stale);
    QCOMPARE(plant.nextAction(), Plant::NoAction);
    const auto rows = plant.store()->endRow();
    QVERIFY(plant.value(testTable().indexOf(QStringLiteral("count"))).toInt() > 5);  // grey, but there

    TestMaster next(QPlcClock::realTime());
    QVERIFY(next.startServer(address));
    QVERIFY(next.startRealTime());
    QTRY_VERIFY_WITH_TIMEOUT(plant.store()->endRow() > rows + 5, 10000);
    QVERIFY(plant.store()->beginsAnew(rows));
    QVERIFY(!plant.store()->beginsAnew(rows + 1));
    QCOMPARE(plant.quality(), Plant::Good);
    QCOMPARE(tables.size(), 1);
    QCOMPARE(textsOf(events).filter(QStringLiteral("lost the master")).size(), 1);
    QTRY_COMPARE(textsOf(events).filter(QStringLiteral("connected to the master")).size(), 2);
}

void tst_Plant::anotherTableReplacesSignalsAndStore()
{
    auto master = std::make_unique<RunningMaster>();
    const QPlcUnderlyingProtocol address = master->protocol("tcp");
    Plant plant(master->address());
    plant.open();
    QTRY_COMPARE(plant.table().size(), testTable().size());
    QSignalSpy tables(&plant, &Plant::tableChanged);
    QSignalSpy stores(&plant, &Plant::storeChanged);
    master.reset();
    TestMaster next(QPlcClock::realTime(), QPlcSignalTable::fromIni("[other]\ntype=Real[4]\n"));
    QVERIFY(next.startServer(address));
    QTRY_COMPARE_WITH_TIMEOUT(tables.size(), 1, 10000);
    QCOMPARE(stores.size(), 1);
    QCOMPARE(plant.store()->channels(), 4);
    QVERIFY(next.startRealTime());
    QTRY_VERIFY(plant.values().rows() > 3);
}

void tst_Plant::silentPortTimesOutAndIsRetried()
{
    QTcpServer silent;
    QVERIFY(silent.listen(QHostAddress::LocalHost));
    ControlClient channel({QStringLiteral("window"), messages::Part::Tool, {}});
    channel.setAnswerTimes(std::chrono::milliseconds(300), std::chrono::minutes(1));
    QSignalSpy lost(&channel, &ControlClient::lost);
    for (int attempt = 1; attempt <= 2; ++attempt) {
        channel.connectToMaster(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, silent.serverPort()));
        QTRY_COMPARE(lost.size(), attempt);
        QCOMPARE(lost.last().at(1).toString(), QStringLiteral("no answer within 0.3 s"));
    }
    // A peer that speaks something else is no master.
    connect(&silent, &QTcpServer::newConnection, this, [&] {
        while (QTcpSocket *socket = silent.nextPendingConnection())
            socket->write("HTTP/1.1 400 Bad Request\r\n\r\n");
    });
    channel.connectToMaster(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, silent.serverPort()));
    QTRY_COMPARE(lost.size(), 3);
    QVERIFY(lost.last().at(1).toString().contains(QStringLiteral("not a QtPLC message")));
}

void tst_Plant::nodeNameInUseIsReportedAndKeepsThePlantConnected()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    auto first = std::make_unique<Plant>(master.address(), QString(), QStringLiteral("Window"));
    first->open();
    QTRY_VERIFY(first->values().rows() > 0);
    Plant second(master.address(), QString(), QStringLiteral("Window"));
    QSignalSpy events(&second, &Plant::eventOccurred);
    second.open();
    QTRY_VERIFY(!textsOf(events).filter(QStringLiteral("Window")).filter(QStringLiteral("refuses")).isEmpty());
    QVERIFY(second.isConnected());
    QCOMPARE(second.nextAction(), Plant::StopAction);
    first.reset();
    QTRY_VERIFY_WITH_TIMEOUT(second.values().rows() > 0, 10000);
}

void tst_Plant::nodeArrivalsAndDeparturesAreEvents()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    Plant plant(master.address());
    QSignalSpy events(&plant, &Plant::eventOccurred);
    plant.open();
    QTRY_VERIFY(plant.values().rows() > 0);
    auto echo = std::make_unique<EchoNode>();
    echo->setSignalTable(testTable());
    QVERIFY(echo->connectToMasterAndWaitForConnected(master.protocol("udp")));
    QTRY_COMPARE(textsOf(events).filter(QStringLiteral("node Echo registered")).size(), 1);
    QTRY_COMPARE(plant.writer(testTable().indexOf(QStringLiteral("echo"))), QStringLiteral("Echo"));
    echo->disconnectFromMaster();
    echo.reset();
    QTRY_COMPARE(textsOf(events).filter(QStringLiteral("node Echo is gone")).size(), 1);
    QTRY_COMPARE(plant.writer(testTable().indexOf(QStringLiteral("echo"))), QString());
}

void tst_Plant::aPlantIsClosedAndOpenedAgain()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    Plant plant(master.address());
    plant.close();  // was never open
    QSignalSpy events(&plant, &Plant::eventOccurred);
    plant.open();
    plant.open();
    QTRY_VERIFY(plant.values().rows() > 3);
    plant.close();
    QCOMPARE(plant.connectionState(), PlantConnection::Disconnected);
    QCOMPARE(textsOf(events).last(), QStringLiteral("left the master at %1").arg(master.address()));
    QVERIFY(std::none_of(events.begin(), events.end(), [](const QList<QVariant> &call) {
        return qvariant_cast<PlantEvent>(call.at(0)).severity == PlantEvent::Error;
    }));
    const quint64 rows = plant.values().rows();
    QTest::qWait(600);  // longer than the pause before an attempt
    QVERIFY(!plant.isConnected());
    plant.open();
    QTRY_VERIFY(plant.values().rows() > rows + 3);
}

void tst_Plant::pausesGrowFromAQuarterToFiveSeconds()
{
    const QVector<int> expected{250, 500, 1000, 2000, 4000, 5000, 5000};
    for (int i = 0; i < expected.size(); ++i)
        QCOMPARE(PlantConnection::pauseAfter(i + 1), expected.at(i));
    QCOMPARE(PlantConnection::pauseAfter(1'000'000), 5000);
}

void tst_Plant::hostsAreLookedUpInTheBackground()
{
    QCOMPARE(AddressResolver::hostToLookUp(QStringLiteral("winch.example:50001")), QStringLiteral("winch.example"));
    QCOMPARE(AddressResolver::hostToLookUp(QStringLiteral("udp://winch.example")), QStringLiteral("winch.example"));
    for (const char *known :
         {"127.0.0.1", "tcp://127.0.0.1:50000", "localhost:1", "[::1]:50000", "udp://[::1]", "local://tower"})
        QVERIFY2(AddressResolver::hostToLookUp(QString(known)).isEmpty(), known);
    AddressResolver resolver;
    QSignalSpy failed(&resolver, &AddressResolver::failed);
    resolver.resolve(QStringLiteral("no-such-host.invalid:50000"));
    QVERIFY(failed.isEmpty());
    QTRY_COMPARE(failed.size(), 1);
    QVERIFY(failed.at(0).at(0).toString().contains(QStringLiteral("no-such-host.invalid")));
    resolver.resolve(QStringLiteral("127.0.0.1:notAPort"));
    QCOMPARE(failed.size(), 2);
}

void tst_Plant::severalPlantsLiveSideBySide()
{
    RunningMaster north;
    RunningMaster south(QPlcSignalTable::fromIni("[other]\ntype=Real\n[count]\ntype=Int32\n[echo]\ntype=Real64\n[sum]\n"
                                                 "type=Real64\nunit=m\n"));
    QVERIFY(north.startRealTime());
    QVERIFY(south.startRealTime());
    PlantList plants;
    Plant *first = plants.add(north.address(), QStringLiteral("kite"));
    Plant *second = plants.add(south.address(), QStringLiteral("kite"));
    Plant *nobody = plants.add(QStringLiteral("127.0.0.1:%1").arg(freePort()));
    QCOMPARE(second->name(), QStringLiteral("kite (2)"));
    QTRY_VERIFY(first->values().rows() > 5);
    QTRY_VERIFY(second->values().rows() > 5);  // whose table is another one than that of the process
    QVERIFY(!nobody->isConnected());
    QVERIFY(second->value(second->table().indexOf(QStringLiteral("count"))).toInt() > 3);
    plants.remove(first);
    QCOMPARE(plants.size(), 2);
    const quint64 rows = second->values().rows();
    QTRY_VERIFY(second->values().rows() > rows + 5);
    plants.remove(first);  // is none of them
    QCOMPARE(plants.size(), 2);
}

void tst_Plant::referencesFindTheirSignalsWhenTheyAppear()
{
    RunningMaster master;
    PlantList plants;
    QSignalSpy changed(&plants, &PlantList::signalsChanged);
    const SignalReference vector = SignalReference::fromString(QStringLiteral("vector[2]"));
    QVERIFY(!plants.resolve(vector));
    Plant *plant = plants.add(master.address(), QStringLiteral("kite"));
    QVERIFY(!plants.resolve(vector));
    QVERIFY(!plants.resolve(vector).value().isValid());
    QTRY_VERIFY(!changed.isEmpty());
    const PlantList::Signal signal = plants.resolve(vector);
    QVERIFY(signal);
    QCOMPARE(signal.definition().name, QStringLiteral("vector"));
    QVERIFY(signal.channel() >= 2);
    QCOMPARE(plants.resolve(SignalReference::fromString("vector")).channel(), ChannelMap::NoChannel);
    QVERIFY(plants.resolve(SignalReference::fromString("count")).channel() >= 0);
    QCOMPARE(plants.resolve(SignalReference::fromString("time")).channel(), ChannelMap::NoChannel);
    QVERIFY(!plants.resolve(SignalReference::fromString("vector[3]")));
    QVERIFY(!plants.resolve(SignalReference::fromString("time[0]")));
    QVERIFY(!plants.resolve(SignalReference::fromString("other/vector")));
    QVERIFY(plants.resolve(SignalReference::fromString("kite/vector")));
    QVERIFY(master.setSignalValue(QStringLiteral("vector"), QPlcValue({1.0, 2.0, 3.0})));
    QTRY_COMPARE(plants.resolve(vector).value(), QPlcValue(3.0));
    QCOMPARE(plants.reference(plant, signal.index, 2).toString(), QStringLiteral("vector[2]"));
    plants.add(QStringLiteral("127.0.0.1:%1").arg(freePort()), QStringLiteral("b"));
    QCOMPARE(plants.reference(plant, signal.index, 2).toString(), QStringLiteral("kite/vector[2]"));
    plants.remove(plant);
    QVERIFY(!plants.resolve(vector));
}

QTEST_GUILESS_MAIN(tst_Plant)
#include "tst_Plant.moc"
