// SPDX-License-Identifier: Apache-2.0
#include "SealFields.h"

#include "QPlcMessage.h"

namespace qplc {

namespace {

QString textOf(const SealKey &key)
{
    return QPlcMessage::fromBytes(QByteArray::fromRawData(key.data(), int(SealKey::Size)));
}

}  // namespace

QJsonObject sealFields(const SealKeys &keys)
{
    return {{QStringLiteral("inputs"), textOf(keys.inputs)}, {QStringLiteral("outputs"), textOf(keys.outputs)}};
}

std::optional<SealKeys> sealKeys(const QJsonObject &fields)
{
    const QPlcMessage message(QPlcMessage::Registered, fields);
    const QByteArray inputs = message.bytes(QStringLiteral("inputs"));
    const QByteArray outputs = message.bytes(QStringLiteral("outputs"));
    if (inputs.size() != int(SealKey::Size) || outputs.size() != int(SealKey::Size))
        return std::nullopt;
    return SealKeys{SealKey(inputs.constData()), SealKey(outputs.constData())};
}

}  // namespace qplc
