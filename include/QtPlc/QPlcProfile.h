// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

/// How strict a plant is where its table, nodes and options say nothing.
///
/// ```cpp
/// master.setProfile(QPlcProfile::Plant);
/// ```
///
/// | default                          | Simulation             | Plant                                 |
/// |----------------------------------|------------------------|---------------------------------------|
/// | watchdog of a node               | none                   | 0.5 s or 4 periods, the longer one    |
/// | reaction of a watchdog           | the node reports       | the node goes to its safe state       |
/// | `hold` of a signal               | for ever               | 3 cycles, then the safe value         |
/// | longest wait for a late node     | for ever               | 5 s, then the plant stops safely      |
/// | longest gap before a cycle       | any                    | 1 s, then the plant stops safely      |
/// | node that comes back             | keeps its state        | begins at its initial state           |
/// | arming                           | with security          | with security                         |
///
/// A setting of the table (`hold`), a node (QPlcSlaveNode::activateWatchdog()) or the master (QPlcMasterNode::setLongestWait()) replaces the one
/// default that it is about. A listener has no watchdog by default.
///
/// The master chooses the profile when an initialization or a start begins, and tells the nodes; a phase keeps its profile.
/// Unless setProfile() says otherwise, the profile is Plant if a registered node drives real devices
/// (QPlcSlaveNode::setHardware()), or if the master listens on an address other than loopback while its clock is RealTime
/// or Scaled. Otherwise it is Simulation.
struct QTPLC_EXPORT QPlcProfile
{
    Q_GADGET
public:
    enum Value : quint8 {
        Automatic,   ///< the master chooses
        Simulation,  ///< for a person at a desk: late answers, breakpoints and lost connections end nothing
        Plant        ///< for machines that move: what is late or lost leads to safe values
    };
    Q_ENUM(Value)

    /// "Automatic", "Simulation", "Plant": as the control messages and `qtplc state` have it.
    static QString name(Value profile);
    /// Reads a name as of name(), in upper or lower case. \return false if \a text is none of them; \a profile has not changed
    static bool fromName(const QString &text, Value *profile);
};

Q_DECLARE_METATYPE(QPlcProfile::Value)
