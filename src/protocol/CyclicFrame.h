// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FrameSeal.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace qplc {

/// The frames that carry values in every cycle: little-endian,
///   u8 version << 4 | kind, u8 flags, u16 session, u32 cycle, u16 info, u16 before, payload, u32
///   CRC-32C
/// = 16 bytes + payload. The CRC is seeded with session id, node id and layout hash. A sealed frame
/// has a sealed payload, and a tag of 16 bytes in the place of the CRC: 28 bytes + payload. See
/// docs/protocol.md.
constexpr std::uint8_t CyclicVersion = 2;
constexpr std::size_t CyclicHeaderSize = 12;
constexpr std::size_t CyclicOverhead = CyclicHeaderSize + sizeof(std::uint32_t);
/// Longest frame: an Ethernet MTU without IPv4 and UDP headers.
constexpr std::size_t MaximumCyclicFrame = 1472;
constexpr std::size_t MaximumCyclicPayload = MaximumCyclicFrame - CyclicOverhead;
constexpr std::size_t SealedOverhead = CyclicHeaderSize + FrameSeal::TagSize;
constexpr std::size_t MaximumSealedPayload = MaximumCyclicFrame - SealedOverhead;
/// Most bytes of a part.
constexpr std::uint32_t maximumPayload(bool isSealed)
{
    return std::uint32_t(isSealed ? MaximumSealedPayload : MaximumCyclicPayload);
}

enum class FrameKind : std::uint8_t {
    Inputs = 1,      ///< master -> node: TimeoutWithNewValues
    Outputs = 2,     ///< node -> master: the answer
    GroupInputs = 3  ///< master -> a multicast group: the inputs of several nodes
};

enum FrameFlag : std::uint8_t {
    ResentFlag = 0x01,    ///< sent again because no answer came: to be answered from the cache
    FaultFlag = 0x02,     ///< outputs: the node could not compute this cycle, the values count for nothing
    SafeStopFlag = 0x04,  ///< inputs: the master stops safely, nothing may move; outputs: the node is in its safe state
    StopWantedFlag = 0x08,  ///< outputs: the node wants the master to stop safely
    PartFlag = 0x80         ///< part 1, 2, ... of a frame of several parts: `info` is the number of the part
};

struct FrameHeader
{
    FrameKind kind = FrameKind::Inputs;
    std::uint8_t flags = 0;
    std::uint64_t cycle = 0;  ///< the wire carries its low 32 bits
    /// Inputs: lateness of the cycle [ns]; outputs: execution time [ns]; saturated. The wire
    /// carries the 12 highest bits. Parts > 0: number of the part.
    std::uint32_t info = 0;
    /// Inputs: how many cycles before this one, from the first one of the node on, the master has
    /// not sent to it, modulo 2^16. Outputs: how many cycles before this one is the one that the
    /// node computed before, at most 2^16 - 1; 0 in its first answer of a phase.
    std::uint16_t before = 0;
};

/// What binds a frame to one session, one node and one layout; mixed into the CRC, never sent.
struct FrameSeed
{
    std::uint64_t session = 0;     ///< random, new at each start of a master, never 0
    std::uint16_t node = 0;        ///< given by the master at registration
    std::uint64_t layoutHash = 0;  ///< PayloadLayout::hash() of the direction
};

enum class FrameStatus : std::uint8_t {
    Complete,      ///< all values of a cycle are there
    Incomplete,    ///< a good part; others are missing
    Duplicate,     ///< a good part that was there before, or belongs to the newest complete cycle
    Old,           ///< a good part of a cycle that is over: before the newest one seen, and not the newest complete one
    WrongLength,   ///< for the part that it says to be, or there is no such part
    WrongVersion,  ///< of the protocol, or the kind of the other direction
    WrongSession,  ///< low 16 bits differ
    WrongChecksum,  ///< corrupted, or of another session, node or table
    /// not sealed with this key as it is: made or changed by a stranger, corrupted, or of another
    /// session, node or direction
    Forged,
    Early  ///< good, but of a cycle that is not due yet
};

/// How the wire carries a time of FrameHeader::info: 5 bits exponent, 11 bits fraction.
std::uint16_t shortTime(std::uint32_t time) noexcept;
/// The time that the wire carries as \a wire: up to 1/2048 shorter than what it was made of.
std::uint32_t timeOfShort(std::uint16_t wire) noexcept;

/// The 64-bit number of the cycle whose low 32 bits are \a wire, nearest to \a reference.
constexpr std::uint64_t extendCycle(std::uint32_t wire, std::uint64_t reference) noexcept
{
    return reference + std::uint64_t(std::int64_t(std::int32_t(wire - std::uint32_t(reference))));
}

/// Writes the frames of one direction of one node. Allocation-free after construction; encode() is
/// thread-safe unless it seals.
class FrameEncoder
{
public:
    FrameEncoder() = default;
    /// \param partBorders PayloadLayout::partBorders(MaximumCyclicPayload or MaximumSealedPayload):
    ///         n parts have n + 1 borders, from 0, never falling
    /// \param key  to seal the frames with; for one encoder alone. Null: they are not sealed
    FrameEncoder(FrameKind kind, const FrameSeed &seed, std::vector<std::uint32_t> partBorders,
                 const SealKey *key = nullptr);

    std::size_t partCount() const { return m_borders.size() - 1; }
    std::size_t partSize(std::size_t part) const { return overhead() + m_borders[part + 1] - m_borders[part]; }
    /// Bytes of all parts together.
    std::size_t totalSize() const { return overhead() * partCount() + m_borders.back(); }
    /// Writes part \a part to \a target (partSize(part) bytes). \a header.kind, PartFlag and, in
    /// parts > 0, \a header.info are set here.
    /// \param payload begin of the whole payload, also for parts > 0; may be \a target +
    ///         CyclicHeaderSize, then nothing is copied
    /// \return false when this frame or a later one has been sealed already: what was sent is sent
    ///         again as it is, see FrameSeal. Nothing is written
    bool encode(std::size_t part, FrameHeader header, const char *payload, char *target) const noexcept;

private:
    std::size_t overhead() const { return m_seal ? SealedOverhead : CyclicOverhead; }

    FrameKind m_kind = FrameKind::Inputs;
    std::uint16_t m_session = 0;
    std::uint32_t m_seedCrc = 0;
    std::vector<std::uint32_t> m_borders{0, 0};
    std::unique_ptr<FrameSeal> m_seal;
};

/// Checks the frames of one direction of one node and puts their parts together. Allocation-free
/// after construction.
///
/// The newest complete payload stays whole and visible while parts of the next cycle arrive: they
/// are put together in a second buffer. A frame that is refused (WrongLength, WrongVersion,
/// WrongSession, WrongChecksum, Forged, Early) changes nothing at all.
class FrameDecoder
{
public:
    /// Refuses every frame.
    FrameDecoder() = default;
    /// \param key  that the frames are sealed with; null: they are not sealed
    FrameDecoder(FrameKind kind, const FrameSeed &seed, std::vector<std::uint32_t> partBorders,
                 const SealKey *key = nullptr);

    /// Takes one datagram. With Complete, payload() holds the values, header() the header of part 0
    /// and cycle() the cycle.
    /// \param end  cycles from this one on are not due yet: their frames are Early
    FrameStatus decode(const char *bytes, std::size_t size,
                       std::uint64_t end = std::numeric_limits<std::uint64_t>::max()) noexcept;
    /// Payload of the newest complete frame (zeros before the first); valid until the next
    /// decode().
    const char *payload() const { return m_payload.get(); }
    /// Header of part 0 of the newest complete frame.
    const FrameHeader &header() const { return m_header; }
    /// Cycle of the newest complete frame.
    std::uint64_t cycle() const { return m_cycle; }
    /// Header of the last frame that was not refused, whatever became of it. A node answers from
    /// its cache when decode() gave Duplicate and this has ResentFlag, no PartFlag, and the number
    /// of cycle().
    const FrameHeader &received() const { return m_received; }
    /// On a byte stream: total size of the frame that begins with the \a CyclicHeaderSize bytes at
    /// \a header, 0 when it is no frame of this decoder.
    std::size_t frameSize(const char *header) const noexcept;

    /// Forgets all cycles: the next frame may have any number from \a firstCycle on (but below
    /// firstCycle + 2^31: the wire carries 32 bits).
    void restart(std::uint64_t firstCycle) noexcept;

private:
    std::size_t overhead() const { return m_seal ? SealedOverhead : CyclicOverhead; }
    std::size_t claimedSize(const char *header) const noexcept;
    FrameHeader readHeader(const char *bytes) const noexcept;
    bool isOfThisKind(const char *header) const noexcept;
    FrameStatus accept(const FrameHeader &header, const char *payload, std::uint64_t end) noexcept;
    void beginCycle(std::uint64_t cycle) noexcept;
    FrameStatus addPart(std::size_t part, const char *payload) noexcept;

    FrameKind m_kind = FrameKind::Inputs;
    std::uint16_t m_session = 0;
    std::uint32_t m_seedCrc = 0;
    std::vector<std::uint32_t> m_borders;
    std::size_t m_partCount = 0;           // 0: no frame has the right length
    std::unique_ptr<char[]> m_payload;     // newest complete one
    std::unique_ptr<char[]> m_incomplete;  // of m_newest, as long as parts are missing
    std::unique_ptr<FrameSeal> m_seal;
    std::unique_ptr<char[]> m_opened;        // payload of a sealed part
    std::vector<std::uint64_t> m_partsSeen;  // of m_newest, one bit a part
    std::size_t m_missingParts = 0;          // of m_newest
    FrameHeader m_received;
    FrameHeader m_incompleteHeader;
    FrameHeader m_header;
    std::uint64_t m_cycle = 0;   // newest complete one
    std::uint64_t m_newest = 0;  // newest cycle seen; before any, the first one that is welcome
    bool m_any = false;          // a frame since restart()
    bool m_anyComplete = false;  // a complete one since restart()
};

}  // namespace qplc
