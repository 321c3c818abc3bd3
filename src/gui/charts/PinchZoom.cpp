// SPDX-License-Identifier: Apache-2.0
#include "PinchZoom.h"

#include <QtWidgets/QGestureEvent>
#include <QtWidgets/QPinchGesture>
#include <QtWidgets/QWidget>

namespace qplc {

PinchZoom::PinchZoom(QWidget *canvas, QObject *parent)
    : QObject(parent)
    , m_canvas(canvas)
{
    canvas->setAttribute(Qt::WA_AcceptTouchEvents);
    canvas->grabGesture(Qt::PinchGesture);
    canvas->installEventFilter(this);
}

bool PinchZoom::eventFilter(QObject * /*watched*/, QEvent *event)
{
    return event->type() == QEvent::Gesture && take(static_cast<QGestureEvent *>(event));
}

bool PinchZoom::take(QGestureEvent *event)
{
    auto *pinch = static_cast<QPinchGesture *>(event->gesture(Qt::PinchGesture));
    if (!pinch)
        return false;
    event->accept(pinch);
    if (pinch->state() == Qt::GestureStarted)
        Q_EMIT began();
    const bool isScaled
        = pinch->changeFlags() & (QPinchGesture::ScaleFactorChanged | QPinchGesture::CenterPointChanged);
    if (isScaled && pinch->scaleFactor() > 0.0) {
        const QPointF moved = pinch->centerPoint() - pinch->lastCenterPoint();
        const QPointF about = pinch->centerPoint() - m_canvas->mapToGlobal(QPoint());
        Q_EMIT zoomed(1.0 / pinch->scaleFactor(), about, moved);
    }
    if (pinch->state() == Qt::GestureFinished || pinch->state() == Qt::GestureCanceled)
        Q_EMIT ended();
    return true;
}

}  // namespace qplc
