// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "PlantFixtures.h"

#include "ScriptedMaster.h"

using namespace qplc;

namespace {

const QString echo = QStringLiteral("echo");
const QString setpoint = QStringLiteral("setpoint");

QVector<PlantEvent> eventsOf(const QSignalSpy &spy)
{
    QVector<PlantEvent> events;
    for (const QList<QVariant> &call : spy)
        events << qvariant_cast<PlantEvent>(call.at(0));
    return events;
}

QStringList textsOf(const QSignalSpy &spy)
{
    QStringList texts;
    for (const PlantEvent &event : eventsOf(spy))
        texts << event.text;
    return texts;
}

}  // namespace

class tst_PlantLeases : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void windowAcquiresAndReleasesASignal();
    void everyWindowSeesTheSingleHolder();
    void leaseOfAnotherWindowIsAcquiredOnlyExplicitly();
    void aWindowThatDoesNothingKeepsItsLease();
    void aWindowThatHangsLosesItsLease();
    void aWindowThatEndsLeavesTheNeutralValue();
    void aWindowWithoutAMasterKnowsOfNoLease();
    void earlierEventsAreDeliveredFirstAndOnce();
    void eventsOfTheMasterAreReportedOnce();
    void eventsOfAnOldConnectionAreNotRepeated();
    void olderMasterIsMonitoredWithoutLeasesAndEvents();
};

void tst_PlantLeases::windowAcquiresAndReleasesASignal()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    Plant plant(master.address());
    QSignalSpy changed(&plant, &Plant::leasesChanged);
    QSignalSpy done(&plant, &Plant::commandDone);
    plant.open();
    QTRY_VERIFY(plant.hasLeases());
    QTRY_VERIFY(master.valueOf(echo) > 10.0);
    const int command = plant.takeLease({echo}, {{echo, -3.0}});
    QTRY_COMPARE(changed.size(), 1);
    QTRY_COMPARE(done.size(), 1);
    QCOMPARE(done.at(0).at(0).toInt(), command);
    QCOMPARE(plant.leases().size(), 1);
    QCOMPARE(plant.lease(echo)->holder, PlantLeases::whoever());
    QCOMPARE(plant.lease(echo)->state, LeaseStatus::Held);
    QVERIFY(plant.lease(echo)->isMine);
    QVERIFY(!plant.lease(setpoint));
    QTRY_COMPARE(master.valueOf(echo), -3.0);
    plant.setValues({{echo, -4.0}});
    QTRY_COMPARE(master.valueOf(echo), -4.0);
    plant.releaseLease({echo});
    QTRY_VERIFY(plant.leases().isEmpty());
    QTRY_VERIFY(master.valueOf(echo) > 10.0);
}

void tst_PlantLeases::everyWindowSeesTheSingleHolder()
{
    FlyingMaster master;
    Plant first(master.address(), QString(), QStringLiteral("First"));
    Plant second(master.address(), QString(), QStringLiteral("Second"));
    first.open();
    second.open();
    QTRY_VERIFY(first.hasLeases() && second.hasLeases());
    first.takeLease({echo, setpoint});
    QTRY_COMPARE(first.leases().size(), 2);
    QTRY_COMPARE(second.leases().size(), 2);
    QVERIFY(first.lease(echo)->isMine);
    QVERIFY(!second.lease(echo)->isMine);  // of the same person
    QCOMPARE(second.lease(echo)->holder, first.lease(echo)->holder);
    Plant third(master.address(), QString(), QStringLiteral("Third"));
    third.open();
    QTRY_COMPARE(third.leases().size(), 2);  // from before it came
}

void tst_PlantLeases::leaseOfAnotherWindowIsAcquiredOnlyExplicitly()
{
    FlyingMaster master;
    Plant first(master.address(), QString(), QStringLiteral("First"));
    Plant second(master.address(), QString(), QStringLiteral("Second"));
    first.open();
    second.open();
    QTRY_VERIFY(first.hasLeases() && second.hasLeases());
    first.takeLease({echo});
    QTRY_VERIFY(first.lease(echo) && second.lease(echo));
    QSignalSpy failed(&second, &Plant::commandFailed);
    second.takeLease({echo});
    QTRY_COMPARE(failed.size(), 1);
    QVERIFY(failed.at(0).at(1).toString().contains(echo));
    QVERIFY(first.lease(echo)->isMine);
    second.takeLease({echo}, {}, Plant::AlsoFromOthers);
    QTRY_VERIFY(second.lease(echo)->isMine);
    QTRY_VERIFY(!first.lease(echo)->isMine);
}

void tst_PlantLeases::aWindowThatDoesNothingKeepsItsLease()
{
    FlyingMaster master;
    Plant plant(master.address());
    plant.open();
    QTRY_VERIFY(plant.hasLeases());
    plant.takeLease({echo});
    QTRY_VERIFY(plant.lease(echo));
    QSignalSpy changed(&plant, &Plant::leasesChanged);
    QTest::qWait(PlantLeases::Timeout * 2);
    QVERIFY(changed.isEmpty());
    QVERIFY(plant.lease(echo)->isMine);
}

void tst_PlantLeases::aWindowThatHangsLosesItsLease()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    // The window hears nothing and says nothing, while its connection is there: as if its thread
    // hung.
    QThread thread;
    QObject window;
    window.moveToThread(&thread);
    thread.start();
    std::unique_ptr<Plant> plant;
    QMetaObject::invokeMethod(&window, [&] {
        plant = std::make_unique<Plant>(master.address());
        connect(plant.get(), &Plant::stateChanged, plant.get(), [&, isFirst = true]() mutable {
            if (plant->hasLeases() && std::exchange(isFirst, false))
                plant->takeLease({echo}, {{echo, -3.0}});
        });
        plant->open();
    });
    QTRY_COMPARE(master.valueOf(echo), -3.0);
    QElapsedTimer time;
    time.start();
    QMetaObject::invokeMethod(&window, [] { QThread::msleep(3 * PlantLeases::Timeout); });
    QTRY_COMPARE(master.valueOf(echo), 0.0);
    QVERIFY(time.elapsed() < 2 * PlantLeases::Timeout);
    QVERIFY(master.leases().first().isLost);
    QMetaObject::invokeMethod(
        &window, [&] { plant.reset(); }, Qt::BlockingQueuedConnection);
    thread.quit();
    QVERIFY(thread.wait());
}

void tst_PlantLeases::aWindowThatEndsLeavesTheNeutralValue()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    Plant other(master.address(), QString(), QStringLiteral("Other"));
    other.open();
    auto plant = std::make_unique<Plant>(master.address());
    plant->open();
    QTRY_VERIFY(plant->hasLeases());
    plant->takeLease({echo}, {{echo, -3.0}});
    QTRY_COMPARE(master.valueOf(echo), -3.0);
    plant.reset();
    QTRY_COMPARE(master.valueOf(echo), 0.0);
    QTRY_VERIFY(other.lease(echo) && other.lease(echo)->state == LeaseStatus::Lost);
    QVERIFY(!other.lease(echo)->isMine);
    QCOMPARE(other.lease(echo)->holder, PlantLeases::whoever());
    other.releaseLease({echo});  // anyone may
    QTRY_VERIFY(other.leases().isEmpty());
}

void tst_PlantLeases::aWindowWithoutAMasterKnowsOfNoLease()
{
    auto master = std::make_unique<FlyingMaster>();
    Plant plant(master->address());
    plant.open();
    QTRY_VERIFY(plant.hasLeases());
    plant.takeLease({echo});
    QTRY_VERIFY(plant.lease(echo));
    QSignalSpy changed(&plant, &Plant::leasesChanged);
    master.reset();
    QTRY_VERIFY(!plant.isConnected());
    QCOMPARE(changed.size(), 1);
    QVERIFY(plant.leases().isEmpty());
    QVERIFY(!plant.hasLeases());
}

// ---- events ----

void tst_PlantLeases::earlierEventsAreDeliveredFirstAndOnce()
{
    FlyingMaster master;
    for (int i = 0; i < 250; ++i) {  // more than one answer has
        QVERIFY(master.startRealTime());
        master.stop();
    }
    Plant plant(master.address(), QStringLiteral("kite"));
    QSignalSpy events(&plant, &Plant::eventOccurred);
    plant.open();
    QTRY_VERIFY(textsOf(events).contains(QStringLiteral("connected to the master at %1").arg(master.address())));
    const int before = textsOf(events).indexOf(QStringLiteral("connected to the master at %1").arg(master.address()));
    QVERIFY(before >= 500);
    QCOMPARE(textsOf(events).filter(QStringLiteral("state Real time")).size(), 250);
    for (int i = 1; i < before; ++i)
        QVERIFY(eventsOf(events).at(i - 1).time <= eventsOf(events).at(i).time);
    QCOMPARE(eventsOf(events).first().source, QStringLiteral("kite"));
    QVERIFY(!eventsOf(events).first().isAcknowledged);
}

void tst_PlantLeases::eventsOfTheMasterAreReportedOnce()
{
    FlyingMaster master;
    Plant plant(master.address(), QStringLiteral("kite"));
    QSignalSpy events(&plant, &Plant::eventOccurred);
    plant.open();
    QTRY_VERIFY(!events.isEmpty());
    plant.start();
    QTRY_VERIFY(plant.status().isRunning());
    QTRY_COMPARE(textsOf(events).filter(QStringLiteral("Real time")).size(), 1);
    plant.takeLease({echo});
    QTRY_COMPARE(textsOf(events).filter(QStringLiteral("has taken over")).size(), 1);
    plant.stop();
    QTRY_VERIFY(!plant.status().isRunning());
    QTest::qWait(1200);  // polls that could tell it again
    QCOMPARE(textsOf(events).filter(QStringLiteral("Real time")).size(), 1);
    const PlantEvent taken = eventsOf(events).at(
        textsOf(events).indexOf(textsOf(events).filter(QStringLiteral("has taken over")).first()));
    QCOMPARE(taken.source, QStringLiteral("kite"));
    QVERIFY(std::abs(taken.time.msecsTo(QDateTime::currentDateTime())) < 60000);
}

void tst_PlantLeases::eventsOfAnOldConnectionAreNotRepeated()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    Plant plant(master.address());
    QSignalSpy events(&plant, &Plant::eventOccurred);
    plant.open();
    QTRY_COMPARE(textsOf(events).filter(QStringLiteral("connected to")).size(), 1);
    plant.close();
    master.stop();
    plant.open();
    QTRY_COMPARE(textsOf(events).filter(QStringLiteral("connected to")).size(), 2);
    QCOMPARE(textsOf(events).filter(QStringLiteral("state Real time")).size(), 1);
    QCOMPARE(textsOf(events).filter(QStringLiteral("state Off")).size(), 1);  // while it was away
}

void tst_PlantLeases::olderMasterIsMonitoredWithoutLeasesAndEvents()
{
    ScriptedMaster master;
    Plant plant(master.tcp().toString());
    QSignalSpy events(&plant, &Plant::eventOccurred);
    QSignalSpy failed(&plant, &Plant::commandFailed);
    plant.open();
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    QCOMPARE(master.messages.first().fields().value(QStringLiteral("features")).toArray(),
             (QJsonArray{QStringLiteral("leases"), QStringLiteral("events")}));
    QJsonObject hello = master.helloFields();
    hello.insert(QStringLiteral("state"), QStringLiteral("Off"));
    master.send(QPlcMessage::Hello, hello);
    QTRY_VERIFY(plant.isConnected());
    QVERIFY(!plant.hasLeases());
    QCOMPARE(textsOf(events).filter(QStringLiteral("connected to")).size(), 1);  // nothing to wait for
    master.send(QPlcMessage::State, {{QStringLiteral("state"), QStringLiteral("RealTime")}});
    QTRY_COMPARE(textsOf(events).filter(QStringLiteral("state Real time")).size(), 1);
    plant.takeLease({echo});
    const auto asked = [&](QPlcMessage::Kind kind) {
        return std::count_if(master.messages.begin(), master.messages.end(),
                             [kind](const QPlcMessage &message) { return message.kind() == kind; });
    };
    QTRY_COMPARE(int(asked(QPlcMessage::TakeLease)), 1);
    QCOMPARE(int(asked(QPlcMessage::GetLeases)), 0);
    QCOMPARE(int(asked(QPlcMessage::GetEvents)), 0);
}

QTEST_GUILESS_MAIN(tst_PlantLeases)
#include "tst_PlantLeases.moc"
