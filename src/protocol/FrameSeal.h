// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace qplc {

/// Secret of one direction of one node, for one registration. Every copy is wiped when it goes.
class SealKey
{
public:
    static constexpr std::size_t Size = 32;  // [byte]

    /// Takes \a Size bytes.
    explicit SealKey(const char *bytes) noexcept;
    SealKey(const SealKey &) = default;
    SealKey &operator=(const SealKey &) = default;
    ~SealKey();
    /// A new one. \param random  64 bits that nobody can guess, new with each call
    static SealKey make(const std::function<std::uint64_t()> &random);

    const char *data() const { return m_bytes.data(); }

private:
    std::array<char, Size> m_bytes;
};

/// Both directions between a master and one node.
struct SealKeys
{
    SealKey inputs;   // master -> node
    SealKey outputs;  // node -> master

    static SealKeys make(const std::function<std::uint64_t()> &random)
    {
        return {SealKey::make(random), SealKey::make(random)};
    }
};

/// Seals the frames of one direction of one node, or opens them: ChaCha20-Poly1305 (RFC 8439) over
/// header and payload, with a nonce of session, node, direction, 64-bit cycle, part and flags. See
/// docs/protocol.md, section 7.8.
///
/// Two different frames under one nonce would give the key away, so a seal cannot be copied, and
/// seals each place in the order of frames once: by cycle, then whether the frame is sent again,
/// then part. Who sends the same frame twice keeps its bytes. Allocation-free.
class FrameSeal
{
public:
    static constexpr std::size_t TagSize = 16;  // [byte]

    FrameSeal(const SealKey &key, std::uint64_t session, std::uint16_t node) noexcept;
    FrameSeal(const FrameSeal &) = delete;
    FrameSeal &operator=(const FrameSeal &) = delete;

    /// Writes \a header, the sealed payload and the tag to \a frame. \param payload may be where
    /// the sealed one goes
    /// \return false when a frame of this place or a later one has been sealed: nothing is written
    bool seal(std::uint64_t cycle, std::uint16_t part, const char *header, const char *payload, std::size_t size,
              char *frame) noexcept;
    /// Writes what is sealed in \a frame to \a payload, \a size bytes. \return false when the frame
    /// is not as it was sealed: \a payload is then void
    bool open(std::uint64_t cycle, std::uint16_t part, const char *frame, std::size_t size,
              char *payload) const noexcept;

private:
    using Nonce = std::array<unsigned char, 12>;
    Nonce nonce(std::uint64_t cycle, std::uint16_t part, const char *header) const noexcept;

    const SealKey m_key;
    const std::uint64_t m_session;
    const std::uint16_t m_node;
    std::uint64_t m_cycle = 0;  // of the next place that may be sealed
    std::uint32_t m_place = 0;  // within that cycle
};

}  // namespace qplc
