// SPDX-License-Identifier: Apache-2.0
#include "PlantMessage.h"

#include "protocol/LittleEndian.h"

#include <QtCore/QSet>

#include <cstring>

namespace qplc {

namespace {

constexpr int LengthSize = 4;       // of a text in a message
constexpr int ImageLengthSize = 2;  // of a text in the image

const char *rosType(QPlcSignalType type)
{
    switch (type.scalar()) {
    case QPlcSignalType::Int8:
        return "int8";
    case QPlcSignalType::Int16:
        return "int16";
    case QPlcSignalType::Int32:
        return "int32";
    case QPlcSignalType::Int64:
    case QPlcSignalType::DateTime:
        return "int64";
    case QPlcSignalType::UInt8:
        return "uint8";
    case QPlcSignalType::UInt16:
        return "uint16";
    case QPlcSignalType::UInt32:
        return "uint32";
    case QPlcSignalType::UInt64:
        return "uint64";
    case QPlcSignalType::Real32:
        return "float32";
    case QPlcSignalType::Real64:
        return "float64";
    default:
        return "string";
    }
}

QByteArray comment(const QPlcSignalDefinition &signal)
{
    QStringList parts{signal.name};
    if (!signal.unit.isEmpty())
        parts << QStringLiteral("[%1]").arg(signal.unit);
    if (!signal.description.isEmpty())
        parts << signal.description.simplified();
    return "  # " + parts.join(QLatin1Char(' ')).toUtf8();
}

}  // namespace

QByteArray rosFieldName(const QString &name, QSet<QByteArray> *used)
{
    QByteArray field;
    for (const QChar sign : name) {
        const bool isAllowed = sign.unicode() < 128 && (sign.isLetterOrNumber() || sign == QLatin1Char('_'));
        field += isAllowed ? sign.toLatin1() : '_';
    }
    if (field.isEmpty() || !QChar::fromLatin1(field.at(0)).isLetter())
        field.prepend("s_");
    QByteArray unique = field;
    for (int i = 2; used->contains(unique); ++i)
        unique = field + '_' + QByteArray::number(i);
    used->insert(unique);
    return unique;
}

PlantMessage::PlantMessage(const QPlcSignalTable &table)
    : m_image(table)
{
    for (const QPlcSignalDefinition &signal : table)
        m_hasTexts = m_hasTexts || signal.type.isString();
}

QByteArray PlantMessage::schema() const
{
    QByteArray text = "# The signals of a plant at the end of a cycle, in the order of the signal table.\n"
                      "qtplc/Cycle cycle\n";
    QSet<QByteArray> used{"cycle", "quality"};
    for (const QPlcSignalDefinition &signal : table()) {
        text += rosType(signal.type);
        if (signal.type.isArray())
            text += '[' + QByteArray::number(signal.type.count()) + ']';
        text += ' ' + rosFieldName(signal.name, &used) + comment(signal) + '\n';
    }
    if (!table().isEmpty())
        text += "uint8[" + QByteArray::number(table().size())
            + "] quality  # 0 Good, 1 to 252 Held for so many cycles, 253 Safe, 254 Invalid\n";
    return text
        + "================================================================================\n"
          "MSG: qtplc/Cycle\n"
          "uint64 number    # of the cycle, from 0 in each phase\n"
          "int64 lateness   # [ns] of its begin\n"
          "uint64 skipped   # cycles that were left out right before it\n"
          "uint32 flags     # 1 safe stop, 2 caught up, 4 nodes or leases have changed, 8 timed, 16 answers missing,\n"
          "                 # 32 signals were set\n";
}

void PlantMessage::encode(const Cycle &cycle, const char *image, QByteArray *message) const
{
    const auto qualities = std::uint32_t(table().size());
    message->resize(int(CycleSize + m_image.size() + qualities + (m_hasTexts ? 2 * qualities : 0)));
    char *to = message->data();
    storeLittle(cycle.number, to);
    storeLittle(cycle.lateness, to + 8);
    storeLittle(cycle.skipped, to + 16);
    storeLittle(cycle.flags, to + 24);
    to += CycleSize;
    if (!m_hasTexts) {
        std::memcpy(to, image, m_image.size());
        to += m_image.size();
    }
    for (QPlcSignalIndex i = 0; m_hasTexts && i < QPlcSignalIndex(table().size()); ++i) {
        const QPlcSignalType type = table().at(i).type;
        const char *value = image + m_image.offset(i);
        if (!type.isString()) {
            std::memcpy(to, value, std::size_t(type.size()));
            to += type.size();
            continue;
        }
        const int length = std::min<int>(loadLittle<std::uint16_t>(value), type.capacity());
        storeLittle(std::uint32_t(length), to);
        std::memcpy(to + LengthSize, value + ImageLengthSize, std::size_t(length));
        to += LengthSize + length;
    }
    std::memcpy(to, image + m_image.totalSize() - qualities, qualities);
    message->truncate(int(to + qualities - message->data()));
}

PlantMessage::Cycle PlantMessage::cycleOf(const char *message)
{
    return {loadLittle<std::uint64_t>(message), loadLittle<std::int64_t>(message + 8),
            loadLittle<std::uint64_t>(message + 16), loadLittle<std::uint32_t>(message + 24)};
}

bool PlantMessage::locate(const char *message, std::size_t size, std::vector<std::uint32_t> *offsets) const
{
    const auto qualities = std::size_t(table().size());
    offsets->clear();
    std::size_t at = CycleSize;
    for (const QPlcSignalDefinition &signal : table()) {
        offsets->push_back(std::uint32_t(at));
        if (!signal.type.isString()) {
            at += std::size_t(signal.type.size());
            continue;
        }
        if (size < LengthSize || at > size - LengthSize)
            return false;
        const auto length = loadLittle<std::uint32_t>(message + at);
        if (length > std::uint32_t(signal.type.capacity()))
            return false;
        at += LengthSize + length;
    }
    return at + qualities == size;
}

std::optional<PlantMessage::Cycle> PlantMessage::decode(const char *message, std::size_t size)
{
    const char *at = message;
    std::size_t left = size;
    const auto take = [&](std::size_t bytes) {
        const char *from = bytes <= left ? at : nullptr;
        if (from) {
            at += bytes;
            left -= bytes;
        }
        return from;
    };
    const char *head = take(CycleSize);
    if (!head)
        return std::nullopt;
    const Cycle cycle = cycleOf(head);
    for (QPlcSignalIndex i = 0; i < QPlcSignalIndex(table().size()); ++i) {
        const QPlcSignalType type = table().at(i).type;
        char *value = m_image.data() + m_image.offset(i);
        const char *length = type.isString() ? take(LengthSize) : nullptr;
        const std::size_t bytes
            = type.isString() ? (length ? loadLittle<std::uint32_t>(length) : 0) : std::size_t(type.size());
        const char *from = type.isString() && (!length || bytes > std::size_t(type.capacity())) ? nullptr : take(bytes);
        if (!from)
            return std::nullopt;
        if (!type.isString()) {
            std::memcpy(value, from, bytes);
            continue;
        }
        std::memset(value, 0, std::size_t(type.size()));
        storeLittle(std::uint16_t(bytes), value);
        std::memcpy(value + ImageLengthSize, from, bytes);
    }
    const auto qualities = std::size_t(table().size());
    const char *from = take(qualities);
    if (!from || left != 0)
        return std::nullopt;
    std::memcpy(m_image.data() + m_image.totalSize() - qualities, from, qualities);
    return cycle;
}

}  // namespace qplc
