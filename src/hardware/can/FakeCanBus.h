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
/// The folder of the bus is can-NAME among the fake devices (FakeMemory::folder()).
class FakeCanBus : public CanBus
{
public:
    static constexpr int MaximumPlaces = 16;
    static constexpr int Backlog = 4096;  // [frame]

    /// \param time  stamps the frames that are sent here; outlives this object
    explicit FakeCanBus(const QString &name, TimeSource &time = TimeSource::monotonic());
    ~FakeCanBus() override;

    static bool isName(const QString &name);
    /// Takes the adapters of all participants away, or gives them back: for tests. \return false
    /// when the folder cannot be used
    static bool setPlugged(const QString &name, bool isPlugged);
    /// Lets the bus take no frame any more, as one that nobody acknowledges, or take them again:
    /// for tests. \return false when the folder cannot be used
    static bool setFull(const QString &name, bool isFull);
    /// Of the bus.
    QString folder() const;

    void close() override;
    int descriptor() const override { return m_socket; }

protected:
    bool join(const Options &options) override;
    int readFrames(CanFrame *frames, int capacity) noexcept override;
    int writeFrames(const CanFrame *frames, int count) noexcept override;

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
        std::atomic<quint32> isFull{0};
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

    bool isFull() const noexcept { return m_board->isFull.load(std::memory_order_relaxed) != 0; }
    bool isUnplugged() const noexcept { return m_board->isUnplugged.load(std::memory_order_relaxed) != 0; }
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
};

}  // namespace qplc
