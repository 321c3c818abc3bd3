// SPDX-License-Identifier: Apache-2.0
#include "Listener.h"

#include "signals/PayloadLayout.h"

#include <algorithm>
#include <numeric>

namespace qplc {

namespace {

/// Reads all signals of its own table, whatever the table of the process is: a window may show
/// several masters.
class ListeningNode : public QPlcIOBufferSlaveNode
{
public:
    explicit ListeningNode(const QString &name)
        : QPlcIOBufferSlaveNode(name)
    {
        readAllSignals();
    }

    int attempt = 0;
};

ListeningNode *listening(QPlcIOBufferSlaveNode *node)
{
    return static_cast<ListeningNode *>(node);
}

int bufferSize(const QPlcSignalTable &table, qint64 period)
{
    constexpr qint64 memory = 32 * 1024 * 1024;  // [byte]
    constexpr qint64 time = 2'000'000'000;       // [ns]
    const qint64 payload = std::accumulate(
        table.begin(), table.end(), qint64(32),
        [](qint64 sum, const QPlcSignalDefinition &definition) { return sum + definition.type.size(); });
    // A ring is a power of two large: half of what fits.
    return int(std::clamp<qint64>(std::min(time / std::max<qint64>(period, 1), memory / 2 / payload), 256, 16384));
}

}  // namespace

Listener::Listener(const QString &name, QObject *parent)
    : QObject(parent)
    , m_node(new ListeningNode(name))
{
    m_thread.setObjectName(QStringLiteral("plc"));
    m_node->setReconnectPolicy(QPlcSlaveNode::NeverReconnect);  // whoever owns it connects again
    m_node->moveToThread(&m_thread);
    connect(&m_thread, &QThread::finished, m_node, &QObject::deleteLater);
    // The number of the attempt is read in the thread of the node, where it is true.
    ListeningNode *node = listening(m_node);
    const auto forward = [this, node](const auto &emitSignal) {
        const auto unlessOutdated = [this, attempt = node->attempt, emitSignal] {
            if (attempt == m_attempt)
                emitSignal();
        };
        QMetaObject::invokeMethod(this, unlessOutdated, Qt::QueuedConnection);
    };
    connect(m_node, &QPlcSlaveNode::connectedToMaster, m_node,
            [this, forward] { forward([this] { Q_EMIT joined(); }); });
    connect(m_node, &QPlcSlaveNode::errorOccurred, m_node, [this, node, forward] {
        const QPlcSlaveNode::State state = node->state();
        if (state == QPlcSlaveNode::Disconnected || state == QPlcSlaveNode::Rejected
            || state == QPlcSlaveNode::SafeStop)  // else it goes on
            forward([this, text = node->errorString()] { Q_EMIT lost(text); });
    });
    m_thread.start();
}

Listener::~Listener()
{
    ++m_attempt;
    m_thread.quit();
    m_thread.wait();
}

template<typename Task>
void Listener::inThread(Task task)
{
    QMetaObject::invokeMethod(m_node, task, Qt::QueuedConnection);
}

void Listener::connectToMaster(const QPlcUnderlyingProtocol &master, const QPlcSignalTable &table, qint64 period,
                               int every)
{
    inThread([node = listening(m_node), attempt = ++m_attempt, security = m_security, master, table, period, every] {
        node->disconnectFromMaster();
        node->attempt = attempt;
        if (security)
            node->setSecurity(*security);
        node->setSignalTable(table);
        node->setBufferSize(bufferSize(table, period * every));
        node->setListeningInterval(every);
        node->connectToMaster(master);
    });
}

void Listener::disconnectFromMaster()
{
    ++m_attempt;
    inThread([node = m_node] { node->disconnectFromMaster(); });
}

int Listener::takeFrames(const std::function<void(const QPlcIOBufferSlaveNode::Frame &)> &take)
{
    return m_node->takeFrames(take);
}

}  // namespace qplc
