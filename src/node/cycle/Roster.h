// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LeaseTerm.h"
#include "NodeSlot.h"
#include "QPlcSchedule.h"
#include "RosterText.h"
#include "SafeValues.h"
#include "Schedule.h"

#include <memory>
#include <vector>

namespace qplc {

class NodeRegistry;

/// All nodes of a cycle and the order in which they are asked; never changed, but replaced as a
/// whole.
struct Roster
{
    /// A node in its stage.
    struct Turn
    {
        NodeSlot *slot = nullptr;
        bool feedsLaterStage = false;
    };
    /// A signal that somebody has taken over, until its term ends.
    struct HeldTerm
    {
        QPlcSignalIndex signal = QPlcInvalidSignalIndex;
        std::shared_ptr<LeaseTerm> term;
    };

    std::vector<std::shared_ptr<NodeSlot>> nodes;
    /// By index: signals that keep the value that they have been given, whatever their writer
    /// answers; empty: none.
    std::vector<bool> held{};
    /// By index: signals that have their safe value while the master stops safely.
    std::vector<bool> safe{};
    /// Of signals that are held, by index.
    std::vector<HeldTerm> terms{};
    /// Signals whose writer has left before it was among the nodes.
    std::vector<QPlcSignalIndex> abandoned{};

    // made by arrange()
    std::vector<bool> written{};  // by index: signals that have the values of their writers
    std::vector<std::vector<Turn>> stages{};
    std::vector<NodeSlot *> twoPhase{};
    std::vector<std::shared_ptr<NodeSlot>> multicast{};  // one node of each part
    SafeImage safeImage{};
    std::vector<SignalGuard::Frame> pasted{};      // of each node, without what is held; empty: nothing is
    std::vector<SignalGuard::Contest> contests{};  // signals that several nodes may write, but for what is held
    bool anyRemote = false;
    QByteArray text{};  // describe(), for recordings

    /// Puts the nodes into stages. \pre they have no algebraic loop: NodeRegistry admits none
    void arrange(const ProcessImage &image);
    /// What recordings say of it. \pre it is arranged
    RosterContent describe() const;
    bool isWritten(QPlcSignalIndex signal) const noexcept { return signal < written.size() && written[signal]; }
    /// Whether \a signal is held, and its holder lost.
    bool isNeutral(QPlcSignalIndex signal) const noexcept;

private:
    void findContests(const QPlcSignalTable &table);
};

/// What the nodes declare makes this order.
Schedule scheduleOf(const std::vector<std::shared_ptr<NodeSlot>> &nodes);
/// "A.in -> A.out -> B.in -> B.out -> A.in": the loop of \a schedule, port by port.
QString loopText(const Schedule &schedule, const std::vector<std::shared_ptr<NodeSlot>> &nodes,
                 const QPlcSignalTable &table);
/// The order of all nodes of \a registry whose cyclic channel is there, for people and programs.
QPlcSchedule describeSchedule(const NodeRegistry &registry, const QPlcSignalTable &table);

}  // namespace qplc
