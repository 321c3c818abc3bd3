// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QAbstractItemModel>
#include <QtCore/QStringList>

/// The text of a cell of a table, as a person reads it.
inline QString cellText(const QAbstractItemModel &table, int row, int column)
{
    return table.index(row, column).data().toString();
}

/// The texts of a column, from the first row on.
inline QStringList columnTexts(const QAbstractItemModel &table, int column)
{
    QStringList texts;
    for (int row = 0; row < table.rowCount(); ++row)
        texts << cellText(table, row, column);
    return texts;
}
