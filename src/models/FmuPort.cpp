// SPDX-License-Identifier: Apache-2.0
#include "FmuPort.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace qplc {

namespace {

bool isReal(const FmuVariable &variable)
{
    return variable.kind == FmuVariable::Float32 || variable.kind == FmuVariable::Float64;
}

struct IntegerRange
{
    qint64 minimum;
    qint64 maximum;
};

template<typename Integer>
constexpr IntegerRange integerRange()
{
    return {qint64(std::numeric_limits<Integer>::min()), qint64(std::numeric_limits<Integer>::max())};
}

IntegerRange integerRange(QPlcSignalType::Scalar scalar)
{
    switch (scalar) {
    case QPlcSignalType::Int8:
        return integerRange<qint8>();
    case QPlcSignalType::Int16:
        return integerRange<qint16>();
    case QPlcSignalType::Int32:
        return integerRange<qint32>();
    case QPlcSignalType::UInt8:
        return integerRange<quint8>();
    case QPlcSignalType::UInt16:
        return integerRange<quint16>();
    case QPlcSignalType::UInt32:
        return integerRange<quint32>();
    case QPlcSignalType::UInt64:
        return {0, std::numeric_limits<qint64>::max()};
    default:
        return integerRange<qint64>();
    }
}

}  // namespace

FmuPort::FmuPort(QPlcCompactSlaveNode *node, const QString &signal, Direction direction, int version,
                 FmuExchange *exchange)
    : QPlcPort(node, signal.toUtf8().constData(), direction)
    , m_version(version)
    , m_exchange(exchange)
{
}

FmuPort::~FmuPort()
{
    leaveNode();
}

bool FmuPort::add(const Wire &wire, bool isArray)
{
    const bool isTaken
        = std::any_of(m_wires.begin(), m_wires.end(), [&](const Wire &other) { return other.element == wire.element; });
    if (!m_wires.empty() && (isArray != m_isArray || (isTaken && !isInput())))
        return false;
    m_isArray = isArray;
    m_wires.push_back(wire);
    m_count = std::max(m_count, wire.element + 1);
    m_exchange->add(*wire.number.variable);
    return true;
}

QString FmuPort::missingElements() const
{
    QStringList names;
    for (int i = 0; i < m_count; ++i) {
        const auto isOfElement = [i](const Wire &wire) { return wire.element == i; };
        if (std::none_of(m_wires.begin(), m_wires.end(), isOfElement))
            names << elementName(i);
    }
    return names.join(QStringLiteral(", "));
}

QString FmuPort::elementName(int element) const
{
    return m_isArray ? QStringLiteral("%1[%2]").arg(name()).arg(element) : name();
}

QString FmuPort::variableType() const
{
    const FmuVariable &variable = *m_wires.front().number.variable;
    const QString type = variable.typeText(m_version);
    if (m_isArray && variable.count == 1)
        return QStringLiteral("%1 numbers of the type %2 (variable '%3', ...)").arg(m_count).arg(type, variable.name);
    return QStringLiteral("%1 (variable '%2')").arg(type, variable.name);
}

/// What the FMU reads may leave elements out, what it writes may not.
bool FmuPort::accepts(QPlcSignalType type) const
{
    const bool hasShape
        = m_isArray ? (isInput() ? type.count() >= m_count : type.count() == m_count) : type.count() == 1;
    return type.isNumeric() && hasShape
        && std::all_of(m_wires.begin(), m_wires.end(), [&](const Wire &wire) { return accepts(wire, type.scalar()); });
}

bool FmuPort::accepts(const Wire &wire, QPlcSignalType::Scalar scalar) const
{
    const QPlcSignalType type(scalar);
    const FmuVariable &variable = *wire.number.variable;
    if (isReal(variable))
        return isInput() || type.isReal();
    if (wire.isConverted() || type.isReal())
        return !isInput() && type.isReal();
    return variable.kind == FmuVariable::Boolean || variable.isEnumeration
        || QPlcPortDetail::fits(variable.scalar(m_version), false, scalar, direction());
}

void FmuPort::attach(QPlcSignalType type)
{
    m_scalar = type.scalar();
    m_moves.clear();
    const auto size = std::size_t(type.elementSize());
    bool isPlain = int(m_wires.size()) == type.count();
    for (const Wire &wire : m_wires) {
        const FmuVariable &variable = *wire.number.variable;
        Move move;
        move.variable = &variable;
        move.scalar = variable.scalar(m_version);
        move.number = m_exchange->at(m_exchange->add(variable))
            + wire.number.element * QPlcSignalType(move.scalar).elementSize();
        move.offset = std::size_t(wire.element) * size;
        move.factor = wire.factor;
        move.added = wire.offset;
        move.isBoolean = variable.kind == FmuVariable::Boolean;
        const bool isSame = move.scalar == m_scalar && !move.isBoolean && !wire.isConverted();
        move.way = isSame ? Move::Copy : !isReal(variable) && type.isInteger() ? Move::Whole : Move::Real;
        move.isChecked = variable.isEnumeration;
        isPlain = isPlain && isSame
            && (m_moves.empty()
                || (move.number == m_moves.back().number + size && move.offset == m_moves.back().offset + size));
        m_moves.push_back(move);
    }
    m_plain = isPlain && m_moves.front().offset == 0 ? m_moves.front().number : nullptr;
}

void FmuPort::load(const char *bytes)
{
    for (const Move &move : m_moves)
        carry(move, m_scalar, bytes + move.offset, move.scalar, move.number);
}

void FmuPort::store(char *bytes) const
{
    for (const Move &move : m_moves)
        carry(move, move.scalar, move.number, m_scalar, bytes + move.offset);
}

/// One number between a signal and the FMU, in either direction.
void FmuPort::carry(const Move &move, QPlcSignalType::Scalar fromScalar, const char *from,
                    QPlcSignalType::Scalar toScalar, char *to) const
{
    if (move.way == Move::Copy) {
        std::memcpy(to, from, std::size_t(QPlcSignalType(toScalar).elementSize()));
    } else if (move.way == Move::Whole) {
        qint64 value = 0;
        QPlcPortDetail::loadElements(fromScalar, from, &value, 1);
        value = move.isBoolean ? qint64(value != 0) : value;
        check(move, value, toScalar);
        QPlcPortDetail::storeElements(toScalar, to, &value, 1);
    } else {
        double value = 0.0;
        QPlcPortDetail::loadElements(fromScalar, from, &value, 1);
        value = move.converted(value);
        QPlcPortDetail::storeElements(toScalar, to, &value, 1);
    }
}

void FmuPort::check(const Move &move, qint64 value, QPlcSignalType::Scalar scalar) const
{
    if (!move.isChecked)
        return;
    const IntegerRange range = integerRange(scalar);
    if (value < range.minimum || value > range.maximum)
        throw std::runtime_error(QStringLiteral("the value %1 does not fit between variable '%2' and signal '%3' (%4)")
                                     .arg(value)
                                     .arg(move.variable->name, name(), QPlcSignalType(m_scalar).name())
                                     .toStdString());
}

}  // namespace qplc
