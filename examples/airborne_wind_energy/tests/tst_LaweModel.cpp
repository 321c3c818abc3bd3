// SPDX-License-Identifier: Apache-2.0
#include "KiteSimulation.h"

#include <QtTest/QtTest>

#include <cmath>
#include <cstring>

extern "C" {
#include "LaweModel.h"
}

namespace {

bool equalsBits(const double (&exported)[3], const Eigen::Vector3d &computed)
{
    return std::memcmp(exported, computed.data(), sizeof exported) == 0;
}

bool equalsBits(double exported, double computed)
{
    return std::memcmp(&exported, &computed, sizeof exported) == 0;
}

bool equalsBits(const ExtY_LaweModel_T &exported, const awe::PlantOutputs &computed)
{
    return equalsBits(exported.bodyPosition_earth, computed.position)
        && equalsBits(exported.bodyVelocity_earth, computed.velocity)
        && equalsBits(exported.windVelocity_earth, computed.inputs.windVelocity)
        && equalsBits(exported.bodyControlOrientation, computed.bodyControlOrientation)
        && equalsBits(exported.bodyPositionOrientation, computed.bodyPositionOrientation)
        && equalsBits(exported.gravitationalForce_earth, computed.gravitationalForce)
        && equalsBits(exported.aerodynamicForce_earth, computed.aerodynamicForce)
        && equalsBits(exported.tetherForce_earth, computed.tetherForce)
        && equalsBits(exported.angleOfAttack, computed.angleOfAttack)
        && equalsBits(exported.dragCoefficient, computed.dragCoefficient)
        && equalsBits(exported.liftCoefficient, computed.liftCoefficient)
        && equalsBits(exported.aweCoefficient, computed.aweCoefficient)
        && equalsBits(exported.tetherLength, computed.tetherLength) && equalsBits(exported.power, computed.power)
        && equalsBits(exported.averagePower, computed.averagePower) && equalsBits(exported.energy, computed.energy)
        && (exported.crashed != 0) == computed.crashed;
}

awe::KiteSimulation simulation()
{
    awe::PlantParameters plant;
    plant.groundContact = awe::GroundContact::Hold;
    return awe::KiteSimulation(plant, awe::WindParameters());
}

}  // namespace

/// The model in the form of an export, beside the plant of the other models.
class tst_LaweModel : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void computesTheBitsOfThePlant_data();
    void computesTheBitsOfThePlant();
};

void tst_LaweModel::computesTheBitsOfThePlant_data()
{
    QTest::addColumn<double>("pitch");   // [deg/s]
    QTest::addColumn<double>("yaw");     // [deg/s]
    QTest::addColumn<double>("tether");  // [m/s]
    QTest::newRow("winding") << 3.0 << 20.0 << 2.0;
    QTest::newRow("winch at rest") << 3.0 << 20.0 << 0.0;
    QTest::newRow("reeling in") << 10.0 << 0.0 << -1.0;
}

/// Until after the wing has come down, which happens in each of them.
void tst_LaweModel::computesTheBitsOfThePlant()
{
    QFETCH(double, pitch);
    QFETCH(double, yaw);
    QFETCH(double, tether);
    awe::KiteSimulation plant = simulation();
    plant.reset();
    LaweModel_initialize();
    awe::PlantOutputs outputs;
    for (int k = 0; k < 12000; ++k) {
        const double pitchSpeed = pitch * std::sin(0.011 * k), yawSpeed = yaw * std::sin(0.003 * k);
        outputs = plant.step({pitchSpeed, yawSpeed, tether});
        LaweModel_U = {pitchSpeed, yawSpeed, tether};
        LaweModel_step();
        QVERIFY2(equalsBits(LaweModel_Y, outputs), qPrintable(QString::number(k)));
        QVERIFY(!rtmGetErrorStatus(LaweModel_M));
    }
    QVERIFY(outputs.crashed);
}

QTEST_GUILESS_MAIN(tst_LaweModel)
#include "tst_LaweModel.moc"
