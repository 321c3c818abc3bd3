// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcIOBufferSlaveNode.h"

#include <QtCore/QObject>
#include <QtCore/QThread>

#include <optional>

namespace qplc {

/// Hears all signals of a master in each cycle: a listening node in a thread of its own ("plc"), so
/// that nothing that happens in a window reaches the cycle. The face of it for the thread of the
/// window: nothing here waits, but for the end of the object.
class Listener : public QObject
{
    Q_OBJECT
public:
    explicit Listener(const QString &name, QObject *parent = nullptr);
    ~Listener() override;

    /// How both ends know each other; none: as the process does. Takes effect with
    /// connectToMaster().
    void setSecurity(const std::optional<QPlcSecurity> &security) { m_security = security; }
    /// Begins to register for all signals of \a table; joined() or lost() follows.
    /// \param period of a cycle [ns]: says how many frames are kept, 2 s of them within 256 ...
    ///         16384 and 32 MB
    /// \param every  cycles for each frame, see QPlcSlaveNode::setListeningInterval()
    void connectToMaster(const QPlcUnderlyingProtocol &master, const QPlcSignalTable &table, qint64 period, int every);
    /// No Qt signal follows.
    void disconnectFromMaster();
    /// See QPlcIOBufferSlaveNode::takeFrames().
    int takeFrames(const std::function<void(const QPlcIOBufferSlaveNode::Frame &)> &take);
    /// Cycles that this process was too slow for, ever.
    quint64 lostCycles() const { return m_node->lostCycles(); }

Q_SIGNALS:
    void joined();
    /// Could not register, or has lost the master. \param sentence  of the node
    void lost(const QString &sentence);

private:
    template<typename Task>
    void inThread(Task task);

    QThread m_thread;
    QPlcIOBufferSlaveNode *m_node;
    std::optional<QPlcSecurity> m_security;
    int m_attempt = 0;  // Qt signals of former ones come late
};

}  // namespace qplc
