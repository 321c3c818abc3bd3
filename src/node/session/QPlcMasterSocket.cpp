// SPDX-License-Identifier: Apache-2.0
#include "QPlcMasterSocket.h"

#include "node/security/TlsSettings.h"
#include "transport/ControlNetwork.h"
#include "transport/Tls.h"

#include <QtCore/QTimer>
#include <QtNetwork/QTcpSocket>

#include <optional>

namespace {

constexpr int longestHandshake = 5000;  // [ms] from the begin to connected()

}  // namespace

struct QPlcMasterSocket::Private
{
    std::optional<QPlcSecurity> ownSecurity;
    QPlcSecurity security;  // of the present connection
    qplc::TlsSettings settings;
    qplc::Tls *tls = nullptr;  // of the present connection; null without security
    bool hasBeenEncrypted = false;
    QTimer timer;
};

QPlcMasterSocket::QPlcMasterSocket(QObject *parent)
    : QPlcAbstractSocket(qplc::ControlNetwork::current().makeSocket(nullptr), parent)
    , d(std::make_unique<Private>())
{
    d->timer.setSingleShot(true);
    d->timer.setInterval(longestHandshake);
    connect(&d->timer, &QTimer::timeout, this, [this] {
        setError(
            TimeoutError,
            QStringLiteral("no TLS handshake within %1 s; is it a secured QtPLC master?").arg(longestHandshake / 1000));
        abort();
    });
    connect(this, &QPlcAbstractSocket::disconnected, &d->timer, &QTimer::stop);
    connect(this, &QPlcAbstractSocket::errorOccurred, &d->timer, &QTimer::stop);
}

QPlcMasterSocket::~QPlcMasterSocket() = default;

void QPlcMasterSocket::setSecurity(const QPlcSecurity &security)
{
    d->ownSecurity = security;
}

void QPlcMasterSocket::connectToMaster(const QPlcUnderlyingProtocol &master)
{
    d->security = d->ownSecurity.value_or(QPlcSecurity::current());
    d->hasBeenEncrypted = false;
    if (!d->security.isNone()) {
        connectSecurely(master);
        return;
    }
    if (d->tls)
        setSocket(qplc::ControlNetwork::current().makeSocket(nullptr));
    d->tls = nullptr;
    socket()->connectToHost(master.address(), master.port());
}

void QPlcMasterSocket::connectSecurely(const QPlcUnderlyingProtocol &master)
{
    QString error;
    if (!qplc::TlsSettings::read(d->security, QPlcSecurity::NodeSide, &d->settings, &error)) {
        QMetaObject::invokeMethod(
            this, [this, error] { setError(SecurityError, error); }, Qt::QueuedConnection);
        return;
    }
    d->tls = qplc::ControlNetwork::current().makeTls(nullptr);
    // Before the base class tells that the connection is there.
    connect(d->tls, &qplc::Tls::encrypted, this, [this] {
        d->timer.stop();
        d->hasBeenEncrypted = true;
        if (!qplc::TlsSettings::isAcceptable(d->tls->suite(), d->security.mode()))
            abort();  // cannot be: no other suite was offered
    });
    setSocket(d->tls->socket());
    d->timer.start();
    const auto keyOf = [keys = d->settings.keys](const QString &identity) {
        const qplc::Keyring::Entry *entry = keys.find(identity);
        return entry ? entry->key : QByteArray();
    };
    d->tls->connectTo(master.address(), master.port(),
                      {d->settings.configuration, d->settings.identity, keyOf, d->security.masterIdentity()});
}

QString QPlcMasterSocket::securityErrorText() const
{
    const QAbstractSocket::SocketError error = socket()->error();
    const bool isOfTls = d->tls
        && (error == QAbstractSocket::SslHandshakeFailedError || error == QAbstractSocket::SslInternalError
            || (!d->hasBeenEncrypted && error == QAbstractSocket::RemoteHostClosedError));
    return isOfTls ? qplc::nodeHandshakeError(*d->tls, d->security, d->settings.identity) : QString();
}
