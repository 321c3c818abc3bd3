// SPDX-License-Identifier: Apache-2.0
#include "CyclicFrame.h"

#include "Crc32c.h"
#include "LittleEndian.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace qplc {

namespace {

// Places in the header [byte].
constexpr std::size_t FlagsAt = 1;
constexpr std::size_t SessionAt = 2;
constexpr std::size_t CycleAt = 4;
constexpr std::size_t InfoAt = 8;
constexpr std::size_t BeforeAt = 10;

constexpr unsigned FractionBits = 11;  // of a time

constexpr std::size_t PartsPerWord = 64;

constexpr char versionAndKind(FrameKind kind)
{
    return char(CyclicVersion << 4 | std::uint8_t(kind));
}

std::uint32_t crcOfSeed(const FrameSeed &seed) noexcept
{
    char bytes[18];
    storeLittle(seed.session, bytes);
    storeLittle(seed.node, bytes + 8);
    storeLittle(seed.layoutHash, bytes + 10);
    return crc32c(0, bytes, sizeof bytes);
}

// An empty payload has no bytes, and perhaps no address; another one may be where it belongs
// already.
void copyBytes(const char *from, std::size_t size, char *to) noexcept
{
    if (size > 0 && from != to)
        std::memcpy(to, from, size);
}

std::vector<std::uint32_t> checkedBorders(std::vector<std::uint32_t> borders)
{
    assert(borders.size() >= 2 && borders.front() == 0 && std::is_sorted(borders.begin(), borders.end())
           && "n parts have n + 1 borders, from 0, never falling");
    return borders;
}

std::size_t largestPart(const std::vector<std::uint32_t> &borders)
{
    std::size_t largest = 0;
    for (std::size_t part = 0; part + 1 < borders.size(); ++part)
        largest = std::max<std::size_t>(largest, borders[part + 1] - borders[part]);
    return largest;
}

std::unique_ptr<FrameSeal> sealOf(const SealKey *key, const FrameSeed &seed)
{
    return key ? std::make_unique<FrameSeal>(*key, seed.session, seed.node) : nullptr;
}

std::size_t partOf(const FrameHeader &header)
{
    return (header.flags & PartFlag) != 0 ? header.info : 0;
}

}  // namespace

std::uint16_t shortTime(std::uint32_t time) noexcept
{
    unsigned exponent = 0;
    while (time >> exponent >= 2U << FractionBits)
        ++exponent;
    return std::uint16_t((exponent << FractionBits) + (time >> exponent));  // a leading one adds 1 to the exponent
}

std::uint32_t timeOfShort(std::uint16_t wire) noexcept
{
    constexpr std::uint32_t one = 1U << FractionBits;
    const std::uint32_t fraction = wire & (one - 1);
    const unsigned exponent = wire >> FractionBits;
    const std::uint64_t time = exponent == 0 ? fraction : std::uint64_t(one + fraction) << (exponent - 1);
    return std::uint32_t(std::min<std::uint64_t>(time, std::numeric_limits<std::uint32_t>::max()));
}

FrameEncoder::FrameEncoder(FrameKind kind, const FrameSeed &seed, std::vector<std::uint32_t> partBorders,
                           const SealKey *key)
    : m_kind(kind)
    , m_session(std::uint16_t(seed.session))
    , m_seedCrc(crcOfSeed(seed))
    , m_borders(checkedBorders(std::move(partBorders)))
    , m_seal(sealOf(key, seed))
{
}

bool FrameEncoder::encode(std::size_t part, FrameHeader header, const char *payload, char *target) const noexcept
{
    const std::size_t begin = m_borders[part];
    const std::size_t size = m_borders[part + 1] - begin;
    header.flags = std::uint8_t(part == 0 ? header.flags & ~PartFlag : header.flags | PartFlag);
    char head[CyclicHeaderSize];
    head[0] = versionAndKind(m_kind);
    storeLittle(header.flags, head + FlagsAt);
    storeLittle(m_session, head + SessionAt);
    storeLittle(std::uint32_t(header.cycle), head + CycleAt);
    storeLittle(part == 0 ? shortTime(header.info) : std::uint16_t(part), head + InfoAt);
    storeLittle(header.before, head + BeforeAt);
    if (m_seal)
        return m_seal->seal(header.cycle, std::uint16_t(part), head, payload + begin, size, target);
    std::memcpy(target, head, CyclicHeaderSize);
    copyBytes(payload + begin, size, target + CyclicHeaderSize);
    storeLittle(crc32c(m_seedCrc, target, CyclicHeaderSize + size), target + CyclicHeaderSize + size);
    return true;
}

FrameDecoder::FrameDecoder(FrameKind kind, const FrameSeed &seed, std::vector<std::uint32_t> partBorders,
                           const SealKey *key)
    : m_kind(kind)
    , m_session(std::uint16_t(seed.session))
    , m_seedCrc(crcOfSeed(seed))
    , m_borders(checkedBorders(std::move(partBorders)))
    , m_partCount(m_borders.size() - 1)
    , m_payload(std::make_unique<char[]>(m_borders.back()))
    , m_incomplete(std::make_unique<char[]>(m_borders.back()))
    , m_seal(sealOf(key, seed))
    , m_opened(key ? std::make_unique<char[]>(largestPart(m_borders)) : nullptr)
    , m_partsSeen((m_partCount + PartsPerWord - 1) / PartsPerWord)
{
}

FrameStatus FrameDecoder::decode(const char *bytes, std::size_t size, std::uint64_t end) noexcept
{
    if (size < overhead() || size != claimedSize(bytes))
        return FrameStatus::WrongLength;
    if (!isOfThisKind(bytes))
        return FrameStatus::WrongVersion;
    if (loadLittle<std::uint16_t>(bytes + SessionAt) != m_session)
        return FrameStatus::WrongSession;
    const FrameHeader header = readHeader(bytes);
    if (m_seal) {
        const std::size_t sealed = size - SealedOverhead;
        if (!m_seal->open(header.cycle, std::uint16_t(partOf(header)), bytes, sealed, m_opened.get()))
            return FrameStatus::Forged;
        return accept(header, m_opened.get(), end);
    }
    const std::size_t checked = size - sizeof(std::uint32_t);
    if (loadLittle<std::uint32_t>(bytes + checked) != crc32c(m_seedCrc, bytes, checked))
        return FrameStatus::WrongChecksum;
    return accept(header, bytes + CyclicHeaderSize, end);
}

/// The cycle is the one nearest to the newest cycle seen.
FrameHeader FrameDecoder::readHeader(const char *bytes) const noexcept
{
    FrameHeader header;
    header.kind = m_kind;
    header.flags = loadLittle<std::uint8_t>(bytes + FlagsAt);
    header.cycle = extendCycle(loadLittle<std::uint32_t>(bytes + CycleAt), m_newest);
    const auto info = loadLittle<std::uint16_t>(bytes + InfoAt);
    header.info = (header.flags & PartFlag) != 0 ? info : timeOfShort(info);
    header.before = loadLittle<std::uint16_t>(bytes + BeforeAt);
    return header;
}

std::size_t FrameDecoder::frameSize(const char *header) const noexcept
{
    const bool isOurs = isOfThisKind(header) && loadLittle<std::uint16_t>(header + SessionAt) == m_session;
    return isOurs ? claimedSize(header) : 0;
}

void FrameDecoder::restart(std::uint64_t firstCycle) noexcept
{
    m_newest = firstCycle;
    m_any = false;
    m_anyComplete = false;
}

// Size of the part that the header says to begin, 0 when there is no such part.
std::size_t FrameDecoder::claimedSize(const char *header) const noexcept
{
    std::size_t part = 0;
    if ((loadLittle<std::uint8_t>(header + FlagsAt) & PartFlag) != 0) {
        part = loadLittle<std::uint16_t>(header + InfoAt);
        if (part == 0)
            return 0;
    }
    return part < m_partCount ? overhead() + m_borders[part + 1] - m_borders[part] : 0;
}

bool FrameDecoder::isOfThisKind(const char *header) const noexcept
{
    return header[0] == versionAndKind(m_kind);
}

// Serial arithmetic on the 32 bits of the wire: up to 2^31 - 1 cycles ahead is newer, all else is
// not.
FrameStatus FrameDecoder::accept(const FrameHeader &header, const char *payload, std::uint64_t end) noexcept
{
    const auto ahead = std::int64_t(header.cycle - m_newest);
    if (ahead >= 0 && header.cycle >= end)
        return FrameStatus::Early;
    m_received = header;
    if (ahead < 0)
        return m_anyComplete && header.cycle == m_cycle ? FrameStatus::Duplicate : FrameStatus::Old;
    if (ahead > 0 || !m_any)
        beginCycle(header.cycle);
    return addPart(partOf(header), payload);
}

void FrameDecoder::beginCycle(std::uint64_t cycle) noexcept
{
    m_newest = cycle;
    m_any = true;
    m_missingParts = m_partCount;
    std::fill(m_partsSeen.begin(), m_partsSeen.end(), 0);
}

FrameStatus FrameDecoder::addPart(std::size_t part, const char *payload) noexcept
{
    std::uint64_t &seen = m_partsSeen[part / PartsPerWord];
    const std::uint64_t bit = std::uint64_t(1) << (part % PartsPerWord);
    if ((seen & bit) != 0)
        return FrameStatus::Duplicate;

    seen |= bit;
    copyBytes(payload, m_borders[part + 1] - m_borders[part], m_incomplete.get() + m_borders[part]);
    if (part == 0)
        m_incompleteHeader = m_received;
    if (--m_missingParts > 0)
        return FrameStatus::Incomplete;

    m_payload.swap(m_incomplete);
    m_header = m_incompleteHeader;
    m_cycle = m_newest;
    m_anyComplete = true;
    return FrameStatus::Complete;
}

}  // namespace qplc
