// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeSession.h"

namespace qplc {

class MasterServer;
struct MasterConnection;

/// A node in another process: requests are messages, and so are its answers.
class RemoteNode final : public NodeSession
{
public:
    /// \pre the cyclic channel of \a connection is there. Both live until leave()
    RemoteNode(MasterServer &server, MasterConnection &connection);

    std::optional<Answer> askOutputs(std::optional<quint64> phase) override;
    std::optional<Answer> giveInputs(const QByteArray &values) override;
    std::optional<Answer> start(const messages::RealTimeStarted &start) override;
    void cyclesStarted(QPlcProfile::Value) override {}  // its first frame says so
    void cancel(const QString &reason, bool isStarting) override;
    void stop(const QString &reason) override;
    void tellSafe() override {}  // its frames say so
    void drop(const QString &reason) override;
    void leave() override { m_connection = nullptr; }

    QPlcSlaveNode::State state() const override;
    QString codeFailed() override { return QStringLiteral("its code failed"); }
    QString transportName() const override;
    bool usesFallback() const override;
    QString address() const override;
    QString identity() const override;

private:
    messages::RealTimeStopped stopMessage(const QString &reason) const;

    MasterServer &m_server;
    MasterConnection *m_connection;  // null: it has left
};

}  // namespace qplc
