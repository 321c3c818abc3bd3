// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcClock.h"
#include "QPlcProfile.h"
#include "QPlcSlaveNode.h"

#include <QtCore/QString>

#include <chrono>

namespace qplc {

/// What a profile says where table, nodes and options say nothing: the one place that knows.
struct ProfileDefaults
{
    std::int64_t hold;                  // [cycles] of a signal without `hold`
    std::chrono::nanoseconds watchdog;  // 0: none
    int watchdogPeriods;                // it is at least so many periods long
    QPlcSlaveNode::WatchdogReaction reaction;
    std::chrono::nanoseconds longestWait;  // for late nodes; 0: for ever
    std::chrono::nanoseconds gapLimit;     // 0: any
    bool keepsState;                       // a node that comes back to its phase goes on where it was

    /// \pre not Automatic
    static const ProfileDefaults &of(QPlcProfile::Value profile);

    /// Instead of longestWait where that is for ever, with the clock External: nothing may hold its
    /// program for longer.
    static constexpr std::chrono::nanoseconds longestStep = std::chrono::seconds(5);
};

/// The profile of a phase, and why.
struct ChosenProfile
{
    QPlcProfile::Value value = QPlcProfile::Simulation;
    QString reason;  // for people

    friend bool operator==(const ChosenProfile &a, const ChosenProfile &b)
    {
        return a.value == b.value && a.reason == b.reason;
    }
};

/// What the choice of a profile depends on.
struct ProfileFacts
{
    QPlcProfile::Value wanted = QPlcProfile::Automatic;
    bool hasManifest = false;
    QPlcProfile::Value ofManifest = QPlcProfile::Automatic;
    QString hardwareNode;    // name of a registered node with real devices; empty: there is none
    QString networkAddress;  // that the master listens on; empty: loopback, or none
    QPlcClock clock;
};

ChosenProfile chooseProfile(const ProfileFacts &facts);

}  // namespace qplc
