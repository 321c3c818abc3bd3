// SPDX-License-Identifier: Apache-2.0
#include "AutopilotGains.h"

#include "FlightPhase.h"
#include "Near.h"

#include <functional>
#include <limits>

using awe::AutopilotGains;

class tst_AutopilotGains : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void bothSetsAreValid();
    void tunedGainsPermitLowerFlightAndLowerReelIn();
    void badGainIsNamedWithItsRemedy_data();
    void badGainIsNamedWithItsRemedy();
    void everyPhaseHasAName();
};

using Change = std::function<void(AutopilotGains &)>;
Q_DECLARE_METATYPE(Change)

void tst_AutopilotGains::bothSetsAreValid()
{
    QCOMPARE(AutopilotGains::safe().validate(), std::string());
    QCOMPARE(AutopilotGains::tuned().validate(), std::string());
    AutopilotGains limited;
    limited.forceLimit = 4000.0;
    QCOMPARE(limited.validate(), std::string());
}

void tst_AutopilotGains::tunedGainsPermitLowerFlightAndLowerReelIn()
{
    const AutopilotGains safe = AutopilotGains::safe(), tuned = AutopilotGains::tuned();
    QVERIFY(tuned.lowestHeight < safe.lowestHeight);
    QVERIFY(tuned.lowestElevation < safe.lowestElevation);
    QVERIFY(tuned.reelInElevation < safe.reelInElevation);
    QVERIFY(tuned.guardFactor < safe.guardFactor);
    QCOMPARE(tuned.forceFilterTime, safe.forceFilterTime);  // the guard of the force limit looks it ahead
}

void tst_AutopilotGains::badGainIsNamedWithItsRemedy_data()
{
    QTest::addColumn<Change>("change");
    QTest::addColumn<QString>("message");
    const auto row = [](const char *name, const Change &change, const char *message) {
        QTest::newRow(name) << change << QString::fromUtf8(message);
    };
    row(
        "orientation", [](AutopilotGains &g) { g.yawGain = -1.0; }, "yawGain is -1 1/s; choose a value from 0 to 100");
    row(
        "yaw limits crossed", [](AutopilotGains &g) { g.slowYawSpeed = 181.0; }, "slowYawSpeed is 181 deg/s");
    row(
        "course", [](AutopilotGains &g) { g.eightHalfWidth = 0.0; }, "eightHalfWidth is 0 m");
    row(
        "look ahead", [](AutopilotGains &g) { g.lookAhead = 28.0; },
        "lookAhead is 28 m; choose a value from 0.1 to 27");
    row(
        "tether crossed", [](AutopilotGains &g) { g.shortestTether = 300.0; }, "shortestTether is 300 m");
    row(
        "no winch", [](AutopilotGains &g) { g.winchAcceleration = 0.0; }, "winchAcceleration is 0 m/s²");
    row(
        "recovery", [](AutopilotGains &g) { g.recoverTargetHeight = 20.0; }, "recoverTargetHeight is 20 m");
    row(
        "NaN filter", [](AutopilotGains &g) { g.forceFilterTime = std::nan(""); }, "forceFilterTime is nan s");
    row(
        "no force", [](AutopilotGains &g) { g.forceLimit = 0.0; }, "forceLimit is 0 N");
    row(
        "mast", [](AutopilotGains &g) { g.mast.landWind = 7.0; },
        "mast.landWind is 7 m/s; choose a value from 0 to 6.2");
    row(
        "short tether of turbines at a mast",
        [](AutopilotGains &g) {
            g = AutopilotGains::drag();
            g.mast.isPresent = true;
            g.constantTether = 50.0;
        },
        "turbines.tetherLength is 50 m; choose a value from 100 to");
    row(
        "no step", [](AutopilotGains &g) { g.step = 0.0; }, "step is 0 s");
}

void tst_AutopilotGains::badGainIsNamedWithItsRemedy()
{
    QFETCH(Change, change);
    QFETCH(QString, message);
    AutopilotGains gains;
    change(gains);
    VERIFY_CONTAINS(gains.validate(), message.toStdString());
}

void tst_AutopilotGains::everyPhaseHasAName()
{
    const QStringList names
        = {QStringLiteral("Launch"), QStringLiteral("Power"),   QStringLiteral("ReelOut"), QStringLiteral("Retract"),
           QStringLiteral("ReelIn"), QStringLiteral("Recover"), QStringLiteral("Docked"),  QStringLiteral("Ascend"),
           QStringLiteral("Park"),   QStringLiteral("Descend")};
    QCOMPARE(names.size(), awe::flightPhaseCount);
    for (int i = 0; i < names.size(); ++i)
        QCOMPARE(QString::fromLatin1(awe::flightPhaseName(static_cast<awe::FlightPhase>(i))), names[i]);
    QCOMPARE(QString::fromLatin1(awe::flightPhaseName(static_cast<awe::FlightPhase>(99))), QStringLiteral("unknown"));
}

QTEST_APPLESS_MAIN(tst_AutopilotGains)
#include "tst_AutopilotGains.moc"
