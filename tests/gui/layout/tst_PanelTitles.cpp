// SPDX-License-Identifier: Apache-2.0
#include "ViewFixtures.h"

using namespace qplc;

class tst_PanelTitles : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void titleBarWindowAndUndoStepsNameThePanelContent();
};

void tst_PanelTitles::titleBarWindowAndUndoStepsNameThePanelContent()
{
    ViewFixture window;
    const auto step = [&] { return window.editor.undoStack()->undoText(); };
    const QString id = window.view.addPanel(QStringLiteral("Time plot"), {{"content", "power"}});
    QCOMPARE(step(), QStringLiteral("new panel 'power'"));
    const PanelFrame *frame = window.view.frame(id);
    QCOMPARE(frame->titleBar()->title(), QStringLiteral("power"));
    window.click(frame->floatAction());
    QCOMPARE(step(), QStringLiteral("float of 'power'"));
    QCOMPARE(frame->window()->windowTitle(), QStringLiteral("power"));
    window.editor.setPanelSettings(id, {{"content", "power, tetherLength"}});
    QCOMPARE(frame->window()->windowTitle(), QStringLiteral("power, tetherLength"));
    window.editor.setPanelTitle(id, QStringLiteral("Winch"));
    QCOMPARE(step(), QStringLiteral("rename of 'power, tetherLength'"));
    QCOMPARE(frame->window()->windowTitle(), QStringLiteral("Winch"));
    window.editor.closePanel(id);
    QCOMPARE(step(), QStringLiteral("close of 'Winch'"));
    window.editor.undoStack()->undo();
    QCOMPARE(window.view.frame(id)->window()->windowTitle(), QStringLiteral("Winch"));
}

QTEST_MAIN(tst_PanelTitles)
#include "tst_PanelTitles.moc"
