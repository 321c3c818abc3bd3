// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcNodeRunner.h"

#include <memory>

namespace qplc_export {

/// What qtplc_add_fmu() and qtplc_add_discon() write down for their library.
struct Identity
{
    const char *name;         // of the target: letters, digits, underscores
    const char *description;  // for people; may be empty
    const char *table;        // text of the signal table
    qint64 period;            // [ns]; 0: the one of the host
    std::unique_ptr<QPlcSlaveNode> (*make)();
};
extern const Identity identity;

/// A node that somebody else's program calls, with its own table.
class ExportedNode
{
public:
    /// \return false, with a sentence in \a error
    bool make(QString *error);
    QPlcNodeRunner &runner() { return *m_runner; }
    const QPlcNodeRunner &runner() const { return *m_runner; }
    const QPlcSlaveNode &node() const { return *m_node; }
    const QPlcSignalDefinition &signal(QPlcSignalIndex index) const { return m_runner->table().at(index); }

private:
    std::unique_ptr<QPlcSlaveNode> m_node;
    std::unique_ptr<QPlcNodeRunner> m_runner;
};

}  // namespace qplc_export
