// SPDX-License-Identifier: Apache-2.0
#include "DoubleEscape.h"

#include <QtCore/QCoreApplication>
#include <QtGui/QInputMethodEvent>
#include <QtGui/QKeyEvent>
#include <QtWidgets/QAbstractItemView>
#include <QtWidgets/QApplication>

namespace qplc {

namespace {

constexpr qint64 longestPause = 600;  // [ms]

QEvent::Type judgement()
{
    static const int type = QEvent::registerEventType();
    return QEvent::Type(type);
}

bool isMainWindow(const QWidget &widget)
{
    return widget.isWindow() && widget.windowType() == Qt::Window;
}

/// Whether a key that comes to \a object was used by no widget.
bool isEndOfTheWay(QObject *object)
{
    // A list takes every key for a search by letters, also this one.
    if (const auto *view = qobject_cast<QAbstractItemView *>(object))
        return isMainWindow(*view->window());
    if (const auto *widget = qobject_cast<QWidget *>(object))
        return isMainWindow(*widget);
    return object->isWindowType() && !object->inherits("QWidgetWindow");  // a window without widgets
}

bool isToolTip(QObject *object)
{
    const auto *widget = qobject_cast<QWidget *>(object);
    return widget && widget->window()->windowType() == Qt::ToolTip;
}

bool takesText(const QWidget &widget)
{
    return widget.inputMethodQuery(Qt::ImEnabled).toBool();
}

}  // namespace

DoubleEscape::DoubleEscape(QObject *parent)
    : QObject(parent)
{
    QCoreApplication::instance()->installEventFilter(this);
}

bool DoubleEscape::eventFilter(QObject *watched, QEvent *event)
{
    switch (event->type()) {
    case QEvent::ShortcutOverride:  // comes first, and alone where a shortcut uses the key
    case QEvent::KeyPress:
        hearKey(watched, *static_cast<const QKeyEvent *>(event));
        break;
    case QEvent::KeyRelease: {
        const auto *key = static_cast<const QKeyEvent *>(event);
        if (key->key() == Qt::Key_Escape && !key->isAutoRepeat())
            m_isHeld = false;
        break;
    }
    case QEvent::InputMethod:
        if (!static_cast<const QInputMethodEvent *>(event)->commitString().isEmpty())
            m_typedInto = QApplication::focusWidget();
        break;
    case QEvent::MouseButtonPress:
        m_isArmed = false;
        m_isDragging = true;
        break;
    case QEvent::MouseButtonRelease:
        m_isDragging = false;
        break;
    case QEvent::Hide:
    case QEvent::Close:
    case QEvent::FocusOut:
    case QEvent::WindowStateChange:
        m_hasLeft = m_hasLeft || !isToolTip(watched);
        break;
    default:
        break;
    }
    return QObject::eventFilter(watched, event);
}

bool DoubleEscape::event(QEvent *event)
{
    if (event->type() != judgement())
        return QObject::event(event);
    judge();
    return true;
}

void DoubleEscape::hearKey(QObject *watched, const QKeyEvent &key)
{
    if (key.key() != Qt::Key_Escape) {
        hearOther(key);
        return;
    }
    if (key.isAutoRepeat())
        return;
    begin(qint64(key.timestamp()));
    if (key.type() == QEvent::KeyPress && !m_hasArrived && isEndOfTheWay(watched))
        arrive();
}

void DoubleEscape::hearOther(const QKeyEvent &key)
{
    judge();
    m_isArmed = false;
    QWidget *const focus = QApplication::focusWidget();
    if (key.type() != QEvent::KeyPress || key.text().isEmpty() || !focus || !takesText(*focus))
        return;
    const bool isEnter = key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter;
    m_typedInto = isEnter ? nullptr : focus;
}

/// \param time  when it was pressed [ms]; 0: not known
void DoubleEscape::begin(qint64 time)
{
    const bool isSame = time != 0 ? time == m_lastTime : m_isHeld;
    m_isHeld = true;
    if (isSame)
        return;
    judge();  // the press before, if nothing was done since
    const qint64 pause = time != 0 && m_lastTime != 0 ? time - m_lastTime
        : m_sinceLast.isValid()                       ? m_sinceLast.elapsed()
                                                      : longestPause + 1;
    m_lastTime = time;
    m_sinceLast.start();
    m_isSecond = m_isArmed && pause >= 0 && pause <= longestPause;
    m_isArmed = false;
    m_hasArrived = false;
    m_hasLeft = false;
    m_isEndOfDrag = m_isDragging && QGuiApplication::mouseButtons() != Qt::NoButton;
    m_isDragging = false;  // the next press is no end of it, also if the button stays down
}

/// The window itself may use the key still; the next turn of the event loop knows.
void DoubleEscape::arrive()
{
    QWidget *const focus = QApplication::focusWidget();
    const bool isEdit = m_typedInto && m_typedInto == focus;
    m_typedInto.clear();
    if (isEdit || m_isEndOfDrag || QApplication::activePopupWidget())
        return;
    m_hasArrived = true;
    QCoreApplication::postEvent(this, new QEvent(judgement()), Qt::HighEventPriority);
}

void DoubleEscape::judge()
{
    if (!m_hasArrived)
        return;
    m_hasArrived = false;
    if (m_hasLeft)
        return;
    m_isArmed = !m_isSecond;
    if (m_isSecond)
        Q_EMIT pressed();
}

}  // namespace qplc
