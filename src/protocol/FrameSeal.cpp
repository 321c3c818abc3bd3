// SPDX-License-Identifier: Apache-2.0
#include "FrameSeal.h"

#include "CyclicFrame.h"
#include "LittleEndian.h"

#include <cstring>
#include <sodium.h>

namespace qplc {

namespace {

static_assert(SealKey::Size == crypto_aead_chacha20poly1305_ietf_KEYBYTES);
static_assert(FrameSeal::TagSize == crypto_aead_chacha20poly1305_ietf_ABYTES);
static_assert(crypto_aead_chacha20poly1305_ietf_NPUBBYTES == 12);

const unsigned char *bytesOf(const char *text) noexcept
{
    return reinterpret_cast<const unsigned char *>(text);
}

unsigned char *bytesOf(char *text) noexcept
{
    return reinterpret_cast<unsigned char *>(text);
}

/// Finds the fastest code for this processor, once; without it the same bytes come more slowly.
void prepareSodium() noexcept
{
    [[maybe_unused]] static const int prepared = sodium_init();
}

}  // namespace

SealKey::SealKey(const char *bytes) noexcept
{
    std::memcpy(m_bytes.data(), bytes, Size);
}

SealKey::~SealKey()
{
    sodium_memzero(m_bytes.data(), Size);
}

SealKey SealKey::make(const std::function<std::uint64_t()> &random)
{
    prepareSodium();
    char bytes[Size];
    for (std::size_t i = 0; i < Size; i += sizeof(std::uint64_t))
        storeLittle(random(), bytes + i);
    const SealKey key(bytes);
    sodium_memzero(bytes, Size);
    return key;
}

FrameSeal::FrameSeal(const SealKey &key, std::uint64_t session, std::uint16_t node) noexcept
    : m_key(key)
    , m_session(session)
    , m_node(node)
{
    prepareSodium();
}

bool FrameSeal::seal(std::uint64_t cycle, std::uint16_t part, const char *header, const char *payload, std::size_t size,
                     char *frame) noexcept
{
    constexpr std::uint32_t resent = 0x10000;  // all parts that are sent again come behind all others
    const std::uint32_t place = part + ((loadLittle<std::uint8_t>(header + 1) & ResentFlag) != 0 ? resent : 0);
    if (cycle < m_cycle || (cycle == m_cycle && place < m_place))
        return false;
    m_cycle = cycle;
    m_place = place + 1;
    std::memcpy(frame, header, CyclicHeaderSize);
    char *sealed = frame + CyclicHeaderSize;
    crypto_aead_chacha20poly1305_ietf_encrypt_detached(
        bytesOf(sealed), bytesOf(sealed + size), nullptr, bytesOf(payload), size, bytesOf(frame), CyclicHeaderSize,
        nullptr, nonce(cycle, part, header).data(), bytesOf(m_key.data()));
    return true;
}

bool FrameSeal::open(std::uint64_t cycle, std::uint16_t part, const char *frame, std::size_t size,
                     char *payload) const noexcept
{
    const char *sealed = frame + CyclicHeaderSize;
    return crypto_aead_chacha20poly1305_ietf_decrypt_detached(bytesOf(payload), nullptr, bytesOf(sealed), size,
                                                              bytesOf(sealed + size), bytesOf(frame), CyclicHeaderSize,
                                                              nonce(cycle, part, frame).data(), bytesOf(m_key.data()))
        == 0;
}

/// Session and node are the same in all nonces of a key, so each of them belongs to one cycle,
/// part, direction and set of flags.
FrameSeal::Nonce FrameSeal::nonce(std::uint64_t cycle, std::uint16_t part, const char *header) const noexcept
{
    Nonce nonce;
    char *bytes = reinterpret_cast<char *>(nonce.data());
    storeLittle(cycle ^ m_session, bytes);
    storeLittle(std::uint16_t(part ^ m_node), bytes + 8);
    std::memcpy(bytes + 10, header, 2);  // version and kind, flags
    return nonce;
}

}  // namespace qplc
