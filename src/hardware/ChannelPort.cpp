// SPDX-License-Identifier: Apache-2.0
#include "ChannelPort.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qplc {

namespace {

/// Numbers that an element of the type can hold, as doubles.
struct Range
{
    double minimum;
    double maximum;  // of 64 bits: the first number above
};

template<typename Integer>
constexpr Range rangeOf()
{
    return {double(std::numeric_limits<Integer>::min()), double(std::numeric_limits<Integer>::max())};
}

Range rangeOf(QPlcSignalType::Scalar scalar)
{
    switch (scalar) {
    case QPlcSignalType::Int8:
        return rangeOf<qint8>();
    case QPlcSignalType::Int16:
        return rangeOf<qint16>();
    case QPlcSignalType::Int32:
        return rangeOf<qint32>();
    case QPlcSignalType::UInt8:
        return rangeOf<quint8>();
    case QPlcSignalType::UInt16:
        return rangeOf<quint16>();
    case QPlcSignalType::UInt32:
        return rangeOf<quint32>();
    case QPlcSignalType::Int64:
        return {-9.2e18, 9.2e18};  // what a double tells apart from 2^63
    case QPlcSignalType::UInt64:
        return {0.0, 1.8e19};
    default:
        return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    }
}

bool fits(double value, QPlcSignalType type)
{
    if (type.isReal())
        return std::isfinite(value);
    const Range range = rangeOf(type.scalar());
    const double rounded = std::nearbyint(value);
    return rounded >= range.minimum && rounded <= range.maximum;
}

}  // namespace

ChannelPort::ChannelPort(QPlcCompactSlaveNode *node, const QString &signal, Direction direction)
    : QPlcPort(node, signal.toUtf8().constData(), direction)
{
}

ChannelPort::~ChannelPort()
{
    leaveNode();
}

bool ChannelPort::add(int index, Wire wire)
{
    const bool isArray = index >= 0;
    wire.element = std::size_t(std::max(index, 0));
    if (!m_wires.empty() && (isArray != m_isArray || (!isInput() && isWired(wire.element))))
        return false;
    m_isArray = isArray;
    m_wires.push_back(wire);
    m_values.resize(std::max(m_values.size(), wire.element + 1));
    return true;
}

bool ChannelPort::isWired(std::size_t element) const
{
    return std::any_of(m_wires.begin(), m_wires.end(), [element](const Wire &wire) { return wire.element == element; });
}

QString ChannelPort::elementName(std::size_t index) const
{
    return m_isArray ? QStringLiteral("%1[%2]").arg(name()).arg(index) : name();
}

QString ChannelPort::missingElements() const
{
    QStringList names;
    for (std::size_t i = 0; i < m_values.size(); ++i) {
        if (!isWired(i))
            names << elementName(i);
    }
    return names.join(QStringLiteral(", "));
}

QString ChannelPort::variableType() const
{
    return m_isArray ? QStringLiteral("%1 numbers").arg(m_values.size()) : QStringLiteral("a number");
}

/// What is written to devices may leave elements out, what is read from them may not.
bool ChannelPort::accepts(QPlcSignalType type) const
{
    const auto count = std::size_t(type.count());
    return type.isNumeric() && (m_isArray ? type.isArray() : count == 1)
        && (isInput() ? count >= m_values.size() : count == m_values.size());
}

// ---- to the devices ----

void ChannelPort::load(const char *bytes)
{
    QPlcPortDetail::loadElements(m_type.scalar(), bytes, m_values.data(), int(m_values.size()));
    pass(false);
}

void ChannelPort::setSafe(const QPlcValue &value) noexcept
{
    for (std::size_t i = 0; i < m_values.size(); ++i)
        m_values[i] = value.toReal(int(i));
    pass(true);
}

void ChannelPort::pass(bool isSafe) noexcept
{
    for (const Wire &wire : m_wires)
        wire.runner->setValue(wire.channel, m_values[wire.element] * wire.factor + wire.offset, isSafe);
}

// ---- from the devices ----

void ChannelPort::refresh(qint64 now) noexcept
{
    bool isGood = true;
    for (const Wire &wire : m_wires) {
        const DriverRunner::Sample sample = wire.runner->sample(wire.channel, now);
        const double value = sample.value * wire.factor + wire.offset;
        isGood = isGood && sample.isFresh && fits(value, m_type);
        if (isGood)
            m_values[wire.element] = m_type.isReal() ? value : std::nearbyint(value);
    }
    giveQuality(isGood ? QPlcQuality::Good : QPlcQuality::Invalid);
}

void ChannelPort::store(char *bytes) const
{
    QPlcPortDetail::storeElements(m_type.scalar(), bytes, m_values.data(), int(m_values.size()));
}

}  // namespace qplc
