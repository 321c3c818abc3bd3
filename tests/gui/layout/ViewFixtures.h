// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../../common/Waiting.h"
#include "DummyPanels.h"
#include "LayoutFixtures.h"
#include "gui/layout/FloatingWindow.h"
#include "gui/layout/InlineEdit.h"
#include "gui/layout/LayoutJson.h"
#include "gui/layout/LayoutTabBar.h"
#include "gui/layout/LayoutView.h"
#include "gui/layout/PageView.h"
#include "gui/layout/PanelFrame.h"
#include "gui/layout/PanelPlaceholder.h"
#include "gui/layout/PanelTitleBar.h"
#include "gui/layout/ShareSplitter.h"

#include <QtWidgets/QAction>
#include <QtWidgets/QMenu>

/// A window of 1000 x 700 that shows a layout, and remembers what it was before an edit.
struct ViewFixture
{
    explicit ViewFixture(const qplc::Layout &layout = threePanels())
        : editor(layout)
        , view(&editor)
        , before(qplc::layoutToJson(layout))
    {
        view.setFactories(factories.all());
        view.resize(1000, 700);
        view.show();
        view.activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(&view));
    }

    qplc::PanelFrame *frame(const char *id) { return view.frame(QString::fromLatin1(id)); }
    DummyPanel *panel(const char *id) { return qobject_cast<DummyPanel *>(view.widget(QString::fromLatin1(id))); }
    QString shown() const { return described(editor.layout()); }

    /// What is on the screen, found out from the widgets alone.
    static QString onScreen(const QWidget *widget)
    {
        if (const auto *frame = qobject_cast<const qplc::PanelFrame *>(widget))
            return frame->panelId();
        const auto *splitter = qobject_cast<const qplc::ShareSplitter *>(widget);
        if (!splitter)
            return QStringLiteral("?");
        QStringList children;
        for (int i = 0; i < splitter->count(); ++i)
            children.append(onScreen(splitter->widget(i)));
        return (splitter->orientation() == Qt::Horizontal ? QStringLiteral("H[%1]") : QStringLiteral("V[%1]"))
            .arg(children.join(QLatin1Char(' ')));
    }

    QString onScreen(const char *anyPanel)
    {
        QWidget *root = frame(anyPanel);
        while (!qobject_cast<qplc::PageView *>(root->parentWidget()))
            root = root->parentWidget();
        return onScreen(root);
    }

    void click(QAction *action)
    {
        for (qplc::PanelFrame *each : allFrames()) {
            for (QToolButton *button : each->titleBar()->findChildren<QToolButton *>()) {
                if (button->defaultAction() == action)
                    return QTest::mouseClick(button, Qt::LeftButton);
            }
        }
        QFAIL("there is no button for the action");
    }

    QList<qplc::PanelFrame *> allFrames()
    {
        QList<qplc::PanelFrame *> all = view.findChildren<qplc::PanelFrame *>();
        for (qplc::FloatingWindow *window : view.floatingWindows())
            all += window->findChildren<qplc::PanelFrame *>();
        return all;
    }

    /// One step was made; undone, everything is as it was, and redone, as the step left it.
    void undoAndRedo()
    {
        QCOMPARE(editor.undoStack()->index(), 1);
        const QByteArray after = qplc::layoutToJson(editor.layout());
        QVERIFY(after != before);
        editor.undoStack()->undo();
        QCOMPARE(qplc::layoutToJson(editor.layout()), before);
        editor.undoStack()->redo();
        QCOMPARE(qplc::layoutToJson(editor.layout()), after);
        editor.undoStack()->undo();
    }

    DummyFactories factories;
    qplc::LayoutEditor editor;
    qplc::LayoutView view;
    QByteArray before;
};

/// Moves the pressed mouse over a widget that has got it.
inline void moveTo(QWidget *bar, const QPoint &global)
{
    QMouseEvent move(QEvent::MouseMove, bar->mapFromGlobal(global), global, Qt::NoButton, Qt::LeftButton,
                     Qt::NoModifier);
    QApplication::sendEvent(bar, &move);
}

inline void release(QWidget *bar, const QPoint &global)
{
    QMouseEvent up(QEvent::MouseButtonRelease, bar->mapFromGlobal(global), global, Qt::LeftButton, Qt::NoButton,
                   Qt::NoModifier);
    QApplication::sendEvent(bar, &up);
}

/// The entry with this text, also in submenus: "Split right/Gauge".
inline QAction *entry(QMenu *menu, const QString &path)
{
    const QString first = path.section(QLatin1Char('/'), 0, 0);
    const QString rest = path.section(QLatin1Char('/'), 1);
    for (QAction *action : menu->actions()) {
        if (action->text() == first)
            return rest.isEmpty() ? action : entry(action->menu(), rest);
    }
    return nullptr;
}
