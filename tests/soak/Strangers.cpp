// SPDX-License-Identifier: Apache-2.0
#include "Strangers.h"

#include "protocol/ControlFrame.h"

#include <QtCore/QJsonArray>
#include <QtCore/QThread>

#include <algorithm>
#include <arpa/inet.h>
#include <cerrno>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace soak {

namespace {

sockaddr_in loopback(quint16 port)
{
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

}  // namespace

QPlcMessage StrangerWords::greeting()
{
    return QPlcMessage(QPlcMessage::Hello,
                       {{QStringLiteral("protocol"), 2},
                        {QStringLiteral("name"), QStringLiteral("Stranger")},
                        {QStringLiteral("uuid"), QStringLiteral("5704ed00-0000-4000-8000-000000000000")},
                        {QStringLiteral("role"), QStringLiteral("tool")},
                        {QStringLiteral("features"), QJsonArray{QStringLiteral("events")}}});
}

QByteArray StrangerWords::randomBytes(int size)
{
    QByteArray bytes(size, '\0');
    for (char &byte : bytes)
        byte = char(m_random());
    return bytes;
}

QByteArray StrangerWords::garbageMessage()
{
    switch (m_random() % 3) {
    case 0:  // longer than a frame may be
        return QByteArray::fromHex("ffffffff") + randomBytes(64);
    case 1:  // of no length
        return QByteArray::fromHex("00000000") + randomBytes(64);
    default:  // a body that is no JSON
        return QByteArray::fromHex("2100000001") + QByteArray(32, '}');
    }
}

Strangers::Strangers(quint64 seed)
    : m_words(seed)
{
}

Strangers::~Strangers()
{
    leave();
}

void Strangers::leave()
{
    for (const int connection : m_connections)
        ::close(connection);
    m_connections.clear();
}

int Strangers::sendDatagrams(quint16 port, int count)
{
    const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const sockaddr_in address = loopback(port);
    int sent = 0;
    for (int i = 0; i < count; ++i) {
        const QByteArray bytes = m_words.randomBytes(int(m_words.number() % 600));
        sent += ::sendto(socket, bytes.constData(), std::size_t(bytes.size()), 0,
                         reinterpret_cast<const sockaddr *>(&address), sizeof address)
                == bytes.size()
            ? 1
            : 0;
        if (i % 10 == 9)
            QThread::msleep(2);
    }
    ::close(socket);
    return sent;
}

/// A connection to this machine; -1: there is none.
int Strangers::connection(quint16 port, int receiveBuffer)
{
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (receiveBuffer > 0)
        ::setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &receiveBuffer, sizeof receiveBuffer);
    const sockaddr_in address = loopback(port);
    pollfd polled{socket, POLLOUT, 0};
    const bool begins
        = ::connect(socket, reinterpret_cast<const sockaddr *>(&address), sizeof address) == 0 || errno == EINPROGRESS;
    if (begins && ::poll(&polled, 1, 1500) == 1 && (polled.revents & (POLLERR | POLLHUP)) == 0) {
        m_connections.push_back(socket);
        return socket;
    }
    ::close(socket);
    return -1;
}

bool Strangers::connectAndSend(quint16 port, const QByteArray &bytes)
{
    const int socket = connection(port);
    if (socket < 0)
        return false;
    if (::send(socket, bytes.constData(), std::size_t(bytes.size()), MSG_NOSIGNAL) == bytes.size())
        return true;
    ::close(socket);
    m_connections.pop_back();
    return false;
}

int Strangers::sendGarbage(quint16 port, int count)
{
    int made = 0;
    for (int i = 0; i < count; ++i)
        made += connectAndSend(port, m_words.garbageMessage()) ? 1 : 0;
    return made;
}

int Strangers::sendCommands(quint16 port, int count)
{
    static const QPlcMessage::Kind commands[]
        = {QPlcMessage::StartRealTime, QPlcMessage::Stop,       QPlcMessage::SafeStop,
           QPlcMessage::Arm,           QPlcMessage::SetSignals, QPlcMessage::Reset};
    int made = 0;
    for (int i = 0; i < count; ++i)
        made += connectAndSend(
                    port,
                    qplc::encodeControlFrame(StrangerWords::greeting())
                        + qplc::encodeControlFrame(QPlcMessage(commands[m_words.number() % std::size(commands)])))
            ? 1
            : 0;
    return made;
}

int Strangers::leaveEnded()
{
    const auto hasEnded = [](int socket) {
        char bytes[1024];
        ssize_t size = 0;
        do
            size = ::recv(socket, bytes, sizeof bytes, MSG_DONTWAIT);
        while (size > 0);
        const bool isOver = size == 0 || (errno != EAGAIN && errno != EINTR);
        if (isOver)
            ::close(socket);
        return isOver;
    };
    const auto open = std::remove_if(m_connections.begin(), m_connections.end(), hasEnded);
    const int ended = int(m_connections.end() - open);
    m_connections.erase(open, m_connections.end());
    return ended;
}

int Strangers::connectOnly(quint16 port, int count)
{
    int made = 0;
    for (int i = 0; i < count; ++i)
        made += connection(port) >= 0 ? 1 : 0;
    return made;
}

int Strangers::askWithoutReading(quint16 port, int count)
{
    const int socket = connection(port, 4096);
    if (socket < 0)
        return 0;
    const auto send = [socket](const QPlcMessage &message) {
        const QByteArray frame = qplc::encodeControlFrame(message);
        return ::send(socket, frame.constData(), std::size_t(frame.size()), MSG_NOSIGNAL) == frame.size();
    };
    send(StrangerWords::greeting());
    int asked = 0;
    while (asked < count && send(QPlcMessage(QPlcMessage::GetSignals)))
        ++asked;
    return asked;
}

}  // namespace soak
