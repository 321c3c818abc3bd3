// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/TabledCrc.h"

#include <QtCore/QByteArray>
#include <QtCore/QMap>

#include <cstdint>

/// The container of recordings, MCAP (https://mcap.dev/spec): records of an opcode, a length and
/// fields, all numbers little-endian. Messages are in chunks, each of which is compressed and has a
/// checksum; a summary at the end tells where the chunks are.
namespace qplc::mcap {

enum Opcode : std::uint8_t {
    HeaderOpcode = 0x01,
    FooterOpcode = 0x02,
    SchemaOpcode = 0x03,
    ChannelOpcode = 0x04,
    MessageOpcode = 0x05,
    ChunkOpcode = 0x06,
    MessageIndexOpcode = 0x07,
    ChunkIndexOpcode = 0x08,
    AttachmentOpcode = 0x09,
    AttachmentIndexOpcode = 0x0a,
    StatisticsOpcode = 0x0b,
    MetadataOpcode = 0x0c,
    MetadataIndexOpcode = 0x0d,
    SummaryOffsetOpcode = 0x0e,
    DataEndOpcode = 0x0f
};

constexpr char Magic[] = "\x89MCAP0\r\n";
constexpr int MagicSize = 8;
constexpr int RecordHeadSize = 9;    // opcode and length
constexpr int MessageHeadSize = 22;  // channel, sequence, two times
constexpr int FooterSize = RecordHeadSize + 20;

/// CRC-32 of zlib. \param crc  of the bytes before
inline std::uint32_t crc32(const char *bytes, std::size_t size, std::uint32_t crc = 0) noexcept
{
    return TabledCrc<0xEDB88320>::of(crc, bytes, size);
}

/// Fields, one behind the other.
class Fields
{
public:
    const QByteArray &bytes() const { return m_bytes; }
    template<typename T>
    Fields &number(T value)
    {
        char little[sizeof value];
        storeLittle(value, little);
        m_bytes.append(little, int(sizeof value));
        return *this;
    }
    Fields &text(const QByteArray &text) { return number(std::uint32_t(text.size())).raw(text); }
    Fields &raw(const QByteArray &bytes)
    {
        m_bytes.append(bytes);
        return *this;
    }
    Fields &texts(const QMap<QByteArray, QByteArray> &map)
    {
        Fields inside;
        for (auto it = map.begin(); it != map.end(); ++it)
            inside.text(it.key()).text(it.value());
        return text(inside.bytes());
    }

private:
    QByteArray m_bytes;
};

/// A record of \a opcode.
inline QByteArray recordOf(Opcode opcode, const QByteArray &fields)
{
    return Fields().number(std::uint8_t(opcode)).number(std::uint64_t(fields.size())).raw(fields).bytes();
}

/// Reads fields; behind the end everything is 0 and empty, and isWhole() is false.
class FieldReader
{
public:
    FieldReader(const char *bytes, std::size_t size)
        : m_at(bytes)
        , m_left(size)
    {
    }

    bool isWhole() const { return m_isWhole; }
    const char *at() const { return m_at; }
    std::size_t left() const { return m_left; }
    template<typename T>
    T number()
    {
        const char *bytes = skip(sizeof(T));
        return bytes ? loadLittle<T>(bytes) : T(0);
    }
    QByteArray bytes(std::uint64_t size)
    {
        const char *bytes = skip(size);
        return bytes ? QByteArray(bytes, int(size)) : QByteArray();
    }
    QByteArray text() { return bytes(number<std::uint32_t>()); }
    QMap<QByteArray, QByteArray> texts()
    {
        const auto size = number<std::uint32_t>();
        const char *inside = skip(size);
        QMap<QByteArray, QByteArray> map;
        FieldReader reader(inside, inside ? size : 0);
        while (reader.left() > 0 && reader.isWhole()) {
            const QByteArray key = reader.text();
            map.insert(key, reader.text());
        }
        m_isWhole = m_isWhole && reader.isWhole();
        return map;
    }
    /// \return null when there are not so many
    const char *skip(std::uint64_t size)
    {
        if (size > m_left) {
            m_isWhole = false;
            m_left = 0;
            return nullptr;
        }
        const char *bytes = m_at;
        m_at += size;
        m_left -= std::size_t(size);
        return bytes;
    }

private:
    const char *m_at;
    std::size_t m_left;
    bool m_isWhole = true;
};

}  // namespace qplc::mcap
