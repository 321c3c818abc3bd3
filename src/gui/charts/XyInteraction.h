// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "XyCanvas.h"

#include <QtCore/QObject>

#include <optional>

class QMouseEvent;
class QRubberBand;
class QWheelEvent;

namespace qplc {

/// What a mouse and two fingers do over an XY plot: the wheel zooms about the mouse, over an axis only its values, with Ctrl those of y; dragging pans, over an axis only its values; dragging with Shift or the
/// right button zooms into a box; a double click wants all; the right button alone wants a menu.
class XyInteraction : public QObject
{
    Q_OBJECT
public:
    XyInteraction(XyCanvas *canvas, QObject *parent);

    /// Where the mouse is over the canvas [px]; empty: elsewhere.
    std::optional<QPoint> mouse() const { return m_mouse; }

Q_SIGNALS:
    void pressed();
    void mouseMoved();
    void allWanted();
    void menuWanted(const QPoint &global);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    enum Action { Nothing, Pan, Box };

    bool press(QWidget *watched, QMouseEvent *event);
    bool move(QWidget *watched, QMouseEvent *event);
    bool release(QMouseEvent *event);
    bool wheel(QWidget *watched, QWheelEvent *event);
    void followPinches();
    QPoint onCanvas(const QWidget *watched, QPoint position) const;
    void setMouse(std::optional<QPoint> position);

    XyCanvas *m_canvas;
    QRubberBand *m_box;  // of the canvas
    std::optional<QPoint> m_mouse;
    Action m_action = Nothing;
    bool m_isPinching = false;  // what a mouse does is by the first finger
    Qt::MouseButton m_button = Qt::NoButton;
    QPoint m_origin;  // of the drag
    QPoint m_last;
    bool m_hasMoved = false;
};

}  // namespace qplc
