// SPDX-License-Identifier: Apache-2.0
#include "Tls.h"

#include <QtNetwork/QTcpSocket>

namespace qplc {

Tls::Tls(QTcpSocket *socket)
    : QObject(socket)
{
}

Tls *Tls::of(const QTcpSocket *socket)
{
    return socket->findChild<Tls *>(QString(), Qt::FindDirectChildrenOnly);
}

}  // namespace qplc
