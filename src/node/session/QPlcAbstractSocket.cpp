// SPDX-License-Identifier: Apache-2.0
#include "QPlcAbstractSocket.h"

#include "PacedReading.h"
#include "node/Logging.h"
#include "protocol/ControlFrame.h"
#include "transport/LossWatch.h"
#include "transport/Tls.h"

#include <QtCore/QPointer>
#include <QtNetwork/QTcpSocket>

#include <algorithm>
#include <deque>
#include <fcntl.h>
#include <functional>

namespace {

constexpr qint64 MostUnread
    = 1 << 20;  // [byte] that the other end has not taken in; then its requests wait, most of them with it
constexpr qint64 MostBuffered = 1 << 16;  // [byte] of them that wait here
constexpr qint64 MostCopied = 1 << 16;    // [byte] of what is sent that each socket keeps for itself

/// For the debug log. What is encrypted for the wire may hold keys: it stays secret here, too.
QString shown(const QByteArray &frame, bool isSecured)
{
    return isSecured ? QStringLiteral("%1 bytes").arg(frame.size()) : QString::fromLatin1(frame.toHex(' '));
}

/// What the socket has not got yet. It copies what it gets: however slowly the other ends read,
/// connections that send the same bytes share them here.
class Unsent
{
public:
    void append(const QByteArray &bytes)
    {
        if (bytes.isEmpty())
            return;
        m_parts.push_back(bytes);
        m_size += bytes.size();
    }
    void clear()
    {
        m_parts.clear();
        m_size = 0;
        m_begin = 0;
    }
    qint64 size() const { return m_size; }  // [byte]
    /// Gives \a socket some of it, at most \a bytes. \return false if it does not take them
    /// \pre size() > 0
    bool give(QTcpSocket *socket, qint64 bytes)
    {
        const QByteArray &part = m_parts.front();
        const int given = int(std::min<qint64>(bytes, part.size() - m_begin));
        if (socket->write(part.constData() + m_begin, given) != given)
            return false;
        m_size -= given;
        m_begin += given;
        if (m_begin == part.size()) {
            m_parts.pop_front();
            m_begin = 0;
        }
        return true;
    }

private:
    std::deque<QByteArray> m_parts;
    int m_begin = 0;    // [byte] of the first part: what is before it is given
    qint64 m_size = 0;  // [byte]
};

}  // namespace

struct QPlcAbstractSocket::Private
{
    QTcpSocket *socket = nullptr;
    qplc::Tls *tls = nullptr;  // of the socket, when it is or will be encrypted, or comes from a master with security
    qplc::ControlFrameReader reader;
    quint32 sendLimit = qplc::UsualControlFrame;  // [byte]
    Unsent unsent;
    bool isSending = false;
    bool isClosing = false;               // when all is sent
    bool isPaused = false;                // the other end takes nothing in
    std::function<void()> onArrival;      // null: messages are given away as they come
    std::function<bool(quint32)> admits;  // whether a long message may go on arriving; null: always
    Error error = NoError;
    QString errorString;

    /// Whether the message that is not complete yet may take more memory.
    bool mayReadMore() const
    {
        const quint32 length = reader.announced();
        return length <= qplc::UsualControlFrame || !admits || reader.error() || admits(length);
    }
    qint64 bytesInSocket() const { return socket->bytesToWrite() + (tls ? tls->encryptedBytesToWrite() : 0); }
    /// Gives the socket as much as it may copy. \return false if it takes nothing
    bool giveUnsent()
    {
        bool isTaken = true;
        while (isTaken && unsent.size() > 0 && bytesInSocket() < MostCopied)
            isTaken = unsent.give(socket, MostCopied - bytesInSocket());
        if (isClosing && unsent.size() == 0) {
            isClosing = false;
            socket->disconnectFromHost();
        }
        return isTaken;
    }
    void forgetUnsent()
    {
        unsent.clear();
        isClosing = false;
    }
    /// Sends \a frame, and \a end behind it.
    bool send(QPlcAbstractSocket *owner, QPlcMessage::Kind kind, const QByteArray &frame, const QByteArray &end = {})
    {
        if (frame.isEmpty()) {
            qCWarning(lcControl).noquote()
                << QPlcMessage::kindName(kind) << "for" << owner->peerName() << "is too long or too deep to be sent";
            return false;
        }
        qCDebug(lcControl).noquote() << "to" << owner->peerName() << QPlcMessage::kindName(kind)
                                     << shown(frame + end, owner->isSecured());
        unsent.append(frame);
        unsent.append(end);
        return sendUnsent(owner);
    }
    /// As much as the other end takes at once. \return false if the socket takes nothing
    bool sendUnsent(QPlcAbstractSocket *owner)
    {
        const QPointer<QPlcAbstractSocket> self(owner);  // who hears of an error may delete it
        isSending = true;
        bool isTaken = giveUnsent();
        while (self && socket->flush() && self && isTaken && unsent.size() > 0)
            isTaken = giveUnsent();
        if (self)
            isSending = false;
        return isTaken;
    }
    void readMore()
    {
        if (socket->isOpen())  // who got a message may have ended the connection, or taken it
            reader.append(socket->readAll());
    }
    /// Nobody knows where the next message begins.
    void endStream(QPlcAbstractSocket *owner) const
    {
        const QPointer<QPlcAbstractSocket> self(owner);
        owner->setError(ProtocolError,
                        QStringLiteral("%1 sent bytes that are not a QtPLC message: %2")
                            .arg(owner->peerName(), reader.errorString()));
        if (self)
            owner->abort();
    }
};

namespace {

QPlcAbstractSocket::Error errorOf(QAbstractSocket::SocketError error)
{
    switch (error) {
    case QAbstractSocket::HostNotFoundError:
        return QPlcAbstractSocket::HostNotFoundError;
    case QAbstractSocket::ConnectionRefusedError:
        return QPlcAbstractSocket::ConnectionRefusedError;
    case QAbstractSocket::SocketTimeoutError:
        return QPlcAbstractSocket::TimeoutError;
    case QAbstractSocket::RemoteHostClosedError:
        return QPlcAbstractSocket::ConnectionLostError;
    default:
        return QPlcAbstractSocket::NetworkError;
    }
}

/// What a control connection needs of its socket. Before it is connected there is nothing to set.
void setControlOptions(QTcpSocket *socket)
{
    socket->setSocketOption(QAbstractSocket::LowDelayOption, 1);
    qplc::LossWatch::begin(int(socket->socketDescriptor()));
}

}  // namespace

QPlcAbstractSocket::QPlcAbstractSocket(QTcpSocket *socket, QObject *parent)
    : QObject(parent)
    , d(std::make_unique<Private>())
{
    qRegisterMetaType<QPlcAbstractSocket::Error>("QPlcAbstractSocket::Error");
    qRegisterMetaType<QPlcMessage>("QPlcMessage");
    setSocket(socket);
    if (socket->bytesAvailable() > 0)  // of a connection that was accepted by others
        QMetaObject::invokeMethod(this, &QPlcAbstractSocket::readMessages, Qt::QueuedConnection);
}

void QPlcAbstractSocket::setSocket(QTcpSocket *socket)
{
    if (d->socket) {
        d->socket->disconnect(this);
        d->socket->deleteLater();
    }
    d->socket = socket;
    d->tls = qplc::Tls::of(socket);
    d->reader = qplc::ControlFrameReader();
    d->sendLimit = qplc::UsualControlFrame;
    d->forgetUnsent();
    socket->setParent(this);
    setControlOptions(socket);
    const auto nowConnected = [this] {
        setControlOptions(d->socket);
        Q_EMIT connected();
    };
    if (d->tls)
        connect(d->tls, &qplc::Tls::encrypted, this, nowConnected);
    else
        connect(socket, &QTcpSocket::connected, this, nowConnected);
    connect(socket, &QTcpSocket::disconnected, this, [this] {
        d->forgetUnsent();
        Q_EMIT disconnected();
    });
    connect(socket, &QTcpSocket::readyRead, this, &QPlcAbstractSocket::readMessages);
    const auto goOn = [this] {
        if (d->isPaused && bytesToSend() <= MostUnread)  // not at once: who sends may be in the middle of a message
            QMetaObject::invokeMethod(this, &QPlcAbstractSocket::readMessages, Qt::QueuedConnection);
        d->giveUnsent();
    };
    connect(socket, &QTcpSocket::bytesWritten, this, goOn);
    if (d->tls)  // which counts as written what it has encrypted
        connect(d->tls, &qplc::Tls::encryptedBytesWritten, this, goOn);
    socket->setReadBufferSize(MostBuffered);
    connect(socket, &QTcpSocket::errorOccurred, this, &QPlcAbstractSocket::readError);
}

QPlcAbstractSocket::~QPlcAbstractSocket()
{
    d->socket->disconnect(this);
}

QTcpSocket *QPlcAbstractSocket::socket() const
{
    return d->socket;
}

bool QPlcAbstractSocket::isConnected() const
{
    return d->socket->state() == QAbstractSocket::ConnectedState && !d->isClosing
        && !(d->tls && d->tls->isHandshaking());
}

bool QPlcAbstractSocket::isSecured() const
{
    return isConnected() && d->tls && d->tls->isEncrypted();
}

void QPlcAbstractSocket::setMessageLimit(quint32 bytes)
{
    d->reader.setLimit(bytes);
}

void QPlcAbstractSocket::setSendLimit(quint32 bytes)
{
    d->sendLimit = bytes;
}

bool QPlcAbstractSocket::sendMessage(const QPlcMessage &message)
{
    if (!isConnected())
        return false;
    return sendFrame(qplc::encodeControlFrame(message, d->sendLimit), message.kind());
}

bool QPlcAbstractSocket::sendFrame(const QByteArray &frame, QPlcMessage::Kind kind)
{
    return d->send(this, kind, frame);
}

qint64 QPlcAbstractSocket::bytesToSend() const
{
    return d->unsent.size() + d->bytesInSocket();
}

void QPlcAbstractSocket::close()
{
    d->isClosing = true;
    d->sendUnsent(this);
}

void QPlcAbstractSocket::abort()
{
    d->forgetUnsent();
    d->socket->abort();
}

QHostAddress QPlcAbstractSocket::localAddress() const
{
    return d->socket->localAddress();
}

quint16 QPlcAbstractSocket::localPort() const
{
    return d->socket->localPort();
}

QHostAddress QPlcAbstractSocket::peerAddress() const
{
    return d->socket->peerAddress();
}

quint16 QPlcAbstractSocket::peerPort() const
{
    return d->socket->peerPort();
}

QString QPlcAbstractSocket::peerName() const
{
    return QStringLiteral("%1:%2").arg(peerAddress().toString()).arg(peerPort());
}

QPlcAbstractSocket::Error QPlcAbstractSocket::error() const
{
    return d->error;
}

QString QPlcAbstractSocket::errorString() const
{
    return d->errorString;
}

int QPlcAbstractSocket::takeDescriptor()
{
    if (!isConnected())
        return -1;
    const int descriptor = ::fcntl(int(d->socket->socketDescriptor()), F_DUPFD_CLOEXEC, 0);
    qplc::LossWatch::end(descriptor);  // a node that is stopped takes no frames: it is late, and not lost
    d->socket->disconnect(this);
    d->socket->abort();  // closes the other descriptor; the connection lives on in the duplicate
    return descriptor;
}

void QPlcAbstractSocket::setError(Error error, const QString &text)
{
    d->error = error;
    d->errorString = text;
    Q_EMIT errorOccurred(error);
}

void QPlcAbstractSocket::readError()
{
    const QString text = securityErrorText();
    if (text.isEmpty())
        setError(errorOf(d->socket->error()), d->socket->errorString());
    else
        setError(SecurityError, text);
}

void QPlcAbstractSocket::readMessages()
{
    if (d->isSending) {
        // TLS reads when it writes. Messages that came between two sends of somebody who walks over
        // connections would surprise him, and answers to answers would fill the stack.
        QMetaObject::invokeMethod(this, &QPlcAbstractSocket::readMessages, Qt::QueuedConnection);
        return;
    }
    if (d->onArrival) {
        d->onArrival();
        return;
    }
    const QPointer<QPlcAbstractSocket> self(this);  // who receives a message may delete us
    while (readMessage() && self) {}
}

/// \return whether there was a message: then this object may have been deleted
bool QPlcAbstractSocket::readMessage()
{
    QPlcMessage message;
    d->isPaused = bytesToSend() > MostUnread;
    if (d->isPaused)
        return false;
    if (d->reader.next(&message) || (d->mayReadMore() && (d->readMore(), d->reader.next(&message)))) {
        qCDebug(lcControl).noquote() << "from" << peerName() << message.kindName()
                                     << shown(d->reader.lastFrame(), isSecured());
        Q_EMIT messageReceived(message);
        return true;
    }
    if (d->reader.error() != qplc::ControlFrameReader::NoError)
        d->endStream(this);
    return false;
}

// ---- read by a master, in turns ----

namespace qplc {

void PacedReading::begin(QPlcAbstractSocket &socket, std::function<void()> onArrival)
{
    socket.d->onArrival = std::move(onArrival);
}

void PacedReading::setLong(QPlcAbstractSocket &socket, bool (*mayBeLong)(QPlcMessage::Kind),
                           std::function<bool(quint32)> admits)
{
    socket.d->reader.setLongKinds(mayBeLong);
    socket.d->admits = std::move(admits);
}

bool PacedReading::next(QPlcAbstractSocket &socket)
{
    return socket.readMessage();
}

bool PacedReading::takeLong(QPlcAbstractSocket &socket, UnreadControlFrame *frame)
{
    QPlcAbstractSocket::Private &d = *socket.d;
    return socket.bytesToSend() <= MostUnread
        && (d.reader.takeLong(frame) || (d.mayReadMore() && (d.readMore(), d.reader.takeLong(frame))));
}

void PacedReading::giveLong(QPlcAbstractSocket &socket, const QPlcMessage &message)
{
    qCDebug(lcControl).noquote() << "from" << socket.peerName() << message.kindName() << "which is long";
    Q_EMIT socket.messageReceived(message);
}

void PacedReading::refuseLong(QPlcAbstractSocket &socket, ControlFrameReader::Error error, const QString &text)
{
    socket.d->reader.fail(error, text);
    socket.d->endStream(&socket);
}

bool PacedReading::takeAhead(QPlcAbstractSocket &socket, bool (*isUrgent)(QPlcMessage::Kind), QPlcMessage *message)
{
    if (socket.d->reader.waiting() < MostBuffered)
        socket.d->readMore();
    return socket.d->reader.takeAhead(isUrgent, message);
}

bool PacedReading::wasTakenAhead(const QPlcAbstractSocket &socket)
{
    return socket.d->reader.wasTakenAhead();
}

bool PacedReading::isOvertaken(const QPlcAbstractSocket &socket)
{
    return socket.d->reader.isOvertaken();
}

bool PacedReading::send(QPlcAbstractSocket &socket, QPlcMessage::Kind kind, const QByteArray &json,
                        const QByteArray &end)
{
    return socket.isConnected()
        && socket.d->send(&socket, kind, encodeControlFrame(kind, json, socket.d->sendLimit, end.size()), end);
}

}  // namespace qplc
