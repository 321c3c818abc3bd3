// SPDX-License-Identifier: Apache-2.0
// A time plot with a trigger, with a real plant.
#include "../../common/Waiting.h"
#include "PlotFixtures.h"
#include "gui/charts/TriggerBar.h"

#include <QtCore/QDir>
#include <QtCore/QTemporaryDir>
#include <QtWidgets/QApplication>
#include <QtWidgets/QToolButton>

#include <qwt_scale_draw.h>

using namespace qplc;
using Time = QPlcTimeAxis::Time;

namespace {

constexpr Time s = 1'000'000'000;

QByteArray triggered(const QByteArray &more)
{
    return R"json({"curves":[{"signal":"= sin(count/5)","gain":2,"offset":1}],"span":1,"trigger":{"on":true,)json"
           R"json("pre":0.25,"signal":"= sin(count/5)")json"
        + more + "}}";
}

}  // namespace

class tst_PlotTrigger : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void keyTogglesTheTrigger();
    void settingsAreRestoredByteForByte();
    void anEventIsShownInThisPlotOnly();
    void timesAreMillisecondsAroundTheEvent();
    void linesAreAtTheEventAndTheLevel();
    void aLinkedTriggerMovesTheWindow();
    void hiddenPlotKeepsItsSingleEvent();
    void pannedViewStaysUntilTheNextEvent();
    void autoGoesBackToLiveWithoutEvents();
    void otherSettingsDoNotArmAgain();
    void everyEventIsSaved();
    void failureToSaveIsLogged();
    void triggerBarDoesNotWidenANarrowPlot();
};

void tst_PlotTrigger::keyTogglesTheTrigger()
{
    PlotWindow window(R"({"curves":[{"signal":"count"}]})");
    QSignalSpy edited(window.plot, &QPlcWidget::settingsEdited);
    window.plot->show();
    window.plot->activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(window.plot));
    window.plot->setFocus();
    window.time()->setSpan(5 * s);
    QTest::keyClick(window.plot, Qt::Key_T);
    QCOMPARE(window.settings(), QByteArray(R"({"curves":[{"signal":"count"}],"span":5,"trigger":{"on":true}})"));
    QVERIFY(window.part<TriggerBar>()->isVisible());
    QTest::keyClick(window.plot, Qt::Key_T);
    QCOMPARE(window.settings(), QByteArray(R"({"curves":[{"signal":"count"}]})"));
    QVERIFY(!window.part<TriggerBar>()->isVisible());
    QCOMPARE(edited.size(), 2);
}

void tst_PlotTrigger::settingsAreRestoredByteForByte()
{
    const QByteArray all = R"({"curves":[{"name":"n","signal":"count"}],"trigger":{"color":"red","holdOff":2,)"
                           R"("kind":"falling","level":3,"linked":true,"on":true,"signal":"sum"}})";
    PlotWindow window(all);
    QCOMPARE(window.settings(), all);
    Q_EMIT window.part<TriggerBar>()->settingsEdited();  // what it has is taken
    QCOMPARE(window.settings(), all);
}

void tst_PlotTrigger::anEventIsShownInThisPlotOnly()
{
    PlotWindow window(triggered(R"(,"mode":"normal","holdOff":0.5)"));
    QVERIFY(window.run(0.2));
    const Trigger &trigger = window.part<TriggerBar>()->trigger();
    QTRY_VERIFY(trigger.shownEvent());
    const Time event = *trigger.shownEvent();
    QTRY_VERIFY(std::abs(window.canvas()->begin() - (event - s / 4)) < s / 100);
    QVERIFY(std::abs(window.canvas()->end() - (event + 3 * s / 4)) < s / 100);
    QVERIFY(window.time()->isLive());
    QTRY_VERIFY(window.part<PlotLegend>()->entries().value(0).value.toDouble() != 0.0);  // not what is still to come
    QVERIFY(!window.canvas()->canvas()->findChild<QToolButton *>()->isVisible());
    QTRY_VERIFY(*trigger.shownEvent() > event);
    for (std::size_t i = 1; i < trigger.events().size(); ++i)
        QVERIFY(trigger.events()[i] - trigger.events()[i - 1] >= s / 2);
}

void tst_PlotTrigger::timesAreMillisecondsAroundTheEvent()
{
    PlotWindow window(triggered(R"(,"mode":"single")"));
    QVERIFY(window.run(0.2));
    QTRY_VERIFY(window.part<PlotOverlay>()->picture().event);
    const QwtScaleDraw *scale = window.canvas()->axisScaleDraw(QwtPlot::xBottom);
    QStringList labels;
    for (const double tick : scale->scaleDiv().ticks(QwtScaleDiv::MajorTick))
        labels << scale->label(tick).text();
    QVERIFY2(labels.contains(QStringLiteral("0")) && labels.last().endsWith(QStringLiteral("00 ms")),
             qPrintable(labels.join(' ')));
    window.trigger("live");
    QTRY_VERIFY(!window.part<PlotOverlay>()->picture().event);
}

void tst_PlotTrigger::linesAreAtTheEventAndTheLevel()
{
    PlotWindow window(triggered(R"(,"mode":"single","kind":"enters","level":-0.5,"upperLevel":0.5)"));
    QVERIFY(window.run(0.2));
    const PlotOverlay::Picture &picture = window.part<PlotOverlay>()->picture();
    QTRY_VERIFY(picture.event);
    QVERIFY(std::abs(*picture.event - window.canvas()->canvas()->width() / 4) <= 2);
    QCOMPARE(picture.levels.size(), 2);
    const double y = window.canvas()->yOf(PlotCurveSettings::Left, 2.0 * 0.5 + 1.0);
    QTRY_VERIFY(std::abs(picture.levels.last().position.y() - y) < 1.0);
}

void tst_PlotTrigger::aLinkedTriggerMovesTheWindow()
{
    PlotWindow window(triggered(R"(,"mode":"single","linked":true)"));
    window.time()->setSpan(s);
    QVERIFY(window.run(0.2));
    QTRY_VERIFY(!window.time()->isLive());
    QCOMPARE(window.time()->begin(), *window.part<TriggerBar>()->trigger().shownEvent() - s / 4);
    window.trigger("trigger");
    QVERIFY(window.time()->isLive());
}

void tst_PlotTrigger::hiddenPlotKeepsItsSingleEvent()
{
    PlotWindow window(triggered(R"(,"mode":"single")"));
    QVERIFY(window.run(0.2));
    window.plot->hide();
    const Trigger &trigger = window.part<TriggerBar>()->trigger();
    QTRY_COMPARE(trigger.state(), Trigger::Done);
    const Time event = *trigger.shownEvent();
    const double past = window.past();
    window.plot->show();
    QTRY_VERIFY(window.past() > past + 0.5);
    QCOMPARE(*trigger.shownEvent(), event);
    QTRY_VERIFY(std::abs(window.canvas()->begin() - (event - s / 4)) < s / 100);
}

void tst_PlotTrigger::pannedViewStaysUntilTheNextEvent()
{
    PlotWindow window(triggered(R"(,"mode":"single")"));
    QVERIFY(window.run(0.2));
    const Trigger &trigger = window.part<TriggerBar>()->trigger();
    QTRY_COMPARE(trigger.state(), Trigger::Done);
    QTRY_VERIFY(std::abs(window.canvas()->begin() - (*trigger.shownEvent() - s / 4)) < s / 100);
    const Time begin = window.canvas()->begin();
    window.trigger("earlier");
    QTRY_VERIFY(window.canvas()->begin() < begin - s / 10);
    QTRY_VERIFY(window.canvas()->canvas()->findChild<QToolButton *>()->isVisible());
    window.part<TriggerBar>()->arm();
    QTRY_VERIFY(window.canvas()->begin() > begin);
}

void tst_PlotTrigger::autoGoesBackToLiveWithoutEvents()
{
    PlotWindow window(triggered(R"(,"level":7)"));
    QVERIFY(window.run(0.2));
    QTRY_COMPARE(window.part<TriggerBar>()->trigger().state(), Trigger::FreeRunning);
    const Time end = window.canvas()->end();
    QTRY_VERIFY(window.canvas()->end() > end + s / 10);
    QCOMPARE(window.part<TriggerBar>()->trigger().count(), std::uint64_t(0));
}

void tst_PlotTrigger::otherSettingsDoNotArmAgain()
{
    PlotWindow window(triggered(R"(,"mode":"single")"));
    QVERIFY(window.run(0.2));
    const Trigger &trigger = window.part<TriggerBar>()->trigger();
    QTRY_COMPARE(trigger.state(), Trigger::Done);
    window.plot->addSignals({QStringLiteral("count")});
    window.trigger("statistics");
    QCOMPARE(trigger.state(), Trigger::Done);
}

void tst_PlotTrigger::everyEventIsSaved()
{
    const QTemporaryDir folder;
    const QByteArray save = R"(,"save":{"on":true,"folder":")" + folder.path().toUtf8() + R"(","most":3})";
    PlotWindow window(triggered(R"(,"mode":"normal")" + save));
    QVERIFY(window.run(0.1));
    const auto files = [&] { return QDir(folder.path()).entryList(QDir::Files); };
    QTRY_COMPARE(files().size(), 3);
    // What is shown before the first event may begin before the plant did.
    QFile file(QDir(folder.path()).filePath(files().at(1)));
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QList<QByteArray> rows = file.readAll().trimmed().split('\n');
    QVERIFY2(rows.first().contains("2*(sin(count/5))+1"), rows.first().constData());
    // A second at 100 Hz, of which a busy computer may have lost cycles.
    const auto timeOf = [](const QByteArray &row) {
        return QDateTime::fromString(QString::fromLatin1(row.left(row.indexOf(','))), Qt::ISODateWithMs);
    };
    const QDateTime first = timeOf(rows.at(1));
    const QDateTime last = timeOf(rows.last());
    QVERIFY2(first.msecsTo(last) > 900 && first.msecsTo(last) < 1100 && rows.size() < 110, rows.last().constData());
    // All that the plant has told of it. Texts have whole milliseconds, cycles are ten apart.
    const auto rowAt = [&](const QDateTime &time) {
        return window.context.plants()->at(0)->store()->rowAt(Time(time.toMSecsSinceEpoch()) * 1'000'000 - s / 500);
    };
    QCOMPARE(qint64(rowAt(last) - rowAt(first)) + 1, qint64(rows.size()) - 1);
    const auto told = [&] {
        const EventLogModel &log = *window.context.events();
        return log.at(log.rowCount() - 1).text;
    };
    QTRY_VERIFY(told().contains(QStringLiteral("has 3 files of events")));
}

void tst_PlotTrigger::failureToSaveIsLogged()
{
    PlotWindow window(triggered(R"(,"mode":"normal","save":{"on":true,"folder":"/proc/no/place"})"));
    QVERIFY(window.run(0.1));
    const EventLogModel &log = *window.context.events();
    QTRY_VERIFY(log.at(log.rowCount() - 1).text.contains(QStringLiteral("/proc/no/place cannot be made")));
    QCOMPARE(log.at(log.rowCount() - 1).severity, PlantEvent::Warning);
    QVERIFY(!QApplication::activeModalWidget());
}

void tst_PlotTrigger::triggerBarDoesNotWidenANarrowPlot()
{
    PlotWindow window(triggered({}));
    window.plot->resize(900, 300);
    window.plot->show();
    auto *bar = window.part<TriggerBar>();
    QTRY_COMPARE(bar->width(), window.plot->width() - 4);
    QVERIFY(window.plot->minimumSizeHint().width() < 170);
    const int shown = bar->findChildren<QWidget *>(QString(), Qt::FindDirectChildrenOnly).size();
    window.plot->resize(170, 180);
    QTRY_COMPARE(bar->width(), 166);
    QVERIFY(bar->findChildren<QWidget *>(QString(), Qt::FindDirectChildrenOnly).size() < shown);
    window.plot->resize(900, 300);
    QTRY_COMPARE(bar->findChildren<QWidget *>(QString(), Qt::FindDirectChildrenOnly).size(), shown);
}

QTEST_MAIN(tst_PlotTrigger)
#include "tst_PlotTrigger.moc"
