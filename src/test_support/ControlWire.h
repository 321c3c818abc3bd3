// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Simulator.h"
#include "transport/ControlNetwork.h"

#include <QtCore/QByteArray>

#include <deque>
#include <map>
#include <memory>
#include <utility>

namespace qplc {

class SimulatedPort;
class SimulatedSocket;

/// One end of a control connection, as the kernel of its host has it: bytes arrive whole and in
/// order, later or never.
class ControlEnd final : public SimulatedTarget, public std::enable_shared_from_this<ControlEnd>
{
public:
    static constexpr qint64 Window = 256 * 1024;  // [byte] that the kernels of both ends take

    explicit ControlEnd(SimulatedHost &host);

    // ---- the network ----

    void connectTo(const QHostAddress &address, quint16 port);
    /// Both ends know each other from now on.
    static void join(const std::shared_ptr<ControlEnd> &client, const std::shared_ptr<ControlEnd> &server);

    // ---- the program ----

    void setSocket(SimulatedSocket *socket);
    void write(const char *bytes, qint64 size);
    qint64 read(char *bytes, qint64 most);
    qint64 readable() const { return m_inbox.size(); }
    /// What has arrived; nobody else reads it.
    QByteArray takeUnread() { return std::exchange(m_inbox, {}); }
    qint64 unsent() const { return m_outbox.size(); }
    /// Sends what is left, then the end.
    void close();
    /// At once. Nothing reaches the other end if the host is mute.
    void reset();

    SimulatedHost &host() const noexcept { return *m_host; }
    QHostAddress localAddress() const;
    QHostAddress peerAddress() const { return m_peerAddress; }
    quint16 localPort() const { return m_localPort; }
    quint16 peerPort() const { return m_peerPort; }

    void happen(std::uint32_t what, std::uint64_t data) override;
    bool isOfProgram(std::uint32_t what) const override { return what == Tell || what == TellConnected; }

private:
    enum What : std::uint32_t { Ask, Connected, Refused, Arrived, Taken, Watch, Tell, TellConnected };
    enum class Kind : quint8 { Bytes, Finish, Reset };
    struct Piece
    {
        Kind kind = Kind::Bytes;
        QByteArray bytes;
    };

    std::int64_t travelTime(const ControlEnd &to);
    void ask();
    void send(Piece piece);
    void transmit();
    bool hasRoad() const;
    void watch();
    void arrive();
    void tell();

    std::weak_ptr<ControlEnd> m_other;
    SimulatedSocket *m_socket = nullptr;  // null: none yet, or no more
    QByteArray m_inbox;
    QByteArray m_outbox;
    std::deque<Piece> m_coming;
    std::int64_t m_nextArrival = 0;  // nothing overtakes
    qint64 m_underWay = 0;           // [byte] that the program of the other end has not read yet
    QHostAddress m_peerAddress;
    quint16 m_localPort = 0;
    quint16 m_peerPort = 0;
    bool m_isClosing = false;  // the end follows what is left
    bool m_hasClosed = false;
    bool m_hasFinished = false;  // the other end
    bool m_wasReset = false;     // by the other end
    bool m_wasRefused = false;
    bool m_isSilent = false;           // nothing was heard of the other end for too long
    std::int64_t m_heard = 0;          // when the other end was reached last
    std::deque<Piece> m_stuck;         // behind a road that is cut
    SimulatedHost *m_there = nullptr;  // null: not connected yet
};

/// Control connections between the hosts of a simulator.
class ControlWire
{
public:
    explicit ControlWire(Simulator &simulator);
    ~ControlWire();

    std::unique_ptr<ControlNetwork> networkOf(SimulatedHost &host);
    /// As the kernel of \a host when its program has ended.
    void closeAll(SimulatedHost &host);
    /// The end behind \a descriptor, which has been accepted. Null: there is none.
    std::shared_ptr<ControlEnd> takeAccepted(int descriptor);

private:
    friend class ControlEnd;
    friend class SimulatedPort;
    friend class HostNetwork;

    static std::pair<QString, quint16> place(const QHostAddress &address, quint16 port);
    SimulatedPort *find(const QHostAddress &address, quint16 port) const;
    void remember(const std::shared_ptr<ControlEnd> &end);
    void keep(const std::shared_ptr<ControlEnd> &end) { m_lingering.push_back(end); }
    void release(const ControlEnd *end);

    Simulator &m_simulator;
    std::map<std::pair<QString, quint16>, SimulatedPort *> m_ports;
    std::map<int, std::shared_ptr<ControlEnd>> m_accepted;  // that no socket has taken yet
    std::vector<std::weak_ptr<ControlEnd>> m_ends;
    std::vector<std::shared_ptr<ControlEnd>> m_lingering;  // closed by their program, while bytes are left
};

}  // namespace qplc
