// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ControlNetwork.h"

#include <QtCore/QObject>
#include <QtCore/QSocketNotifier>

#include <memory>

namespace qplc {

/// Listens for connections and takes them out of the queue of the system when asked to.
///
/// A descriptor is kept in reserve: with it a connection that there is no descriptor for is closed.
class ControlListener : public QObject
{
    Q_OBJECT
public:
    explicit ControlListener(QObject *parent = nullptr);
    ~ControlListener() override;

    /// \return false, with the reason in errorString()
    bool listen(const QHostAddress &address, quint16 port);
    void close();
    QHostAddress address() const { return m_port ? m_port->address() : QHostAddress(); }
    quint16 port() const { return m_port ? m_port->number() : quint16(0); }
    QString errorString() const { return m_errorString; }
    QAbstractSocket::SocketError error() const { return m_error; }

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

    std::unique_ptr<ControlPort> m_port;  // null: nothing listens
    QAbstractSocket::SocketError m_error = QAbstractSocket::UnknownSocketError;
    QString m_errorString;
    std::unique_ptr<QSocketNotifier> m_notifier;
    int m_reserve = -1;
    quint64 m_withoutDescriptor = 0;
};

}  // namespace qplc
