// SPDX-License-Identifier: Apache-2.0
#include "ClampedCubicSpline.h"

#include "Near.h"

using awe::ClampedCubicSpline;

class tst_ClampedCubicSpline : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void passesThroughItsAnchors();
    void isSmoothAtInnerAnchors();
    void hasZeroSlopeAtBothEnds();
    void twoAnchorsGiveTheHermiteCubic();
    void holdsTheEndValuesOutside();
    void reproducesACubicThatIsFlatAtItsEnds();

private:
    const ClampedCubicSpline<4> m_uneven{{-3.0, -1.0, 0.5, 4.0}, {1.0, -2.0, 0.25, 7.0}};
};

void tst_ClampedCubicSpline::passesThroughItsAnchors()
{
    const std::array<double, 4> y = {1.0, -2.0, 0.25, 7.0};
    for (std::size_t i = 0; i < y.size(); ++i)
        COMPARE_NEAR(m_uneven.value(m_uneven.anchors()[i]), y[i], 1e-14);
}

void tst_ClampedCubicSpline::isSmoothAtInnerAnchors()
{
    for (std::size_t i = 0; i + 1 < m_uneven.pieces().size(); ++i) {
        const auto &left = m_uneven.pieces()[i], &right = m_uneven.pieces()[i + 1];
        const double h = m_uneven.anchors()[i + 1] - m_uneven.anchors()[i];
        COMPARE_NEAR((3.0 * left.a * h + 2.0 * left.b) * h + left.c, right.c, 1e-13);
        COMPARE_NEAR(6.0 * left.a * h + 2.0 * left.b, 2.0 * right.b, 1e-13);
    }
}

void tst_ClampedCubicSpline::hasZeroSlopeAtBothEnds()
{
    COMPARE_NEAR(m_uneven.pieces().front().c, 0.0, 0.0);
    const auto &last = m_uneven.pieces().back();
    const double h = 3.5;
    COMPARE_NEAR((3.0 * last.a * h + 2.0 * last.b) * h + last.c, 0.0, 1e-13);
}

void tst_ClampedCubicSpline::twoAnchorsGiveTheHermiteCubic()
{
    const ClampedCubicSpline<2> spline({0.0, 1.0}, {0.0, 1.0});  // 3 x^2 - 2 x^3
    COMPARE_NEAR(spline.value(0.5), 0.5, 1e-15);
    COMPARE_NEAR(spline.value(0.25), 0.15625, 1e-15);
}

void tst_ClampedCubicSpline::holdsTheEndValuesOutside()
{
    COMPARE_NEAR(m_uneven.value(-100.0), 1.0, 0.0);
    COMPARE_NEAR(m_uneven.value(100.0), 7.0, 0.0);
    COMPARE_NEAR(m_uneven.value(std::nan("")), 1.0, 0.0);
}

void tst_ClampedCubicSpline::reproducesACubicThatIsFlatAtItsEnds()
{
    const auto cubic = [](double x) { return x * x * x - 3.0 * x; };  // slope 0 at -1 and 1
    const ClampedCubicSpline<4> spline({-1.0, -0.2, 0.5, 1.0}, {cubic(-1.0), cubic(-0.2), cubic(0.5), cubic(1.0)});
    for (double x = -1.0; x <= 1.0; x += 0.05)
        COMPARE_NEAR(spline.value(x), cubic(x), 1e-14);
}

QTEST_APPLESS_MAIN(tst_ClampedCubicSpline)
#include "tst_ClampedCubicSpline.moc"
