// SPDX-License-Identifier: Apache-2.0
#include "ControlChannel.h"

#include "PlantLeases.h"
#include "node/Logging.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QJsonArray>
#include <QtCore/QTimer>
#include <QtCore/QUuid>

#include <algorithm>

namespace qplc {

namespace {

using Message = QPlcMessage;

qint64 milliseconds()
{
    static const QElapsedTimer clock = [] {
        QElapsedTimer started;
        started.start();
        return started;
    }();
    return clock.elapsed();
}

Message failed(const QString &text)
{
    return Message(Message::Failed,
                   {{QStringLiteral("error"), QStringLiteral("Lost")}, {QStringLiteral("text"), text}});
}

/// What a question is answered with; Done for commands.
Message::Kind answerOf(Message::Kind question)
{
    switch (question) {
    case Message::GetState:
        return Message::State;
    case Message::GetSignals:
        return Message::Signals;
    case Message::GetStatistics:
        return Message::Statistics;
    case Message::GetSchedule:
        return Message::Schedule;
    case Message::GetLeases:
        return Message::Leases;
    case Message::GetEvents:
        return Message::Events;
    case Message::Arm:
        return Message::Armed;
    default:
        return Message::Done;
    }
}

}  // namespace

ControlChannel::ControlChannel(QObject *parent)
    : QObject(parent)
    , m_timer(new QTimer(this))
{
    m_timer->setInterval(250);
    connect(m_timer, &QTimer::timeout, this, &ControlChannel::checkAnswerTimes);
}

ControlChannel::~ControlChannel()
{
    if (m_socket)
        m_socket->disconnect(this);
}

bool ControlChannel::isQuestion(Message::Kind kind)
{
    return answerOf(kind) != Message::Done;
}

void ControlChannel::connectToMaster(const QPlcUnderlyingProtocol &master)
{
    close();
    m_begin = milliseconds();
    m_isRefused = false;
    m_socket = new QPlcMasterSocket(this);
    if (m_security)
        m_socket->setSecurity(*m_security);
    connect(m_socket, &QPlcAbstractSocket::connected, this, [this] {
        m_socket->sendMessage(
            Message(Message::Hello,
                    {{QStringLiteral("protocol"), 1},
                     {QStringLiteral("name"), PlantLeases::whoever()},
                     {QStringLiteral("uuid"), QUuid::createUuid().toString(QUuid::WithoutBraces)},
                     {QStringLiteral("role"), QStringLiteral("tool")},
                     {QStringLiteral("features"), QJsonArray{QStringLiteral("leases"), QStringLiteral("events")}}}));
    });
    connect(m_socket, &QPlcAbstractSocket::messageReceived, this, &ControlChannel::receive);
    connect(m_socket, &QPlcAbstractSocket::errorOccurred, this, [this] { end(m_socket->errorString()); });
    connect(m_socket, &QPlcAbstractSocket::disconnected, this,
            [this] { end(QStringLiteral("the connection was closed")); });
    m_timer->start();
    m_socket->connectToMaster(master);
}

void ControlChannel::close()
{
    m_isGreeted = false;
    m_timer->stop();
    if (m_socket) {
        m_socket->disconnect(this);
        m_socket->abort();
        m_socket->deleteLater();
        m_socket = nullptr;
    }
    const QList<Request> unanswered = m_sent + m_waiting;
    m_sent.clear();
    m_waiting.clear();
    for (const Request &request : unanswered)
        request.handler(failed(QStringLiteral("the master was lost before it answered")));
}

void ControlChannel::end(const QString &reason)
{
    if (!m_socket)
        return;  // an error and its end
    close();
    Q_EMIT lost(reason);
}

void ControlChannel::receive(const Message &message)
{
    switch (message.kind()) {
    case Message::Hello:
        receiveHello(message);
        break;
    case Message::Rejected:
        refuse(message.text(QStringLiteral("error")) == QLatin1String("VersionMismatch")
                   ? QStringLiteral("versions differ: %1; update the older one")
                   : QStringLiteral("the master refuses: %1"),
               message);
        break;
    case Message::MasterEnds:
        end(QStringLiteral("the master has ended"));
        break;
    case Message::State:
    case Message::Signals:
    case Message::Schedule:
    case Message::Statistics:
    case Message::Leases:
    case Message::Armed:
    case Message::Done:
    case Message::Failed:
        answer(message);
        break;
    case Message::Events:
        if (message.fields().contains(QStringLiteral("more")))  // which pushed ones have not
            answer(message);
        else
            Q_EMIT pushed(message);
        break;
    default:
        Q_EMIT pushed(message);
    }
}

void ControlChannel::refuse(const QString &form, const Message &message)
{
    m_isRefused = true;
    end(form.arg(printable(message.text(QStringLiteral("text")))));
}

void ControlChannel::receiveHello(const Message &message)
{
    const int protocol = message.fields().value(QStringLiteral("protocol")).toInt();
    if (protocol != 1) {
        m_isRefused = true;
        end(QStringLiteral("versions differ: the master speaks protocol version %1, this window version 1; update the "
                           "older one")
                .arg(protocol));
        return;
    }
    m_isGreeted = true;
    Q_EMIT greeted(message);
}

/// The request that this kind answers; -1 when there is none. While a command waits for nodes the master answers questions at once, so the order alone does not tell.
int ControlChannel::requestFor(Message::Kind answer) const
{
    const auto fits = [&](const Request &request) {
        return answer == Message::Failed ? request.message.kind() != Message::GetState  // which is never refused
                                         : answerOf(request.message.kind()) == answer;
    };
    const auto found = std::find_if(m_sent.begin(), m_sent.end(), fits);
    return found == m_sent.end() ? -1 : int(found - m_sent.begin());
}

void ControlChannel::answer(const Message &message)
{
    const int place = requestFor(message.kind());
    if (place < 0)
        return;  // unasked: nobody waits for it
    const Handler handler = m_sent.takeAt(place).handler;
    sendNextCommand();
    handler(message);
}

void ControlChannel::ask(const Message &question, const Handler &handler)
{
    if (m_isGreeted)
        send({question, handler});
    else
        handler(failed(QStringLiteral("there is no connection to the master")));
}

void ControlChannel::command(const Message &command, const Handler &handler)
{
    if (!m_isGreeted) {
        handler(failed(QStringLiteral("there is no connection to the master")));
    } else if (command.kind() == Message::Stop || command.kind() == Message::SafeStop) {
        send({command, handler});
    } else {
        m_waiting.enqueue({command, handler});
        sendNextCommand();
    }
}

bool ControlChannel::isBusy() const
{
    return std::any_of(m_sent.begin(), m_sent.end(),
                       [](const Request &request) { return !isQuestion(request.message.kind()); });
}

void ControlChannel::send(const Request &request)
{
    m_sent.enqueue(request);
    m_sent.last().sent = milliseconds();
    if (m_socket->sendMessage(request.message))
        return;
    m_sent.removeLast();
    request.handler(failed(QStringLiteral("the message is too long to be sent")));
}

void ControlChannel::sendNextCommand()
{
    if (!m_waiting.isEmpty() && !isBusy())
        send(m_waiting.dequeue());
}

void ControlChannel::checkAnswerTimes()
{
    const qint64 now = milliseconds();
    const auto isLate = [&](const Request &request) {
        return now - request.sent > (isQuestion(request.message.kind()) ? m_answerTime : CommandTime);
    };
    if ((!m_isGreeted && now - m_begin > m_answerTime) || std::any_of(m_sent.begin(), m_sent.end(), isLate))
        end(QStringLiteral("no answer within %1 s").arg(double(m_answerTime) * 1e-3));
}

}  // namespace qplc
