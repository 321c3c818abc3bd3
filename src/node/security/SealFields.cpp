// SPDX-License-Identifier: Apache-2.0
#include "SealFields.h"

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

std::optional<SealKeys> sealKeys(const messages::Seal &seal)
{
    if (seal.inputs.size() != int(SealKey::Size) || seal.outputs.size() != int(SealKey::Size))
        return std::nullopt;
    return SealKeys{SealKey(seal.inputs.constData()), SealKey(seal.outputs.constData())};
}

}  // namespace qplc
