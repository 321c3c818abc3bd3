// SPDX-License-Identifier: Apache-2.0
#include "Aerodynamics.h"

#include "Near.h"

#include <array>
#include <fstream>
#include <string>

using awe::Aerodynamics;
using awe::AngleOfAttackRange;
using Eigen::Vector3d;

class tst_Aerodynamics : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void dragCoefficientsAreTheExactFractions();
    void liftCoefficientsAgreeWithThePublishedDigits();
    void agreesWithTheTableForEveryDegree();
    void bestAweCoefficientIsThePublishedOne();
    void bestGlideAndZeroLiftAgreeWithTheReferenceAngles();
    void maximumPowerAtThesisWindIsPublished();
    void dragFactorScalesDragButNotTheAweCoefficient();
    void noWindGivesNoForce();
    void windAlongTheSpanGivesDragOnly();
    void liftIsPerpendicularToWindAndSpan();
    void forceGrowsWithTheSquareOfTheSpeed();
    void windFromBelowGivesAPositiveAngle();
    void roundingBeyondOneIsClamped();
    void foldedRangeFoldsBackwardFlow();
    void fullRangeDistinguishesBackwardFlow();
};

namespace {

const Vector3d tail = Vector3d::UnitX(), side = Vector3d::UnitY(), top = Vector3d::UnitZ();

}  // namespace

void tst_Aerodynamics::dragCoefficientsAreTheExactFractions()
{
    const double expected[4][4] = {{-1.3 / 729000.0, 1.0 / 4500.0, 0.0, 0.5},
                                   {1.5 / 729000.0, -2.1 / 8100.0, -1.0 / 300.0, 1.0},
                                   {-1.5 / 729000.0, 2.4 / 8100.0, 0.0, 0.1},
                                   {1.3 / 729000.0, -2.1 / 8100.0, 1.0 / 300.0, 1.0}};
    const Aerodynamics aerodynamics;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto &piece = aerodynamics.dragSpline().pieces()[i];
        COMPARE_NEAR(piece.a, expected[i][0], 1e-20);
        COMPARE_NEAR(piece.b, expected[i][1], 1e-18);
        COMPARE_NEAR(piece.c, expected[i][2], 1e-17);
        COMPARE_NEAR(piece.d, expected[i][3], 0.0);
    }
}

void tst_Aerodynamics::liftCoefficientsAgreeWithThePublishedDigits()
{
    const double cubic[6] = {-1.07943755498536e-05, 2.75078193731700e-06, 2.03492707314944e-06,
                             -1.82365512609771e-05, 4.45092408658084e-06, -1.35093994928975e-05};
    const Aerodynamics aerodynamics;
    for (std::size_t i = 0; i < 6; ++i)
        COMPARE_NEAR(aerodynamics.liftSpline().pieces()[i].a, cubic[i], 1e-19);
    COMPARE_NEAR(aerodynamics.liftSpline().pieces()[3].c, 0.0299497321847434, 1e-15);
}

void tst_Aerodynamics::agreesWithTheTableForEveryDegree()
{
    std::ifstream table(AWE_REFERENCE "/aero_table.csv");
    const Aerodynamics aerodynamics;
    double angle = 0.0, drag = 0.0, lift = 0.0, awe = 0.0;
    char comma = 0;
    int lines = 0;
    while (table >> angle >> comma >> drag >> comma >> lift >> comma >> awe) {
        ++lines;
        const Aerodynamics::Coefficients found = aerodynamics.coefficients(angle);
        COMPARE_NEAR(found.drag, drag, 1e-14);
        COMPARE_NEAR(found.lift, lift, 1e-14);
        COMPARE_NEAR(found.awe, awe, 1e-12);
    }
    QCOMPARE(lines, 181);
}

void tst_Aerodynamics::bestAweCoefficientIsThePublishedOne()
{
    const Aerodynamics::BestAngle best = Aerodynamics::bestAngleOfAttack();
    COMPARE_NEAR(best.aweCoefficient, 17.5427, 5e-5);
    COMPARE_NEAR(best.angleOfAttack, 21.977, 5e-4);
}

void tst_Aerodynamics::bestGlideAndZeroLiftAgreeWithTheReferenceAngles()
{
    const Aerodynamics aerodynamics;
    COMPARE_NEAR(aerodynamics.liftCoefficient(15.2) / aerodynamics.dragCoefficient(15.2), 4.438, 5e-4);
    COMPARE_NEAR(aerodynamics.liftCoefficient(-7.716), 0.0, 2e-5);
    COMPARE_NEAR(aerodynamics.dragCoefficient(0.0), 0.1, 1e-15);
}

void tst_Aerodynamics::maximumPowerAtThesisWindIsPublished()
{
    const double windSpeed = Vector3d(5.0, 3.0, 0.0).norm();
    const double power
        = 2.0 / 27.0 * 1.2 * 10.0 * std::pow(windSpeed, 3) * Aerodynamics::bestAngleOfAttack().aweCoefficient;
    COMPARE_NEAR(power, 3091.46, 0.01);
}

void tst_Aerodynamics::dragFactorScalesDragButNotTheAweCoefficient()
{
    const Aerodynamics plain, slippery(0.2);
    const Aerodynamics::Coefficients a = plain.coefficients(22.0), b = slippery.coefficients(22.0);
    COMPARE_NEAR(b.drag, 0.2 * a.drag, 1e-16);
    COMPARE_NEAR(b.lift, a.lift, 0.0);
    COMPARE_NEAR(b.awe, a.awe, 0.0);
}

void tst_Aerodynamics::noWindGivesNoForce()
{
    const Aerodynamics::Airflow flow = Aerodynamics().airflow(Vector3d::Zero(), tail, side, top, 6.0);
    QCOMPARE(flow.force, Vector3d(Vector3d::Zero()));
    QCOMPARE(flow.angleOfAttack, 0.0);
}

void tst_Aerodynamics::windAlongTheSpanGivesDragOnly()
{
    const Aerodynamics::Airflow flow = Aerodynamics().airflow(10.0 * side, tail, side, top, 6.0);
    COMPARE_NEAR((flow.force - Vector3d(0.0, 6.0 * 100.0 * 0.1, 0.0)).norm(), 0.0, 1e-12);
}

void tst_Aerodynamics::liftIsPerpendicularToWindAndSpan()
{
    const Vector3d wind(9.0, 2.0, 3.0);
    const Aerodynamics::Airflow flow = Aerodynamics().airflow(wind, tail, side, top, 6.0);
    const Vector3d lift = flow.force - 6.0 * wind.norm() * flow.drag * wind;
    COMPARE_NEAR(lift.dot(wind), 0.0, 1e-10);
    COMPARE_NEAR(lift.dot(side), 0.0, 1e-10);
    COMPARE_NEAR(lift.norm(), 6.0 * wind.squaredNorm() * flow.lift, 1e-10);
    QVERIFY(lift.dot(top) > 0.0);
}

void tst_Aerodynamics::forceGrowsWithTheSquareOfTheSpeed()
{
    const Vector3d wind(9.0, 2.0, 3.0);
    const Vector3d once = Aerodynamics().airflow(wind, tail, side, top, 6.0).force;
    const Vector3d twice = Aerodynamics().airflow(2.0 * wind, tail, side, top, 6.0).force;
    COMPARE_NEAR((twice - 4.0 * once).norm(), 0.0, 1e-9);
}

void tst_Aerodynamics::windFromBelowGivesAPositiveAngle()
{
    const Vector3d wind = std::cos(0.3) * tail + std::sin(0.3) * top;
    COMPARE_NEAR(Aerodynamics().airflow(wind, tail, side, top, 6.0).angleOfAttack, 17.188733853924695, 1e-12);
}

void tst_Aerodynamics::roundingBeyondOneIsClamped()
{
    const Vector3d top2(0.0, 0.0, 1.0 + 1e-15);  // a unit vector after rounding
    COMPARE_NEAR(Aerodynamics().airflow(3.0 * top, tail, side, top2, 6.0).angleOfAttack, 90.0, 0.0);
}

void tst_Aerodynamics::foldedRangeFoldsBackwardFlow()
{
    const Vector3d fromBehind = -std::cos(0.3) * tail + std::sin(0.3) * top;
    COMPARE_NEAR(Aerodynamics().airflow(fromBehind, tail, side, top, 6.0).angleOfAttack, 17.188733853924695, 1e-12);
}

void tst_Aerodynamics::fullRangeDistinguishesBackwardFlow()
{
    const Aerodynamics full(1.0, AngleOfAttackRange::Full);
    const Vector3d fromBehind = -std::cos(0.3) * tail + std::sin(0.3) * top;
    COMPARE_NEAR(full.airflow(fromBehind, tail, side, top, 6.0).angleOfAttack, 180.0 - 17.188733853924695, 1e-12);
    const Vector3d fromAhead = std::cos(0.3) * tail - std::sin(0.3) * top;
    COMPARE_NEAR(full.airflow(fromAhead, tail, side, top, 6.0).angleOfAttack, -17.188733853924695, 1e-12);
}

QTEST_APPLESS_MAIN(tst_Aerodynamics)
#include "tst_Aerodynamics.moc"
