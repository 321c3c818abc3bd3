// SPDX-License-Identifier: Apache-2.0
#include "DoubleEscape.h"

#include <QtCore/QCoreApplication>
#include <QtGui/QKeyEvent>

namespace qplc {

namespace {

constexpr qint64 longestPause = 600;  // [ms]

}  // namespace

DoubleEscape::DoubleEscape(QObject *parent)
    : QObject(parent)
{
    QCoreApplication::instance()->installEventFilter(this);
}

bool DoubleEscape::eventFilter(QObject *watched, QEvent *event)
{
    const bool isPress = event->type() == QEvent::KeyPress;
    if (!isPress && event->type() != QEvent::KeyRelease)
        return QObject::eventFilter(watched, event);
    const auto *key = static_cast<const QKeyEvent *>(event);
    const bool isEscape = key->key() == Qt::Key_Escape;
    if (isPress && !isEscape)
        m_isArmed = false;
    else if (isPress && !key->isAutoRepeat())
        hear(qint64(key->timestamp()));
    else if (isEscape && !key->isAutoRepeat())
        m_isHeld = false;
    return QObject::eventFilter(watched, event);
}

/// \param time  when it was pressed [ms]; 0: not known
void DoubleEscape::hear(qint64 time)
{
    const bool isSame = time != 0 ? time == m_lastTime : m_isHeld;
    m_isHeld = true;
    if (isSame)
        return;
    const qint64 pause = time != 0 && m_lastTime != 0 ? time - m_lastTime : m_sinceLast.elapsed();
    m_lastTime = time;
    m_sinceLast.start();
    if (m_isArmed && pause >= 0 && pause <= longestPause) {
        m_isArmed = false;
        Q_EMIT pressed();
    } else {
        m_isArmed = true;
    }
}

}  // namespace qplc
