// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QElapsedTimer>
#include <QtCore/QObject>
#include <QtCore/QPointer>

class QKeyEvent;
class QWidget;

namespace qplc {

/// Hears Escape pressed twice within 0.6 s in any window of the program, and leaves the key to the
/// widgets that use it.
///
/// A press counts only if nothing uses it. It does not count, and is no first press either, if
/// - a widget, a shortcut or a dialog accepts the key: it closes a menu, cancels an edit, ...;
/// - it hides, closes or changes the state of a window or widget, or moves the focus;
/// - it is the first one since a mouse button went down that is still held: it ends what the person
///   drags. A person who holds a slider in a fright and presses Escape again and again stops the
///   plant;
/// - the person was typing into a field and has not pressed Enter since: the press ends the edit.
///
/// Several objects see one press. The time at which it was made tells presses apart. A press that a
/// program makes has no time: there the key has to be released before the next press.
class DoubleEscape : public QObject
{
    Q_OBJECT
public:
    explicit DoubleEscape(QObject *parent = nullptr);
    bool eventFilter(QObject *watched, QEvent *event) override;
    bool event(QEvent *event) override;

Q_SIGNALS:
    void pressed();

private:
    void hearKey(QObject *watched, const QKeyEvent &key);
    void hearOther(const QKeyEvent &key);
    void begin(qint64 time);
    void arrive();
    void judge();

    qint64 m_lastTime = 0;  // of the last press [ms]; 0: not known
    QElapsedTimer m_sinceLast;
    QPointer<QWidget> m_typedInto;  // a field, since the last Enter or Escape
    bool m_isHeld = false;          // it was not released since
    bool m_isArmed = false;         // the first press counted
    bool m_isSecond = false;        // the press that is under way came soon enough after a first one
    bool m_isDragging = false;      // a mouse button is down, and Escape has not come since
    bool m_isEndOfDrag = false;     // the press that is under way ends a drag
    bool m_hasArrived = false;      // it has come to a window, so that no widget uses it
    bool m_hasLeft = false;         // something closed or lost the focus during the press
};

}  // namespace qplc
