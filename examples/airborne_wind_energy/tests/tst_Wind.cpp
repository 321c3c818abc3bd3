// SPDX-License-Identifier: Apache-2.0
#include "AngleMath.h"
#include "Wind.h"

#include "Near.h"

using namespace awe;
using Eigen::Vector3d;

class tst_Wind : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void constantWindStaysExactlyTheMean();
    void gustRisesAndFallsAsOneMinusCosine();
    void turbulenceHasTheWantedStandardDeviations();
    void turbulenceDecorrelatesOverItsLengthScale();
    void statisticsDoNotDependOnTheStep();
    void sameSeedGivesTheSameWindBitForBit();
    void otherSeedGivesAnotherWind();
    void gaussianNumbersAreNormalAndKnown();
    void kaimalTurbulenceHasTheWantedStandardDeviations();
    void kaimalTurbulenceHasItsSpectrum();
    void kaimalTurbulenceDoesNotDependOnTheStep();
    void kaimalTurbulenceRepeatsWithItsSeed();
    void verticalMeanWindHasFiniteTurbulence();
    void badValueIsNamed();

private:
    static WindParameters turbulent(std::uint64_t seed = 1);
};

WindParameters tst_Wind::turbulent(std::uint64_t seed)
{
    WindParameters parameters;
    parameters.meanVelocity = {8.0, 0.0, 0.0};
    parameters.turbulenceIntensity = 0.15;
    parameters.seed = seed;
    return parameters;
}

void tst_Wind::constantWindStaysExactlyTheMean()
{
    Wind wind;
    for (int i = 0; i < 1000; ++i)
        wind.step();
    QCOMPARE(wind.velocity(), Vector3d(5.0, 3.0, 0.0));
    COMPARE_NEAR(wind.time(), 10.0, 1e-12);
}

void tst_Wind::gustRisesAndFallsAsOneMinusCosine()
{
    WindParameters parameters;
    parameters.gustAmplitude = 0.8;
    parameters.gustStart = 1.0;
    parameters.gustDuration = 4.0;
    Wind wind(parameters);
    const auto factorAt = [&wind](double time) {
        wind.reset();
        for (long i = 0; i < std::lround(time / 0.01); ++i)
            wind.step();
        return wind.velocity().x() / 5.0;
    };
    COMPARE_NEAR(factorAt(0.5), 1.0, 0.0);
    COMPARE_NEAR(factorAt(2.0), 1.4, 1e-12);
    COMPARE_NEAR(factorAt(3.0), 1.8, 1e-12);
    COMPARE_NEAR(factorAt(4.0), 1.4, 1e-12);
    COMPARE_NEAR(factorAt(6.0), 1.0, 0.0);
}

void tst_Wind::turbulenceHasTheWantedStandardDeviations()
{
    Wind wind(turbulent());
    Vector3d sum = Vector3d::Zero(), squares = Vector3d::Zero();
    const int count = 2000000;  // 20 000 s, about 2700 independent values
    for (int i = 0; i < count; ++i) {
        wind.step();
        const Vector3d deviation = wind.velocity() - Vector3d(8.0, 0.0, 0.0);
        sum += deviation;
        squares += deviation.cwiseAbs2();
    }
    const Vector3d sigma = (squares / count).cwiseSqrt();
    COMPARE_NEAR(sigma.x(), 1.2, 0.06);
    COMPARE_NEAR(sigma.y(), 0.8 * 1.2, 0.05);
    COMPARE_NEAR(sigma.z(), 0.5 * 1.2, 0.03);
    QVERIFY((sum / count).norm() < 0.1);
}

void tst_Wind::turbulenceDecorrelatesOverItsLengthScale()
{
    Wind wind(turbulent());
    const int lag = 750;  // 60 m / (8 m/s) = 7.5 s: correlation 1/e
    std::vector<double> history;
    for (int i = 0; i < 1500000; ++i) {
        wind.step();
        history.push_back(wind.velocity().x() - 8.0);
    }
    double product = 0.0, square = 0.0;
    for (std::size_t i = lag; i < history.size(); ++i) {
        product += history[i] * history[i - lag];
        square += history[i] * history[i];
    }
    COMPARE_NEAR(product / square, std::exp(-1.0), 0.05);
}

void tst_Wind::statisticsDoNotDependOnTheStep()
{
    WindParameters coarse = turbulent();
    coarse.step = 0.5;
    Wind wind(coarse);
    double squares = 0.0;
    const int count = 100000;
    for (int i = 0; i < count; ++i) {
        wind.step();
        squares += std::pow(wind.velocity().x() - 8.0, 2);
    }
    COMPARE_NEAR(std::sqrt(squares / count), 1.2, 0.06);
}

void tst_Wind::sameSeedGivesTheSameWindBitForBit()
{
    Wind a(turbulent(7)), b(turbulent(7));
    for (int i = 0; i < 1001; ++i) {
        a.step();
        b.step();
    }
    QVERIFY(a.velocity() == b.velocity());
    const Vector3d there = a.velocity();
    a.reset();
    QCOMPARE(a.velocity(), Vector3d(8.0, 0.0, 0.0));
    for (int i = 0; i < 1001; ++i)
        a.step();
    QVERIFY(a.velocity() == there);
}

void tst_Wind::otherSeedGivesAnotherWind()
{
    Wind a(turbulent(1)), b(turbulent(2));
    a.step();
    b.step();
    QVERIFY(a.velocity() != b.velocity());
}

void tst_Wind::gaussianNumbersAreNormalAndKnown()
{
    GaussianSource source(1);
    const int count = 1000000;
    double sum = 0.0, squares = 0.0, fourth = 0.0;
    int withinOneSigma = 0;
    for (int i = 0; i < count; ++i) {
        const double g = source.next();
        sum += g;
        squares += g * g;
        fourth += g * g * g * g;
        withinOneSigma += std::abs(g) < 1.0 ? 1 : 0;
    }
    COMPARE_NEAR(sum / count, 0.0, 0.005);
    COMPARE_NEAR(squares / count, 1.0, 0.005);
    COMPARE_NEAR(fourth / count, 3.0, 0.04);
    COMPARE_NEAR(double(withinOneSigma) / count, 0.682689, 0.002);
    source.reset(1);
    COMPARE_NEAR(source.next(), -0.039399956754155314, 1e-12);
    COMPARE_NEAR(source.next(), -0.38683176162103955, 1e-12);
}

void tst_Wind::kaimalTurbulenceHasTheWantedStandardDeviations()
{
    WindParameters parameters = turbulent();
    parameters.turbulenceModel = TurbulenceModel::Kaimal;
    parameters.lengthScale = 35.0;
    Vector3d sum = Vector3d::Zero(), squares = Vector3d::Zero();
    constexpr int seeds = 40, steps = 60000;  // of 10 minutes
    for (parameters.seed = 1; parameters.seed <= seeds; ++parameters.seed) {
        Wind wind(parameters);
        for (int i = 0; i < steps; i += 10) {
            for (int k = 0; k < 10; ++k)
                wind.step();
            sum += wind.turbulence();
            squares += wind.turbulence().cwiseAbs2();
        }
    }
    const double count = seeds * steps / 10.0;
    const Vector3d deviation = (squares / count).cwiseSqrt();
    const double along = 0.15 * 8.0;
    COMPARE_NEAR(deviation.x(), along, 0.03 * along);
    COMPARE_NEAR(deviation.y(), 0.8 * along, 0.03 * along);
    COMPARE_NEAR(deviation.z(), 0.5 * along, 0.03 * along);
    COMPARE_NEAR((sum / count).norm(), 0.0, 0.2 * along);  // much of it is slower than 10 minutes
}

// The variance in each octave, by the exact sums over an interval of 2^16 values, is that of the
// formula.
void tst_Wind::kaimalTurbulenceHasItsSpectrum()
{
    WindParameters parameters = turbulent();
    parameters.turbulenceModel = TurbulenceModel::Kaimal;
    parameters.lengthScale = 35.0;
    const double scale = 8.1 * 35.0 / 8.0, variance = 1.2 * 1.2;  // n of 1 Hz; (TI U)^2
    const auto above = [&](double frequency) { return variance * std::pow(1.0 + 6.0 * scale * frequency, -2.0 / 3.0); };
    constexpr int count = 8192;
    constexpr double step = 0.05;
    std::vector<double> octaves(9, 0.0);
    constexpr int seeds = 24;
    for (parameters.seed = 1; parameters.seed <= seeds; ++parameters.seed) {
        parameters.step = step;
        Wind wind(parameters);
        std::vector<double> values(count);
        for (int i = 0; i < count; ++i, wind.step())  // Hann: what is between two lines does not leak far
            values[std::size_t(i)] = wind.turbulence().x() * (1.0 - std::cos(2.0 * pi * i / count));
        for (std::size_t octave = 0; octave < octaves.size(); ++octave) {
            for (int line = 8 << octave; line < 16 << octave && line < count / 2; line += 1 << octave) {
                double x = 0.0, y = 0.0;
                for (int i = 0; i < count; ++i) {
                    const double angle = 2.0 * pi * double((long(line) * i) % count) / count;
                    x += values[std::size_t(i)] * std::cos(angle);
                    y += values[std::size_t(i)] * std::sin(angle);
                }
                // Power of this line, for all that it stands for; 1.5: power of the window.
                octaves[octave] += 2.0 * (x * x + y * y) / (double(count) * count) / 1.5 * (1 << octave) / seeds;
            }
        }
    }
    for (std::size_t octave = 0; octave < 7; ++octave) {
        const double low = double(8 << octave) / (count * step);
        const double expected = above(low) - above(2.0 * low);
        QVERIFY2(std::abs(octaves[octave] / expected - 1.0) < 0.3,
                 qPrintable(
                     QStringLiteral("octave from %1 Hz: %2, expected %3").arg(low).arg(octaves[octave]).arg(expected)));
    }
}

void tst_Wind::kaimalTurbulenceDoesNotDependOnTheStep()
{
    WindParameters parameters = turbulent();
    parameters.turbulenceModel = TurbulenceModel::Kaimal;
    Wind fine(parameters);
    parameters.step = 0.02;
    Wind coarse(parameters);
    // The first value comes after one step of each: 10 and 20 ms.
    for (int i = 0; i < 500; ++i) {
        coarse.step();
        fine.step();
        fine.step();
        if (i == 0)
            fine.step();
    }
    COMPARE_NEAR((fine.velocity() - coarse.velocity()).norm(), 0.0, 1e-9);
}

void tst_Wind::kaimalTurbulenceRepeatsWithItsSeed()
{
    WindParameters parameters = turbulent(5);
    parameters.turbulenceModel = TurbulenceModel::Kaimal;
    Wind first(parameters), second(parameters);
    for (int i = 0; i < 1000; ++i) {
        QVERIFY(first.velocity() == second.velocity());
        first.step();
        second.step();
    }
    first.reset();
    second = Wind(parameters);
    QVERIFY(first.velocity() == second.velocity());
    parameters.seed = 6;
    QVERIFY(Wind(parameters).velocity() != first.velocity());
}

void tst_Wind::verticalMeanWindHasFiniteTurbulence()
{
    WindParameters parameters = turbulent();
    parameters.meanVelocity = {0.0, 0.0, 8.0};
    Wind wind(parameters);
    wind.step();
    QVERIFY(wind.velocity().allFinite());
    QVERIFY(wind.velocity().x() != 0.0 && wind.velocity().y() != 0.0);
}

void tst_Wind::badValueIsNamed()
{
    WindParameters parameters;
    QVERIFY(parameters.validate().empty());
    parameters.turbulenceIntensity = -0.1;
    VERIFY_CONTAINS(parameters.validate(), "turbulenceIntensity is -0.1; choose a value from 0 to 1");
    parameters = WindParameters();
    parameters.meanVelocity.y() = std::nan("");
    VERIFY_CONTAINS(parameters.validate(), "meanVelocity is nan m/s");
    parameters = WindParameters();
    parameters.lengthScale = 0.0;
    VERIFY_CONTAINS(parameters.validate(), "lengthScale is 0 m");
}

QTEST_APPLESS_MAIN(tst_Wind)
#include "tst_Wind.moc"
