// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QObject>
#include <QtCore/QSocketNotifier>
#include <QtNetwork/QTcpServer>

#include <memory>

namespace qplc {

/// Listens for connections and takes them out of the queue of the system when asked to.
///
/// QTcpServer itself would take every connection, and would spin when the process has no descriptor left. Here one is kept in reserve: with it a connection that there is no descriptor for
/// is closed.
class ControlListener : public QObject
{
    Q_OBJECT
public:
    explicit ControlListener(QObject *parent = nullptr);
    ~ControlListener() override;

    /// \return false, with the reason in errorString()
    bool listen(const QHostAddress &address, quint16 port);
    void close();
    QHostAddress address() const { return m_server.serverAddress(); }
    quint16 port() const { return m_server.serverPort(); }
    QString errorString() const { return m_server.errorString(); }
    QAbstractSocket::SocketError error() const { return m_server.serverError(); }

    /// The next connection, non-blocking; the caller owns it. \return -1: nobody waits
    int take();
    /// Whether arrived() is emitted; what comes meanwhile waits in the queue of the system.
    void setAttentive(bool attentive);
    /// False also when there was no descriptor left: to be set again after a while.
    bool isAttentive() const { return m_notifier && m_notifier->isEnabled(); }
    /// Connections that were closed because the process had no descriptor for them.
    quint64 withoutDescriptor() const { return m_withoutDescriptor; }

Q_SIGNALS:
    /// Somebody waits.
    void arrived();

private:
    void closeOneForWantOfDescriptors();
    void reserve();

    QTcpServer m_server;
    std::unique_ptr<QSocketNotifier> m_notifier;
    int m_reserve = -1;
    quint64 m_withoutDescriptor = 0;
};

}  // namespace qplc
