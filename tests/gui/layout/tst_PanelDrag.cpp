// SPDX-License-Identifier: Apache-2.0
#include "ViewFixtures.h"
#include "gui/SignalsMimeType.h"
#include "gui/layout/DropZone.h"
#include "gui/layout/EmptyPage.h"
#include "gui/panel/SignalDropArea.h"

#include <QtCore/QMimeData>
#include <QtWidgets/QToolButton>

using namespace qplc;

namespace {

QPoint globalPoint(const QWidget *widget, double x, double y)
{
    return widget->mapToGlobal(QPoint(int(widget->width() * x), int(widget->height() * y)));
}

void drag(PanelFrame *frame, const QPoint &global)
{
    QWidget *bar = frame->titleBar();
    QTest::mousePress(bar, Qt::LeftButton, {}, {20, 10});
    moveTo(bar, bar->mapToGlobal({60, 12}));
    moveTo(bar, global);
    release(bar, global);
}

DropOverlay *visibleOverlay()
{
    for (QWidget *each : QApplication::allWidgets()) {
        auto *overlay = qobject_cast<DropOverlay *>(each);
        if (overlay && overlay->isVisible())
            return overlay;
    }
    return nullptr;
}

bool dropSignals(QWidget *onto, const QPoint &position, const QString &format)
{
    QMimeData data;
    data.setData(format, "windSpeed");
    QDragEnterEvent enter(position, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    enter.ignore();
    QApplication::sendEvent(onto, &enter);
    if (!enter.isAccepted())
        return false;
    QDragMoveEvent move(position, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(onto, &move);
    const bool wasShown = visibleOverlay() != nullptr;
    QDropEvent drop(position, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(onto, &drop);
    return wasShown && !visibleOverlay();
}

}  // namespace

class tst_PanelDrag : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void zoneIsTheNearestEdge_data();
    void zoneIsTheNearestEdge();
    void panelGoesToTheEdgeWhereItIsDropped_data();
    void panelGoesToTheEdgeWhereItIsDropped();
    void panelInTheMiddleGoesToTheNearestEdge();
    void zoneIsShownWhileDragging();
    void panelGoesToTheTabWhereItIsDropped();
    void panelFillsAnEmptyTab();
    void panelThatLeavesTheWindowFloats();
    void floatingPanelIsDraggedBack();
    void floatingPanelThatStaysOutsideMovesItsWindow();
    void emptiedWindowDoesNotCoverTheDropTarget();
    void dropOnItselfChangesNothing();
    void escapeEndsTheDrag();
    void closingADraggedPanelIsSafe();
    void dropOfSignalsReportsPanelAndZone_data();
    void dropOfSignalsReportsPanelAndZone();
    void ownDropAreaOfAPanelAcceptsSignals();
    void dropOnAnEmptyTabReportsNoPanel();
    void signalsAreDroppedOnTabs();
    void panelIsDroppedIntoANewTab();
    void otherDropDataAreRefused();
};

void tst_PanelDrag::zoneIsTheNearestEdge_data()
{
    QTest::addColumn<QPoint>("position");
    QTest::addColumn<int>("zone");
    QTest::addColumn<int>("edge");
    const int left = int(DropZone::Left), right = int(DropZone::Right), above = int(DropZone::Above),
              below = int(DropZone::Below);
    QTest::newRow("left") << QPoint(15, 60) << left << left;
    QTest::newRow("right") << QPoint(205, 60) << right << right;
    QTest::newRow("above") << QPoint(100, 12) << above << above;
    QTest::newRow("below") << QPoint(100, 108) << below << below;
    QTest::newRow("middle, rather left") << QPoint(90, 60) << int(DropZone::Center) << left;
    QTest::newRow("outside") << QPoint(500, 60) << right << right;
}

void tst_PanelDrag::zoneIsTheNearestEdge()
{
    QFETCH(QPoint, position);
    const QRect area(10, 10, 200, 100);
    QTEST(int(dropZoneAt(area, position, DropCenter::IsAZone)), "zone");
    QTEST(int(dropZoneAt(area, position, DropCenter::BelongsToTheNearestEdge)), "edge");
    for (int zone = 0; zone < 5; ++zone)
        QVERIFY(area.contains(dropZoneRect(area, DropZone(zone))));
}

void tst_PanelDrag::panelGoesToTheEdgeWhereItIsDropped_data()
{
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    QTest::addColumn<QString>("expected");
    QTest::newRow("left") << 0.05 << 0.5 << "V[panel2 H[panel1 panel3]]";
    QTest::newRow("right") << 0.95 << 0.5 << "V[panel2 H[panel3 panel1]]";
    QTest::newRow("above") << 0.5 << 0.05 << "V[panel2 panel1 panel3]";
    QTest::newRow("below") << 0.5 << 0.95 << "V[panel2 panel3 panel1]";
}

void tst_PanelDrag::panelGoesToTheEdgeWhereItIsDropped()
{
    QFETCH(double, x);
    QFETCH(double, y);
    QFETCH(QString, expected);
    ViewFixture window;
    const DummyPanel *widget = window.panel("panel1");
    drag(window.frame("panel1"), globalPoint(window.frame("panel3"), x, y));
    QCOMPARE(window.shown(), expected);
    QCOMPARE(window.onScreen("panel1"), expected);
    QCOMPARE(window.panel("panel1"), widget);
    QCOMPARE(window.editor.undoStack()->undoText(), QStringLiteral("move of 'Time plot'"));
    window.undoAndRedo();
    QCOMPARE(window.onScreen("panel1"), QStringLiteral("H[panel1 V[panel2 panel3]]"));
}

/// Neither takes the place of the other, and none is lost.
void tst_PanelDrag::panelInTheMiddleGoesToTheNearestEdge()
{
    for (const auto &[x, expected] :
         {std::pair(0.45, "V[panel2 H[panel1 panel3]]"), std::pair(0.55, "V[panel2 H[panel3 panel1]]")}) {
        ViewFixture window;
        const QRect area = window.frame("panel3")->rect();
        QVERIFY(int(dropZoneAt(area, {int(area.width() * x), area.height() / 2}, DropCenter::IsAZone))
                == int(DropZone::Center));
        drag(window.frame("panel1"), globalPoint(window.frame("panel3"), x, 0.5));
        QCOMPARE(window.shown(), QString::fromLatin1(expected));
        window.undoAndRedo();
    }
}

void tst_PanelDrag::zoneIsShownWhileDragging()
{
    ViewFixture window;
    QWidget *bar = window.frame("panel1")->titleBar();
    QTest::mousePress(bar, Qt::LeftButton, {}, {20, 10});
    moveTo(bar, bar->mapToGlobal({22, 10}));
    QVERIFY(!visibleOverlay());
    const QPoint target = globalPoint(window.frame("panel3"), 0.5, 0.9);
    moveTo(bar, target);
    QVERIFY(visibleOverlay());
    QCOMPARE(visibleOverlay()->parentWidget(), static_cast<QWidget *>(window.frame("panel3")));
    QCOMPARE(visibleOverlay()->geometry(), dropZoneRect(window.frame("panel3")->rect(), DropZone::Below));
    release(bar, target);
    QVERIFY(!visibleOverlay());
}

void tst_PanelDrag::panelGoesToTheTabWhereItIsDropped()
{
    Layout layout = threePanels();
    layout.addTab("Fly");
    layout.setCurrentTab("tab1");
    ViewFixture window(layout);
    LayoutTabBar *bar = window.view.tabBar();
    drag(window.frame("panel1"), bar->mapToGlobal(bar->tabRect(1).center()));
    QCOMPARE(window.shown(), QStringLiteral("V[panel2 panel3] | panel1"));
    QCOMPARE(bar->currentIndex(), 1);
    window.undoAndRedo();
    drag(window.frame("panel1"), bar->mapToGlobal(bar->tabRect(0).center()));
    QCOMPARE(window.editor.undoStack()->index(), 0);
}

void tst_PanelDrag::panelFillsAnEmptyTab()
{
    Layout layout = threePanels();
    layout.floatPanel("panel1", {1200, 100, 300, 200});
    layout.addTab("Fly");
    ViewFixture window(layout);
    drag(window.frame("panel1"), globalPoint(&window.view, 0.5, 0.5));
    QCOMPARE(window.shown(), QStringLiteral("V[panel2 panel3] | panel1"));
    window.undoAndRedo();
}

void tst_PanelDrag::panelThatLeavesTheWindowFloats()
{
    ViewFixture window;
    const QPoint outside = window.view.mapToGlobal({1100, 300});
    drag(window.frame("panel1"), outside);
    QCOMPARE(window.shown(), QStringLiteral("V[panel2 panel3] / panel1"));
    QVERIFY(window.editor.layout().windows().front().geometry.contains(outside));
    window.undoAndRedo();
    QVERIFY(window.view.floatingWindows().isEmpty());
}

void tst_PanelDrag::floatingPanelIsDraggedBack()
{
    Layout layout = threePanels();
    layout.floatPanel("panel1", {1200, 100, 300, 200});
    ViewFixture window(layout);
    drag(window.frame("panel1"), globalPoint(window.frame("panel3"), 0.5, 0.95));
    QCOMPARE(window.shown(), QStringLiteral("V[panel2 panel3 panel1]"));
    window.undoAndRedo();
    drag(window.frame("panel2"), globalPoint(window.frame("panel1"), 0.05, 0.5));
    QCOMPARE(window.shown(), QStringLiteral("panel3 / H[panel2 panel1]"));
    window.undoAndRedo();
}

void tst_PanelDrag::floatingPanelThatStaysOutsideMovesItsWindow()
{
    Layout layout = threePanels();
    layout.floatPanel("panel1", {1200, 100, 300, 200});
    ViewFixture window(layout);
    drag(window.frame("panel1"), QPoint(1300, 400));
    QCOMPARE(window.shown(), QStringLiteral("V[panel2 panel3] / panel1"));
    QVERIFY(window.view.floatingWindows().first()->geometry().contains(1300, 400));
    QCOMPARE(window.editor.undoStack()->count(), 0);
}

void tst_PanelDrag::emptiedWindowDoesNotCoverTheDropTarget()
{
    Layout layout = threePanels();
    layout.floatPanel("panel1", {300, 300, 400, 300});
    ViewFixture window(layout);
    const QPoint target = globalPoint(window.frame("panel3"), 0.5, 0.6);
    window.editor.setWindowGeometry("window1", QRect(target - QPoint(100, 100), QSize(400, 300)));
    window.before = layoutToJson(window.editor.layout());
    drag(window.frame("panel1"), target);
    QCOMPARE(window.shown(), QStringLiteral("V[panel2 panel3 panel1]"));
    window.undoAndRedo();
}

void tst_PanelDrag::dropOnItselfChangesNothing()
{
    ViewFixture window;
    drag(window.frame("panel1"), globalPoint(window.frame("panel1"), 0.5, 0.9));
    QCOMPARE(window.editor.undoStack()->count(), 0);
    QCOMPARE(layoutToJson(window.editor.layout()), window.before);
}

void tst_PanelDrag::escapeEndsTheDrag()
{
    ViewFixture window;
    QWidget *bar = window.frame("panel1")->titleBar();
    const QPoint target = globalPoint(window.frame("panel3"), 0.5, 0.9);
    QTest::mousePress(bar, Qt::LeftButton, {}, {20, 10});
    moveTo(bar, target);
    QVERIFY(visibleOverlay());
    QTest::keyClick(bar, Qt::Key_Escape);
    QVERIFY(!visibleOverlay());
    release(bar, target);
    QCOMPARE(window.editor.undoStack()->count(), 0);
}

void tst_PanelDrag::closingADraggedPanelIsSafe()
{
    ViewFixture window;
    const QPointer<QWidget> bar = window.frame("panel1")->titleBar();
    const QPoint target = globalPoint(window.frame("panel3"), 0.5, 0.9);
    QTest::mousePress(bar, Qt::LeftButton, {}, {20, 10});
    moveTo(bar, target);
    window.editor.closePanel("panel1");
    QVERIFY(!visibleOverlay());
    release(bar, target);
    QCOMPARE(window.shown(), QStringLiteral("V[panel2 panel3]"));
}

void tst_PanelDrag::dropOfSignalsReportsPanelAndZone_data()
{
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    QTest::addColumn<int>("zone");
    QTest::newRow("left") << 0.05 << 0.5 << int(DropZone::Left);
    QTest::newRow("right") << 0.95 << 0.5 << int(DropZone::Right);
    QTest::newRow("above") << 0.5 << 0.05 << int(DropZone::Above);
    QTest::newRow("below") << 0.5 << 0.95 << int(DropZone::Below);
    QTest::newRow("center") << 0.5 << 0.5 << int(DropZone::Center);
}

void tst_PanelDrag::dropOfSignalsReportsPanelAndZone()
{
    QFETCH(double, x);
    QFETCH(double, y);
    ViewFixture window;
    QString panel;
    int where = -1;
    QByteArray dropped;
    connect(&window.view, &LayoutView::signalsDropped, this,
            [&](const QString &id, DropZone zone, const QMimeData *data) {
                panel = id;
                where = int(zone);
                dropped = data->data(signalsMimeType());
            });
    PanelFrame *frame = window.frame("panel2");
    QVERIFY(dropSignals(frame, QPoint(int(x * frame->width()), int(y * frame->height())), signalsMimeType()));
    QCOMPARE(panel, QStringLiteral("panel2"));
    QTEST(where, "zone");
    QCOMPARE(dropped, QByteArray("windSpeed"));
    QCOMPARE(window.editor.undoStack()->count(), 0);
}

void tst_PanelDrag::ownDropAreaOfAPanelAcceptsSignals()
{
    ViewFixture window;
    int where = -1;
    connect(&window.view, &LayoutView::signalsDropped, this,
            [&](const QString &, DropZone zone, const QMimeData *) { where = int(zone); });
    PanelFrame *frame = window.frame("panel2");
    const QRect place(frame->widget()->width() / 2, frame->widget()->height() / 2 - 10, 40, 20);
    new SignalDropArea(
        QStringLiteral("Right axis"), [place] { return place; }, [](const QStringList &) { return true; },
        frame->widget());
    const QPoint inside = frame->widget()->pos() + place.center();
    QVERIFY(dropSignals(frame, inside, signalsMimeType()));
    QCOMPARE(where, int(DropZone::Area));
    QVERIFY(dropSignals(frame, inside - QPoint(50, 0), signalsMimeType()));
    QVERIFY(where != int(DropZone::Area));
}

void tst_PanelDrag::dropOnAnEmptyTabReportsNoPanel()
{
    ViewFixture window{Layout()};
    int drops = 0;
    connect(&window.view, &LayoutView::signalsDropped, this, [&](const QString &id, DropZone zone) {
        QVERIFY(id.isEmpty());
        QCOMPARE(int(zone), int(DropZone::Center));
        ++drops;
    });
    QVERIFY(dropSignals(window.view.findChild<EmptyPage *>(), {100, 100}, signalsMimeType()));
    QCOMPARE(drops, 1);
}

void tst_PanelDrag::signalsAreDroppedOnTabs()
{
    ViewFixture window;
    const QString first = window.editor.layout().currentTab().id;
    window.editor.addTab();
    QVERIFY(window.editor.layout().currentTab().id != first);
    DropZone where = DropZone::Left;
    connect(&window.view, &LayoutView::signalsDropped, this, [&](const QString &id, DropZone zone) {
        QVERIFY(id.isEmpty());
        where = zone;
    });
    LayoutTabBar *bar = window.view.tabBar();
    QVERIFY(dropSignals(bar, bar->tabRect(0).center(), signalsMimeType()));
    QCOMPARE(window.editor.layout().currentTab().id, first);  // it came to the front
    QCOMPARE(int(where), int(DropZone::Center));
    auto *add = window.view.findChild<QToolButton *>(QStringLiteral("addPanel"));
    QVERIFY(dropSignals(add, add->rect().center(), signalsMimeType()));
    QCOMPARE(int(where), int(DropZone::NewTab));
    QVERIFY(!dropSignals(add, add->rect().center(), "text/plain"));
}

void tst_PanelDrag::panelIsDroppedIntoANewTab()
{
    ViewFixture window;
    const std::size_t tabs = window.editor.layout().tabs().size();
    auto *add = window.view.findChild<QToolButton *>(QStringLiteral("addPanel"));
    drag(window.frame("panel1"), add->mapToGlobal(add->rect().center()));
    QCOMPARE(window.editor.layout().tabs().size(), tabs + 1);
    QCOMPARE(window.editor.layout().pageOf("panel1")->id, window.editor.layout().currentTab().id);
    QCOMPARE(window.editor.undoStack()->count(), 1);
}

void tst_PanelDrag::otherDropDataAreRefused()
{
    ViewFixture window;
    int drops = 0;
    connect(&window.view, &LayoutView::signalsDropped, this, [&] { ++drops; });
    QVERIFY(!dropSignals(window.frame("panel1"), {100, 100}, "text/plain"));
    QCOMPARE(drops, 0);
}

QTEST_MAIN(tst_PanelDrag)
#include "tst_PanelDrag.moc"
