// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "TwoPlants.h"

using namespace qplc;

namespace {

const QString echo = QStringLiteral("echo");
const QString setpoint = QStringLiteral("setpoint");
const QString number = QStringLiteral("number");
const QString momentary = QStringLiteral("momentary");

void typeInto(QWidget *setter, const QString &text)
{
    auto *field = setter->findChild<QLineEdit *>();
    QTRY_VERIFY(field->isEnabled());
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, text);
}

}  // namespace

/// Which plant a window means, and says that it means, when it has several.
class tst_SeveralPlants : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void badgesAreHiddenWithOnePlant();
    void panelsFollowTheSelectedPlantAndNameIt();
    void aQualifiedOrPinnedPanelStaysWithItsPlant();
    void panelMenuPinsThePanelAsAnUndoStep();
    void panelNamesItsMissingPlantAndShowsNoOther();
    void typedValueIsNotSentToTheNextPlant();
    void heldButtonIsReleasedInItsOwnPlant();
    void heldKeysAreReleasedInTheirOwnPlant();
    void controlIsAcquiredFromTheShownPlant();
    void stopActsOnTheControlledPlant();
    void escapeTwiceStopsTheControlledPlant();
    void stopNeverMovesToAnotherPlantWhenTheControlledOneIsLost();
    void stopAsksWhenSeveralPlantsAreControlled();
    void stopReasonRecordsHowTheQuestionWasAnswered();
    void badgeIsNotElidedWhenItFits();
    void resetKeyBelongsToTheSelectedPlant();
    void histogramsFollowTheSelectedPlant();

private:
    std::unique_ptr<TestSettings> m_settings;
};

void tst_SeveralPlants::badgesAreHiddenWithOnePlant()
{
    TwoPlants fixture;
    QPlcSetter *setter = fixture.addSetter(setpoint, number);
    QVERIFY(fixture.isReady());
    QVERIFY(!TwoPlants::badgeOf(setter).isEmpty());
    QVERIFY(!fixture.topBar()->stopButton()->detail().isEmpty());
    fixture.window.disconnectFromMaster(QStringLiteral("north"));
    QCOMPARE(TwoPlants::badgeOf(setter), QString());
    QCOMPARE(fixture.topBar()->stopButton()->detail(), QString());
}

void tst_SeveralPlants::panelsFollowTheSelectedPlantAndNameIt()
{
    TwoPlants fixture;
    QPlcSetter *setter = fixture.addSetter(setpoint, number);
    QPlcWidget *plot
        = fixture.addPanel(QStringLiteral("Time plot"),
                           {{QStringLiteral("curves"), QJsonArray{QJsonObject{{QStringLiteral("signal"), echo}}}}});
    QVERIFY(fixture.isReady());
    QCOMPARE(fixture.barPlant(), QStringLiteral("north"));
    QCOMPARE(TwoPlants::badgeOf(setter), QStringLiteral("north"));
    const PanelTitleBar *title = TwoPlants::frameOf(setter)->titleBar();
    const QColor ofNorth = title->badge().color;
    QVERIFY(title->badgeRect().width() > title->fontMetrics().horizontalAdvance(QStringLiteral("north")));
    fixture.selectNext();
    QCOMPARE(fixture.barPlant(), QStringLiteral("south"));
    for (QWidget *panel : {static_cast<QWidget *>(setter), static_cast<QWidget *>(plot)})
        QCOMPARE(TwoPlants::badgeOf(panel), QStringLiteral("south"));
    QVERIFY(title->badge().color != ofNorth);
    typeInto(setter, QStringLiteral("2.5\r"));
    QTRY_COMPARE(fixture.south.valueOf(setpoint), 2.5);
    QVERIFY(fixture.settle());
    QCOMPARE(fixture.northTap.commands().size(), 0);
    QCOMPARE(fixture.southTap.count(QPlcMessage::SetSignals), 1);
}

void tst_SeveralPlants::aQualifiedOrPinnedPanelStaysWithItsPlant()
{
    TwoPlants fixture;
    QPlcSetter *qualified = fixture.addSetter(QStringLiteral("north/setpoint"), number);
    QPlcSetter *pinned = fixture.addSetter(setpoint, number, QStringLiteral("north"));
    QVERIFY(fixture.isReady());
    fixture.selectNext();
    QCOMPARE(fixture.barPlant(), QStringLiteral("south"));
    QCOMPARE(TwoPlants::badgeOf(qualified), QStringLiteral("north"));
    QCOMPARE(TwoPlants::badgeOf(pinned), QStringLiteral("north"));
    QVERIFY(TwoPlants::frameOf(pinned)->titleBar()->badge().isPinned);
    QVERIFY(!TwoPlants::frameOf(qualified)->titleBar()->badge().isPinned);
    typeInto(qualified, QStringLiteral("1\r"));
    QTRY_COMPARE(fixture.north.valueOf(setpoint), 1.0);
    typeInto(pinned, QStringLiteral("2\r"));
    QTRY_COMPARE(fixture.north.valueOf(setpoint), 2.0);
    QVERIFY(fixture.settle());
    QCOMPARE(fixture.southTap.commands().size(), 0);
}

void tst_SeveralPlants::panelMenuPinsThePanelAsAnUndoStep()
{
    TwoPlants fixture;
    QPlcSetter *setter = fixture.addSetter(setpoint, number);
    QVERIFY(fixture.isReady());
    PanelTitleBar *title = TwoPlants::frameOf(setter)->titleBar();
    QTest::mouseClick(title, Qt::LeftButton, {}, title->badgeRect().center());
    auto *menu = qobject_cast<QMenu *>(QApplication::activePopupWidget());
    QVERIFY(menu);
    TwoPlants::choose(menu, QStringLiteral("Pin to south"));
    QCOMPARE(TwoPlants::badgeOf(setter), QStringLiteral("south"));
    QCOMPARE(fixture.barPlant(), QStringLiteral("north"));
    QVERIFY(fixture.window.layoutJson().contains("\"plant\""));
    fixture.editor->undoStack()->undo();
    QCOMPARE(TwoPlants::badgeOf(setter), QStringLiteral("north"));
}

void tst_SeveralPlants::panelNamesItsMissingPlantAndShowsNoOther()
{
    TwoPlants fixture;
    QPlcSetter *setter = fixture.addSetter(setpoint, number, QStringLiteral("east"));
    QVERIFY(fixture.isReady());
    QCOMPARE(TwoPlants::badgeOf(setter), QStringLiteral("east"));
    QVERIFY(!setter->findChild<QLineEdit *>()->isEnabled());
}

void tst_SeveralPlants::typedValueIsNotSentToTheNextPlant()
{
    TwoPlants fixture;
    QPlcSetter *setter = fixture.addSetter(setpoint, number);
    QVERIFY(fixture.isReady());
    typeInto(setter, QStringLiteral("7.5"));
    fixture.selectNext();
    QVERIFY(setter->isAncestorOf(QApplication::focusWidget()));
    fixture.press(Qt::Key_Return);
    QVERIFY(fixture.settle());
    QVERIFY(fixture.north.valueOf(setpoint) != 7.5);
    QVERIFY(fixture.south.valueOf(setpoint) != 7.5);
}

void tst_SeveralPlants::heldButtonIsReleasedInItsOwnPlant()
{
    TwoPlants fixture;
    QPlcSetter *setter = fixture.addSetter(setpoint, momentary);
    QVERIFY(fixture.isReady());
    auto *button = qobject_cast<QAbstractButton *>(setter->focusProxy()->focusProxy());
    QTRY_VERIFY(button->isEnabled());
    QTest::mousePress(button, Qt::LeftButton);
    QTRY_COMPARE(fixture.north.valueOf(setpoint), 10.0);
    fixture.selectNext();
    QTRY_COMPARE(fixture.north.valueOf(setpoint), 0.0);
    QTRY_VERIFY(fixture.north.leases().isEmpty());
    QTest::mouseRelease(setter, Qt::LeftButton);
    QVERIFY(fixture.settle());
    QCOMPARE(fixture.southTap.commands().size(), 0);
}

void tst_SeveralPlants::heldKeysAreReleasedInTheirOwnPlant()
{
    TwoPlants fixture;
    QPlcKeyboardControl *keyboard = fixture.addKeyboard();
    QVERIFY(fixture.isReady());
    QTRY_VERIFY(TwoPlants::take(keyboard));
    QTRY_VERIFY(fixture.plant(0)->lease(echo) && fixture.plant(0)->lease(echo)->isMine);
    keyboard->setFocus();
    QTest::keyPress(keyboard, Qt::Key_W);
    QTRY_COMPARE(fixture.north.valueOf(echo), 4.0);
    fixture.selectNext();
    QTRY_COMPARE(fixture.north.valueOf(echo), 0.0);
    QTest::keyRelease(keyboard, Qt::Key_W);
    QTest::keyPress(keyboard, Qt::Key_W);
    QVERIFY(fixture.settle());
    QCOMPARE(fixture.southTap.commands().size(), 0);
    QVERIFY(labelsOf(keyboard).contains(QStringLiteral("south: ")));
}

void tst_SeveralPlants::controlIsAcquiredFromTheShownPlant()
{
    TwoPlants fixture;
    QPlcSetter *setter = fixture.addSetter(echo, number);
    QVERIFY(fixture.isReady());
    fixture.selectNext();
    QTRY_VERIFY(TwoPlants::take(setter));
    QTRY_COMPARE(fixture.south.leases().size(), 1);
    QCOMPARE(fixture.northTap.commands().size(), 0);
}

void tst_SeveralPlants::stopActsOnTheControlledPlant()
{
    TwoPlants fixture;
    QPlcSetter *setter = fixture.addSetter(QStringLiteral("south/echo"), number);
    QVERIFY(fixture.isReady());
    QCOMPARE(fixture.stopPlants(), QStringList(QStringLiteral("north")));
    QTRY_VERIFY(TwoPlants::take(setter));
    QTRY_COMPARE(fixture.stopPlants(), QStringList(QStringLiteral("south")));
    QCOMPARE(fixture.barPlant(), QStringLiteral("north"));
    QVERIFY(fixture.action("Stop south (Esc Esc)"));
    QTest::mouseClick(fixture.topBar()->stopButton(), Qt::LeftButton);
    QTRY_COMPARE(fixture.south.state(), QPlcMasterNode::Off);
    QCOMPARE(fixture.barPlant(), QStringLiteral("south"));  // what comes next is for what was stopped
    QVERIFY(fixture.settle());
    QCOMPARE(fixture.north.state(), QPlcMasterNode::RealTime);
    QCOMPARE(fixture.northTap.commands().size(), 0);
}

void tst_SeveralPlants::escapeTwiceStopsTheControlledPlant()
{
    TwoPlants fixture;
    QPlcSetter *setter = fixture.addSetter(QStringLiteral("south/echo"), number);
    QVERIFY(fixture.isReady());
    QTRY_VERIFY(TwoPlants::take(setter));
    QTRY_COMPARE(fixture.stopPlants(), QStringList(QStringLiteral("south")));
    fixture.window.setFocus();
    fixture.press(Qt::Key_Escape);
    fixture.press(Qt::Key_Escape);
    QTRY_COMPARE(fixture.south.state(), QPlcMasterNode::Off);
    QVERIFY(fixture.settle());
    QCOMPARE(fixture.northTap.commands().size(), 0);
}

/// A person whose plant does not answer any more presses Escape again and again.
void tst_SeveralPlants::stopNeverMovesToAnotherPlantWhenTheControlledOneIsLost()
{
    TwoPlants fixture;
    QPlcSetter *setter = fixture.addSetter(QStringLiteral("south/echo"), number);
    QVERIFY(fixture.isReady());
    QTRY_VERIFY(TwoPlants::take(setter));
    QTRY_COMPARE(fixture.stopPlants(), QStringList(QStringLiteral("south")));
    fixture.southTap.cut();
    QTRY_VERIFY(!fixture.plant(1)->isConnected());
    QCOMPARE(fixture.stopPlants(), QStringList(QStringLiteral("south")));
    fixture.window.setFocus();
    fixture.press(Qt::Key_Escape);
    fixture.press(Qt::Key_Escape);
    QTRY_COMPARE(fixture.barPlant(), QStringLiteral("south"));
    QTest::mouseClick(fixture.topBar()->stopButton(), Qt::LeftButton);
    QTest::qWait(100);
    QCOMPARE(fixture.northTap.count(QPlcMessage::Stop), 0);
    QCOMPARE(fixture.north.state(), QPlcMasterNode::RealTime);
    fixture.selectNext();  // now north is what the person means
    QCOMPARE(fixture.stopPlants(), QStringList(QStringLiteral("north")));
    QTest::mouseClick(fixture.topBar()->stopButton(), Qt::LeftButton);
    QTRY_COMPARE(fixture.north.state(), QPlcMasterNode::Off);
}

void tst_SeveralPlants::stopReasonRecordsHowTheQuestionWasAnswered()
{
    TwoPlants fixture;
    QPlcSetter *ofNorth = fixture.addSetter(QStringLiteral("north/echo"), number);
    QPlcSetter *ofSouth = fixture.addSetter(QStringLiteral("south/echo"), number);
    QVERIFY(fixture.isReady());
    QTRY_VERIFY(TwoPlants::take(ofNorth) && TwoPlants::take(ofSouth));
    QTRY_COMPARE(fixture.stopPlants().size(), 2);
    fixture.window.setFocus();
    for (int press = 0; press < 4; ++press)
        fixture.press(Qt::Key_Escape);
    QTRY_VERIFY(fixture.plant(1)->status().master.stopped);
    QCOMPARE(fixture.plant(1)->status().master.stopped->how, QStringLiteral("Esc Esc"));
}

/// Letters have widths that are no whole pixels.
void tst_SeveralPlants::badgeIsNotElidedWhenItFits()
{
    PanelTitleBar title;
    title.resize(600, 24);
    for (double size = 6.0; size < 20.0; size += 0.1) {
        QFont font = title.font();
        font.setPointSizeF(size);
        font.setHintingPreference(QFont::PreferNoHinting);
        title.setFont(font);
        for (const char *name : {"north", "south", "winch1", "winch2"}) {
            const QString text = QString::fromLatin1(name);
            title.setBadge({text, Qt::blue, Qt::white, QString(), false});
            const int room = title.badgeRect().width() - 12;
            QVERIFY2(title.fontMetrics().elidedText(text, Qt::ElideRight, room) == text,
                     qPrintable(QStringLiteral("%1 at %2").arg(text).arg(size)));
        }
    }
}

void tst_SeveralPlants::stopAsksWhenSeveralPlantsAreControlled()
{
    TwoPlants fixture;
    QPlcSetter *ofNorth = fixture.addSetter(QStringLiteral("north/echo"), number);
    QPlcSetter *ofSouth = fixture.addSetter(QStringLiteral("south/echo"), number);
    QVERIFY(fixture.isReady());
    QTRY_VERIFY(TwoPlants::take(ofNorth) && TwoPlants::take(ofSouth));
    QTRY_COMPARE(fixture.topBar()->stopButton()->detail(), QStringLiteral("north, south?"));
    auto *question = fixture.part<StopQuestion>();
    const auto isStopped = [&](const CommandTap &tap) { return tap.count(QPlcMessage::Stop) > 0; };
    QTest::mouseClick(fixture.topBar()->stopButton(), Qt::LeftButton);
    QVERIFY(question->text().startsWith(QStringLiteral("You control north, south.")));
    QVERIFY(fixture.settle());
    QVERIFY(!isStopped(fixture.northTap) && !isStopped(fixture.southTap));
    QTest::mouseClick(buttonOf(question, QStringLiteral("Stop south")), Qt::LeftButton);
    QVERIFY(question->isHidden());
    QTRY_COMPARE(fixture.south.state(), QPlcMasterNode::Off);
    QVERIFY(!isStopped(fixture.northTap));

    QTest::mouseClick(fixture.topBar()->stopButton(), Qt::LeftButton);
    QTest::mouseClick(buttonOf(question, QStringLiteral("Stop none")), Qt::LeftButton);
    QVERIFY(question->isHidden());
    QVERIFY(fixture.settle());
    QVERIFY(!isStopped(fixture.northTap));
    QTest::mouseClick(fixture.topBar()->stopButton(), Qt::LeftButton);
    QTest::mouseClick(fixture.topBar()->stopButton(), Qt::LeftButton);  // once more is "all"
    QTRY_COMPARE(fixture.north.state(), QPlcMasterNode::Off);

    QTest::mouseClick(fixture.topBar()->stopButton(), Qt::LeftButton);
    QVERIFY(!question->isHidden());
    fixture.press(Qt::Key_G, Qt::ControlModifier);  // nothing is controlled any more: nothing is asked
    QTRY_VERIFY(question->isHidden());
}

void tst_SeveralPlants::resetKeyBelongsToTheSelectedPlant()
{
    TwoPlants fixture;
    QVERIFY(fixture.isReady());
    fixture.south.safeStop(QStringLiteral("test"));
    auto *banner = fixture.part<LatchBanner>();
    QTRY_VERIFY(banner->isVisible());
    QVERIFY(banner->accessibleName().startsWith(QStringLiteral("south ")));
    auto *reset = banner->findChild<BarButton *>();
    QCOMPARE(reset->detail(), QString());
    fixture.selectNext();
    QCOMPARE(reset->detail(), QStringLiteral("F7"));
    fixture.north.safeStop(QStringLiteral("test"));
    QTRY_VERIFY(fixture.plant(0)->status().isLatched());
    QVERIFY(banner->accessibleName().startsWith(QStringLiteral("south ")));
    fixture.selectNext();
    QVERIFY(banner->accessibleName().startsWith(QStringLiteral("north ")));
}

void tst_SeveralPlants::histogramsFollowTheSelectedPlant()
{
    TwoPlants fixture;
    QPlcWidget *histogram = fixture.addPanel(QStringLiteral("Jitter histogram"), {});
    QVERIFY(fixture.isReady());
    QTRY_VERIFY(labelsOf(histogram).contains(QStringLiteral("north: ")));
    fixture.selectNext();
    QCOMPARE(TwoPlants::badgeOf(histogram), QStringLiteral("south"));
    QTRY_VERIFY(labelsOf(histogram).contains(QStringLiteral("south: ")));
}

QTEST_MAIN(tst_SeveralPlants)
#include "tst_SeveralPlants.moc"
