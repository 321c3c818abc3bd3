// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanBus.h"
#include "realtime/TimeSource.h"

#include <QtCore/QByteArray>

#include <array>
#include <atomic>
#include <sys/un.h>

namespace qplc {

/// A CAN bus of this computer that needs neither kernel support nor hardware. Participants may be
/// in several programs of one user.
///
/// Each participant has a place, with a number, in a folder of the bus, and a Unix datagram socket
/// of that number. A frame goes to all others at once; frames of one sender arrive in order. A
/// datagram holds the frames of one call of send(). What does not fit into the socket of a receiver
/// waits at its sender, up to Backlog frames; what does not fit there either is lost, and counted
/// by the receiver. Frames are stamped when they are sent. A participant that was killed leaves its
/// place to the next one.
///
/// Each participant has a controller and a queue in front of it, as the kernel has. While nobody
/// acknowledges frames (setAcknowledged()), the controller repeats one, QueueLength more wait in
/// the queue, and further ones are refused. When the bus is back, they go out, the oldest first,
/// with the next call of send() or receive() of their sender. A controller that sends a frame only
/// once (setOneShot()) drops what is not acknowledged, and nothing waits.
///
/// The folder of the bus is can-NAME among the fake devices (FakeMemory::folder()).
class FakeCanBus : public CanBus
{
public:
    static constexpr int MaximumPlaces = 16;
    static constexpr int Backlog = 4096;    // [frame]
    static constexpr int QueueLength = 10;  // [frame] as txqueuelen of a CAN interface

    /// \param time  stamps the frames that are sent here; outlives this object
    explicit FakeCanBus(const QString &name, TimeSource &time = TimeSource::monotonic());
    ~FakeCanBus() override;

    static bool isName(const QString &name);
    /// Takes the adapters of all participants away, or gives them back: for tests. \return false
    /// when the folder cannot be used
    static bool setPlugged(const QString &name, bool isPlugged);
    /// Lets nobody acknowledge the frames of the bus any more, or again: for tests. \return false
    /// when the folder cannot be used
    static bool setAcknowledged(const QString &name, bool isAcknowledged);
    /// Lets controllers repeat no frame, for participants that open the bus from here on: for
    /// tests. \return false when the folder cannot be used
    static bool setOneShot(const QString &name, bool isOneShot);
    /// Of the bus.
    QString folder() const;

    void close() override;
    int descriptor() const override { return m_socket; }

protected:
    bool join(const Options &options) override;
    int readFrames(CanFrame *frames, int capacity) noexcept override;
    int writeFrames(const CanFrame *frames, int count) noexcept override;
    bool hasQueue() const noexcept override { return m_waitingCount > 1; }

private:
    static constexpr int BatchSize = 64;  // frames of a datagram

    /// What all participants share: a file in the folder.
    struct Place
    {
        std::atomic<quint32> generation{0};  // counts those who had the place; odd: somebody has it
        std::atomic<quint32> lost{0};        // frames to the one who has it
    };
    struct Board
    {
        std::array<Place, MaximumPlaces> places;
        std::atomic<quint32> isUnplugged{0};
        std::atomic<quint32> isUnacknowledged{0};
        std::atomic<quint32> isOneShot{0};
    };
    /// Frames that wait for the socket of another participant: a ring.
    struct Peer
    {
        quint32 generation = 0;
        int first = 0;
        int count = 0;
        sockaddr_un address{};
        std::vector<CanFrame> frames;
    };

    static bool setMark(const QString &name, std::atomic<quint32> Board::*mark, bool isSet);
    bool openBoard();
    bool takePlace();
    bool isAlive(int number) const;
    bool openSocket(int number);
    bool failWith(const QString &what);
    sockaddr_un addressOf(int number) const;
    void preparePeers();

    bool isAcknowledged() const noexcept { return m_board->isUnacknowledged.load(std::memory_order_relaxed) == 0; }
    bool isUnplugged() const noexcept { return m_board->isUnplugged.load(std::memory_order_relaxed) != 0; }
    int keep(const CanFrame *frames, int count) noexcept;
    void sendWaiting() noexcept;
    void transmit(const CanFrame *frames, int count) noexcept;
    CanFrame ownState() noexcept;
    bool takeDatagram() noexcept;
    void noteLost() noexcept;
    bool meet(int number) noexcept;
    void queue(Peer *peer, int number, const CanFrame &frame) noexcept;
    void flush(Peer *peer) noexcept;

    const QString m_name;
    TimeSource &m_time;
    QByteArray m_folder;
    Board *m_board = nullptr;
    int m_boardFile = -1;
    int m_socket = -1;
    int m_sender = -1;  // socket without a name
    int m_place = -1;
    quint32 m_lost = 0;  // of the place, as last seen

    std::array<Peer, MaximumPlaces> m_peers;
    std::array<CanFrame, BatchSize> m_inbox{};
    int m_inboxFirst = 0;
    int m_inboxCount = 0;

    std::array<CanFrame, QueueLength + 1> m_waiting{};  // for an acknowledgement; the first is in the controller
    int m_waitingCount = 0;
    int m_echoes = 0;  // frames that have reached the bus since the last receive()
    bool m_repeats = true;
    bool m_isPassive = false;
    bool m_isToldOfPassive = false;
};

}  // namespace qplc
