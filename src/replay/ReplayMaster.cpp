// SPDX-License-Identifier: Apache-2.0
#include "ReplayMaster.h"

#include "node/api/QPlcMasterNodePrivate.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QEventLoop>
#include <QtCore/QTimer>

#include <utility>

namespace qplc {

namespace {

QPlcMasterNodePrivate &inside(const QPlcMasterNode &master)
{
    return QPlcMasterNodePrivate::of(master);
}

}  // namespace

ReplayMaster::ReplayMaster(const RingDescription &description, const QPlcSignalTable &table)
{
    m_master.setSignalTable(table);
    m_master.setInterval(std::chrono::nanoseconds(description.period));
    m_master.setClock(QPlcClock::external());
    m_master.setProfile(QPlcProfile::Simulation);
    m_master.setLongestWait(std::chrono::seconds(30));
    m_master.setInitializationTimeout(std::chrono::seconds(30));
    inside(m_master).phaseSettings.hasRing = false;
}

ReplayMaster::~ReplayMaster() = default;

QString ReplayMaster::listen(QString *error)
{
    if (m_master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)))
        return QStringLiteral("local://%1").arg(m_master.serverPort());
    *error = m_master.errorString();
    return {};
}

/// As a program would: then its first cycle is counted as theirs.
bool ReplayMaster::add(QPlcSlaveNode *node, QString *error)
{
    const QString address = listen(error);
    if (address.isEmpty())
        return false;
    if (node->connectToMasterAndWaitForConnected(QPlcUnderlyingProtocol::fromString(address))
        && waitForNode(std::chrono::seconds(10), [] { return false; }))
        return true;
    *error = node->errorString();
    return false;
}

bool ReplayMaster::waitFor(const std::function<bool()> &isReached, std::chrono::milliseconds longest)
{
    QEventLoop loop;
    QTimer look;
    QTimer end;
    end.setSingleShot(true);
    end.start(longest);
    look.start(5);
    while (!isReached() && end.isActive())
        loop.processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents);
    return isReached();
}

bool ReplayMaster::waitForNode(std::chrono::milliseconds longest, const std::function<bool()> &isHopeless)
{
    const auto findNode = [this] {
        for (const std::shared_ptr<NodeSlot> &slot : inside(m_master).parts->registry.nodes()) {
            if (slot->isThere())
                m_slot = slot;
        }
        return m_slot != nullptr;
    };
    waitFor([&] { return findNode() || isHopeless(); }, longest);
    return m_slot != nullptr;
}

bool ReplayMaster::start(const NodePassage &passage, std::chrono::milliseconds longest, QString *error)
{
    auto &parts = *inside(m_master).parts;
    parts.values.setRecordedInputs(passage.start ? passage.start->inputs : QByteArray());
    m_toImage.clear();
    for (const CopyRun &run : parts.cycle.image().gatherRuns(m_slot->inputLayout))
        m_toImage.push_back({run.to, run.from, run.size});
    m_master.startRealTime();
    waitFor(
        [this] {
            const QPlcMasterNode::State state = m_master.state();
            return state != QPlcMasterNode::Initializing;
        },
        longest);
    if (m_master.state() != QPlcMasterNode::RealTime) {
        *error = m_master.errorString().isEmpty() ? QStringLiteral("the node did not start in time")
                                                  : m_master.errorString();
        return false;
    }
    // Requests that were lost before its first cycle: the node counts them.
    for (std::uint64_t i = 0; i < passage.lostAtFirst; ++i)
        m_slot->sentCycles.note({});
    return true;
}

void ReplayMaster::stop()
{
    m_master.stop();
}

MasterCycle::Step ReplayMaster::step(std::uint64_t number, const QByteArray &inputs) noexcept
{
    return inside(m_master).parts->cycle.step(
        number, [&](ProcessImage &image) { copyRuns(m_toImage, inputs.constData(), image.data()); });
}

const char *ReplayMaster::outputs() const
{
    return m_slot->decoder.payload();
}

}  // namespace qplc
