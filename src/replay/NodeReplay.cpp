// SPDX-License-Identifier: Apache-2.0
#include "NodeReplay.h"

#include "NodeProgram.h"
#include "OutputComparison.h"
#include "QPlcSlaveNode.h"
#include "ReplayMaster.h"
#include "realtime/TimeSource.h"
#include "realtime/Worker.h"

#include <QtCore/QEventLoop>
#include <QtCore/QSocketNotifier>

#include <algorithm>

namespace qplc {

namespace {

constexpr std::chrono::seconds Patience(30);  // for each answer of a program that was started

/// Plays the cycles of one passage. Its thread is that of the cycles.
class Player final : public RecordedCycles::Reader
{
public:
    Player(ReplayMaster &master, const NodePassage &passage, double speed, const NodePayloads &payloads,
           OutputComparison &comparison, ReplayResult *result)
        : m_master(master)
        , m_passage(passage)
        , m_speed(speed)
        , m_payloads(payloads)
        , m_comparison(comparison)
        , m_result(*result)
    {
    }

    bool begin(const RingDescription &description, const QPlcSignalTable &) override
    {
        m_period = description.period;
        m_begin = monotonicNow();
        return true;
    }
    bool cycle(const RecordedRow &row) override
    {
        const std::uint64_t number = row.cycle.number;
        if (number < m_passage.first)
            return true;
        if (m_passage.end && number >= *m_passage.end)
            return false;
        if (m_passage.hasComputed(number) && !step(row))
            return false;
        m_comparison.compare(row);
        return true;
    }
    /// [s] from the first cycle to the last one.
    double simulated() const { return double(m_steps) * double(m_period) * 1e-9; }
    double elapsed() const { return double(monotonicNow() - m_begin) * 1e-9; }

private:
    bool step(const RecordedRow &row)
    {
        const std::uint64_t number = row.cycle.number;
        if (!m_payloads.inputs(row, &m_inputs))
            return fail(QStringLiteral("the recording does not say what the node was sent in cycle %1").arg(number));
        if (m_steps++ == 0)
            m_firstCycle = number;
        if (m_speed > 0.0) {
            const double due = double(number - m_firstCycle) * double(m_period) / m_speed;
            TimeSource::monotonic().sleepUntil(m_begin + std::int64_t(due));
        }
        switch (m_master.step(number, m_inputs)) {
        case MasterCycle::Step::Complete:
        case MasterCycle::Step::Safe:  // the node has asked for it
            break;
        case MasterCycle::Step::Late:
            return fail(QStringLiteral("the node has not answered to cycle %1").arg(number));
        default:
            return fail(QStringLiteral("the replay was stopped in cycle %1").arg(number));
        }
        ++m_result.cycles;
        if (m_master.node()->faulted)
            return fail(QStringLiteral("the code of the node has failed in cycle %1").arg(number));
        m_comparison.add(number, m_master.outputs());
        return true;
    }
    bool fail(const QString &text)
    {
        m_result.kind = ReplayResult::Failed;
        m_result.error = text;
        return false;
    }

    ReplayMaster &m_master;
    const NodePassage &m_passage;
    const double m_speed;
    const NodePayloads &m_payloads;
    OutputComparison &m_comparison;
    ReplayResult &m_result;
    QByteArray m_inputs;
    std::int64_t m_period = 0;  // [ns]
    std::int64_t m_begin = 0;   // [ns]
    std::uint64_t m_firstCycle = 0;
    std::uint64_t m_steps = 0;
};

class Replay
{
public:
    explicit Replay(const ReplayRequest &request)
        : m_request(request)
    {
        m_result.node = request.name;
    }

    ReplayResult run()
    {
        QString error;
        if (!findPhase(m_request.file, &m_phase, &m_result.notes, &error))
            return refuse(error);
        m_table = QPlcSignalTable::fromIni(m_phase.description.table);
        if (m_phase.files.size() > 1)
            m_result.notes << QStringLiteral("the recording is %1").arg(m_phase.name());
        if (!m_request.node && NodeProgram::isSecured(m_request.program))
            return refuse(QStringLiteral("the master of a replay has no keys; leave out --security and what belongs to "
                                         "it"));
        // The name of the node is known when its program has registered.
        if (!bringNode())
            return m_result;
        if (m_result.node.isEmpty())
            m_result.node = m_master->node()->name;
        std::vector<NodePassage> passages;
        if (!readPassages(m_phase, m_result.node, &passages, &error))
            return refuse(error);
        if (m_request.node && passages.size() > 1) {
            m_result.notes << QStringLiteral("the recording has %1 registrations of the node; this is the first one")
                                  .arg(passages.size());
            passages.resize(1);
        }
        for (std::size_t i = 0; i < passages.size() && m_result.kind == ReplayResult::Done; ++i) {
            if (i > 0 && !bringNode())
                break;
            play(passages[i]);
            dropNode();
        }
        return m_result;
    }

private:
    ReplayResult refuse(const QString &text)
    {
        m_result.kind = ReplayResult::Refused;
        m_result.error = text;
        dropNode();
        return m_result;
    }
    bool fail(const QString &text)
    {
        m_result.kind = ReplayResult::Failed;
        m_result.error = text;
        dropNode();
        return false;
    }
    /// The program, or the node of this process, at a master of its own.
    bool bringNode()
    {
        QString error;
        m_master = std::make_unique<ReplayMaster>(m_phase.description, m_table);
        if (m_request.node)
            return m_master->add(m_request.node, &error) || fail(error);
        const QString address = m_master->listen(&error);
        if (address.isEmpty() || !m_program.start(m_request.program, address, &error))
            return fail(error);
        if (m_master->waitForNode(Patience, [this] { return m_program.hasEnded(); }))
            return true;
        return fail(
            m_program.hasEnded()
                ? QStringLiteral("the program has ended before its node registered: %1").arg(m_program.endText())
                : QStringLiteral("no node of the program has registered within %1 s; it has to take the option "
                                 "--master")
                      .arg(Patience.count()));
    }
    void dropNode()
    {
        if (m_master)
            m_master->stop();
        if (m_request.node)
            m_request.node->disconnectFromMaster();
        m_master.reset();
        m_program.end();
    }

    void play(const NodePassage &passage)
    {
        const QString text = objectionTo(passage);
        if (!text.isEmpty()) {
            refuse(text);
            return;
        }
        QString error;
        if (!m_master->start(passage, Patience, &error)) {
            fail(QStringLiteral("node '%1' did not begin: %2").arg(m_result.node, error));
            return;
        }
        const ProcessImage image(m_table);
        const NodePayloads payloads(image, passage.node, m_phase.description.ownSignals);
        OutputComparison comparison(m_table, payloads, passage, m_phase.description.period, m_request.from, &m_result);
        comparison.compareInitial(passage.start->outputs, m_master->node()->initialOutputs.data());
        Player player(*m_master, passage, m_request.speed, payloads, comparison, &m_result);
        playAside(player);
        m_result.simulated += player.simulated();
        if (m_result.kind == ReplayResult::Failed && m_program.hasEnded())
            m_result.error += QStringLiteral("; the program has ended: %1").arg(m_program.endText());
        if (passage.end)
            m_result.notes << QStringLiteral("replayed until cycle %1: %2").arg(*passage.end).arg(passage.endReason);
    }
    /// The thread of the master handles its events meanwhile.
    void playAside(Player &player)
    {
        QEventLoop loop;
        QString error;
        bool isRead = false;
        const std::int64_t begin = monotonicNow();
        bool isDone = false;
        Worker worker;
        worker.begin([&] { isRead = RecordedCycles::read(m_phase.files, player, &error); }, [&] { isDone = true; });
        if (worker.descriptor() >= 0) {
            QSocketNotifier news(worker.descriptor(), QSocketNotifier::Read);
            QObject::connect(&news, &QSocketNotifier::activated, &loop, [&] { worker.collect(); });
            while (!isDone)
                loop.processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents);
        }
        m_result.elapsed += double(monotonicNow() - begin) * 1e-9;
        if (!isRead && m_result.kind == ReplayResult::Done)
            fail(error);
    }
    /// Why the node cannot be replayed; empty: it can.
    QString objectionTo(const NodePassage &passage) const
    {
        const NodeSlot &slot = *m_master->node();
        if (passage.node.hasDevices || slot.hardware)
            return QStringLiteral("node '%1' drives real devices, whose answers are not in the recording: it cannot be "
                                  "replayed")
                .arg(m_result.node);
        if (!passage.start)
            return QStringLiteral("the recording begins when node '%1' had computed before: its state then is not "
                                  "known; take a recording from the start of the phase")
                .arg(m_result.node);
        if (!NodePayloads::isPossible(passage.node))
            return QStringLiteral("the recording names a signal of node '%1' twice; it is damaged").arg(m_result.node);
        const QString inputs = differenceOf(slot.inputLayout, passage.node.inputs);
        const QString outputs = differenceOf(slot.outputLayout, passage.node.outputs);
        if (!inputs.isEmpty() || !outputs.isEmpty())
            return QStringLiteral("the program does not %1 as in the recording: %2; take the version of the program "
                                  "that was recorded")
                .arg(inputs.isEmpty() ? QStringLiteral("write the same signals")
                                      : QStringLiteral("read the same signals"),
                     inputs.isEmpty() ? outputs : inputs);
        if (slot.twoPhase != passage.node.isTwoPhase
            || slot.inputLayout.hasQualities() != passage.node.hasInputQualities)
            return QStringLiteral("the program is a %1 node%2, and was another one in the recording: start it with the "
                                  "same options")
                .arg(slot.twoPhase ? QStringLiteral("two-phase") : QStringLiteral("usual"),
                     slot.inputLayout.hasQualities() ? QStringLiteral(" that reads qualities") : QString());
        return {};
    }
    /// The first signal that \a layout has at another place than the recording; empty: none.
    QString differenceOf(const PayloadLayout &layout, const QVector<QPlcSignalIndex> &recorded) const
    {
        const int count = int(layout.fields().size());
        for (int i = 0; i < std::min(count, recorded.size()); ++i) {
            const QPlcSignalIndex signal = layout.fields()[std::size_t(i)].signal;
            if (signal != recorded[i])
                return QStringLiteral("'%1' instead of '%2'")
                    .arg(m_table.at(signal).name, m_table.at(recorded[i]).name);
        }
        return count == recorded.size() ? QString()
                                        : QStringLiteral("%1 signals instead of %2").arg(count).arg(recorded.size());
    }

    const ReplayRequest &m_request;
    ReplayResult m_result;
    RecordedPhase m_phase;
    QPlcSignalTable m_table;
    NodeProgram m_program;
    std::unique_ptr<ReplayMaster> m_master;
};

}  // namespace

ReplayResult replayNode(const ReplayRequest &request)
{
    return Replay(request).run();
}

}  // namespace qplc
