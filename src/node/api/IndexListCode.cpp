// SPDX-License-Identifier: Apache-2.0
#include "IndexListCode.h"

#include "QPlcSignalIndexTable.h"
#include "QPlcSignalTable.h"

#include <algorithm>
#include <iterator>

namespace qplc {

bool IndexListCode::declare(const QPlcSignalTable &table, Declaration *declaration, QString *error)
{
    const QPlcSignalIndexList inputs = inputList();
    const QPlcSignalIndexList outputs = outputList();
    QStringList errors;
    for (const QString &unknown : inputs.unknownNames() + outputs.unknownNames())
        errors << table.unknownSignalText(unknown);
    for (QPlcSignalIndex index : inputs.toVector() + outputs.toVector()) {
        if (index >= table.size())
            errors << QStringLiteral("signal index %1 is not in the table of %2 signals; declare signals by name")
                          .arg(index)
                          .arg(table.size());
        else if (QPlcSignalIndexTable::name(index) != table.at(index).name)
            errors << QStringLiteral("signal '%1' has the index of signal '%2' in the table of the process; give node "
                                     "and process the same table")
                          .arg(table.at(index).name, QPlcSignalIndexTable::name(index));
    }
    declaration->inputs = inputs.toVector();
    declaration->outputs = outputs.toVector();
    std::copy_if(declaration->inputs.cbegin(), declaration->inputs.cend(), std::back_inserter(declaration->sameCycle),
                 [&](QPlcSignalIndex index) { return inputs.isSameCycle(index); });
    *error = errors.join(QStringLiteral("; "));
    return errors.isEmpty();
}

}  // namespace qplc
