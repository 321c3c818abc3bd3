// SPDX-License-Identifier: Apache-2.0
#include "OwnSignals.h"

namespace qplc {

namespace {

bool isDateTime(QPlcSignalType type)
{
    return type.isDateTime();
}

bool isSingleReal(QPlcSignalType type)
{
    return type.isReal() && !type.isArray();
}

bool isSingleNumber(QPlcSignalType type)
{
    return type.isNumeric() && !type.isArray();
}

}  // namespace

OwnSignals::OwnSignals(NodeRegistry &registry, const QPlcSignalTable &table, const Leases &leases,
                       MasterWrites &settings)
    : m_registry(registry)
    , m_table(table)
    , m_leases(leases)
    , m_settings(settings)
{
}

QString OwnSignals::claim(Role role, const QString &name)
{
    return role == Time ? claim(name, &m_signals[role], &isDateTime, QStringLiteral("DateTime"))
                        : claim(name, &m_signals[role], &isSingleReal, QStringLiteral("Real"));
}

QString OwnSignals::claim(const QString &name, QPlcSignalIndex *place, bool (*accepts)(QPlcSignalType),
                          const QString &wantedType)
{
    const QPlcSignalIndex index = m_table.indexOf(name);
    if (index == QPlcInvalidSignalIndex)
        return QStringLiteral("master: %1").arg(m_table.unknownSignalText(name));
    if (!accepts(m_table.at(index).type))
        return QStringLiteral("master: signal '%1' is %2; give it the type %3")
            .arg(name, m_table.at(index).type.name(), wantedType);
    if (const Leases::Lease *lease = m_leases.find(index))
        return QStringLiteral("master: %1").arg(leaseRefusal(name, *lease).text);
    if (*place != QPlcInvalidSignalIndex)
        m_registry.release(*place);
    if (!m_registry.claim(index))
        return QStringLiteral("master: signal '%1' is written by '%2' already").arg(name, m_registry.writer(index));
    *place = index;
    m_settings.leaveToWriters();
    return {};
}

QString OwnSignals::faultOf(QPlcStatisticFigure figure, const QString &signalName, const QString &nodeName)
{
    if (nodeName.isEmpty() ? figure.isOfMaster() : figure.isOfNode())
        return {};
    return nodeName.isEmpty()
        ? QStringLiteral("master: signal '%1': this figure belongs to a node; give its name").arg(signalName)
        : QStringLiteral("master: signal '%1': this figure belongs to the master; leave out '%2'")
              .arg(signalName, nodeName);
}

QString OwnSignals::add(QPlcStatisticFigure figure, const QString &signalName, const QString &nodeName)
{
    QPlcSignalIndex signal = QPlcInvalidSignalIndex;
    const QString fault = figure.isDuration()
        ? claim(signalName, &signal, &isSingleReal, QStringLiteral("Real"))
        : claim(signalName, &signal, &isSingleNumber, QStringLiteral("Real, Int or UInt"));
    if (fault.isEmpty())
        m_statistics.add(figure, signal, nodeName);
    return fault;
}

}  // namespace qplc
