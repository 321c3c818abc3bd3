// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "node/state/MasterStates.h"
#include "protocol/messages/MessageTable.h"

namespace qplc {

/// What the parts of a master can tell it.
class MasterControl
{
public:
    virtual QPlcMasterNode::State state() const = 0;
    /// Something has happened: the master goes to the next state as masterStates() says, and does
    /// what belongs to it.
    /// \param reason  for people; empty: none
    /// \return false when the present state refuses \a event; an error says why
    virtual bool apply(MasterEvent event, const QString &reason = QString()) = 0;
    /// Tells all clients how the initialization has ended.
    virtual void announce(const messages::StatesInitialized &news) = 0;

protected:
    ~MasterControl() = default;
};

}  // namespace qplc
