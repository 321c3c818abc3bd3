// SPDX-License-Identifier: Apache-2.0
#include "GainTuning.h"

#include "Near.h"

#include <QtCore/QProcess>

#include <limits>

using namespace awe;

class tst_GainTuning : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void everyRangeHoldsValidGains();
    void gainsAreReadAndWritten();
    void steeredStartInvertsTheLawOfThePlant();
    void tuningKeepsTheOtherGains();
    void scoreSummarizesTheSimulatedFlights();
    void deadTimeAndSeedsMatter();
    void unsafeGainsAreWorthNothing();
    void tunedGainsAreWorthMoreThanTheStart_data();
    void tunedGainsAreWorthMoreThanTheStart();
    void badOptionsAreRefused_data();
    void badOptionsAreRefused();
    void helpDescribesTheOptions();
};

void tst_GainTuning::everyRangeHoldsValidGains()
{
    for (const TunableGain &tunable : TunableGain::all()) {
        const double tuned = AutopilotGains::tuned().*tunable.gain;
        QVERIFY2(tuned >= tunable.range.smallest && tuned <= tunable.range.largest && tunable.range.step > 0.0,
                 tunable.name);
        for (double border : {tunable.range.smallest, tunable.range.largest}) {
            AutopilotGains gains = AutopilotGains::tuned();
            gains.*tunable.gain = border;
            QCOMPARE(gains.validate(), std::string());
        }
    }
}

void tst_GainTuning::gainsAreReadAndWritten()
{
    CoordinateSearch::Point point = TunableGain::read(AutopilotGains::tuned());
    QCOMPARE(point.size(), TunableGain::all().size());
    for (std::size_t i = 0; i < point.size(); ++i)
        point[i] += 0.5 + double(i);
    const AutopilotGains written = TunableGain::write(AutopilotGains::tuned(), point);
    QCOMPARE(TunableGain::read(written), point);
    QCOMPARE(written.yawGain, AutopilotGains::tuned().yawGain + 0.5);
}

void tst_GainTuning::steeredStartInvertsTheLawOfThePlant()
{
    SteeringParameters steering;
    QCOMPARE(startOfTuning(steering).turnRateFactor, 0.0);
    steering.kind = SteeringKind::TurnRate;
    steering.turnRateFactor = 0.2;
    steering.weightFactor = 0.05;
    const AutopilotGains start = startOfTuning(steering);
    QCOMPARE(start.turnRateFactor, 0.2);
    QCOMPARE(start.weightFactor, 0.05);
    QCOMPARE(start.eightHalfWidth, AutopilotGains::steered().eightHalfWidth);
}

void tst_GainTuning::tuningKeepsTheOtherGains()
{
    const AutopilotGains written
        = TunableGain::write(AutopilotGains::tuned(), TunableGain::read(AutopilotGains::safe()));
    QCOMPARE(written.lowestHeight, AutopilotGains::tuned().lowestHeight);
    QCOMPARE(written.guardFactor, AutopilotGains::tuned().guardFactor);
    QCOMPARE(written.forceFilterTime, AutopilotGains::tuned().forceFilterTime);
}

void tst_GainTuning::scoreSummarizesTheSimulatedFlights()
{
    constexpr double duration = 200.0;
    ClosedLoopParameters parameters;
    parameters.gains = AutopilotGains::tuned();
    parameters.deadTime = 0;
    ClosedLoopFlight calm(parameters);
    calm.fly(duration);
    double turbulentEta = 0.0;
    parameters.wind.turbulenceIntensity = 0.15;
    for (int seed = 1; seed <= 8; ++seed) {
        parameters.wind.seed = std::uint64_t(seed);
        ClosedLoopFlight flight(parameters);
        flight.fly(duration);
        turbulentEta += flight.report().etaPerMeanCubedWind / 8.0;
    }
    const GainScore score = scoreOf(AutopilotGains::tuned(), 0, TuningSeeds::Tuned, duration);
    QCOMPARE(score.calmEta, calm.report().eta);
    QCOMPARE(score.calmAltitude, calm.report().minimumAltitude);
    QCOMPARE(score.turbulentEta, turbulentEta);
    QVERIFY(score.isSafe());
    QCOMPARE(score.value(), (score.calmEta + score.turbulentEta + score.strongEta) / 3.0);
}

void tst_GainTuning::deadTimeAndSeedsMatter()
{
    const AutopilotGains gains = AutopilotGains::tuned();
    const GainScore score = scoreOf(gains, 0, TuningSeeds::Tuned, 200.0);
    QVERIFY(scoreOf(gains, 2, TuningSeeds::Tuned, 200.0).calmEta != score.calmEta);
    const GainScore fresh = scoreOf(gains, 0, TuningSeeds::Fresh, 200.0);
    QCOMPARE(fresh.calmEta, score.calmEta);
    QVERIFY(fresh.turbulentEta != score.turbulentEta);
}

void tst_GainTuning::unsafeGainsAreWorthNothing()
{
    const double nothing = -std::numeric_limits<double>::infinity();
    GainScore good;
    good.calmAltitude = good.turbulentAltitude = GainScore::lowestAltitude;
    good.limitedForce = GainScore::forceLimit;
    good.calmEta = 0.75;
    QCOMPARE(good.value(), 0.25);
    GainScore crashed = good, low = good, gusty = good, strong = good;
    crashed.crashed = true;
    low.calmAltitude = 14.9;
    gusty.turbulentAltitude = 14.9;
    strong.limitedForce = 4000.1;
    for (const GainScore &bad : {crashed, low, gusty, strong})
        QCOMPARE(bad.value(), nothing);
    AutopilotGains daring = AutopilotGains::tuned();
    daring.lowestHeight = daring.lowestElevation = 0.0;
    QCOMPARE(scoreOf(daring, 0, TuningSeeds::Tuned, 200.0).value(), nothing);
}

void tst_GainTuning::tunedGainsAreWorthMoreThanTheStart_data()
{
    QTest::addColumn<int>("deadTime");
    QTest::newRow("same cycle") << 0;
    QTest::newRow("default links") << 2;
}

void tst_GainTuning::tunedGainsAreWorthMoreThanTheStart()
{
    QFETCH(int, deadTime);
    for (TuningSeeds seeds : {TuningSeeds::Tuned, TuningSeeds::Fresh}) {
        const GainScore start = scoreOf(startOfTuning(), deadTime, seeds);
        const GainScore tuned = scoreOf(AutopilotGains::tuned(), deadTime, seeds);
        QVERIFY(tuned.isSafe());
        QVERIFY2(tuned.calmEta > start.calmEta + 0.005, qPrintable(QString::number(tuned.calmEta)));
        QVERIFY2(tuned.strongEta > start.strongEta, qPrintable(QString::number(tuned.strongEta)));
        QVERIFY2(tuned.turbulentEta > start.turbulentEta + 0.005, qPrintable(QString::number(tuned.turbulentEta)));
    }
}

void tst_GainTuning::badOptionsAreRefused_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("message");
    const auto row = [](const char *arguments, const char *message) {
        QTest::newRow(arguments) << QString::fromLatin1(arguments).split(QLatin1Char(' '))
                                 << QStringLiteral("awe_tune_gains: %1\n").arg(QLatin1String(message));
    };
    row("--fly", "unknown option '--fly'; see --help");
    row("5", "unknown option '5'; see --help");
    row("--dead-time", "--dead-time without a value: use a whole number of 0 ... 63");
    row("--dead-time -1", "--dead-time -1: use a whole number of 0 ... 63");
    row("--dead-time 64", "--dead-time 64: use a whole number of 0 ... 63");
    row("--dead-time 0.5", "--dead-time 0.5: use a whole number of 0 ... 63");
    row("--dead-time nan", "--dead-time nan: use a whole number of 0 ... 63");
    row("--plant", "--plant without a value: use a name or a file");
    row("--plant nowhere",
        "cannot read the plant nowhere: No such file or directory; choose another file, or one of drag, mast, "
        "realistic, thesis");
    row("--plant drag",
        "--plant drag: the search flies pumping cycles, without hardware and without a mast; use another plant");
    row("--plant mast",
        "--plant mast: the search flies pumping cycles, without hardware and without a mast; use another plant");
    row("--seconds 3601", "--seconds 3601: use a whole number of 0 ... 3600");
    row("--halvings two", "--halvings two: use a whole number of 0 ... 10");
    row("--dead-time 1 --halvings 2x", "--halvings 2x: use a whole number of 0 ... 10");
    row("--least-gain 1.5", "--least-gain 1.5: use a number of 0 ... 1");
}

void tst_GainTuning::badOptionsAreRefused()
{
    QFETCH(QStringList, arguments);
    QFETCH(QString, message);
    QProcess program;
    program.start(QStringLiteral(AWE_TUNE_GAINS), arguments);
    QVERIFY(program.waitForFinished());
    QCOMPARE(program.exitCode(), 2);
    QCOMPARE(QString::fromUtf8(program.readAllStandardError()), message);
    QCOMPARE(program.readAllStandardOutput(), QByteArray());
}

void tst_GainTuning::helpDescribesTheOptions()
{
    QProcess program;
    program.start(QStringLiteral(AWE_TUNE_GAINS), {QStringLiteral("--help")});
    QVERIFY(program.waitForFinished());
    QCOMPARE(program.exitCode(), 0);
    const QByteArray help = program.readAllStandardOutput();
    QVERIFY(help.startsWith("usage: awe_tune_gains"));
    for (const char *option : {"--plant", "--dead-time", "--halvings", "--least-gain", "--seconds"})
        QVERIFY2(help.contains(option), option);
}

QTEST_GUILESS_MAIN(tst_GainTuning)
#include "tst_GainTuning.moc"
