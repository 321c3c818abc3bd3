// SPDX-License-Identifier: Apache-2.0
#include "gui/charts/JitterDistributions.h"
#include "protocol/messages/Statistics.h"

#include <QtTest/QtTest>

#include <QtCore/QJsonDocument>

using namespace qplc;

namespace {

/// Those of the lateness of a master with these bins.
QVector<JitterDistribution::Bin> binsOf(const QByteArray &bins)
{
    const QByteArray json = R"({"master":{"lateness":{"sinceStart":{"count":1,"bins":)" + bins + "}}}}";
    const auto read = messages::fieldsOf<messages::Statistics>(QJsonDocument::fromJson(json).object());
    return jitterDistributions({{QString(), QString(), *read.master.lateness}}, &QPlcDurationStatistics::sinceStart)
        .first()
        .bins;
}

}  // namespace

class tst_JitterDistributions : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void missingStatisticsGiveNoDistributions();
    void figuresAreThoseOfTheWindow();
    void fineAndCoarseBinsMergeIntoEighthsOfAnOctave();
    void smallAndLargestBordersHaveTheirBins();
    void countsAreKept();
    void invalidBinsAreIgnored();
    void keysHaveReadableTitles();
};

void tst_JitterDistributions::missingStatisticsGiveNoDistributions()
{
    QVERIFY(jitterDistributions({}, &QPlcDurationStatistics::sinceStart).isEmpty());
    QVERIFY(jitterDistributions({{}}, &QPlcDurationStatistics::sinceStart).first().bins.isEmpty());
}

void tst_JitterDistributions::figuresAreThoseOfTheWindow()
{
    QPlcPanelContext::Duration duration{QStringLiteral("Kite"), QStringLiteral("execution"), {}};
    duration.statistics.sinceStart.count = 5;
    duration.statistics.sinceStart.p50 = 100;
    duration.statistics.sinceStart.p99 = 200;
    duration.statistics.sinceStart.maximum = 300;
    duration.statistics.last10s.count = 2;
    const JitterDistribution found = jitterDistributions({duration}, &QPlcDurationStatistics::sinceStart).first();
    QCOMPARE(found.key(), QStringLiteral("Kite.execution"));
    QCOMPARE(found.count, 5.0);
    QCOMPARE(found.p50, 100.0);
    QCOMPARE(found.p99, 200.0);
    QCOMPARE(found.maximum, 300.0);
    QCOMPARE(jitterDistributions({duration}, &QPlcDurationStatistics::last10s).first().count, 2.0);
}

void tst_JitterDistributions::fineAndCoarseBinsMergeIntoEighthsOfAnOctave()
{
    // 1024 ... 2047: fine bins are 32 wide, coarse ones 128.
    const auto fine = binsOf("[[1055, 1], [1087, 2], [1151, 4], [1183, 8]]");
    QCOMPARE(fine.size(), 2);
    QCOMPARE(fine[0].low, 1024.0);
    QCOMPARE(fine[0].high, 1152.0);
    QCOMPARE(fine[0].count, 7.0);
    QCOMPARE(fine[1].low, 1152.0);
    QCOMPARE(fine[1].count, 8.0);
    const auto coarse = binsOf("[[1151, 7], [1279, 8]]");
    QCOMPARE(coarse.size(), 2);
    QCOMPARE(coarse[0].low, 1024.0);
    QCOMPARE(coarse[1].high, 1280.0);
}

void tst_JitterDistributions::smallAndLargestBordersHaveTheirBins()
{
    const auto bins = binsOf("[[0, 1], [1, 1], [7, 1], [8, 1], [15, 1], [16, 1], [9223372036854775807, 1]]");
    QCOMPARE(bins.size(), 7);
    QCOMPARE(bins[0].low, 0.0);
    QCOMPARE(bins[2].high, 8.0);
    QCOMPARE(bins[3].low, 8.0);
    QCOMPARE(bins[4].high, 16.0);
    QCOMPARE(bins[5].high, 18.0);
    QVERIFY(bins[6].low >= 9e18);
}

void tst_JitterDistributions::countsAreKept()
{
    double sum = 0.0;
    QByteArray json;
    for (int i = 1; i <= 1000; ++i) {
        json += (json.isEmpty() ? "[[" : ",[") + QByteArray::number(i * i) + "," + QByteArray::number(i) + "]";
        sum += i;
    }
    double found = 0.0;
    double end = 0.0;
    for (const JitterDistribution::Bin &bin : binsOf(json + "]")) {
        QVERIFY(bin.low >= end && bin.low < bin.high);
        end = bin.high;
        found += bin.count;
    }
    QCOMPARE(found, sum);
}

void tst_JitterDistributions::invalidBinsAreIgnored()
{
    QVERIFY(binsOf(R"([[-5, 1], ["x"], [3, 0], [3, -1], 7, null])").size() <= 1);
    QVERIFY(binsOf("{}").isEmpty());
}

void tst_JitterDistributions::keysHaveReadableTitles()
{
    QCOMPARE(JitterDistribution::titleOf("Master.lateness"), QStringLiteral("Master lateness"));
    QCOMPARE(JitterDistribution::titleOf("a.b.roundTrip"), QStringLiteral("a.b round trip"));
}

QTEST_APPLESS_MAIN(tst_JitterDistributions)
#include "tst_JitterDistributions.moc"
