// SPDX-License-Identifier: Apache-2.0
#include "Formula.h"

#include "FormulaCalculator.h"
#include "FormulaReader.h"

namespace qplc {

namespace {

QString derivativeUnit(const QString &unit)
{
    if (unit.endsWith(QLatin1String(" s")))
        return unit.chopped(2);
    if (unit.endsWith(QLatin1String("/s")))
        return unit + QChar(0xb2);  // "m/s" becomes "m/s²"
    return (unit.isEmpty() ? QStringLiteral("1") : unit) + QLatin1String("/s");
}

QString integralUnit(const QString &unit)
{
    if (unit.endsWith(QLatin1String("/s")))
        return unit.chopped(2);
    if (unit.endsWith(QLatin1String("/s") + QChar(0xb2)))
        return unit.chopped(1);
    return unit.isEmpty() ? QStringLiteral("s") : unit + QLatin1String(" s");
}

}  // namespace

bool Formula::isFormula(const QString &text)
{
    return text.trimmed().startsWith(QLatin1Char('='));
}

Formula Formula::read(const QString &text, const QStringList &plants, QString *error)
{
    Formula formula;
    formula.m_text = text;
    const auto refuse = [&](int place, const QString &what) {
        if (error)
            *error = formula.errorAt(place, what);
        return Formula();
    };
    if (error)
        error->clear();
    if (text.size() > longestText)
        return refuse(longestText, QStringLiteral("a formula has at most %1 characters").arg(longestText));
    try {
        const FormulaText read = readFormula(text, plants);
        formula.m_operands = read.operands;
        formula.m_parts = read.parts;
    } catch (const FormulaError &found) {
        return refuse(found.place, found.what);
    }
    if (const auto found = FormulaCalculator::check(formula.m_operands, formula.m_parts)) {
        const Part &part = formula.m_parts[std::size_t(found->part)];
        const auto character = std::size_t(found->character);
        return refuse(character < part.places.size() ? part.places[character] : part.end, found->what);
    }
    return formula;
}

QString Formula::errorAt(int place, const QString &what) const
{
    const QString where = place >= m_text.size()
        ? QStringLiteral("at the end of '%1'").arg(m_text)
        : QStringLiteral("at character %1 of '%2', before '%3'").arg(place + 1).arg(m_text, m_text.mid(place, 12));
    return QStringLiteral("%1 (%2)").arg(what, where);
}

QString Formula::unit(const QStringList &units) const
{
    return unitOf(m_parts.back().text, units).value_or(QString());
}

/// Nothing when \a text is more than one operand or part.
std::optional<QString> Formula::unitOf(const std::string &text, const QStringList &units) const
{
    const QString name = QString::fromStdString(text).trimmed();
    bool isNumber = false;
    const int number = name.mid(1).toInt(&isNumber);
    if (isNumber && name.startsWith(QLatin1Char('s')))
        return units.value(number);
    if (!isNumber || !name.startsWith(QLatin1Char('f')))
        return std::nullopt;
    const Part &part = m_parts[std::size_t(number)];
    const std::optional<QString> unit = unitOf(part.text, units);
    if (!unit)
        return std::nullopt;
    return part.function == Derivative ? derivativeUnit(*unit) : part.function == Integral ? integralUnit(*unit) : unit;
}

}  // namespace qplc
