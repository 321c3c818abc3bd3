// SPDX-License-Identifier: Apache-2.0
#include "PayloadLayout.h"

#include <QtCore/qendian.h>

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

}  // namespace

PayloadLayout::PayloadLayout(const QPlcSignalTable &table, const QVector<QPlcSignalIndex> &signalIndices)
{
    m_fields.reserve(std::size_t(signalIndices.size()));
    for (const QPlcSignalIndex index : signalIndices) {
        const QPlcSignalDefinition &signal = table.at(index);
        m_fields.push_back({index, m_size, signal.type});
        addRealRun(m_fields.back());
        const QString text = signal.name + QLatin1Char(':') + signal.type.name() + QLatin1Char('@')
            + QString::number(m_size) + QLatin1Char('\n');
        m_hash = fnv1a64(text.toUtf8(), m_hash);
        m_size += quint32(signal.type.size());
    }
}

void PayloadLayout::addRealRun(const Field &field)
{
    if (!field.type.isReal())
        return;
    const RealRun run{field.type.scalar(), field.offset, quint32(field.type.size())};
    if (!m_realRuns.empty()) {
        RealRun &last = m_realRuns.back();
        if (last.scalar == run.scalar && last.offset + last.size == run.offset) {
            last.size += run.size;
            return;
        }
    }
    m_realRuns.push_back(run);
}

bool PayloadLayout::isFinite(QPlcSignalType::Scalar scalar, const char *bytes, quint32 size) noexcept
{
    return scalar == QPlcSignalType::Real32 ? allFinite<quint32>(bytes, size, 0x7f800000u)
                                            : allFinite<quint64>(bytes, size, 0x7ff0000000000000u);
}

const PayloadLayout::Field *PayloadLayout::firstNotFiniteField(const char *payload) const noexcept
{
    for (const Field &field : m_fields) {
        if (field.type.isReal() && !isFinite(field.type.scalar(), payload + field.offset, quint32(field.type.size())))
            return &field;
    }
    return nullptr;
}

std::vector<quint32> PayloadLayout::partBorders(quint32 maximum) const
{
    std::vector<quint32> borders = {0};
    for (const Field &field : m_fields) {
        const bool fits = field.offset + quint32(field.type.size()) - borders.back() <= maximum;
        if (!fits && field.offset > borders.back())
            borders.push_back(field.offset);
    }
    borders.push_back(m_size);
    return borders;
}

}  // namespace qplc
