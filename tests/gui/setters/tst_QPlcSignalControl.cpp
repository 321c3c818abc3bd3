// SPDX-License-Identifier: Apache-2.0
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
    void whatANodeWritesIsTakenFirst();
    void whatAnotherPersonHoldsIsTakenOnlyOnPurpose();
    void controlIsGivenBackWithThePanel();
    void aMissingSignalIsNamed();
    void nothingIsSetInALostPlant();
    void anElementKeepsTheOthers();
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

void tst_QPlcSignalControl::whatANodeWritesIsTakenFirst()
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

void tst_QPlcSignalControl::whatAnotherPersonHoldsIsTakenOnlyOnPurpose()
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

void tst_QPlcSignalControl::controlIsGivenBackWithThePanel()
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

void tst_QPlcSignalControl::nothingIsSetInALostPlant()
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

void tst_QPlcSignalControl::anElementKeepsTheOthers()
{
    Bench bench({QStringLiteral("vector[1]")});
    QTRY_COMPARE(bench.control->state(), Control::Free);
    QTRY_VERIFY(bench.control->set(QStringLiteral("vector[1]"), 6.0));  // when the other elements are known
    QTRY_COMPARE(bench.master.signalValue(QStringLiteral("vector")).toReal(1), 6.0);
    QCOMPARE(bench.master.signalValue(QStringLiteral("vector")).toReal(0), 0.0);
}

QTEST_MAIN(tst_QPlcSignalControl)
#include "tst_QPlcSignalControl.moc"
