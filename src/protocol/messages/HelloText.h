// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Greeting.h"
#include "QPlcSignalTable.h"

namespace qplc::messages {

/// The greeting of a master as JSON. The text of the table is made once: a large one takes longer
/// than others may wait. With the table the greeting is beforeTable() and table(), which all
/// clients share: hundreds that are greeted and do not read cost no copies of it.
class HelloText
{
public:
    explicit HelloText(const QPlcSignalTable &table);
    static QByteArray beforeTable(const MasterHello &hello);
    /// The field with the table, and the brace behind it.
    const QByteArray &table() const { return m_table; }
    static QByteArray withoutTable(const MasterHello &hello);

private:
    const QByteArray m_table;
};

}  // namespace qplc::messages
