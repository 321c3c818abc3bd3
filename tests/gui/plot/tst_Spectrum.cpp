// SPDX-License-Identifier: Apache-2.0
#include "gui/plot/SpectrumTable.h"

#include <QtTest/QtTest>

#include <cmath>
#include <random>

using namespace qplc;

namespace {

constexpr double pi = 3.14159265358979323846;
const Spectrum::Flag wanted{false};

Spectrum::Samples sine(std::size_t count, double amplitude, double frequency, double period, double mean = 0.0)
{
    Spectrum::Samples samples;
    for (std::size_t i = 0; i < count; ++i)
        samples.push_back(float(mean + amplitude * std::sin(2.0 * pi * frequency * double(i) * period + 0.3)));
    return samples;
}

/// Of the variance 1.
Spectrum::Samples noise(std::size_t count)
{
    std::mt19937 numbers(7);  // the same in each run
    Spectrum::Samples samples;
    for (std::size_t i = 0; i < count; ++i)
        samples.push_back(float(std::sqrt(12.0) * (double(numbers()) / double(std::mt19937::max()) - 0.5)));
    return samples;
}

/// Values 0, 1, 2, ... with lines at 0, \a step, ...
Spectrum::Lines linesOf(std::size_t count, double step)
{
    Spectrum::Lines lines;
    lines.step = step;
    for (std::size_t i = 0; i < count; ++i)
        lines.values.push_back(double(i));
    return lines;
}

Spectrum::Picture pictureOf(std::size_t columns, std::size_t lines)
{
    Spectrum::Picture picture;
    picture.step = 0.5;
    picture.begin = 1.0;
    picture.duration = 2.0;
    picture.columns = columns;
    picture.lines = lines;
    for (std::size_t i = 0; i < columns * lines; ++i)
        picture.values.push_back(float(i));
    return picture;
}

QByteArray textOf(TextTable &table)
{
    QByteArray text = table.header();
    while (!table.isAtEnd())
        text += table.next(1);
    return text;
}

double meanSquare(const Spectrum::Samples &samples)
{
    double mean = 0.0;
    for (const float sample : samples)
        mean += double(sample) / double(samples.size());
    double square = 0.0;
    for (const float sample : samples)
        square += (double(sample) - mean) * (double(sample) - mean) / double(samples.size());
    return square;
}

double integral(const Spectrum::Lines &lines)
{
    double sum = 0.0;
    for (const double value : lines.values)
        sum += value * lines.step;
    return sum;
}

bool isNear(double a, double b, double share)
{
    return std::fabs(a - b) <= share * std::fabs(b);
}

EvenRun runOf(const std::vector<std::int64_t> &times)
{
    EvenRun run;
    for (const std::int64_t time : times)
        run.add(time, 1.0, false);
    return run;
}

}  // namespace

/// The mathematics of spectra, against what is known without them.
class tst_Spectrum : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void sineShowsItsAmplitudeAtItsFrequency_data();
    void sineShowsItsAmplitudeAtItsFrequency();
    void flatTopShowsTheAmplitudeAlsoBetweenLines();
    void twoSinesShowBothAmplitudes();
    void integralOfTheDensityIsTheMeanSquare_data();
    void integralOfTheDensityIsTheMeanSquare();
    void sineHasItsMeanSquareInTheDensity();
    void whiteNoiseHasAFlatDensity();
    void meanIsRemoved();
    void newestSamplesAreUsed();
    void pictureShowsWhenAFrequencyIsThere();
    void pictureHasABoundedNumberOfColumns();
    void tooFewSamplesHaveNoSpectrum();
    void unwantedSpectrumEndsEarly();
    void lengthsAreProductsOfSmallFactors();
    void evenSamplesAreOneRun();
    void longestRunWithoutAGapIsTaken();
    void missingValueEndsARun();
    void otherCycleBeginsARun();
    void skippedCycleIsNoPartOfARun();
    void newestOfEqualRunsIsTaken();
    void smallDifferencesOfTimeAreNoGap();
    void tableHasARowForEachFrequency();
    void tableHasWhatIsSeen();
    void tableOfASpectrogramHasARowForEachPieceOfTime();
    void piecesOfALargeSpectrogramAreSmall();
};

void tst_Spectrum::sineShowsItsAmplitudeAtItsFrequency_data()
{
    QTest::addColumn<int>("window");
    QTest::newRow("rectangular") << int(Spectrum::Rectangular);
    QTest::newRow("Hann") << int(Spectrum::Hann);
    QTest::newRow("flat top") << int(Spectrum::FlatTop);
}

void tst_Spectrum::sineShowsItsAmplitudeAtItsFrequency()
{
    QFETCH(int, window);
    // 1000 samples at 100 Hz: a line each 0.1 Hz
    const Spectrum::Lines lines
        = Spectrum::amplitudes(sine(1000, 3.0, 12.5, 0.01, 40.0), 0.01, Spectrum::Window(window), wanted);
    QCOMPARE(lines.samples, std::size_t(1000));
    QCOMPARE(lines.values.size(), std::size_t(501));
    QVERIFY(isNear(lines.step, 0.1, 1e-9));
    QCOMPARE(lines.highest(), std::size_t(125));
    QVERIFY2(isNear(lines.values[125], 3.0, 1e-4), qPrintable(QString::number(lines.values[125])));
    QVERIFY(lines.values[200] < 1e-4);
}

void tst_Spectrum::flatTopShowsTheAmplitudeAlsoBetweenLines()
{
    const Spectrum::Samples samples = sine(1000, 3.0, 12.55, 0.01);
    const Spectrum::Lines flat = Spectrum::amplitudes(samples, 0.01, Spectrum::FlatTop, wanted);
    QVERIFY(isNear(flat.values[flat.highest()], 3.0, 2e-3));
    const Spectrum::Lines rectangular = Spectrum::amplitudes(samples, 0.01, Spectrum::Rectangular, wanted);
    QVERIFY(rectangular.values[rectangular.highest()] < 0.7 * 3.0);  // what the window is for
}

void tst_Spectrum::twoSinesShowBothAmplitudes()
{
    Spectrum::Samples samples = sine(4000, 1.0, 5.0, 0.001);
    const Spectrum::Samples other = sine(4000, 0.01, 80.0, 0.001);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] += other[i];
    const Spectrum::Lines lines = Spectrum::amplitudes(samples, 0.001, Spectrum::Hann, wanted);
    QVERIFY(isNear(lines.values[20], 1.0, 1e-3));
    QVERIFY(isNear(lines.values[320], 0.01, 1e-2));
}

void tst_Spectrum::integralOfTheDensityIsTheMeanSquare_data()
{
    QTest::addColumn<int>("samples");
    QTest::newRow("power of two") << 4096;
    QTest::newRow("other factors") << 3000;
}

/// Parseval. Exact for one segment without a window.
void tst_Spectrum::integralOfTheDensityIsTheMeanSquare()
{
    QFETCH(int, samples);
    const Spectrum::Samples random = noise(std::size_t(samples));
    const Spectrum::Lines lines
        = Spectrum::densities(random, 0.002, Spectrum::Rectangular, {random.size(), 0.0}, wanted);
    QCOMPARE(lines.segments, std::size_t(1));
    QCOMPARE(lines.samples, random.size());
    QVERIFY(isNear(integral(lines), meanSquare(random), 1e-4));
}

void tst_Spectrum::sineHasItsMeanSquareInTheDensity()
{
    for (const Spectrum::Window window : {Spectrum::Rectangular, Spectrum::Hann, Spectrum::FlatTop}) {
        const Spectrum::Lines lines
            = Spectrum::densities(sine(8192, 4.0, 50.0, 0.001), 0.001, window, {1024, 0.5}, wanted);
        QCOMPARE(lines.segments, std::size_t(15));
        QVERIFY(isNear(integral(lines), 8.0, 0.01));  // a^2 / 2
    }
}

/// The variance over the band from 0 to half of the rate.
void tst_Spectrum::whiteNoiseHasAFlatDensity()
{
    constexpr double period = 0.01;
    const double level = 1.0 * 2.0 * period;
    const Spectrum::Lines lines = Spectrum::densities(noise(200000), period, Spectrum::Hann, {256, 0.5}, wanted);
    QVERIFY(lines.segments > 1500);
    for (std::size_t line = 2; line + 2 < lines.values.size(); ++line)
        QVERIFY2(isNear(lines.values[line], level, 0.2), qPrintable(QString::number(lines.values[line] / level)));
    QVERIFY(isNear(integral(lines), 1.0, 0.02));
}

void tst_Spectrum::meanIsRemoved()
{
    const Spectrum::Samples constant(512, 1234.5F);
    for (const double value : Spectrum::amplitudes(constant, 0.1, Spectrum::Hann, wanted).values)
        QVERIFY(value < 1e-3);
}

void tst_Spectrum::newestSamplesAreUsed()
{
    Spectrum::Samples samples(39, 1000.0F);  // 1039 is no quick length
    const Spectrum::Samples newest = sine(1000, 2.0, 10.0, 0.01);
    samples.insert(samples.end(), newest.begin(), newest.end());
    const Spectrum::Lines lines = Spectrum::amplitudes(samples, 0.01, Spectrum::Rectangular, wanted);
    QCOMPARE(lines.samples, std::size_t(1024));
    const Spectrum::Lines cut = Spectrum::densities(samples, 0.01, Spectrum::Rectangular, {1000, 0.5}, wanted);
    QCOMPARE(cut.samples, std::size_t(1000));
    QVERIFY(isNear(integral(cut), 2.0, 1e-3));
}

void tst_Spectrum::pictureShowsWhenAFrequencyIsThere()
{
    Spectrum::Samples samples = sine(4000, 1.0, 10.0, 0.01);
    const Spectrum::Samples second = sine(4000, 1.0, 30.0, 0.01);
    samples.insert(samples.end(), second.begin(), second.end());
    const Spectrum::Picture picture = Spectrum::picture(samples, 0.01, Spectrum::Hann, {200, 0.5}, wanted);
    QCOMPARE(picture.columns, std::size_t(79));
    QCOMPARE(picture.lines, std::size_t(101));
    QVERIFY(isNear(picture.duration, 1.0, 1e-9));
    QVERIFY(isNear(picture.begin, 0.5, 1e-9));  // the first segment is that of 0 s to 2 s
    QVERIFY(picture.at(10, 20) > 1000.0F * picture.at(10, 60));
    QVERIFY(picture.at(70, 60) > 1000.0F * picture.at(70, 20));
    QVERIFY(picture.lowest > 0.0F && picture.lowest < picture.highest);
}

void tst_Spectrum::pictureHasABoundedNumberOfColumns()
{
    const Spectrum::Picture picture = Spectrum::picture(noise(300000), 0.001, Spectrum::Hann, {16, 0.75}, wanted);
    QVERIFY(picture.columns <= Spectrum::MostColumns);
    QVERIFY(picture.columns > Spectrum::MostColumns / 2);
    QVERIFY(isNear(double(picture.columns) * picture.duration, 300.0, 0.01));
}

void tst_Spectrum::tooFewSamplesHaveNoSpectrum()
{
    for (const std::size_t count : {std::size_t(0), std::size_t(1), Spectrum::LeastSamples - 1}) {
        QVERIFY(Spectrum::amplitudes(noise(count), 0.1, Spectrum::Hann, wanted).values.empty());
        QVERIFY(Spectrum::densities(noise(count), 0.1, Spectrum::Hann, {}, wanted).values.empty());
        QCOMPARE(Spectrum::picture(noise(count), 0.1, Spectrum::Hann, {}, wanted).columns, std::size_t(0));
    }
    const Spectrum::Samples least = noise(Spectrum::LeastSamples);
    QCOMPARE(Spectrum::amplitudes(least, 0.1, Spectrum::Hann, wanted).values.size(), least.size() / 2 + 1);
    QCOMPARE(Spectrum::densities(least, 0.1, Spectrum::Hann, {}, wanted).segments, std::size_t(1));
    QCOMPARE(Spectrum::picture(least, 0.1, Spectrum::Hann, {}, wanted).columns, std::size_t(1));
}

void tst_Spectrum::unwantedSpectrumEndsEarly()
{
    const Spectrum::Flag unwanted{true};
    QVERIFY(Spectrum::amplitudes(noise(1000), 0.1, Spectrum::Hann, unwanted).values.empty());
    QVERIFY(Spectrum::densities(noise(1000), 0.1, Spectrum::Hann, {}, unwanted).values.empty());
    QCOMPARE(Spectrum::picture(noise(1000), 0.1, Spectrum::Hann, {}, unwanted).columns, std::size_t(0));
}

void tst_Spectrum::lengthsAreProductsOfSmallFactors()
{
    for (std::size_t size = 2; size < 3000; ++size) {
        const std::size_t length = Spectrum::fastLength(size);
        QVERIFY(length <= size && length % 2 == 0);
        std::size_t rest = length;
        for (const std::size_t factor : {2, 3, 5}) {
            while (rest % factor == 0)
                rest /= factor;
        }
        QCOMPARE(rest, std::size_t(1));
    }
    QCOMPARE(Spectrum::fastLength(1000), std::size_t(1000));
    QCOMPARE(Spectrum::fastLength(2 * 509), std::size_t(1000));
    QCOMPARE(Spectrum::fastLength(Spectrum::MostSamples), Spectrum::MostSamples);
}

void tst_Spectrum::evenSamplesAreOneRun()
{
    const EvenRun run = runOf({0, 10, 20, 30});
    QCOMPARE(run.begin(), std::size_t(0));
    QCOMPARE(run.size(), std::size_t(4));
    QVERIFY(isNear(run.period(), 10e-9, 1e-9));
    QCOMPARE(run.interruptions() + run.missingValues() + run.otherDistances(), std::size_t(0));
    QCOMPARE(EvenRun().size(), std::size_t(0));
    QCOMPARE(runOf({5}).period(), 0.0);
}

void tst_Spectrum::longestRunWithoutAGapIsTaken()
{
    EvenRun run;
    for (int i = 0; i < 100; ++i)
        run.add(i * 10, 1.0, i == 0 || i == 20 || i == 90);
    QCOMPARE(run.begin(), std::size_t(20));
    QCOMPARE(run.size(), std::size_t(70));
    QCOMPARE(run.interruptions(), std::size_t(2));  // what is first follows nothing
}

void tst_Spectrum::missingValueEndsARun()
{
    EvenRun run;
    for (int i = 0; i < 100; ++i)
        run.add(i * 10, i == 30 || i == 31 ? std::nan("") : 1.0, false);
    QCOMPARE(run.begin(), std::size_t(32));
    QCOMPARE(run.size(), std::size_t(68));
    QCOMPARE(run.missingValues(), std::size_t(2));
}

void tst_Spectrum::otherCycleBeginsARun()
{
    const EvenRun run = runOf({0, 10, 20, 30, 50, 70, 90, 110, 130});
    QCOMPARE(run.begin(), std::size_t(3));
    QCOMPARE(run.size(), std::size_t(6));
    QVERIFY(isNear(run.period(), 20e-9, 1e-9));
    QCOMPARE(run.otherDistances(), std::size_t(1));
}

void tst_Spectrum::skippedCycleIsNoPartOfARun()
{
    const EvenRun run = runOf({0, 10, 20, 40, 50, 60, 70});
    QCOMPARE(run.begin(), std::size_t(3));
    QCOMPARE(run.size(), std::size_t(4));
    QVERIFY(isNear(run.period(), 10e-9, 1e-9));
}

void tst_Spectrum::newestOfEqualRunsIsTaken()
{
    EvenRun run;
    for (int i = 0; i < 40; ++i)
        run.add(i * 10, 1.0, i == 20);
    QCOMPARE(run.begin(), std::size_t(20));
}

void tst_Spectrum::smallDifferencesOfTimeAreNoGap()
{
    const EvenRun run = runOf({0, 1000, 2030, 3000, 3980, 5000});
    QCOMPARE(run.size(), std::size_t(6));
}

void tst_Spectrum::tableHasARowForEachFrequency()
{
    SpectrumTable table(TableText::Csv, {{"force", "N", linesOf(3, 1.0)}, {"speed", "m/s", linesOf(2, 1.5)}}, {});
    QCOMPARE(textOf(table), QByteArray("frequency [Hz],force [N],speed [m/s]\r\n0,0,0\r\n1,1,\r\n1.5,,1\r\n2,2,\r\n"));
    QCOMPARE(table.rows(), std::int64_t(4));
    SpectrumTable nothing(TableText::Csv, {}, {});
    QCOMPARE(textOf(nothing), QByteArray("frequency [Hz]\r\n"));
}

void tst_Spectrum::tableHasWhatIsSeen()
{
    SpectrumTable table(TableText::Csv, {{"force", "", linesOf(100, 0.1)}}, {0.25, 0.45});
    QCOMPARE(textOf(table).count('\n'), 1 + 2);
    SpectrogramTable picture(TableText::Csv, {"force", "", 0, pictureOf(10, 10)}, {3.5, 6.5}, {0.9, 1.6});
    QCOMPARE(textOf(picture),
             QByteArray("UTC,time [s],force at 1 Hz,force at 1.5 Hz\r\n"
                        "1970-01-01T00:00:04.000000Z,4,12,13\r\n"
                        "1970-01-01T00:00:06.000000Z,6,22,23\r\n"));
}

void tst_Spectrum::tableOfASpectrogramHasARowForEachPieceOfTime()
{
    constexpr std::int64_t begin = 1'700'000'000'500'000'000;  // [ns]
    SpectrogramTable table(TableText::Tsv, {"force", "N/Hz", begin, pictureOf(2, 2)}, {}, {});
    QCOMPARE(textOf(table),
             QByteArray("UTC\ttime [s]\tforce at 0 Hz [N/Hz]\tforce at 0.5 Hz [N/Hz]\n"
                        "2023-11-14T22:13:22.500000Z\t2\t0\t1\n"
                        "2023-11-14T22:13:24.500000Z\t4\t2\t3\n"));
    SpectrogramTable nothing(TableText::Csv, {}, {}, {});
    QCOMPARE(textOf(nothing), QByteArray("UTC,time [s]\r\n"));
}

/// The window goes on between them.
void tst_Spectrum::piecesOfALargeSpectrogramAreSmall()
{
    SpectrogramTable table(TableText::Csv, {"force", "", 0, pictureOf(100, 50'000)}, {}, {});
    QCOMPARE(table.next(2000).count('\n'), 2);
    QCOMPARE(table.rows(), std::int64_t(2));
}

QTEST_GUILESS_MAIN(tst_Spectrum)
#include "tst_Spectrum.moc"
