// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "WindowFixtures.h"
#include "gui/layout/LayoutJson.h"
#include "gui/window/DefaultLayout.h"
#include "gui/window/DoubleEscape.h"
#include "gui/window/FuzzyMatch.h"
#include "gui/window/RecentRecordings.h"
#include "gui/window/RecorderNotice.h"

#include <QtCore/QJsonArray>

using namespace qplc;

namespace {

/// \param time  as QInputEvent::timestamp() [ms]
void pressEscape(QWidget *widget, ulong time)
{
    for (const QEvent::Type type : {QEvent::KeyPress, QEvent::KeyRelease}) {
        QKeyEvent event(type, Qt::Key_Escape, Qt::NoModifier);
        event.setTimestamp(time);
        QCoreApplication::sendEvent(widget, &event);
    }
}

}  // namespace

class tst_WindowParts : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void fuzzySearchMatchesLettersInOrder();
    void fuzzySearchPrefersRunsAndWordStarts();
    void thePaletteShowsTheBestFirstAndNotTooMany();
    void addressesAreValidatedBeforeConnecting();
    void recentMastersAreLimitedAndNewestFirst();
    void recentRecordingsAreLimitedAndNewestFirst();
    void doublePressOfEscapeIsDetectedAndASinglePressIsNot();
    void slowlyHandledEscapeCountsOnce_data();
    void slowlyHandledEscapeCountsOnce();
    void escapeTwiceIsJudgedByWhenItWasPressed();
    void invalidLayoutIsRefusedWithTheErrorPosition();
    void theFirstLayoutIsTheDefault();
    void theDefaultLayoutHasSignalsAndRealTime();
    void droppedSignalsBecomeAPlotAtTheZone();
    void timeSpansHaveReadableUnits();
    void violationsAreNewForTenSeconds();
    void barShowsDelayAndLossOfTheLink();
    void barShowsTheConditionOfAPlant();
    void barShowsTheRecorder_data();
    void barShowsTheRecorder();

private:
    std::unique_ptr<TestSettings> m_settings;
};

void tst_WindowParts::fuzzySearchMatchesLettersInOrder()
{
    QVERIFY(fuzzyScore(QStringLiteral("tsp"), QStringLiteral("tetherSpeed")) > 0);
    QVERIFY(fuzzyScore(QStringLiteral("SPEED teth"), QStringLiteral("tetherSpeed")) > 0);
    QVERIFY(fuzzyScore(QStringLiteral("spt"), QStringLiteral("tetherSpeed")) < 0);
    QVERIFY(fuzzyScore(QStringLiteral("x"), QString()) < 0);
    QCOMPARE(fuzzyScore(QString(), QStringLiteral("anything")), 0);
    QCOMPARE(fuzzyScore(QStringLiteral("  "), QString()), 0);
    QVERIFY(fuzzyScore(QString(200, QLatin1Char('a')), QStringLiteral("aaa")) < 0);
}

void tst_WindowParts::fuzzySearchPrefersRunsAndWordStarts()
{
    const QString pattern = QStringLiteral("sp");
    const auto score = [&](const char *text) { return fuzzyScore(pattern, QString::fromLatin1(text)); };
    QVERIFY(score("speed") > score("tetherSpeed"));
    QVERIFY(score("tetherSpeed") > score("crisp"));
    QVERIFY(score("crisp") > score("asepsis"));
    QVERIFY(score("speed") > score("speed of the tether"));
    QVERIFY(fuzzyScore("large", "Large targets for touch") > fuzzyScore("large", "Larger values"));  // a whole word
}

void tst_WindowParts::thePaletteShowsTheBestFirstAndNotTooMany()
{
    QVector<PaletteItem> items;
    for (const char *text : {"Add panel: Time plot", "Stop", "Start", "Restart", "winch.start"})
        items.append({QString::fromLatin1(text), {}, {}, [] {}});
    QCOMPARE(CommandPalette::matches(items, QStringLiteral("start"), 10), (QVector<int>{2, 4, 3}));
    QCOMPARE(CommandPalette::matches(items, QString(), 2), (QVector<int>{0, 1}));
    QVERIFY(CommandPalette::matches(items, QStringLiteral("zzz"), 10).isEmpty());
    QVERIFY(CommandPalette::matches({}, QStringLiteral("start"), 10).isEmpty());
}

void tst_WindowParts::addressesAreValidatedBeforeConnecting()
{
    for (const char *good :
         {"127.0.0.1:50000", "qtplc://127.0.0.1:1", "[::1]:50000", "winch.local", "udp://10.0.0.1:3", "localhost"})
        QCOMPARE(ConnectStrip::errorOf(QString::fromLatin1(good)), QString());
    for (const char *bad : {"", "   ", "127.0.0.1:0", "127.0.0.1:70000", "127.0.0.1:kite"})
        QVERIFY2(!ConnectStrip::errorOf(QString::fromLatin1(bad)).isEmpty(), bad);
}

void tst_WindowParts::recentMastersAreLimitedAndNewestFirst()
{
    RecentMasters recent;
    QVERIFY(recent.addresses().isEmpty());
    for (int i = 0; i < 12; ++i)
        recent.add(QString::number(i));
    recent.add(QStringLiteral("9"));
    QCOMPARE(recent.addresses().size(), 8);
    QCOMPARE(recent.addresses().mid(0, 3),
             (QStringList{QStringLiteral("9"), QStringLiteral("11"), QStringLiteral("10")}));
}

void tst_WindowParts::recentRecordingsAreLimitedAndNewestFirst()
{
    RecentRecordings recent;
    QVERIFY(recent.all().isEmpty());
    for (int i = 0; i < 12; ++i)
        recent.add({QStringLiteral("/flights/%1.mcap").arg(i)});
    recent.add({QStringLiteral("/a.mcap"), QStringLiteral("/b.mcap")});
    recent.add({QStringLiteral("/flights/9.mcap")});
    const QVector<QStringList> all = recent.all();
    QCOMPARE(all.size(), 8);
    QCOMPARE(all.at(0), QStringList{QStringLiteral("/flights/9.mcap")});
    QCOMPARE(all.at(1), (QStringList{QStringLiteral("/a.mcap"), QStringLiteral("/b.mcap")}));
    QCOMPARE(all.at(2), QStringList{QStringLiteral("/flights/11.mcap")});
    QCOMPARE(RecentRecordings::textOf(all.at(0)), QStringLiteral("9.mcap"));
    QCOMPARE(RecentRecordings::textOf(all.at(1)), QStringLiteral("a.mcap and 1 more"));
}

void tst_WindowParts::doublePressOfEscapeIsDetectedAndASinglePressIsNot()
{
    DoubleEscape escape;
    QSignalSpy pressed(&escape, &DoubleEscape::pressed);
    QWidget parent;
    QWidget child(&parent);  // one press reaches both
    parent.show();
    const auto press = [&](Qt::Key key) { QTest::keyClick(&child, key, Qt::NoModifier, 40); };
    press(Qt::Key_Escape);
    QCOMPARE(pressed.count(), 0);
    press(Qt::Key_Escape);
    QTRY_COMPARE(pressed.count(), 1);
    press(Qt::Key_Escape);
    QCOMPARE(pressed.count(), 1);
    press(Qt::Key_A);  // something else in between
    press(Qt::Key_Escape);
    QCOMPARE(pressed.count(), 1);
    QTest::qWait(650);  // too late
    press(Qt::Key_Escape);
    QCOMPARE(pressed.count(), 1);
}

void tst_WindowParts::slowlyHandledEscapeCountsOnce_data()
{
    QTest::addColumn<ulong>("time");
    QTest::newRow("of a keyboard") << 1000UL;
    QTest::newRow("of a program") << 0UL;
}

void tst_WindowParts::slowlyHandledEscapeCountsOnce()
{
    QFETCH(ulong, time);
    /// Whoever gets the key first takes his time.
    class Slow : public QWidget
    {
    public:
        using QWidget::QWidget;
        void keyPressEvent(QKeyEvent *event) override
        {
            QTest::qSleep(40);
            event->ignore();
        }
    };
    DoubleEscape escape;
    QSignalSpy pressed(&escape, &DoubleEscape::pressed);
    QWidget parent;
    Slow child(&parent);
    pressEscape(&child, time);
    QCOMPARE(pressed.count(), 0);
    pressEscape(&child, time == 0 ? 0 : time + 300);
    QTRY_COMPARE(pressed.count(), 1);
}

/// A window that was busy hears both presses at once, or the second one late.
void tst_WindowParts::escapeTwiceIsJudgedByWhenItWasPressed()
{
    DoubleEscape escape;
    QSignalSpy pressed(&escape, &DoubleEscape::pressed);
    QWidget widget;
    pressEscape(&widget, 1000);
    pressEscape(&widget, 3000);
    QCOMPARE(pressed.count(), 0);
    pressEscape(&widget, 3500);
    QTRY_COMPARE(pressed.count(), 1);
}

void tst_WindowParts::invalidLayoutIsRefusedWithTheErrorPosition()
{
    LayoutEditor editor;
    LayoutShelf shelf(&editor);
    const QByteArray before = layoutToJson(editor.layout());
    QString error;
    QVERIFY(!shelf.add(QStringLiteral("Fly"), "{\n  \"version\": 1,\n  oops }", &error));
    QVERIFY2(error.startsWith(QLatin1String("Fly:3:")), qPrintable(error));
    QVERIFY(!shelf.open(QStringLiteral("/nowhere/layout.json"), &error));
    QVERIFY2(error.contains(QLatin1String("/nowhere/layout.json")), qPrintable(error));
    QVERIFY(!shelf.show(QStringLiteral("Fly")));
    QCOMPARE(layoutToJson(editor.layout()), before);
    QVERIFY(shelf.names().isEmpty());
}

void tst_WindowParts::theFirstLayoutIsTheDefault()
{
    Layout fly;
    fly.addPanel(QStringLiteral("Gauge"), {}, LayoutTarget::inTab(fly.currentTab().id));
    LayoutEditor editor;
    LayoutShelf shelf(&editor);
    QVERIFY(shelf.add(QStringLiteral("Fly"), layoutToJson(fly), nullptr));
    QVERIFY(shelf.add(QStringLiteral("Empty"), layoutToJson(Layout()), nullptr));
    QCOMPARE(layoutToJson(editor.layout()), layoutToJson(fly));  // shown, because nothing else was yet
    QVERIFY(shelf.show(QStringLiteral("Empty")));
    shelf.reset();
    QCOMPARE(layoutToJson(editor.layout()), layoutToJson(fly));
    editor.undoStack()->undo();
    QCOMPARE(layoutToJson(editor.layout()), layoutToJson(Layout()));
}

void tst_WindowParts::theDefaultLayoutHasSignalsAndRealTime()
{
    const Layout layout = defaultLayout();
    QCOMPARE(layout.invariantError(), QString());
    QStringList types;
    for (const LayoutPanel *panel : layout.panels())
        types.append(panel->type);
    QCOMPARE(types.join(QStringLiteral(", ")),
             QStringLiteral("Value table, Time plot, Node table, Jitter histogram, Event log"));
    QCOMPARE(layout.currentTab().name, QStringLiteral("Signals"));
}

void tst_WindowParts::droppedSignalsBecomeAPlotAtTheZone()
{
    DummyFactories factories;
    LayoutEditor editor;
    LayoutView view(&editor);
    view.setFactories(factories.all());
    SignalPlacer placer(&view);
    const QStringList signal{QStringLiteral("kite.elevation")};
    placer.drop(QString(), DropZone::Center, signal);
    const auto panels = [&] { return editor.layout().panels(); };
    QCOMPARE(int(panels().size()), 1);
    QCOMPARE(panels()[0]->type, QStringLiteral("Time plot"));
    const QJsonArray curves = panels()[0]->settings.value(QStringLiteral("curves")).toArray();
    QCOMPARE(curves.at(0).toObject().value(QStringLiteral("signal")).toString(), signal.first());
    const QString first = panels()[0]->id;
    placer.drop(first, DropZone::Left, signal);
    QCOMPARE(panels()[1]->id, first);              // the new one stands at its left
    placer.drop(first, DropZone::Center, signal);  // the dummy has no use for signals
    QCOMPARE(int(panels().size()), 3);
    placer.drop(first, DropZone::Center, {});
    QCOMPARE(int(panels().size()), 3);
    placer.show({QStringLiteral("a"), QStringLiteral("b")}, QStringLiteral("Gauge"));
    QCOMPARE(int(panels().size()), 5);
    for (int step = 0; step < 5; ++step)
        editor.undoStack()->undo();
    QVERIFY(panels().empty());
}

void tst_WindowParts::timeSpansHaveReadableUnits()
{
    QCOMPARE(spanText(200'000), QStringLiteral("0.2 ms"));
    QCOMPARE(spanText(30'000'000'000), QStringLiteral("30 s"));
    QCOMPARE(spanText(120'000'000'000), QStringLiteral("2 min"));
    QCOMPARE(spanText(7'200'000'000'000), QStringLiteral("2 h"));
}

void tst_WindowParts::violationsAreNewForTenSeconds()
{
    ViolationWatch watch;
    QCOMPARE(watch.text(), QStringLiteral("0 violations"));
    watch.take(5, 1000);  // of before the window came
    QCOMPARE(watch.recent(), quint64(0));
    QCOMPARE(watch.text(), QStringLiteral("5 violations"));
    watch.take(5, 2000);
    watch.take(6, 2250);
    QCOMPARE(watch.text(), QStringLiteral("1 violation in 10 s"));
    watch.take(9, 8000);
    QCOMPARE(watch.text(), QStringLiteral("4 violations in 10 s"));
    watch.take(9, 12'000);
    QCOMPARE(watch.recent(), quint64(4));
    watch.take(9, 12'400);  // the first one was 10.15 s ago
    QCOMPARE(watch.recent(), quint64(3));
    watch.take(9, 18'300);
    QCOMPARE(watch.text(), QStringLiteral("9 violations"));
    watch.take(2, 18'500);  // another phase
    QCOMPARE(watch.text(), QStringLiteral("2 violations"));
    watch.take(2, 1'000'000);
    QCOMPARE(watch.total(), quint64(2));
}

void tst_WindowParts::barShowsDelayAndLossOfTheLink()
{
    QCOMPARE(linkText(164e3, 0), QStringLiteral("link 164 µs"));
    QCOMPARE(linkText(12.3e6, 7), QStringLiteral("link 12.3 ms, 7 lost"));
    RunningMaster master;
    PlantList plants;
    Plant *plant = plants.add(master.address(), QStringLiteral("kite"), QStringLiteral("Window"));
    QVERIFY(!plant->ownNode());
    QTRY_VERIFY(plant->ownNode());
    QVERIFY(plant->ownNode()->info.listener);
    QCOMPARE(plant->ownNode()->info.name, QStringLiteral("Window"));
}

void tst_WindowParts::barShowsTheConditionOfAPlant()
{
    QCOMPARE(StateStep::of(nullptr, false).step, StateStep::None);
    PlantList plants;
    Plant *nobody = plants.add(QStringLiteral("127.0.0.1:%1").arg(freePort()));
    QTRY_VERIFY(nobody->nextAttempt() >= 0.0);
    QVERIFY2(PlantSummary::of(*nobody).condition.startsWith(QLatin1String("not there; next attempt in ")),
             qPrintable(PlantSummary::of(*nobody).condition));
    RunningMaster master;
    Plant *plant = plants.add(master.address());
    QTRY_COMPARE(PlantSummary::of(*plant).condition, QStringLiteral("at rest"));
    QCOMPARE(StateStep::of(plant, false).step, StateStep::Off);
    QCOMPARE(StateStep::of(plant, true).step, StateStep::Initialized);
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(PlantSummary::of(*plant).condition, QStringLiteral("live"));
    QTRY_COMPARE(StateStep::of(plant, false).step, StateStep::RealTime);
    QTRY_VERIFY2(QRegularExpression(QStringLiteral("^Plant · 100 Hz · jitter .+ p99 · \\d+ violations?"))
                     .match(PlantSummary::of(*plant).figures)
                     .hasMatch(),
                 qPrintable(PlantSummary::of(*plant).figures));
}

void tst_WindowParts::barShowsTheRecorder_data()
{
    using messages::RecorderState;
    QTest::addColumn<int>("state");
    QTest::addColumn<int>("missing");
    QTest::addColumn<QString>("text");
    QTest::addColumn<int>("tone");
    const auto add = [](const char *name, RecorderState state, int missing, const char *text, Tone tone) {
        QTest::newRow(name) << int(state) << missing << QString(text) << int(tone);
    };
    add("nobody", RecorderState::None, 0, "not recording", Tone::Calm);
    add("all is well", RecorderState::Recording, 0, "14 kB/s", Tone::Calm);
    add("cycles are missing", RecorderState::Recording, 7, "7 missing", Tone::Warning);
    add("full disk", RecorderState::DiskFull, 0, "disk full", Tone::Alarm);
    add("other error", RecorderState::Failing, 0, "write error", Tone::Alarm);
    add("stalled", RecorderState::Stalled, 0, "stalled", Tone::Warning);
    add("killed", RecorderState::Gone, 0, "recorder gone", Tone::Alarm);
    add("stopped by somebody", RecorderState::Stopped, 0, "stopped", Tone::Calm);
    add("a word of a newer master", RecorderState::Unknown, 0, "", Tone::Calm);
}

void tst_WindowParts::barShowsTheRecorder()
{
    QFETCH(int, state);
    QFETCH(int, missing);
    QFETCH(QString, text);
    QFETCH(int, tone);
    messages::RecorderEntry recorder;
    recorder.state = messages::RecorderState(state);
    recorder.missing = quint64(missing);
    recorder.bytesPerSecond = 14'100;
    recorder.file = "/recordings/kite.mcap.part";
    const RecorderSummary summary = RecorderSummary::of(recorder);
    QCOMPARE(summary.text, text);
    QCOMPARE(int(summary.tone), tone);
    QCOMPARE(summary.isRecording, recorder.state == messages::RecorderState::Recording);
    QCOMPARE(summary.more.contains("kite.mcap"), !text.isEmpty());
}

QTEST_MAIN(tst_WindowParts)
#include "tst_WindowParts.moc"
