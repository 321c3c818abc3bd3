// SPDX-License-Identifier: Apache-2.0
#include "QPlcMasterSocket.h"

#include <QtNetwork/QTcpSocket>

QPlcMasterSocket::QPlcMasterSocket(QObject *parent)
    : QPlcAbstractSocket(new QTcpSocket, parent)
{
}

void QPlcMasterSocket::connectToMaster(const QPlcUnderlyingProtocol &master)
{
    socket()->connectToHost(master.address(), master.port());
}
