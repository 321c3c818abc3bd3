// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "PlantFixtures.h"
#include "gui/plant/PastValue.h"

using namespace qplc;

namespace {

PlantList::Signal signalOf(const PlantList &plants, const char *text)
{
    return plants.resolve(SignalReference::fromString(QString(text)));
}

}  // namespace

class tst_PastValue : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void valueIsInvalidWithoutPlantOrBeforeTheFirstRow();
    void aValueHoldsUntilTheNextRow();
    void valueDuringAnInterruptionIsInvalid();
    void valuesKeepTheTypeAndElementsOfTheSignal();
};

void tst_PastValue::valueIsInvalidWithoutPlantOrBeforeTheFirstRow()
{
    RunningMaster master;
    PlantList plants;
    QVERIFY(!pastValue({}, 0).isValid());
    Plant *plant = plants.add(master.address());
    QTRY_VERIFY(plant->store());
    QVERIFY(plant->store()->isEmpty());
    QVERIFY(!pastValue(signalOf(plants, "count"), 0).isValid());
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(!plant->store()->isEmpty());
    const SignalStore::Time first = plant->store()->time(plant->store()->firstRow());
    QVERIFY(!pastValue(signalOf(plants, "count"), first - 1).isValid());
    QVERIFY(pastValue(signalOf(plants, "count"), first).isValid());
    QVERIFY(!pastValue(signalOf(plants, "time"), first).isValid());
}

void tst_PastValue::aValueHoldsUntilTheNextRow()
{
    RunningMaster master;
    PlantList plants;
    Plant *plant = plants.add(master.address());
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(plant->store() && plant->store()->endRow() > plant->store()->firstRow() + 50);
    const SignalStore &store = *plant->store();
    SignalStore::Row row = store.firstRow() + 3;
    while (row + 2 < store.endRow() && store.beginsAnew(row + 1))  // a busy computer interrupts
        ++row;
    const PlantList::Signal count = signalOf(plants, "count");
    const double value = double(store.value(count.channel(), row));
    QCOMPARE(pastValue(count, store.time(row)).toReal(), value);
    QCOMPARE(pastValue(count, store.time(row + 1) - 1).toReal(), value);
    QCOMPARE(pastValue(count, store.time(row + 1)).toReal(), double(store.value(count.channel(), row + 1)));
}

void tst_PastValue::valueDuringAnInterruptionIsInvalid()
{
    RunningMaster master;
    PlantList plants;
    Plant *plant = plants.add(master.address());
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(plant->store() && !plant->store()->isEmpty());
    const SignalStore::Time last = plant->store()->time(plant->store()->endRow() - 1);
    const auto hold = SignalStore::Time(plant->staleAfter() * 1e9);
    master.stop();
    QTRY_COMPARE(plant->quality(), Plant::AtRest);
    const SignalStore::Time end = plant->store()->time(plant->store()->endRow() - 1);
    QVERIFY(end >= last);
    QVERIFY(pastValue(signalOf(plants, "count"), end + hold - 1'000).isValid());
    QVERIFY(!pastValue(signalOf(plants, "count"), end + hold + 1'000).isValid());
}

void tst_PastValue::valuesKeepTheTypeAndElementsOfTheSignal()
{
    RunningMaster master;
    PlantList plants;
    Plant *plant = plants.add(master.address());
    QTRY_VERIFY(plant->store());
    plant->setValues({{QStringLiteral("vector"), QPlcValue({1.5, -2.0, 3.25})}});
    plant->refresh();
    QTRY_COMPARE(plant->value(plant->table().indexOf(QStringLiteral("vector"))).toReal(2), 3.25);
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(!plant->store()->isEmpty());
    const SignalStore::Time now = plant->store()->time(plant->store()->endRow() - 1);
    QCOMPARE(pastValue(signalOf(plants, "vector"), now), QPlcValue({1.5, -2.0, 3.25}));
    QCOMPARE(pastValue(signalOf(plants, "vector[1]"), now), QPlcValue(-2.0));
    QCOMPARE(pastValue(signalOf(plants, "count"), now).type().scalar(), QPlcSignalType::Int32);
}

QTEST_MAIN(tst_PastValue)
#include "tst_PastValue.moc"
