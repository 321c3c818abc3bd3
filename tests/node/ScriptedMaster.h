// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../common/Waiting.h"
#include "NodeFixtures.h"
#include "node/security/Handshake.h"
#include "protocol/CyclicFrame.h"
#include "signals/PayloadLayout.h"

#include <QtCore/QJsonArray>
#include <QtNetwork/QTcpServer>
#include <QtNetwork/QTcpSocket>
#include <QtNetwork/QUdpSocket>

#include <unistd.h>

/// A master that speaks the protocol as the test tells it, message by message and frame by frame,
/// to one real node.
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
        m_server.listen(QHostAddress::LocalHost, 0);
        m_udp.bind(QHostAddress::LocalHost, m_server.serverPort());
        connect(&m_server, &QTcpServer::newConnection, this, &ScriptedMaster::accept);
        connect(&m_udp, &QUdpSocket::readyRead, this, &ScriptedMaster::readDatagrams);
    }

    const QPlcSignalTable table;
    QPlcSlaveSocket *control = nullptr;
    QTcpSocket *stream = nullptr;   // cyclic TCP
    QVector<QPlcMessage> messages;  // of all connections
    QVector<Answer> answers;
    quint64 first = 100;  // number on the wire of cycle 0

    QPlcUnderlyingProtocol udp() const
    {
        return QPlcUnderlyingProtocol::udp(QHostAddress::LocalHost, m_server.serverPort());
    }
    QPlcUnderlyingProtocol tcp() const
    {
        return QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, m_server.serverPort());
    }

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
        return {{QStringLiteral("protocol"), 1},
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
        m_peerPort = quint16(message.fields().value(QStringLiteral("udpPort")).toInt());
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
        if (address.kind() == QPlcUnderlyingProtocol::Udp)
            send(QPlcMessage::CyclicChannelAttached);
        else if (next().kind() != QPlcMessage::AttachCyclicChannel)
            return false;
        return waitUntil([&] { return node.state() == QPlcSlaveNode::Off; }, 5000);
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
    /// Admits \a node over UDP, and starts it in lockstep.
    bool beginWith(QPlcSlaveNode &node) { return admit(node, udp()) && start(QStringLiteral("Lockstep")); }

    // ---- cyclic channel ----
    quint32 inputSize() const { return m_in.size(); }
    QVector<QByteArray> requestFrames(quint64 cycle, const QByteArray &values, quint8 flags = 0) const
    {
        QVector<QByteArray> frames;
        qplc::FrameHeader header;
        header.flags = flags;
        header.cycle = quint32(first + cycle);
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
        if (stream)
            stream->write(frame);
        else
            m_udp.writeDatagram(frame, QHostAddress::LocalHost, m_peerPort);
        if (stream)
            stream->flush();
    }
    bool waitForAnswers(int count)
    {
        return waitUntil([&] { return answers.size() >= count; }, 5000);
    }

private:
    qplc::PayloadLayout layoutOf(const QJsonArray &array) const
    {
        QVector<QPlcSignalIndex> indices;
        for (const QJsonValue &signal : array)
            indices << table.indexOf(signal.toObject().value(QStringLiteral("name")).toString());
        return qplc::PayloadLayout(table, indices);
    }
    void accept()
    {
        QTcpSocket *newcomer = m_server.nextPendingConnection();
        if (m_security.isNone() || control) {  // the cyclic connection has no TLS
            take(new QPlcSlaveSocket(newcomer, this));
            return;
        }
        auto *handshake = new qplc::Handshake(::dup(int(newcomer->socketDescriptor())), m_security, this);
        delete newcomer;
        connect(handshake, &qplc::Handshake::succeeded, this,
                [this, handshake] { take(new QPlcSlaveSocket(handshake->takeSocket(), this)); });
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
    void readDatagrams()
    {
        while (m_udp.hasPendingDatagrams()) {
            QByteArray bytes(int(m_udp.pendingDatagramSize()), '\0');
            m_udp.readDatagram(bytes.data(), bytes.size());
            take(bytes);
        }
    }
    void take(const QByteArray &bytes)
    {
        const qplc::FrameStatus status = m_decoder.decode(bytes.constData(), std::size_t(bytes.size()));
        answers << Answer{bytes, status, quint8(bytes.at(1)), quint32(m_decoder.received().cycle) - first,
                          QByteArray(m_decoder.payload(), int(m_out.size()))};
    }

    QPlcSecurity m_security;
    int m_taken = 0;
    quint16 m_peerPort = 0;
    QTcpServer m_server;
    QUdpSocket m_udp;
    QByteArray m_streamBytes;
    qplc::PayloadLayout m_in;
    qplc::PayloadLayout m_out;
    qplc::FrameEncoder m_encoder;
    qplc::FrameDecoder m_decoder;
};
