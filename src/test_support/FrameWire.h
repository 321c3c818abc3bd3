// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SimulatedNetwork.h"
#include "Simulator.h"
#include "transport/SocketAddress.h"

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <unordered_map>
#include <vector>

namespace qplc {

class Fiber;
class FrameEnd;
class FramePort;

/// A frame on its way.
struct SimulatedFrame
{
    quint64 from = 0;  // SocketAddress::key()
    std::vector<char> bytes;
};

/// Carries cyclic frames between the hosts of a simulator, each on its own, as UDP does; or in
/// order and without loss, if one end is reliable.
class FrameWire
{
public:
    explicit FrameWire(Simulator &simulator);
    ~FrameWire();

    /// A port of \a host that nobody has. A kernel may give one again that was closed just before;
    /// this one has so few that it often does.
    quint16 freePort(const SimulatedHost &host);
    /// \a host is gone.
    void removePorts(const SimulatedHost &host);

    void send(FrameEnd &from, quint64 to, const char *bytes, std::size_t size);
    /// From now on what comes from \a from to the open port \a to is for \a reader alone; null: for
    /// the end of the port again.
    using Reader = std::function<void(FrameEnd &end, SimulatedFrame &frame)>;
    void divert(quint64 from, quint64 to, Reader reader);
    /// All ports that are open, in the order of their keys.
    std::vector<const FrameEnd *> ends() const;
    SimulatedFrame &frame(std::size_t number) { return *m_frames[number]; }
    void release(std::size_t number) { m_free.push_back(number); }

private:
    friend class FrameEnd;
    /// When what is sent now arrives [ns of the simulator].
    std::int64_t arrival(FrameEnd &from, const FramePort &to, const SimulatedRoad &road);
    void carry(const FrameEnd &from, const FramePort &to, std::int64_t arrival, const char *bytes, std::size_t size);

    Simulator &m_simulator;
    std::unordered_map<quint64, std::unique_ptr<FramePort>> m_ports;
    std::vector<std::unique_ptr<SimulatedFrame>> m_frames;
    std::vector<std::size_t> m_free;
};

/// A port of a host. What arrives is for the end that is open then, whoever had the port when it
/// was sent.
class FramePort final : public SimulatedTarget
{
public:
    FramePort(SimulatedHost &host, FrameWire &wire);

    SimulatedHost &host() const noexcept { return *m_host; }
    void happen(std::uint32_t what, std::uint64_t data) override;
    bool isOfProgram(std::uint32_t) const override { return false; }

    FrameEnd *end = nullptr;                       // null: closed
    std::map<quint64, FrameWire::Reader> readers;  // by the sender

private:
    FrameWire &m_wire;
};

/// An open port, with the memory that the kernel has for frames that nobody has read yet.
class FrameEnd
{
    friend class FrameWire;

public:
    static constexpr std::size_t MostUnread = 256;  // frames

    FrameEnd(SimulatedHost &host, quint16 port);
    ~FrameEnd();
    FrameEnd(const FrameEnd &) = delete;
    FrameEnd &operator=(const FrameEnd &) = delete;

    quint64 key() const noexcept { return m_key; }
    SimulatedHost &host() const noexcept { return m_host; }
    /// What it sends and receives travels on a stream.
    void becomeReliable() noexcept { m_isReliable = true; }
    bool isReliable() const noexcept { return m_isReliable; }
    bool isEmpty() const noexcept { return m_unread.empty(); }
    /// Readable while a frame is there.
    int descriptor() const noexcept { return m_descriptor; }
    /// The next frame, valid until the next call. Null: there is none.
    const SimulatedFrame *take();
    /// Waits for a frame, at most until \a deadline [ns] of the host. On a fiber; elsewhere it does
    /// not wait.
    void wait(std::int64_t deadline) noexcept;
    void send(quint64 to, const char *bytes, std::size_t size) { m_wire.send(*this, to, bytes, size); }
    /// Frames for which there was no memory.
    std::uint64_t unread() const noexcept { return m_dropped; }

    void arrived(std::size_t number);

private:
    static constexpr std::size_t None = SIZE_MAX;

    SimulatedHost &m_host;
    FrameWire &m_wire;
    const quint64 m_key;
    const int m_descriptor;
    std::deque<std::size_t> m_unread;
    std::unordered_map<const FramePort *, std::int64_t> m_arrivals;  // of the last frame to each port [ns]
    std::size_t m_taken = None;
    Fiber *m_waiting = nullptr;
    std::uint64_t m_dropped = 0;
    bool m_isReliable = false;
};

}  // namespace qplc
