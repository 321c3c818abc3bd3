// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcMasterNode.h"
#include "node/statistics/Journal.h"

#include <functional>

namespace qplc {

/// The last error of a master: kept for those who ask, and told to the journal and to the program.
class MasterError
{
public:
    /// \param heard  called for each error
    MasterError(Journal &journal, std::function<void(QPlcMasterNode::Error)> heard);

    /// Forgets the last one. \return true
    bool clear();
    /// The master reports \a text about itself. \return false
    bool set(QPlcMasterNode::Error value, const QString &text);
    /// \param source  the node that is to blame, or the master
    /// \return false
    bool set(QPlcMasterNode::Error value, const QString &text, const QString &source, JournalEvent::Kind kind);

    QPlcMasterNode::Error value() const { return m_value; }
    QString text() const { return m_text; }

private:
    Journal &m_journal;
    const std::function<void(QPlcMasterNode::Error)> m_heard;
    QPlcMasterNode::Error m_value = QPlcMasterNode::NoError;
    QString m_text;
};

}  // namespace qplc
