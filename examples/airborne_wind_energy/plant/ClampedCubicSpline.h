// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace awe {

/// Piecewise cubic curve through N anchors, twice continuously differentiable, with zero slope at
/// both ends.
///
/// Piece i holds for x(i) <= x <= x(i+1), the first match counts:
///
///     y = a (x - x(i))^3 + b (x - x(i))^2 + c (x - x(i)) + y(i)
///
/// The slopes c at the inner anchors solve the usual tridiagonal system (equal second derivative
/// left and right); it is solved once, by elimination, when the object is made. Outside the anchors
/// the end value is returned. Evaluation takes no memory and may run in the control cycle.
template<std::size_t N>
class ClampedCubicSpline
{
    static_assert(N >= 2, "a spline needs two anchors at least");

public:
    struct Piece
    {
        double a = 0.0, b = 0.0, c = 0.0, d = 0.0;  // cubic, quadratic, linear, constant coefficient
    };

    /// \param x  anchor positions, strictly rising
    /// \param y  anchor values
    ClampedCubicSpline(const std::array<double, N> &x, const std::array<double, N> &y)
        : m_x(x)
        , m_y(y)
    {
        const std::array<double, N> slope = anchorSlopes();
        for (std::size_t i = 0; i + 1 < N; ++i) {
            const double h = x[i + 1] - x[i];
            const double secant = (y[i + 1] - y[i]) / h;
            m_pieces[i].a = (slope[i] + slope[i + 1] - 2.0 * secant) / (h * h);
            m_pieces[i].b = (3.0 * secant - 2.0 * slope[i] - slope[i + 1]) / h;
            m_pieces[i].c = slope[i];
            m_pieces[i].d = y[i];
        }
    }

    double value(double x) const
    {
        if (!(x > m_x.front()))
            return m_y.front();
        for (std::size_t i = 0; i + 1 < N; ++i) {
            if (x <= m_x[i + 1]) {
                const double s = x - m_x[i];
                const Piece &p = m_pieces[i];
                return ((p.a * s + p.b) * s + p.c) * s + p.d;
            }
        }
        return m_y.back();
    }

    const std::array<Piece, N - 1> &pieces() const { return m_pieces; }
    const std::array<double, N> &anchors() const { return m_x; }

private:
    std::array<double, N> anchorSlopes() const
    {
        std::array<double, N> slope{}, upper{};  // both ends stay zero: clamped
        for (std::size_t i = 1; i + 1 < N; ++i) {
            const double left = 1.0 / (m_x[i] - m_x[i - 1]), right = 1.0 / (m_x[i + 1] - m_x[i]);
            const double rightSide
                = 3.0 * ((m_y[i] - m_y[i - 1]) * left * left + (m_y[i + 1] - m_y[i]) * right * right);
            const double pivot = 2.0 * (left + right) - left * upper[i - 1];
            upper[i] = right / pivot;
            slope[i] = (rightSide - left * slope[i - 1]) / pivot;
        }
        for (std::size_t i = N - 1; i-- > 1;)
            slope[i] -= upper[i] * slope[i + 1];
        return slope;
    }

    std::array<double, N> m_x;
    std::array<double, N> m_y;
    std::array<Piece, N - 1> m_pieces{};
};

}  // namespace awe
