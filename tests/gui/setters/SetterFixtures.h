// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../../common/Waiting.h"
#include "PlantFixtures.h"
#include "gui/panel/WindowContext.h"

#include "QPlcWidget.h"

#include <QtWidgets/QAction>
#include <QtWidgets/QLabel>
#include <QtWidgets/QToolButton>

/// A window with one plant.
class TestWindow
{
public:
    explicit TestWindow(const QString &address, const QString &nodeName = QStringLiteral("Window"))
        : plant(context.plants()->add(address, QStringLiteral("kite"), nodeName))
        , done(plant, &qplc::Plant::commandDone)
        , failed(plant, &qplc::Plant::commandFailed)
    {
        panel.setContext(&context);
    }
    bool isReady()
    {
        return waitUntil([this] { return plant->hasLeases() && !plant->writer(6).isEmpty(); }, 5000);
    }
    bool isMine(const QString &signal) const { return plant->lease(signal) && plant->lease(signal)->isMine; }

    qplc::WindowContext context;
    qplc::Plant *plant;
    QSignalSpy done;
    QSignalSpy failed;
    QPlcWidget panel;  // for what needs one
};

/// Shows a panel as a window does.
inline bool showPanel(QPlcWidget *panel, qplc::WindowContext *context, const QJsonObject &settings)
{
    panel->setContext(context);
    panel->applySettings(settings);
    panel->resize(300, 160);
    panel->show();
    panel->activateWindow();
    return QTest::qWaitForWindowActive(panel);
}

inline QAction *actionOf(QWidget *panel, const QString &text)
{
    for (QAction *action : panel->actions()) {
        if (action->text() == text)
            return action;
    }
    return nullptr;
}

/// A button that can be seen, by its text.
inline QAbstractButton *buttonOf(QWidget *panel, const QString &text)
{
    for (QAbstractButton *button : panel->findChildren<QAbstractButton *>()) {
        if (button->text() == text && button->isVisible())
            return button;
    }
    return nullptr;
}

/// All texts of labels that can be seen.
inline QString labelsOf(QWidget *panel)
{
    QStringList texts;
    for (const QLabel *label : panel->findChildren<QLabel *>()) {
        if (label->isVisible())
            texts << label->text();
    }
    return texts.join(QLatin1Char('\n'));
}
