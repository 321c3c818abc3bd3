// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QObject>
#include <QtCore/QVector>

class QWidget;

namespace qplc {

/// Escape ends what a person drags on a widget, wherever the keyboard is: from then on the widget
/// hears no movement until the mouse button is up. The press of the key reaches nothing else.
class DragEscape : public QObject
{
    Q_OBJECT
public:
    /// \param widget  which is dragged on; more of them can be watched, too
    explicit DragEscape(QWidget *widget, QObject *parent);
    void watch(QWidget *widget);
    bool eventFilter(QObject *watched, QEvent *event) override;

Q_SIGNALS:
    void escaped();

private:
    bool hearMouse(const QEvent &event);
    void listenToKeys(bool listens);

    QVector<const QObject *> m_widgets;
    bool m_isPressed = false;
    bool m_isOver = false;  // Escape came, and the button is still down
};

/// Lets a widget believe that the left mouse button is up.
void sendRelease(QWidget *widget);

}  // namespace qplc
