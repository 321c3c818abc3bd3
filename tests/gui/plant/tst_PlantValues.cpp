// SPDX-License-Identifier: Apache-2.0
#include "formulas/SignalReference.h"
#include "gui/plant/PlantStatus.h"
#include "gui/plant/PlantValues.h"
#include "node/Logging.h"

#include <QtCore/QJsonArray>
#include <QtTest/QtTest>

#include <cmath>

using namespace qplc;

namespace {

/// What a window reads when a master answers with \a fields.
template<typename Answer>
Answer answerOf(const QJsonObject &fields)
{
    return messages::fieldsOf<Answer>(fields);
}

constexpr qint64 ms = 1'000'000;  // [ns]
constexpr qint64 wall = 1'800'000'000'000 * ms;

QPlcSignalTable table()
{
    return QPlcSignalTable::fromIni("[text]\ntype=String(4)\n[byte]\ntype=UInt8\n[vector]\ntype=Real64[3]\n"
                                    "[time]\ntype=DateTime\n[a]\ntype=Real32\n[b]\ntype=Real32\n[big]\ntype=Int64\n");
}

/// Values of the table: byte = n, vector = n, n + 1, n + 2, a = n / 2, b = -n, big = -n.
QByteArray payload(int n)
{
    const double vector[3] = {double(n), n + 1.0, n + 2.0};
    return QPlcValue::fromString({QPlcSignalType::String, 4}, QStringLiteral("t%1").arg(n)).toBytes()
        + QPlcValue(quint8(n)).toBytes() + QPlcValue(vector).toBytes()
        + QPlcValue::fromString(QPlcSignalType::DateTime, QStringLiteral("2026-01-31T12:00:00Z")).toBytes()
        + QPlcValue(float(n) / 2).toBytes() + QPlcValue(float(-n)).toBytes() + QPlcValue(qint64(-n)).toBytes();
}

void give(PlantValues *values, quint64 cycle, quint64 phase, qint64 now, qint64 period = 10 * ms, int every = 1)
{
    const QByteArray bytes = payload(int(cycle));
    values->storeFrame({cycle, phase, std::chrono::nanoseconds(period), bytes.constData(), bytes.size(), every}, now);
}

}  // namespace

class tst_PlantValues : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void everyElementOfANumberHasAChannel();
    void allTypesBecomeFloats();
    void anEmptyTableHasNoChannels();
    void rowsLieAPeriodApartFromTheBeginOfThePhase();
    void unwrittenValuesAreGapsInCurves();
    void aJumpOfCyclesIsAGap();
    void reducedRateCausesNoGap();
    void missingFrameAtReducedRateIsAGap();
    void anotherIntervalKeepsThePast();
    void newPhaseStartsANewSegmentAtALaterTime();
    void interruptionIsNotCountedAsCycleGap();
    void framesThatTheLastConnectionLeftAreNoneOfTheNextOne_data();
    void framesThatTheLastConnectionLeftAreNoneOfTheNextOne();
    void aPhaseGoesOnAtWholePeriodsBehindALostConnection_data();
    void aPhaseGoesOnAtWholePeriodsBehindALostConnection();
    void rowsOfThePastReplaceThoseOfTheirGap();
    void framesOfAnotherTableAreIgnored();
    void theStoreIsBoundedByTimeAndMemory();
    void aMuchShorterPeriodGetsALargerStore();
    void aBatchHoldsTheCyclesSinceTheLastOne();
    void valuesAtRestReplaceTheNewest();
    void referencesAreReadAndWritten_data();
    void referencesAreReadAndWritten();
    void invalidTextIsNotAReference_data();
    void invalidTextIsNotAReference();
    void newOverrunsAreMarkedUntilTheNextStatistics();
    void aStatusKeepsTheFiguresOfItsNodes();
    void invalidAnswersGiveAnEmptyStatus();
    void displayedTextsContainNoEscapeCodes();
};

void tst_PlantValues::everyElementOfANumberHasAChannel()
{
    const ChannelMap map(table());
    QCOMPARE(map.channels(), 1 + 3 + 1 + 1 + 1);
    QCOMPARE(map.payloadSize(), payload(0).size());
    QCOMPARE(map.channel(0), ChannelMap::NoChannel);  // text
    QCOMPARE(map.channel(1), 0);
    QCOMPARE(map.channel(2, 2), 3);
    QCOMPARE(map.channel(2, 3), ChannelMap::NoChannel);
    QCOMPARE(map.channel(2, -1), ChannelMap::NoChannel);
    QCOMPARE(map.channel(3), ChannelMap::NoChannel);  // time
    QCOMPARE(map.channel(4), 4);
    QCOMPARE(map.channel(QPlcInvalidSignalIndex), ChannelMap::NoChannel);
    QCOMPARE(map.offset(2), 6 + 1);
}

void tst_PlantValues::allTypesBecomeFloats()
{
    const char *types[]
        = {"Int8", "Int16", "Int32", "Int64", "UInt8", "UInt16", "UInt32", "UInt64", "Real32", "Real64"};
    for (const char *type : types) {
        const QPlcSignalTable one = QPlcSignalTable::fromIni(QByteArray("[x]\ntype=") + type + "[2]\n");
        const QByteArray bytes = QPlcValue::fromString(one.at(0).type, QStringLiteral("7, 100")).toBytes();
        float values[2] = {};
        ChannelMap(one).toFloats(bytes.constData(), values);
        QVERIFY2(values[0] == 7.0F && values[1] == 100.0F, type);
    }
}

void tst_PlantValues::anEmptyTableHasNoChannels()
{
    QCOMPARE(ChannelMap().channels(), 0);
    QCOMPARE(ChannelMap().channel(0), ChannelMap::NoChannel);
    const PlantValues values;
    QVERIFY(!values.store());
    QVERIFY(!values.value(0).isValid());
}

void tst_PlantValues::rowsLieAPeriodApartFromTheBeginOfThePhase()
{
    PlantValues values;
    values.setTable(table(), 10 * ms);
    QVERIFY(!values.value(1).isValid());
    give(&values, 5, 1, wall);  // joined late
    give(&values, 6, 1, wall + 77 * ms);
    give(&values, 7, 1, wall + 77 * ms);
    SignalStore &store = *values.store();
    QCOMPARE(store.endRow(), SignalStore::Row(3));
    QCOMPARE(qint64(store.time(0)), wall);
    QCOMPARE(qint64(store.time(2)), wall + 20 * ms);
    QVERIFY(!store.beginsAnew(1) && !store.beginsAnew(2));
    QCOMPARE(store.value(values.channels().channel(2, 1), 2), 8.0F);
    QCOMPARE(values.value(4).toReal(), 3.5);
    QCOMPARE(values.value(0).toString(), QStringLiteral("t7"));
    QCOMPARE(values.gaps(), quint64(0));
}

void tst_PlantValues::unwrittenValuesAreGapsInCurves()
{
    PlantValues values;
    values.setTable(table(), 10 * ms);
    const QByteArray bytes = payload(3);
    QByteArray qualities(7, '\0');  // good
    qualities[1] = char(QPlcQuality::held(2).toByte());
    for (const int invalid : {0, 2, 5})
        qualities[invalid] = char(QPlcQuality(QPlcQuality::Invalid).toByte());
    qualities[6] = char(QPlcQuality(QPlcQuality::Safe).toByte());
    values.storeFrame(
        {0, 1, std::chrono::nanoseconds(10 * ms), bytes.constData(), bytes.size(), 1, qualities.constData()}, wall);
    const auto isGap = [&](int signal, int element = 0) {
        const int channel = values.channels().channel(QPlcSignalIndex(signal), element);
        return std::isnan(values.store()->value(channel, 0));
    };
    QVERIFY(!isGap(1) && !isGap(4) && !isGap(6));
    QVERIFY(isGap(2, 0) && isGap(2, 1) && isGap(2, 2) && isGap(5));
    QCOMPARE(values.quality(1).heldCycles(), 2);
    QCOMPARE(values.quality(2).kind(), QPlcQuality::Invalid);
    QCOMPARE(values.quality(4).kind(), QPlcQuality::Good);
    QCOMPARE(values.quality(6).kind(), QPlcQuality::Safe);
    QCOMPARE(values.value(5).toReal(), -3.0);  // the table shows what there is
    const auto mark = [&](int signal, int element = 0) {
        return int(values.store()->greatestMark(values.channels().channel(QPlcSignalIndex(signal), element), 0, 1));
    };
    QCOMPARE(mark(1), int(QPlcQuality::Held));
    QCOMPARE(mark(2, 2), int(QPlcQuality::Invalid));
    QCOMPARE(mark(4), int(QPlcQuality::Good));
    QCOMPARE(mark(6), int(QPlcQuality::Safe));
}

void tst_PlantValues::aJumpOfCyclesIsAGap()
{
    PlantValues values;
    values.setTable(table(), 10 * ms);
    give(&values, 0, 1, wall);
    give(&values, 1, 1, wall);
    give(&values, 100, 1, wall);
    QCOMPARE(values.gaps(), quint64(1));
    QVERIFY(values.store()->beginsAnew(2));
    QCOMPARE(qint64(values.store()->time(2)), wall + 1000 * ms);
}

void tst_PlantValues::reducedRateCausesNoGap()
{
    PlantValues values;
    values.setTable(table(), 10 * ms);
    for (const quint64 cycle : {23, 30, 40, 53, 60})  // joined late, and skipped 50 ... 52
        give(&values, cycle, 1, wall, 10 * ms, 10);
    QCOMPARE(values.gaps(), quint64(0));
    SignalStore &store = *values.store();
    for (SignalStore::Row row = 1; row < store.endRow(); ++row)
        QVERIFY(!store.beginsAnew(row));
    QCOMPARE(qint64(store.time(0)), wall);
    QCOMPARE(qint64(store.time(4)), wall + 370 * ms);
    QCOMPARE(qint64(values.rowPeriod()), 100 * ms);
    QCOMPARE(qint64(values.period()), 10 * ms);
}

void tst_PlantValues::missingFrameAtReducedRateIsAGap()
{
    PlantValues values;
    values.setTable(table(), 10 * ms);
    for (const quint64 cycle : {0, 10, 30})
        give(&values, cycle, 1, wall, 10 * ms, 10);
    QCOMPARE(values.gaps(), quint64(1));
    QVERIFY(!values.store()->beginsAnew(1));
    QVERIFY(values.store()->beginsAnew(2));
}

void tst_PlantValues::anotherIntervalKeepsThePast()
{
    PlantValues values;
    values.setTable(table(), 1 * ms);
    const SignalStore *store = values.store();
    for (quint64 cycle = 0; cycle < 100; cycle += 10)
        give(&values, cycle, 1, wall, 1 * ms, 10);
    give(&values, 150, 2, wall + 150 * ms, 1 * ms, 1);  // registered again
    give(&values, 151, 2, wall + 150 * ms, 1 * ms, 1);
    QCOMPARE(values.store(), const_cast<SignalStore *>(store));
    QCOMPARE(store->endRow(), SignalStore::Row(12));
    QVERIFY(store->beginsAnew(10));  // nobody knows what was in between
    QVERIFY(!store->beginsAnew(11));
    QCOMPARE(qint64(store->time(10)), wall + 150 * ms);
}

void tst_PlantValues::newPhaseStartsANewSegmentAtALaterTime()
{
    PlantValues values;
    values.setTable(table(), 10 * ms);
    for (quint64 cycle = 0; cycle < 100; ++cycle)  // faster than the clock on the wall
        give(&values, cycle, 1, wall);
    give(&values, 0, 2, wall + 1 * ms);
    give(&values, 1, 2, wall + 1 * ms);
    QCOMPARE(values.store()->endRow(), SignalStore::Row(102));
    QVERIFY(values.store()->beginsAnew(100));
    QCOMPARE(qint64(values.store()->time(100)), wall + 1000 * ms);
    // A phase whose first cycle follows by chance the last one of the former is a new one, too.
    give(&values, 2, 3, wall + 5000 * ms);
    QVERIFY(values.store()->beginsAnew(102));
    QCOMPARE(qint64(values.store()->time(102)), wall + 5000 * ms);
    QCOMPARE(values.gaps(), quint64(0));
}

void tst_PlantValues::interruptionIsNotCountedAsCycleGap()
{
    PlantValues values;
    values.setTable(table(), 10 * ms);
    give(&values, 0, 1, wall);
    values.interrupt();
    give(&values, 1, 2, wall + 3000 * ms);
    QVERIFY(values.store()->beginsAnew(1));
    QCOMPARE(qint64(values.store()->time(1)), wall + 3000 * ms);
    QCOMPARE(values.gaps(), quint64(0));
}

/// The thread that hears them takes some while the window leaves the master.
void tst_PlantValues::framesThatTheLastConnectionLeftAreNoneOfTheNextOne_data()
{
    QTest::addColumn<bool>("isInterrupted");
    QTest::newRow("the master was left") << true;
    QTest::newRow("nothing was heard") << false;
}

void tst_PlantValues::framesThatTheLastConnectionLeftAreNoneOfTheNextOne()
{
    QFETCH(bool, isInterrupted);
    PlantValues values;
    values.setTable(table(), 10 * ms);
    for (const quint64 cycle : {100, 101}) {
        give(&values, cycle, 1, wall);
        values.setPhase({7, wall});
    }
    if (isInterrupted)
        values.interrupt();
    values.rejoin();
    values.setPhase({7, wall});
    give(&values, 102, 1, wall + 1000 * ms);
    QCOMPARE(values.rows(), quint64(2));
    give(&values, 200, 2, wall + 1000 * ms);
    QCOMPARE(values.rows(), quint64(3));
    QCOMPARE(qint64(values.store()->time(2)), wall + 1000 * ms);
    QVERIFY(values.store()->beginsAnew(2));
    QCOMPARE(values.phase().session, quint64(7));
}

void tst_PlantValues::aPhaseGoesOnAtWholePeriodsBehindALostConnection_data()
{
    QTest::addColumn<qint64>("cycleZero");
    QTest::addColumn<int>("session");
    QTest::addColumn<qint64>("cycleZeroThen");
    QTest::addColumn<quint64>("cycle");
    QTest::addColumn<bool>("isNeeded");
    QTest::addColumn<bool>("goesOn");
    QTest::newRow("the same phase") << wall << 7 << wall << quint64(200) << true << true;
    QTest::newRow("another session") << wall << 8 << wall << quint64(200) << true << false;
    QTest::newRow("another phase") << wall << 7 << wall + 1 << quint64(200) << true << false;
    QTest::newRow("nobody tells") << wall << 0 << qint64(0) << quint64(200) << true << false;
    QTest::newRow("a cycle of before") << wall << 7 << wall << quint64(101) << true << false;
    QTest::newRow("is not timed") << qint64(0) << 7 << qint64(0) << quint64(200) << false << false;
}

void tst_PlantValues::aPhaseGoesOnAtWholePeriodsBehindALostConnection()
{
    QFETCH(qint64, cycleZero);
    QFETCH(int, session);
    QFETCH(qint64, cycleZeroThen);
    QFETCH(quint64, cycle);
    PlantValues values;
    values.setTable(table(), 10 * ms);
    give(&values, 100, 1, wall);
    values.setPhase({7, cycleZero});
    QCOMPARE(values.phase().session, quint64(0));  // the answer may be older than the frame
    give(&values, 101, 1, wall);
    values.setPhase({7, cycleZero});
    QCOMPARE(values.phase().session, quint64(7));
    values.interrupt();
    values.rejoin();
    QTEST(values.isPhaseNeeded(), "isNeeded");
    if (session != 0)
        values.setPhase({quint64(session), cycleZeroThen});
    QVERIFY(session == 0 || !values.isPhaseNeeded());
    give(&values, cycle, 2, wall + 1234 * ms);
    QFETCH(bool, goesOn);
    QCOMPARE(qint64(values.store()->time(2)), wall + (goesOn ? 1000 : 1234) * ms);
    QVERIFY(values.store()->beginsAnew(2));
    QCOMPARE(values.phase().session, quint64(goesOn ? 7 : 0));
}

void tst_PlantValues::rowsOfThePastReplaceThoseOfTheirGap()
{
    PlantValues values;
    values.setTable(table(), 10 * ms);
    for (const quint64 cycle : {0, 1, 2})
        give(&values, cycle, 1, wall);
    values.interrupt();
    for (const quint64 cycle : {0, 1})
        give(&values, cycle, 2, wall + 1000 * ms);
    PlantValues past;
    past.setTable(table(), 10 * ms, {200 * ms, 1 << 20});
    for (const qint64 time : {30, 40, 990})
        past.storeRow(payload(int(time)).constData(), wall + time * ms);
    values.fill({wall + 20 * ms, wall + 1000 * ms, SignalStore::Continues, SignalStore::BeginsAnew}, past, 0);
    QVector<qint64> times;
    QVector<int> begins;
    for (SignalStore::Row row = values.store()->firstRow(); row < values.store()->endRow(); ++row) {
        times << (values.store()->time(row) - wall) / ms;
        if (values.store()->beginsAnew(row))
            begins << int(row);
    }
    QCOMPARE(times, (QVector<qint64>{0, 10, 20, 30, 40, 990, 1000, 1010}));
    QCOMPARE(begins, (QVector<int>{0, 6}));
    QCOMPARE(values.store()->capacity(), 60'000);  // ten minutes still
    QCOMPARE(values.store()->value(values.channels().channel(1), 4), 40.0F);
    give(&values, 2, 2, wall + 1020 * ms);
    QVERIFY(!values.store()->beginsAnew(8));
    // What is found later takes its place.
    past.setTable(table(), 10 * ms, {200 * ms, 1 << 20});
    past.storeRow(payload(1).constData(), wall + 500 * ms);
    values.fill({wall + 20 * ms, wall + 1000 * ms}, past, 3'600'000 * ms);
    QCOMPARE(values.store()->endRow(), SignalStore::Row(3 + 1 + 3));
    QCOMPARE(values.store()->capacity(), 360'000);
}

void tst_PlantValues::framesOfAnotherTableAreIgnored()
{
    PlantValues values;
    const char frame[4] = {};
    values.storeFrame({0, 1, std::chrono::nanoseconds(ms), frame, 4}, wall);  // before the table
    values.setTable(table(), 10 * ms);
    values.storeFrame({0, 1, std::chrono::nanoseconds(ms), frame, 4}, wall);
    QCOMPARE(values.rows(), quint64(0));
    QVERIFY(values.store()->isEmpty());
}

void tst_PlantValues::theStoreIsBoundedByTimeAndMemory()
{
    PlantValues values;
    values.setTable(table(), 10 * ms);
    QCOMPARE(values.store()->channels(), 7);
    QCOMPARE(values.store()->capacity(), 60'000);
    values.setTable(table(), 10 * ms, {600'000 * ms, 39 * 1000});  // 9 + 7 * 4.33 bytes a row
    QCOMPARE(values.store()->capacity(), 1000);
    values.setTable(table(), 3'600'000 * ms);
    QCOMPARE(values.store()->capacity(), 16);
    values.setTable(table(), 10 * ms, {600'000 * ms, 0});
    QCOMPARE(values.store()->capacity(), 16);
    values.setTable(table(), 0, {1000, 1 << 20});
    QCOMPARE(values.store()->capacity(), 1000);
}

void tst_PlantValues::aMuchShorterPeriodGetsALargerStore()
{
    PlantValues values;
    values.setTable(table(), 100 * ms);
    give(&values, 0, 1, wall, 100 * ms);
    QCOMPARE(values.store()->capacity(), 6000);
    give(&values, 0, 2, wall + 1000 * ms, 90 * ms);
    QCOMPARE(values.store()->capacity(), 6000);
    QCOMPARE(values.store()->endRow(), SignalStore::Row(2));
    give(&values, 0, 3, wall + 2000 * ms, 10 * ms);
    QCOMPARE(values.store()->capacity(), 60'000);
    QCOMPARE(values.store()->endRow(), SignalStore::Row(1));
}

void tst_PlantValues::aBatchHoldsTheCyclesSinceTheLastOne()
{
    PlantValues values;
    values.setTable(table(), 10 * ms);
    give(&values, 0, 1, wall);
    values.beginBatch();
    QVERIFY(values.batch({4}).isEmpty());
    give(&values, 1, 1, wall);
    give(&values, 2, 1, wall);
    const QList<QPlcSignalList> batch = values.batch({4, 0, 1000});
    QCOMPARE(batch.size(), 2);
    QCOMPARE(batch.at(0).size(), 2);
    QCOMPARE(batch.at(0).value(QPlcSignalIndex(4)).toReal(), 0.5);
    QCOMPARE(batch.at(1).value(QPlcSignalIndex(0)).toString(), QStringLiteral("t2"));
}

void tst_PlantValues::valuesAtRestReplaceTheNewest()
{
    PlantValues values;
    values.storeValue(4, QPlcValue(1.5F));  // before the table
    values.setTable(table(), 10 * ms);
    values.storeValue(4, QPlcValue(1.5F));
    values.storeValue(4, QPlcValue(2.5));  // no Real32
    values.storeValue(1000, QPlcValue(2.5F));
    QCOMPARE(values.value(4).toReal(), 1.5);
    QVERIFY(values.store()->isEmpty());
}

void tst_PlantValues::referencesAreReadAndWritten_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("plant");
    QTest::addColumn<QString>("name");
    QTest::addColumn<int>("element");
    QTest::newRow("signal") << "tetherSpeed"
                            << ""
                            << "tetherSpeed" << -1;
    QTest::newRow("element") << "v[2]"
                             << ""
                             << "v" << 2;
    QTest::newRow("plant") << "north/v.x_1"
                           << "north"
                           << "v.x_1" << -1;
    QTest::newRow("both") << "north/v[10]"
                          << "north"
                          << "v" << 10;
    QTest::newRow("address") << "127.0.0.1:50000/v"
                             << "127.0.0.1:50000"
                             << "v" << -1;
    QTest::newRow("local") << "local://tower/v[0]"
                           << "local://tower"
                           << "v" << 0;
}

void tst_PlantValues::referencesAreReadAndWritten()
{
    QFETCH(QString, text);
    QString error = QStringLiteral("old");
    const SignalReference reference = SignalReference::fromString(text, &error);
    QTEST(reference.plant, "plant");
    QTEST(reference.signal, "name");
    QTEST(reference.element, "element");
    QVERIFY(reference.isValid() && error.isEmpty());
    QCOMPARE(reference.toString(), text);
    QCOMPARE(SignalReference::fromString(QStringLiteral("  ") + text + QStringLiteral(" \n")), reference);
}

void tst_PlantValues::invalidTextIsNotAReference_data()
{
    QTest::addColumn<QString>("text");
    for (const char *text :
         {"", " ", "/", "a/", "/a", "a[", "a[]", "a[-1]", "a[x]", "a[1][2]", "[1]", "1a", "a b", "a[99999]"})
        QTest::newRow(text) << QString(text);
    QTest::newRow("too long") << QString(64, QLatin1Char('a'));
}

void tst_PlantValues::invalidTextIsNotAReference()
{
    QFETCH(QString, text);
    QString error;
    QVERIFY(!SignalReference::fromString(text, &error).isValid());
    QVERIFY2(error.contains(QStringLiteral("write signal, signal[2] or plant/signal")), qPrintable(error));
}

void tst_PlantValues::newOverrunsAreMarkedUntilTheNextStatistics()
{
    const auto statistics = [](double overruns) {
        messages::Statistics answer;
        answer.master.counters.insert("overruns", overruns);
        return answer;
    };
    PlantStatus status;
    status.handleStatistics(statistics(3));
    QVERIFY(!status.isOverrunning);  // they were before anybody looked
    status.handleStatistics(statistics(4));
    QVERIFY(status.isOverrunning);
    status.handleStatistics(statistics(4));
    QVERIFY(!status.isOverrunning);
    status.handleStatistics(statistics(0));  // a new phase
    QVERIFY(!status.isOverrunning);
}

void tst_PlantValues::aStatusKeepsTheFiguresOfItsNodes()
{
    const QJsonObject winch{{"name", "Winch"}, {"transport", "udp"}, {"policy", "SilentWait"}, {"listener", true}};
    const auto state = answerOf<messages::State>(
        {{"state", "RealTime"}, {"period", 1e7}, {"cycle", "00000000000000ff"}, {"nodes", QJsonArray{winch}}});
    const auto statistics = [](int late) {
        const QJsonObject figures{{"count", 3}, {"p50", 1000}, {"p99", 2000}, {"maximum", 3000}};
        return answerOf<messages::Statistics>(
            {{"master", QJsonObject{{"lateness", QJsonObject{{"last10s", figures}}}}},
             {"nodes",
              QJsonArray{QJsonObject{{"name", "Winch"},
                                     {"execution", QJsonObject{{"sinceStart", figures}}},
                                     {"counters", QJsonObject{{"late", late}}}},
                         QJsonObject{{"name", "Stranger"}}}}});
    };
    PlantStatus status;
    status.handleState(state);
    QVERIFY(status.isRunning());
    QCOMPARE(quint64(status.master.cycle), quint64(255));
    status.handleStatistics(statistics(3));
    QCOMPARE(status.statistics.lateness.last10s.p99, qint64(2000));
    QCOMPARE(status.nodes.size(), 1);
    QVERIFY(status.isCounted);
    QVERIFY(!status.node("Winch")->isLate);  // it was late before anybody looked
    status.handleState(state);
    QCOMPARE(status.node("Winch")->statistics.execution.sinceStart.maximum, qint64(3000));
    QCOMPARE(status.node("Winch")->statistics.late, quint64(3));
    status.handleStatistics(statistics(4));
    QVERIFY(status.node("Winch")->isLate);
    status.handleStatistics(statistics(4));
    QVERIFY(!status.node("Winch")->isLate);
    status.handleStatistics(statistics(0));  // a new phase
    QVERIFY(!status.node("Winch")->isLate);
    status.handleState(messages::State());
    QVERIFY(status.nodes.isEmpty() && !status.node("Winch"));
}

void tst_PlantValues::invalidAnswersGiveAnEmptyStatus()
{
    PlantStatus status;
    status.handleState(answerOf<messages::State>({{"state", 7}, {"nodes", "many"}, {"period", "long"}}));
    status.handleState(answerOf<messages::State>(
        {{"state", "a\x1b[31m"}, {"nodes", QJsonArray{1, "x", QJsonObject{{"name", QJsonArray()}}}}}));
    QVERIFY(status.nodes.isEmpty());
    QVERIFY(!status.isRunning());
    QCOMPARE(status.master.state, messages::MasterState::Unknown);
    status.handleState(answerOf<messages::State>({{"nodes", QJsonArray{QJsonObject{{"name", "Winch"}}}}}));
    status.handleStatistics(answerOf<messages::Statistics>(
        {{"nodes", QJsonArray{QJsonObject{{"name", "Winch"}, {"counters", QJsonObject{{"late", -1e300}}}}}},
         {"master", 1}}));
    QCOMPARE(status.node("Winch")->statistics.late, quint64(0));
    status.handleSchedule(
        answerOf<messages::Schedule>({{"stages", QJsonArray{1, QJsonArray{2}}}, {"links", QJsonArray{3}}}));
    QVERIFY(status.schedule.stages.isEmpty() && status.schedule.links.isEmpty());
}

void tst_PlantValues::displayedTextsContainNoEscapeCodes()
{
    const QString escape = QStringLiteral("a\x1b[31m");
    const QString shown = printable(escape);
    messages::State state;
    state.reason = escape;
    state.stopped = messages::StopEntry{escape, escape, 0, false};
    state.nodes.append(QPlcNodeInfo());
    state.nodes.first().name = escape;
    state.nodes.first().faultPlan = escape;
    PlantStatus status;
    status.handleState(state);
    QCOMPARE(status.master.reason, shown);
    QCOMPARE(status.master.stopped->whoever, shown);
    QCOMPARE(status.nodes.at(0).info.faultPlan, shown);
    messages::Statistics statistics;
    statistics.nodes.push_back({escape, {}, {}, {}, {{"late", 7.0}}});
    status.handleStatistics(statistics);
    QCOMPARE(status.node(shown)->statistics.late, quint64(7));
    messages::Schedule schedule;
    schedule.stages = {{{escape, QPlcSchedule::Update}}};
    status.handleSchedule(schedule);
    QCOMPARE(status.schedule.stages.at(0).at(0).node, shown);
}

QTEST_GUILESS_MAIN(tst_PlantValues)
#include "tst_PlantValues.moc"
