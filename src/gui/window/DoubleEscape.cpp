// SPDX-License-Identifier: Apache-2.0
#include "DoubleEscape.h"

#include <QtCore/QCoreApplication>
#include <QtGui/QKeyEvent>

namespace qplc {

namespace {

constexpr qint64 longestPause = 600;  // [ms]
constexpr qint64 samePress = 15;      // one press goes through several objects

}  // namespace

DoubleEscape::DoubleEscape(QObject *parent)
    : QObject(parent)
{
    QCoreApplication::instance()->installEventFilter(this);
}

bool DoubleEscape::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() != QEvent::KeyPress)
        return QObject::eventFilter(watched, event);
    const auto *key = static_cast<const QKeyEvent *>(event);
    if (key->key() != Qt::Key_Escape)
        m_isArmed = false;
    else if (!key->isAutoRepeat())
        hear();
    return QObject::eventFilter(watched, event);
}

void DoubleEscape::hear()
{
    const qint64 pause = m_sinceLast.isValid() ? m_sinceLast.elapsed() : longestPause + 1;
    m_sinceLast.start();
    if (pause <= samePress)
        return;
    if (m_isArmed && pause <= longestPause) {
        m_isArmed = false;
        Q_EMIT pressed();
    } else {
        m_isArmed = true;
    }
}

}  // namespace qplc
