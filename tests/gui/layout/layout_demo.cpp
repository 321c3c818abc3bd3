// SPDX-License-Identifier: Apache-2.0
// A window with panels that show nothing real, to look at: layout_demo [--dark] [--scene NAME]
// [--screenshot FILE.png]
#include "DummyPanels.h"
#include "LayoutFixtures.h"
#include "gui/layout/DropZone.h"
#include "gui/layout/FloatingWindow.h"
#include "gui/layout/LayoutView.h"
#include "gui/layout/PanelFrame.h"

#include <QtCore/QCommandLineParser>
#include <QtCore/QTimer>
#include <QtGui/QScreen>
#include <QtWidgets/QAction>
#include <QtWidgets/QApplication>
#include <QtWidgets/QMainWindow>
#include <QtWidgets/QMenu>
#include <QtWidgets/QMenuBar>
#include <QtWidgets/QStyleFactory>

using namespace qplc;

namespace {

void setDark()
{
    QPalette dark(QColor(45, 47, 51));
    dark.setColor(QPalette::Base, QColor(32, 33, 36));
    dark.setColor(QPalette::WindowText, QColor(225, 226, 228));
    dark.setColor(QPalette::Text, QColor(225, 226, 228));
    dark.setColor(QPalette::ButtonText, QColor(225, 226, 228));
    dark.setColor(QPalette::Highlight, QColor(70, 130, 200));
    QApplication::setPalette(dark);
}

Layout demoLayout()
{
    Layout layout = threePanels();
    layout.renameTab("tab1", "Fly");
    layout.setPanelTitle("panel2", "Tether force");
    layout.addPanel("Wind rose", {}, LayoutTarget::beside("panel3", LayoutSide::Right));
    layout.setShares({"panel1", "panel4"}, {3, 2});
    layout.addTab("Ground station");
    layout.addTab("Real time");
    layout.setCurrentTab("tab1");
    return layout;
}

void play(const QString &scene, LayoutEditor *editor, LayoutView *view)
{
    if (scene == "empty")
        editor->setCurrentTab("tab2");
    if (scene == "maximized")
        editor->setMaximized("panel1", true);
    if (scene == "floating")
        editor->floatPanel("panel2", QRect(700, 220, 420, 260));
    if (scene == "menu")
        view->frame("panel1")->createMenu()->popup(view->mapToGlobal({200, 150}));
    if (scene == "settings")
        view->frame("panel1")->settingsAction()->trigger();
    if (scene == "drop") {
        PanelFrame *frame = view->frame("panel1");
        (new DropOverlay)->showOver(frame, dropZoneRect(frame->rect(), DropZone::Right));
    }
}

}  // namespace

int main(int argc, char **argv)
{
    QApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
    QApplication application(argc, argv);
    QCommandLineParser options;
    options.addOptions({{"dark", "Dark palette."},
                        {"scene", "empty, maximized, floating, menu, settings or drop.", "name"},
                        {"screenshot", "Makes a picture of the screen, and ends.", "file"}});
    options.addHelpOption();
    options.process(application);
    QApplication::setStyle(QStyleFactory::create("Fusion"));
    if (options.isSet("dark"))
        setDark();
    const DummyFactories factories;
    LayoutEditor editor(demoLayout());
    QMainWindow window;
    auto *view = new LayoutView(&editor);
    view->setFactories(factories.all());
    window.setCentralWidget(view);
    QMenu *edit = window.menuBar()->addMenu("Edit");
    for (QAction *action : {editor.undoStack()->createUndoAction(edit), editor.undoStack()->createRedoAction(edit)})
        edit->addAction(action);
    edit->actions().first()->setShortcut(QKeySequence::Undo);
    edit->actions().last()->setShortcut(QKeySequence::Redo);
    window.resize(1366, 740);
    window.show();
    QTimer::singleShot(300, &window, [&] { play(options.value("scene"), &editor, view); });
    if (options.isSet("screenshot")) {
        QTimer::singleShot(1000, &window, [&] {
            QGuiApplication::primaryScreen()->grabWindow(0).save(options.value("screenshot"));
            QApplication::exit();
        });
    }
    return QApplication::exec();
}
