// SPDX-License-Identifier: Apache-2.0
#include "KeyButton.h"

#include "ManualBindings.h"

#include <QtGui/QKeyEvent>

namespace qplc {

KeyButton::KeyButton(int key, QWidget *parent)
    : QPushButton(parent)
    , m_key(key)
{
    setAccessibleName(tr("Key"));
    connect(this, &QPushButton::clicked, this, [this] { setWaiting(true); });
    setWaiting(false);
}

void KeyButton::setWaiting(bool waiting)
{
    m_isWaiting = waiting;
    const QString name = KeyBinding::keyName(m_key);
    setText(waiting ? tr("press a key") : name.isEmpty() ? tr("none") : name);
}

void KeyButton::take(int key)
{
    const bool isModifier = key == Qt::Key_Shift || key == Qt::Key_Control || key == Qt::Key_Alt || key == Qt::Key_Meta
        || key == Qt::Key_AltGr || key == Qt::Key_unknown;
    if (isModifier)
        return;  // there is more to come
    const bool isOther = key != Qt::Key_Escape && key != m_key;
    if (isOther)
        m_key = key;
    setWaiting(false);
    if (isOther)
        Q_EMIT keyChanged(key);
}

bool KeyButton::event(QEvent *event)
{
    const bool isKey = event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride;
    if (!m_isWaiting || !isKey)
        return QPushButton::event(event);
    event->accept();
    if (event->type() == QEvent::KeyPress)
        take(static_cast<QKeyEvent *>(event)->key());
    return true;
}

void KeyButton::focusOutEvent(QFocusEvent *event)
{
    QPushButton::focusOutEvent(event);
    setWaiting(false);
}

}  // namespace qplc
