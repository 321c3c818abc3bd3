// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/CyclicFrame.h"

#include <QtCore/QFile>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>

#include <optional>
#include <random>
#include <vector>

/// The byte vectors of docs/protocol, which were made by another implementation. Tests read them
/// and never write them.
namespace vectors {

inline QByteArray document(const QString &path)
{
    QFile file(QStringLiteral(PROTOCOL_DOCUMENTS "/") + path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

/// Empty when the file is missing or no JSON.
inline QJsonObject file(const QString &name)
{
    return QJsonDocument::fromJson(document(QStringLiteral("protocol/vectors/") + name)).object();
}

inline QByteArray bytes(const QJsonValue &hex)
{
    return QByteArray::fromHex(hex.toString().toLatin1());
}

inline quint64 number(const QJsonValue &hex)
{
    return hex.toString().toULongLong(nullptr, 16);
}

inline qplc::FrameKind kindOf(const QString &name)
{
    if (name == QLatin1String("Inputs"))
        return qplc::FrameKind::Inputs;
    return name == QLatin1String("GroupInputs") ? qplc::FrameKind::GroupInputs : qplc::FrameKind::Outputs;
}

/// One direction of one node.
struct Channel
{
    explicit Channel(const QJsonValue &json)
        : kind(kindOf(json[QStringLiteral("kind")].toString()))
    {
        seed.session = number(json[QStringLiteral("session")]);
        seed.node = std::uint16_t(json[QStringLiteral("node")].toInt());
        seed.layoutHash = number(json[QStringLiteral("layoutHash")]);
        for (const QJsonValue border : json[QStringLiteral("borders")].toArray())
            borders.push_back(std::uint32_t(border.toInt()));
        if (const QByteArray bytes = vectors::bytes(json[QStringLiteral("key")]); !bytes.isEmpty())
            key.emplace(bytes.constData());
    }

    qplc::FrameEncoder encoder() const { return qplc::FrameEncoder(kind, seed, borders, key ? &*key : nullptr); }
    qplc::FrameDecoder decoder() const { return qplc::FrameDecoder(kind, seed, borders, key ? &*key : nullptr); }
    QByteArray payload(const qplc::FrameDecoder &decoder) const
    {
        return QByteArray(decoder.payload(), int(borders.back()));
    }

    qplc::FrameKind kind;
    qplc::FrameSeed seed;
    std::vector<std::uint32_t> borders;
    std::optional<qplc::SealKey> key;  // none: the frames are not sealed
};

inline QString name(qplc::FrameStatus status)
{
    const char *const names[] = {"Complete",     "Incomplete",   "Duplicate",     "Old",    "WrongLength",
                                 "WrongVersion", "WrongSession", "WrongChecksum", "Forged", "Early"};
    return QString::fromLatin1(names[std::size_t(status)]);
}

inline bool isRefused(qplc::FrameStatus status)
{
    return status >= qplc::FrameStatus::WrongLength;
}

inline qplc::FrameStatus decode(qplc::FrameDecoder &decoder, const QByteArray &frame)
{
    return decoder.decode(frame.constData(), std::size_t(frame.size()));
}

inline QByteArray encode(const qplc::FrameEncoder &encoder, std::size_t part, const qplc::FrameHeader &header,
                         const QByteArray &payload)
{
    QByteArray frame(int(encoder.partSize(part)), '\0');
    encoder.encode(part, header, payload.constData(), frame.data());
    return frame;
}

/// The same bytes on every machine, unlike those of std::uniform_int_distribution.
inline QByteArray randomBytes(std::mt19937 &random, int size)
{
    QByteArray result(size, '\0');
    for (char &byte : result)
        byte = char(random() >> 24);
    return result;
}

}  // namespace vectors
