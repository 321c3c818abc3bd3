// SPDX-License-Identifier: Apache-2.0
#include "PayloadRules.h"

#include <QtCore/qendian.h>

#include <cmath>
#include <limits>

namespace qplc {

namespace {

/// \param exponent  the bits that are all set in NaN and infinity
template<typename Bits>
bool allFinite(const char *bytes, quint32 size, Bits exponent) noexcept
{
    bool finite = true;  // no early end: compilers make a loop without one a few wide instructions
    for (quint32 i = 0; i < size; i += sizeof(Bits))
        finite &= (qFromLittleEndian<Bits>(bytes + i) & exponent) != exponent;
    return finite;
}

/// The first of \a count values outside of the limits; NaN is within all limits.
template<typename Wire, typename Bound>
ValueFault firstOutside(const char *bytes, int count, Bound minimum, Bound maximum) noexcept
{
    for (int i = 0; i < count; ++i) {
        const auto value = Bound(qFromLittleEndian<Wire>(bytes + sizeof(Wire) * std::size_t(i)));
        if (value < minimum || value > maximum)
            return {value < minimum ? ValueFault::BelowMinimum : ValueFault::AboveMaximum, double(value)};
    }
    return {};
}

double real(const char *bytes, QPlcSignalType::Scalar scalar) noexcept
{
    return scalar == QPlcSignalType::Real32 ? double(qFromLittleEndian<float>(bytes))
                                            : qFromLittleEndian<double>(bytes);
}

}  // namespace

QString faultText(const QPlcSignalDefinition &signal, const ValueFault &fault)
{
    const QPlcValue exact(fault.value);
    const QPlcValue rounded = exact.convertedTo(QPlcSignalType(signal.type.scalar()));
    const QString value = (rounded.isValid() ? rounded : exact).toString();
    switch (fault.kind) {
    case ValueFault::NotFinite:
        return QStringLiteral("%1 is not a finite number").arg(value);
    case ValueFault::BelowMinimum:
        return QStringLiteral("%1 is below its minimum %2").arg(value, signal.minimum.toString());
    case ValueFault::AboveMaximum:
        return QStringLiteral("%1 is above its maximum %2").arg(value, signal.maximum.toString());
    case ValueFault::None:
        break;
    }
    return {};
}

PayloadRules::PayloadRules(const QPlcSignalTable &table, const PayloadLayout &layout)
{
    m_fields.reserve(layout.fields().size());
    for (const PayloadLayout::Field &field : layout.fields()) {
        const QPlcSignalDefinition &signal = table.at(field.signal);
        Field rules;
        if (field.type.isReal() && !signal.nanAllowed) {
            rules.run = {field.type.scalar(), field.offset, quint32(field.type.size())};
            add(rules.run);
        }
        if (signal.minimum.isValid() || signal.maximum.isValid() || (field.type.isReal() && signal.nanAllowed)) {
            rules.limits = int(m_limits.size());
            m_limits.push_back(limitsOf(signal, field.offset));
        }
        m_fields.push_back(rules);
    }
}

void PayloadRules::add(const RealRun &run)
{
    if (!m_realRuns.empty()) {
        RealRun &last = m_realRuns.back();
        if (last.scalar == run.scalar && last.offset + last.size == run.offset) {
            last.size += run.size;
            return;
        }
    }
    m_realRuns.push_back(run);
}

PayloadRules::Limits PayloadRules::limitsOf(const QPlcSignalDefinition &signal, quint32 offset)
{
    Limits limits{signal.type.scalar(), quint16(signal.type.count()), offset, {}, {}};
    const bool isNatural
        = signal.type.scalar() >= QPlcSignalType::UInt8 && signal.type.scalar() <= QPlcSignalType::UInt64;
    const bool hasMinimum = signal.minimum.isValid(), hasMaximum = signal.maximum.isValid();
    if (signal.type.isReal()) {
        constexpr double greatest = std::numeric_limits<double>::max();  // infinity is never a value
        limits.minimum.real = hasMinimum ? std::fmax(signal.minimum.toReal(), -greatest) : -greatest;
        limits.maximum.real = hasMaximum ? std::fmin(signal.maximum.toReal(), greatest) : greatest;
    } else if (isNatural) {
        limits.minimum.natural = hasMinimum ? signal.minimum.toUInt64() : 0;
        limits.maximum.natural = hasMaximum ? signal.maximum.toUInt64() : std::numeric_limits<quint64>::max();
    } else {
        limits.minimum.integer = hasMinimum ? signal.minimum.toInt64() : std::numeric_limits<qint64>::min();
        limits.maximum.integer = hasMaximum ? signal.maximum.toInt64() : std::numeric_limits<qint64>::max();
    }
    return limits;
}

bool PayloadRules::isFinite(const RealRun &run, const char *payload) noexcept
{
    const char *bytes = payload + run.offset;
    return run.scalar == QPlcSignalType::Real32 ? allFinite<quint32>(bytes, run.size, 0x7f800000u)
                                                : allFinite<quint64>(bytes, run.size, 0x7ff0000000000000u);
}

ValueFault PayloadRules::firstOutside(const Limits &limits, const char *payload) noexcept
{
    const char *bytes = payload + limits.offset;
    const int count = limits.count;
    switch (limits.scalar) {
    case QPlcSignalType::Real32:
        return qplc::firstOutside<float, double>(bytes, count, limits.minimum.real, limits.maximum.real);
    case QPlcSignalType::Real64:
        return qplc::firstOutside<double, double>(bytes, count, limits.minimum.real, limits.maximum.real);
    case QPlcSignalType::Int8:
        return qplc::firstOutside<qint8, qint64>(bytes, count, limits.minimum.integer, limits.maximum.integer);
    case QPlcSignalType::Int16:
        return qplc::firstOutside<qint16, qint64>(bytes, count, limits.minimum.integer, limits.maximum.integer);
    case QPlcSignalType::Int32:
        return qplc::firstOutside<qint32, qint64>(bytes, count, limits.minimum.integer, limits.maximum.integer);
    case QPlcSignalType::Int64:
        return qplc::firstOutside<qint64, qint64>(bytes, count, limits.minimum.integer, limits.maximum.integer);
    case QPlcSignalType::UInt8:
        return qplc::firstOutside<quint8, quint64>(bytes, count, limits.minimum.natural, limits.maximum.natural);
    case QPlcSignalType::UInt16:
        return qplc::firstOutside<quint16, quint64>(bytes, count, limits.minimum.natural, limits.maximum.natural);
    case QPlcSignalType::UInt32:
        return qplc::firstOutside<quint32, quint64>(bytes, count, limits.minimum.natural, limits.maximum.natural);
    case QPlcSignalType::UInt64:
        return qplc::firstOutside<quint64, quint64>(bytes, count, limits.minimum.natural, limits.maximum.natural);
    case QPlcSignalType::Invalid:
    case QPlcSignalType::String:
    case QPlcSignalType::DateTime:
        break;  // have no limits
    }
    return {};
}

ValueFault PayloadRules::fault(std::size_t field, const char *payload) const noexcept
{
    const Field &rules = m_fields[field];
    if (rules.run.size > 0 && !isFinite(rules.run, payload)) {
        const quint32 step = rules.run.scalar == QPlcSignalType::Real32 ? sizeof(float) : sizeof(double);
        for (quint32 offset = rules.run.offset;; offset += step) {
            const double value = real(payload + offset, rules.run.scalar);
            if (!std::isfinite(value))
                return {ValueFault::NotFinite, value};
        }
    }
    if (rules.limits < 0)
        return {};
    const ValueFault outside = firstOutside(m_limits[std::size_t(rules.limits)], payload);
    return std::isinf(outside.value) ? ValueFault{ValueFault::NotFinite, outside.value} : outside;
}

}  // namespace qplc
