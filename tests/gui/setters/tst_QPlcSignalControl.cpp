// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "QPlcPanelContext.h"
#include "QPlcSignalControl.h"
#include "SetterFixtures.h"

using Control = QPlcSignalControl;

namespace {

const QString setpoint = QStringLiteral("setpoint");
const QString echo = QStringLiteral("echo");

class Panel : public QPlcWidget
{
    Q_OBJECT
};

/// A plant in real time, and a panel that controls some of its signals.
struct Bench
{
    explicit Bench(const QStringList &references)
        : window(master.address())
        , control(std::make_unique<Control>(panel.context()))
    {
        control->setSignals(references);
        QCOMPARE(control->state(), Control::Missing);
        panel.setContext(&window.context);
        QVERIFY(master.startRealTime());
        QVERIFY(window.isReady());
    }

    FlyingMaster master;
    TestWindow window;
    Panel panel;
    std::unique_ptr<Control> control;
};

}  // namespace

class tst_QPlcSignalControl : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void aFreeSignalIsSetWithinItsLimits();
    void signalOfANodeRequiresControlFirst();
    void signalHeldByAnotherPersonIsAcquiredOnlyExplicitly();
    void closingThePanelReleasesControl();
    void aMissingSignalIsNamed();
    void lostPlantAcceptsNoValues();
    void settingOneElementKeepsTheOtherElements();
    void elementsAreSetTogether();
    void textsAndArraysAreSent();
    void eachSentValueReachesTheMaster();
    void controlMayBeginAtNeutral();
    void whatIsHeldGoesToNeutral();
    void whoTakesASignalEndsItsHold();
    void neutralIsSetWhereTheOthersAreLost();
    void controlMayOutliveItsPanel();
};

void tst_QPlcSignalControl::aFreeSignalIsSetWithinItsLimits()
{
    Bench bench({setpoint});
    QTRY_COMPARE(bench.control->state(), Control::Free);
    QVERIFY(bench.control->set(setpoint, 3.5));
    QTRY_COMPARE(bench.master.valueOf(setpoint), 3.5);
    for (int i = 0; i < 100; ++i)
        QVERIFY(bench.control->set(setpoint, i));  // the last one counts, as near as the table allows
    QTRY_COMPARE(bench.master.valueOf(setpoint), 10.0);
    QVERIFY(!bench.control->set(echo, 1.0));
    QCOMPARE(bench.control->neutral(setpoint), 0.0);
}

void tst_QPlcSignalControl::signalOfANodeRequiresControlFirst()
{
    Bench bench({echo, setpoint});
    QTRY_COMPARE(bench.control->state(), Control::Written);
    QCOMPARE(bench.control->who(), QStringLiteral("Echo"));
    QVERIFY(!bench.control->set(echo, -7.0));
    const QSignalSpy changed(bench.control.get(), &Control::changed);
    bench.control->take();
    QTRY_COMPARE(bench.control->state(), Control::Mine);
    QVERIFY(changed.count() > 0);
    QVERIFY(bench.control->set(echo, -7.0));
    QVERIFY(bench.control->set(setpoint, 2.0));
    QTRY_COMPARE(bench.master.valueOf(echo), -7.0);
    QTRY_COMPARE(bench.master.valueOf(setpoint), 2.0);
    bench.control->giveBack();
    QTRY_COMPARE(bench.control->state(), Control::Written);
    QTRY_VERIFY(bench.master.valueOf(echo) > 10.0);
}

void tst_QPlcSignalControl::signalHeldByAnotherPersonIsAcquiredOnlyExplicitly()
{
    Bench bench({echo});
    TestWindow other(bench.master.address(), QStringLiteral("Other window"));
    QVERIFY(other.isReady());
    other.plant->takeLease({echo});
    QTRY_COMPARE(bench.control->state(), Control::Other);
    bench.control->take();
    QTRY_VERIFY(other.isMine(echo));
    QVERIFY(!bench.control->set(echo, 1.0));
    bench.control->take(Control::AlsoFromOthers);
    QTRY_COMPARE(bench.control->state(), Control::Mine);
    QTRY_VERIFY(!other.isMine(echo));
}

void tst_QPlcSignalControl::closingThePanelReleasesControl()
{
    Bench bench({echo});
    QTRY_COMPARE(bench.control->state(), Control::Written);
    bench.control->take();
    QTRY_COMPARE(bench.control->state(), Control::Mine);
    bench.control.reset();
    QTRY_VERIFY(!bench.window.plant->lease(echo));
    QTRY_VERIFY(bench.master.valueOf(echo) > 10.0);
}

void tst_QPlcSignalControl::aMissingSignalIsNamed()
{
    Bench bench({setpoint});
    QTRY_COMPARE(bench.control->state(), Control::Free);
    bench.control->setSignals({setpoint, QStringLiteral("nothing")});
    QCOMPARE(bench.control->state(), Control::Missing);
    QVERIFY(bench.control->text().contains(QStringLiteral("nothing")));
    QVERIFY(!bench.control->mayTake());
    QVERIFY(!bench.control->set(setpoint, 1.0));
}

void tst_QPlcSignalControl::lostPlantAcceptsNoValues()
{
    Bench bench({setpoint});
    QTRY_COMPARE(bench.control->state(), Control::Free);
    bench.window.plant->close();
    QTRY_COMPARE(bench.control->state(), Control::Offline);
    QVERIFY(!bench.control->set(setpoint, 4.0));
    bench.window.plant->open();
    QTRY_COMPARE(bench.control->state(), Control::Free);
    QTRY_VERIFY(bench.window.plant->values().hasValues());
    QVERIFY(bench.master.valueOf(setpoint) != 4.0);
}

void tst_QPlcSignalControl::settingOneElementKeepsTheOtherElements()
{
    Bench bench({QStringLiteral("vector[1]")});
    QTRY_COMPARE(bench.control->state(), Control::Free);
    QTRY_VERIFY(bench.control->set(QStringLiteral("vector[1]"), 6.0));  // when the other elements are known
    QTRY_COMPARE(bench.master.signalValue(QStringLiteral("vector")).toReal(1), 6.0);
    QCOMPARE(bench.master.signalValue(QStringLiteral("vector")).toReal(0), 0.0);
}

void tst_QPlcSignalControl::elementsAreSetTogether()
{
    const auto element = [](int place) { return QStringLiteral("vector[%1]").arg(place); };
    Bench bench({element(0), element(2)});
    QTRY_VERIFY(bench.control->set({{element(0), 1.0}, {element(2), 3.0}}));  // when the other one is known
    QTRY_COMPARE(bench.master.signalValue(QStringLiteral("vector")), QPlcValue({1.0, 0.0, 3.0}));
    QVERIFY(!bench.control->set({{element(0), 5.0}, {echo, 1.0}}));  // all or none
    QVERIFY(bench.control->set({{element(0), 7.0}, {element(2), 8.0}}));
    QTRY_COMPARE(bench.master.signalValue(QStringLiteral("vector")), QPlcValue({7.0, 0.0, 8.0}));
}

void tst_QPlcSignalControl::textsAndArraysAreSent()
{
    const QString vector = QStringLiteral("vector");
    Bench bench({vector, setpoint});
    QTRY_COMPARE(bench.control->state(), Control::Free);
    QVERIFY(bench.control->send(vector, QPlcValue({4.0, 5.0, 6.0})));
    QTRY_COMPARE(bench.master.signalValue(vector), QPlcValue({4.0, 5.0, 6.0}));
    QVERIFY(bench.control->send(setpoint, QPlcValue(99)));
    QTRY_COMPARE(bench.master.valueOf(setpoint), 10.0);
    QVERIFY(!bench.control->send(setpoint, QPlcValue("fast")));
    QVERIFY(bench.control->send(vector, QPlcValue(1.0)));
    QTRY_COMPARE(bench.master.signalValue(vector), QPlcValue({1.0, 1.0, 1.0}));
    QVERIFY(!bench.control->send(echo, QPlcValue(1.0)));
    QVERIFY(!bench.control->send(setpoint, QPlcValue()));
}

void tst_QPlcSignalControl::eachSentValueReachesTheMaster()
{
    Bench bench({setpoint});
    QTRY_COMPARE(bench.control->state(), Control::Free);
    for (int i = 1; i <= 5; ++i)
        QVERIFY(bench.control->send(setpoint, QPlcValue(double(i))));
    QTRY_COMPARE(bench.window.done.size(), 5);
    QTRY_COMPARE(bench.master.valueOf(setpoint), 5.0);
    QVERIFY(bench.control->set(setpoint, 6.0));
    QVERIFY(bench.control->set(setpoint, 7.0));              // waits
    QVERIFY(bench.control->send(setpoint, QPlcValue(8.0)));  // behind it
    QTRY_COMPARE(bench.window.done.size(), 8);
    QTRY_COMPARE(bench.master.valueOf(setpoint), 8.0);
}

void tst_QPlcSignalControl::controlMayBeginAtNeutral()
{
    Bench bench({echo});
    QTRY_VERIFY(bench.control->mayTake());
    QTRY_VERIFY(bench.master.valueOf(echo) > 10.0);
    bench.control->setBeginning(Control::Neutral);
    bench.control->take();
    QTRY_COMPARE(bench.control->state(), Control::Mine);
    QTRY_COMPARE(bench.master.valueOf(echo), 0.0);
    QVERIFY(bench.control->neutralText().startsWith(QStringLiteral("echo 0")));
    QCOMPARE(bench.control->plantNames(), QString());
}

void tst_QPlcSignalControl::whatIsHeldGoesToNeutral()
{
    Bench bench({setpoint});
    QTRY_COMPARE(bench.control->state(), Control::Free);
    QTRY_VERIFY(bench.window.plant->hasLeases());
    QVERIFY(bench.control->hold(setpoint, 4.0));
    QVERIFY(bench.control->isHolding());
    QTRY_VERIFY(bench.window.isMine(setpoint));
    QTRY_COMPARE(bench.master.valueOf(setpoint), 4.0);
    QVERIFY(bench.control->hold(setpoint, 5.0));
    QTRY_COMPARE(bench.master.valueOf(setpoint), 5.0);
    bench.control->endHold();
    QVERIFY(!bench.control->isHolding());
    QTRY_COMPARE(bench.master.valueOf(setpoint), 0.0);
    QTRY_VERIFY(!bench.window.isMine(setpoint));
    QVERIFY(!bench.control->hold(echo, 1.0));
}

void tst_QPlcSignalControl::whoTakesASignalEndsItsHold()
{
    Bench bench({setpoint});
    TestWindow other(bench.master.address(), QStringLiteral("Other window"));
    QVERIFY(other.isReady());
    QTRY_COMPARE(bench.control->state(), Control::Free);
    const QSignalSpy lost(bench.control.get(), &Control::holdLost);
    QVERIFY(bench.control->hold(setpoint, 4.0));
    QTRY_VERIFY(bench.window.isMine(setpoint));
    other.plant->takeLease({setpoint}, {{setpoint, 2.0}}, qplc::Plant::AlsoFromOthers);
    QTRY_COMPARE(lost.size(), 1);
    QVERIFY(!bench.control->isHolding());
    bench.control->endHold();
    QTRY_COMPARE(bench.master.valueOf(setpoint), 2.0);
}

void tst_QPlcSignalControl::neutralIsSetWhereTheOthersAreLost()
{
    Bench bench({echo, setpoint});
    TestWindow other(bench.master.address(), QStringLiteral("Other window"));
    QVERIFY(other.isReady());
    QTRY_VERIFY(bench.control->mayTake());
    bench.control->take();
    QTRY_COMPARE(bench.control->state(), Control::Mine);
    QVERIFY(bench.control->set({{echo, -3.0}, {setpoint, 2.0}}));
    QTRY_COMPARE(bench.master.valueOf(setpoint), 2.0);
    other.plant->takeLease({setpoint}, {}, qplc::Plant::AlsoFromOthers);
    QTRY_COMPARE(bench.control->state(), Control::Other);
    bench.control->setNeutral();
    QTRY_COMPARE(bench.master.valueOf(echo), 0.0);
    QCOMPARE(bench.master.valueOf(setpoint), 2.0);  // is the other person's
}

void tst_QPlcSignalControl::controlMayOutliveItsPanel()
{
    Bench bench({echo});
    QTRY_VERIFY(bench.control->mayTake());
    bench.control->setKeepsControl(true);
    bench.control->take();
    QTRY_COMPARE(bench.control->state(), Control::Mine);
    QVERIFY(bench.control->set(echo, -7.0));
    bench.control.reset();
    QTRY_COMPARE(bench.master.valueOf(echo), -7.0);
    QVERIFY(bench.window.isMine(echo));
}

QTEST_MAIN(tst_QPlcSignalControl)
#include "tst_QPlcSignalControl.moc"
