// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SoakPlant.h"

#include <QtCore/QMap>

#include <optional>
#include <vector>

namespace soak {

/// What is done to the plant.
enum class FaultKind : quint8 {
    KillNode,          ///< SIGKILL, and started again at once
    StopNode,          ///< SIGSTOP for 0.3 s
    KillMaster,        ///< SIGKILL, and started again at once
    StopMaster,        ///< SIGSTOP for 0.3 s
    GarbageDatagrams,  ///< from strangers to the UDP port of the master
    GarbageControl,    ///< connections to the TCP port of the master that send no message
    GarbageToNodes,    ///< from strangers to the UDP ports of the nodes
    StoppedReader,     ///< a tool that asks and asks, and takes no answer
    ConnectFlood,      ///< connections that say nothing
    /// from here on: a node whose link does this to its frames, for a while; not of a stream, which
    /// knows no such faults
    LoseFrames,
    DuplicateFrames,
    ReorderFrames,
    CorruptFrames,
    CutLink,
    PowerNode,    ///< from here on in simulated plants only: a node without power for a while; its kernel tells nobody
    PowerMaster,  ///< likewise
    CutRoad,      ///< nothing arrives from the node at the master, frames and control connections alike, nor back
    CutRoadToNode,    ///< in one direction
    DelayOnRoad,      ///< to the node and back
    LoseOnRoads,      ///< of all nodes
    DisorderOnRoads,  ///< frames are doubled, and overtake each other
    StepWallClock,    ///< of a node, an hour back
    StepMasterClock,
    SlowListener,     ///< a tool that asks for much, and reads a little at a time
    EchoOnRoads,      ///< of all nodes: now and then a copy of a frame arrives seconds later
    EvictNode,        ///< kept out by the operator, who tries to start without it, and lets it in again
    MissingNode,      ///< is killed, and comes back later; meanwhile the operator tries to start without it
    Siege,            ///< strangers connect and send datagrams beyond their budgets while a node starts again
    OtherParameters,  ///< the master is killed, and comes back with other safety parameters
    SilentJoiner      ///< another node registers, and answers nothing
};
constexpr int FaultKinds = int(FaultKind::SilentJoiner) + 1;
constexpr std::array<const char *, FaultKinds> FaultNames{"kill a node",
                                                          "stop a node",
                                                          "kill the master",
                                                          "stop the master",
                                                          "garbage datagrams",
                                                          "garbage control",
                                                          "garbage to nodes",
                                                          "stopped reader",
                                                          "connect flood",
                                                          "lose frames",
                                                          "duplicate frames",
                                                          "reorder frames",
                                                          "corrupt frames",
                                                          "cut a link",
                                                          "node without power",
                                                          "master without power",
                                                          "cut a road",
                                                          "cut a road to a node",
                                                          "delay on a road",
                                                          "lose on all roads",
                                                          "disorder on all roads",
                                                          "step a clock",
                                                          "step the clock of the master",
                                                          "slow listener",
                                                          "echo on all roads",
                                                          "evict a node",
                                                          "start without a node",
                                                          "siege",
                                                          "other safety parameters",
                                                          "silent joiner"};

constexpr bool isLinkFault(FaultKind kind)
{
    return kind >= FaultKind::LoseFrames && kind <= FaultKind::CutLink;
}
/// Whether a fault of this kind is one of a single node.
constexpr bool hasNode(FaultKind kind)
{
    return kind == FaultKind::KillNode || kind == FaultKind::StopNode || isLinkFault(kind)
        || kind == FaultKind::PowerNode || kind == FaultKind::CutRoad || kind == FaultKind::CutRoadToNode
        || kind == FaultKind::DelayOnRoad || kind == FaultKind::StepWallClock || kind == FaultKind::EvictNode
        || kind == FaultKind::MissingNode || kind == FaultKind::Siege;
}
constexpr bool isOfMaster(FaultKind kind)
{
    return kind == FaultKind::KillMaster || kind == FaultKind::StopMaster || kind == FaultKind::PowerMaster
        || kind == FaultKind::OtherParameters;
}
/// Whether it may happen to every node.
constexpr bool concernsAll(FaultKind kind)
{
    return isOfMaster(kind) || kind == FaultKind::LoseOnRoads || kind == FaultKind::DisorderOnRoads;
}

struct Fault
{
    FaultKind kind = FaultKind::KillNode;
    int node = -1;     // -1: not of a node
    int amount = 0;    // datagrams, connections, requests; [ms] of a stop, cut or faulty link
    quint64 seed = 0;  // for all that is drawn while it happens
    int pause = -1;    // [ms] until the next one, which does not wait for the plant to recover; -1: it waits

    /// "stop a node (Node3), 300, seed 815; the next one 120 ms later".
    QString toString() const;
    /// Reads what toString() writes.
    /// \param nodes  of the plant
    /// \return what is wrong with \a text; empty: nothing
    static QString read(const QString &text, int nodes, Fault *fault);
};

/// What a node is told of the faults of its link: docs/faults.md. What is counted is done to the
/// frames that it sends.
QString linkFaultsOf(FaultKind kind, quint64 seed);

/// What a soak is.
struct Profile
{
    QString name;
    PlantShape shape;
    qint64 periodUs = 10'000;
    int seconds = 60;           // unless the command line says another duration
    int faultEvery = 0;         // [ms] from fault to fault at least; 0: there are none
    int faultCount = 0;         // 0: as many as fit into the duration
    bool isLoaded = false;      // stress-ng runs beside
    bool judgesMemory = false;  // long enough for a slope
    int priority = 0;           // of the cycle threads, SCHED_FIFO; 0: they are ordinary
    double restless = 1.0;      // share of the nodes that have faults
    int attemptsPerSecond = 0;  // of strangers to get in; the plant is secured then
    bool hasManifest = false;   // which needs all nodes
    bool isTurned = false;      // the program of the master turns the clock, and all nodes have devices
    bool hasProcesses = true;   // whose resources are judged; a simulated plant has none
    std::array<int, FaultKinds> weights{};

    /// Whether control connections are TLS with a key for each node, and frames are sealed.
    bool isSecured() const { return attemptsPerSecond > 0; }
    static std::optional<Profile> named(const QString &name);
    static QStringList names();
};

/// The faults of a run, in order: the same for the same profile, number and seed. Kinds come as
/// often as their weights say, up to one.
std::vector<Fault> planOf(const Profile &profile, int count, quint64 seed);

}  // namespace soak
