// SPDX-License-Identifier: Apache-2.0
#include "QPlcCompactSignal.h"

#include <stdexcept>

QPlcCompactSignal::QPlcCompactSignal(const char *name, Direction direction, QPlcCompactSlaveNode *node,
                                     QPlcInputTiming::Value timing)
    : QPlcPort(node, name, direction, timing)
{
}

QPlcCompactSignal::~QPlcCompactSignal()
{
    leaveNode();
}

QString QPlcCompactSignal::variableType() const
{
    return QStringLiteral("any type");
}

bool QPlcCompactSignal::accepts(QPlcSignalType) const
{
    return true;
}

void QPlcCompactSignal::attach(QPlcSignalType type)
{
    m_type = type;
    if (!m_value.isValid())
        m_value = QPlcValue(type);
}

void QPlcCompactSignal::load(const char *bytes)
{
    m_value = QPlcValue::fromBytes(m_type, bytes);
}

void QPlcCompactSignal::store(char *bytes) const
{
    if (m_value.type() == m_type) {
        m_value.toBytes(bytes);
        return;
    }
    const QPlcValue converted = m_value.convertedTo(m_type);
    if (!converted.isValid()) {
        const QString text = QStringLiteral("the value %1 (%2) does not fit signal '%3' of type %4")
                                 .arg(m_value.toString(), m_value.type().name(), name(), m_type.name());
        throw std::runtime_error(text.toStdString());
    }
    converted.toBytes(bytes);
}
