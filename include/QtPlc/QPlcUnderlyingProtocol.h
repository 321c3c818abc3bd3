// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>
#include <QtNetwork/QHostAddress>

/// How and where master and slaves meet.
///
/// Control messages always travel over TCP. The kind says how the cyclic frames travel: over a TCP connection of their own, over UDP on the same
/// port number, or through memory that master and slave share on one machine. A master serves all of them; each slave chooses for itself.
/// A value type.
class QTPLC_EXPORT QPlcUnderlyingProtocol
{
public:
    enum Kind : quint8 { Invalid, Tcp, Udp, UdpMulticast, Local };

    static constexpr quint16 DefaultPort = 50000;

    QPlcUnderlyingProtocol() = default;
    static QPlcUnderlyingProtocol tcp(const QHostAddress &address, quint16 port = DefaultPort)
    {
        return {Tcp, address, port};
    }
    static QPlcUnderlyingProtocol udp(const QHostAddress &address, quint16 port = DefaultPort)
    {
        return {Udp, address, port};
    }

    /// UDP, where the master sends the inputs of all nodes at once to its multicast group (QPlcMasterNode::setMulticastGroup()): one datagram instead of one per
    /// node. For nodes without same-cycle inputs, over IPv4.
    static QPlcUnderlyingProtocol udpMulticast(const QHostAddress &address, quint16 port = DefaultPort)
    {
        return {UdpMulticast, address, port};
    }
    /// A master on this machine, run by the same user. \param name  its name (QPlcMasterNode::setLocalName()), or its port number
    /// \return an invalid protocol, with the reason in \a error, when no master of this name is running
    static QPlcUnderlyingProtocol local(const QString &name = QString::number(DefaultPort), QString *error = nullptr);

    /// Reads "local://NAME", "local://PORT", "HOST:PORT", "HOST", "[IPV6]:PORT", optionally behind "tcp://", "udp://" or "udp-multicast://". Host names other than "localhost" are looked up, which may block.
    /// \param kind  when the text names none
    /// \return an invalid protocol, with the reason in \a error, when the text is none
    static QPlcUnderlyingProtocol fromString(const QString &text, Kind kind = Tcp, QString *error = nullptr);

    bool isValid() const { return m_kind != Invalid; }
    Kind kind() const { return m_kind; }
    QHostAddress address() const { return m_address; }
    quint16 port() const { return m_port; }
    /// "udp://127.0.0.1:50000", "local://50000"
    QString toString() const;
    /// "tcp", "udp", "udp-multicast", "local"
    QString kindName() const;

    friend bool operator==(const QPlcUnderlyingProtocol &a, const QPlcUnderlyingProtocol &b)
    {
        return a.m_kind == b.m_kind && a.m_address == b.m_address && a.m_port == b.m_port;
    }
    friend bool operator!=(const QPlcUnderlyingProtocol &a, const QPlcUnderlyingProtocol &b) { return !(a == b); }

private:
    QPlcUnderlyingProtocol(Kind kind, const QHostAddress &address, quint16 port)
        : m_kind(kind)
        , m_address(address)
        , m_port(port)
    {
    }
    Kind m_kind = Invalid;
    QHostAddress m_address;
    quint16 m_port = 0;
};

Q_DECLARE_METATYPE(QPlcUnderlyingProtocol)
