// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "History.h"
#include "tools/BlockingClient.h"

#include <memory>

namespace soak {

/// The person at the plant: looks at the state of the master, and brings the plant back to motion
/// after a fault. Every command is written down.
class Operator
{
public:
    Operator(HistoryWriter &history, int nodes);

    /// From now on the master is here; an earlier one is gone.
    void useMaster(const QPlcUnderlyingProtocol &master);
    /// Does what there is to do until the whole plant runs. \return false when it does not within
    /// \a patience [ms]: errorString() says what is missing
    bool bringToRealTime(int patience);
    /// Whether the whole plant runs. Does nothing about it.
    bool isRunning();
    /// From now on the whole plant runs only with a node \a node that has registered anew. To be
    /// called before its process ends.
    void expectAnother(int node);
    /// Waits until this many nodes have registered. \return false when they have not within \a
    /// patience [ms]
    bool waitForNodes(int count, int patience);
    bool stop();
    /// Keeps a node out, and then expects another registration of it. \return whether it is out
    bool evict(int node);
    /// Lets it in again, if the master still keeps it out.
    void admit(int node);
    /// Tells a plant that lacks a node to initialize and to start, and writes down the answers.
    void tryToStartWithout(int node);
    /// Does what leads to motion, whoever is missing.
    void tryToStart();
    /// Whether the master has a node of this name now.
    bool sees(const QString &name);
    /// "127.0.0.1:40312" of the nodes that have datagrams.
    QStringList datagramAddresses();
    QString errorString() const { return m_errorString; }

    static void wait(int milliseconds);
    /// [ms] on the clock of the host
    static qint64 now();

private:
    template<typename Request>
    bool ask(const Request &request, typename Request::Answer *answer = nullptr)
    {
        if (client().ask(request, answer))
            return true;
        m_errorString = QStringLiteral("%1: %2").arg(QPlcMessage::kindName(Request::kind), m_client->errorString());
        return false;
    }
    tools::BlockingClient &client();
    /// Waits for an event of the master, but not much longer than somebody who looks now and then.
    void waitForNews();
    bool areAllThere(const qplc::messages::State &state) const;
    /// Resets where the master is latched, and starts where it can be started.
    void resetOrStart(const qplc::messages::State &state);
    /// Arms where the master wants it, and starts.
    void start(const qplc::messages::State &state);
    static int idOf(const qplc::messages::State &state, int node);
    /// Does the next thing. \return whether the whole plant runs
    bool goOn();

    HistoryWriter &m_history;
    const int m_nodes;
    QPlcUnderlyingProtocol m_master;
    int m_formerNode = -1;
    int m_formerId = 0;  // of this node, which its next registration will not have; 0: none
    std::unique_ptr<tools::BlockingClient> m_client;
    bool m_hasNews = false;  // since the last look at the state
    QString m_errorString;
};

}  // namespace soak
