// SPDX-License-Identifier: Apache-2.0
#include "QPlcPort.h"

#include "QPlcCompactSlaveNode.h"

#include <QtCore/qendian.h>

QPlcPort::QPlcPort(QPlcCompactSlaveNode *node, const char *name, Direction direction, QPlcInputTiming::Value timing)
    : m_node(node)
    , m_name(QString::fromUtf8(name))
    , m_direction(direction)
    , m_timing(timing)
{
    if (direction == Output)
        m_quality = &m_given;
    m_node->add(this);
}

QPlcPort::~QPlcPort()
{
    leaveNode();
}

void QPlcPort::leaveNode()
{
    if (m_node)
        m_node->remove(this);
    m_node = nullptr;
}

namespace QPlcPortDetail {

namespace {

template<typename Wire, typename Element>
void loadAs(const char *bytes, Element *elements, int count)
{
    for (int i = 0; i < count; ++i)
        elements[i] = static_cast<Element>(qFromLittleEndian<Wire>(bytes + sizeof(Wire) * i));
}

template<typename Wire, typename Element>
void storeAs(char *bytes, const Element *elements, int count)
{
    for (int i = 0; i < count; ++i)
        qToLittleEndian<Wire>(static_cast<Wire>(elements[i]), bytes + sizeof(Wire) * i);
}

bool isSigned(QPlcSignalType::Scalar scalar)
{
    return scalar >= QPlcSignalType::Int8 && scalar <= QPlcSignalType::Int64;
}

}  // namespace

template<typename Element>
void loadElements(QPlcSignalType::Scalar scalar, const char *bytes, Element *elements, int count)
{
    switch (scalar) {
    case QPlcSignalType::Int8:
        loadAs<qint8>(bytes, elements, count);
        break;
    case QPlcSignalType::Int16:
        loadAs<qint16>(bytes, elements, count);
        break;
    case QPlcSignalType::Int32:
        loadAs<qint32>(bytes, elements, count);
        break;
    case QPlcSignalType::DateTime:
    case QPlcSignalType::Int64:
        loadAs<qint64>(bytes, elements, count);
        break;
    case QPlcSignalType::UInt8:
        loadAs<quint8>(bytes, elements, count);
        break;
    case QPlcSignalType::UInt16:
        loadAs<quint16>(bytes, elements, count);
        break;
    case QPlcSignalType::UInt32:
        loadAs<quint32>(bytes, elements, count);
        break;
    case QPlcSignalType::UInt64:
        loadAs<quint64>(bytes, elements, count);
        break;
    case QPlcSignalType::Real32:
        loadAs<float>(bytes, elements, count);
        break;
    case QPlcSignalType::Real64:
        loadAs<double>(bytes, elements, count);
        break;
    case QPlcSignalType::String:
    case QPlcSignalType::Invalid:
        Q_UNREACHABLE();
        break;
    }
}

template<typename Element>
void storeElements(QPlcSignalType::Scalar scalar, char *bytes, const Element *elements, int count)
{
    switch (scalar) {
    case QPlcSignalType::Int8:
        storeAs<qint8>(bytes, elements, count);
        break;
    case QPlcSignalType::Int16:
        storeAs<qint16>(bytes, elements, count);
        break;
    case QPlcSignalType::Int32:
        storeAs<qint32>(bytes, elements, count);
        break;
    case QPlcSignalType::DateTime:
    case QPlcSignalType::Int64:
        storeAs<qint64>(bytes, elements, count);
        break;
    case QPlcSignalType::UInt8:
        storeAs<quint8>(bytes, elements, count);
        break;
    case QPlcSignalType::UInt16:
        storeAs<quint16>(bytes, elements, count);
        break;
    case QPlcSignalType::UInt32:
        storeAs<quint32>(bytes, elements, count);
        break;
    case QPlcSignalType::UInt64:
        storeAs<quint64>(bytes, elements, count);
        break;
    case QPlcSignalType::Real32:
        storeAs<float>(bytes, elements, count);
        break;
    case QPlcSignalType::Real64:
        storeAs<double>(bytes, elements, count);
        break;
    case QPlcSignalType::String:
    case QPlcSignalType::Invalid:
        Q_UNREACHABLE();
        break;
    }
}

#define QPLC_INSTANTIATE(Element)                                                                                      \
    template QTPLC_EXPORT void loadElements<Element>(QPlcSignalType::Scalar, const char *, Element *, int);            \
    template QTPLC_EXPORT void storeElements<Element>(QPlcSignalType::Scalar, char *, const Element *, int);
QPLC_INSTANTIATE(bool)
QPLC_INSTANTIATE(char)
QPLC_INSTANTIATE(signed char)
QPLC_INSTANTIATE(unsigned char)
QPLC_INSTANTIATE(short)
QPLC_INSTANTIATE(unsigned short)
QPLC_INSTANTIATE(int)
QPLC_INSTANTIATE(unsigned int)
QPLC_INSTANTIATE(long)
QPLC_INSTANTIATE(unsigned long)
QPLC_INSTANTIATE(long long)
QPLC_INSTANTIATE(unsigned long long)
QPLC_INSTANTIATE(float)
QPLC_INSTANTIATE(double)
#undef QPLC_INSTANTIATE

bool fits(QPlcSignalType::Scalar variable, bool isBool, QPlcSignalType::Scalar wire, QPlcPort::Direction direction)
{
    const QPlcSignalType variableType(variable);
    const QPlcSignalType wireType(wire);
    if (isBool)
        return wire == QPlcSignalType::Int8 || wire == QPlcSignalType::UInt8;
    if (variableType.isReal())
        return wireType.isReal();
    if (wireType.isDateTime())
        return variable == QPlcSignalType::Int64;
    if (!wireType.isInteger() || isSigned(variable) != isSigned(wire))
        return false;
    return direction == QPlcPort::Input ? variableType.elementSize() >= wireType.elementSize()
                                        : variableType.elementSize() <= wireType.elementSize();
}

QString describe(QPlcSignalType::Scalar scalar, bool isBool, int count)
{
    const QString element = isBool ? QStringLiteral("bool") : QPlcSignalType(scalar).name();
    return count == 1 ? element : QStringLiteral("%1[%2]").arg(element).arg(count);
}

}  // namespace QPlcPortDetail
