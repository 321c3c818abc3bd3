// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "realtime/Host.h"
#include "transport/LocalLink.h"
#include "transport/LocalSocket.h"
#include "transport/SharedChannel.h"

#include <QtCore/QString>

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <vector>

namespace {

using qplc::CycleVolume;
using qplc::CyclicLink;
using qplc::Descriptor;
using qplc::Doorbell;
using qplc::LocalLink;
using qplc::SharedChannel;
using qplc::SharedMemory;

constexpr std::size_t LongestFrame = 2048;

/// Listens for the nodes of a session of this process.
class Listener
{
public:
    Listener()
    {
        sockaddr_un address;
        const socklen_t length = qplc::LocalSocket::addressOf(session, &address);
        fuzz::check(::bind(m_socket.number(), reinterpret_cast<const sockaddr *>(&address), length) == 0
                        && ::listen(m_socket.number(), 5) == 0,
                    "a session has a name of its own");
    }
    Descriptor take() const { return Descriptor(::accept(m_socket.number(), nullptr, nullptr)); }
    const std::uint64_t session = qplc::Host::machine().random();

private:
    const Descriptor m_socket = qplc::LocalSocket::make();
};

/// What a master has and may pass, right or wrong.
struct Things
{
    explicit Things(const CycleVolume &volume)
    {
        QString error;
        int ends[2] = {-1, -1};
        fuzz::check(channel.create(volume, &error) && bell.create(sizeof(Doorbell), &error)
                        && ::pipe2(ends, O_NONBLOCK | O_CLOEXEC) == 0,
                    "there is memory");
        toRead = Descriptor(ends[0]);
        toWrite = Descriptor(ends[1]);
        unsealed = Descriptor(::memfd_create("fuzz", MFD_CLOEXEC));
        fuzz::check(::ftruncate(unsealed.number(), off_t(SharedChannel::sizeFor(volume))) == 0, "there is memory");
    }
    int numbered(unsigned kind) const
    {
        const std::array<int, 6> all{channel.descriptor(), bell.descriptor(), toWrite.number(),
                                     toRead.number(),      unsealed.number(), STDIN_FILENO};
        return all[kind % all.size()];
    }

    SharedChannel channel;
    SharedMemory bell;
    Descriptor toRead;
    Descriptor toWrite;
    Descriptor unsealed;
};

/// Sends what the input says: bytes and kinds of things. \return whether it is what a node takes
bool sendMessage(fuzz::Input *input, int socket, std::uint64_t key, const Things &things)
{
    std::array<char, 16> bytes{};
    const std::uint64_t sent = key ^ input->number<std::uint8_t>();
    std::memcpy(bytes.data(), &sent, sizeof sent);
    const std::size_t length = input->number<std::uint8_t>() % (bytes.size() + 1);
    std::vector<unsigned> kinds;
    for (int count = input->number<std::uint8_t>() % 8; count > 0; --count)
        kinds.push_back(input->number<std::uint8_t>() % 6);
    iovec data{bytes.data(), length};
    alignas(cmsghdr) char control[CMSG_SPACE(8 * sizeof(int))] = {};
    msghdr message{};
    message.msg_iov = &data;
    message.msg_iovlen = 1;
    if (!kinds.empty()) {
        message.msg_control = control;
        message.msg_controllen = CMSG_SPACE(kinds.size() * sizeof(int));
        cmsghdr *header = CMSG_FIRSTHDR(&message);
        header->cmsg_level = SOL_SOCKET;
        header->cmsg_type = SCM_RIGHTS;
        header->cmsg_len = CMSG_LEN(kinds.size() * sizeof(int));
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            const int descriptor = things.numbered(kinds[i]);
            std::memcpy(CMSG_DATA(header) + i * sizeof descriptor, &descriptor, sizeof descriptor);
        }
    }
    fuzz::check(::sendmsg(socket, &message, MSG_DONTWAIT | MSG_NOSIGNAL) == ssize_t(length), "a message is sent");
    return length == sizeof key && sent == key && kinds == std::vector<unsigned>{0, 1, 2};
}

/// Both ends go on while the other one writes what it likes into the memory.
void exchange(fuzz::Input *input, LocalLink *link, Things *things, const CycleVolume &volume)
{
    void *memory = ::mmap(nullptr, SharedChannel::sizeFor(volume), PROT_READ | PROT_WRITE, MAP_SHARED,
                          things->channel.descriptor(), 0);
    fuzz::check(memory != MAP_FAILED, "memory is mapped once more");
    std::array<char, LongestFrame> taken{};
    while (!input->atEnd()) {
        const char *frame = nullptr;
        std::size_t size = 0;
        switch (input->number<std::uint8_t>() % 5) {
        case 0: {
            const auto offset = input->number<std::uint32_t>() % (SharedChannel::sizeFor(volume) - 3);
            const auto value = input->number<std::uint32_t>();
            std::memcpy(static_cast<char *>(memory) + offset, &value, sizeof value);
            break;
        }
        case 1:
            fuzz::check(link->poll(&frame, &size) == CyclicLink::Received ? size > 0 && size <= LongestFrame
                                                                          : size == 0,
                        "a node takes a frame or nothing");
            break;
        case 2:
            fuzz::check(things->channel.outputs.pop(taken.data(), taken.size()) <= LongestFrame,
                        "a master takes a frame or nothing");
            break;
        case 3: {
            const QByteArray bytes = input->bytes(input->number<std::uint16_t>() % LongestFrame);
            (void)link->send(bytes.constData(), std::size_t(bytes.size()));
            link->flush();
            break;
        }
        default: {
            const QByteArray bytes = input->bytes(input->number<std::uint16_t>() % LongestFrame);
            (void)things->channel.inputs.push(bytes.constData(), std::size_t(bytes.size()));
            things->channel.inputs.wake();
        }
        }
    }
    ::munmap(memory, SharedChannel::sizeFor(volume));
}

int lowestFree()
{
    return Descriptor(::dup(STDIN_FILENO)).number();
}

}  // namespace

// Input: how many frames there are in each direction, the message that a master passes (a change of
// the key, its length, how many descriptors of which kinds), then what both ends do.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    static const Listener listener;
    const int before = lowestFree();
    {
        fuzz::Input input(data, size);
        const std::size_t ins = 1 + input.number<std::uint8_t>() % 64;
        const std::size_t outs = 1 + input.number<std::uint8_t>() % 64;
        const CycleVolume volume{{ins, ins * 1472}, {outs, outs * 1472}};
        Things things(volume);
        QString error;
        const std::unique_ptr<LocalLink> link = LocalLink::begin(listener.session, &error);
        fuzz::check(link != nullptr, "a node connects");
        const Descriptor master = listener.take();
        const bool isGood = sendMessage(&input, master.number(), link->key(), things);
        fuzz::check(link->finish(volume, &error) == isGood, "a node takes what is right, and nothing else");
        fuzz::check(isGood == error.isEmpty(), "a refusal has a reason");
        if (isGood)
            exchange(&input, link.get(), &things, volume);
    }
    fuzz::check(lowestFree() == before, "nothing stays open");
    return 0;
}
