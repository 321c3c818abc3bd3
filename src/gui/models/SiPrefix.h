// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

namespace qplc {

/// The prefix with which values of a unit are written: "13.90 µs", "1.008 MJ". A value type.
///
/// - Units that take prefixes are s, m, N, Nm, J, W, Wh, V, A, VA, Hz, Pa, Ohm, F, H and C, also
///   those that have one already ("kN", "us"). All others are written as they are: deg, %, rad,
///   m/s, kg, 1.
/// - From 0.1 up to 10 000 a value has the unit of the signal table. Above and below it gets the
///   prefix with which it is from 1 up to 1000.
/// - What is shown again and again keeps its prefix while the value is from 0.1 up to 10 000 with
///   it (kept()), so that the unit does not jump.
class SiPrefix
{
public:
    /// The unit as it is.
    SiPrefix() = default;
    explicit SiPrefix(const QString &unit)
        : m_table(unit)
        , m_shown(unitText(unit))
    {
    }
    /// \param size  of the largest value that is shown with it [unit]
    static SiPrefix fitting(const QString &unit, double size);
    /// This one while it is good enough for \a size [unit of the table], else the fitting one.
    SiPrefix kept(double size) const;

    /// Numbers are multiplied by it.
    double factor() const { return m_factor; }
    double shown(double value) const { return m_factor * value; }
    /// "µs"; empty: there is none.
    QString unit() const { return m_shown; }
    /// As the signal table has it.
    const QString &tableUnit() const { return m_table; }

    /// Whether values of a unit are ever written with a prefix.
    static bool isTakenBy(const QString &unit);
    /// A unit as people read it: "us" is "µs", and the unit 1 is empty.
    static QString unitText(const QString &unit);

private:
    QString m_table;
    QString m_shown;
    double m_factor = 1.0;
};

/// A number of so many significant digits, also when the last ones are 0, so that numbers do not
/// become narrower now and then: "1.200". Below 1 it has as many decimals as from 1 to 10.
/// Exponents where there is no other way, "–" for NaN.
QString steadyNumberText(double value, int digits);

}  // namespace qplc
