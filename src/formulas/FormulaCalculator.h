// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Formula.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace qplc {

/// Calculates a formula row after row.
///
/// NaN in, NaN out. After a NaN derivative and low-pass begin anew; the integral goes on without
/// the time that is missing; the mean is that of the other rows.
class FormulaCalculator
{
public:
    using Time = std::int64_t;  // [ns]

    /// What muParser refuses.
    struct Error
    {
        int part;
        int character;  // of the text of the part
        QString what;
    };

    /// \pre check() finds nothing
    explicit FormulaCalculator(const Formula &formula);
    ~FormulaCalculator();

    static std::optional<Error> check(const QVector<Formula::Operand> &operands,
                                      const std::vector<Formula::Part> &parts);
    /// Those of muParser.
    static const QStringList &functions();

    /// There is a gap before the next row: of cycles that were lost (at most 0.5 s), which is as a
    /// NaN, or what follows does not continue what was, and everything with a past begins anew.
    void interrupt();
    /// The result of the next row. \param time  after that of the row before
    /// \param operands  one for each operand of the formula
    double next(Time time, const double *operands);

private:
    struct Private;
    std::unique_ptr<Private> d;
};

}  // namespace qplc
