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
    const qint64 pause = m_sinceFirst.isValid() ? m_sinceFirst.elapsed() : longestPause + 1;
    if (key->key() != Qt::Key_Escape) {
        m_sinceFirst.invalidate();
    } else if (!key->isAutoRepeat() && pause > longestPause) {
        m_sinceFirst.start();
    } else if (!key->isAutoRepeat() && pause > samePress) {
        m_sinceFirst.invalidate();
        Q_EMIT pressed();
    }
    return QObject::eventFilter(watched, event);
}

}  // namespace qplc
