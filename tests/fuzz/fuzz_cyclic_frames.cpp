// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "protocol/Crc32c.h"
#include "protocol/CyclicFrame.h"
#include "protocol/LittleEndian.h"
#include "transport/FrameCutter.h"

#include <vector>

namespace {

using qplc::FrameDecoder;
using qplc::FrameStatus;

/// One direction of one node, as the input begins.
struct Channel
{
    explicit Channel(fuzz::Input *input)
    {
        const auto kindAndSeal = input->number<std::uint8_t>();
        isSealed = kindAndSeal & 0x80;
        kind = qplc::FrameKind(1 + (kindAndSeal & 0x7f) % 3);
        seed.session = input->number<std::uint64_t>();
        seed.node = input->number<std::uint16_t>();
        seed.layoutHash = input->number<std::uint64_t>();
        firstCycle = input->number<std::uint64_t>();
        for (int parts = 1 + input->number<std::uint8_t>() % 70; parts > 0; --parts)
            borders.push_back(borders.back() + input->number<std::uint16_t>() % (qplc::maximumPayload(isSealed) + 1));
    }

    FrameDecoder decoder() const
    {
        const qplc::SealKey key(keyBytes);
        FrameDecoder decoder(kind, seed, borders, isSealed ? &key : nullptr);
        decoder.restart(firstCycle);
        return decoder;
    }
    /// Gives \a frame the checksum, or the seal, that no chance would find.
    void repair(QByteArray *frame) const
    {
        if (isSealed)
            seal(frame);
        else
            setChecksum(frame);
    }

    void seal(QByteArray *frame) const
    {
        if (frame->size() < int(qplc::SealedOverhead))
            return;
        const QByteArray plain = *frame;
        const char *header = plain.constData();
        const bool isPart = qplc::loadLittle<std::uint8_t>(header + 1) & qplc::PartFlag;
        qplc::FrameSeal seal(qplc::SealKey(keyBytes), this->seed.session, this->seed.node);
        seal.seal(qplc::extendCycle(qplc::loadLittle<std::uint32_t>(header + 4), firstCycle),
                  std::uint16_t(isPart ? qplc::loadLittle<std::uint32_t>(header + 8) : 0), header,
                  header + qplc::CyclicHeaderSize, std::size_t(plain.size()) - qplc::SealedOverhead, frame->data());
    }

    void setChecksum(QByteArray *frame) const
    {
        if (frame->size() < int(qplc::CyclicOverhead))
            return;
        char bytes[18];
        qplc::storeLittle(seed.session, bytes);
        qplc::storeLittle(seed.node, bytes + 8);
        qplc::storeLittle(seed.layoutHash, bytes + 10);
        const std::size_t checked = std::size_t(frame->size()) - sizeof(std::uint32_t);
        char *target = frame->data();
        qplc::storeLittle(qplc::crc32c(qplc::crc32c(0, bytes, sizeof bytes), target, checked), target + checked);
    }

    static constexpr char keyBytes[] = "0123456789abcdef0123456789abcdef";
    qplc::FrameKind kind = qplc::FrameKind::Inputs;
    bool isSealed = false;
    qplc::FrameSeed seed;
    std::uint64_t firstCycle = 0;
    std::vector<std::uint32_t> borders{0};
};

bool isRefused(FrameStatus status)
{
    return status == FrameStatus::WrongLength || status == FrameStatus::WrongVersion
        || status == FrameStatus::WrongSession || status == FrameStatus::WrongChecksum || status == FrameStatus::Forged;
}

void decode(FrameDecoder *decoder, const QByteArray &frame, std::size_t payloadSize)
{
    const QByteArray payload(decoder->payload(), int(payloadSize));
    const std::uint64_t cycle = decoder->cycle();
    const std::uint64_t received = decoder->received().cycle;
    const FrameStatus status = decoder->decode(frame.constData(), std::size_t(frame.size()));
    const bool sameValues = decoder->cycle() == cycle && payload == QByteArray(decoder->payload(), int(payloadSize));
    fuzz::check(status == FrameStatus::Complete || sameValues, "only a complete frame changes values");
    fuzz::check(!isRefused(status) || decoder->received().cycle == received, "a refused frame changes nothing");
}

std::size_t frameSize(const void *decoder, const char *header)
{
    return static_cast<const FrameDecoder *>(decoder)->frameSize(header);
}

/// The same frames, one behind the other.
void decodeStream(const Channel &channel, QByteArray stream)
{
    FrameDecoder decoder = channel.decoder();
    qplc::FrameBuffer buffer(4 * qplc::MaximumCyclicFrame);
    const qplc::FrameCutter cutter{qplc::CyclicHeaderSize, &frameSize, &decoder};
    const char *frame = nullptr;
    std::size_t size = 0;
    while (!stream.isEmpty()) {
        buffer.compact();
        const auto taken = std::min(std::size_t(stream.size()), buffer.spaceSize());
        fuzz::check(taken > 0, "a buffer without a whole frame has room");
        std::memcpy(buffer.space(), stream.constData(), taken);
        buffer.filled(taken);
        stream.remove(0, int(taken));
        qplc::FrameBuffer::Result result;
        while ((result = buffer.next(cutter, &frame, &size)) == qplc::FrameBuffer::Frame)
            decode(&decoder, QByteArray(frame, int(size)), channel.borders.back());
        if (result == qplc::FrameBuffer::Garbage)
            return;
    }
}

}  // namespace

// Input: a channel (kind and whether it is sealed, session, node, layout hash, first cycle, parts
// and their lengths), then frames: whether to give it a right checksum or seal, length, bytes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    fuzz::Input input(data, size);
    const Channel channel(&input);
    FrameDecoder decoder = channel.decoder();
    QByteArray stream;
    while (!input.atEnd()) {
        const bool isToBeRepaired = input.number<std::uint8_t>() & 1;
        QByteArray frame = input.bytes(input.number<std::uint16_t>());
        if (isToBeRepaired)
            channel.repair(&frame);
        decode(&decoder, frame, channel.borders.back());
        stream += frame;
    }
    decodeStream(channel, stream);
    return 0;
}
