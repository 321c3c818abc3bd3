// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Evidence.h"

#include <QtCore/QStringList>

namespace soak {

/// One thing that must hold in every run. docs/soak.md says what each of them means.
struct Gate
{
    explicit Gate(const char *gateName)
        : name(QString::fromLatin1(gateName))
    {
    }

    QString name;
    bool isOfTime = false;  // a machine that stands still can make it fail: see SoakReport::Unjudged
    bool isAsked = true;    // of this run: there was something that could go wrong
    qint64 looked = 0;
    qint64 failed = 0;
    qint64 excused = 0;    // would have failed, had the machine not stood still meanwhile
    QStringList examples;  // of failures, the first ones
    QMap<QString, double> figures;

    /// A gate that looked at nothing has shown nothing.
    bool passed() const { return !isAsked || (failed == 0 && looked > 0); }
    void fail(const QString &text);
    void largest(const QString &figure, double value);
};

// Values (ValueGates.cpp)
Gate valuesAreWhole(const Evidence &evidence);     // what is seen has the check that belongs to it
Gate valuesWereWritten(const Evidence &evidence);  // its writer says that it wrote just this
Gate valuesNeverGoBack(const Evidence &evidence);  // nothing older after something newer
Gate stepsComeOnce(const Evidence &evidence);      // no cycle twice or backwards; missed ones are told

// Safe states (SafetyGates.cpp)
Gate silentWritersBecomeSafe(const Evidence &evidence);  // a drive goes safe after hold cycles without news
Gate nodesAloneBecomeSafe(const Evidence &evidence);     // a node without its master goes safe by itself
Gate nothingMovesByItself(const Evidence &evidence);     // after a safe state or another master: by the operator only
Gate safeStopsAreTold(const Evidence &evidence);         // a master that stops its nodes safely says so itself
Gate evictedNodesStayOut(
    const Evidence &evidence);                 // they neither register nor move, nor does a plant that needs them start
Gate noFalseAlarms(const Evidence &evidence);  // no loss, no safe state that no fault explains

// The plant as a whole (PlantGates.cpp)
Gate cyclesAddUp(const Evidence &evidence);       // computed + skipped == elapsed time / period
Gate faultsAreSeen(const Evidence &evidence);     // by an event, within hold + 2 cycles
Gate plantRecovers(const Evidence &evidence);     // within 2 s
Gate faultsAreCounted(const Evidence &evidence);  // exactly as many as there were

// Who takes part (MemberGates.cpp)
Gate startsHaveTheirNodes(const Evidence &evidence);     // a start without one is refused, and the node is named
Gate friendsGetIn(const Evidence &evidence);             // while strangers use up their budgets; the plant runs on
Gate silentJoinersAreDropped(const Evidence &evidence);  // and the plant starts without them
Gate safetyParametersAgree(const Evidence &evidence);    // of nodes and their master, also of another one

// Who does not belong (IntruderGates.cpp)
Gate attemptsAreRefused(const Evidence &evidence);  // of strangers: all of them, and each one is counted
Gate commandsAreDenied(const Evidence &evidence);   // of who may only look: likewise

// Frames on the way (LinkGates.cpp)
Gate linkFaultsAreCounted(const Evidence &evidence);  // what a link did, by frame

// Resources (ResourceGates.cpp)
Gate nothingLeaks(const Evidence &evidence);                         // descriptors and threads
Gate memoryStays(const Evidence &evidence, const Profile &profile);  // resident memory, and heap in use

/// All of them, in this order.
std::vector<Gate> judge(const Evidence &evidence, const Profile &profile);

}  // namespace soak
