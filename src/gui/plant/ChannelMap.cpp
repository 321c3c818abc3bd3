// SPDX-License-Identifier: Apache-2.0
#include "ChannelMap.h"

#include <QtCore/QtEndian>

namespace qplc {

namespace {

template<typename T>
void convert(const char *from, float *to, int count)
{
    for (int i = 0; i < count; ++i)
        to[i] = float(qFromLittleEndian<T>(from + std::size_t(i) * sizeof(T)));
}

}  // namespace

ChannelMap::ChannelMap(const QPlcSignalTable &table)
{
    m_signals.reserve(table.size());
    for (const QPlcSignalDefinition &definition : table) {
        const QPlcSignalType type = definition.type;
        if (type.isNumeric()) {
            m_signals.append({m_payloadSize, m_channels, type.count()});
            addRun({type.scalar(), m_payloadSize, m_channels, type.count()}, type.elementSize());
            m_channels += type.count();
        } else {
            m_signals.append({m_payloadSize, NoChannel, 0});
        }
        m_payloadSize += type.size();
    }
}

void ChannelMap::addRun(const Run &run, int elementSize)
{
    if (!m_runs.isEmpty()) {
        Run &last = m_runs.last();
        if (last.scalar == run.scalar && last.offset + last.count * elementSize == run.offset) {
            last.count += run.count;
            return;
        }
    }
    m_runs.append(run);
}

int ChannelMap::channel(QPlcSignalIndex signal, int element) const
{
    if (signal >= m_signals.size() || element < 0 || element >= m_signals.at(signal).count)
        return NoChannel;
    return m_signals.at(signal).channel + element;
}

void ChannelMap::toFloats(const char *payload, float *values) const
{
    for (const Run &run : m_runs) {
        const char *from = payload + run.offset;
        float *to = values + run.channel;
        switch (run.scalar) {
        case QPlcSignalType::Int8:
            convert<qint8>(from, to, run.count);
            break;
        case QPlcSignalType::Int16:
            convert<qint16>(from, to, run.count);
            break;
        case QPlcSignalType::Int32:
            convert<qint32>(from, to, run.count);
            break;
        case QPlcSignalType::Int64:
            convert<qint64>(from, to, run.count);
            break;
        case QPlcSignalType::UInt8:
            convert<quint8>(from, to, run.count);
            break;
        case QPlcSignalType::UInt16:
            convert<quint16>(from, to, run.count);
            break;
        case QPlcSignalType::UInt32:
            convert<quint32>(from, to, run.count);
            break;
        case QPlcSignalType::UInt64:
            convert<quint64>(from, to, run.count);
            break;
        case QPlcSignalType::Real32:
            convert<float>(from, to, run.count);
            break;
        case QPlcSignalType::Real64:
            convert<double>(from, to, run.count);
            break;
        case QPlcSignalType::Invalid:
        case QPlcSignalType::String:
        case QPlcSignalType::DateTime:
            break;
        }
    }
}

}  // namespace qplc
