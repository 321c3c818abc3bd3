// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>
#include <QtNetwork/QHostAddress>

/// The address of a master, and the way of the cyclic frames: UDP, TCP, UDP multicast, or shared
/// memory.
///
/// \code
/// QString error;
/// const QPlcUnderlyingProtocol master = QPlcUnderlyingProtocol::fromString(
///     "winch:50000", QPlcUnderlyingProtocol::Automatic, &error);
/// if (!master.isValid())
///     qWarning("%s", qPrintable(error));
/// QPlcIOSlaveNode node("Operator");
/// node.connectToMaster(master);
/// \endcode
///
/// Control messages always use TCP. The kind says how the cyclic frames travel: over UDP on the
/// same port number, over a TCP connection of their own, or through memory that master and node
/// share on one machine. A master serves all kinds; each node chooses for itself.
///
/// With Automatic, a node tests UDP each time it registers: it sends up to 20 datagrams to the
/// master within 500 ms, and waits for an answer. With an answer, its frames use UDP. Without one,
/// they use TCP until the node registers again; node and master log it, and QPlcNodeInfo::fallback
/// is true. The node does not test UDP again while it is registered: if UDP stops later, the node
/// is lost, as with Udp. It then registers again, with a new test.
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup network
class QTPLC_EXPORT QPlcUnderlyingProtocol
{
public:
    /// Ways of the cyclic frames.
    enum Kind : quint8 {
        Invalid,  ///< no address
        Tcp,      ///< a TCP connection of their own
        Udp,      ///< datagrams between master and node
        /// Inputs in datagrams to a multicast group, outputs in datagrams to the master.
        UdpMulticast,
        Local,     ///< shared memory of one machine
        Automatic  ///< UDP if datagrams get through in both directions, else TCP
    };

    /// Port number of a master, unless another one is given.
    static constexpr quint16 DefaultPort = 50000;

    /// Makes an invalid address.
    QPlcUnderlyingProtocol() = default;
    /// Returns the address of a master, with cyclic frames over UDP if datagrams get through in
    /// both directions, else over TCP. The usual choice for nodes.
    static QPlcUnderlyingProtocol automatic(const QHostAddress &address, quint16 port = DefaultPort)
    {
        return {Automatic, address, port};
    }
    /// Returns the address of a master, with cyclic frames over TCP. Use it for servers, too.
    static QPlcUnderlyingProtocol tcp(const QHostAddress &address, quint16 port = DefaultPort)
    {
        return {Tcp, address, port};
    }
    /// Returns the address of a master, with cyclic frames over UDP: less delay after a loss than
    /// TCP.
    static QPlcUnderlyingProtocol udp(const QHostAddress &address, quint16 port = DefaultPort)
    {
        return {Udp, address, port};
    }

    /// Returns the address of a master that sends the inputs of all nodes in one datagram to its
    /// multicast group (QPlcMasterNode::setMulticastGroup()). For nodes without same-cycle inputs,
    /// over IPv4.
    static QPlcUnderlyingProtocol udpMulticast(const QHostAddress &address, quint16 port = DefaultPort)
    {
        return {UdpMulticast, address, port};
    }
    /// Returns the address of a master on this machine, run by the same user, with cyclic frames
    /// through shared memory.
    /// \param name  its name (QPlcMasterNode::setLocalName()) or its port number
    /// \param error  if given: the reason for an invalid result
    /// \return an invalid address when no master of this name is running
    static QPlcUnderlyingProtocol local(const QString &name = QString::number(DefaultPort), QString *error = nullptr);

    /// Reads "local://NAME", "local://PORT", "HOST:PORT", "HOST" or "[IPV6]:PORT"; "tcp://",
    /// "udp://", "udp-multicast://" or "auto://" may come first. Host names other than "localhost"
    /// are looked up, which may block for seconds.
    /// \param kind  if the text has none
    /// \param error  if given: the reason for an invalid result
    /// \return an invalid address when \a text is wrong or the host is unknown
    static QPlcUnderlyingProtocol fromString(const QString &text, Kind kind = Automatic, QString *error = nullptr);

    /// Returns false for an address that was not given or could not be read.
    bool isValid() const { return m_kind != Invalid; }
    /// Returns the way of the cyclic frames.
    Kind kind() const { return m_kind; }
    /// Returns the IP address of the master.
    QHostAddress address() const { return m_address; }
    /// Returns the port on which the master accepts control connections (TCP).
    quint16 port() const { return m_port; }
    /// Returns a text that fromString() reads back: "udp://127.0.0.1:50000", "local://50000",
    /// "127.0.0.1:50000" for Automatic; "invalid" for an invalid address.
    QString toString() const;
    /// Returns "tcp", "udp", "udp-multicast", "local" or "auto"; "invalid" for an invalid address.
    QString kindName() const;

    /// Returns true if kind, IP address and port are the same.
    friend bool operator==(const QPlcUnderlyingProtocol &a, const QPlcUnderlyingProtocol &b)
    {
        return a.m_kind == b.m_kind && a.m_address == b.m_address && a.m_port == b.m_port;
    }
    /// Returns true if kind, IP address or port differ.
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
