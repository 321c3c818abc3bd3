// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QObject>
#include <QtCore/QPoint>
#include <QtCore/QPointer>
#include <QtCore/QTimer>

class QMouseEvent;
class QWidget;

namespace qplc {

/// A finger that stays on a widget for 0.6 s opens its context menu. Mice have a button for that,
/// and are left alone. For all windows of the application.
class LongPress : public QObject
{
    Q_OBJECT
public:
    static constexpr int Delay = 600;  // [ms]

    /// From now on, as long as there is the application; once is enough.
    static void watch();

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    explicit LongPress(QObject *parent);
    void press(QWidget *widget, const QMouseEvent &event);
    void openMenu();

    QPointer<QWidget> m_pressed;
    QPoint m_place;  // on the screen
    QTimer m_timer;
};

}  // namespace qplc
