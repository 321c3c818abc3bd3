// SPDX-License-Identifier: Apache-2.0
#include "InlineEdit.h"

#include <QtGui/QKeyEvent>

namespace qplc {

InlineEdit::InlineEdit(const QString &text, const QRect &place, QWidget *parent)
    : QLineEdit(text, parent)
{
    setAccessibleName(tr("Name"));
    setTextMargins(0, 0, 0, 0);
    setGeometry(place);
    selectAll();
    show();
    setFocus(Qt::OtherFocusReason);
}

void InlineEdit::finish(Outcome outcome)
{
    if (m_isFinished)
        return;
    m_isFinished = true;
    const QString name = text().trimmed();
    deleteLater();
    hide();
    if (outcome == Take)
        Q_EMIT accepted(name);
}

void InlineEdit::keyPressEvent(QKeyEvent *event)
{
    if (event->key() == Qt::Key_Escape)
        return finish(Forget);
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter)
        return finish(Take);
    QLineEdit::keyPressEvent(event);
}

void InlineEdit::focusOutEvent(QFocusEvent *event)
{
    QLineEdit::focusOutEvent(event);
    if (event->reason() != Qt::PopupFocusReason && event->reason() != Qt::ActiveWindowFocusReason)
        finish(Take);
}

void InlineEdit::hideEvent(QHideEvent *event)
{
    QLineEdit::hideEvent(event);
    finish(Forget);
}

}  // namespace qplc
