// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Greeting.h"
#include "QPlcSignalTable.h"

namespace qplc::messages {

/// The greeting of a master as JSON. The text of the table is made once: a large one takes longer
/// than others may wait.
class HelloText
{
public:
    explicit HelloText(const QPlcSignalTable &table);
    QByteArray withTable(const MasterHello &hello) const;
    static QByteArray withoutTable(const MasterHello &hello);

private:
    const QByteArray m_end;  // the field with the table, and the brace behind it
};

}  // namespace qplc::messages
