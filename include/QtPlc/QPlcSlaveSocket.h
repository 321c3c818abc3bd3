// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcAbstractSocket.h"

/// The control connection of a master to one of its nodes or tools.
///
/// \code
/// auto *server = new QTcpServer(qApp);
/// QObject::connect(server, &QTcpServer::newConnection, server, [server] {
///     auto *socket = new QPlcSlaveSocket(server->nextPendingConnection(), server);
///     QObject::connect(socket, &QPlcAbstractSocket::disconnected, socket, &QObject::deleteLater);
/// });
/// server->listen(QHostAddress::LocalHost, 50000);
/// \endcode
///
/// QPlcMasterNode makes these objects by itself.
///
/// \threadsafe no: the object lives in the thread of its owner and needs its event loop
///
/// \ingroup network
class QTPLC_EXPORT QPlcSlaveSocket : public QPlcAbstractSocket
{
    Q_OBJECT
public:
    /// Makes a control connection out of an accepted one.
    /// \param socket  becomes owned
    /// \param parent  owns this object, if given
    explicit QPlcSlaveSocket(QTcpSocket *socket, QObject *parent = nullptr);
};
