// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPanelContext.h"

#include <QtCore/QPointer>
#include <QtWidgets/QStyledItemDelegate>

namespace qplc {

/// Draws cells of tables: figures of one width where they stand at the right, and before some words
/// a sign whose form and colour say how things are.
class TableDelegate : public QStyledItemDelegate
{
    Q_OBJECT
public:
    /// Each with a form of its own: disc, triangle, square, ring.
    enum Sign { NoSign, Good, Warning, Alarm, Unknown, Note };
    using SignOf = Sign (*)(const QModelIndex &index);

    /// \param signOf  the sign of a cell; null: none has one
    explicit TableDelegate(SignOf signOf, QObject *parent = nullptr);
    void setContext(QPlcPanelContext *context) { m_context = context; }
    /// Where names differ at their ends: the middle of them is left out. \param column  -1: none
    void setNameColumn(int column) { m_nameColumn = column; }

    void paint(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const override;
    QSize sizeHint(const QStyleOptionViewItem &option, const QModelIndex &index) const override;

protected:
    void initStyleOption(QStyleOptionViewItem *option, const QModelIndex &index) const override;

private:
    SignOf m_signOf;
    int m_nameColumn = -1;
    QPointer<QPlcPanelContext> m_context;
};

}  // namespace qplc
