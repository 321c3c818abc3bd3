// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../../common/Waiting.h"
#include "DummyPanels.h"
#include "PlantFixtures.h"
#include "WindowStructure.h"
#include "gui/window/QPlcControlCenterPrivate.h"

#include <QtCore/QSettings>
#include <QtCore/QTemporaryDir>
#include <QtGui/QScreen>
#include <QtWidgets/QAction>
#include <QtWidgets/QLineEdit>

/// Settings of this test alone.
class TestSettings
{
public:
    TestSettings()
    {
        QCoreApplication::setOrganizationName(QStringLiteral("QtPlcTest"));
        QCoreApplication::setApplicationName(QStringLiteral("window"));
        QSettings::setDefaultFormat(QSettings::IniFormat);
        QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, m_folder.path());
        QSettings().clear();
    }

private:
    QTemporaryDir m_folder;
};

/// A window of a laptop on the screen. On a screen (qtplc_add_screen_test) a picture of what was
/// seen last is kept, under the name of the test.
struct WindowFixture
{
    WindowFixture()
    {
        part<qplc::MasterSearch>()->setSilent(true);  // masters of other tests are none of ours
        window.resize(1366, 768);
        window.show();
        window.activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(&window));
    }
    ~WindowFixture()
    {
        const QString folder = qEnvironmentVariable("QTPLC_SCREENSHOTS");
        if (folder.isEmpty() || !window.isVisible())
            return;
        const QString name = QStringLiteral("window_%1_%2.png")
                                 .arg(QLatin1String(QTest::currentTestFunction()),
                                      QLatin1String(QTest::currentDataTag() ? QTest::currentDataTag() : "last"));
        const QString file = folder + QLatin1Char('/') + QString(name).replace(QLatin1Char(' '), QLatin1Char('_'));
        if (!window.screen()->grabWindow(0).save(file))
            qWarning("the picture '%s' cannot be written", qPrintable(file));
    }

    template<typename Widget>
    Widget *part(const char *name = nullptr)
    {
        return window.findChild<Widget *>(name ? QString::fromLatin1(name) : QString());
    }
    qplc::TopBar *topBar() { return part<qplc::TopBar>(); }
    qplc::Plant *plant(int place = 0) { return window.context()->plants()->at(place); }
    QString hint() { return part<qplc::HintLine>()->text(); }
    /// Of the window, by its text without mnemonic.
    QAction *action(const char *text)
    {
        for (QAction *each : window.actions()) {
            if (each->text().remove(QLatin1Char('&')) == QLatin1String(text))
                return each;
        }
        qFatal("the window has no action '%s'", text);
        return nullptr;
    }
    WindowStructure structure() { return WindowStructure(&window); }
    /// Presses keys where a person's would go.
    void press(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
    {
        QWidget *target = QApplication::activePopupWidget() ? QApplication::activePopupWidget()->focusWidget()
                                                            : QApplication::focusWidget();
        QTest::keyClick(target ? target : &window, key, modifiers);
    }
    void type(const QString &text)
    {
        QWidget *target = QApplication::activePopupWidget() ? QApplication::activePopupWidget()->focusWidget()
                                                            : QApplication::focusWidget();
        QTest::keyClicks(target, text);
    }
    /// By typing its address.
    void connectTo(const QString &address)
    {
        press(Qt::Key_O, Qt::ControlModifier);
        part<qplc::ConnectStrip>()->line()->clear();
        type(address);
        press(Qt::Key_Return);
    }

    QPlcControlCenter window;
};
