// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AccessRights.h"
#include "QPlcSecurity.h"
#include "TlsSettings.h"

#include <QtCore/QObject>

QT_BEGIN_NAMESPACE
class QTcpSocket;
QT_END_NAMESPACE

namespace qplc {

class Tls;

/// An accepted connection until it is known what it speaks, and who is there. Answers in the
/// language of the other end when the two do not fit.
class Handshake : public QObject
{
    Q_OBJECT
public:
    /// \param descriptor  of the connection, owned from here on
    Handshake(int descriptor, const QPlcSecurity &security, QObject *parent);
    ~Handshake() override;

    /// "127.0.0.1:40312"
    QString address() const { return m_address; }
    /// As the other end says: to be believed after succeeded() only. Fit to be shown.
    QString claimedIdentity() const;
    const Peer &peer() const { return m_peer; }
    /// The connection, after succeeded(). \return to be owned by the caller
    QTcpSocket *takeSocket();
    /// There is no room for who is there, after succeeded() with TLS: it is told so, and the
    /// connection is closing.
    void turnAway(const QString &reason);
    /// Begins the handshake that tlsWanted() has told.
    void beginTls();
    /// Why it takes so long.
    QString stage() const;

Q_SIGNALS:
    /// The other end wants a TLS handshake, which costs much: it waits for beginTls().
    void tlsWanted();
    /// peer() is who is there, on an encrypted connection or, without security, on a plain one.
    void succeeded();
    /// The other end was told so as far as it understands, and the connection is closing. \param
    /// reason empty: it has gone without a word
    void failed(const QString &reason);

private:
    void look();
    void refusePlain();
    void refuseTls();
    QByteArray keyOf(const QString &identity);
    void encrypted();
    bool identify(QString *reason);
    void fail(const QString &reason);
    void tlsFailed();

    const QPlcSecurity m_security;
    QTcpSocket *m_socket;
    Tls *m_tls = nullptr;  // of the socket; null without security
    QString m_address;
    TlsSettings m_settings;
    Peer m_peer;
    QString m_unknownIdentity;
    bool m_isTls = false;
    bool m_isOver = false;
};

}  // namespace qplc
