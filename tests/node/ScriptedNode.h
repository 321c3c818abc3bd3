// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../common/Waiting.h"
#include "NodeFixtures.h"
#include "node/security/SealFields.h"
#include "protocol/ControlFrame.h"
#include "protocol/CyclicFrame.h"
#include "protocol/messages/MessageTable.h"
#include "signals/PayloadLayout.h"
#include "transport/TransportRegistry.h"

#include <QtCore/QJsonArray>
#include <QtCore/QSocketNotifier>
#include <QtNetwork/QTcpSocket>

#include <functional>

/// Indices of signals of the test table, in this order.
inline QVector<QPlcSignalIndex> indicesOf(const QPlcSignalTable &table, const QStringList &names)
{
    QVector<QPlcSignalIndex> indices;
    for (const QString &name : names)
        indices << table.indexOf(name);
    return indices;
}

/// A node that speaks the protocol as the test tells it, message by message and frame by frame,
/// against a real master: on the machine, or on a host of a simulator.
class ScriptedNode : public QObject
{
    Q_OBJECT
public:
    struct Request
    {
        QByteArray bytes;
        qplc::FrameStatus status;
        quint8 flags;
        quint64 cycle;
        QByteArray payload;  // newest complete one
    };

    explicit ScriptedNode(const QString &nodeName = QStringLiteral("Scripted"))
        : name(nodeName)
        , uuid(QUuid::createUuid().toString(QUuid::WithoutBraces))
    {
        connect(&control, &QPlcAbstractSocket::messageReceived, this, [this](const QPlcMessage &message) {
            messages << message;
            if (playsAlong)
                playAlong(message);
        });
        connect(&stream, &QTcpSocket::readyRead, this, &ScriptedNode::readStream);
    }

    // ---- what it is; to be set before registerAt() ----
    QString name;
    QString uuid;
    QStringList features;
    QString policy = QStringLiteral("ErrorZeroOrderHold");
    QString cyclic = datagrams();
    bool listener = false;
    bool critical = false;
    int every = 1;  // cycles
    QPlcSignalTable table = testTable();
    QStringList inputs{QStringLiteral("count")};
    QStringList outputs{QStringLiteral("echo")};
    QByteArray initialValues = QByteArray(8, '\0');
    bool playsAlong = true;  // answers initialization and start by itself
    std::function<void(const Request &)> onRequest;
    /// Makes it a listener that writes nothing.
    void onlyListen()
    {
        listener = true;
        outputs.clear();
        initialValues.clear();
    }

    // ---- what came ----
    QPlcMasterSocket control;
    QTcpSocket stream;  // cyclic TCP
    QVector<QPlcMessage> messages;
    QVector<Request> frames;    // all of them
    QVector<Request> requests;  // that became complete: one for each cycle
    QPlcMessage registered;
    quint64 session = 0;

    // ---- control channel ----
    bool connectTo(quint16 port)
    {
        m_port = port;
        control.connectToMaster(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, port));
        return waitUntil([this] { return control.isConnected(); });
    }
    void send(QPlcMessage::Kind kind, const QJsonObject &fields = {})
    {
        control.sendMessage(QPlcMessage(kind, fields));
    }
    /// The next message; of kind Invalid when none comes.
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
    bool waitForMessage(QPlcMessage::Kind kind)
    {
        return waitUntil([&] {
            return std::any_of(messages.begin(), messages.end(),
                               [&](const QPlcMessage &m) { return m.kind() == kind; });
        });
    }
    QJsonObject helloFields() const
    {
        return {{QStringLiteral("protocol"), 2},
                {QStringLiteral("name"), name},
                {QStringLiteral("uuid"), uuid},
                {QStringLiteral("role"), QStringLiteral("node")},
                {QStringLiteral("features"), QJsonArray::fromStringList(features)}};
    }
    QJsonArray describe(const QStringList &names) const
    {
        QJsonArray array;
        for (const QString &signal : names) {
            const QPlcSignalDefinition &definition = table.at(table.indexOf(signal));
            array << QJsonObject{{QStringLiteral("name"), signal},
                                 {QStringLiteral("type"), definition.type.name()},
                                 {QStringLiteral("unit"), definition.unit}};
        }
        return array;
    }
    QJsonObject registerFields()
    {
        if (!m_link)
            beginLink();
        QJsonObject fields = m_linkFields;
        const QJsonObject own{{QStringLiteral("name"), name},
                              {QStringLiteral("uuid"), uuid},
                              {QStringLiteral("policy"), policy},
                              {QStringLiteral("listener"), listener},
                              {QStringLiteral("critical"), critical},
                              {QStringLiteral("every"), every},
                              {QStringLiteral("inputs"), describe(inputs)},
                              {QStringLiteral("outputs"), describe(outputs)},
                              {QStringLiteral("cyclic"), cyclic}};
        for (auto field = own.begin(); field != own.end(); ++field)
            fields.insert(field.key(), field.value());
        return fields;
    }
    /// Greets and registers, and attaches its cyclic channel.
    bool registerAt(quint16 port)
    {
        if (!connectTo(port))
            return false;
        send(QPlcMessage::Hello, helloFields());
        const QPlcMessage hello = next();
        session = hello.hex64(QStringLiteral("session"));
        send(QPlcMessage::Register, registerFields());
        if (hello.kind() != QPlcMessage::Hello || !takeRegistered(next()))
            return false;
        return cyclic == datagrams() ? next().kind() == QPlcMessage::CyclicChannelAttached : attach();
    }
    bool takeRegistered(const QPlcMessage &message)
    {
        registered = message;
        const auto node = quint16(message.fields().value(QStringLiteral("node")).toInt());
        const qplc::PayloadLayout in(table, indicesOf(table, inputs));
        const qplc::PayloadLayout out(table, indicesOf(table, outputs));
        const auto read = qplc::messages::readAs<qplc::messages::Registered>(message);
        const auto keys = read && read->seal ? qplc::sealKeys(*read->seal) : std::nullopt;
        const quint32 longest = qplc::maximumPayload(keys.has_value());
        m_decoder = qplc::FrameDecoder(qplc::FrameKind::Inputs, {session, node, in.hash()}, in.partBorders(longest),
                                       keys ? &keys->inputs : nullptr);
        m_encoder = qplc::FrameEncoder(qplc::FrameKind::Outputs, {session, node, out.hash()}, out.partBorders(longest),
                                       keys ? &keys->outputs : nullptr);
        return message.kind() == QPlcMessage::Registered;
    }
    /// Attaches the cyclic TCP connection with the token given, or that of the registration.
    bool attach(quint64 token = 0)
    {
        stream.connectToHost(QHostAddress::LocalHost, m_port);
        if (!waitUntil([this] { return stream.state() == QAbstractSocket::ConnectedState; }))
            return false;
        stream.write(qplc::encodeControlFrame(
            QPlcMessage(QPlcMessage::AttachCyclicChannel,
                        {{QStringLiteral("node"), registered.fields().value(QStringLiteral("node"))},
                         {QStringLiteral("token"),
                          token ? QPlcMessage::fromHex64(token) : registered.text(QStringLiteral("token"))}})));
        return waitUntil([this] { return m_attachAnswer.kind() != QPlcMessage::Invalid; })
            && m_attachAnswer.kind() == QPlcMessage::CyclicChannelAttached;
    }
    QPlcMessage attachAnswer() const { return m_attachAnswer; }

    // ---- cyclic channel ----
    /// All parts of an answer; \a values are the packed outputs.
    QVector<QByteArray> answerFrames(quint64 cycle, const QByteArray &values, quint8 flags = 0) const
    {
        QVector<QByteArray> parts;
        qplc::FrameHeader header;
        header.flags = flags;
        header.cycle = cycle;
        for (std::size_t part = 0; part < m_encoder.partCount(); ++part) {
            parts << QByteArray(int(m_encoder.partSize(part)), '\0');
            m_encoder.encode(part, header, values.constData(), parts.last().data());
        }
        return parts;
    }
    void answer(quint64 cycle, const QByteArray &values, quint8 flags = 0)
    {
        for (const QByteArray &frame : answerFrames(cycle, values, flags))
            sendFrame(frame);
    }
    void answer(quint64 cycle, double value)
    {
        answer(cycle, QByteArray(reinterpret_cast<const char *>(&value), sizeof value));
    }
    void sendFrame(const QByteArray &frame)
    {
        if (cyclic == datagrams())
            m_link->send(frame.constData(), std::size_t(frame.size()));
        else
            stream.write(frame);
    }
    /// Registers at \a master, which does not listen yet, starts it, and gets the first request.
    bool beginWith(TestMaster &master)
    {
        return master.listen() && registerAt(master.serverPort()) && master.startRealTime() && waitForRequests(1);
    }
    /// Frames of any kind, also those that it was not ready for.
    bool waitForFrames(int count)
    {
        return waitUntil([&] { return frames.size() >= count; });
    }
    bool waitForRequests(int count)
    {
        return waitUntil([&] { return requests.size() >= count; });
    }
    /// Whether a request of this cycle came, again or for the first time.
    bool waitForRequestOf(quint64 cycle, quint8 flags = 0)
    {
        return waitUntil([&] {
            return std::any_of(frames.begin(), frames.end(),
                               [&](const Request &r) { return r.cycle == cycle && r.flags == flags; });
        });
    }
    /// Answers every request at once.
    void answerAll()
    {
        onRequest = [this](const Request &request) {
            if (request.status == qplc::FrameStatus::Complete)
                answer(request.cycle, initialValues);
        };
    }

private:
    void playAlong(const QPlcMessage &message)
    {
        switch (message.kind()) {
        case QPlcMessage::SendYourInitialOutputStates:
            send(QPlcMessage::ReceiveMyInitialOutputStates,
                 {{QStringLiteral("values"), QPlcMessage::fromBytes(initialValues)}});
            break;
        case QPlcMessage::InitializeWithValues:
            send(QPlcMessage::Initialized);
            break;
        case QPlcMessage::RealTimeStarted:
            m_decoder.restart(message.hex64(QStringLiteral("firstCycle")));
            send(QPlcMessage::RealTimeReady);
            break;
        default:
            break;
        }
    }
    void beginLink()
    {
        const qplc::ControlEnds ends{{}, {QHostAddress(QHostAddress::LocalHost), m_port}, session, {}};
        QString error;
        if (!qplc::TransportRegistry::instance().named(datagrams())->beginLink(ends, &m_linkFields, &m_link, &error))
            qFatal("%s", qPrintable(error));
        m_arrival = std::make_unique<QSocketNotifier>(m_link->descriptor(), QSocketNotifier::Read);
        connect(m_arrival.get(), &QSocketNotifier::activated, this, &ScriptedNode::readLink);
    }
    void readLink()
    {
        const char *frame = nullptr;
        for (std::size_t size = 0; m_link->poll(&frame, &size) == qplc::CyclicLink::Received;)
            take(QByteArray(frame, int(size)));
    }
    void readStream()
    {
        m_streamBytes += stream.readAll();
        if (m_attachAnswer.kind() == QPlcMessage::Invalid) {
            m_reader.append(m_streamBytes);
            m_streamBytes.clear();
            if (!m_reader.next(&m_attachAnswer))
                return;
            m_streamBytes = m_reader.takeRest();
        }
        while (m_streamBytes.size() >= int(qplc::CyclicHeaderSize)) {
            const int size = int(m_decoder.frameSize(m_streamBytes.constData()));
            if (size == 0 || m_streamBytes.size() < size)
                return;
            take(m_streamBytes.left(size));
            m_streamBytes.remove(0, size);
        }
    }
    void take(const QByteArray &bytes)
    {
        const qplc::FrameStatus status = m_decoder.decode(bytes.constData(), std::size_t(bytes.size()));
        const quint64 cycle
            = status == qplc::FrameStatus::Complete ? m_decoder.cycle() : quint64(m_decoder.received().cycle);
        const Request request{
            bytes, status, quint8(bytes.size() > 1 ? bytes.at(1) : 0), cycle,
            QByteArray(m_decoder.payload(), int(qplc::PayloadLayout(table, indicesOf(table, inputs)).size()))};
        frames << request;
        if (status == qplc::FrameStatus::Complete)
            requests << request;
        if (onRequest)
            onRequest(request);
    }

    quint16 m_port = 0;
    int m_taken = 0;
    std::unique_ptr<qplc::CyclicLink> m_link;  // null: it has not registered yet
    std::unique_ptr<QSocketNotifier> m_arrival;
    QJsonObject m_linkFields;  // of Register
    QByteArray m_streamBytes;
    qplc::ControlFrameReader m_reader;
    QPlcMessage m_attachAnswer;
    qplc::FrameDecoder m_decoder;
    qplc::FrameEncoder m_encoder;
};

/// A tool: greets, and asks.
class ScriptedTool : public ScriptedNode
{
    Q_OBJECT
public:
    explicit ScriptedTool(const QString &toolName = QStringLiteral("Tool"))
        : ScriptedNode(toolName)
    {
        playsAlong = false;
    }
    bool greetAt(quint16 port)
    {
        if (!connectTo(port))
            return false;
        QJsonObject fields = helloFields();
        fields.insert(QStringLiteral("role"), QStringLiteral("tool"));
        send(QPlcMessage::Hello, fields);
        return next().kind() == QPlcMessage::Hello;
    }
    QPlcMessage ask(QPlcMessage::Kind kind, const QJsonObject &fields = {})
    {
        send(kind, fields);
        return next();
    }
    /// The answer, behind what all are told of the initialization that belongs to it.
    QPlcMessage answerTo(QPlcMessage::Kind kind, const QJsonObject &fields = {})
    {
        QPlcMessage answer = ask(kind, fields);
        while (answer.kind() == QPlcMessage::StatesInitialized)
            answer = next();
        return answer;
    }
};
