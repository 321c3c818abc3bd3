// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcAbstractSocket.h"

/// The control connection of a master to one of its slaves (or to a tool).
class QTPLC_EXPORT QPlcSlaveSocket : public QPlcAbstractSocket
{
    Q_OBJECT
public:
    /// Takes over the accepted connection \a socket.
    explicit QPlcSlaveSocket(QTcpSocket *socket, QObject *parent = nullptr);
};
