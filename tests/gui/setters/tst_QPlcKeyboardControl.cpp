// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "QPlcKeyboardControl.h"
#include "SetterFixtures.h"
#include "gui/setters/ElidedLabel.h"
#include "gui/setters/Gamepad.h"
#include "gui/setters/KeyButton.h"
#include "gui/setters/KeyMapView.h"

#include <QtCore/QJsonArray>
#include <QtWidgets/QDoubleSpinBox>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QVBoxLayout>

using namespace qplc;

namespace {

const QString echo = QStringLiteral("echo");

QJsonObject keySettings()
{
    return {{"keys",
             QJsonArray{QJsonObject{{"key", "Left"}, {"signal", "echo"}, {"value", -3.0}},
                        QJsonObject{{"key", "W"}, {"signal", "setpoint"}, {"value", 2.0}}}}};
}

/// A panel that flies a plant.
struct Pilot
{
    explicit Pilot(FlyingMaster &master)
        : window(master.address())
    {
    }
    bool begin()
    {
        if (!showPanel(&panel, &window.context, keySettings()) || !window.isReady()
            || !waitUntil([this] { return buttonOf(&panel, QStringLiteral("Take control")) != nullptr; }))
            return false;
        QTest::mouseClick(buttonOf(&panel, QStringLiteral("Take control")), Qt::LeftButton);
        return waitUntil([this] { return buttonOf(&panel, QStringLiteral("Give back")) != nullptr; });
    }

    TestWindow window;
    QPlcKeyboardControl panel;
};

}  // namespace

class tst_QPlcKeyboardControl : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void settingsAreRestoredUnchanged();
    void operatorAcquiresUsesAndReleasesControl();
    void sentencesAndNamesHaveRoomInNarrowPanels();
    void valuesAndKeysHaveOnePrefix();
    void losingFocusOrHidingThePanelSetsNeutralValues_data();
    void losingFocusOrHidingThePanelSetsNeutralValues();
    void keyReleasedWithAnotherModifierIsReleased();
    void masterSetsNeutralValuesOnLostConnection();
    void panelAsksBeforeItAcquiresControlFromAnotherPerson();
    void removedPlantIsShownAsMissing_data();
    void removedPlantIsShownAsMissing();
    void keysAreEdited();
    void valuesOfKeysMayBeSmall();
    void panelHidesGamepadControlsWithoutGamepad();
    void panelWorksWithoutPlantOrKeys();
};

void tst_QPlcKeyboardControl::settingsAreRestoredUnchanged()
{
    QPlcKeyboardControl panel;
    QJsonObject settings = keySettings();
    settings.insert("axes",
                    QJsonArray{QJsonObject{{"axis", "LeftX"}, {"signal", "echo"}, {"value", 5.0}, {"expo", 0.5}}});
    settings.insert("later", 1);  // that nobody knows yet
    panel.applySettings(settings);
    QCOMPARE(panel.settings(), settings);
    panel.applySettings({{"title", QString()}});
    QCOMPARE(panel.settings(), (QJsonObject{{"later", 1}}));
}

void tst_QPlcKeyboardControl::operatorAcquiresUsesAndReleasesControl()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    Pilot pilot(master);
    QVERIFY(showPanel(&pilot.panel, &pilot.window.context, keySettings()) && pilot.window.isReady());
    // Said before, as it moves the plant.
    QTRY_VERIFY(labelsOf(&pilot.panel).contains(QStringLiteral("begin at neutral (all 0)")));
    QVERIFY(pilot.begin());
    QVERIFY(pilot.panel.hasFocus());
    QVERIFY(labelsOf(&pilot.panel).contains(QStringLiteral("You")));
    QTRY_COMPARE(master.valueOf(echo), 0.0);
    QTest::keyPress(&pilot.panel, Qt::Key_Left);
    QTRY_COMPARE(master.valueOf(echo), -3.0);
    QTest::keyPress(&pilot.panel, Qt::Key_W);
    QTRY_COMPARE(master.valueOf("setpoint"), 2.0);
    QTest::keyRelease(&pilot.panel, Qt::Key_Left);
    QTRY_COMPARE(master.valueOf(echo), 0.0);
    QCOMPARE(master.valueOf("setpoint"), 2.0);
    QTest::keyRelease(&pilot.panel, Qt::Key_W);
    QTRY_COMPARE(master.valueOf("setpoint"), 0.0);
    QVERIFY(actionOf(&pilot.panel, QStringLiteral("Give back")));
    QTest::keyClick(&pilot.panel, Qt::Key_B, Qt::ControlModifier);
    QTRY_VERIFY(labelsOf(&pilot.panel).contains(QStringLiteral("Echo")));
    QTRY_VERIFY(master.valueOf(echo) > 10.0);
    QTest::keyPress(&pilot.panel, Qt::Key_Left);
    QTest::qWait(50);
    QVERIFY(pilot.window.failed.isEmpty());
    QVERIFY(master.valueOf(echo) > 10.0);
}

void tst_QPlcKeyboardControl::sentencesAndNamesHaveRoomInNarrowPanels()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    TestWindow window(master.address());
    QPlcKeyboardControl panel;
    QVERIFY(showPanel(&panel, &window.context, keySettings()) && window.isReady());
    QTRY_VERIFY(labelsOf(&panel).contains(QStringLiteral("begin at neutral (")));
    for (const int width : {400, 300, 240}) {
        panel.resize(width, 300);
        QCoreApplication::processEvents();
        for (const ElidedLabel *label : panel.findChildren<ElidedLabel *>())
            QTRY_VERIFY2(!label->isElided() && label->height() >= label->heightForWidth(label->width()),
                         qPrintable(QStringLiteral("%1 at %2: %3 of %4 px")
                                        .arg(label->text())
                                        .arg(width)
                                        .arg(label->height())
                                        .arg(label->heightForWidth(label->width()))));
        const QAbstractButton *take = buttonOf(&panel, QStringLiteral("Take control"));
        QVERIFY(take && take->width() >= take->sizeHint().width());
    }
    const auto *keys = panel.findChild<KeyMapView *>();
    const int name = keys->fontMetrics().horizontalAdvance(QStringLiteral("setpoint"));
    const int above = keys->heightForWidth(name) - keys->heightForWidth(10 * name);
    QCOMPARE(above, 2 * keys->fontMetrics().height());  // each name has a line of its own
}

void tst_QPlcKeyboardControl::valuesAndKeysHaveOnePrefix()
{
    RunningMaster master(QPlcSignalTable::fromIni("[pull]\ntype = Real64\nunit = N\n"
                                                  "[turns]\ntype = Real64\nunit = 1\n"));
    TestWindow window(master.address());
    QPlcKeyboardControl panel;
    QVERIFY(showPanel(&panel, &window.context,
                      {{"keys",
                        QJsonArray{QJsonObject{{"key", "Left"}, {"signal", "pull"}, {"value", -20000.0}},
                                   QJsonObject{{"key", "W"}, {"signal", "turns"}, {"value", 2.0}}}}}));
    const auto *keys = panel.findChild<KeyMapView *>();
    QTRY_VERIFY(window.plant->table().size() > 0);
    QVERIFY(master.setSignalValue("pull", 1500.0));
    QTRY_VERIFY2(keys->accessibleDescription().contains(QStringLiteral("pull −20")),
                 qPrintable(keys->accessibleDescription()));
    QTRY_COMPARE(keys->valueText(0), QStringLiteral("1.5 kN"));
    QCOMPARE(keys->valueText(1), QStringLiteral("0"));
}

void tst_QPlcKeyboardControl::losingFocusOrHidingThePanelSetsNeutralValues_data()
{
    QTest::addColumn<int>("end");
    QTest::newRow("another field has the keyboard") << 0;
    QTest::newRow("the panel is hidden") << 1;
    QTest::newRow("another window is active") << 2;
    QTest::newRow("the panel is closed") << 3;
}

void tst_QPlcKeyboardControl::losingFocusOrHidingThePanelSetsNeutralValues()
{
    QFETCH(int, end);
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    auto pilot = std::make_unique<Pilot>(master);
    QVERIFY(pilot->begin());
    auto panel = &pilot->panel;
    QTest::keyPress(panel, Qt::Key_Left);
    QTRY_COMPARE(master.valueOf(echo), -3.0);
    QLineEdit other;
    if (end == 0)
        buttonOf(panel, QStringLiteral("Give back"))->setFocus();
    if (end == 1)
        panel->hide();
    if (end == 2) {
        other.show();
        other.activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(&other));
    }
    if (end == 3)
        pilot.reset();  // with its window: the master ends it, too
    QTRY_COMPARE(master.valueOf(echo), 0.0);
    if (end == 3)
        return;
    panel->show();
    panel->activateWindow();
    panel->setFocus();
    QTest::qWait(100);
    QCOMPARE(master.valueOf(echo), 0.0);  // held or not: it has to be pressed again
    QVERIFY(pilot->window.isMine(echo));
}

void tst_QPlcKeyboardControl::keyReleasedWithAnotherModifierIsReleased()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    Pilot pilot(master);
    QVERIFY(pilot.begin());
    const auto send = [&](QEvent::Type type, Qt::Key key, Qt::KeyboardModifiers modifiers, quint32 place) {
        QKeyEvent event(type, key, modifiers, place, 0, 0);
        QCoreApplication::sendEvent(&pilot.panel, &event);
    };
    send(QEvent::KeyPress, Qt::Key_Left, Qt::KeypadModifier, 83);
    QTRY_COMPARE(master.valueOf(echo), -3.0);
    send(QEvent::KeyPress, Qt::Key_Shift, Qt::ShiftModifier, 50);
    send(QEvent::KeyRelease, Qt::Key_4, Qt::KeypadModifier | Qt::ShiftModifier, 83);
    QTRY_COMPARE(master.valueOf(echo), 0.0);
}

void tst_QPlcKeyboardControl::masterSetsNeutralValuesOnLostConnection()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    Pilot pilot(master);
    QVERIFY(pilot.begin());
    QTest::keyPress(&pilot.panel, Qt::Key_Left);
    QTRY_COMPARE(master.valueOf(echo), -3.0);
    pilot.window.plant->close();  // not a word more
    QTRY_COMPARE(master.valueOf(echo), 0.0);
    QTRY_VERIFY(labelsOf(&pilot.panel).contains(QStringLiteral("No plant")));
    pilot.window.plant->open();
    QTRY_VERIFY(labelsOf(&pilot.panel).contains(QStringLiteral("was lost")));
    QTest::keyPress(&pilot.panel, Qt::Key_Left);
    QTest::qWait(100);
    QCOMPARE(master.valueOf(echo), 0.0);
    QTRY_VERIFY(buttonOf(&pilot.panel, QStringLiteral("Give back")));
    QTest::mouseClick(buttonOf(&pilot.panel, QStringLiteral("Give back")), Qt::LeftButton);
    QTRY_VERIFY(master.valueOf(echo) > 10.0);
}

void tst_QPlcKeyboardControl::panelAsksBeforeItAcquiresControlFromAnotherPerson()
{
    FlyingMaster master;
    TestWindow first(master.address(), QStringLiteral("First"));
    QVERIFY(first.isReady());
    first.plant->takeLease({echo});
    TestWindow second(master.address(), QStringLiteral("Second"));
    QPlcKeyboardControl panel;
    QVERIFY(showPanel(&panel, &second.context, keySettings()));
    QTRY_VERIFY(labelsOf(&panel).contains(QStringLiteral("Held by %1").arg(PlantLeases::whoever())));
    QTest::mouseClick(buttonOf(&panel, QStringLiteral("Take control")), Qt::LeftButton);
    QVERIFY(labelsOf(&panel).contains(QStringLiteral("take over?")));
    QTest::mouseClick(buttonOf(&panel, QStringLiteral("No")), Qt::LeftButton);
    QVERIFY(!labelsOf(&panel).contains(QStringLiteral("take over?")));
    QTest::qWait(50);
    QVERIFY(first.isMine(echo));
    QTest::mouseClick(buttonOf(&panel, QStringLiteral("Take control")), Qt::LeftButton);
    QTest::mouseClick(buttonOf(&panel, QStringLiteral("Take over")), Qt::LeftButton);
    QTRY_VERIFY(second.isMine(echo));
    QTRY_VERIFY(!first.isMine(echo));
}

void tst_QPlcKeyboardControl::removedPlantIsShownAsMissing_data()
{
    QTest::addColumn<bool>("isMine");
    QTest::newRow("written by a node") << false;
    QTest::newRow("under control") << true;
}

void tst_QPlcKeyboardControl::removedPlantIsShownAsMissing()
{
    QFETCH(bool, isMine);
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    Pilot pilot(master);
    QVERIFY(pilot.begin());
    if (isMine) {
        QTest::keyPress(&pilot.panel, Qt::Key_Left);
        QTRY_COMPARE(master.valueOf(echo), -3.0);
    } else {
        QTest::mouseClick(buttonOf(&pilot.panel, QStringLiteral("Give back")), Qt::LeftButton);
        QTRY_VERIFY(buttonOf(&pilot.panel, QStringLiteral("Take control")));
    }
    PlantList *plants = pilot.window.context.plants();
    plants->remove(plants->at(0));
    QVERIFY(!buttonOf(&pilot.panel, QStringLiteral("Take control")));
    QVERIFY(!buttonOf(&pilot.panel, QStringLiteral("Give back")));
}

void tst_QPlcKeyboardControl::keysAreEdited()
{
    QPlcKeyboardControl panel;
    panel.applySettings(keySettings());
    QSignalSpy edited(&panel, &QPlcWidget::settingsEdited);
    const std::unique_ptr<QWidget> editor(panel.createSettingsEditor());
    editor->show();
    auto *key = editor->findChild<KeyButton *>();
    QTest::mouseClick(key, Qt::LeftButton);
    QTest::keyClick(key, Qt::Key_A);
    QCOMPARE(edited.size(), 1);
    QCOMPARE(panel.settings().value("keys").toArray().at(0).toObject().value("key").toString(), QStringLiteral("A"));
    QTest::mouseClick(buttonOf(editor.get(), QStringLiteral("Add a key")), Qt::LeftButton);
    QTest::mouseClick(buttonOf(editor.get(), QStringLiteral("×")), Qt::LeftButton);
    QCOMPARE(edited.size(), 2);
    QCOMPARE(panel.settings().value("keys").toArray().at(0).toObject().value("key").toString(), QStringLiteral("W"));
}

void tst_QPlcKeyboardControl::valuesOfKeysMayBeSmall()
{
    QPlcKeyboardControl panel;
    panel.applySettings({{"keys", QJsonArray{QJsonObject{{"key", "Left"}, {"signal", "echo"}, {"value", 0.00025}}}}});
    const std::unique_ptr<QWidget> editor(panel.createSettingsEditor());
    editor->show();
    auto *value = editor->findChild<QDoubleSpinBox *>();
    QCOMPARE(value->text(), QStringLiteral("0.00025"));
    value->selectAll();
    QTest::keyClicks(value, QStringLiteral("-4e-5\r"));
    QCOMPARE(panel.settings().value("keys").toArray().at(0).toObject().value("value").toDouble(), -4e-5);
}

void tst_QPlcKeyboardControl::panelHidesGamepadControlsWithoutGamepad()
{
    if (Gamepad().isConnected())
        QSKIP("a gamepad is plugged in", "");
    WindowContext context;
    QPlcKeyboardControl panel;
    QJsonObject settings = keySettings();
    settings.insert("axes", QJsonArray{QJsonObject{{"axis", "RightY"}, {"signal", "echo"}, {"value", 5.0}}});
    QVERIFY(showPanel(&panel, &context, settings));
    auto *keys = panel.findChild<KeyMapView *>();
    QVERIFY(keys->accessibleDescription().contains(QStringLiteral("W: setpoint")));
    QVERIFY(!keys->accessibleDescription().contains(QStringLiteral("RightY")));
    QVERIFY(!actionOf(&panel, QStringLiteral("Arm gamepad"))->isVisible());
    QVERIFY(!labelsOf(&panel).contains(QStringLiteral("gamepad")));
    keys->setAxesShown(true);  // as soon as one comes
    QVERIFY(keys->accessibleDescription().contains(QStringLiteral("RightY: echo ±5")));
    const std::unique_ptr<QWidget> editor(panel.createSettingsEditor());
    editor->show();
    QVERIFY(labelsOf(editor.get()).contains(QStringLiteral("gamepad")));
    settings.remove("keys");
    panel.applySettings(settings);
    QVERIFY(labelsOf(&panel).contains(QStringLiteral("gamepad")));  // there is nothing else to steer with
}

void tst_QPlcKeyboardControl::panelWorksWithoutPlantOrKeys()
{
    QPlcKeyboardControl bare;
    bare.show();
    QTest::keyClick(&bare, Qt::Key_Left);
    WindowContext context;
    QPlcKeyboardControl panel;
    QVERIFY(showPanel(&panel, &context, {}));
    QVERIFY(labelsOf(&panel).contains(QStringLiteral("No keys yet")));
    panel.applySettings(keySettings());
    QVERIFY(labelsOf(&panel).contains(QStringLiteral("There is no signal 'echo' at the moment")));
    QTest::keyClick(&panel, Qt::Key_Left);
    QVERIFY(!panel.grab().isNull());
}

QTEST_MAIN(tst_QPlcKeyboardControl)
#include "tst_QPlcKeyboardControl.moc"
