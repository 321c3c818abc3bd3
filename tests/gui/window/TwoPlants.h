// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../../common/Waiting.h"
#include "CommandTap.h"
#include "SetterFixtures.h"
#include "WindowFixtures.h"
#include "gui/layout/PanelFrame.h"
#include "gui/layout/PanelTitleBar.h"

#include "QPlcKeyboardControl.h"
#include "QPlcSetter.h"

#include <QtCore/QJsonArray>
#include <QtWidgets/QMenu>

/// Two masters that run, "north" and "south", with the same signals; a window that is connected to
/// both; and between them what hears the commands that the window sends to each.
struct TwoPlants : WindowFixture
{
    TwoPlants()
        : editor(part<qplc::LayoutView>()->editor())
    {
        for (FlyingMaster *master : {&north, &south})
            QVERIFY(master->startRealTime());
        window.connectToMaster(northTap.address(), QStringLiteral("north"));
        window.connectToMaster(southTap.address(), QStringLiteral("south"));
        part<qplc::SignalDock>()->hide();
        QStringList others;
        for (const qplc::LayoutPanel *panel : editor->layout().panels())
            others << panel->id;
        for (const QString &panel : others)
            editor->closePanel(panel);
    }
    bool isReady()
    {
        const auto hasAll = [this](int place) {
            return plant(place)->hasLeases() && !plant(place)->writer(6).isEmpty()
                && plant(place)->quality() == qplc::Plant::Good && plant(place)->status().isRunning();
        };
        return waitUntil([&] { return hasAll(0) && hasAll(1); }) && settle();
    }
    /// All that the window has sent so far has arrived and was answered, and what it sent upon
    /// these answers, and so on.
    bool settle()
    {
        int before = -1;
        while (before != commandCount()) {
            before = commandCount();
            auto answers = std::make_shared<int>(0);
            for (int place = 0; place < 2; ++place) {
                const auto ask = [this, place, answers] {
                    return plant(place)->ask(qplc::messages::GetState(), [answers](const auto &) { ++*answers; });
                };
                if (!waitUntil(ask))
                    return false;
            }
            if (!waitUntil([&] { return *answers == 2; }))
                return false;
        }
        return true;
    }
    QPlcWidget *addPanel(const QString &type, const QJsonObject &settings)
    {
        const QList<QPlcWidget *> before = window.findChildren<QPlcWidget *>();
        // In two rows, so that all have room.
        const auto target = m_above.isEmpty() ? qplc::LayoutTarget::inTab(editor->layout().currentTab().id)
                                              : qplc::LayoutTarget::beside(m_above, qplc::LayoutSide::Below);
        editor->addPanel(type, settings, target);
        for (QPlcWidget *widget : window.findChildren<QPlcWidget *>()) {
            if (before.contains(widget))
                continue;
            m_above = m_above.isEmpty() ? frameOf(widget)->panelId() : QString();
            return widget;
        }
        return nullptr;
    }
    QPlcSetter *addSetter(const QString &signal, const QString &style, const QString &pin = QString())
    {
        QJsonObject settings{{QStringLiteral("signal"), signal}};
        if (style != QLatin1String("number"))
            settings.insert(QStringLiteral("style"), style);
        if (!pin.isEmpty())
            settings.insert(QStringLiteral("plant"), pin);
        return qobject_cast<QPlcSetter *>(addPanel(QStringLiteral("Setter"), settings));
    }
    QPlcKeyboardControl *addKeyboard()
    {
        const QJsonObject up{{QStringLiteral("key"), QStringLiteral("W")},
                             {QStringLiteral("signal"), QStringLiteral("echo")},
                             {QStringLiteral("value"), 4.0}};
        return qobject_cast<QPlcKeyboardControl *>(
            addPanel(QStringLiteral("Keyboard control"), {{QStringLiteral("keys"), QJsonArray{up}}}));
    }
    static qplc::PanelFrame *frameOf(QWidget *widget)
    {
        while (widget && !qobject_cast<qplc::PanelFrame *>(widget))
            widget = widget->parentWidget();
        return qobject_cast<qplc::PanelFrame *>(widget);
    }
    static QString badgeOf(QWidget *widget) { return frameOf(widget)->titleBar()->badge().text; }
    /// The plants that a panel names above itself.
    static QStringList plantsOf(QWidget *widget) { return badgeOf(widget).split(QStringLiteral(", ")); }
    /// The plants that are written on STOP.
    QStringList stopPlants()
    {
        return topBar()->stopButton()->detail().remove(QLatin1Char('?')).split(QStringLiteral(", "));
    }
    /// The plant that the bar shows.
    QString barPlant() { return topBar()->selector()->text().section(QLatin1Char(':'), 0, 0); }
    /// With a click, or two where it is asked who is to have it.
    static bool take(QWidget *panel)
    {
        QAbstractButton *button = buttonOf(panel, QStringLiteral("Take control"));
        if (button)
            QTest::mouseClick(button, Qt::LeftButton);
        return button;
    }
    void selectNext() { press(Qt::Key_P, Qt::ControlModifier); }
    static void choose(QMenu *menu, const QString &text)
    {
        for (QAction *action : menu->actions()) {
            if (action->text().startsWith(text))
                QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
        }
    }
    void clear()
    {
        northTap.clear();
        southTap.clear();
    }

    FlyingMaster north;
    FlyingMaster south;
    CommandTap northTap{north.serverPort()};
    CommandTap southTap{south.serverPort()};
    qplc::LayoutEditor *editor;

private:
    int commandCount() const { return northTap.commands().size() + southTap.commands().size(); }

    QString m_above;
};
