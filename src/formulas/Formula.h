// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SignalReference.h"

#include <QtCore/QStringList>
#include <QtCore/QVector>

#include <optional>
#include <string>
#include <vector>

namespace qplc {

/// What is calculated of signals, as text that begins with "=": "= derivative(kite.elevation)", "=
/// power/1000 + 2*abs(bodyPosition_earth[2])". A value type.
///
/// Signals are written as references (SignalReference). Operators and functions are those of
/// muParser: + - * / ^, comparisons, && || ?:, abs(), sqrt(), sin(), min(), ..., and the constants
/// _pi and _e. With a past there are
///
/// | function | of a quantity in u | is in |
/// |---|---|---|
/// | derivative(x) | difference to the row before over the time between | u/s |
/// | integral(x) | by trapezoids, 0 at the first row, without the time of cycles that were lost | u
/// s |
/// | mean(x, T) | of the rows of the last T seconds | u |
/// | lowpass(x, T) | of first order, time constant T [s]; begins with the first value | u |
/// | norm(x, ...) | root of the sum of squares, of all elements of arrays | u |
///
/// T is a number, 0 < T <= 600. Functions may be nested. "a/b" is a division unless a plant has the
/// name a; blanks make it one in any case.
class Formula
{
public:
    /// A signal of the formula.
    struct Operand
    {
        SignalReference reference;
        int place = 0;        // of its first character, from 0
        bool isNorm = false;  // of all elements
    };
    enum Function { Plain, Derivative, Integral, Mean, LowPass };
    /// Something calculated of operands s0, s1, ... and of parts before, f0, f1, ...
    struct Part
    {
        std::string text;         // for muParser
        std::vector<int> places;  // of each of its characters in the text of the formula
        int end = 0;              // the place behind it
        Function function = Plain;
        double seconds = 0.0;  // T of the function
    };

    static constexpr double longestTime = 600.0;  // [s]
    static constexpr int longestText = 1000;      // characters

    /// Whether it begins with "=".
    static bool isFormula(const QString &text);
    /// \param plants  names that references may begin with
    /// \return one that is not valid, with what is wrong and where in \a error, when \a text is
    ///         none
    static Formula read(const QString &text, const QStringList &plants, QString *error = nullptr);

    bool isValid() const { return !m_parts.empty(); }
    const QVector<Operand> &operands() const { return m_operands; }
    /// In the order of calculation; the last one is the result.
    const std::vector<Part> &parts() const { return m_parts; }
    /// Of the result, when it is one function of one signal; empty for all else. \param units of
    /// the operands
    QString unit(const QStringList &units) const;
    /// \a what is wrong, with the place in the text.
    QString errorAt(int place, const QString &what) const;

private:
    std::optional<QString> unitOf(const std::string &text, const QStringList &units) const;

    QString m_text;
    QVector<Operand> m_operands;
    std::vector<Part> m_parts;
};

}  // namespace qplc
