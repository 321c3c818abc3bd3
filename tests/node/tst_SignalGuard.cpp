// SPDX-License-Identifier: Apache-2.0
#include "node/cycle/SignalGuard.h"

#include <QtTest/QtTest>

#include <random>

using namespace qplc;

namespace {

/// Two nodes: A writes speed, force and vector, B writes mode. `free` is written by nobody.
QPlcSignalTable plantTable()
{
    return QPlcSignalTable::fromIni("[speed]\ntype = Real64\nmin = -10\nmax = 10\nsafe = 1\ninitial = 2\n"
                                    "[force]\ntype = Real64\nhold = 0\n"
                                    "[vector]\ntype = RealTriple\nhold = 1\nmax = 100\nsafe = 7\n"
                                    "[mode]\ntype = UInt8\nmin = 3\nmax = 9\ninitial = 5\nhold = 300\n"
                                    "[free]\ntype = Int\ninitial = 4\n");
}

enum Signal : QPlcSignalIndex { Speed, Force, Vector, Mode, Free };

struct Plant : SignalGuard::Observer
{
    explicit Plant(const QPlcSignalTable &table = plantTable())
        : image(table)
        , guard(image, this)
        , layoutA(table, {Force, Speed, Vector})
        , layoutB(table, {Mode})
        , frameA(SignalGuard::frameFor(image, layoutA))
        , frameB(SignalGuard::frameFor(image, layoutB))
    {
        a.id = 1;
        b.id = 2;
    }

    void valueRefused(std::uint16_t writer, SignalGuard::Place place, const ValueFault &fault,
                      bool isFirst) noexcept override
    {
        if (isFirst)
            told << QStringLiteral("%1 of %2: %3")
                        .arg(nameOf(place))
                        .arg(writer)
                        .arg(faultText(image.table().at(QPlcSignalIndex(place)), fault));
        ++refusals;
    }
    void signalBecameSafe(SignalGuard::Place place) noexcept override { told << nameOf(place) + " is safe"; }
    void sourceChanged(SignalGuard::Place, std::uint16_t, std::uint16_t) noexcept override {}
    QString nameOf(SignalGuard::Place place) const { return image.table().at(QPlcSignalIndex(place)).name; }

    void answerA(std::int64_t cycle, std::int64_t now, double speed, double force = 0.5, float element = 1.0F)
    {
        QByteArray payload
            = QPlcValue(force).toBytes() + QPlcValue(speed).toBytes() + QPlcValue({0.0F, element, 0.0F}).toBytes();
        guard.store(frameA, a, payload.constData(), cycle, now);
    }
    void answerB(std::int64_t cycle, std::int64_t now, quint8 mode)
    {
        guard.store(frameB, b, reinterpret_cast<const char *>(&mode), cycle, now);
    }
    /// The end of a cycle as the master makes it.
    void end(std::int64_t now)
    {
        guard.miss(frameA, a, now);
        guard.miss(frameB, b, now);
        guard.settle(now);
    }
    /// "2 good": value and quality.
    QString state(QPlcSignalIndex signal) const
    {
        return image.value(signal).toString() + ' ' + image.quality(signal).toString();
    }

    ProcessImage image;
    SignalGuard guard;
    PayloadLayout layoutA;
    PayloadLayout layoutB;
    SignalGuard::Frame frameA;
    SignalGuard::Frame frameB;
    SignalGuard::Writer a;
    SignalGuard::Writer b;
    QStringList told;
    int refusals = 0;
};

}  // namespace

class tst_SignalGuard : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initialValuesAreInvalidUntilTheFirstOne();
    void valueAnsweredInItsCycleIsGood();
    void missingValueIsHeldAndThenSafe();
    void valueIsHeldForExactlyItsHoldTime_data();
    void valueIsHeldForExactlyItsHoldTime();
    void ageIsLimitedToOneByte();
    void nextAnswerRestoresTheValue();
    void lateAnswerIsHeldWithItsAge();
    void answerOlderThanTheHoldTimeIsIgnored();
    void badValuesAreCountedAndNeverAccepted();
    void aBadValueHoldsItsOwnSignalOnly();
    void consecutiveBadValuesAreReportedOnce();
    void safeSignalIsReportedOnceUntilItRecovers();
    void badFirstValueKeepsTheInitialValue();
    void leasedSignalIsNotChanged();
    void releasedSignalIsAgedAgain();
    void signalsOfALostWriterAreHeldAndThenSafe();
    void unwrittenSignalsAreSafeAfterAPhase();
    void cyclesThatWereSkippedCount();
    void lastGoodInputsStayUntilTheNextFrame();
    void randomHistoriesFollowTheQualityRule();
};

void tst_SignalGuard::initialValuesAreInvalidUntilTheFirstOne()
{
    Plant plant;
    for (int cycle = 0; cycle < 10; ++cycle)
        plant.end(cycle);
    QCOMPARE(plant.state(Speed), QString("2 invalid"));
    QCOMPARE(plant.state(Mode), QString("5 invalid"));
    QCOMPARE(plant.state(Free), QString("4 invalid"));
    QVERIFY(plant.told.isEmpty());
}

void tst_SignalGuard::valueAnsweredInItsCycleIsGood()
{
    Plant plant;
    for (int cycle = 0; cycle < 5; ++cycle) {
        plant.answerA(cycle, cycle, cycle);
        plant.answerB(cycle, cycle, quint8(cycle + 3));
        plant.end(cycle);
        QCOMPARE(plant.state(Speed), QString("%1 good").arg(cycle));
        QCOMPARE(plant.state(Force), QString("0.5 good"));
        QCOMPARE(plant.state(Vector), QString("0, 1, 0 good"));
        QCOMPARE(plant.state(Mode), QString("%1 good").arg(cycle + 3));
    }
    QCOMPARE(plant.state(Free), QString("4 invalid"));
    QVERIFY(plant.a.isWhole && plant.b.isWhole);
    QVERIFY(plant.told.isEmpty());
}

void tst_SignalGuard::missingValueIsHeldAndThenSafe()
{
    Plant plant;
    plant.answerA(7, 7, -3.0);
    plant.end(7);
    for (int age = 1; age <= 6; ++age) {
        plant.answerB(7 + age, 7 + age, 4);
        plant.end(7 + age);
        QCOMPARE(plant.state(Speed), age <= 3 ? QString("-3 held %1").arg(age) : QString("1 safe"));
        QCOMPARE(plant.state(Force), QString("0 safe"));
        QCOMPARE(plant.state(Vector), age <= 1 ? QString("0, 1, 0 held 1") : QString("7, 7, 7 safe"));
        QCOMPARE(plant.state(Mode), QString("4 good"));
    }
    QCOMPARE(plant.told, (QStringList{"force is safe", "vector is safe", "speed is safe"}));
}

void tst_SignalGuard::valueIsHeldForExactlyItsHoldTime_data()
{
    QTest::addColumn<int>("hold");
    for (const int hold : {0, 1, 2, 3, 10, 251, 252, 253, 1000})
        QTest::newRow(qPrintable(QString::number(hold))) << hold;
}

void tst_SignalGuard::valueIsHeldForExactlyItsHoldTime()
{
    QFETCH(int, hold);
    Plant plant(QPlcSignalTable::fromIni(plantTable().toIni().replace(
        "[force]\ntype = Real64\nhold = 0", "[force]\ntype = Real64\nhold = " + QByteArray::number(hold))));
    plant.answerA(0, 0, 1.0, 42.0);
    plant.end(0);
    for (int age = 1; age <= hold; ++age) {
        plant.end(age);
        QCOMPARE(plant.state(Force), QString("42 held %1").arg(std::min(age, 252)));
    }
    plant.end(hold + 1);
    QCOMPARE(plant.state(Force), QString("0 safe"));
}

void tst_SignalGuard::ageIsLimitedToOneByte()
{
    Plant plant;
    plant.answerB(0, 0, 9);
    for (int cycle = 0; cycle <= 300; ++cycle)
        plant.end(cycle);
    QCOMPARE(plant.state(Mode), QString("9 held 252"));
    plant.end(301);
    QCOMPARE(plant.state(Mode), QString("3 safe"));
}

void tst_SignalGuard::nextAnswerRestoresTheValue()
{
    Plant plant;
    plant.answerA(0, 0, 2.0);
    for (const int missing : {1, 3, 4, 20}) {
        const int next = missing + 1;
        for (int cycle = 1; cycle <= missing; ++cycle)
            plant.end(cycle);
        plant.answerA(next, next, 8.0);
        plant.end(next);
        QCOMPARE(plant.state(Speed), QString("8 good"));
        QVERIFY(plant.a.isWhole);
        plant.answerA(0, 0, 2.0);
    }
}

void tst_SignalGuard::lateAnswerIsHeldWithItsAge()
{
    Plant plant;
    plant.answerA(0, 0, 0.0);
    plant.end(0);
    for (int now = 2; now < 20; ++now) {
        plant.answerA(now - 1, now, double(now) / 2);
        plant.end(now);
        QCOMPARE(plant.state(Speed), QString("%1 held 1").arg(double(now) / 2));
        QCOMPARE(plant.state(Force), QString("0 safe"));  // hold = 0: nothing that is late will do
    }
    plant.answerA(19, 20, 3.0);
    plant.answerA(20, 20, 4.0);
    plant.end(20);
    QCOMPARE(plant.state(Speed), QString("4 good"));
    QCOMPARE(plant.state(Force), QString("0.5 good"));
}

void tst_SignalGuard::answerOlderThanTheHoldTimeIsIgnored()
{
    Plant plant;
    plant.answerA(0, 0, 0.0);
    plant.end(0);
    plant.answerA(1, 5, 9.0);
    plant.end(5);
    QCOMPARE(plant.state(Speed), QString("1 safe"));
    plant.answerA(2, 5, 9.0);
    plant.end(5);
    QCOMPARE(plant.state(Speed), QString("9 held 3"));
    plant.end(6);
    QCOMPARE(plant.state(Speed), QString("1 safe"));
}

void tst_SignalGuard::badValuesAreCountedAndNeverAccepted()
{
    Plant plant;
    plant.answerA(0, 0, 5.0);
    plant.end(0);
    int cycle = 0;
    for (const double bad : {qQNaN(), qInf(), -qInf(), 10.5, -11.0}) {
        ++cycle;
        plant.answerA(cycle, cycle, bad);
        plant.end(cycle);
        QCOMPARE(plant.state(Speed), cycle <= 3 ? QString("5 held %1").arg(cycle) : QString("1 safe"));
    }
    QCOMPARE(plant.guard.nonFinite(Speed), std::uint64_t(3));
    QCOMPARE(plant.guard.outOfRange(Speed), std::uint64_t(2));
    QCOMPARE(plant.guard.nonFinite(Force) + plant.guard.outOfRange(Force), std::uint64_t(0));
    QCOMPARE(plant.refusals, 5);
    plant.guard.clearCounters();
    QCOMPARE(plant.guard.nonFinite(Speed) + plant.guard.outOfRange(Speed), std::uint64_t(0));
}

void tst_SignalGuard::aBadValueHoldsItsOwnSignalOnly()
{
    Plant plant;
    plant.answerA(0, 0, 5.0, 1.0);
    plant.end(0);
    plant.answerA(1, 1, 6.0, 2.0, 101.0F);
    plant.end(1);
    QCOMPARE(plant.state(Speed), QString("6 good"));
    QCOMPARE(plant.state(Force), QString("2 good"));
    QCOMPARE(plant.state(Vector), QString("0, 1, 0 held 1"));
    plant.answerA(2, 2, qQNaN(), 3.0, 2.0F);
    plant.end(2);
    QCOMPARE(plant.state(Speed), QString("6 held 1"));
    QCOMPARE(plant.state(Force), QString("3 good"));
    QCOMPARE(plant.state(Vector), QString("0, 2, 0 good"));
}

void tst_SignalGuard::consecutiveBadValuesAreReportedOnce()
{
    Plant plant;
    for (int cycle = 0; cycle < 3; ++cycle)
        plant.answerA(cycle, cycle, 12.0);
    plant.answerA(3, 3, 10.0);
    plant.answerA(4, 4, -12.5);
    plant.answerA(5, 5, qQNaN());
    QCOMPARE(plant.told,
             (QStringList{"speed of 1: 12 is above its maximum 10", "speed of 1: -12.5 is below its minimum -10"}));
    QCOMPARE(plant.refusals, 5);
}

void tst_SignalGuard::safeSignalIsReportedOnceUntilItRecovers()
{
    Plant plant;
    for (int time = 0; time < 2; ++time) {
        plant.answerA(time * 10, time * 10, 1.0);
        plant.end(time * 10);
        for (int cycle = time * 10 + 1; cycle < time * 10 + 8; ++cycle) {
            plant.guard.miss(plant.frameA, plant.a, cycle);  // the end of a stage: others read it in this cycle
            plant.end(cycle);
        }
    }
    QCOMPARE(plant.told.count("speed is safe"), 2);
    QCOMPARE(plant.told.size(), 6);
}

void tst_SignalGuard::badFirstValueKeepsTheInitialValue()
{
    Plant plant;
    for (int cycle = 0; cycle < 8; ++cycle) {
        plant.answerA(cycle, cycle, 99.0);
        plant.end(cycle);
        QCOMPARE(plant.state(Speed), QString("2 invalid"));
        QCOMPARE(plant.state(Force), QString("0.5 good"));
    }
}

void tst_SignalGuard::leasedSignalIsNotChanged()
{
    Plant plant;
    plant.answerA(0, 0, 5.0);
    plant.end(0);
    plant.end(1);
    QCOMPARE(plant.state(Speed), QString("5 held 1"));
    const SignalGuard::Frame held = SignalGuard::frameFor(plant.image, plant.layoutA, {true});
    plant.frameA = held;
    plant.guard.resume(held, plant.a, 1);
    plant.guard.keep(Speed);
    QCOMPARE(plant.state(Speed), QString("5 good"));
    for (int cycle = 2; cycle < 10; ++cycle) {
        if (cycle > 5)
            plant.answerA(cycle, cycle, cycle == 6 ? qQNaN() : -1.0);
        plant.end(cycle);
        QCOMPARE(plant.state(Speed), QString("5 good"));
    }
    QCOMPARE(plant.refusals, 0);
    plant.guard.set(Speed, QPlcQuality::Safe);
    plant.end(10);
    QCOMPARE(plant.image.quality(Speed), QPlcQuality(QPlcQuality::Safe));
}

void tst_SignalGuard::releasedSignalIsAgedAgain()
{
    Plant plant;
    const SignalGuard::Frame free = plant.frameA;
    plant.frameA = SignalGuard::frameFor(plant.image, plant.layoutA, {true});
    plant.guard.set(Speed, QPlcQuality::Good);
    plant.answerA(0, 0, 5.0);
    plant.end(0);
    plant.frameA = free;
    plant.guard.resume(free, plant.a, 0);
    plant.end(1);
    QCOMPARE(plant.state(Speed), QString("2 held 1"));
    plant.end(2);
    plant.end(3);
    plant.end(4);
    QCOMPARE(plant.state(Speed), QString("1 safe"));
    plant.answerA(5, 5, 5.0);
    plant.end(5);
    QCOMPARE(plant.state(Speed), QString("5 good"));
}

void tst_SignalGuard::signalsOfALostWriterAreHeldAndThenSafe()
{
    Plant plant;
    plant.answerA(4, 4, 5.0);
    plant.end(4);
    plant.guard.leave(plant.frameA, plant.a);
    for (int cycle = 5; cycle < 10; ++cycle) {
        plant.guard.ageAbandoned(cycle);  // who reads it in this cycle need not wait for anybody
        QCOMPARE(plant.state(Speed), cycle <= 7 ? QString("5 held %1").arg(cycle - 4) : QString("1 safe"));
        plant.guard.settle(cycle);
        QCOMPARE(plant.state(Speed), cycle <= 7 ? QString("5 held %1").arg(cycle - 4) : QString("1 safe"));
    }
    SignalGuard::Writer successor;
    std::swap(plant.a, successor);
    plant.answerA(10, 10, 6.0);
    plant.end(10);
    QCOMPARE(plant.state(Speed), QString("6 good"));
}

void tst_SignalGuard::unwrittenSignalsAreSafeAfterAPhase()
{
    Plant plant;
    plant.answerA(500, 500, 5.0);
    plant.answerB(498, 500, 9);
    plant.end(500);
    plant.guard.leave(plant.frameA, plant.a);
    plant.guard.set(Free, QPlcQuality::Good);
    plant.guard.forget();
    plant.guard.settle(-1);
    QCOMPARE(plant.state(Free), QString("4 good"));
    QCOMPARE(plant.state(Speed), QString("1 safe"));
    QCOMPARE(plant.state(Mode), QString("3 safe"));
    plant.answerA(-1, -1, 4.0);  // initial outputs
    plant.guard.settle(-1);
    QCOMPARE(plant.state(Speed), QString("4 good"));
    plant.end(0);
    QCOMPARE(plant.state(Speed), QString("4 held 1"));
}

void tst_SignalGuard::cyclesThatWereSkippedCount()
{
    Plant plant;
    plant.answerA(0, 0, 5.0);
    plant.end(0);
    plant.answerA(10, 10, 6.0);
    plant.end(10);
    QCOMPARE(plant.state(Speed), QString("6 good"));
    plant.end(12);
    QCOMPARE(plant.state(Speed), QString("6 held 2"));
    plant.end(14);
    QCOMPARE(plant.state(Speed), QString("1 safe"));
}

/// As a node has it: places are the fields of its inputs.
void tst_SignalGuard::lastGoodInputsStayUntilTheNextFrame()
{
    const QPlcSignalTable table = QPlcSignalTable::fromIni(
        "[x]\ntype = Real64\ninitial = nan\n[y]\ntype = Int16\nmax = 50\nsafe = -1\nhold = 1\n");
    const PayloadLayout layout(table, {1, 0});
    QByteArray values(int(layout.size()), '\1');
    QByteArray qualities(2, '\0');
    SignalGuard guard(table, layout, values.data(), qualities.data(), nullptr);
    const SignalGuard::Frame frame = SignalGuard::frameFor(table, layout);
    SignalGuard::Writer master;
    const auto state = [&] {
        return QPlcValue::fromBytes(table.at(1).type, values.constData()).toString() + ' '
            + QPlcQuality::fromByte(quint8(qualities[0])).toString() + ", "
            + QPlcValue::fromBytes(table.at(0).type, values.constData() + 2).toString() + ' '
            + QPlcQuality::fromByte(quint8(qualities[1])).toString();
    };
    const auto give = [&](std::int64_t cycle, qint16 y, double x) {
        const QByteArray payload = QPlcValue(y).toBytes() + QPlcValue(x).toBytes();
        guard.store(frame, master, payload.constData(), cycle, cycle);
        guard.settle(cycle);
    };
    QCOMPARE(state(), QString("0 invalid, 0 invalid"));  // NaN is no value for a node
    give(0, 50, 1.5);
    QCOMPARE(state(), QString("50 good, 1.5 good"));
    give(1, 51, qQNaN());
    QCOMPARE(state(), QString("50 held 1, 1.5 held 1"));
    give(2, 60, 2.5);
    QCOMPARE(state(), QString("-1 safe, 2.5 good"));
    give(3, 7, 3.5);
    QCOMPARE(state(), QString("7 good, 3.5 good"));
    QVERIFY(master.isWhole);
}

/// Any history of answers that are good, bad, late or missing against the rule in one line: the
/// quality of a signal is the age of its newest good value.
void tst_SignalGuard::randomHistoriesFollowTheQualityRule()
{
    std::mt19937 random(20261122);
    const auto chance = [&random](unsigned percent) { return random() % 100 < percent; };
    for (int history = 0; history < 300; ++history) {
        Plant plant;
        std::int64_t good = -1000;  // cycle of the newest good speed
        double newest = 2.0;
        bool any = false;
        bool safe = false;
        for (int now = 0; now < 60; ++now) {
            const int late = chance(20) ? int(random() % 6) : 0;
            const double value = chance(15) ? qQNaN() : chance(15) ? 11.0 : double(random() % 20) - 10.0;
            if (chance(70)) {
                plant.answerA(now - late, now, value);
                if (value <= 10.0 && late <= 3) {
                    good = now - late;
                    newest = value;
                    any = true;
                    safe = false;
                }
            }
            plant.end(now);
            safe = safe || (any && now - good > 3);
            const QPlcQuality quality = !any ? QPlcQuality()
                : safe                       ? QPlcQuality(QPlcQuality::Safe)
                                             : QPlcQuality::held(now - good);
            QCOMPARE(plant.image.quality(Speed).toString(), quality.toString());
            QCOMPARE(plant.image.value(Speed).toReal(), safe ? 1.0 : newest);
        }
    }
}

QTEST_APPLESS_MAIN(tst_SignalGuard)
#include "tst_SignalGuard.moc"
