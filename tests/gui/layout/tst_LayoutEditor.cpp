// SPDX-License-Identifier: Apache-2.0
#include "LayoutFixtures.h"
#include "gui/layout/LayoutEditor.h"
#include "gui/layout/LayoutJson.h"

#include <QtTest/QtTest>

using namespace qplc;

class tst_LayoutEditor : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void undoStepDescribesItsEdit();
    void editWithoutEffectCreatesNoUndoStep();
    void successiveResizesOfOneSplitAreOneStep();
    void resizesOfTwoSplitsAreTwoSteps();
    void successiveSettingsOfOnePanelAreOneStep();
    void settingsThatAreSeparatedAreTwoSteps();
    void revertedSettingsLeaveNoStep();
    void undoShowsTheTabWhereItHappens();
    void undoLeavesWindowsWhereTheyWerePut();
    void undoOfAnotherLayoutPutsItsWindowsBack();
    void anotherLayoutHasNothingToUndo();
    void fullLayoutRefusesAnotherPanel();
};

void tst_LayoutEditor::undoStepDescribesItsEdit()
{
    LayoutEditor editor(threePanels());
    const auto text = [&] { return editor.undoStack()->undoText(); };
    editor.setPanelTitle("panel1", "Power");
    QCOMPARE(text(), QStringLiteral("rename of 'Time plot'"));
    editor.movePanel("panel1", LayoutTarget::beside("panel3", LayoutSide::Below));
    QCOMPARE(text(), QStringLiteral("move of 'Power'"));
    editor.addPanel("Gauge", {}, LayoutTarget::inTab("tab1"));
    QCOMPARE(text(), QStringLiteral("new panel 'Gauge'"));
    editor.floatPanel("panel1", {0, 0, 10, 10});
    QCOMPARE(text(), QStringLiteral("float of 'Power'"));
    editor.closeWindow("window1");
    QCOMPARE(text(), QStringLiteral("close of window 'Power'"));
    editor.renameTab("tab1", "Fly");
    QCOMPARE(text(), QStringLiteral("rename of tab 'Tab 1'"));
    editor.setMaximized("panel2", true);
    QCOMPARE(text(), QStringLiteral("maximize of 'Gauge'"));
}

void tst_LayoutEditor::editWithoutEffectCreatesNoUndoStep()
{
    LayoutEditor editor(threePanels());
    QSignalSpy changed(&editor, &LayoutEditor::layoutChanged);
    QVERIFY(!editor.renameTab("tab1", "Tab 1"));
    QVERIFY(!editor.closePanel("panel9"));
    QVERIFY(!editor.setShares({"panel1", "panel3"}, {1, 1}));
    QCOMPARE(editor.undoStack()->count(), 0);
    QCOMPARE(changed.count(), 0);
}

void tst_LayoutEditor::successiveResizesOfOneSplitAreOneStep()
{
    LayoutEditor editor(threePanels());
    for (int share = 5100; share <= 7000; share += 100)
        QVERIFY(editor.setShares({"panel1", "panel3"}, {share, 10000 - share}));
    QCOMPARE(editor.undoStack()->count(), 1);
    QCOMPARE(editor.layout().currentTab().tree->shares(), (QVector<int>{7000, 3000}));
    editor.undoStack()->undo();
    QVERIFY(editor.layout() == threePanels());
    editor.undoStack()->redo();
    QCOMPARE(editor.layout().currentTab().tree->shares(), (QVector<int>{7000, 3000}));
}

void tst_LayoutEditor::resizesOfTwoSplitsAreTwoSteps()
{
    LayoutEditor editor(threePanels());
    editor.setShares({"panel1", "panel3"}, {1, 3});
    editor.setShares({"panel2", "panel3"}, {1, 3});
    editor.setShares({"panel1", "panel3"}, {1, 4});
    QCOMPARE(editor.undoStack()->count(), 3);
}

void tst_LayoutEditor::successiveSettingsOfOnePanelAreOneStep()
{
    LayoutEditor editor(threePanels());
    for (int limit = 0; limit < 5; ++limit)
        editor.setPanelSettings("panel2", {{"limit", 10 + limit}});
    QCOMPARE(editor.undoStack()->count(), 1);
    editor.setPanelSettings("panel3", {{"limit", 1}});
    editor.setPanelSettings("panel2", {{"limit", 1}});
    QCOMPARE(editor.undoStack()->count(), 3);
    editor.undoStack()->undo();
    QCOMPARE(editor.layout().panel("panel2")->settings, (QJsonObject{{"limit", 14}}));
}

void tst_LayoutEditor::settingsThatAreSeparatedAreTwoSteps()
{
    LayoutEditor editor(threePanels());
    editor.setPanelSettings("panel1", {{"gain", 1}});
    editor.separateSteps();
    editor.separateSteps();
    QCOMPARE(editor.undoStack()->count(), 1);  // it is no step itself
    editor.setPanelSettings("panel1", {{"gain", 2}});
    QCOMPARE(editor.undoStack()->count(), 2);
    editor.undoStack()->undo();
    QCOMPARE(editor.layout().panel("panel1")->settings, (QJsonObject{{"gain", 1}}));
}

void tst_LayoutEditor::revertedSettingsLeaveNoStep()
{
    LayoutEditor editor(threePanels());
    editor.setPanelSettings("panel2", {{"limit", 4}});
    editor.setPanelSettings("panel2", {{"limit", 3}});
    QCOMPARE(editor.undoStack()->count(), 0);
    QVERIFY(editor.layout() == threePanels());
}

void tst_LayoutEditor::undoShowsTheTabWhereItHappens()
{
    LayoutEditor editor(threePanels());
    editor.closePanel("panel1");
    editor.addTab("Other");
    editor.setCurrentTab("tab1");
    editor.undoStack()->undo();
    QCOMPARE(editor.layout().tabs().size(), std::size_t(1));
    editor.undoStack()->undo();
    QVERIFY(editor.layout() == threePanels());
}

void tst_LayoutEditor::undoLeavesWindowsWhereTheyWerePut()
{
    LayoutEditor editor(threePanels());
    editor.floatPanel("panel1", {10, 10, 300, 200});
    editor.setPanelTitle("panel1", "Power");
    editor.setWindowGeometry("window1", {50, 60, 320, 200});
    QCOMPARE(editor.undoStack()->count(), 2);
    editor.undoStack()->undo();
    QCOMPARE(editor.layout().window("window1")->geometry, QRect(50, 60, 320, 200));
    QCOMPARE(editor.layout().panel("panel1")->title(), QStringLiteral("Time plot"));
    editor.undoStack()->undo();
    QVERIFY(editor.layout() == threePanels());
}

void tst_LayoutEditor::undoOfAnotherLayoutPutsItsWindowsBack()
{
    Layout first = threePanels();
    first.floatPanel("panel1", {1, 2, 300, 200});
    Layout second = threePanels();
    second.floatPanel("panel2", {3, 4, 500, 400});
    LayoutEditor editor(first);
    QVERIFY(editor.replace(second, QStringLiteral("reset of the layout")));
    QVERIFY(editor.layout() == second);
    QCOMPARE(editor.undoStack()->undoText(), QStringLiteral("reset of the layout"));
    editor.undoStack()->undo();
    QVERIFY(editor.layout() == first);
}

void tst_LayoutEditor::anotherLayoutHasNothingToUndo()
{
    LayoutEditor editor;
    editor.addTab();
    QSignalSpy changed(&editor, &LayoutEditor::layoutChanged);
    editor.setLayout(threePanels());
    QCOMPARE(changed.count(), 1);
    QVERIFY(!editor.undoStack()->canUndo());
    QVERIFY(editor.layout() == threePanels());
}

void tst_LayoutEditor::fullLayoutRefusesAnotherPanel()
{
    Layout layout;
    const auto target = LayoutTarget::inTab(layout.currentTab().id);
    while (!layout.isFull())
        layout.addPanel("Gauge", {}, target);
    LayoutEditor editor(layout);
    QSignalSpy refused(&editor, &LayoutEditor::refused);
    QCOMPARE(editor.addPanel("Gauge", {}, target), QString());
    QCOMPARE(editor.duplicatePanel("panel1", LayoutSide::Right), QString());
    QCOMPARE(refused.count(), 2);
    QCOMPARE(refused.at(0).at(0).toString(), QStringLiteral("A layout has at most 500 panels: close some first."));
    QVERIFY(editor.layout() == layout);
    // What an edit can make, a file can hold.
    QVERIFY(layoutFromJson(layoutToJson(layout)));
    QVERIFY(editor.closePanel("panel1"));
    QVERIFY(!editor.addPanel("Gauge", {}, target).isEmpty());
}

QTEST_GUILESS_MAIN(tst_LayoutEditor)
#include "tst_LayoutEditor.moc"
