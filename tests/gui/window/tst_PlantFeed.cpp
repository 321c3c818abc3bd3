// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "NodeFixtures.h"
#include "gui/plant/PlantFeed.h"
#include "gui/plant/PlantList.h"

#include <cmath>

using namespace qplc;

namespace {

constexpr PlantValues::Time millisecond = 1'000'000;
constexpr PlantValues::Time begin = 1'700'000'000'000 * millisecond;

/// Cycles that count on from \a first, without the other signals.
QList<QPlcSignalList> cycles(int first, int count)
{
    QList<QPlcSignalList> batch;
    for (int i = first; i < first + count; ++i)
        batch.append(valueOf("count", QPlcValue(i)));
    return batch;
}

struct FedPlant
{
    FedPlant()
    {
        QPlcSignalIndexTable::setCurrent(testTable());
        plant = plants.addFed(QStringLiteral("fed"));
        plant->feed()->connected(testTable());
    }
    PlantFeed &feed() { return *plant->feed(); }

    PlantList plants;
    Plant *plant;
};

}  // namespace

class tst_PlantFeed : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aFedPlantHasStateAndNextAction();
    void omittedValuesKeepTheirLastValue();
    void rowsFollowTheWallClock_data();
    void rowsFollowTheWallClock();
    void aPauseInterruptsTheCurves();
    void feedIsIgnoredWithoutConnection();
    void commandsGoOutAndAreDone();
    void theStoreStaysOverLostConnections();
};

void tst_PlantFeed::aFedPlantHasStateAndNextAction()
{
    FedPlant fed;
    QVERIFY(fed.plant->isConnected());
    QCOMPARE(fed.plant->nextAction(), Plant::Start);
    fed.feed().initialize(valueOf("count", QPlcValue(3)));
    QCOMPARE(fed.plant->stateText(), QStringLiteral("Ready"));
    QCOMPARE(fed.plant->value(testTable().indexOf(QStringLiteral("count"))).toInt(), 3);
    QCOMPARE(fed.plant->quality(), Plant::AtRest);
    fed.feed().started();
    QCOMPARE(fed.plant->nextAction(), Plant::StopAction);
    fed.feed().stopped();
    QCOMPARE(fed.plant->stateText(), QStringLiteral("Off"));
    fed.feed().disconnected();
    QVERIFY(!fed.plant->isConnected());
    QCOMPARE(fed.plant->nextAction(), Plant::NoAction);
}

void tst_PlantFeed::omittedValuesKeepTheirLastValue()
{
    FedPlant fed;
    fed.feed().started();
    fed.feed().add(cycles(5, 3), begin);
    const PlantList::Signal count = fed.plants.resolve(SignalReference::fromString(QStringLiteral("count")));
    const SignalStore *store = fed.plant->store();
    QCOMPARE(store->endRow() - store->firstRow(), SignalStore::Row(3));
    QCOMPARE(store->value(count.channel(), store->endRow() - 1), 7.0F);
    QCOMPARE(fed.plant->value(count.index).toInt(), 7);
    QCOMPARE(fed.plant->value(testTable().indexOf(QStringLiteral("echo"))).toReal(), 0.0);
    QCOMPARE(fed.plant->quality(), Plant::Good);
}

void tst_PlantFeed::rowsFollowTheWallClock_data()
{
    QTest::addColumn<double>("period");  // [ms]
    QTest::newRow("10 Hz") << 100.0;
    QTest::newRow("100 Hz") << 10.0;
    QTest::newRow("133 Hz") << 7.5;
    QTest::newRow("1 kHz") << 1.0;
}

/// Batches 50 times a second, as a timer of a busy window gives them, from a plant of any rate.
void tst_PlantFeed::rowsFollowTheWallClock()
{
    QFETCH(double, period);
    FedPlant fed;
    fed.feed().started();
    quint32 random = 7;
    int taken = 0;
    const double pause = std::max(20.0, period);
    for (int batch = 1; batch <= 1000; ++batch) {
        random = random * 1664525U + 1013904223U;
        const double wall = batch * pause + double(random >> 24) / 64.0;  // 0 ... 4 ms late
        const int due = int(wall / period);
        if (due > taken)
            fed.feed().add(cycles(taken, due - taken), begin + PlantValues::Time(wall * millisecond));
        taken = due;
    }
    const SignalStore *store = fed.plant->store();
    QCOMPARE(int(store->endRow()), taken);
    QCOMPARE(store->nextBeginAnew(store->firstRow() + 1, store->endRow()), store->endRow());
    const auto spacing
        = [&](SignalStore::Row row) { return double(store->time(row) - store->time(row - 1)) / millisecond; };
    for (SignalStore::Row row = store->endRow() / 2; row < store->endRow(); ++row)
        QVERIFY2(std::fabs(spacing(row) - period) < 0.35 * period, qPrintable(QString::number(spacing(row))));
    const double behind = double(begin - store->time(store->endRow() - 1)) / millisecond + 1000 * pause;
    QVERIFY2(std::fabs(behind) < 25.0 + period, qPrintable(QString::number(behind)));
}

void tst_PlantFeed::aPauseInterruptsTheCurves()
{
    FedPlant fed;
    fed.feed().started();
    fed.feed().add(cycles(0, 2), begin);
    fed.feed().add(cycles(2, 2), begin + 20 * millisecond);
    fed.feed().add(cycles(4, 2), begin + 3000 * millisecond);
    const SignalStore *store = fed.plant->store();
    QVERIFY(!store->beginsAnew(2));
    QVERIFY(store->beginsAnew(4));
    QCOMPARE(store->time(5), begin + 3000 * millisecond);
}

void tst_PlantFeed::feedIsIgnoredWithoutConnection()
{
    PlantList plants;
    Plant *plant = plants.addFed(QStringLiteral("fed"));
    plant->feed()->add(cycles(0, 3), begin);
    plant->feed()->initialize({});
    plant->feed()->started();
    plant->feed()->stopped();
    plant->feed()->disconnected();
    QVERIFY(!plant->isConnected());
    QVERIFY(!plant->store());
    QCOMPARE(plant->quality(), Plant::NoValue);
}

void tst_PlantFeed::commandsGoOutAndAreDone()
{
    FedPlant fed;
    QSignalSpy commanded(fed.plant->feed(), &PlantFeed::commanded);
    QSignalSpy done(fed.plant, &Plant::commandDone);
    const int number = fed.plant->stop();
    QCOMPARE(commanded.count(), 1);
    QCOMPARE(commanded.first().first().value<QPlcMessage>().kind(), QPlcMessage::Stop);
    QTRY_COMPARE(done.count(), 1);
    QCOMPARE(done.first().first().toInt(), number);
    fed.feed().disconnected();
    QSignalSpy failed(fed.plant, &Plant::commandFailed);
    fed.plant->start();
    QTRY_COMPARE(failed.count(), 1);
}

void tst_PlantFeed::theStoreStaysOverLostConnections()
{
    FedPlant fed;
    fed.feed().started();
    fed.feed().add(cycles(0, 2), begin);
    const SignalStore *store = fed.plant->store();
    fed.feed().disconnected();
    fed.feed().connected(testTable());
    fed.feed().add(cycles(2, 2), begin + 100 * millisecond);
    QCOMPARE(fed.plant->store(), store);
    QCOMPARE(int(store->endRow()), 4);
    QVERIFY(store->beginsAnew(2));
}

QTEST_GUILESS_MAIN(tst_PlantFeed)
#include "tst_PlantFeed.moc"
