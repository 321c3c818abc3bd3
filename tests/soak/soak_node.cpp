// SPDX-License-Identifier: Apache-2.0
// soak_node: a node of the soak's plant. It writes its group, moves a drive as its neighbour says, and keeps a history of both.
#include "History.h"
#include "NodeOptions.h"
#include "SoakPlant.h"

namespace soak {

class Node : public QPlcCompactSlaveNode
{
public:
    Node(const NodeOptions &options, HistoryWriter &history)
        : QPlcCompactSlaveNode(nodeName(options.node), ErrorZeroOrderHold)
        , m_options(options)
        , m_history(history)
        , m_written(this, options.shape, options.node)
        , m_seen(this, options.shape, (options.node + options.shape.nodes - 1) % options.shape.nodes)
    {
        // Every eighth gets its table from the master, and no qualities.
        if (options.node % 8 != 0) {
            setSignalTable(table(options.shape));
            setReceivesQuality(true);
        }
        connect(this, &QPlcSlaveNode::realTimeHasStarted, this,
                [this] { m_history.append(Record::Phase, m_options.node); });
        connect(this, &QPlcSlaveNode::disconnectedFromMaster, this,
                [this] { m_history.append(Record::MasterLost, m_options.node); });
        connect(this, &QPlcSlaveNode::errorWithMaster, this,
                [this] { m_history.append(Record::KeptOut, m_options.node); });
    }

private:
    void reset() override
    {
        write(m_written, m_options.life, ++m_counter);
        m_history.append(Record::Reset, m_options.node, {0, m_counter, m_written.check});
    }
    void step(const QPlcCycle &cycle) override
    {
        const Stamp seen = m_seen.stamp();
        write(m_written, m_options.life, ++m_counter);
        m_history.append(Record::Step, m_options.node,
                         {cycle.missedCycles(), m_counter, m_written.check, seen.life, seen.counter, seen.check,
                          m_seen.computedCheck(), bitsOf(m_seen.drive),
                          receivesQuality() ? m_seen.drive.quality().toByte() : Record::NoQuality},
                         cycle.number());
    }
    void stopped() override { m_history.append(Record::PhaseEnded, m_options.node); }
    void safeState(SafeStateReason reason) override
    {
        m_history.append(Record::Safe, m_options.node,
                         {bitsOf(m_seen.drive), reason == PhaseEnded ? 1U : 0U, reason == MasterStopsSafely ? 1U : 0U});
    }

    const NodeOptions m_options;
    HistoryWriter &m_history;
    Group<QPlcOutput> m_written;
    Group<QPlcInput> m_seen;
    quint32 m_counter = 0;
};

}  // namespace soak

int main(int argc, char **argv)
{
    QPlcNodeApplication application(argc, argv);
    soak::addNodeOptions(application);
    soak::NodeOptions options;
    soak::HistoryWriter history;
    if (!application.parseNodeOptions() || !soak::readNodeOptions(application, &options, &history))
        return application.exitCode();
    soak::Node node(options, history);
    history.append(soak::Record::Born, options.node, {quint64(application.applicationPid())});
    return application.run(node);
}
