// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSecurity.h"
#include "transport/ConnectionGate.h"

#include <QtNetwork/QHostAddress>

#include <optional>

namespace qplc {

/// What the program has set for the server of a master, and who may come to it.
struct ServerSettings
{
    QPlcSecurity security;
    bool insecureNetworkAllowed = false;
    int maximumConnections = ConnectionGate::Limits().connections;
    QString localName;
    quint16 port = 0;  // that was asked for; 0: a free one
    QHostAddress multicastGroup;
    QString faultPlan;
    bool hasBeacon = false;
    std::optional<bool> armingWanted;  // else: with security

    bool isArmingRequired() const { return armingWanted.value_or(!security.isNone()); }
    /// Where to listen instead of \a wanted: nothing but security, or a loud option, opens a plant
    /// to the network.
    QHostAddress allowedAddress(const QHostAddress &wanted) const;
    /// Of a server that listens at \a address, as Hello tells it: "none", "psk", "insecure".
    QString securityName(const QHostAddress &address) const;
};

}  // namespace qplc
