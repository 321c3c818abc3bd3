// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Formula.h"

namespace qplc {

/// Where a text is no formula, and why.
struct FormulaError
{
    int place;
    QString what;
};

struct FormulaText
{
    QVector<Formula::Operand> operands;
    std::vector<Formula::Part> parts;
};

/// Takes the text of a formula apart: signals become operands, functions with a past become parts,
/// the rest is for muParser. \throw FormulaError
FormulaText readFormula(const QString &text, const QStringList &plants);

}  // namespace qplc
