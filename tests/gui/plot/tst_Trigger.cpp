// SPDX-License-Identifier: Apache-2.0
#include "gui/plot/Trigger.h"

#include <QtTest/QtTest>

#include <cmath>

using namespace qplc;
using Time = Trigger::Time;
using Times = std::vector<Time>;

namespace {
constexpr Time s = 1'000'000'000;
const float nothing = std::numeric_limits<float>::quiet_NaN();
}  // namespace

class tst_Trigger : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void init();
    void everyKindDetectsItsEvents_data();
    void everyKindDetectsItsEvents();
    void anEventIsWhereTheLineMeetsTheLevel();
    void hysteresisLeavesNoiseAlone();
    void firstValueIsNotAnEdge();
    void noEventIsSeenAcrossAnInterruption();
    void noEventIsSeenAcrossNan();
    void rowsBeforeArmingAreIgnored();
    void overwrittenRowsAreAnInterruption();
    void eventsWithinTheHoldOffAreIgnored();
    void theViewHasItsShareBeforeTheEvent();
    void viewIsKeptUntilItIsComplete();
    void singleShowsOneEventUntilItIsArmedAgain();
    void normalShowsTheLastEventForEver();
    void autoModeRunsFreeAfterADelayUntilTheNextEvent();
    void oldEventsAreForgottenAndCounted();
    void settingsAreRestoredUnchanged();
    void invalidSettingsAreCorrected();

private:
    void feed(const std::vector<float> &values);
    Trigger::Settings settings(Trigger::Kind kind, double level = 0.5) const;

    std::unique_ptr<SignalStore> m_store;
    Trigger m_trigger;
    Time m_now = 0;
};

void tst_Trigger::init()
{
    m_store = std::make_unique<SignalStore>(1, 100'000);
    m_trigger = Trigger();
    m_trigger.setSpan(10 * s);
    m_now = 0;
    m_trigger.take(*m_store, 0);
}

/// A row a second.
void tst_Trigger::feed(const std::vector<float> &values)
{
    for (const float value : values)
        m_store->append(m_now += s, &value);
    m_trigger.take(*m_store, 0);
}

Trigger::Settings tst_Trigger::settings(Trigger::Kind kind, double level) const
{
    Trigger::Settings settings;
    settings.kind = kind;
    settings.level = level;
    settings.mode = Trigger::Normal;
    return settings;
}

void tst_Trigger::everyKindDetectsItsEvents_data()
{
    QTest::addColumn<int>("kind");
    QTest::addColumn<Times>("events");
    // 0 0 2 2 0 4 2 0, level 1, window 1 ... 3
    QTest::newRow("rising") << int(Trigger::RisingEdge) << Times{5 * s / 2, 21 * s / 4};
    QTest::newRow("falling") << int(Trigger::FallingEdge) << Times{9 * s / 2, 15 * s / 2};
    QTest::newRow("either") << int(Trigger::EitherEdge) << Times{5 * s / 2, 9 * s / 2, 21 * s / 4, 15 * s / 2};
    QTest::newRow("above") << int(Trigger::AboveLevel) << Times{5 * s / 2, 4 * s, 21 * s / 4, 7 * s};
    QTest::newRow("below") << int(Trigger::BelowLevel) << Times{1 * s, 2 * s, 9 * s / 2, 15 * s / 2};
    QTest::newRow("enters") << int(Trigger::EntersWindow) << Times{5 * s / 2, 13 * s / 2};
    QTest::newRow("leaves") << int(Trigger::LeavesWindow) << Times{9 * s / 2, 15 * s / 2};
}

void tst_Trigger::everyKindDetectsItsEvents()
{
    QFETCH(int, kind);
    QFETCH(Times, events);
    Trigger::Settings wanted = settings(Trigger::Kind(kind), 1.0);
    wanted.upperLevel = 3.0;
    m_trigger.setSettings(wanted);
    feed({0, 0, 2, 2, 0, 4, 2, 0});
    QCOMPARE(m_trigger.events(), events);
    QCOMPARE(m_trigger.count(), std::uint64_t(events.size()));
}

void tst_Trigger::anEventIsWhereTheLineMeetsTheLevel()
{
    m_trigger.setSettings(settings(Trigger::RisingEdge, 2.5));
    feed({0, 10});
    QCOMPARE(m_trigger.events(), (Times{s + s / 4}));
    m_trigger.setSettings(settings(Trigger::RisingEdge, 20.0));
    feed({0, 20});
    QCOMPARE(m_trigger.events().back(), 4 * s);
}

void tst_Trigger::hysteresisLeavesNoiseAlone()
{
    Trigger::Settings wanted = settings(Trigger::RisingEdge);
    wanted.hysteresis = 0.3;
    m_trigger.setSettings(wanted);
    feed({0.0F, 0.6F, 0.4F, 0.6F, 0.3F, 0.7F});
    QCOMPARE(m_trigger.count(), std::uint64_t(1));
    feed({0.1F, 0.6F});
    QCOMPARE(m_trigger.count(), std::uint64_t(2));
}

void tst_Trigger::firstValueIsNotAnEdge()
{
    m_trigger.setSettings(settings(Trigger::EitherEdge));
    feed({1, 1, 1});
    QCOMPARE(m_trigger.count(), std::uint64_t(0));
    QVERIFY(!m_trigger.view());
}

void tst_Trigger::noEventIsSeenAcrossAnInterruption()
{
    m_trigger.setSettings(settings(Trigger::RisingEdge));
    feed({0});
    m_store->interrupt();
    feed({1, 1});
    QCOMPARE(m_trigger.count(), std::uint64_t(0));
    feed({0, 1});
    QCOMPARE(m_trigger.count(), std::uint64_t(1));
}

void tst_Trigger::noEventIsSeenAcrossNan()
{
    m_trigger.setSettings(settings(Trigger::RisingEdge));
    feed({0, nothing, 1});
    QCOMPARE(m_trigger.count(), std::uint64_t(0));
}

void tst_Trigger::rowsBeforeArmingAreIgnored()
{
    m_trigger.setSettings(settings(Trigger::RisingEdge));
    feed({0});
    m_trigger.arm();
    const float one = 1;
    m_store->append(m_now += s, &one);
    m_trigger.take(*m_store, 0);
    QCOMPARE(m_trigger.count(), std::uint64_t(0));
    feed({0, 1});
    QCOMPARE(m_trigger.count(), std::uint64_t(1));
}

void tst_Trigger::overwrittenRowsAreAnInterruption()
{
    m_store = std::make_unique<SignalStore>(1, 16);
    m_trigger.arm();
    m_trigger.setSettings(settings(Trigger::RisingEdge));
    m_trigger.take(*m_store, 0);
    feed({0});
    feed(std::vector<float>(40, 1.0F));
    QCOMPARE(m_trigger.count(), std::uint64_t(0));
}

void tst_Trigger::eventsWithinTheHoldOffAreIgnored()
{
    Trigger::Settings wanted = settings(Trigger::RisingEdge);
    wanted.holdOff = 4.0;
    m_trigger.setSettings(wanted);
    feed({0, 1, 0, 1, 0, 1, 0, 1});
    QCOMPARE(m_trigger.events(), (Times{3 * s / 2, 11 * s / 2}));
}

void tst_Trigger::theViewHasItsShareBeforeTheEvent()
{
    Trigger::Settings wanted = settings(Trigger::RisingEdge, 1.0);
    wanted.preShare = 0.25;
    m_trigger.setSettings(wanted);
    feed({0, 1});
    QCOMPARE(m_trigger.state(), Trigger::Triggered);
    QCOMPARE(*m_trigger.shownEvent(), 2 * s);
    QCOMPARE(m_trigger.view()->begin, 2 * s - 5 * s / 2);
    QCOMPARE(m_trigger.view()->end - m_trigger.view()->begin, 10 * s);
}

void tst_Trigger::viewIsKeptUntilItIsComplete()
{
    m_trigger.setSettings(settings(Trigger::RisingEdge, 1.0));  // 2 s before, 8 s after the event
    feed({0, 1, 0, 1});
    QCOMPARE(m_trigger.count(), std::uint64_t(2));
    QCOMPARE(*m_trigger.shownEvent(), 2 * s);
    feed({0, 0, 0, 0, 0});
    QCOMPARE(m_trigger.state(), Trigger::Triggered);
    feed({0});
    QCOMPARE(m_trigger.state(), Trigger::Armed);
    feed({1});
    QCOMPARE(*m_trigger.shownEvent(), 11 * s);
    QCOMPARE(m_trigger.state(), Trigger::Triggered);
}

void tst_Trigger::singleShowsOneEventUntilItIsArmedAgain()
{
    Trigger::Settings wanted = settings(Trigger::RisingEdge, 1.0);
    wanted.mode = Trigger::Single;
    m_trigger.setSettings(wanted);
    feed({0, 1});
    feed(std::vector<float>(20, 0.0F));
    QCOMPARE(m_trigger.state(), Trigger::Done);
    feed({0, 1, 0, 1});
    QCOMPARE(*m_trigger.shownEvent(), 2 * s);
    QCOMPARE(m_trigger.count(), std::uint64_t(1));
    m_trigger.arm();
    QCOMPARE(m_trigger.state(), Trigger::Armed);
    m_trigger.take(*m_store, 0);
    feed({0, 1});
    QCOMPARE(*m_trigger.shownEvent(), m_now);
}

void tst_Trigger::normalShowsTheLastEventForEver()
{
    m_trigger.setSettings(settings(Trigger::RisingEdge, 1.0));
    feed({0, 1});
    feed(std::vector<float>(1000, 0.0F));
    QCOMPARE(m_trigger.state(), Trigger::Armed);
    QCOMPARE(m_trigger.view()->begin, 0 * s);
}

void tst_Trigger::autoModeRunsFreeAfterADelayUntilTheNextEvent()
{
    Trigger::Settings wanted = settings(Trigger::RisingEdge, 1.0);
    wanted.mode = Trigger::Auto;
    m_trigger.setSettings(wanted);
    feed(std::vector<float>(10, 0.0F));
    QCOMPARE(m_trigger.state(), Trigger::Armed);
    feed({0, 0});
    QCOMPARE(m_trigger.state(), Trigger::FreeRunning);
    QVERIFY(!m_trigger.view());
    feed({1});
    QCOMPARE(m_trigger.state(), Trigger::Triggered);
    QVERIFY(m_trigger.view());
    feed(std::vector<float>(30, 0.0F));
    QCOMPARE(m_trigger.state(), Trigger::FreeRunning);
}

void tst_Trigger::oldEventsAreForgottenAndCounted()
{
    m_trigger.setSettings(settings(Trigger::RisingEdge, 1.0));
    for (int i = 0; i < 1500; ++i)
        feed({0, 1});
    QCOMPARE(m_trigger.count(), std::uint64_t(1500));
    QCOMPARE(m_trigger.events().size(), Trigger::mostEvents);
    QCOMPARE(m_trigger.events().back(), m_now);
}

void tst_Trigger::settingsAreRestoredUnchanged()
{
    QVERIFY(Trigger::Settings().toJson().isEmpty());
    Trigger::Settings all;
    all.kind = Trigger::LeavesWindow;
    all.level = -3.5;
    all.upperLevel = 7.25;
    all.hysteresis = 0.125;
    all.mode = Trigger::Single;
    all.preShare = 0.5;
    all.holdOff = 2.0;
    QVERIFY(Trigger::Settings::fromJson(all.toJson()) == all);
    QVERIFY(Trigger::Settings::fromJson({}) == Trigger::Settings());
}

void tst_Trigger::invalidSettingsAreCorrected()
{
    const auto mended
        = Trigger::Settings::fromJson({{"kind", "sideways"}, {"hysteresis", -1.0}, {"pre", 7.0}, {"holdOff", -2}});
    QCOMPARE(mended.kind, Trigger::RisingEdge);
    QCOMPARE(mended.hysteresis, 0.0);
    QCOMPARE(mended.preShare, 1.0);
    QCOMPARE(mended.holdOff, 0.0);
}

QTEST_GUILESS_MAIN(tst_Trigger)
#include "tst_Trigger.moc"
