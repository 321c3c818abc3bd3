// SPDX-License-Identifier: Apache-2.0
#include "QPlcTimeAxis.h"

#include <QtTest/QtTest>

using Time = QPlcTimeAxis::Time;

namespace {
constexpr Time s = 1'000'000'000;
}

class tst_QPlcTimeAxis : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void init();
    void aLiveViewEndsWithTheNewestValues();
    void whoeverPansOrShowsOrJumpsFreezes();
    void aFrozenViewStaysWhereItIsAndSaysHowFarBehindItIs();
    void goingLiveComesBackToTheNewestValues();
    void zoomingAboutTheRightEdgeStaysLive();
    void zoomingKeepsTheTimeBelowTheMouse();
    void spansHaveLimits();
    void liveNobodyHasToLookAtAnotherTime();
    void frozenTheDisplayedTimeIsThatOfThePointerOrTheRightEdge();
    void withoutAPointerTheDisplayedTimeIsThatOfThePlayhead();
    void aPlayheadOutsideOfTheViewMovesIt();
    void theDisplayedTimeOfAViewIntoTheFutureGoesOn();
    void beforeTheFirstValuesAnyTimeCanBeLookedAt();
    void goingLiveForgetsThePointer();
    void nothingIsToldTwice();
    void theNewestTimeGoesBackWhenValuesAreGone();

private:
    std::unique_ptr<QPlcTimeAxis> m_view;
};

void tst_QPlcTimeAxis::init()
{
    m_view = std::make_unique<QPlcTimeAxis>();
    m_view->setSpan(10 * s);
    m_view->setNewest(100 * s);
}

void tst_QPlcTimeAxis::aLiveViewEndsWithTheNewestValues()
{
    QVERIFY(m_view->isLive());
    QCOMPARE(m_view->end(), 100 * s);
    QCOMPARE(m_view->begin(), 90 * s);
    m_view->setNewest(101 * s);
    QCOMPARE(m_view->end(), 101 * s);
    QCOMPARE(m_view->behind(), 0 * s);
}

void tst_QPlcTimeAxis::whoeverPansOrShowsOrJumpsFreezes()
{
    m_view->pan(-3 * s);
    QVERIFY(!m_view->isLive());
    QCOMPARE(m_view->end(), 97 * s);
    m_view->goLive();
    m_view->show(20 * s, 25 * s);
    QVERIFY(!m_view->isLive());
    QCOMPARE(m_view->begin(), 20 * s);
    QCOMPARE(m_view->span(), 5 * s);
    m_view->goLive();
    m_view->jumpTo(50 * s);
    QVERIFY(!m_view->isLive());
    QCOMPARE((m_view->begin() + m_view->end()) / 2, 50 * s);
}

void tst_QPlcTimeAxis::aFrozenViewStaysWhereItIsAndSaysHowFarBehindItIs()
{
    m_view->freeze();
    m_view->setNewest(112 * s);
    QCOMPARE(m_view->end(), 100 * s);
    QCOMPARE(m_view->behind(), 12 * s);
}

void tst_QPlcTimeAxis::goingLiveComesBackToTheNewestValues()
{
    m_view->show(0, 5 * s);
    m_view->setNewest(120 * s);
    m_view->goLive();
    QCOMPARE(m_view->end(), 120 * s);
    QCOMPARE(m_view->span(), 5 * s);
}

void tst_QPlcTimeAxis::zoomingAboutTheRightEdgeStaysLive()
{
    m_view->zoom(0.5, m_view->end());
    QVERIFY(m_view->isLive());
    QCOMPARE(m_view->span(), 5 * s);
}

void tst_QPlcTimeAxis::zoomingKeepsTheTimeBelowTheMouse()
{
    m_view->zoom(0.5, 92 * s);
    QVERIFY(!m_view->isLive());
    QCOMPARE(m_view->span(), 5 * s);
    QCOMPARE(m_view->begin(), 91 * s);
    m_view->zoom(2.0, 92 * s);
    QCOMPARE(m_view->begin(), 90 * s);
    QCOMPARE(m_view->end(), 100 * s);
}

void tst_QPlcTimeAxis::spansHaveLimits()
{
    m_view->setSpan(240 * 3600 * s);
    QCOMPARE(m_view->span(), 240 * 3600 * s);  // ten days
    m_view->setSpan(-5);
    QCOMPARE(m_view->span(), QPlcTimeAxis::shortestSpan);
    m_view->zoom(1e30, 0);
    QCOMPARE(m_view->span(), QPlcTimeAxis::longestSpan);
    m_view->zoom(std::numeric_limits<double>::quiet_NaN(), 0);
    QVERIFY(m_view->span() >= QPlcTimeAxis::shortestSpan);
    m_view->zoom(-1e300, 0);
    QCOMPARE(m_view->span(), QPlcTimeAxis::shortestSpan);
}

void tst_QPlcTimeAxis::liveNobodyHasToLookAtAnotherTime()
{
    m_view->setPointer(95 * s);
    QVERIFY(!m_view->displayTime());
}

void tst_QPlcTimeAxis::withoutAPointerTheDisplayedTimeIsThatOfThePlayhead()
{
    QSignalSpy heads(m_view.get(), &QPlcTimeAxis::playheadChanged);
    m_view->show(20 * s, 30 * s);
    m_view->setPlayhead(25 * s);
    QCOMPARE(m_view->displayTime().value_or(0), 25 * s);
    QCOMPARE(m_view->begin(), 20 * s);
    m_view->setPointer(22 * s);
    QCOMPARE(m_view->displayTime().value_or(0), 22 * s);
    m_view->setPointer(std::nullopt);
    m_view->setPlayhead(25 * s);
    QCOMPARE(heads.size(), 1);
    m_view->setPlayhead(std::nullopt);
    QCOMPARE(m_view->displayTime().value_or(0), 30 * s);
    m_view->goLive();
    m_view->setPlayhead(95 * s);
    QVERIFY(!m_view->isLive());
}

void tst_QPlcTimeAxis::aPlayheadOutsideOfTheViewMovesIt()
{
    m_view->show(20 * s, 30 * s);
    for (const Time time : {31 * s, 19 * s, 90 * s}) {
        m_view->setPlayhead(time);
        QVERIFY(m_view->begin() <= time && time <= m_view->end());
        QCOMPARE(m_view->span(), 10 * s);
    }
}

void tst_QPlcTimeAxis::theDisplayedTimeOfAViewIntoTheFutureGoesOn()
{
    m_view->jumpTo(100 * s);
    QSignalSpy changes(m_view.get(), &QPlcTimeAxis::displayTimeChanged);
    m_view->setNewest(101 * s);
    QCOMPARE(*m_view->displayTime(), 101 * s);
    QCOMPARE(changes.count(), 1);
    m_view->setPointer(50 * s);
    m_view->setNewest(102 * s);
    QCOMPARE(changes.count(), 2);
}

void tst_QPlcTimeAxis::beforeTheFirstValuesAnyTimeCanBeLookedAt()
{
    m_view->setNewest(0);
    m_view->show(40 * s, 50 * s);
    QCOMPARE(*m_view->displayTime(), 50 * s);
}

void tst_QPlcTimeAxis::frozenTheDisplayedTimeIsThatOfThePointerOrTheRightEdge()
{
    QSignalSpy changes(m_view.get(), &QPlcTimeAxis::displayTimeChanged);
    m_view->freeze();
    QCOMPARE(*m_view->displayTime(), 100 * s);
    m_view->setPointer(95 * s);
    QCOMPARE(*m_view->displayTime(), 95 * s);
    m_view->setPointer(105 * s);
    QCOMPARE(*m_view->displayTime(), 100 * s);
    m_view->goLive();
    QVERIFY(!m_view->displayTime());
    QCOMPARE(changes.count(), 4);
}

/// It is that of an event, say, which the view was at.
void tst_QPlcTimeAxis::goingLiveForgetsThePointer()
{
    m_view->jumpTo(50 * s);
    m_view->setPointer(50 * s);
    QSignalSpy pointers(m_view.get(), &QPlcTimeAxis::pointerChanged);
    m_view->goLive();
    QVERIFY(!m_view->pointer());
    QCOMPARE(pointers.count(), 1);
    m_view->setPointer(95 * s);  // a mouse
    m_view->setSpan(5 * s);
    QVERIFY(m_view->pointer());
}

void tst_QPlcTimeAxis::nothingIsToldTwice()
{
    QSignalSpy views(m_view.get(), &QPlcTimeAxis::viewChanged);
    QSignalSpy cursors(m_view.get(), &QPlcTimeAxis::cursorsChanged);
    m_view->goLive();
    m_view->setSpan(10 * s);
    m_view->freeze();
    m_view->freeze();
    QCOMPARE(views.count(), 1);
    m_view->setCursor(QPlcTimeAxis::A, 5 * s);
    m_view->setCursor(QPlcTimeAxis::A, 5 * s);
    m_view->setCursor(QPlcTimeAxis::B, std::nullopt);
    QCOMPARE(cursors.count(), 1);
}

void tst_QPlcTimeAxis::theNewestTimeGoesBackWhenValuesAreGone()
{
    m_view->setNewest(50 * s);
    QCOMPARE(m_view->end(), 50 * s);
    m_view->freeze();
    m_view->setNewest(0);
    QCOMPARE(m_view->end(), 50 * s);
    QCOMPARE(m_view->behind(), 0 * s);
}

QTEST_GUILESS_MAIN(tst_QPlcTimeAxis)
#include "tst_QPlcTimeAxis.moc"
