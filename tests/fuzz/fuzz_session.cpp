// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "MemorySocket.h"
#include "QPlcMasterNode.h"
#include "node/api/QPlcMasterNodePrivate.h"
#include "protocol/ControlFrame.h"
#include "protocol/LittleEndian.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QPointer>

#include <memory>
#include <vector>

namespace {

// The door of a server, which it keeps to itself: an explicit instantiation may name what is
// private.
qplc::MasterDoor &doorOf(qplc::MasterServer &server);
template<qplc::MasterDoor qplc::MasterServer::*Door>
struct Members
{
    friend qplc::MasterDoor &doorOf(qplc::MasterServer &server) { return server.*Door; }
};
template struct Members<&qplc::MasterServer::m_door>;

constexpr char tableText[] = "[tetherSpeed]\ntype = Real\nunit = m/s\nmin = -10\nmax = 10\nsafe = 0\n"
                             "[tetherLength]\ntype = Real64\nunit = m\nmin = 1\ninitial = 1\n"
                             "[position]\ntype = RealTriple\n[mode]\ntype = UInt8\nmax = 3\n"
                             "[title]\ntype = String(5)\n[now]\ntype = DateTime\n[count]\ntype = Int64\n";

/// A master, and strangers that talk to it over connections without a network.
class Session
{
public:
    Session()
        : m_inside(QPlcMasterNodePrivate::of(m_master))
    {
        static const QPlcSignalTable table = QPlcSignalTable::fromIni(tableText);
        m_master.setSignalTable(table);
        m_master.setInterval(std::chrono::seconds(1));
        QString error;
        fuzz::check(m_inside.prepare()
                        && m_inside.hub.open(qplc::SocketAddress(QHostAddress(QHostAddress::LocalHost), 0), &error),
                    "a master can be made");
    }

    ~Session()
    {
        m_master.stop();
        settle();
        fuzz::check(m_master.state() == QPlcMasterNode::Off, "a master that was stopped is off");
        checkNodes();
    }

    /// One record of the input: what happens, to which connection or node, length, bytes.
    void step(fuzz::Input *input)
    {
        const auto what = input->number<std::uint8_t>();
        const auto who = input->number<std::uint8_t>();
        const QByteArray bytes = input->bytes(input->number<std::uint16_t>());
        switch (what % 9) {
        case 0:
            send(who, bytes);
            break;
        case 1:
            arrive(who, bytes);
            break;
        case 2:
            connect();
            break;
        case 3:
            if (MemorySocket *socket = socketOf(who))
                socket->disconnectFromHost();
            break;
        case 4:
            answer(who, bytes);
            break;
        case 5:
            attach();
            break;
        case 6:
            timeOut();
            break;
        case 7:
            become(who);
            break;
        default:
            QCoreApplication::processEvents();
            break;
        }
        settle();
        checkNodes();
    }

private:
    using MemorySocket = fuzz::MemorySocket;

    void connect()
    {
        if (m_sockets.size() >= 16)
            return;
        m_sockets.emplace_back(new MemorySocket);
        Q_EMIT doorOf(m_inside.parts->server).entered(new QPlcSlaveSocket(m_sockets.back()), m_peer, 0);
    }

    /// Who comes next: anybody without security (at first), or somebody known with a role.
    void become(std::uint8_t who)
    {
        m_peer = {};
        m_peer.isSecured = who > 0;
        m_peer.isCyclicOnly = who % 8 == 7;
        m_peer.role = qplc::Role(who / 8 % 4);
        m_peer.mayWriteAll = who < 128;
        m_peer.writes = QStringList{QStringLiteral("tether*")};
        m_peer.identity = who == 0 ? QString() : QStringLiteral("Winch");
    }

    MemorySocket *socketOf(std::size_t who) const
    {
        return m_sockets.empty() ? nullptr : m_sockets[who % m_sockets.size()].data();
    }

    void arrive(std::size_t who, const QByteArray &bytes)
    {
        if (m_sockets.empty())
            connect();
        if (MemorySocket *socket = socketOf(who))
            socket->arrive(bytes);
    }

    /// A control message: kind, body. The length is ours.
    void send(std::size_t who, const QByteArray &kindAndBody)
    {
        QByteArray frame(4, '\0');
        qplc::storeLittle(std::uint32_t(kindAndBody.size()), frame.data());
        arrive(who, frame + kindAndBody);
    }

    /// A cyclic frame of a node: flags, cycle, info, payload as far as it is given. Outside of the
    /// real-time phase, where the cycle thread takes them.
    void answer(std::size_t who, const QByteArray &bytes)
    {
        const auto &nodes = m_inside.parts->registry.nodes();
        const bool isRunning
            = m_master.state() == QPlcMasterNode::RealTime || m_master.state() == QPlcMasterNode::WaitingForLateSlaves;
        if (nodes.empty() || isRunning)
            return;
        qplc::NodeSlot &slot = *nodes[who % nodes.size()];
        fuzz::Input input(reinterpret_cast<const std::uint8_t *>(bytes.constData()), std::size_t(bytes.size()));
        qplc::FrameHeader header;
        header.flags = input.number<std::uint8_t>();
        header.cycle = input.number<std::uint32_t>();
        header.info = input.number<std::uint32_t>();
        const std::size_t size = slot.outputLayout.size();
        const QByteArray payload = input.bytes(size).leftJustified(int(size), '\x7f');
        const qplc::FrameEncoder encoder(qplc::FrameKind::Outputs,
                                         {m_inside.session, slot.id, slot.outputLayout.hash()},
                                         slot.outputLayout.partBorders(qplc::MaximumCyclicPayload));
        std::vector<char> frame(encoder.partSize(0));
        encoder.encode(0, header, payload.constData(), frame.data());
        const qplc::FrameStatus status = slot.decoder.decode(frame.data(), frame.size());
        if (status == qplc::FrameStatus::Complete && slot.outputs.rules.allow(slot.decoder.payload()))
            qplc::copyRuns(slot.outputs.runs, slot.decoder.payload(), m_inside.parts->cycle.image().data());
    }

    /// The cyclic TCP connection of a node that waits for it, with the token that no chance would
    /// find.
    void attach()
    {
        for (const std::unique_ptr<qplc::MasterConnection> &connection : m_inside.parts->server.connections()) {
            if (connection->stage != qplc::MasterConnection::Attaching)
                continue;
            const QJsonObject fields{{QStringLiteral("node"), connection->slot->id},
                                     {QStringLiteral("token"), QPlcMessage::fromHex64(connection->token)}};
            connect();
            if (m_sockets.back())
                m_sockets.back()->arrive(qplc::encodeControlFrame({QPlcMessage::AttachCyclicChannel, fields}));
            return;
        }
    }

    void timeOut()
    {
        if (!m_inside.stepTimer.isActive())
            return;
        m_inside.stepTimer.elapse();
    }

    static void settle()
    {
        QCoreApplication::sendPostedEvents();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }

    void checkNodes() const
    {
        const auto &nodes = m_inside.parts->registry.nodes();
        for (const std::shared_ptr<qplc::NodeSlot> &slot : nodes) {
            fuzz::check(m_inside.parts->server.connectionOf(slot.get()), "every registered node is connected");
            for (const qplc::PayloadLayout::Field &field : slot->outputLayout.fields())
                fuzz::check(m_inside.parts->registry.writer(field.signal) == slot->name, "a node writes its outputs");
        }
        for (const QPlcNodeInfo &info : m_master.nodes())
            fuzz::check(!info.name.isEmpty() && info.id != 0, "every node has a name and a number");
    }

    QPlcMasterNode m_master;
    QPlcMasterNodePrivate &m_inside;
    qplc::Peer m_peer;
    std::vector<QPointer<MemorySocket>> m_sockets;
};

void becomeSilent()
{
    qInstallMessageHandler([](QtMsgType type, const QMessageLogContext &, const QString &text) {
        if (type == QtFatalMsg)
            fprintf(stderr, "%s\n", qPrintable(text));
    });
}

}  // namespace

// Input: records of u8 what, u8 who, u16 length, bytes; see Session::step().
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    static int argc = 1;
    static char name[] = "fuzz_session";
    static char *argv[] = {name, nullptr};
    static const QCoreApplication application(argc, argv);
    static const bool isSilent = (becomeSilent(), true);
    Q_UNUSED(isSilent)

    fuzz::Input input(data, size);
    {
        Session session;
        for (int steps = 0; steps < 64 && !input.atEnd(); ++steps)
            session.step(&input);
    }
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    return 0;
}
