// SPDX-License-Identifier: Apache-2.0
#include "SimulatedTls.h"

#include "SimulatedSocket.h"

#include <QtCore/QCryptographicHash>
#include <QtCore/QDataStream>
#include <QtCore/QPointer>

namespace qplc {

namespace {

constexpr int HeaderSize = 6;  // of a record, and the kind of its message
const QByteArray ClientHello = QByteArray::fromRawData("\x16\x03\x01\x00\x00\x01", HeaderSize);
const QByteArray ServerHello = QByteArray::fromRawData("\x16\x03\x03\x00\x00\x02", HeaderSize);
constexpr char Alert = 0x15;

QByteArray proofOf(const QByteArray &key)
{
    return QCryptographicHash::hash(key, QCryptographicHash::Sha256);
}

/// As OpenSSL calls an alert of the other end.
QString alertText(quint8 description)
{
    constexpr int firstAlert = 1000;
    return QStringLiteral("error:14094%1:SSL routines").arg(firstAlert + description, 3, 16, QLatin1Char('0'));
}

}  // namespace

SimulatedTls::SimulatedTls(SimulatedHost &host, QObject *parent)
    : SimulatedTls(new SimulatedSocket(host, parent))
{
}

SimulatedTls::SimulatedTls(SimulatedSocket *socket)
    : Tls(socket)
    , m_socket(socket)
{
}

QTcpSocket *SimulatedTls::socket() const
{
    return m_socket;
}

void SimulatedTls::begin(const Terms &terms)
{
    m_terms = terms;
    m_suite = terms.configuration.ciphers().value(0);
    m_stage = Stage::Handshaking;
}

void SimulatedTls::connectTo(const QHostAddress &master, quint16 port, const Terms &terms)
{
    begin(terms);
    m_socket->setReader([this] { readAnswer(); });
    connect(m_socket, &QTcpSocket::connected, this, &SimulatedTls::greet);
    m_socket->connectToHost(master, port, QIODevice::ReadWrite);
}

void SimulatedTls::greet()
{
    QByteArray body;
    QDataStream stream(&body, QIODevice::WriteOnly);
    stream << m_terms.identity << proofOf(m_terms.keyOf(m_terms.identity));
    m_socket->write(ClientHello + body);
}

void SimulatedTls::accept(const Terms &terms)
{
    begin(terms);
    m_socket->setReader([this] { readGreeting(); });
    readGreeting();
}

void SimulatedTls::readGreeting()
{
    QDataStream stream(m_socket->peek(m_socket->bytesAvailable()).mid(HeaderSize));
    QString identity;
    QByteArray proof;
    stream >> identity >> proof;
    if (stream.status() == QDataStream::ReadPastEnd)
        return;  // the rest is on its way
    m_socket->readAll();
    const QByteArray key = m_terms.keyOf(identity);
    if (key.isEmpty() || proof != proofOf(key)) {
        m_socket->fail(QAbstractSocket::SslHandshakeFailedError, QStringLiteral("the keys differ"));
        return;
    }
    m_socket->write(ServerHello);
    end();
}

void SimulatedTls::readAnswer()
{
    if (m_socket->peek(HeaderSize) == ServerHello) {
        const QPointer<SimulatedSocket> socket(m_socket);  // who hears that it is encrypted may end it
        m_socket->read(HeaderSize);
        end();
        if (socket && socket->bytesAvailable() > 0)
            Q_EMIT socket->readyRead();
        return;
    }
    const QByteArray answer = m_socket->readAll();
    m_socket->fail(QAbstractSocket::SslHandshakeFailedError,
                   answer.startsWith(Alert) ? alertText(quint8(answer.back()))
                                            : QStringLiteral("wrong version number"));
}

void SimulatedTls::end()
{
    m_stage = Stage::Encrypted;
    m_terms = Terms();
    m_socket->setReader(nullptr);
    Q_EMIT encrypted();
}

void SimulatedTls::sendAlert(const QByteArray &bytes)
{
    m_socket->write(bytes);
}

}  // namespace qplc
