// SPDX-License-Identifier: Apache-2.0
#include "transport/FaultPlan.h"

#include <QtTest/QtTest>

using qplc::FaultPlan;

class tst_FaultPlan : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void optionsApplyToBothDirections();
    void optionsMayApplyToOneDirection();
    void aCutHasBeginLengthAndPeriod();
    void invalidOptionsAreReported_data();
    void invalidOptionsAreReported();
};

namespace {

FaultPlan planOf(const char *text)
{
    QString error;
    const auto plan = FaultPlan::fromText(QString::fromLatin1(text), &error);
    if (!plan)
        QTest::qFail(qPrintable(error), __FILE__, __LINE__);
    return plan.value_or(FaultPlan());
}

}  // namespace

void tst_FaultPlan::optionsApplyToBothDirections()
{
    const FaultPlan plan
        = planOf("loss=5%, duplicate=0.5%,reorder=100%,corrupt=1%,delay=2ms,jitter=500us,seed=18446744073709551615");
    for (const FaultPlan::Direction &direction : {plan.sent, plan.received}) {
        QCOMPARE(direction.loss, 0.05);
        QCOMPARE(direction.duplicate, 0.005);
        QCOMPARE(direction.reorder, 1.0);
        QCOMPARE(direction.corrupt, 0.01);
        QCOMPARE(direction.delay, std::int64_t(2'000'000));
        QCOMPARE(direction.jitter, std::int64_t(500'000));
        QCOMPARE(direction.cutBegin, std::int64_t(-1));
    }
    QCOMPARE(plan.seed, ~std::uint64_t(0));
    QCOMPARE(planOf("loss=5%").seed, std::uint64_t(1));
}

void tst_FaultPlan::optionsMayApplyToOneDirection()
{
    const FaultPlan plan = planOf("loss=5%,loss-sent=50%,delay-received=1s,cut-sent=0s");
    QCOMPARE(plan.sent.loss, 0.5);  // what comes later counts
    QCOMPARE(plan.received.loss, 0.05);
    QCOMPARE(plan.sent.delay, std::int64_t(0));
    QCOMPARE(plan.received.delay, std::int64_t(1'000'000'000));
    QVERIFY(plan.sent.isCut(0));
    QVERIFY(!plan.received.isCut(0));
}

void tst_FaultPlan::aCutHasBeginLengthAndPeriod()
{
    const FaultPlan::Direction forGood = planOf("cut=2s").sent;
    QVERIFY(!forGood.isCut(1'999'999'999));
    QVERIFY(forGood.isCut(2'000'000'000));
    QVERIFY(forGood.isCut(std::int64_t(1) << 62));
    const FaultPlan::Direction once = planOf("cut=100ns+50ns").sent;
    QVERIFY(!once.isCut(99) && once.isCut(100) && once.isCut(149) && !once.isCut(150) && !once.isCut(1000));
    const FaultPlan::Direction again = planOf("cut=100ns+50ns/200ns").received;
    QVERIFY(again.isCut(100) && !again.isCut(150) && !again.isCut(299) && again.isCut(300) && again.isCut(349)
            && !again.isCut(350));
}

void tst_FaultPlan::invalidOptionsAreReported_data()
{
    QTest::addColumn<QString>("message");
    const auto row = [](const char *text, const char *message) { QTest::newRow(text) << QString::fromLatin1(message); };
    row("", "'' has no fault; name one");
    row("seed=3", "'seed=3' has no fault; name one");
    row("loss=0%", "'loss=0%' has no fault");
    row("loss=5", "'loss=5': use a share of 0% ... 100%");
    row("loss=101%", "'loss=101%': use a share");
    row("loss=-1%", "'loss=-1%': use a share");
    row("loss=nan%", "'loss=nan%': use a share");
    row("loss", "'loss': use a share");
    row("loss=5%,lose=1%", "'lose=1%': use loss, duplicate,");
    row("loss-both=1%", "'loss-both=1%': use loss, duplicate,");
    row("delay=2", "'delay=2': use a time of 0 ... 10s");
    row("delay=11s", "'delay=11s': use a time");
    row("delay=2 days", "'delay=2 days': use a time");
    row("jitter=infs", "'jitter=infs': use a time");
    row("loss=1%,seed=-1", "'seed=-1': use a whole number");
    row("seed-sent=1,loss=1%", "'seed-sent=1': use loss");
    row("cut=", "'cut=': use BEGIN, BEGIN+LENGTH");
    row("cut=1s+0s", "'cut=1s+0s': use BEGIN");
    row("cut=1s/2s", "'cut=1s/2s': use BEGIN");
    row("cut=1s+2s/2s", "'cut=1s+2s/2s': use BEGIN");
}

void tst_FaultPlan::invalidOptionsAreReported()
{
    QFETCH(QString, message);
    QString error;
    QVERIFY(!FaultPlan::fromText(QString::fromLatin1(QTest::currentDataTag()), &error));
    QVERIFY2(error.contains(message), qPrintable(error));
}

QTEST_APPLESS_MAIN(tst_FaultPlan)
#include "tst_FaultPlan.moc"
