// SPDX-License-Identifier: Apache-2.0
#include "ZipFile.h"

#include <QtCore/qendian.h>

namespace qplc_export {

namespace {

constexpr quint16 version = 20;   // 2.0: deflate
constexpr quint16 deflated = 8;   // method
constexpr quint16 date = 0x2821;  // 1 January 2000, midnight
constexpr quint32 mode = 0100644u << 16;

template<typename T>
void append(QByteArray *bytes, T number)
{
    char packed[sizeof(T)];
    qToLittleEndian<T>(number, packed);
    bytes->append(packed, int(sizeof(T)));
}

/// CRC-32 of ISO 3309, bit by bit: a library of some megabytes takes some hundredths of a second.
quint32 checksum(const QByteArray &content)
{
    quint32 crc = 0xFFFFFFFF;
    for (const char byte : content) {
        crc ^= quint8(byte);
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc >> 1) ^ ((crc & 1) ? 0xEDB88320 : 0);
    }
    return ~crc;
}

/// Without the size, header and checksum that qCompress() puts around.
QByteArray compress(const QByteArray &content)
{
    const QByteArray framed = qCompress(content, 9);
    return framed.mid(4 + 2, framed.size() - 4 - 2 - 4);
}

}  // namespace

void ZipFile::add(const QByteArray &name, const QByteArray &content)
{
    const QByteArray packed = compress(content);
    QByteArray facts;  // what both headers have
    append<quint16>(&facts, version);
    append<quint16>(&facts, 0);  // flags
    append<quint16>(&facts, deflated);
    append<quint16>(&facts, 0);  // time
    append<quint16>(&facts, date);
    append<quint32>(&facts, checksum(content));
    append<quint32>(&facts, quint32(packed.size()));
    append<quint32>(&facts, quint32(content.size()));
    append<quint16>(&facts, quint16(name.size()));
    append<quint16>(&facts, 0);  // further fields
    append<quint32>(&m_directory, 0x02014B50);
    append<quint16>(&m_directory, version | 3 << 8);  // made by Unix
    m_directory += facts;
    append<quint16>(&m_directory, 0);  // comment
    append<quint16>(&m_directory, 0);  // disk
    append<quint16>(&m_directory, 0);  // kind
    append<quint32>(&m_directory, mode);
    append<quint32>(&m_directory, quint32(m_entries.size()));
    m_directory += name;
    append<quint32>(&m_entries, 0x04034B50);
    m_entries += facts + name + packed;
    ++m_count;
}

QByteArray ZipFile::bytes() const
{
    QByteArray end;
    append<quint32>(&end, 0x06054B50);
    append<quint32>(&end, 0);  // disks
    append<quint16>(&end, m_count);
    append<quint16>(&end, m_count);
    append<quint32>(&end, quint32(m_directory.size()));
    append<quint32>(&end, quint32(m_entries.size()));
    append<quint16>(&end, 0);  // comment
    return m_entries + m_directory + end;
}

}  // namespace qplc_export
