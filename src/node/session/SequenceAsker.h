// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSlaveSocket.h"
#include "protocol/messages/MessageTable.h"

#include <QtCore/QPointer>

namespace qplc {

/// The client that waits for the end of the sequence at hand, if there is one.
class SequenceAsker
{
public:
    /// \a asker gets its answer later. Who waited before hears no more.
    void wait(QPlcSlaveSocket *asker) { m_asker = asker; }
    /// The sequence has ended well.
    void done() { answer(messages::toMessage(messages::Done())); }
    void fail(const QString &reason)
    {
        answer(messages::toMessage(messages::Failed{messages::errorWord::nodeError, reason}));
    }

private:
    void answer(const QPlcMessage &message)
    {
        if (m_asker)
            m_asker->sendMessage(message);
        m_asker.clear();
    }

    QPointer<QPlcSlaveSocket> m_asker;
};

}  // namespace qplc
