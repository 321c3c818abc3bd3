// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "gui/charts/TriggerBar.h"

#include "PanelFixtures.h"
#include "PlantFixtures.h"
#include "QPlcWidget.h"
#include "gui/panel/WindowContext.h"

#include <QtCore/QJsonDocument>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QDoubleSpinBox>
#include <QtWidgets/QLabel>

using namespace qplc;

namespace {

/// A panel in a window.
class PanelOf : public QPlcWidget
{
public:
    explicit PanelOf(WindowContext *window) { setContext(window); }
};

template<typename Widget>
Widget *control(const QWidget &bar, const QString &accessibleName)
{
    const QList<Widget *> all = bar.findChildren<Widget *>();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const Widget *each) { return each->accessibleName() == accessibleName; });
    return found == all.end() ? nullptr : *found;
}

}  // namespace

class tst_TriggerBar : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void settingsAreRestoredUnchanged();
    void theFirstSignalIsChosenUntilAPersonDoes();
    void userChoiceIsSignalled();
    void numbersOfAnySizeStayAsTheyAre();
    void aSmallLevelIsWritten();
    void windowTriggersHaveTwoLevels();
    void anEventMovesTheViewOfTheWindow();
    void hiddenBarEvaluatesNoTrigger();
    void barReportsAMissingSignal();
};

void tst_TriggerBar::settingsAreRestoredUnchanged()
{
    const QPlcWidget panel;
    TriggerBar bar(panel.context());
    const QJsonObject all
        = objectOf(R"({"signal":"power","kind":"leaves","level":2,"upperLevel":5,"mode":"single","pre":0.5})");
    bar.applySettings(all);
    QCOMPARE(bar.settings(), all);
    bar.applySettings({});
    QVERIFY(bar.settings().isEmpty());
}

void tst_TriggerBar::theFirstSignalIsChosenUntilAPersonDoes()
{
    const QPlcWidget panel;
    TriggerBar bar(panel.context());
    bar.setSignals({"a", "b"});
    QCOMPARE(bar.settings(), objectOf(R"({"signal":"a"})"));
    bar.applySettings(objectOf(R"({"signal":"gone"})"));
    bar.setSignals({"a", "b"});
    QCOMPARE(control<QComboBox>(bar, "Signal of the trigger")->currentText(), QStringLiteral("gone"));
}

void tst_TriggerBar::userChoiceIsSignalled()
{
    const QPlcWidget panel;
    TriggerBar bar(panel.context());
    bar.setSignals({"a", "b"});
    QSignalSpy edited(&bar, &TriggerBar::settingsEdited);
    auto *mode = control<QComboBox>(bar, "Mode of the trigger");
    mode->setCurrentIndex(Trigger::Single);
    Q_EMIT mode->activated(Trigger::Single);
    control<QDoubleSpinBox>(bar, "Level")->setValue(4.5);
    QCOMPARE(edited.size(), 2);
    QCOMPARE(bar.settings(), objectOf(R"({"signal":"a","mode":"single","level":4.5})"));
}

void tst_TriggerBar::numbersOfAnySizeStayAsTheyAre()
{
    const QPlcWidget panel;
    TriggerBar bar(panel.context());
    QJsonObject all = objectOf(R"({"signal":"a","level":0.0003,"upperLevel":0.00031234567890123,"hysteresis":1e-9,)"
                               R"("pre":0.123,"holdOff":0.0004})");
    bar.applySettings(all);
    QCOMPARE(control<QDoubleSpinBox>(bar, "Level")->text(), QStringLiteral("0.0003"));
    auto *mode = control<QComboBox>(bar, "Mode of the trigger");
    mode->setCurrentIndex(Trigger::Single);
    Q_EMIT mode->activated(Trigger::Single);
    all.insert(QStringLiteral("mode"), QStringLiteral("single"));
    QCOMPARE(bar.settings(), all);
}

void tst_TriggerBar::aSmallLevelIsWritten()
{
    const QPlcWidget panel;
    TriggerBar bar(panel.context());
    bar.setSignals({"a"});
    auto *level = control<QDoubleSpinBox>(bar, "Level");
    level->selectAll();
    QTest::keyClicks(level, QStringLiteral("2.5e-4"));
    QCOMPARE(bar.trigger().settings().level, 0.0);  // not complete
    QTest::keyClick(level, Qt::Key_Return);
    QCOMPARE(bar.trigger().settings().level, 2.5e-4);
    control<QDoubleSpinBox>(bar, "Before the event")->setValue(12.0);
    QCOMPARE(bar.settings(), objectOf(R"({"signal":"a","level":0.00025,"pre":0.12})"));
}

void tst_TriggerBar::windowTriggersHaveTwoLevels()
{
    const QPlcWidget panel;
    TriggerBar bar(panel.context());
    const auto *upper = control<QDoubleSpinBox>(bar, "Upper level");
    QVERIFY(!upper->isVisibleTo(&bar));
    bar.applySettings(objectOf(R"({"kind":"enters"})"));
    QVERIFY(upper->isVisibleTo(&bar));
}

void tst_TriggerBar::anEventMovesTheViewOfTheWindow()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    WindowContext context;
    context.timeAxis()->setSpan(1'000'000'000);
    PanelOf panel(&context);
    TriggerBar bar(panel.context());
    bar.setSignals({"= count % 2", "count"});
    bar.applySettings(objectOf(R"json({"signal":"= sin(count/5)","mode":"normal","pre":0.25})json"));
    bar.show();
    context.plants()->add(master.address());
    QTRY_VERIFY(bar.trigger().count() > 0);
    QVERIFY(!context.timeAxis()->isLive());
    const Trigger::Time event = *bar.trigger().shownEvent();
    QCOMPARE(context.timeAxis()->begin(), event - 250'000'000);
    QCOMPARE(context.timeAxis()->span(), QPlcTimeAxis::Time(1'000'000'000));
    QTRY_VERIFY(*bar.trigger().shownEvent() > event);
}

void tst_TriggerBar::hiddenBarEvaluatesNoTrigger()
{
    RunningMaster master;
    QVERIFY(master.startRealTime());
    WindowContext context;
    PanelOf panel(&context);
    TriggerBar bar(panel.context());
    bar.applySettings(objectOf(R"json({"signal":"= sin(count)","mode":"normal"})json"));
    Plant *plant = context.plants()->add(master.address());
    QTRY_VERIFY(plant->values().rows() > 50);
    QCOMPARE(bar.trigger().count(), std::uint64_t(0));
    QVERIFY(context.timeAxis()->isLive());
    bar.show();
    QTRY_VERIFY(!context.timeAxis()->isLive());
    bar.hide();
    QVERIFY(context.timeAxis()->isLive());
}

void tst_TriggerBar::barReportsAMissingSignal()
{
    WindowContext context;
    PanelOf panel(&context);
    TriggerBar bar(panel.context());
    bar.applySettings(objectOf(R"({"signal":"nobody"})"));
    const QList<QLabel *> labels = bar.findChildren<QLabel *>();
    QVERIFY(std::any_of(labels.begin(), labels.end(),
                        [](const QLabel *label) { return label->text().contains("No signal"); }));
}

QTEST_MAIN(tst_TriggerBar)
#include "tst_TriggerBar.moc"
