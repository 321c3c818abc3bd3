// SPDX-License-Identifier: Apache-2.0
#include "FakeCanBus.h"

#include "hardware/fake/FakeMemory.h"

#include <QtCore/QDir>
#include <QtCore/QRegularExpression>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <linux/can/error.h>
#include <new>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

namespace qplc {

namespace {

constexpr int fakeSendBuffer = 4 << 20;  // [byte]

/// Only one participant at a time takes a place.
class FakeBusLock
{
public:
    explicit FakeBusLock(int file)
        : m_file(file)
    {
        while (flock(m_file, LOCK_EX) != 0 && errno == EINTR) {}
    }
    ~FakeBusLock() { flock(m_file, LOCK_UN); }
    FakeBusLock(const FakeBusLock &) = delete;
    FakeBusLock &operator=(const FakeBusLock &) = delete;

private:
    int m_file;
};

}  // namespace

FakeCanBus::FakeCanBus(const QString &name, TimeSource &time)
    : m_name(name)
    , m_time(time)
{
}

FakeCanBus::~FakeCanBus()
{
    FakeCanBus::close();
}

bool FakeCanBus::isName(const QString &name)
{
    static const QRegularExpression allowed(QStringLiteral("^[A-Za-z0-9_-]{1,32}$"));
    return allowed.match(name).hasMatch();
}

QString FakeCanBus::folder() const
{
    return FakeMemory::folder() + QStringLiteral("/can-") + m_name;
}

bool FakeCanBus::failWith(const QString &what)
{
    return fail(QStringLiteral("fake:%1: %2 in the folder %3 (%4); check its rights, or set QTPLC_FAKE_DEVICES to a "
                               "folder of yours")
                    .arg(m_name, what, folder(), QString::fromLocal8Bit(std::strerror(errno))));
}

bool FakeCanBus::join(const Options &options)
{
    close();
    m_folder = folder().toLocal8Bit();
    if (openBoard() && takePlace()) {
        preparePeers();
        m_repeats = m_board->isOneShot.load() == 0;
        if (m_repeats && !options.sentKeys.empty())
            expectConfirmations();
        return true;
    }
    close();
    return false;
}

void FakeCanBus::close()
{
    if (m_place >= 0) {
        unlink(addressOf(m_place).sun_path);
        m_board->places[m_place].generation.fetch_add(1);
    }
    if (m_board)
        munmap(m_board, sizeof(Board));
    for (const int file : {m_boardFile, m_socket, m_sender}) {
        if (file >= 0)
            ::close(file);
    }
    m_board = nullptr;
    m_boardFile = m_socket = m_sender = m_place = -1;
    m_inboxFirst = m_inboxCount = 0;
    m_waitingCount = m_echoes = 0;
    m_isPassive = m_isToldOfPassive = false;
}

sockaddr_un FakeCanBus::addressOf(int number) const
{
    sockaddr_un address;
    std::memset(&address, 0, sizeof address);
    address.sun_family = AF_UNIX;
    const QByteArray path = m_folder + '/' + QByteArray::number(number);
    std::memcpy(address.sun_path, path.constData(), std::min(size_t(path.size()), sizeof address.sun_path - 1));
    return address;
}

bool FakeCanBus::openBoard()
{
    if (size_t(m_folder.size()) + 4 > sizeof(sockaddr_un::sun_path))
        return fail(
            QStringLiteral("fake:%1: the folder %2 has a name of more than %3 bytes, too many for a socket; set "
                           "QTPLC_FAKE_DEVICES to a shorter one")
                .arg(m_name, folder())
                .arg(sizeof(sockaddr_un::sun_path) - 4));
    if (!FakeMemory::makeFolder() || !QDir().mkpath(folder()))
        return failWith(QStringLiteral("cannot make the bus"));
    m_boardFile = ::open((m_folder + "/board").constData(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (m_boardFile < 0 || ftruncate(m_boardFile, sizeof(Board)) != 0)
        return failWith(QStringLiteral("cannot make the file 'board'"));
    void *memory = mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED, m_boardFile, 0);
    if (memory == MAP_FAILED)
        return failWith(QStringLiteral("cannot use the file 'board'"));
    m_board = static_cast<Board *>(memory);  // a new file is zero, which is what an empty board looks like
    return true;
}

bool FakeCanBus::setPlugged(const QString &name, bool isPlugged)
{
    return setMark(name, &Board::isUnplugged, !isPlugged);
}

bool FakeCanBus::setAcknowledged(const QString &name, bool isAcknowledged)
{
    return setMark(name, &Board::isUnacknowledged, !isAcknowledged);
}

bool FakeCanBus::setOneShot(const QString &name, bool isOneShot)
{
    return setMark(name, &Board::isOneShot, isOneShot);
}

bool FakeCanBus::setMark(const QString &name, std::atomic<quint32> Board::*mark, bool isSet)
{
    FakeCanBus bus(name);
    bus.m_folder = bus.folder().toLocal8Bit();
    if (!bus.openBoard())
        return false;
    bus.m_board->*mark = isSet ? 1 : 0;
    return true;
}

bool FakeCanBus::takePlace()
{
    if (isUnplugged())
        return fail(QStringLiteral("fake:%1 is not plugged in; plug it in").arg(m_name));
    const FakeBusLock lock(m_boardFile);
    for (int number = 0; number < MaximumPlaces; ++number) {
        if (!isAlive(number))
            return openSocket(number);
    }
    return fail(QStringLiteral("fake:%1 has %2 participants already; end one of them").arg(m_name).arg(MaximumPlaces));
}

// Whether the one who took a place is still there.
bool FakeCanBus::isAlive(int number) const
{
    if (m_board->places[number].generation.load() % 2 == 0)
        return false;
    const sockaddr_un address = addressOf(number);
    const int probe = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const bool isThere = connect(probe, reinterpret_cast<const sockaddr *>(&address), sizeof address) == 0;
    ::close(probe);
    return isThere;
}

bool FakeCanBus::openSocket(int number)
{
    const sockaddr_un address = addressOf(number);
    unlink(address.sun_path);
    m_socket = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    m_sender = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (m_socket < 0 || m_sender < 0
        || bind(m_socket, reinterpret_cast<const sockaddr *>(&address), sizeof address) != 0)
        return failWith(QStringLiteral("cannot make a socket"));
    // What one slow receiver has not taken is kept for it and must not keep frames from the others.
    setsockopt(m_sender, SOL_SOCKET, SO_SNDBUF, &fakeSendBuffer, sizeof fakeSendBuffer);
    Place &place = m_board->places[number];
    m_place = number;
    m_lost = place.lost.load();
    place.generation.store((place.generation.load() + 1) | 1);
    return true;
}

void FakeCanBus::preparePeers()
{
    for (int number = 0; number < MaximumPlaces; ++number) {
        Peer &peer = m_peers[number];
        peer.generation = 0;
        peer.count = 0;
        peer.address = addressOf(number);
        peer.frames.resize(Backlog);
    }
}

int FakeCanBus::readFrames(CanFrame *frames, int capacity) noexcept
{
    if (isUnplugged())
        return lose(ENODEV);
    for (int number = 0; number < MaximumPlaces; ++number) {
        if (m_peers[number].count > 0 && meet(number))
            flush(&m_peers[number]);
    }
    noteLost();
    if (isAcknowledged())
        sendWaiting();
    confirm(m_echoes);
    m_echoes = 0;
    int count = 0;
    if (capacity > 0 && m_isToldOfPassive != m_isPassive)
        frames[count++] = ownState();
    while (count < capacity && (m_inboxFirst < m_inboxCount || takeDatagram())) {
        const CanFrame &frame = m_inbox[m_inboxFirst++];
        if (accepts(frame))
            frames[count++] = frame;
    }
    return count;
}

bool FakeCanBus::takeDatagram() noexcept
{
    ssize_t size = 0;
    do {
        size = recv(m_socket, m_inbox.data(), sizeof m_inbox, MSG_DONTWAIT | MSG_TRUNC);
    } while ((size < 0 && errno == EINTR) || (size >= 0 && size % ssize_t(sizeof(CanFrame)) != 0)
             || size > ssize_t(sizeof m_inbox));
    m_inboxFirst = 0;
    m_inboxCount = size > 0 ? int(size / ssize_t(sizeof(CanFrame))) : 0;
    return m_inboxCount > 0;
}

void FakeCanBus::noteLost() noexcept
{
    const quint32 lost = m_board->places[m_place].lost.load(std::memory_order_relaxed);
    countLost(quint32(lost - m_lost));
    m_lost = lost;
}

int FakeCanBus::writeFrames(const CanFrame *frames, int count) noexcept
{
    if (isUnplugged())
        return lose(ENODEV);
    if (!isAcknowledged())
        return keep(frames, count);
    sendWaiting();
    transmit(frames, count);
    return count;
}

// Nobody acknowledges: the controller repeats the first frame, the others wait behind it.
int FakeCanBus::keep(const CanFrame *frames, int count) noexcept
{
    m_isPassive = m_isPassive || count > 0;
    if (!m_repeats)
        return count;
    const int kept = std::min(count, int(m_waiting.size()) - m_waitingCount);
    std::copy_n(frames, kept, m_waiting.begin() + m_waitingCount);
    m_waitingCount += kept;
    return kept;
}

void FakeCanBus::sendWaiting() noexcept
{
    m_isPassive = false;
    if (m_waitingCount == 0)
        return;
    transmit(m_waiting.data(), m_waitingCount);
    m_waitingCount = 0;
}

void FakeCanBus::transmit(const CanFrame *frames, int count) noexcept
{
    const qint64 now = m_time.now();
    m_echoes = std::min(m_echoes + count, Backlog);
    for (int number = 0; number < MaximumPlaces; ++number) {
        if (number == m_place || !meet(number))
            continue;
        Peer &peer = m_peers[number];
        for (int i = 0; i < count; ++i) {
            CanFrame frame = frames[i];
            frame.time = now;
            queue(&peer, number, frame);
        }
        flush(&peer);
    }
}

// What the controller tells of itself, as the kernel does.
CanFrame FakeCanBus::ownState() noexcept
{
    m_isToldOfPassive = m_isPassive;
    CanFrame frame;
    frame.id = CAN_ERR_CRTL;
    frame.flags = CanFrame::Error;
    frame.size = CAN_ERR_DLC;
    frame.data[1] = m_isPassive ? CAN_ERR_CRTL_TX_PASSIVE : CAN_ERR_CRTL_ACTIVE;
    frame.time = m_time.now();
    return frame;
}

// Whether somebody has the place; frames for the one who had it before are forgotten.
bool FakeCanBus::meet(int number) noexcept
{
    Peer &peer = m_peers[number];
    const quint32 generation = m_board->places[number].generation.load(std::memory_order_acquire);
    if (generation != peer.generation)
        peer.count = 0;
    peer.generation = generation;
    return generation % 2 == 1;
}

void FakeCanBus::queue(Peer *peer, int number, const CanFrame &frame) noexcept
{
    if (peer->count == Backlog) {
        m_board->places[number].lost.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    peer->frames[size_t((peer->first + peer->count) % Backlog)] = frame;
    ++peer->count;
}

void FakeCanBus::flush(Peer *peer) noexcept
{
    while (peer->count > 0) {
        const int count = std::min({peer->count, BatchSize, Backlog - peer->first});
        const ssize_t sent = sendto(m_sender, &peer->frames[size_t(peer->first)], size_t(count) * sizeof(CanFrame),
                                    MSG_DONTWAIT | MSG_NOSIGNAL, reinterpret_cast<const sockaddr *>(&peer->address),
                                    sizeof peer->address);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == ENOBUFS))
            return;
        peer->first = (peer->first + count) % Backlog;
        peer->count -= count;  // also to one who is gone: there is nobody who could miss them
    }
    peer->first = 0;  // else frames of one cycle would be two datagrams at the end of the ring
}

}  // namespace qplc
