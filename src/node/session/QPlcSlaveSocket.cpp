// SPDX-License-Identifier: Apache-2.0
#include "QPlcSlaveSocket.h"

#include <QtNetwork/QTcpSocket>

QPlcSlaveSocket::QPlcSlaveSocket(QTcpSocket *socket, QObject *parent)
    : QPlcAbstractSocket(socket, parent)
{
}
