// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "SameCycleFixtures.h"
#include "ThreadCosts.h"

#include <QtPlcCore>

#include <cmath>
#include <limits>

// One node without a master computes what it computes in a plant, and its inputs and outputs follow
// the same rules.
class tst_QPlcNodeRunner : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void stepsFollowTheInputs();
    void signalsAreReachedByNameAndByIndex();
    void namesOfValuesAndTextsAreValues();
    void wrongValuesAreRefusedWithASentence();
    void wrongIndicesAreRefusedWithASentence_data();
    void wrongIndicesAreRefusedWithASentence();
    void functionsForSignalsSurviveAnyIndex();
    void twoPhaseOutputsAreThoseOfTheNextCycle();
    void nodesWithListsRunToo();
    void digestIsThatOfAPlant_data();
    void digestIsThatOfAPlant();
    void badInputsAreHeldAndThenSafe();
    void badOutputsAreNotGivenAway();
    void qualitiesOfInputsCount();
    void skippedCyclesAreMissed();
    void timeNeverGoesBack();
    void wantedSafeStopComesWithTheNextStep();
    void exceptionLeadsToTheSafeState_data();
    void exceptionLeadsToTheSafeState();
    void phasesBeginAnew();
    void bindNamesWhatIsWrong();
    void wrongOrderIsRefused();
    void nodeOfAMasterIsRefused();
    void cyclesAllocateNothing();
};

namespace {

QPlcSignalTable everyKind()
{
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni(R"(
[real]
type = Real64
min = -10
max = 10
safe = 0.5
initial = 1
[small]
type = UInt8
[big]
type = UInt64
[phase]
type = Int8
values = 0: Off, 1: ReelOut, 2: ReelIn
[name]
type = String(8)
[position]
type = Real32[3]
[realOut]
type = Real64
max = 100
safe = -1
hold = 2
[wideOut]
type = UInt64
[phaseOut]
type = Int8
values = 0: Off, 1: ReelOut, 2: ReelIn
[positionOut]
type = Real64[3]
[other]
type = Real64
[mine]
type = Real64
writer = Somebody
)",
                                                           &errors);
    Q_ASSERT_X(errors.isEmpty(), "everyKind", qPrintable(QPlcParseError::toString(errors)));
    return table;
}

/// Gives back what it reads, and remembers what happened to it.
class Echo : public QPlcCompactSlaveNode
{
public:
    Echo()
        : QPlcCompactSlaveNode("Echo")
    {
    }
    std::function<void(const QPlcCycle &)> onStep;
    std::function<void()> onReset;
    QStringList story;
    double seen = 0.0;
    QPlcQuality seenQuality;
    double factor = 2.0;

protected:
    void reset() override
    {
        story << "reset";
        m_realOut = 7.0;
        if (onReset)
            onReset();
    }
    void initialized() override { story << QString("initialized %1").arg(double(m_real)); }
    void step(const QPlcCycle &cycle) override
    {
        seen = m_real;
        seenQuality = m_real.quality();
        m_realOut = factor * m_real;
        m_wideOut = m_big;
        m_phaseOut = m_phase;
        m_positionOut = {m_position.value()[2], m_position.value()[1], double(m_small)};
        if (onStep)
            onStep(cycle);
    }
    void safeState(SafeStateReason reason) override
    {
        story << QString("safe ") + QMetaEnum::fromType<SafeStateReason>().valueToKey(reason);
    }
    void stopped() override { story << "stopped"; }

private:
    QPlcInput<double> m_real{this, "real"};
    QPlcInput<quint8> m_small{this, "small"};
    QPlcInput<quint64> m_big{this, "big"};
    QPlcInput<qint8> m_phase{this, "phase"};
    QPlcInput<std::array<double, 3>> m_position{this, "position"};
    QPlcOutput<double> m_realOut{this, "realOut"};
    QPlcOutput<quint64> m_wideOut{this, "wideOut"};
    QPlcOutput<qint8> m_phaseOut{this, "phaseOut"};
    QPlcOutput<std::array<double, 3>> m_positionOut{this, "positionOut"};
};

class EchoRunner : public QPlcNodeRunner
{
public:
    explicit EchoRunner(Echo &echo)
        : QPlcNodeRunner(echo)
    {
        if (!bind(everyKind()))
            qFatal("%s", qPrintable(errorString()));
    }
};

/// A signal that never repeats.
double waveform(quint64 cycle)
{
    return 3.0 * std::sin(0.37 * double(cycle) + 0.1);
}

/// Writes the setpoint of a plant, known before the cycle.
class Source : public QPlcCompactSlaveNode
{
public:
    Source()
        : QPlcCompactSlaveNode("Source")
    {
        setTwoPhase(true);
    }

private:
    QPlcOutput<double> m_setpoint{this, "setpoint"};
    quint64 m_next = 0;
    void reset() override { m_next = 0; }
    void outputs() override { m_setpoint = waveform(m_next); }
    void update(const QPlcCycle &) override { ++m_next; }
};

std::unique_ptr<QPlcSlaveNode> nodeOf(const QString &kind)
{
    if (kind == QLatin1String("ports"))
        return std::make_unique<Adder>("Adder", "setpoint", "sum", QPlcInputTiming::SameCycle);
    if (kind == QLatin1String("two phases"))
        return std::make_unique<Integrator>();
    return std::make_unique<ListIntegrator>();
}

/// A runner needs none; a master does.
struct Application
{
    int count = 1;
    char name[5] = "test";
    char *arguments[2] = {name, nullptr};
    QCoreApplication application{count, arguments};
};

quint64 digestInAPlant(QPlcSlaveNode &node, quint64 cycles)
{
    const Application application;
    TestMaster master;
    Source source;
    if (!master.addLocalNode(&source) || !master.addLocalNode(&node))
        qFatal("%s", qPrintable(master.errorString()));
    master.setCycleLimit(cycles);
    if (!master.startRealTime() || !master.waitForState(QPlcMasterNode::Off))
        qFatal("%s", qPrintable(master.errorString()));
    return master.statistics().imageDigest;
}

}  // namespace

void tst_QPlcNodeRunner::stepsFollowTheInputs()
{
    Echo echo;
    EchoRunner runner(echo);
    QVERIFY2(runner.initialize(), qPrintable(runner.errorString()));
    QCOMPARE(echo.story, (QStringList{"reset", "initialized 1"}));
    QCOMPARE(runner.value("realOut").toReal(), 7.0);
    QCOMPARE(runner.nextCycle(), quint64(0));
    QVERIFY(runner.step());
    QCOMPARE(runner.value("realOut").toReal(), 2.0);
    QVERIFY(runner.set("real", 4.5));
    QVERIFY(runner.step());
    QCOMPARE(runner.value("realOut").toReal(), 9.0);
    QCOMPARE(runner.nextCycle(), quint64(2));
    QCOMPARE(runner.time(), std::chrono::nanoseconds(20'000'000));
    runner.stop();
    QCOMPARE(echo.story.mid(2), (QStringList{"safe PhaseEnded", "stopped"}));
}

void tst_QPlcNodeRunner::signalsAreReachedByNameAndByIndex()
{
    Echo echo;
    EchoRunner runner(echo);
    QCOMPARE(runner.inputs().size(), 5);
    QCOMPARE(runner.outputs().size(), 4);
    QVERIFY(runner.initialize());
    const QPlcSignalIndex position = runner.indexOf("position");
    QVERIFY(runner.isInput(position) && !runner.isOutput(position));
    QVERIFY(runner.setReal(position, 1.5, 2));
    QVERIFY(runner.setInteger(position, -4, 1));
    QVERIFY(runner.setInteger(runner.indexOf("small"), 255));
    const quint64 all = std::numeric_limits<quint64>::max();
    QVERIFY(runner.set("big", all));
    QVERIFY(runner.step());
    const QPlcSignalIndex out = runner.indexOf("positionOut");
    QCOMPARE(runner.real(out, 0), 1.5);
    QCOMPARE(runner.real(out, 1), -4.0);
    QCOMPARE(runner.integer(out, 2), qint64(255));
    QCOMPARE(runner.value("wideOut").toUInt64(), all);
    QCOMPARE(QSplitPrimitive<quint64>::fromBytes(runner.bytes(runner.indexOf("wideOut"))), all);
    QCOMPARE(runner.value(position).toReal(1), -4.0);
}

void tst_QPlcNodeRunner::namesOfValuesAndTextsAreValues()
{
    Echo echo;
    EchoRunner runner(echo);
    QVERIFY(runner.initialize());
    QVERIFY2(runner.set("phase", "ReelIn"), qPrintable(runner.errorString()));
    QVERIFY2(runner.set("position", "1, 2, 3"), qPrintable(runner.errorString()));
    QVERIFY(runner.step());
    QCOMPARE(runner.text("phaseOut"), QString("ReelIn"));
    QCOMPARE(runner.value("phaseOut").toInt(), 2);
    QCOMPARE(runner.value("positionOut").toReal(), 3.0);
}

void tst_QPlcNodeRunner::wrongValuesAreRefusedWithASentence()
{
    Echo echo;
    EchoRunner runner(echo);
    QVERIFY(runner.set("small", 3));
    QVERIFY(!runner.set("small", 256));
    QVERIFY2(runner.errorString().contains("256") && runner.errorString().contains("UInt8"),
             qPrintable(runner.errorString()));
    QVERIFY(!runner.set("phase", "Reel"));
    QVERIFY2(runner.errorString().contains("ReelOut"), qPrintable(runner.errorString()));
    QVERIFY(!runner.set("position", std::array<double, 2>{1, 2}));
    QVERIFY(!runner.set("realOut", 1.0));
    QVERIFY2(runner.errorString().contains("output"), qPrintable(runner.errorString()));
    QVERIFY(!runner.set("rael", 1.0));
    QVERIFY2(runner.errorString().contains("did you mean 'real'"), qPrintable(runner.errorString()));
    QVERIFY(!runner.set("other", 1.0));
    QVERIFY2(runner.errorString().contains("neither reads nor writes"), qPrintable(runner.errorString()));
    QVERIFY(!runner.setInteger(runner.indexOf("small"), -1));
    QVERIFY(!runner.setReal(runner.indexOf("small"), std::nan("")));
    QVERIFY(!runner.setReal(runner.indexOf("position"), 1.0, 3));
    QVERIFY(!runner.setReal(QPlcInvalidSignalIndex, 1.0));
    QVERIFY(!runner.value("rael").isValid());
    QCOMPARE(runner.value("small").toInt(), 3);
}

void tst_QPlcNodeRunner::wrongIndicesAreRefusedWithASentence_data()
{
    QTest::addColumn<QString>("signal");
    QTest::addColumn<int>("element");
    QTest::addColumn<double>("value");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("no signal") << QString() << 0 << 1.0
                               << "there is no signal with the index 65535; get it with indexOf()";
    QTest::newRow("output") << "realOut" << 0 << 1.0 << "signal 'realOut' is an output; set inputs only";
    QTest::newRow("of others") << "other" << 0 << 1.0 << "it does not read signal 'other'; declare a port for it";
    QTest::newRow("element") << "position" << 3 << 1.0 << "signal 'position' of type Real32[3] has no number 3";
    QTest::newRow("before") << "position" << -1 << 1.0 << "signal 'position' of type Real32[3] has no number -1";
    QTest::newRow("value") << "small" << 0 << 256.0
                           << "the value 256 (Real64) does not fit signal 'small' of type UInt8";
}

void tst_QPlcNodeRunner::wrongIndicesAreRefusedWithASentence()
{
    QFETCH(QString, signal);
    QFETCH(int, element);
    QFETCH(double, value);
    QFETCH(QString, sentence);
    Echo echo;
    EchoRunner runner(echo);
    const QPlcSignalIndex index = signal.isEmpty() ? QPlcInvalidSignalIndex : runner.table().indexOf(signal);
    const auto isRefused = [&](bool isSet) { return !isSet && runner.errorString() == "node 'Echo': " + sentence; };
    QVERIFY2(isRefused(runner.setReal(index, value, element)), qPrintable(runner.errorString()));
    QVERIFY(!runner.set("rael", 1.0));
    QVERIFY(isRefused(runner.setInteger(index, qint64(value), element))
            || runner.errorString().contains("the value 256 (Int64) does not fit"));
}

void tst_QPlcNodeRunner::functionsForSignalsSurviveAnyIndex()
{
    Echo echo;
    EchoRunner runner(echo);
    const auto other = runner.table().indexOf("other");
    const double bytes = 1.0;
    QVERIFY(runner.initialize() && runner.errorString().isEmpty());
    for (const QPlcSignalIndex index : {other, QPlcSignalIndex(runner.table().size()), QPlcInvalidSignalIndex}) {
        QVERIFY(!runner.setValue(index, 1.0) && runner.errorString().contains(index == other ? "'other'" : "index"));
        QVERIFY(!runner.set("rael", 1.0));
        QVERIFY(!runner.setBytes(index, &bytes) && runner.errorString().contains(index == other ? "'other'" : "index"));
        QVERIFY(!runner.set("rael", 1.0));
        QVERIFY(!runner.setQuality(index, QPlcQuality::Safe));
        QVERIFY(runner.errorString().contains(index == other ? "'other'" : "index"));
        QVERIFY(!runner.value(index).isValid() && !runner.bytes(index));
        QCOMPARE(runner.real(index), 0.0);
        QCOMPARE(runner.integer(index, 7), qint64(0));
        QCOMPARE(runner.refusedValues(index), quint64(0));
        QVERIFY(!runner.isInput(index) && !runner.isOutput(index));
    }
    QVERIFY(!runner.setQuality(runner.indexOf("realOut"), QPlcQuality::Good));
    QVERIFY(runner.errorString().contains("is an output"));
    QVERIFY(runner.step());
}

void tst_QPlcNodeRunner::twoPhaseOutputsAreThoseOfTheNextCycle()
{
    Integrator node;
    QPlcNodeRunner runner(node);
    QVERIFY(runner.bind(testTable()));
    QVERIFY(runner.initialize());
    QCOMPARE(runner.value("sum").toReal(), 1.0);
    runner.set("setpoint", 4.0);
    QVERIFY(runner.step());
    QCOMPARE(runner.value("sum").toReal(), 5.0);
}

void tst_QPlcNodeRunner::nodesWithListsRunToo()
{
    QPlcSignalIndexTable::setCurrent(QPlcSignalTable());
    ListIntegrator node;
    QPlcNodeRunner runner(node);
    QVERIFY2(runner.bind(testTable()), qPrintable(runner.errorString()));
    QVERIFY(runner.initialize());
    runner.set("setpoint", 0.5);
    QVERIFY(runner.step() && runner.step());
    QCOMPARE(runner.value("sum").toReal(), 2.0);
}

void tst_QPlcNodeRunner::digestIsThatOfAPlant_data()
{
    QTest::addColumn<QString>("kind");
    for (const char *kind : {"ports", "two phases", "lists"})
        QTest::newRow(kind) << kind;
}

void tst_QPlcNodeRunner::digestIsThatOfAPlant()
{
    QFETCH(QString, kind);
    constexpr quint64 cycles = 1000;
    const std::unique_ptr<QPlcSlaveNode> node = nodeOf(kind);
    const quint64 expected = digestInAPlant(*node, cycles);
    const std::unique_ptr<QPlcSlaveNode> alone = nodeOf(kind);
    QPlcNodeRunner runner(*alone);
    QVERIFY(runner.bind(testTable()));
    QVERIFY(runner.reset());
    const QPlcSignalIndex setpoint = runner.indexOf("setpoint");
    runner.setReal(setpoint, waveform(0));
    QVERIFY(runner.initialize());
    for (quint64 cycle = 0; cycle < cycles; ++cycle) {
        runner.setReal(setpoint, waveform(cycle));
        QVERIFY(runner.step());
    }
    QCOMPARE(runner.digest(), expected);
    runner.step();
    QVERIFY(runner.digest() != expected);
}

void tst_QPlcNodeRunner::badInputsAreHeldAndThenSafe()
{
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 10.5, -10.5}) {
        Echo echo;
        EchoRunner runner(echo);
        runner.setProfile(QPlcProfile::Plant);  // three cycles of hold
        QVERIFY(runner.initialize());
        const QPlcSignalIndex real = runner.indexOf("real");
        runner.setReal(real, 3.0);
        QVERIFY(runner.step());
        QCOMPARE(runner.quality(real), QPlcQuality(QPlcQuality::Good));
        runner.setReal(real, bad);
        for (int cycle = 1; cycle <= 3; ++cycle) {
            QVERIFY(runner.step());
            QCOMPARE(echo.seen, 3.0);
            QCOMPARE(runner.quality(real), QPlcQuality::held(cycle));
        }
        QVERIFY(runner.step());
        QCOMPARE(echo.seen, 0.5);
        QCOMPARE(runner.quality(real), QPlcQuality(QPlcQuality::Safe));
        QCOMPARE(runner.refusedValues(real), quint64(4));
        runner.setReal(real, 4.0);
        QVERIFY(runner.step());
        QCOMPARE(echo.seen, 4.0);
        QVERIFY(runner.quality(real).isGood());
    }
}

void tst_QPlcNodeRunner::badOutputsAreNotGivenAway()
{
    Echo echo;
    EchoRunner runner(echo);
    QVERIFY(runner.initialize());
    const QPlcSignalIndex out = runner.indexOf("realOut");
    QVERIFY(runner.step());
    echo.factor = std::nan("");
    QVERIFY(runner.step() && runner.step());
    QCOMPARE(runner.real(out), 2.0);
    QCOMPARE(runner.quality(out), QPlcQuality::held(2));
    QVERIFY(runner.step());
    QCOMPARE(runner.real(out), -1.0);
    QCOMPARE(runner.refusedValues(out), quint64(3));
}

void tst_QPlcNodeRunner::qualitiesOfInputsCount()
{
    Echo echo;
    echo.setReceivesQuality(true);
    EchoRunner runner(echo);
    QVERIFY(runner.initialize());
    const QPlcSignalIndex real = runner.indexOf("real");
    runner.setReal(real, 2.0);
    QVERIFY(runner.step());
    QVERIFY(echo.seenQuality.isGood());
    runner.setReal(real, 5.0);
    QVERIFY(runner.setQuality(real, QPlcQuality::Invalid));
    QVERIFY(runner.step());
    QCOMPARE(echo.seen, 2.0);
    QCOMPARE(echo.seenQuality, QPlcQuality::held(1));
    QVERIFY(!runner.setQuality(runner.indexOf("realOut"), QPlcQuality::Good));
}

void tst_QPlcNodeRunner::skippedCyclesAreMissed()
{
    Echo echo;
    EchoRunner runner(echo);
    QVector<quint64> numbers, missed;
    echo.onStep = [&](const QPlcCycle &cycle) { numbers << cycle.number(), missed << cycle.missedCycles(); };
    QVERIFY(runner.initialize());
    QVERIFY(runner.step());
    QVERIFY(runner.skip(3));
    QVERIFY(runner.step() && runner.step());
    QCOMPARE(numbers, (QVector<quint64>{0, 4, 5}));
    QCOMPARE(missed, (QVector<quint64>{0, 3, 0}));
}

void tst_QPlcNodeRunner::timeNeverGoesBack()
{
    Echo echo;
    EchoRunner runner(echo);
    QVERIFY(!runner.skip(1));
    QVERIFY2(runner.errorString().contains("initialize()"), qPrintable(runner.errorString()));
    QVERIFY(runner.initialize() && runner.step());
    constexpr quint64 most = 100ULL * 365 * 24 * 3600 * 100;  // cycles of 10 ms
    for (const quint64 cycles : {~quint64(0), ~quint64(0) - 1, quint64(1) << 63, most}) {
        QVERIFY(!runner.skip(cycles));
        QVERIFY2(runner.errorString().contains(QString::number(cycles)), qPrintable(runner.errorString()));
        QCOMPARE(runner.nextCycle(), quint64(1));
    }
    QVERIFY(runner.skip(most - 1) && !runner.skip(1) && runner.skip(0));
    QVERIFY(runner.step() && runner.step());
    QVERIFY(!runner.skip(1));
    QCOMPARE(runner.time(),
             std::chrono::nanoseconds(std::chrono::hours(100 * 365 * 24)) + std::chrono::milliseconds(20));
}

void tst_QPlcNodeRunner::wantedSafeStopComesWithTheNextStep()
{
    Echo echo;
    EchoRunner runner(echo);
    echo.onStep = [&](const QPlcCycle &cycle) {
        if (cycle.number() == 1)
            echo.requestSafeStop();
    };
    QVERIFY(runner.initialize());
    QVERIFY(runner.step());
    QVERIFY(!runner.wantsSafeStop());
    runner.set("real", 5.0);
    QVERIFY(runner.step());
    QVERIFY(runner.wantsSafeStop() && !runner.isSafe());
    QCOMPARE(runner.value("realOut").toReal(), 10.0);
    QVERIFY(runner.step());
    QVERIFY(runner.isSafe() && !runner.hasFailed());
    QCOMPARE(runner.value("realOut").toReal(), -1.0);
    QCOMPARE(echo.story.last(), QString("safe MasterStopsSafely"));
}

void tst_QPlcNodeRunner::exceptionLeadsToTheSafeState_data()
{
    QTest::addColumn<bool>("isStandard");
    QTest::newRow("std::exception") << true;
    QTest::newRow("another one") << false;
}

void tst_QPlcNodeRunner::exceptionLeadsToTheSafeState()
{
    QFETCH(bool, isStandard);
    Echo echo;
    EchoRunner runner(echo);
    echo.onStep = [&](const QPlcCycle &cycle) {
        if (cycle.number() < 2)
            return;
        if (isStandard)
            throw std::runtime_error("the tether is torn");
        throw 1;
    };
    QVERIFY(runner.initialize());
    QVERIFY(runner.step() && runner.step());
    QVERIFY(!runner.step());
    QVERIFY(runner.hasFailed() && runner.isSafe());
    const QString expected = isStandard ? "the tether is torn" : "not derived from std::exception";
    QVERIFY2(runner.errorString().contains(expected) && runner.errorString().contains("cycle 2"),
             qPrintable(runner.errorString()));
    QCOMPARE(runner.value("realOut").toReal(), -1.0);
    QCOMPARE(runner.quality(runner.indexOf("realOut")), QPlcQuality(QPlcQuality::Safe));
    QCOMPARE(echo.story.last(), QString("safe CodeFailed"));
    QVERIFY(!runner.step());
    echo.onStep = nullptr;
    QVERIFY2(runner.initialize(), qPrintable(runner.errorString()));
    QVERIFY(runner.step());
    echo.onReset = [] { throw std::runtime_error("no bus"); };
    QVERIFY(!runner.initialize());
    QVERIFY2(runner.errorString().contains("no bus"), qPrintable(runner.errorString()));
    QVERIFY(!runner.isRunning());
}

void tst_QPlcNodeRunner::phasesBeginAnew()
{
    Echo echo;
    EchoRunner runner(echo);
    quint64 digests[2];
    for (quint64 &digest : digests) {
        QVERIFY(runner.reset());
        QVERIFY(runner.set("real", 3.0));
        QVERIFY(runner.initialize());
        QCOMPARE(echo.story.last(), QString("initialized 3"));
        QVERIFY(runner.step());
        digest = runner.digest();
        runner.makeSafe();
        QCOMPARE(runner.value("realOut").toReal(), -1.0);
    }
    QCOMPARE(digests[0], digests[1]);
    QVERIFY(runner.reset());
    QCOMPARE(runner.value("real").toReal(), 1.0);
}

void tst_QPlcNodeRunner::bindNamesWhatIsWrong()
{
    Echo echo;
    QPlcNodeRunner runner(echo);
    QVERIFY(!runner.bind(QPlcSignalTable::fromIni("[real]\ntype = String\n[smal]\ntype = UInt8\n")));
    QVERIFY2(runner.errorString().contains("'real' is String") && runner.errorString().contains("mean 'smal'"),
             qPrintable(runner.errorString()));
    QVERIFY(!runner.isBound() && !runner.initialize());
    Adder thief("Thief", "real", "mine", QPlcInputTiming::LastCycle);
    QPlcNodeRunner another(thief);
    QVERIFY(!another.bind(everyKind()));
    QVERIFY2(another.errorString().contains("Somebody"), qPrintable(another.errorString()));
    Echo worse;
    worse.onReset = [] {};
    worse.factor = 1.0;
    EchoRunner third(worse);
    const QPlcSignalTable strict = QPlcSignalTable::fromIni(everyKind().toIni().replace("max = 100", "max = 5"));
    QVERIFY(third.bind(strict));
    QVERIFY(!third.initialize());
    QVERIFY2(third.errorString().contains("'realOut'") && third.errorString().contains("7"),
             qPrintable(third.errorString()));
}

void tst_QPlcNodeRunner::wrongOrderIsRefused()
{
    Echo echo;
    QPlcNodeRunner runner(echo, std::chrono::milliseconds(5));
    QCOMPARE(runner.period(), std::chrono::nanoseconds(5'000'000));
    QVERIFY(!runner.reset() && !runner.initialize() && !runner.step());
    QVERIFY(!runner.setPeriod(std::chrono::nanoseconds(1)));
    QVERIFY2(runner.errorString().contains("10 us"), qPrintable(runner.errorString()));
    QVERIFY(runner.bind(everyKind()));
    QVERIFY(!runner.step());
    QVERIFY2(runner.errorString().contains("initialize()"), qPrintable(runner.errorString()));
    runner.makeSafe();
    runner.skip(2);
    runner.stop();
    QVERIFY(echo.story.isEmpty());
    QVERIFY(runner.initialize());
    QVERIFY(!runner.setPeriod(std::chrono::milliseconds(1)));
    QCOMPARE(runner.nextCycle(), quint64(0));
}

void tst_QPlcNodeRunner::nodeOfAMasterIsRefused()
{
    const Application application;
    TestMaster master;
    Integrator node;
    QVERIFY(master.addLocalNode(&node));
    QPlcNodeRunner runner(node);
    QVERIFY(!runner.bind(testTable()));
    QVERIFY2(runner.errorString().contains("master"), qPrintable(runner.errorString()));
    master.removeLocalNode(&node);
    QVERIFY2(runner.bind(testTable()), qPrintable(runner.errorString()));
}

void tst_QPlcNodeRunner::cyclesAllocateNothing()
{
    if (!ThreadCosts::areCounted())
        QSKIP("the sanitizer owns malloc", "");
    Echo echo;
    EchoRunner runner(echo);
    QVERIFY(runner.initialize());
    const QPlcSignalIndex real = runner.indexOf("real");
    const QPlcSignalIndex small = runner.indexOf("small");
    const QPlcSignalIndex out = runner.indexOf("realOut");
    double sum = 0.0;
    const auto run = [&] {
        for (int cycle = 0; cycle < 1000; ++cycle) {
            runner.setReal(real, cycle % 20 == 19 ? std::nan("") : 0.001 * cycle);
            runner.setInteger(small, cycle % 256);
            runner.step();
            sum += runner.real(out) + double(runner.integer(out));
        }
    };
    run();
    const ThreadCosts before = ThreadCosts::ofThisThread();
    run();
    const ThreadCosts spent = ThreadCosts::ofThisThread() - before;
    QCOMPARE(spent.allocations, std::uint64_t(0));
    QCOMPARE(spent.locks, std::uint64_t(0));
    QVERIFY(sum > 0.0);
}

QTEST_APPLESS_MAIN(tst_QPlcNodeRunner)
#include "tst_QPlcNodeRunner.moc"
