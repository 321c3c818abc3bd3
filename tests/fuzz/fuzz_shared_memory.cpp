// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "transport/SharedChannel.h"

#include <array>
#include <fcntl.h>
#include <memory>
#include <new>
#include <unistd.h>

namespace {

using qplc::Doorbell;
using qplc::SharedRing;

constexpr std::size_t LongestFrame = 2048;
constexpr std::size_t RingSize = SharedRing::HeaderSize + SharedRing::SmallestCapacity;

/// Memory as the kernel maps it; a look behind it is seen by the sanitizer.
class Memory
{
public:
    explicit Memory(std::size_t size)
        : m_size(size)
        , m_bytes(static_cast<char *>(::operator new(size, alignment)))
    {
        std::memset(m_bytes, 0, size);
    }
    ~Memory() { ::operator delete(m_bytes, alignment); }
    Memory(const Memory &) = delete;
    Memory &operator=(const Memory &) = delete;

    char *data() const { return m_bytes; }
    /// What the process at the other end writes. Most of it hits the head, where the numbers are.
    void poke(fuzz::Input *input)
    {
        const bool isHead = input->number<std::uint8_t>() % 4 != 0;
        const std::size_t range = (isHead ? std::min<std::size_t>(m_size, 256) : m_size) - sizeof(std::uint32_t);
        const std::size_t offset = input->number<std::uint32_t>() % (range + 1);
        const auto value = input->number<std::uint32_t>();
        std::memcpy(m_bytes + offset, &value, sizeof value);
    }

private:
    static constexpr std::align_val_t alignment{64};
    const std::size_t m_size;
    char *const m_bytes;
};

/// A pipe to ring, that never makes anybody wait.
int bellPipe()
{
    std::array<int, 2> ends{-1, -1};
    fuzz::check(::pipe2(ends.data(), O_NONBLOCK | O_CLOEXEC) == 0, "there is a pipe");
    return ends[1];
}

}  // namespace

// Input: what the process at the other end writes into the memory of a ring and of a doorbell, and
// what this one does meanwhile.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    static const int pipe = bellPipe();
    fuzz::Input input(data, size);
    Memory ringMemory(RingSize);
    Memory bellMemory(sizeof(Doorbell));
    SharedRing ring(ringMemory.data(), SharedRing::SmallestCapacity);
    auto *bell = new (bellMemory.data()) Doorbell;
    std::array<char, LongestFrame> frame{};
    int sleeps = 4;  // a sleep of no time takes the slack of a timer
    while (!input.atEnd()) {
        switch (input.number<std::uint8_t>() % 6) {
        case 0:
            ringMemory.poke(&input);
            break;
        case 1:
            bellMemory.poke(&input);
            break;
        case 2:
            fuzz::check(ring.pop(frame.data(), frame.size()) <= frame.size(), "a frame fits or is none");
            break;
        case 3: {
            const QByteArray bytes = input.bytes(input.number<std::uint16_t>() % LongestFrame);
            (void)ring.push(bytes.constData(), std::size_t(bytes.size()));
            break;
        }
        case 4:
            bell->ring(pipe);
            break;
        default:
            bell->want(bell->count() + input.number<std::uint8_t>());
            if (sleeps-- > 0)
                bell->sleep(0);
            if (bell->beginPoll())
                bell->endPoll();
        }
    }
    return 0;
}
