// SPDX-License-Identifier: Apache-2.0
#include "SealFields.h"

#include "QPlcMessage.h"

namespace qplc {

namespace {

QByteArray bytesOf(const SealKey &key)
{
    return {key.data(), int(SealKey::Size)};
}

}  // namespace

messages::Seal sealOf(const SealKeys &keys)
{
    return {bytesOf(keys.inputs), bytesOf(keys.outputs)};
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
