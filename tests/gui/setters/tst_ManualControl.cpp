// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "SetterFixtures.h"
#include "gui/panel/ValueStream.h"
#include "gui/setters/ManualControl.h"
#include "gui/setters/SetterTarget.h"
#include "gui/setters/Waveform.h"

#include <QtCore/QJsonArray>

using namespace qplc;

namespace {

const SignalReference echo{QString(), QStringLiteral("echo"), SignalReference::Whole};
const SignalReference setpoint{QString(), QStringLiteral("setpoint"), SignalReference::Whole};

ManualBindings bindings()
{
    AxisBinding axis;
    axis.axis = QStringLiteral("LeftX");
    axis.signal = setpoint;
    axis.value = 8.0;
    axis.deadZone = 0.5;
    axis.expo = 0.0;
    return {{{Qt::Key_Left, echo, -3.0},
             {Qt::Key_Right, echo, 4.0},
             {Qt::Key_W, setpoint, 9.0},
             {Qt::Key_E, setpoint, 6.0}},
            {axis}};
}

/// A window with these bindings, for one plant.
struct Pilot
{
    explicit Pilot(const FlyingMaster &master)
        : window(master.address())
        , control(window.panel.context())
    {
        control.setBindings(bindings());
    }
    bool isReady()
    {
        return window.isReady() && waitUntil([this] { return control.control().mayTake(); });
    }
    bool takesControl()
    {
        if (!isReady())
            return false;
        control.control().take();
        return waitUntil([this] { return control.isFlying(); });
    }

    TestWindow window;
    ManualControl control;
};

}  // namespace

class tst_ManualControl : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void keysThatRepeatThemselvesAreHeldOnce();
    void releaseMatchesThePressedKeyDespiteModifiers();
    void axesHaveADeadZoneAndExpo();
    void bindingsAreTheSameAfterJson();
    void waveformsAreExact();
    void heldKeysAreValuesAndReleasedOnesNeutral();
    void sumsStayWithinTheTable();
    void axesActWhileTheyAreArmed();
    void withoutControlNothingIsWritten();
    void keysHeldBeforeAcquiringControlDoNotAct();
    void losingOneSignalSetsAllSignalsToNeutral();
    void controlCanBeAcquiredAgainAfterAReconnection();
    void anElementIsWrittenIntoItsArray();
    void elementsOfAnArrayAreSteeredTogether();
    void aStreamEndsWithTheLastValueHoweverManyThereWere();
};

void tst_ManualControl::keysThatRepeatThemselvesAreHeldOnce()
{
    HeldKeys keys;
    QVERIFY(!keys.release(Qt::Key_A, false));
    QVERIFY(!keys.press(Qt::Key_A, true));  // the window came while it was held
    QVERIFY(keys.press(Qt::Key_A, false));
    QVERIFY(!keys.release(Qt::Key_A, true));  // X11 repeats releases, too
    QVERIFY(!keys.press(Qt::Key_A, true));
    QVERIFY(keys.contains(Qt::Key_A));
    QVERIFY(keys.release(Qt::Key_A, false));
    QVERIFY(!keys.releaseAll());
    QVERIFY(keys.press(Qt::Key_B, false));
    QVERIFY(keys.releaseAll());
    QVERIFY(!keys.contains(Qt::Key_B));
}

/// The 4 of the keypad is Left, and 4 as soon as Shift is held.
void tst_ManualControl::releaseMatchesThePressedKeyDespiteModifiers()
{
    constexpr quint32 keypad4 = 83;
    constexpr quint32 left = 113;
    HeldKeys keys;
    QVERIFY(keys.press(Qt::Key_Left, false, keypad4));
    QVERIFY(!keys.press(Qt::Key_4, false, keypad4));
    QVERIFY(keys.press(Qt::Key_Left, false, left));
    QVERIFY(keys.release(Qt::Key_4, false, keypad4));
    QVERIFY(keys.contains(Qt::Key_Left));  // the other one
    QVERIFY(keys.release(Qt::Key_Left, false, left));
    QVERIFY(!keys.contains(Qt::Key_Left));
}

void tst_ManualControl::axesHaveADeadZoneAndExpo()
{
    AxisBinding axis;
    axis.deadZone = 0.2;
    axis.expo = 0.0;
    QCOMPARE(axis.shaped(0.0), 0.0);
    QCOMPARE(axis.shaped(0.2), 0.0);
    QCOMPARE(axis.shaped(-0.6), -0.5);
    QCOMPARE(axis.shaped(1.0), 1.0);
    QCOMPARE(axis.shaped(-7.0), -1.0);
    QCOMPARE(axis.shaped(std::nan("")), 0.0);
    axis.expo = 1.0;
    QCOMPARE(axis.shaped(0.6), 0.125);
    QCOMPARE(axis.shaped(1.0), 1.0);
}

void tst_ManualControl::bindingsAreTheSameAfterJson()
{
    const QJsonObject json = bindings().toJson();
    QCOMPARE(ManualBindings::fromJson(json).toJson(), json);
    QCOMPARE(json.value("keys").toArray().at(0).toObject(),
             (QJsonObject{{"key", "Left"}, {"signal", "echo"}, {"value", -3.0}}));
    QCOMPARE(ManualBindings().toJson(), QJsonObject());
    const ManualBindings nonsense
        = ManualBindings::fromJson({{"keys", QJsonArray{1, QJsonObject{{"key", "Ctrl+Nothing"}}}},
                                    {"axes", QJsonArray{QJsonObject{{"deadZone", 5}}}}});
    QCOMPARE(nonsense.keys.size(), 2);
    QCOMPARE(nonsense.keys.at(1).key, 0);
    QVERIFY(nonsense.axes.at(0).deadZone < 1.0);
    QVERIFY(nonsense.signalReferences().isEmpty());
    QCOMPARE(bindings().signalReferences(), (QVector<SignalReference>{echo, setpoint}));
}

void tst_ManualControl::waveformsAreExact()
{
    const Waveform step{Waveform::Step, 2.0, 1.0, 4.0};
    QCOMPARE(step.value(0.0), 3.0);
    QCOMPARE(step.value(1.99), 3.0);
    QCOMPARE(step.value(2.0), 1.0);
    QCOMPARE(step.value(4.0), 3.0);
    const Waveform ramp{Waveform::Ramp, 2.0, 1.0, 4.0};
    QCOMPARE(ramp.value(0.0), 1.0);
    QCOMPARE(ramp.value(3.0), 2.5);
    QCOMPARE(ramp.value(4.0), 1.0);
    const Waveform sine{Waveform::Sine, 2.0, 1.0, 4.0};
    QCOMPARE(sine.value(0.0), 1.0);
    QCOMPARE(sine.value(1.0), 3.0);
    QCOMPARE(sine.value(3.0), -1.0);
}

void tst_ManualControl::heldKeysAreValuesAndReleasedOnesNeutral()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    Pilot pilot(master);
    ManualControl &control = pilot.control;
    QVERIFY(pilot.isReady());
    QTRY_COMPARE(control.control().state(), QPlcSignalControl::Written);
    QTRY_VERIFY(master.valueOf(echo.signal) > 10.0);
    control.control().take();
    QTRY_VERIFY(control.isFlying());
    QTRY_COMPARE(master.valueOf(echo.signal), 0.0);  // nothing is held yet
    QVERIFY(pilot.window.isMine(setpoint.signal));   // all at once
    QVERIFY(control.press(Qt::Key_Left, false));
    QTRY_COMPARE(master.valueOf(echo.signal), -3.0);
    QTest::qWait(100);  // answers that are under way
    const int commands = pilot.window.done.size();
    for (int i = 0; i < 50; ++i) {
        control.release(Qt::Key_Left, true);
        control.press(Qt::Key_Left, true);
    }
    QVERIFY(control.press(Qt::Key_Right, false));
    QTRY_COMPARE(master.valueOf(echo.signal), 1.0);
    QTest::qWait(100);
    QCOMPARE(pilot.window.done.size(), commands + 1);  // repeated keys are no news
    control.endHold();
    QTRY_COMPARE(master.valueOf(echo.signal), 0.0);
    QVERIFY(!control.press(Qt::Key_Q, false));
    control.control().giveBack();
    QTRY_VERIFY(master.valueOf(echo.signal) > 10.0);
    QVERIFY(pilot.window.failed.isEmpty());
}

void tst_ManualControl::sumsStayWithinTheTable()
{
    FlyingMaster master;
    Pilot pilot(master);
    ManualControl &control = pilot.control;
    QVERIFY(pilot.takesControl());
    control.press(Qt::Key_W, false);
    control.press(Qt::Key_E, false);
    QCOMPARE(control.wanted(setpoint), 10.0);
    QTRY_COMPARE(master.valueOf(setpoint.signal), 10.0);
}

void tst_ManualControl::axesActWhileTheyAreArmed()
{
    FlyingMaster master;
    Pilot pilot(master);
    ManualControl &control = pilot.control;
    QVERIFY(pilot.takesControl());
    control.moveAxis(QStringLiteral("LeftX"), -0.75);
    QCOMPARE(control.wanted(setpoint), 0.0);
    control.setArmed(true);
    QCOMPARE(control.wanted(setpoint), -4.0);
    QTRY_COMPARE(master.valueOf(setpoint.signal), -4.0);
    control.moveAxis(QStringLiteral("LeftX"), 0.1);
    QTRY_COMPARE(master.valueOf(setpoint.signal), 0.0);
    control.moveAxis(QStringLiteral("LeftX"), 1.0);
    QTRY_COMPARE(master.valueOf(setpoint.signal), 8.0);
    control.endHold();
    QVERIFY(!control.isArmed());
    QTRY_COMPARE(master.valueOf(setpoint.signal), 0.0);
}

void tst_ManualControl::withoutControlNothingIsWritten()
{
    FlyingMaster master;
    TestWindow window(master.address());
    ManualControl control(window.panel.context());
    control.press(Qt::Key_Left, false);  // nothing is bound
    control.setBindings(bindings());
    QVERIFY(window.isReady());
    control.press(Qt::Key_W, false);
    control.release(Qt::Key_W, false);
    QTest::qWait(100);
    QCOMPARE(window.done.size() + window.failed.size(), 0);
}

void tst_ManualControl::keysHeldBeforeAcquiringControlDoNotAct()
{
    FlyingMaster master;
    Pilot pilot(master);
    ManualControl &control = pilot.control;
    QVERIFY(pilot.isReady());
    QTRY_VERIFY(control.control().mayTake());
    control.press(Qt::Key_W, false);
    control.control().take();
    QTRY_VERIFY(control.isFlying());
    QVERIFY(!control.isHeld(Qt::Key_W));
    QCOMPARE(master.valueOf(setpoint.signal), 0.0);
}

void tst_ManualControl::losingOneSignalSetsAllSignalsToNeutral()
{
    FlyingMaster master;
    QVERIFY(master.startRealTime());
    TestWindow other(master.address(), QStringLiteral("Other"));
    Pilot pilot(master);
    ManualControl &control = pilot.control;
    QVERIFY(other.isReady() && pilot.takesControl());
    control.press(Qt::Key_Left, false);
    QTRY_COMPARE(master.valueOf(echo.signal), -3.0);
    other.plant->takeLease({setpoint.signal}, {}, Plant::AlsoFromOthers);
    QTRY_COMPARE(master.valueOf(echo.signal), 0.0);
    QVERIFY(pilot.window.isMine(echo.signal));  // still held, by nobody's finger
    QCOMPARE(control.control().state(), QPlcSignalControl::Other);
}

void tst_ManualControl::controlCanBeAcquiredAgainAfterAReconnection()
{
    FlyingMaster master;
    TestWindow window(master.address());
    QVERIFY(window.isReady());
    QPlcSignalControl control(window.panel.context());
    QString told;  // what a panel shows, which looks when it is told
    connect(&control, &QPlcSignalControl::changed, &control, [&] { told = control.text(); });
    control.setSignals({echo.signal});
    QCOMPARE(told, QStringLiteral("Echo writes this"));
    window.plant->close();
    QVERIFY(told.startsWith(QLatin1String("Disconnected")));
    window.plant->open();
    QTRY_COMPARE(told, QStringLiteral("Echo writes this"));
    QVERIFY(control.mayTake());
}

void tst_ManualControl::anElementIsWrittenIntoItsArray()
{
    FlyingMaster master;
    QVERIFY(master.setSignalValue(QStringLiteral("vector"), QPlcValue({1.0, 2.0, 3.0})));
    TestWindow window(master.address());
    SetterTarget target(window.panel.context());
    target.setSignal(QStringLiteral("vector[1]"));
    QVERIFY(window.isReady());
    QTRY_COMPARE(target.actualNumber(), 2.0);
    target.sendOnce(7.0);
    QTRY_COMPARE(master.signalValue(QStringLiteral("vector")), QPlcValue({1.0, 7.0, 3.0}));
}

/// What the plant has of one of them is older than what was sent of it, when both move within the
/// time that a command takes.
void tst_ManualControl::elementsOfAnArrayAreSteeredTogether()
{
    FlyingMaster master;
    QVERIFY(master.setSignalValue(QStringLiteral("vector"), QPlcValue({1.0, 2.0, 3.0})));
    QVERIFY(master.startRealTime());
    Pilot pilot(master);
    ManualControl &control = pilot.control;
    const auto element = [](int place) { return SignalReference{QString(), QStringLiteral("vector"), place}; };
    control.setBindings({{{Qt::Key_1, element(0), 5.0}, {Qt::Key_2, element(1), 7.0}}, {}});
    QVERIFY(pilot.takesControl());
    const auto vector = [&] { return master.signalValue(QStringLiteral("vector")); };
    const auto seen = [&] { return pilot.window.plant->value(testTable().indexOf(QStringLiteral("vector"))); };
    QTRY_COMPARE(vector(), QPlcValue({0.0, 0.0, 0.0}));
    QTRY_COMPARE(seen(), vector());
    control.press(Qt::Key_1, false);
    control.press(Qt::Key_2, false);
    QTRY_COMPARE(vector(), QPlcValue({5.0, 7.0, 0.0}));
    QTRY_COMPARE(seen(), vector());
    control.endHold();
    QTRY_COMPARE(vector(), QPlcValue({0.0, 0.0, 0.0}));
}

void tst_ManualControl::aStreamEndsWithTheLastValueHoweverManyThereWere()
{
    FlyingMaster master;
    TestWindow window(master.address());
    QVERIFY(window.isReady());
    ValueStream stream;
    stream.send({{setpoint.signal, 1.0}});  // nowhere
    stream.setPlant(window.plant);
    for (int i = 1; i <= 1000; ++i)
        stream.send({{setpoint.signal, i * 0.01}});
    QTRY_COMPARE(master.valueOf(setpoint.signal), 10.0);
    QTRY_COMPARE(window.done.size(), 2);  // the first one, and the last
    QSignalSpy failed(&stream, &ValueStream::failed);
    stream.send({{setpoint.signal, 11.0}});
    stream.send({{setpoint.signal, 1.0}});
    QTRY_COMPARE(failed.size(), 1);
    stream.send({{setpoint.signal, 2.0}});  // goes on
    QTRY_COMPARE(master.valueOf(setpoint.signal), 2.0);
}

QTEST_MAIN(tst_ManualControl)
#include "tst_ManualControl.moc"
