// SPDX-License-Identifier: Apache-2.0
#include "tools/HistogramText.h"

#include <QtTest/QtTest>

using tools::durationText;
using tools::histogramLines;

class tst_HistogramText : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void durationHasThreeDigits_data();
    void durationHasThreeDigits();
    void emptyHistogramIsReported();
    void oneBinIsOneFullBar();
    void everyValueIsInOneRow();
    void rowCountsValuesUpToItsBorder();
    void rareValuesAreSeen();
    void gapsKeepTheirRows();
    void longGapsAreOneLine();
    void linesAreAsWideAsWanted_data();
    void linesAreAsWideAsWanted();
    void invalidBinsDoNotCrash();
    void binsInAnyOrderHaveTheirRows();

private:
    static QPlcDistribution::Bin bin(qint64 border, quint64 count) { return {border, count}; }
};

void tst_HistogramText::durationHasThreeDigits_data()
{
    QTest::addColumn<double>("nanoseconds");
    QTest::addColumn<QString>("text");
    QTest::newRow("zero") << 0.0 << "0 ns";
    QTest::newRow("ns") << 850.0 << "850 ns";
    QTest::newRow("rounded up to the next unit") << 999.9 << "1.00 µs";
    QTest::newRow("us") << 1234.0 << "1.23 µs";
    QTest::newRow("tens") << 12340.0 << "12.3 µs";
    QTest::newRow("hundreds") << 123400.0 << "123 µs";
    QTest::newRow("just below ten") << 9996.0 << "10.0 µs";
    QTest::newRow("ms") << 1.5e6 << "1.50 ms";
    QTest::newRow("s") << 2e9 << "2.00 s";
    QTest::newRow("an hour") << 3.6e12 << "3600 s";
    QTest::newRow("negative") << -12000.0 << "-12.0 µs";
}

void tst_HistogramText::durationHasThreeDigits()
{
    QFETCH(double, nanoseconds);
    QFETCH(QString, text);
    QCOMPARE(durationText(nanoseconds), text);
}

void tst_HistogramText::emptyHistogramIsReported()
{
    QCOMPARE(histogramLines({}, 80), QStringList{QStringLiteral("nothing recorded")});
    QCOMPARE(histogramLines({bin(100, 0)}, 80), QStringList{QStringLiteral("nothing recorded")});
}

void tst_HistogramText::oneBinIsOneFullBar()
{
    const QStringList lines = histogramLines({bin(1000, 5)}, 80);
    QCOMPARE(lines.size(), 1);
    QCOMPARE(lines.constFirst().section(QChar(0x2588), 0, 0).simplified(), QStringLiteral("<= 1.00 µs 5 100.000 %"));
    QCOMPARE(lines.constFirst().size(), 80);
}

void tst_HistogramText::everyValueIsInOneRow()
{
    QVector<QPlcDistribution::Bin> bins;
    double total = 0;
    for (int i = 1; i < 40; ++i) {
        bins.append(bin(qint64(std::pow(1.7, i)) + i, quint64(i)));
        total += i;
    }
    double shown = 0;
    for (const QString &line : histogramLines(bins, 80))
        shown += line.simplified().section(QLatin1Char(' '), 3, 3).toDouble();
    QCOMPARE(shown, total);
}

void tst_HistogramText::rowCountsValuesUpToItsBorder()
{
    const QStringList lines = histogramLines({bin(1000, 1), bin(2000, 2), bin(2001, 4), bin(50000, 8)}, 80);
    const auto countOf = [&lines](const char *border) {
        const QStringList found
            = lines.filter(QRegularExpression(QStringLiteral("^<= +%1 ").arg(QString::fromUtf8(border))));
        return found.value(0).simplified().section(QLatin1Char(' '), 3, 3);
    };
    QCOMPARE(countOf("1.00 µs"), QStringLiteral("1"));
    QCOMPARE(countOf("2.00 µs"), QStringLiteral("2"));
    QCOMPARE(countOf("5.00 µs"), QStringLiteral("4"));
    QCOMPARE(countOf("50.0 µs"), QStringLiteral("8"));
}

void tst_HistogramText::rareValuesAreSeen()
{
    const QStringList lines = histogramLines({bin(1000, 1'000'000'000), bin(1'000'000, 1)}, 80);
    QVERIFY2(lines.constLast().contains(QChar(0x258f)), qPrintable(lines.constLast()));  // the thinnest block
}

void tst_HistogramText::gapsKeepTheirRows()
{
    const QStringList lines = histogramLines({bin(1000, 1), bin(100'000, 1)}, 80);
    QCOMPARE(lines.size(), 7);  // 1 2 5 10 20 50 100 us
    QVERIFY(!lines.at(3).contains(QChar(0x258f)));
}

void tst_HistogramText::longGapsAreOneLine()
{
    const QStringList lines = histogramLines({bin(1, 2), bin(10'000'000, 8)}, 80);
    QCOMPARE(lines.size(), 3);
    QCOMPARE(lines.at(1).trimmed(), QStringLiteral("..."));
    QCOMPARE(lines.at(2).simplified().section(QLatin1Char(' '), 1, 4), QStringLiteral("10.0 ms 8 80.000"));
}

void tst_HistogramText::linesAreAsWideAsWanted_data()
{
    QTest::addColumn<int>("width");
    QTest::newRow("narrow") << 40;
    QTest::newRow("usual") << 80;
    QTest::newRow("wide") << 200;
}

void tst_HistogramText::linesAreAsWideAsWanted()
{
    QFETCH(int, width);
    int longest = 0;
    for (const QString &line : histogramLines({bin(900, 1), bin(1000, 7), bin(123456, 3)}, width))
        longest = qMax(longest, line.size());
    QCOMPARE(longest, width);
}

void tst_HistogramText::invalidBinsDoNotCrash()
{
    histogramLines({bin(-5, 3), bin(0, 1)}, 80);
    histogramLines({bin(1, 1), bin(9'000'000'000'000'000'000, 1)}, 10);
}

void tst_HistogramText::binsInAnyOrderHaveTheirRows()
{
    const QStringList rising = histogramLines({bin(10, 1), bin(1000, 2), bin(1'000'000'000, 3)}, 80);
    QCOMPARE(histogramLines({bin(1000, 2), bin(1'000'000'000, 3), bin(10, 1)}, 80), rising);
}

QTEST_APPLESS_MAIN(tst_HistogramText)
#include "tst_HistogramText.moc"
