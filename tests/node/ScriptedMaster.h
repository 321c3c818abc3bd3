// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../common/Waiting.h"
#include "NodeFixtures.h"
#include "node/security/Handshake.h"
#include "protocol/CyclicFrame.h"
#include "signals/PayloadLayout.h"
#include "transport/ControlListener.h"
#include "transport/CyclicHub.h"
#include "transport/TransportRegistry.h"

#include <QtCore/QJsonArray>
#include <QtNetwork/QTcpSocket>

/// A master that speaks the protocol as the test tells it, message by message and frame by frame,
/// to one real node: on the machine, or on a host of a simulator.
class ScriptedMaster : public QObject
{
    Q_OBJECT
public:
    struct Answer
    {
        QByteArray bytes;
        qplc::FrameStatus status;
        quint8 flags;
        quint64 cycle;
        QByteArray payload;
    };

    static constexpr quint64 Session = 0x8f3a61c2d4e5b097;
    static constexpr quint64 Token = 0x0123456789abcdef;
    static constexpr int Node = 7;

    explicit ScriptedMaster(const QPlcSignalTable &signalTable = testTable())
        : table(signalTable)
    {
        QString error;
        if (!listen(&error))
            qFatal("%s", qPrintable(m_listener.errorString() + error));
        connect(&m_listener, &qplc::ControlListener::arrived, this, &ScriptedMaster::accept);
        connect(&m_look, &QTimer::timeout, this, &ScriptedMaster::readHub);
        m_look.start(1);
    }
    ~ScriptedMaster() override
    {
        if (m_peer)
            m_hub.detach(m_peer.get());
    }

    const QPlcSignalTable table;
    QPlcSlaveSocket *control = nullptr;
    QTcpSocket *stream = nullptr;   // cyclic TCP
    QVector<QPlcMessage> messages;  // of all connections
    QVector<Answer> answers;
    quint64 first = 100;  // number on the wire of cycle 0
    quint16 before = 0;   // of its frames: cycles that it has not sent

    /// Where frames travel one by one.
    QPlcUnderlyingProtocol place() const { return over(datagrams()); }
    QPlcUnderlyingProtocol over(const QString &kind) const
    {
        return QPlcUnderlyingProtocol::fromString(QStringLiteral("%1://127.0.0.1:%2").arg(kind).arg(m_listener.port()));
    }
    QPlcUnderlyingProtocol udp() const { return over(QStringLiteral("udp")); }
    QPlcUnderlyingProtocol tcp() const { return over(QStringLiteral("tcp")); }

    /// Nodes come over TLS from now on.
    void setSecurity(const QPlcSecurity &security) { m_security = security; }

    // ---- control channel ----
    void send(QPlcMessage::Kind kind, const QJsonObject &fields = {})
    {
        control->sendMessage(QPlcMessage(kind, fields));
    }
    QPlcMessage next(int timeout = 5000)
    {
        (void)waitUntil([this] { return m_taken < messages.size(); }, timeout);
        return m_taken < messages.size() ? messages.at(m_taken++) : QPlcMessage();
    }
    void forgetMessages()
    {
        messages.clear();
        m_taken = 0;
    }
    QJsonObject helloFields() const
    {
        return {{QStringLiteral("protocol"), 2},
                {QStringLiteral("name"), QStringLiteral("Master")},
                {QStringLiteral("session"), QPlcMessage::fromHex64(Session)},
                {QStringLiteral("table"), QString::fromUtf8(table.toIni())}};
    }
    QJsonObject registeredFields(const QPlcMessage &message)
    {
        m_in = layoutOf(message.fields().value(QStringLiteral("inputs")).toArray());
        m_out = layoutOf(message.fields().value(QStringLiteral("outputs")).toArray());
        m_encoder = qplc::FrameEncoder(qplc::FrameKind::Inputs, {Session, Node, m_in.hash()},
                                       m_in.partBorders(qplc::MaximumCyclicPayload));
        m_decoder = qplc::FrameDecoder(qplc::FrameKind::Outputs, {Session, Node, m_out.hash()},
                                       m_out.partBorders(qplc::MaximumCyclicPayload));
        attachPeer(message);
        return {{QStringLiteral("node"), Node},
                {QStringLiteral("inputsHash"), QPlcMessage::fromHex64(m_in.hash())},
                {QStringLiteral("outputsHash"), QPlcMessage::fromHex64(m_out.hash())},
                {QStringLiteral("token"), QPlcMessage::fromHex64(Token)}};
    }
    /// Connects \a node to this master, and plays the whole registration.
    bool admit(QPlcSlaveNode &node, const QPlcUnderlyingProtocol &address)
    {
        node.connectToMaster(address);
        if (next().kind() != QPlcMessage::Hello)
            return false;
        send(QPlcMessage::Hello, helloFields());
        const QPlcMessage request = next();
        send(QPlcMessage::Registered, registeredFields(request));
        if (address.kindName() == datagrams())
            send(QPlcMessage::CyclicChannelAttached);
        else if (next().kind() != QPlcMessage::AttachCyclicChannel)
            return false;
        return waitUntil([&] { return node.state() == QPlcSlaveNode::Off; });
    }
    QJsonObject startFields(const QString &clock = QStringLiteral("RealTime"), qint64 period = 10'000'000) const
    {
        return {{QStringLiteral("period"), double(period)},
                {QStringLiteral("clock"), clock},
                {QStringLiteral("scale"), clock == QLatin1String("Lockstep") ? 0.0 : 1.0},
                {QStringLiteral("cycleZero"), QPlcMessage::fromHex64(first)},
                {QStringLiteral("firstCycle"), QPlcMessage::fromHex64(first)}};
    }
    bool start(const QString &clock = QStringLiteral("RealTime"), qint64 period = 10'000'000)
    {
        return startWith(startFields(clock, period));
    }
    bool startWith(const QJsonObject &fields)
    {
        m_decoder.restart(first);
        send(QPlcMessage::RealTimeStarted, fields);
        return next().kind() == QPlcMessage::RealTimeReady;
    }
    /// Admits \a node, and starts it in lockstep.
    bool beginWith(QPlcSlaveNode &node) { return admit(node, place()) && start(QStringLiteral("Lockstep")); }

    // ---- cyclic channel ----
    quint32 inputSize() const { return m_in.size(); }
    QVector<QByteArray> requestFrames(quint64 cycle, const QByteArray &values, quint8 flags = 0) const
    {
        QVector<QByteArray> frames;
        qplc::FrameHeader header;
        header.flags = flags;
        header.cycle = quint32(first + cycle);
        header.before = before;
        for (std::size_t part = 0; part < m_encoder.partCount(); ++part) {
            frames << QByteArray(int(m_encoder.partSize(part)), '\0');
            m_encoder.encode(part, header, values.constData(), frames.last().data());
        }
        return frames;
    }
    /// Asks for cycle \a cycle of the phase.
    void request(quint64 cycle, const QByteArray &values, quint8 flags = 0)
    {
        for (const QByteArray &frame : requestFrames(cycle, values, flags))
            sendFrame(frame);
    }
    void request(quint64 cycle, quint8 flags = 0) { request(cycle, QByteArray(int(m_in.size()), '\0'), flags); }
    void sendFrame(const QByteArray &frame)
    {
        if (stream) {
            stream->write(frame);
            stream->flush();
            return;
        }
        m_hub.send(m_peer.get(), frame.constData(), std::size_t(frame.size()));
        m_hub.flush();
    }
    bool waitForAnswers(int count)
    {
        return waitUntil([&] { return answers.size() >= count; });
    }

private:
    /// On a port that is free for both: a free one of TCP may be taken on UDP.
    bool listen(QString *error)
    {
        for (int attempts = 16; attempts > 0 && m_listener.listen(QHostAddress::LocalHost, 0); --attempts) {
            if (m_hub.open({m_listener.address(), m_listener.port()}, error))
                return true;
            m_listener.close();
        }
        return false;
    }
    qplc::PayloadLayout layoutOf(const QJsonArray &array) const
    {
        QVector<QPlcSignalIndex> indices;
        for (const QJsonValue &signal : array)
            indices << table.indexOf(signal.toObject().value(QStringLiteral("name")).toString());
        return qplc::PayloadLayout(table, indices);
    }
    void accept()
    {
        auto *handshake = new qplc::Handshake(m_listener.take(), m_security, this);
        connect(handshake, &qplc::Handshake::tlsWanted, handshake, &qplc::Handshake::beginTls);
        connect(handshake, &qplc::Handshake::succeeded, this, [this, handshake] {
            take(new QPlcSlaveSocket(handshake->takeSocket(), this));
            handshake->deleteLater();
        });
    }
    /// The node that has sent \a message, its Register, has a link whose frames travel one by one.
    void attachPeer(const QPlcMessage &message)
    {
        const auto *kind = qplc::TransportRegistry::instance().named(datagrams());
        const qplc::Newcomer node{{}, QHostAddress(QHostAddress::LocalHost), false, false, 1, message.fields(), {}};
        if (m_peer)
            m_hub.detach(m_peer.get());
        m_peer = kind->makePeer(m_hub, node, nullptr, nullptr);
        m_hub.attach(m_peer.get());
    }
    void take(QPlcSlaveSocket *socket)
    {
        if (!control)
            control = socket;
        connect(socket, &QPlcAbstractSocket::messageReceived, this, [this, socket](const QPlcMessage &message) {
            messages << message;
            if (message.kind() != QPlcMessage::AttachCyclicChannel)
                return;
            socket->sendMessage(QPlcMessage::CyclicChannelAttached);
            stream = new QTcpSocket(this);
            stream->setSocketDescriptor(socket->takeDescriptor());
            connect(stream, &QTcpSocket::readyRead, this, &ScriptedMaster::readStream);
        });
    }
    void readStream()
    {
        m_streamBytes += stream->readAll();
        while (m_streamBytes.size() >= int(qplc::CyclicHeaderSize)) {
            const int size = int(m_decoder.frameSize(m_streamBytes.constData()));
            if (size == 0 || m_streamBytes.size() < size)
                return;
            take(m_streamBytes.left(size));
            m_streamBytes.remove(0, size);
        }
    }
    void readHub()
    {
        qplc::HubFrame frame;
        (void)m_hub.wait(0);
        while (m_hub.next(&frame))
            take(QByteArray(frame.bytes, int(frame.size)));
    }
    void take(const QByteArray &bytes)
    {
        const qplc::FrameStatus status = m_decoder.decode(bytes.constData(), std::size_t(bytes.size()));
        answers << Answer{bytes, status, quint8(bytes.at(1)), quint32(m_decoder.received().cycle) - first,
                          QByteArray(m_decoder.payload(), int(m_out.size()))};
    }

    QPlcSecurity m_security;
    int m_taken = 0;
    qplc::ControlListener m_listener;
    qplc::CyclicHub m_hub;
    std::unique_ptr<qplc::HubPeer> m_peer;  // null: nobody has registered, or over a stream
    QTimer m_look;
    QByteArray m_streamBytes;
    qplc::PayloadLayout m_in;
    qplc::PayloadLayout m_out;
    qplc::FrameEncoder m_encoder;
    qplc::FrameDecoder m_decoder;
};
