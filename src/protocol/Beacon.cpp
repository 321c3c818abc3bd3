// SPDX-License-Identifier: Apache-2.0
#include "Beacon.h"

#include "Crc32c.h"
#include "LittleEndian.h"
#include "signals/Utf8.h"

#include <cstring>

namespace qplc {

namespace {

constexpr char magic[] = {'Q', 'P', 'L', 'B'};
constexpr quint8 version = 1;
constexpr quint8 secured = 0x01;

constexpr int versionOffset = 4;
constexpr int flagsOffset = 5;
constexpr int portOffset = 6;
constexpr int hashOffset = 8;
constexpr int lengthOffset = 16;
constexpr int nameOffset = 17;
constexpr int checksumSize = 4;

QByteArray nameBytes(const QString &name)
{
    if (name.isEmpty())
        return QByteArrayLiteral("master");
    QByteArray bytes = name.toUtf8().left(Beacon::MaximumName);
    const int invalid = firstInvalidUtf8(bytes.constData(), bytes.size());  // a character that was cut
    return invalid < 0 ? bytes : bytes.left(invalid);
}

quint32 checksum(const char *bytes, int size)
{
    return crc32c(0, bytes, std::size_t(size));
}

}  // namespace

QByteArray Beacon::encoded() const
{
    Q_ASSERT_X(port != 0, "Beacon::encoded", "a master that listens has a port");
    const QByteArray text = nameBytes(name);
    const int end = nameOffset + text.size();
    char data[nameOffset + MaximumName + checksumSize];
    std::memcpy(data, magic, sizeof magic);
    storeLittle<quint8>(version, data + versionOffset);
    storeLittle<quint8>(isSecured ? secured : 0, data + flagsOffset);
    storeLittle<quint16>(port, data + portOffset);
    storeLittle<quint64>(tableHash, data + hashOffset);
    storeLittle<quint8>(quint8(text.size()), data + lengthOffset);
    std::memcpy(data + nameOffset, text.constData(), std::size_t(text.size()));
    storeLittle<quint32>(checksum(data, end), data + end);
    return QByteArray(data, end + checksumSize);
}

std::optional<Beacon> Beacon::decode(const char *bytes, int size)
{
    if (size <= nameOffset + checksumSize || std::memcmp(bytes, magic, sizeof magic) != 0
        || loadLittle<quint8>(bytes + versionOffset) != version)
        return {};
    const quint8 flags = loadLittle<quint8>(bytes + flagsOffset);
    const int nameSize = loadLittle<quint8>(bytes + lengthOffset);
    const int end = nameOffset + nameSize;
    if ((flags & ~secured) != 0 || nameSize < 1 || nameSize > MaximumName || size != end + checksumSize
        || loadLittle<quint32>(bytes + end) != checksum(bytes, end)
        || firstInvalidUtf8(bytes + nameOffset, nameSize) >= 0)
        return {};
    Beacon beacon;
    beacon.port = loadLittle<quint16>(bytes + portOffset);
    beacon.isSecured = (flags & secured) != 0;
    beacon.tableHash = loadLittle<quint64>(bytes + hashOffset);
    beacon.name = QString::fromUtf8(bytes + nameOffset, nameSize);
    if (beacon.port == 0)
        return {};
    return beacon;
}

}  // namespace qplc
