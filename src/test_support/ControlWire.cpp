// SPDX-License-Identifier: Apache-2.0
#include "ControlWire.h"

#include "SimulatedHost.h"
#include "SimulatedSocket.h"
#include "SimulatedTls.h"
#include "transport/LossWatch.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace qplc {

namespace {

constexpr std::int64_t WatchPeriod = 500'000'000;  // [ns]

}  // namespace

/// A port of a host that listens.
class SimulatedPort final : public ControlPort
{
public:
    SimulatedPort(SimulatedHost &host, const QHostAddress &address, quint16 number)
        : m_host(host)
        , m_address(address)
        , m_number(number)
        , m_descriptor(host.simulator().openDescriptor(&host))
    {
        wire().m_ports[ControlWire::place(address, number)] = this;
    }
    ~SimulatedPort() override
    {
        wire().m_ports.erase(ControlWire::place(m_address, m_number));
        for (const std::shared_ptr<ControlEnd> &end : m_waiting)
            end->reset();
        m_host.simulator().closeDescriptor(m_descriptor);
    }
    SimulatedHost &host() const { return m_host; }
    void arrive(const std::shared_ptr<ControlEnd> &end)
    {
        m_waiting.push_back(end);
        m_host.simulator().setReadable(m_descriptor, true);
    }

    int descriptor() const override { return m_descriptor; }
    QHostAddress address() const override { return m_address; }
    quint16 number() const override { return m_number; }
    int accept() override
    {
        if (m_waiting.empty()) {
            errno = EAGAIN;
            return -1;
        }
        const int descriptor = m_host.simulator().openDescriptor(&m_host);
        wire().m_accepted[descriptor] = m_waiting.front();
        m_waiting.pop_front();
        m_host.simulator().setReadable(m_descriptor, !m_waiting.empty());
        return descriptor;
    }

private:
    ControlWire &wire() const { return m_host.simulator().controlWire(); }

    SimulatedHost &m_host;
    const QHostAddress m_address;
    const quint16 m_number;
    const int m_descriptor;
    std::deque<std::shared_ptr<ControlEnd>> m_waiting;
};

/// The ControlWire as one host has it.
class HostNetwork final : public ControlNetwork
{
public:
    HostNetwork(ControlWire &wire, SimulatedHost &host)
        : m_wire(wire)
        , m_host(host)
    {
    }
    QTcpSocket *makeSocket(QObject *parent) override { return new SimulatedSocket(m_host, parent); }
    Tls *makeTls(QObject *parent) override { return new SimulatedTls(m_host, parent); }
    std::unique_ptr<ControlPort> listen(const QHostAddress &address, quint16 port, QAbstractSocket::SocketError *error,
                                        QString *text) override
    {
        if (address != m_host.address()) {
            *error = QAbstractSocket::SocketAddressNotAvailableError;
            *text = QStringLiteral("The address is not available");
            return nullptr;
        }
        const quint16 number = port == 0 ? m_host.newPort() : port;
        if (m_wire.find(address, number)) {
            *error = QAbstractSocket::AddressInUseError;
            *text = QStringLiteral("The bound address is already in use");
            return nullptr;
        }
        return std::make_unique<SimulatedPort>(m_host, address, number);
    }
    QHostAddress peerOf(int descriptor) override
    {
        const auto found = m_wire.m_accepted.find(descriptor);
        return found == m_wire.m_accepted.end() ? QHostAddress() : found->second->peerAddress();
    }
    void close(int descriptor) override
    {
        if (const std::shared_ptr<ControlEnd> end = m_wire.takeAccepted(descriptor))
            end->close();
    }

private:
    ControlWire &m_wire;
    SimulatedHost &m_host;
};

// ---- ControlWire ----

ControlWire::ControlWire(Simulator &simulator)
    : m_simulator(simulator)
{
}

ControlWire::~ControlWire() = default;

std::unique_ptr<ControlNetwork> ControlWire::networkOf(SimulatedHost &host)
{
    return std::make_unique<HostNetwork>(*this, host);
}

std::pair<QString, quint16> ControlWire::place(const QHostAddress &address, quint16 port)
{
    return {address.toString(), port};
}

SimulatedPort *ControlWire::find(const QHostAddress &address, quint16 port) const
{
    const auto found = m_ports.find(place(address, port));
    return found == m_ports.end() ? nullptr : found->second;
}

std::shared_ptr<ControlEnd> ControlWire::takeAccepted(int descriptor)
{
    const auto found = m_accepted.find(descriptor);
    if (found == m_accepted.end())
        return nullptr;
    const std::shared_ptr<ControlEnd> end = found->second;
    m_accepted.erase(found);
    m_simulator.closeDescriptor(descriptor);
    return end;
}

/// \a end lives until the other end has heard of all of it.
void ControlWire::remember(const std::shared_ptr<ControlEnd> &end)
{
    const auto isGone = [](const std::weak_ptr<ControlEnd> &other) { return other.expired(); };
    m_ends.erase(std::remove_if(m_ends.begin(), m_ends.end(), isGone), m_ends.end());
    m_ends.push_back(end);
}

void ControlWire::release(const ControlEnd *end)
{
    const auto isIt = [end](const std::shared_ptr<ControlEnd> &other) { return other.get() == end; };
    m_lingering.erase(std::remove_if(m_lingering.begin(), m_lingering.end(), isIt), m_lingering.end());
}

void ControlWire::closeAll(SimulatedHost &host)
{
    std::vector<std::shared_ptr<ControlEnd>> ends;
    for (const std::weak_ptr<ControlEnd> &weak : m_ends) {
        if (std::shared_ptr<ControlEnd> end = weak.lock(); end && &end->host() == &host)
            ends.push_back(end);
    }
    for (const std::shared_ptr<ControlEnd> &end : ends)
        end->reset();
}

// ---- ControlEnd ----

ControlEnd::ControlEnd(SimulatedHost &host)
    : SimulatedTarget(host.simulator(), &host)
{
}

QHostAddress ControlEnd::localAddress() const
{
    return m_host->address();
}

/// [ns] What is lost is sent again, later and later.
std::int64_t ControlEnd::travelTime(const ControlEnd &to)
{
    constexpr std::int64_t firstRepeat = 200'000'000;  // [ns]
    const SimulatedRoad &road = m_simulator.network().road(host(), to.host());
    std::int64_t time = road.delay + std::int64_t(m_simulator.fate().below(std::uint64_t(road.jitter)));
    for (std::int64_t repeat = firstRepeat; road.loss > 0 && m_simulator.fate().fraction() < road.loss; repeat *= 2)
        time += repeat;
    return time;
}

void ControlEnd::connectTo(const QHostAddress &address, quint16 port)
{
    m_localPort = m_host->newPort();
    m_peerAddress = address;
    m_peerPort = port;
    const SimulatedRoad &road = m_simulator.network().usual;
    m_simulator.schedule(*this, m_simulator.now() + road.delay, Ask);
}

void ControlEnd::join(const std::shared_ptr<ControlEnd> &client, const std::shared_ptr<ControlEnd> &server)
{
    client->m_other = server;
    server->m_other = client;
    server->m_localPort = client->m_peerPort;
    server->m_peerPort = client->m_localPort;
    server->m_peerAddress = client->localAddress();
    for (const auto &[end, there] : {std::pair(client, &server->host()), std::pair(server, &client->host())}) {
        end->m_there = there;
        end->m_heard = end->m_simulator.now();
        end->m_simulator.schedule(*end, end->m_heard + WatchPeriod, Watch);
    }
}

/// The first packet has arrived where it was sent to.
void ControlEnd::ask()
{
    ControlWire &wire = m_simulator.controlWire();
    SimulatedPort *port = wire.find(m_peerAddress, m_peerPort);
    const std::int64_t back = m_simulator.now() + m_simulator.network().usual.delay;
    m_simulator.trace(std::uint64_t(m_simulator.now()));
    if (!port) {
        m_simulator.schedule(*this, back, Refused);
        return;
    }
    if (m_simulator.network().road(host(), port->host()).isCut || port->host().isMute())
        return;
    const auto server = std::make_shared<ControlEnd>(port->host());
    join(shared_from_this(), server);
    wire.remember(shared_from_this());
    wire.remember(server);
    port->arrive(server);
    m_simulator.schedule(*this, back, Connected);
}

void ControlEnd::setSocket(SimulatedSocket *socket)
{
    m_socket = socket;
    if (socket && (!m_inbox.isEmpty() || m_hasFinished || m_wasReset))
        m_simulator.schedule(*this, m_simulator.now(), Tell);
}

// ---- sending ----

void ControlEnd::write(const char *bytes, qint64 size)
{
    m_outbox.append(bytes, int(size));
    transmit();
}

void ControlEnd::transmit()
{
    const std::shared_ptr<ControlEnd> self = shared_from_this();  // it may end here
    while (!m_outbox.isEmpty() && m_underWay < Window) {
        const auto size = int(std::min<qint64>(m_outbox.size(), Window - m_underWay));
        m_underWay += size;
        send({Kind::Bytes, m_outbox.left(size)});
        m_outbox.remove(0, size);
    }
    if (m_isClosing && m_outbox.isEmpty() && !m_hasClosed) {
        m_hasClosed = true;
        send({Kind::Finish, {}});
        m_simulator.controlWire().release(this);
    }
}

/// Whether packets arrive there, and answers here.
bool ControlEnd::hasRoad() const
{
    const SimulatedNetwork &network = m_simulator.network();
    return !host().isMute() && !m_there->isMute() && !network.road(host(), *m_there).isCut
        && !network.road(*m_there, host()).isCut;
}

/// As the kernel does with the options of LossWatch: what is stuck is sent again, and a silent end
/// is given up.
void ControlEnd::watch()
{
    const std::int64_t now = m_simulator.now();
    if (hasRoad()) {
        m_heard = now;
        for (Piece &piece : std::exchange(m_stuck, {}))
            send(std::move(piece));
        m_wasReset = m_wasReset || (m_other.expired() && !m_hasFinished);  // the other end knows nothing of it
    }
    const std::int64_t longest = m_stuck.empty()
        ? (LossWatch::Idle + LossWatch::Probes * LossWatch::Interval) * std::int64_t(1'000'000'000)
        : LossWatch::Unacknowledged * std::int64_t(1'000'000);
    m_isSilent = now - m_heard > longest;
    if (m_isSilent || m_wasReset)
        m_simulator.schedule(*this, now, Tell);
    else
        m_simulator.schedule(*this, now + WatchPeriod, Watch);
}

void ControlEnd::send(Piece piece)
{
    const std::shared_ptr<ControlEnd> other = m_other.lock();
    if (!other || host().isMute())
        return;
    if (!m_stuck.empty() || !hasRoad()) {
        m_stuck.push_back(std::move(piece));
        return;
    }
    other->m_nextArrival = std::max(other->m_nextArrival, m_simulator.now() + travelTime(*other));
    other->m_coming.push_back(std::move(piece));
    m_simulator.schedule(*other, other->m_nextArrival, Arrived);
}

void ControlEnd::close()
{
    if (m_isClosing)
        return;
    m_isClosing = true;
    m_simulator.controlWire().keep(shared_from_this());
    transmit();
}

void ControlEnd::reset()
{
    if (m_hasClosed || m_isClosing)
        return;
    m_isClosing = m_hasClosed = true;
    m_outbox.clear();
    send({Kind::Reset, {}});
}

// ---- receiving ----

qint64 ControlEnd::read(char *bytes, qint64 most)
{
    const auto size = int(std::min<qint64>(most, m_inbox.size()));
    if (size <= 0)
        return 0;
    std::memcpy(bytes, m_inbox.constData(), std::size_t(size));
    m_inbox.remove(0, size);
    const std::shared_ptr<ControlEnd> other = m_other.lock();
    if (other)
        m_simulator.schedule(*other, m_simulator.now() + m_simulator.network().usual.delay, Taken, std::uint64_t(size));
    return size;
}

void ControlEnd::arrive()
{
    const Piece piece = std::move(m_coming.front());
    m_coming.pop_front();
    m_simulator.trace(std::uint64_t(m_simulator.now()));
    m_simulator.trace(piece.bytes.constData(), std::size_t(piece.bytes.size()));
    switch (piece.kind) {
    case Kind::Bytes:
        m_inbox.append(piece.bytes);
        break;
    case Kind::Finish:
        m_hasFinished = true;
        break;
    case Kind::Reset:
        m_wasReset = true;
        break;
    }
    if (m_socket)
        m_simulator.schedule(*this, m_simulator.now(), Tell);
}

/// To the program.
void ControlEnd::tell()
{
    const std::shared_ptr<ControlEnd> self = shared_from_this();
    if (m_socket && !m_inbox.isEmpty())
        m_socket->beReadable();
    if (m_socket && (m_hasFinished || m_wasReset))
        m_socket->beClosed();
    else if (m_socket && m_isSilent)
        m_socket->beGivenUp();
}

void ControlEnd::happen(std::uint32_t what, std::uint64_t data)
{
    const std::shared_ptr<ControlEnd> self = shared_from_this();
    switch (what) {
    case Ask:
        ask();
        break;
    case Connected:
    case Refused:
        m_wasRefused = what == Refused;
        m_simulator.schedule(*this, m_simulator.now(), TellConnected);
        break;
    case TellConnected:
        if (m_socket)
            m_simulator.deliver([this] { m_wasRefused ? m_socket->beRefused() : m_socket->becomeConnected(); });
        break;
    case Arrived:
        arrive();
        break;
    case Taken: {
        m_underWay -= qint64(data);
        const bool wasFull = !m_outbox.isEmpty();
        transmit();
        if (m_socket && wasFull)
            m_simulator.deliver([this, data] { m_socket->beDrained(qint64(data)); });
        break;
    }
    case Watch:
        watch();
        break;
    case Tell:
        m_simulator.deliver([this] { tell(); });
        break;
    default:
        break;
    }
}

}  // namespace qplc
