// SPDX-License-Identifier: Apache-2.0
#include "ControlClient.h"

#include "TerminalText.h"

#include <QtCore/QDeadlineTimer>
#include <QtCore/QEventLoop>
#include <QtCore/QTimer>
#include <QtCore/QUuid>

namespace tools {

using Message = QPlcMessage;

bool hasCycles(const QString &state)
{
    return state == QLatin1String("RealTime") || state == QLatin1String("WaitingForLateSlaves")
        || state == QLatin1String("SafeStop");
}

ControlClient::ControlClient(std::chrono::milliseconds timeout)
    : m_timeout(timeout)
{
    connect(&m_socket, &QPlcAbstractSocket::connected, this, &ControlClient::greet);
    connect(&m_socket, &QPlcAbstractSocket::messageReceived, this, &ControlClient::receive);
    connect(&m_socket, &QPlcAbstractSocket::errorOccurred, this, [this] { connectionLost(m_socket.errorString()); });
    connect(&m_socket, &QPlcAbstractSocket::disconnected, this,
            [this] { connectionLost(QStringLiteral("the connection was closed")); });
}

bool ControlClient::connectToMaster(const QPlcUnderlyingProtocol &master)
{
    m_address = master.toString().section(QStringLiteral("://"), 1);
    m_socket.connectToMaster(master);
    Message hello;
    if (!waitForMessage(QDeadlineTimer(m_timeout), &hello))
        return false;
    if (hello.kind() == Message::Rejected)
        return setError(Refused,
                        QStringLiteral("the master at %1 refuses: %2")
                            .arg(m_address, printable(hello.text(QStringLiteral("text")))));
    if (hello.kind() != Message::Hello)
        return setError(Unreachable,
                        QStringLiteral("%1 answers with %2 instead of a greeting; is it a QtPLC master?")
                            .arg(m_address, hello.kindName()));
    const int protocol = hello.fields().value(QStringLiteral("protocol")).toInt();
    if (protocol != 1)
        return setError(
            Unreachable,
            QStringLiteral("the master at %1 speaks protocol version %2, this tool version 1; update the older one")
                .arg(m_address)
                .arg(protocol));
    m_hello = hello;
    return true;
}

void ControlClient::greet()
{
    m_socket.sendMessage(Message(Message::Hello,
                                 {{QStringLiteral("protocol"), 1},
                                  {QStringLiteral("name"), QStringLiteral("qtplc")},
                                  {QStringLiteral("uuid"), QUuid::createUuid().toString(QUuid::WithoutBraces)},
                                  {QStringLiteral("role"), QStringLiteral("tool")},
                                  {QStringLiteral("features"), m_features}}));
}

void ControlClient::receive(const Message &message)
{
    switch (message.kind()) {
    case Message::StatesInitialized:
        break;  // for all; who asked gets an answer of its own
    case Message::LeasesChanged:
        Q_EMIT pushed(message);
        break;
    case Message::Events:
        if (message.fields().contains(QStringLiteral("more")))
            m_inbox.append(message);  // an answer
        else
            Q_EMIT pushed(message);
        break;
    case Message::MasterEnds:
        connectionLost(QStringLiteral("the master has ended"));
        break;
    default:
        m_inbox.append(message);
    }
}

void ControlClient::connectionLost(const QString &reason)
{
    if (m_error != NoError || !m_inbox.isEmpty())  // a refusal that came before says more
        return;
    if (m_hello.kind() == Message::Invalid)
        setError(Unreachable,
                 QStringLiteral("cannot reach a master at %1: %2; start the master, or give its address by --master")
                     .arg(m_address, reason));
    else
        setError(Lost, QStringLiteral("lost the master at %1: %2").arg(m_address, reason));
    Q_EMIT lost();
}

bool ControlClient::setError(Error error, const QString &text)
{
    m_error = error;
    m_errorString = text;
    return false;
}

bool ControlClient::waitForMessage(QDeadlineTimer deadline, Message *message)
{
    QEventLoop loop;
    QTimer timer;
    connect(&timer, &QTimer::timeout, &loop, &QEventLoop::quit);
    connect(&m_socket, &QPlcAbstractSocket::messageReceived, &loop, &QEventLoop::quit);
    connect(&m_socket, &QPlcAbstractSocket::errorOccurred, &loop, &QEventLoop::quit);
    connect(&m_socket, &QPlcAbstractSocket::disconnected, &loop, &QEventLoop::quit);
    while (m_inbox.isEmpty() && m_error == NoError && !deadline.hasExpired()) {
        timer.start(int(deadline.remainingTime()) + 1);
        loop.exec();
    }
    if (!m_inbox.isEmpty()) {
        *message = m_inbox.takeFirst();
        return true;
    }
    if (m_error == NoError)
        connectionLost(QStringLiteral("no answer within %1 s").arg(double(m_timeout.count()) * 1e-3));
    return false;
}

bool ControlClient::ask(const Message &request, Message *answer)
{
    if (m_error != NoError)
        return false;
    m_socket.sendMessage(request);
    Message received;
    if (!waitForMessage(QDeadlineTimer(m_timeout), &received))
        return false;
    m_refusal = received.text(QStringLiteral("error"));
    if (received.kind() == Message::Failed || received.kind() == Message::Rejected)
        return setError(Refused,
                        QStringLiteral("the master refuses: %1").arg(printable(received.text(QStringLiteral("text")))));
    if (answer)
        *answer = received;
    return true;
}

bool ControlClient::askFor(Message::Kind request, Message::Kind expected, const QJsonObject &fields, Message *answer)
{
    const bool isAnswered = ask(Message(request, fields), answer);
    const bool isUnknown = m_error == Refused && m_refusal == QLatin1String("MalformedMessage");
    if (isUnknown || (isAnswered && answer->kind() != expected))
        return setError(Refused,
                        QStringLiteral("the master at %1 does not know %2; it is older than this tool: update it")
                            .arg(m_address, Message::kindName(request)));
    return isAnswered;
}

QPlcSignalTable ControlClient::table()
{
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni(m_hello.text(QStringLiteral("table")).toUtf8(), &errors,
                                                           QStringLiteral("table of the master"));
    if (table.isEmpty())
        setError(Lost, QPlcParseError::toString(errors));
    return table;
}

}  // namespace tools
