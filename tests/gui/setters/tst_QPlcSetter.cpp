// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "QPlcSetter.h"
#include "SetterFixtures.h"

#include <QtWidgets/QComboBox>
#include <QtWidgets/QDoubleSpinBox>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QSlider>

using namespace qplc;

namespace {

const QString setpoint = QStringLiteral("setpoint");
const QString echo = QStringLiteral("echo");

QJsonObject settingsOf(const QString &signal, const QString &style)
{
    return {{"signal", signal}, {"style", style}};
}

}  // namespace

class tst_QPlcSetter : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void settingsAreRestoredUnchanged();
    void enterSendsOnceAndTypingNever();
    void editedTextIsKeptUntilEscapeRevertsIt();
    void valuesBeyondTheTableBecomeTheLimit();
    void keysStepByShareOfTheRange();
    void sliderLimitsItsRateAndAlwaysSendsTheEndValue();
    void sliderReportsMissingLimits();
    void aSwitchSendsOnceForEachClick();
    void aSwitchNamesTheValueOfABoolean();
    void buttonSetsItsValueWhileHeld_data();
    void buttonSetsItsValueWhileHeld();
    void aHeldButtonIsNeutralWhenTheWindowIsLost();
    void aGeneratorKeepsNumbersOfAnySize();
    void controlStartsFromTheCurrentValue_data();
    void controlStartsFromTheCurrentValue();
    void aGeneratorRunsAndEndsInNeutral_data();
    void aGeneratorRunsAndEndsInNeutral();
    void signalOfANodeRequiresControlFirst();
    void aRefusalIsShown();
    void aDroppedSignalReplacesTheOneBefore();
    void panelWorksWithoutPlantOrSignal();
};

void tst_QPlcSetter::settingsAreRestoredUnchanged()
{
    const QJsonObject waveform{{"shape", "step"}, {"amplitude", 2.0}, {"offset", -1.0}, {"period", 4.0}};
    for (const QJsonObject &settings :
         {QJsonObject{{"signal", "kite/vector[1]"}},
          QJsonObject{{"signal", "echo"}, {"style", "slider"}, {"minimum", -1.0}, {"maximum", 2.5}},
          QJsonObject{{"signal", "echo"}, {"style", "toggle"}, {"on", 5.0}, {"later", 1}},
          QJsonObject{{"signal", "echo"}, {"style", "momentary"}, {"pressed", 5.0}, {"title", "Brake"}},
          QJsonObject{{"signal", "echo"}, {"style", "generator"}, {"generator", waveform}}, QJsonObject()}) {
        QPlcSetter setter;
        setter.applySettings(settings);
        QCOMPARE(setter.settings(), settings);
        QPlcSetter other;
        other.applySettings(settingsOf(echo, QStringLiteral("generator")));
        other.applySettings(settings);  // what is missing is a default, so that undo works
        QCOMPARE(other.settings(), settings);
    }
    QPlcSetter setter;
    setter.applySettings({{"style", "lever"}, {"signal", 5}, {"minimum", "low"}});
    QCOMPARE(setter.settings(), QJsonObject());
}

void tst_QPlcSetter::enterSendsOnceAndTypingNever()
{
    FlyingMaster master;
    TestWindow window(master.address());
    QPlcSetter setter;
    QVERIFY(showPanel(&setter, &window.context, settingsOf(setpoint, QStringLiteral("number"))));
    QVERIFY(window.isReady());
    auto *field = setter.findChild<QLineEdit *>();
    QTRY_VERIFY(field->isEnabled());
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, QStringLiteral("1.25"));
    QTest::qWait(100);
    QCOMPARE(window.done.size(), 0);
    QTest::keyClick(field, Qt::Key_Return);
    QTRY_COMPARE(master.valueOf(setpoint), 1.25);
    QTest::qWait(100);
    QCOMPARE(window.done.size(), 1);
    QTest::keyClicks(field, QStringLiteral("2"));
    QTest::mouseClick(buttonOf(&setter, QStringLiteral("Set")), Qt::LeftButton);
    QTRY_COMPARE(master.valueOf(setpoint), 2.0);
    field->clearFocus();  // is no Enter
    QTest::qWait(50);
    QCOMPARE(window.done.size(), 2);
    QTest::keyClicks(field, QStringLiteral("nonsense"));
    QTest::keyClick(field, Qt::Key_Return);
    QTest::qWait(50);
    QCOMPARE(window.done.size() + window.failed.size(), 2);
    QVERIFY(labelsOf(&setter).contains(QStringLiteral("nonsense")));
    QTRY_VERIFY(labelsOf(&setter).contains(QStringLiteral("2 m/s")));  // the actual value
}

void tst_QPlcSetter::editedTextIsKeptUntilEscapeRevertsIt()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    TestWindow window(master.address());
    QPlcSetter setter;
    QVERIFY(showPanel(&setter, &window.context, settingsOf(setpoint, QStringLiteral("number"))));
    QVERIFY(window.isReady());
    auto *field = setter.findChild<QLineEdit *>();
    QTRY_VERIFY(field->isEnabled());
    QVERIFY(master.setSignalValue(setpoint, 3.0));
    QTRY_COMPARE(field->text(), QStringLiteral("3"));
    field->setFocus();
    QTest::keyClick(field, Qt::Key_End);
    QTest::keyClicks(field, QStringLiteral(".5"));
    QVERIFY(master.setSignalValue(setpoint, 4.0));
    QTRY_VERIFY(labelsOf(&setter).contains(QStringLiteral("4 m/s")));
    QTest::qWait(250);
    QCOMPARE(field->text(), QStringLiteral("3.5"));
    QTest::keyClick(field, Qt::Key_Escape);
    QTRY_COMPARE(field->text(), QStringLiteral("4"));
    QCOMPARE(window.done.size(), 0);
}

void tst_QPlcSetter::valuesBeyondTheTableBecomeTheLimit()
{
    FlyingMaster master;
    TestWindow window(master.address());
    QPlcSetter setter;
    QVERIFY(showPanel(&setter, &window.context, settingsOf(setpoint, QStringLiteral("number"))));
    QVERIFY(window.isReady());
    auto *field = setter.findChild<QLineEdit *>();
    QTRY_VERIFY(field->isEnabled());
    field->selectAll();
    QTest::keyClicks(field, QStringLiteral("99"));
    QTest::keyClick(field, Qt::Key_Return);
    QTRY_COMPARE(master.valueOf(setpoint), 10.0);
    QVERIFY(labelsOf(&setter).contains(QStringLiteral("At most 10 m/s")));
    QCOMPARE(field->text(), QStringLiteral("10"));
    setter.applySettings({{"signal", setpoint}, {"minimum", -2.0}});
    field = setter.findChild<QLineEdit *>();
    field->selectAll();
    QTest::keyClicks(field, QStringLiteral("-5"));
    QTest::keyClick(field, Qt::Key_Return);
    QTRY_COMPARE(master.valueOf(setpoint), -2.0);
    QVERIFY(window.failed.isEmpty());
}

void tst_QPlcSetter::keysStepByShareOfTheRange()
{
    FlyingMaster master;
    TestWindow window(master.address());
    QPlcSetter setter;
    QVERIFY(showPanel(&setter, &window.context, settingsOf(setpoint, QStringLiteral("number"))));
    QVERIFY(window.isReady());
    auto *field = setter.findChild<QLineEdit *>();
    QTRY_VERIFY(field->isEnabled());
    QTest::keyClick(field, Qt::Key_Up);
    QCOMPARE(field->text(), QStringLiteral("0.2"));  // of -10 ... 10
    QTest::keyClick(field, Qt::Key_PageDown);
    QCOMPARE(field->text(), QStringLiteral("-1.8"));
    QTest::mouseClick(buttonOf(&setter, QStringLiteral("++")), Qt::LeftButton);
    QCOMPARE(field->text(), QStringLiteral("0.2"));
    for (int i = 0; i < 6; ++i)
        QTest::keyClick(field, Qt::Key_PageUp);
    QCOMPARE(field->text(), QStringLiteral("10"));
    QCOMPARE(window.done.size(), 0);
    QTest::keyClick(field, Qt::Key_Return);
    QTRY_COMPARE(master.valueOf(setpoint), 10.0);
}

void tst_QPlcSetter::sliderLimitsItsRateAndAlwaysSendsTheEndValue()
{
    FlyingMaster master;
    TestWindow window(master.address());
    QPlcSetter setter;
    QVERIFY(showPanel(&setter, &window.context, settingsOf(setpoint, QStringLiteral("slider"))));
    QVERIFY(window.isReady());
    auto *slider = setter.findChild<QSlider *>();
    QTRY_VERIFY(slider->isEnabled());
    QTRY_COMPARE(slider->value(), 500);
    QElapsedTimer time;
    time.start();
    slider->setSliderDown(true);
    for (int i = 501; i <= 700; ++i) {
        slider->setSliderPosition(i);
        QTest::qWait(1);
    }
    QTRY_COMPARE(master.valueOf(setpoint), 4.0);  // also without a release
    QVERIFY2(window.done.size() <= int(time.elapsed() / 50) + 2, qPrintable(QString::number(window.done.size())));
    slider->setSliderPosition(725);
    slider->setSliderPosition(750);
    const int before = window.done.size();
    slider->setSliderDown(false);
    QTRY_COMPARE(master.valueOf(setpoint), 5.0);
    QTest::qWait(150);
    QVERIFY(window.done.size() <= before + 2);
    QCOMPARE(slider->value(), 750);
}

void tst_QPlcSetter::sliderReportsMissingLimits()
{
    FlyingMaster master;
    TestWindow window(master.address());
    QPlcSetter setter;
    QVERIFY(showPanel(&setter, &window.context, settingsOf(QStringLiteral("free"), QStringLiteral("slider"))));
    QVERIFY(window.isReady());
    QTRY_VERIFY(labelsOf(&setter).contains(QStringLiteral("no limits")));
    QVERIFY(!setter.findChild<QSlider *>()->isEnabled());
    setter.applySettings({{"signal", "free"}, {"style", "slider"}, {"minimum", 0.0}, {"maximum", 4.0}});
    QTRY_VERIFY(setter.findChild<QSlider *>()->isEnabled());
    QTest::keyClick(setter.findChild<QSlider *>(), Qt::Key_End);
    QTRY_COMPARE(master.valueOf(QStringLiteral("free")), 4.0);
}

void tst_QPlcSetter::aSwitchSendsOnceForEachClick()
{
    FlyingMaster master;
    TestWindow window(master.address());
    QPlcSetter setter;
    QVERIFY(showPanel(&setter, &window.context, {{"signal", "free"}, {"style", "toggle"}, {"on", 3.0}}));
    QVERIFY(window.isReady());
    auto *button = static_cast<QAbstractButton *>(setter.focusProxy()->focusProxy());
    QTRY_VERIFY(button->isEnabled());
    QTest::mouseClick(button, Qt::LeftButton);
    QTRY_COMPARE(master.valueOf(QStringLiteral("free")), 3.0);
    QVERIFY(button->isChecked());
    QTest::keyClick(button, Qt::Key_Space);
    QTRY_COMPARE(master.valueOf(QStringLiteral("free")), 0.0);
    QTRY_COMPARE(window.done.size(), 2);
    QVERIFY(master.setSignalValue(QStringLiteral("free"), 3.0F));
    QTRY_VERIFY(button->isChecked());  // by somebody else
}

void tst_QPlcSetter::aSwitchNamesTheValueOfABoolean()
{
    RunningMaster master(QPlcSignalTable::fromIni("[time]\ntype = DateTime\n[brake]\ntype = Bool\n"));
    TestWindow window(master.address());
    QPlcSetter setter;
    QVERIFY(showPanel(&setter, &window.context, settingsOf(QStringLiteral("brake"), QStringLiteral("toggle"))));
    const auto texts = [&setter] { return labelsOf(&setter).split(QLatin1Char('\n')); };
    QTRY_VERIFY2(texts().contains(QStringLiteral("off")), qPrintable(labelsOf(&setter)));
    QVERIFY(!texts().contains(QStringLiteral("0")));
    QVERIFY(master.setSignalValue(QStringLiteral("brake"), true));
    QTRY_VERIFY2(texts().contains(QStringLiteral("on")), qPrintable(labelsOf(&setter)));
    QVERIFY(!texts().contains(QStringLiteral("1")));
}

void tst_QPlcSetter::buttonSetsItsValueWhileHeld_data()
{
    QTest::addColumn<int>("end");
    QTest::newRow("released") << 0;
    QTest::newRow("focus goes elsewhere") << 1;
    QTest::newRow("hidden") << 2;
    QTest::newRow("another signal") << 3;
}

void tst_QPlcSetter::buttonSetsItsValueWhileHeld()
{
    QFETCH(int, end);
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    TestWindow window(master.address());
    QPlcSetter setter;
    QVERIFY(showPanel(&setter, &window.context, settingsOf(setpoint, QStringLiteral("momentary"))));
    QVERIFY(window.isReady());
    auto *button = setter.findChild<QPushButton *>();
    QTRY_VERIFY(button->isEnabled());
    button->setFocus();
    QTest::mousePress(button, Qt::LeftButton);
    QTRY_COMPARE(master.valueOf(setpoint), 10.0);
    QTRY_VERIFY(window.isMine(setpoint));  // while it is held
    if (end == 0)
        QTest::mouseRelease(button, Qt::LeftButton);
    if (end == 1)
        button->clearFocus();
    if (end == 2)
        setter.hide();
    if (end == 3)
        setter.addSignals({QStringLiteral("free")});
    QTRY_COMPARE(master.valueOf(setpoint), 0.0);
    QTRY_VERIFY(!window.plant->lease(setpoint));
    QVERIFY(window.failed.isEmpty());
}

void tst_QPlcSetter::aHeldButtonIsNeutralWhenTheWindowIsLost()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    TestWindow window(master.address());
    QPlcSetter setter;
    QVERIFY(showPanel(&setter, &window.context, settingsOf(setpoint, QStringLiteral("momentary"))));
    QVERIFY(window.isReady());
    auto *button = setter.findChild<QPushButton *>();
    QTRY_VERIFY(button->isEnabled());
    QTest::mousePress(button, Qt::LeftButton);
    QTRY_VERIFY(window.isMine(setpoint));
    window.plant->close();
    QTRY_COMPARE(master.valueOf(setpoint), 0.0);
    QVERIFY(!button->isDown());
    QVERIFY(labelsOf(&setter).contains(QStringLiteral("Control was lost")));
}

void tst_QPlcSetter::aGeneratorKeepsNumbersOfAnySize()
{
    QPlcSetter setter;
    QJsonObject waveform{{"amplitude", 0.00025}, {"offset", -0.00012345678912}};
    const auto settings = [&waveform] {
        return QJsonObject{{"signal", "echo"}, {"style", "generator"}, {"generator", waveform}};
    };
    setter.applySettings(settings());
    QStringList texts;
    for (const QDoubleSpinBox *field : setter.findChildren<QDoubleSpinBox *>())
        texts << field->text();
    QVERIFY2(texts.contains(QStringLiteral("± 0.00025")), qPrintable(texts.join(QStringLiteral("; "))));
    auto *shape = setter.findChild<QComboBox *>();
    shape->setCurrentIndex(0);
    Q_EMIT shape->activated(0);
    waveform.insert("shape", "step");
    QCOMPARE(setter.settings(), settings());
}

void tst_QPlcSetter::controlStartsFromTheCurrentValue_data()
{
    QTest::addColumn<bool>("moves");  // whether a key moves it
    QTest::newRow("slider") << true;
    QTest::newRow("knob") << true;
    QTest::newRow("number") << true;
    QTest::newRow("toggle") << false;
    QTest::newRow("momentary") << false;
    QTest::newRow("generator") << false;
}

/// The writer counts up: a value that falls is a jump.
void tst_QPlcSetter::controlStartsFromTheCurrentValue()
{
    QFETCH(bool, moves);
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    TestWindow window(master.address());
    QPlcSetter setter;
    QJsonObject settings = settingsOf(echo, QLatin1String(QTest::currentDataTag()));
    settings.insert(QStringLiteral("minimum"), 0);
    settings.insert(QStringLiteral("maximum"), 1000);
    QVERIFY(showPanel(&setter, &window.context, settings));
    QVERIFY(window.isReady());
    QTRY_VERIFY(master.valueOf(echo) >= 100.0);
    QTRY_VERIFY(actionOf(&setter, QStringLiteral("Take control"))->isVisible());
    actionOf(&setter, QStringLiteral("Take control"))->trigger();
    double newest = master.valueOf(echo);
    const auto hasFallen = [&] {
        const double before = std::exchange(newest, master.valueOf(echo));
        return newest < before;
    };
    while (!window.isMine(echo)) {
        QTest::qWait(1);
        QVERIFY(!hasFallen());
    }
    QTest::qWait(50);
    const double taken = master.valueOf(echo);
    QVERIFY(taken >= newest);
    QTest::qWait(300);
    QCOMPARE(master.valueOf(echo), taken);
    if (!moves)
        return;
    QWidget *field = setter.focusProxy();
    while (field->focusProxy())
        field = field->focusProxy();
    QTRY_VERIFY(field->isEnabled());
    QTest::keyClick(field, Qt::Key_Up);
    QTest::keyClick(field, Qt::Key_Return);
    QTRY_VERIFY(master.valueOf(echo) != taken);
    const double step = 10.0;  // 1 % of the range; a slider rounds to 1, a knob to its steps
    QVERIFY2(qAbs(master.valueOf(echo) - taken - step) <= 10.0,
             qPrintable(QString::number(master.valueOf(echo) - taken)));
}

void tst_QPlcSetter::aGeneratorRunsAndEndsInNeutral_data()
{
    QTest::addColumn<int>("end");
    QTest::newRow("stopped") << 0;
    QTest::newRow("hidden") << 1;
    QTest::newRow("the plant is stopped") << 2;
    QTest::newRow("the connection is lost") << 3;
    QTest::newRow("somebody takes over") << 4;
}

void tst_QPlcSetter::aGeneratorRunsAndEndsInNeutral()
{
    QFETCH(int, end);
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    TestWindow window(master.address());
    TestWindow other(master.address(), QStringLiteral("Other"));
    QPlcSetter setter;
    const QJsonObject waveform{{"shape", "ramp"}, {"amplitude", 4.0}, {"offset", 2.0}, {"period", 0.5}};
    QVERIFY(
        showPanel(&setter, &window.context, {{"signal", setpoint}, {"style", "generator"}, {"generator", waveform}}));
    QVERIFY(window.isReady() && other.isReady());
    QTRY_VERIFY(buttonOf(&setter, QStringLiteral("Start"))->isEnabled());
    QTRY_VERIFY(window.plant->status().isRunning());
    QTest::mouseClick(buttonOf(&setter, QStringLiteral("Start")), Qt::LeftButton);
    QTRY_VERIFY(master.valueOf(setpoint) > 3.0);
    QTRY_VERIFY(master.valueOf(setpoint) > 5.0);
    if (end == 0)
        QTest::mouseClick(buttonOf(&setter, QStringLiteral("Stop")), Qt::LeftButton);
    if (end == 1)
        setter.hide();
    if (end == 2)
        window.plant->stop();
    if (end == 3)
        window.plant->close();
    if (end == 4)
        other.plant->takeLease({setpoint}, {{setpoint, 0.0}}, Plant::AlsoFromOthers);
    QTRY_COMPARE(master.valueOf(setpoint), 0.0);
    QTest::qWait(100);
    QCOMPARE(master.valueOf(setpoint), 0.0);
    setter.show();
    QVERIFY(buttonOf(&setter, QStringLiteral("Start")));
}

void tst_QPlcSetter::signalOfANodeRequiresControlFirst()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    TestWindow window(master.address());
    QPlcSetter setter;
    QVERIFY(showPanel(&setter, &window.context, settingsOf(echo, QStringLiteral("number"))));
    QVERIFY(window.isReady());
    QTRY_VERIFY(labelsOf(&setter).contains(QStringLiteral("Echo writes this")));
    auto *field = setter.findChild<QLineEdit *>();
    QVERIFY(!field->isEnabled());
    actionOf(&setter, QStringLiteral("Take control"))->trigger();
    QTRY_VERIFY(labelsOf(&setter).contains(QStringLiteral("You have control")));
    field->selectAll();
    QTest::keyClicks(field, QStringLiteral("-7"));
    QTest::keyClick(field, Qt::Key_Return);
    QTRY_COMPARE(master.valueOf(echo), -7.0);
    actionOf(&setter, QStringLiteral("Give back"))->trigger();
    QTRY_VERIFY(labelsOf(&setter).contains(QStringLiteral("Echo writes this")));
    QVERIFY(!field->isEnabled());
    QTRY_VERIFY(master.valueOf(echo) > 10.0);
    setter.addSignals({QStringLiteral("time")});
    QTRY_VERIFY(labelsOf(&setter).contains(QStringLiteral("time")));
    QVERIFY(!setter.findChild<QLineEdit *>()->isEnabled() || window.plant->writer(0).isEmpty());
}

void tst_QPlcSetter::aRefusalIsShown()
{
    FlyingMaster master;
    TestWindow window(master.address());
    QPlcSetter setter;
    QVERIFY(showPanel(&setter, &window.context, settingsOf(QStringLiteral("count"), QStringLiteral("number"))));
    QVERIFY(window.isReady());
    actionOf(&setter, QStringLiteral("Take control"))->trigger();
    QTRY_VERIFY(labelsOf(&setter).contains(QStringLiteral("You have control")));
    auto *field = setter.findChild<QLineEdit *>();
    field->selectAll();
    QTest::keyClicks(field, QStringLiteral("1e30"));  // no integer
    QTest::keyClick(field, Qt::Key_Return);
    QVERIFY(labelsOf(&setter).contains(QStringLiteral("is not a value of this signal")));
    field->selectAll();
    TestWindow other(master.address(), QStringLiteral("Other"));
    QVERIFY(other.isReady());
    QTRY_COMPARE(window.done.size(), 1);
    other.plant->takeLease({QStringLiteral("count")}, {}, Plant::AlsoFromOthers);
    QTRY_COMPARE(other.done.size(), 1);
    QTest::keyClicks(field, QStringLiteral("5"));
    QTest::keyClick(field, Qt::Key_Return);
    QTRY_VERIFY(labelsOf(&setter).contains(PlantLeases::whoever()));
    QTRY_VERIFY(!field->isEnabled());
}

void tst_QPlcSetter::aDroppedSignalReplacesTheOneBefore()
{
    QPlcSetter setter;
    setter.applySettings({{"signal", "echo"}, {"style", "slider"}, {"minimum", 0.0}});
    QSignalSpy edited(&setter, &QPlcWidget::settingsEdited);
    QVERIFY(!setter.addSignals({QString()}));
    QVERIFY(setter.addSignals({setpoint, echo}));
    QCOMPARE(edited.size(), 1);
    QCOMPARE(setter.settings(), settingsOf(setpoint, QStringLiteral("slider")));
    const std::unique_ptr<QWidget> editor(setter.createSettingsEditor());
    editor->findChild<QComboBox *>()->setCurrentText(QStringLiteral("momentary"));
    QCOMPARE(edited.size(), 2);
    QCOMPARE(setter.settings(), settingsOf(setpoint, QStringLiteral("momentary")));
}

void tst_QPlcSetter::panelWorksWithoutPlantOrSignal()
{
    for (const char *style : {"number", "slider", "toggle", "momentary", "generator"}) {
        QPlcSetter bare;
        bare.applySettings(settingsOf(echo, QString(style)));
        bare.show();
        QVERIFY(!bare.grab().isNull());
        WindowContext context;
        QPlcSetter setter;
        QVERIFY(showPanel(&setter, &context, {{"style", style}}));
        QVERIFY(labelsOf(&setter).contains(QStringLiteral("No signal yet")));
        setter.applySettings(settingsOf(echo, QString(style)));
        QVERIFY(labelsOf(&setter).contains(QStringLiteral("There is no signal 'echo' at the moment")));
        QTest::keyClick(setter.focusProxy(), Qt::Key_Space);
        QTest::keyClick(setter.focusProxy(), Qt::Key_Return);
    }
}

QTEST_MAIN(tst_QPlcSetter)
#include "tst_QPlcSetter.moc"
