// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcAbstractSocket.h"
#include "QPlcSecurity.h"
#include "QPlcUnderlyingProtocol.h"

/// The control connection of a node or tool to its master.
///
/// \code
/// auto *socket = new QPlcMasterSocket(qApp);
/// QObject::connect(socket, &QPlcAbstractSocket::connected, socket, [socket] {
///     socket->sendMessage(QPlcMessage(QPlcMessage::Hello, {{"protocol", 2}, {"role", "tool"}}));
/// });
/// QObject::connect(socket, &QPlcAbstractSocket::errorOccurred, socket,
///                  [socket] { qWarning("%s", qPrintable(socket->errorString())); });
/// socket->connectToMaster(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost));
/// \endcode
///
/// \threadsafe no: the object lives in the thread of its owner and needs its event loop
///
/// \ingroup network
class QTPLC_EXPORT QPlcMasterSocket : public QPlcAbstractSocket
{
    Q_OBJECT
public:
    /// Makes an object without a connection.
    /// \param parent  owns this object, if given
    explicit QPlcMasterSocket(QObject *parent = nullptr);
    /// Closes the connection at once, without a signal.
    ~QPlcMasterSocket() override;

    /// Sets how the two ends authenticate each other; QPlcSecurity::current() by default. Takes
    /// effect with connectToMaster().
    void setSecurity(const QPlcSecurity &security);
    /// Begins to connect; connected() or errorOccurred() follows. With security, connected() comes
    /// after the handshake, which may take 5 s at most; then it is a TimeoutError. A file of the
    /// security settings that is wrong is a SecurityError.
    void connectToMaster(const QPlcUnderlyingProtocol &master);

protected:
    QString securityErrorText() const override;

private:
    Q_DECL_HIDDEN void connectSecurely(const QPlcUnderlyingProtocol &master);

    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
