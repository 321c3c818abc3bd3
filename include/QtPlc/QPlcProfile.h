// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

/// How strict a plant is where its signal table, its nodes and its options do not say anything.
///
/// \code
/// QPlcMasterNode master;
/// master.setProfile(QPlcProfile::Plant);
/// \endcode
///
/// | default                      | Simulation            | Plant                             |
/// |------------------------------|-----------------------|-----------------------------------|
/// | watchdog of a node           | none                  | 0.5 s or 4 periods, the longer    |
/// | reaction of a watchdog       | the node reports      | the node goes to its safe state   |
/// | `hold` of a signal           | forever               | 3 cycles, then the safe value     |
/// | longest wait for a late node | forever               | 5 s, then the plant stops safely  |
/// | longest gap before a cycle   | any                   | 1 s, then the plant stops safely  |
/// | node that comes back         | keeps its state       | begins at its initial state       |
/// | arming                       | with security         | with security                     |
///
/// A setting of the signal table (`hold`), of a node (QPlcSlaveNode::activateWatchdog()) or of the
/// master (QPlcMasterNode::setLongestWait()) replaces one default. A listener has no watchdog by
/// default.
///
/// The master chooses the profile when an initialization or a start begins, and tells it to the
/// nodes. A phase keeps its profile. If setProfile() has not chosen one, it is the profile of the
/// manifest (QPlcManifest). If that is Automatic, too, or there is no manifest, the profile is
/// Plant in three cases: there is a manifest, a registered node drives real devices
/// (QPlcSlaveNode::setHardware()), or the master listens on an address other than loopback while
/// its clock is RealTime or Scaled. Otherwise it is Simulation.
///
/// \threadsafe the functions are
///
/// \ingroup master
struct QTPLC_EXPORT QPlcProfile
{
    Q_GADGET
public:
    /// The profiles.
    enum Value : quint8 {
        Automatic,  ///< the master chooses
        /// For a person at a desk: late answers, breakpoints and lost connections end nothing.
        Simulation,
        Plant  ///< for machines that move: late or lost nodes lead to safe values
    };
    Q_ENUM(Value)

    /// Returns "Automatic", "Simulation" or "Plant", as control messages and `qtplc state` use
    /// them.
    static QString name(Value profile);
    /// Reads a name that name() returns, in upper or lower case.
    /// \param profile  gets the result
    /// \return false for any other text; \a profile has not changed then
    static bool fromName(const QString &text, Value *profile);
};

Q_DECLARE_METATYPE(QPlcProfile::Value)
