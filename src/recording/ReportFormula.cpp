// SPDX-License-Identifier: Apache-2.0
#include "ReportFormula.h"

#ifdef QTPLC_HAS_FORMULAS
#include "formulas/FormulaCalculator.h"
#endif

#include <algorithm>
#include <cmath>
#include <optional>

namespace qplc {

bool ReportFormula::isFormula(const QString &text)
{
    return text.trimmed().startsWith(QLatin1Char('='));
}

#ifdef QTPLC_HAS_FORMULAS

struct ReportFormula::Private
{
    /// A signal of the formula.
    struct Operand
    {
        std::size_t column = 0;
        int element = 0;
        int elements = 1;     // of a norm
        bool isNorm = false;  // of all elements

        double value(const RecordedRows &rows) const
        {
            if (!isNorm)
                return rows.number(column, element);
            double sum = 0.0;
            for (int i = element; i < element + elements; ++i)
                sum += rows.number(column, i) * rows.number(column, i);
            return std::sqrt(sum);
        }
    };

    explicit Private(const Formula &formula)
        : calculator(formula)
    {
    }

    FormulaCalculator calculator;
    std::vector<Operand> operands;
    std::vector<double> values;  // of the operands
    std::optional<std::uint64_t> lastCycle;
};

namespace {

/// \return what is wrong with a signal of a formula, with %1 for its name
QString problemOf(const SignalReference &reference, bool isNorm, const Recording &recording,
                  const std::vector<int> &columns)
{
    const int signal = recording.indexOf(reference.signal);
    if (signal < 0)
        return QStringLiteral("the recording has no signal %1");
    if (columns[std::size_t(signal)] < 0)
        return QStringLiteral("%1 is not a number");
    const QPlcSignalType type = recording.signalList()[std::size_t(signal)].definition.type;
    const bool isWhole = reference.element == SignalReference::Whole;
    if (!isWhole && reference.element >= type.count())
        return QStringLiteral("the recording has no element %1");
    if (isWhole && type.isArray() && !isNorm)
        return QStringLiteral("%1 is an array; choose an element, %1[0], or take norm(%1)");
    return {};
}

}  // namespace

ReportFormula::ReportFormula(const QString &text, const Recording &recording, const std::vector<int> &columns)
    : m_text(text.trimmed())
{
    const Formula formula = Formula::read(m_text, {recording.description().plant}, &m_problem);
    if (!formula.isValid())
        return;
    if (formula.operands().isEmpty())
        m_problem = formula.errorAt(0, QStringLiteral("a formula needs a signal, for its times"));
    auto made = std::make_unique<Private>(formula);
    QStringList units;
    for (const Formula::Operand &operand : formula.operands()) {
        const SignalReference &reference = operand.reference;
        const QString problem = problemOf(reference, operand.isNorm, recording, columns);
        if (!problem.isEmpty()) {
            m_problem = formula.errorAt(operand.place, problem.arg(reference.toString()));
            return;
        }
        const int signal = recording.indexOf(reference.signal);
        const QPlcSignalDefinition &definition = recording.signalList()[std::size_t(signal)].definition;
        const bool isWhole = reference.element == SignalReference::Whole;
        made->operands.push_back({std::size_t(columns[std::size_t(signal)]), isWhole ? 0 : reference.element,
                                  isWhole ? definition.type.count() : 1, operand.isNorm});
        units << definition.unit;
    }
    if (!m_problem.isEmpty())
        return;
    made->values.resize(made->operands.size());
    m_unit = formula.unit(units);
    d = std::move(made);
}

overview::Bucket ReportFormula::next(const RecordedRows &rows)
{
    const std::uint64_t cycle = rows.cycle().number;
    if (d->lastCycle && cycle != *d->lastCycle + 1)
        d->calculator.interrupt();
    d->lastCycle = cycle;
    quint8 worst = QPlcQuality(QPlcQuality::Good).toByte();
    for (std::size_t i = 0; i < d->operands.size(); ++i) {
        const Private::Operand &operand = d->operands[i];
        const bool isThere = rows.value(operand.column) != nullptr;
        const QPlcQuality quality = isThere ? rows.quality(operand.column) : QPlcQuality(QPlcQuality::Invalid);
        d->values[i] = quality.kind() != QPlcQuality::Invalid ? operand.value(rows) : NAN;
        worst = std::max(worst, quality.toByte());
    }
    const double result = d->calculator.next(rows.time(), d->values.data());
    overview::Bucket bucket{result, result, overview::flagOf(QPlcQuality::fromByte(worst))};
    if (std::isfinite(result))
        bucket.flags |= overview::HasValue;
    else
        bucket.flags &= quint8(~overview::HasValue);
    return bucket;
}

#else

struct ReportFormula::Private
{
};

ReportFormula::ReportFormula(const QString &text, const Recording & /*recording*/, const std::vector<int> & /*columns*/)
    : m_text(text.trimmed())
    , m_problem(QStringLiteral("this qtplc calculates no formulas: it was built without muParser"))
{
}

overview::Bucket ReportFormula::next(const RecordedRows & /*rows*/)
{
    return {};
}

#endif

ReportFormula::ReportFormula(ReportFormula &&other) noexcept = default;

ReportFormula::~ReportFormula() = default;

}  // namespace qplc
