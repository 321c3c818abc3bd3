// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "QPlcSetter.h"
#include "SetterFixtures.h"

#include <QtWidgets/QAbstractItemView>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QLineEdit>

#include <qwt_knob.h>

using namespace qplc;

namespace {

QPlcSignalTable statesTable()
{
    return QPlcSignalTable::fromIni("[mode]\ntype = Int8\nmax = 2\nvalues = -5: Service, 0: Manual, 1: Automatic\n"
                                    "[speed]\ntype = Real64\nunit = m/s\nmin = -10\nmax = 10\n"
                                    "[pull]\ntype = Real64\nunit = N\nmin = -20000\nmax = 20000\n"
                                    "[work]\ntype = Real64\nunit = J\n");
}

QJsonObject settingsOf(const char *signal, const char *style)
{
    return {{"signal", signal}, {"style", style}};
}

/// Moves the mouse with its button held.
void drag(QWidget *widget, const QPoint &position)
{
    QMouseEvent move(QEvent::MouseMove, position, widget->mapToGlobal(position), Qt::NoButton, Qt::LeftButton,
                     Qt::NoModifier);
    QCoreApplication::sendEvent(widget, &move);
}

struct Desk
{
    bool show(const QJsonObject &settings)
    {
        return showPanel(&setter, &window.context, settings)
            && waitUntil([this] { return window.plant->hasLeases(); }, 5000);
    }
    double valueOf(const char *signal) const { return master.signalValue(QLatin1String(signal)).toReal(); }
    template<typename Part>
    Part *part() const
    {
        return setter.findChild<Part *>();
    }

    RunningMaster master{statesTable()};
    TestWindow window{master.address()};
    QPlcSetter setter;
};

}  // namespace

class tst_ChoiceAndKnob : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void theListHasTheNamesAndSendsTheNumberOnce();
    void openListIsNotChangedByTheCurrentValue();
    void aListWithinLimitsHasFewerNames();
    void wheelAndLettersChooseNothing();
    void signalWithoutValueNamesShowsTheRemedy();
    void aSignalWithNamesThatIsDroppedBecomesAList();
    void numberFieldAcceptsValueNames();
    void knobSendsOnceOnMouseRelease();
    void escapeRevertsADraggedKnob();
    void keysTurnTheKnobAndEnterSends();
    void escapeRevertsTheKnobWithoutSending();
    void knobWithoutLimitsShowsTheRemedy();
    void shownValueHasThePrefixOfTheRange();
    void typedValueHasTheUnitOfTheTable();
};

void tst_ChoiceAndKnob::theListHasTheNamesAndSendsTheNumberOnce()
{
    Desk desk;
    QVERIFY(desk.show(settingsOf("mode", "list")));
    auto *list = desk.part<QComboBox>();
    QTRY_VERIFY(list->isEnabled());
    QCOMPARE(list->count(), 3);
    QTRY_COMPARE(list->currentText(), QStringLiteral("Manual"));
    list->setFocus();
    QTest::keyClick(list, Qt::Key_Down);
    QTRY_VERIFY(list->view()->isVisible());
    QTest::keyClick(list->view(), Qt::Key_Down);
    QTest::qWait(50);
    QCOMPARE(desk.window.done.size(), 0);
    QTest::keyClick(list->view(), Qt::Key_Return);
    QTRY_COMPARE(desk.valueOf("mode"), 1.0);
    QTRY_COMPARE(desk.window.done.size(), 1);
    QCOMPARE(list->currentText(), QStringLiteral("Automatic"));
    QTRY_VERIFY(labelsOf(&desk.setter).contains(QStringLiteral("Automatic")));  // the actual value
}

void tst_ChoiceAndKnob::openListIsNotChangedByTheCurrentValue()
{
    Desk desk;
    QVERIFY(desk.show(settingsOf("mode", "list")));
    auto *list = desk.part<QComboBox>();
    QTRY_COMPARE(list->currentText(), QStringLiteral("Manual"));
    list->showPopup();
    QVERIFY(desk.master.setSignalValue("mode", -5));
    QTRY_VERIFY(labelsOf(&desk.setter).contains(QStringLiteral("Service")));
    QCOMPARE(list->currentText(), QStringLiteral("Manual"));
    list->hidePopup();
    QTRY_COMPARE(list->currentText(), QStringLiteral("Service"));
    QVERIFY(desk.master.setSignalValue("mode", 2));  // which has no name
    QTRY_COMPARE(list->currentIndex(), -1);
    QCOMPARE(list->placeholderText(), QStringLiteral("2"));
}

void tst_ChoiceAndKnob::aListWithinLimitsHasFewerNames()
{
    Desk desk;
    QVERIFY(desk.show({{"signal", "mode"}, {"style", "list"}, {"minimum", 0}}));
    QTRY_COMPARE(desk.part<QComboBox>()->count(), 2);
}

void tst_ChoiceAndKnob::wheelAndLettersChooseNothing()
{
    Desk desk;
    QVERIFY(desk.show(settingsOf("mode", "list")));
    auto *list = desk.part<QComboBox>();
    QTRY_COMPARE(list->currentText(), QStringLiteral("Manual"));
    list->setFocus();
    QTest::keyClicks(list, QStringLiteral("a"));
    QWheelEvent wheel(QPointF(5, 5), list->mapToGlobal(QPoint(5, 5)), {}, QPoint(0, -120), Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(list, &wheel);
    QTest::qWait(50);
    QCOMPARE(list->currentText(), QStringLiteral("Manual"));
    QCOMPARE(desk.window.done.size(), 0);
}

void tst_ChoiceAndKnob::signalWithoutValueNamesShowsTheRemedy()
{
    Desk desk;
    QVERIFY(desk.show(settingsOf("speed", "list")));
    QTRY_VERIFY(
        labelsOf(&desk.setter).contains(QStringLiteral("The values of 'speed' have no names: give it 'values =")));
    QVERIFY(!desk.part<QComboBox>()->isEnabled());
}

void tst_ChoiceAndKnob::aSignalWithNamesThatIsDroppedBecomesAList()
{
    Desk desk;
    QVERIFY(desk.show({}));
    QTRY_VERIFY(!desk.window.plant->table().isEmpty());
    QVERIFY(desk.setter.addSignals({QStringLiteral("mode")}));
    QCOMPARE(desk.setter.settings(), settingsOf("mode", "list"));
    desk.setter.applySettings({});
    QVERIFY(desk.setter.addSignals({QStringLiteral("speed")}));
    QCOMPARE(desk.setter.settings(), (QJsonObject{{"signal", "speed"}}));
}

void tst_ChoiceAndKnob::numberFieldAcceptsValueNames()
{
    Desk desk;
    QVERIFY(desk.show(settingsOf("mode", "number")));
    auto *field = desk.part<QLineEdit>();
    QTRY_VERIFY(field->isEnabled());
    field->selectAll();
    QTest::keyClicks(field, QStringLiteral("automatic"));
    QTest::keyClick(field, Qt::Key_Return);
    QTRY_COMPARE(desk.valueOf("mode"), 1.0);
}

void tst_ChoiceAndKnob::knobSendsOnceOnMouseRelease()
{
    Desk desk;
    QVERIFY(desk.show(settingsOf("speed", "knob")));
    auto *knob = desk.part<QwtKnob>();
    QTRY_VERIFY(knob->isEnabled());
    QCOMPARE(knob->lowerBound(), -10.0);
    QCOMPARE(knob->upperBound(), 10.0);
    const QPoint center = knob->rect().center();
    QTest::mousePress(knob, Qt::LeftButton, {}, center + QPoint(0, -20));
    drag(knob, center + QPoint(10, -17));
    drag(knob, center + QPoint(17, -10));
    QTest::qWait(100);
    QCOMPARE(desk.window.done.size(), 0);
    QVERIFY(labelsOf(&desk.setter).contains(QStringLiteral("Not sent yet")));
    QTest::mouseRelease(knob, Qt::LeftButton, {}, center + QPoint(17, -10));
    QTRY_VERIFY(desk.valueOf("speed") > 1.0);
    QCOMPARE(desk.valueOf("speed"), knob->value());
    QTest::qWait(50);
    QTRY_COMPARE(desk.window.done.size(), 1);
    QVERIFY(!labelsOf(&desk.setter).contains(QStringLiteral("Not sent yet")));
    QTest::mouseClick(knob, Qt::LeftButton, {}, center + QPoint(17, -10));  // turns nothing
    QTest::qWait(50);
    QTRY_COMPARE(desk.window.done.size(), 1);
}

void tst_ChoiceAndKnob::escapeRevertsADraggedKnob()
{
    Desk desk;
    QVERIFY(desk.show(settingsOf("speed", "knob")));
    auto *knob = desk.part<QwtKnob>();
    QTRY_VERIFY(knob->isEnabled());
    const double before = knob->value();
    const QPoint center = knob->rect().center();
    QTest::mousePress(knob, Qt::LeftButton, {}, center + QPoint(0, -20));
    drag(knob, center + QPoint(10, -17));
    drag(knob, center + QPoint(17, -10));
    QVERIFY(knob->value() != before);
    QTest::keyClick(knob, Qt::Key_Escape);
    QTRY_COMPARE(knob->value(), before);
    drag(knob, center + QPoint(10, 17));  // the button is still down
    QTest::mouseRelease(knob, Qt::LeftButton, {}, center + QPoint(10, 17));
    QTest::qWait(100);
    QCOMPARE(knob->value(), before);
    QCOMPARE(desk.window.done.size(), 0);
}

void tst_ChoiceAndKnob::keysTurnTheKnobAndEnterSends()
{
    Desk desk;
    QVERIFY(desk.show(settingsOf("speed", "knob")));
    auto *knob = desk.part<QwtKnob>();
    QTRY_VERIFY(knob->isEnabled());
    knob->setFocus();
    QTest::keyClick(knob, Qt::Key_Up);
    QTest::keyClick(knob, Qt::Key_PageUp);
    QTest::qWait(50);
    QCOMPARE(desk.window.done.size(), 0);
    const double wanted = knob->value();
    QVERIFY(wanted > 0.5);
    QTest::keyClick(knob, Qt::Key_Return);
    QTRY_COMPARE(desk.valueOf("speed"), wanted);
    QTest::keyClick(knob, Qt::Key_Return);  // nothing is new
    QTest::qWait(50);
    QTRY_COMPARE(desk.window.done.size(), 1);
}

void tst_ChoiceAndKnob::escapeRevertsTheKnobWithoutSending()
{
    Desk desk;
    QVERIFY(desk.show(settingsOf("speed", "knob")));
    auto *knob = desk.part<QwtKnob>();
    QTRY_VERIFY(knob->isEnabled());
    QVERIFY(desk.master.setSignalValue("speed", 3.0));
    QTRY_COMPARE(knob->value(), 3.0);
    knob->setFocus();
    QTest::keyClick(knob, Qt::Key_Up);
    const double turned = knob->value();
    QVERIFY(turned > 3.0);
    QVERIFY(desk.master.setSignalValue("speed", -4.0));
    QTRY_VERIFY(labelsOf(&desk.setter).contains(QStringLiteral("-4 m/s")));
    QCOMPARE(knob->value(), turned);
    QTest::keyClick(knob, Qt::Key_Escape);
    QTRY_COMPARE(knob->value(), -4.0);
    QCOMPARE(desk.window.done.size(), 0);
}

void tst_ChoiceAndKnob::knobWithoutLimitsShowsTheRemedy()
{
    Desk desk;
    QVERIFY(desk.show(settingsOf("mode", "knob")));
    QTRY_VERIFY(labelsOf(&desk.setter).contains(QStringLiteral("'mode' has no limits in the table")));
    QVERIFY(!desk.part<QwtKnob>()->isEnabled());
}

void tst_ChoiceAndKnob::shownValueHasThePrefixOfTheRange()
{
    Desk desk;
    QVERIFY(desk.show(settingsOf("pull", "knob")));
    QVERIFY(desk.master.setSignalValue("pull", 15000.0));
    QTRY_VERIFY(labelsOf(&desk.setter).contains(QStringLiteral("15.00 kN")));
    QVERIFY(desk.master.setSignalValue("pull", 20.0));
    QTRY_VERIFY(labelsOf(&desk.setter).contains(QStringLiteral("0.020 kN")));  // as near 0 as at the ends
    QTRY_COMPARE(desk.part<QwtKnob>()->toolTip(), QStringLiteral("-20.00 kN … 20.00 kN"));
    auto *knob = desk.part<QwtKnob>();
    QTRY_VERIFY(knob->isEnabled());
    knob->setFocus();
    QTest::keyClick(knob, Qt::Key_Up);
    QVERIFY(knob->value() > 100.0 && knob->value() < 1000.0);
    const QString wanted = QString::number(knob->value() / 1000.0, 'f', 3) + QStringLiteral(" kN");
    QVERIFY2(labelsOf(&desk.setter).contains(wanted), qPrintable(labelsOf(&desk.setter)));
    desk.setter.applySettings(settingsOf("pull", "momentary"));
    QVERIFY(buttonOf(&desk.setter, QStringLiteral("Hold: 20 kN")));
}

void tst_ChoiceAndKnob::typedValueHasTheUnitOfTheTable()
{
    Desk desk;
    QVERIFY(desk.show(settingsOf("work", "number")));
    QVERIFY(desk.master.setSignalValue("work", 101108.0));
    QTRY_VERIFY(labelsOf(&desk.setter).contains(QStringLiteral("101.1 kJ")));
    QTRY_COMPARE(desk.part<QLineEdit>()->text(), QStringLiteral("101108"));
    QVERIFY(labelsOf(&desk.setter).split(QLatin1Char('\n')).contains(QStringLiteral("J")));  // beside the field
    auto *field = desk.part<QLineEdit>();
    QTRY_VERIFY(field->isEnabled());
    field->selectAll();
    QTest::keyClicks(field, QStringLiteral("4"));
    QTest::keyClick(field, Qt::Key_Return);
    QTRY_COMPARE(desk.valueOf("work"), 4.0);
}

QTEST_MAIN(tst_ChoiceAndKnob)
#include "tst_ChoiceAndKnob.moc"
