// SPDX-License-Identifier: Apache-2.0
#include "ServerSettings.h"

#include "node/Logging.h"
#include "protocol/messages/Greeting.h"

namespace qplc {

QHostAddress ServerSettings::allowedAddress(const QHostAddress &wanted) const
{
    if (wanted.isLoopback() || !security.isNone())
        return wanted;
    if (insecureNetworkAllowed) {
        qCWarning(lcMaster).noquote() << "listening on" << wanted.toString()
                                      << "WITHOUT SECURITY: everybody on the network can read and command the plant";
        return wanted;
    }
    qCWarning(lcMaster).noquote() << "listening on 127.0.0.1 only instead of" << wanted.toString()
                                  << "- everybody on the network could read and command the plant; use setSecurity() "
                                     "(--security psk), or open it by setInsecureNetworkAllowed(true)";
    return QHostAddress::LocalHost;
}

QString ServerSettings::securityName(const QHostAddress &address) const
{
    return address.isLoopback() || !security.isNone() ? security.modeName() : QString(messages::insecure);
}

}  // namespace qplc
