// SPDX-License-Identifier: Apache-2.0
#include "FormulaCalculator.h"

#include "PastFilter.h"

#include <muParser.h>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

std::string operandName(std::size_t number)
{
    return "s" + std::to_string(number);
}

std::string partName(std::size_t number)
{
    return "f" + std::to_string(number);
}

QString sentenceOf(const mu::ParserError &error)
{
    switch (error.GetCode()) {
    case mu::ecUNEXPECTED_EOF:
        return QStringLiteral("a value is missing");
    case mu::ecEMPTY_EXPRESSION:
        return QStringLiteral("there is nothing to calculate");
    case mu::ecUNEXPECTED_OPERATOR:
    case mu::ecUNASSIGNABLE_TOKEN:
    case mu::ecUNEXPECTED_CONDITIONAL:
        return QStringLiteral("an operator stands where a value is expected");
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_FUN:
        return QStringLiteral("an operator is missing before this");
    case mu::ecUNEXPECTED_PARENS:
        return QStringLiteral("a parenthesis stands at a wrong place");
    case mu::ecUNEXPECTED_ARG_SEP:
    case mu::ecUNEXPECTED_ARG:
        return QStringLiteral("a comma stands at a wrong place");
    case mu::ecTOO_MANY_PARAMS:
        return QStringLiteral("the function has too many arguments");
    case mu::ecTOO_FEW_PARAMS:
        return QStringLiteral("the function has too few arguments");
    case mu::ecMISSING_ELSE_CLAUSE:
        return QStringLiteral("':' is missing behind '?'");
    case mu::ecMISPLACED_COLON:
        return QStringLiteral("':' stands without a '?'");
    default:
        return QStringLiteral("this is not a formula");
    }
}

bool isBlank(const std::string &text)
{
    return text.find_first_not_of(' ') == std::string::npos;
}

/// Where there is nothing to calculate, muParser names no place.
int characterOf(const mu::ParserError &error)
{
    return std::max(int(error.GetPos()), 0);
}

}  // namespace

struct FormulaCalculator::Private
{
    explicit Private(std::size_t operandCount, const std::vector<Formula::Part> &parts)
        : operands(operandCount, 1.0)
        , results(parts.size(), 1.0)
        , parsers(parts.size())
    {
        for (std::size_t part = 0; part < parts.size(); ++part) {
            for (std::size_t i = 0; i < operandCount; ++i)
                parsers[part].DefineVar(operandName(i), &operands[i]);
            for (std::size_t i = 0; i < part; ++i)
                parsers[part].DefineVar(partName(i), &results[i]);
            parsers[part].SetExpr(parts[part].text);
            filters.emplace_back(parts[part].function, parts[part].seconds);
        }
    }

    // Parsers know the addresses of these.
    std::vector<double> operands;
    std::vector<double> results;
    std::vector<mu::Parser> parsers;
    std::vector<PastFilter> filters;
};

FormulaCalculator::FormulaCalculator(const Formula &formula)
    : d(std::make_unique<Private>(std::size_t(formula.operands().size()), formula.parts()))
{
}

FormulaCalculator::~FormulaCalculator() = default;

std::optional<FormulaCalculator::Error> FormulaCalculator::check(const QVector<Formula::Operand> &operands,
                                                                 const std::vector<Formula::Part> &parts)
{
    for (std::size_t part = 0; part < parts.size(); ++part) {
        if (isBlank(parts[part].text))
            return Error{int(part), int(parts[part].text.size()), QStringLiteral("a value is missing")};
    }
    Private trial(std::size_t(operands.size()), parts);
    for (std::size_t part = 0; part < parts.size(); ++part) {
        try {
            trial.parsers[part].Eval();
        } catch (const mu::ParserError &error) {
            return Error{int(part), characterOf(error), sentenceOf(error)};
        }
    }
    return std::nullopt;
}

const QStringList &FormulaCalculator::functions()
{
    static const QStringList names = [] {
        QStringList list;
        const mu::Parser parser;
        for (const auto &function : parser.GetFunDef())
            list << QString::fromStdString(function.first);
        return list;
    }();
    return names;
}

void FormulaCalculator::interrupt()
{
    for (PastFilter &filter : d->filters)
        filter.interrupt();
}

double FormulaCalculator::next(Time time, const double *operands)
{
    std::copy_n(operands, d->operands.size(), d->operands.begin());
    try {
        for (std::size_t part = 0; part < d->parsers.size(); ++part)
            d->results[part] = d->filters[part].next(time, d->parsers[part].Eval());
    } catch (const mu::ParserError &) {
        return NAN;  // a function has no value there
    }
    return d->results.back();
}

}  // namespace qplc
