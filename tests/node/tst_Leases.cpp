// SPDX-License-Identifier: Apache-2.0
#include "node/session/Leases.h"

#include <QtTest/QtTest>

using namespace qplc;

// Who has which signal until when, by a clock of the test.
class tst_Leases : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_leases = Leases(); }
    void noSignalIsLeasedInitially();
    void holderHasItsSignalsOnly();
    void newLeaseReplacesTheHolder();
    void releasedSignalHasNoHolder();
    void silentHolderLosesItsLeaseAtTheDeadline();
    void everyMessageOfTheHolderRenewsAllItsLeases();
    void messageAtTheDeadlineRenewsNothing();
    void leaseThatACycleHasEndedIsNotRenewed();
    void lostHolderLosesItsOwnLeasesOnce();
    void lostLeaseHasNoHolderAndStaysInTheMask();
    void nextDeadlineIsTheEarliestOfAllHeldLeases();

private:
    Leases m_leases;
    const int m_first = 0, m_second = 0;
    Leases::Holder anna() const { return &m_first; }
    Leases::Holder bert() const { return &m_second; }
};

void tst_Leases::noSignalIsLeasedInitially()
{
    QVERIFY(!m_leases.find(0));
    QVERIFY(m_leases.mask().empty());
    QVERIFY(m_leases.all().empty());
    QVERIFY(m_leases.loseSilent(1'000'000).empty());
    QVERIFY(m_leases.loseAllOf(anna()).empty());
    QVERIFY(!m_leases.nextDeadline());
    m_leases.renew(anna(), 5);
    m_leases.release({3});
    QVERIFY(m_leases.all().empty());
}

void tst_Leases::holderHasItsSignalsOnly()
{
    m_leases.take({1, 4}, anna(), "Anna", 100, 1000);
    m_leases.take({2}, bert(), "Bert", 100, 1000);
    QVERIFY(m_leases.isHeldBy(4, anna()) && m_leases.isHeldBy(2, bert()));
    QVERIFY(!m_leases.isHeldBy(2, anna()) && !m_leases.isHeldBy(3, anna()) && !m_leases.isHeldBy(3, nullptr));
    QVERIFY(m_leases.isHeldByOther(2, anna()) && !m_leases.isHeldByOther(1, anna()));
    QVERIFY(m_leases.signalsOf(anna()) == (Leases::Signals{1, 4}));
    QVERIFY(m_leases.mask() == (std::vector<bool>{false, true, true, false, true}));
    QCOMPARE(m_leases.find(1)->name, QString("Anna"));
    QCOMPARE(m_leases.find(1)->state(), qplc::messages::LeaseState::Held);
}

void tst_Leases::newLeaseReplacesTheHolder()
{
    m_leases.take({1, 2}, anna(), "Anna", 100, 1000);
    m_leases.take({2}, bert(), "Bert", 500, 1050);
    QVERIFY(m_leases.signalsOf(anna()) == Leases::Signals{1});
    QVERIFY(m_leases.isHeldBy(2, bert()));
    QVERIFY(m_leases.loseAllOf(anna()) == Leases::Signals{1});
    QVERIFY(m_leases.isHeldBy(2, bert()));
    QCOMPARE(m_leases.find(2)->term->deadline(), std::int64_t(1550));
}

void tst_Leases::releasedSignalHasNoHolder()
{
    m_leases.take({1, 2}, anna(), "Anna", 100, 1000);
    m_leases.release({2});
    QVERIFY(!m_leases.find(2));
    QVERIFY(m_leases.mask() == (std::vector<bool>{false, true}));
}

void tst_Leases::silentHolderLosesItsLeaseAtTheDeadline()
{
    m_leases.take({1}, anna(), "Anna", 100, 1000);
    QVERIFY(m_leases.loseSilent(1099).empty());
    QVERIFY(m_leases.isHeldBy(1, anna()));
    QVERIFY(m_leases.loseSilent(1100) == Leases::Signals{1});
    QVERIFY(m_leases.find(1)->isLost());
    QVERIFY(m_leases.loseSilent(5000).empty());  // once is enough
}

void tst_Leases::everyMessageOfTheHolderRenewsAllItsLeases()
{
    m_leases.take({1}, anna(), "Anna", 100, 1000);
    m_leases.take({2}, anna(), "Anna", 300, 1000);
    m_leases.take({3}, bert(), "Bert", 100, 1000);
    m_leases.renew(anna(), 1090);
    QVERIFY(m_leases.loseSilent(1189) == Leases::Signals{3});
    QVERIFY(m_leases.loseSilent(1190) == Leases::Signals{1});
    m_leases.renew(anna(), 1200);  // what is lost stays lost
    QVERIFY(m_leases.find(1)->isLost());
    QVERIFY(m_leases.loseSilent(1500) == Leases::Signals{2});
}

void tst_Leases::messageAtTheDeadlineRenewsNothing()
{
    m_leases.take({1}, anna(), "Anna", 100, 1000);
    m_leases.renew(anna(), 1100);
    QVERIFY(m_leases.loseSilent(1100) == Leases::Signals{1});
}

void tst_Leases::leaseThatACycleHasEndedIsNotRenewed()
{
    m_leases.take({1}, anna(), "Anna", 100, 1000);
    LeaseTerm &term = *m_leases.terms().at(0).term;
    QVERIFY(!term.end(1099) && !term.hasEnded());
    QVERIFY(term.end(1100) && term.hasEnded());
    QVERIFY(!term.end(1200));      // once
    m_leases.renew(anna(), 1099);  // its message was read before, and the thread was busy since
    QVERIFY(term.hasEnded());
    QVERIFY(m_leases.loseSilent(1099) == Leases::Signals{1});
}

void tst_Leases::lostHolderLosesItsOwnLeasesOnce()
{
    m_leases.take({1, 3}, anna(), "Anna", 100, 1000);
    m_leases.take({2}, bert(), "Bert", 100, 1000);
    QVERIFY(m_leases.loseAllOf(anna()) == (Leases::Signals{1, 3}));
    QVERIFY(m_leases.loseAllOf(anna()).empty());
    QVERIFY(m_leases.isHeldBy(2, bert()));
}

void tst_Leases::lostLeaseHasNoHolderAndStaysInTheMask()
{
    m_leases.take({1}, anna(), "Anna", 100, 1000);
    m_leases.loseAllOf(anna());
    QVERIFY(!m_leases.isHeldBy(1, anna()) && !m_leases.isHeldBy(1, nullptr));
    QVERIFY(!m_leases.isHeldByOther(1, bert()));
    QVERIFY(m_leases.signalsOf(nullptr).empty());
    QVERIFY(m_leases.mask() == (std::vector<bool>{false, true}));
    QCOMPARE(m_leases.find(1)->state(), qplc::messages::LeaseState::Lost);
    QCOMPARE(m_leases.find(1)->name, QString("Anna"));
}

void tst_Leases::nextDeadlineIsTheEarliestOfAllHeldLeases()
{
    m_leases.take({1}, anna(), "Anna", 100, 1000);
    m_leases.take({2}, bert(), "Bert", 50, 1000);
    QCOMPARE(*m_leases.nextDeadline(), std::int64_t(1050));
    m_leases.loseSilent(1050);
    QCOMPARE(*m_leases.nextDeadline(), std::int64_t(1100));
    m_leases.loseSilent(1100);
    QVERIFY(!m_leases.nextDeadline());
}

QTEST_APPLESS_MAIN(tst_Leases)
#include "tst_Leases.moc"
