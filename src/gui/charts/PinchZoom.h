// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QObject>
#include <QtCore/QPointF>

class QGestureEvent;
class QWidget;

namespace qplc {

/// Two fingers on the canvas of a chart: how far they have gone apart, and where to. The first one
/// is a mouse for Qt, whose drag is to be given up at began().
class PinchZoom : public QObject
{
    Q_OBJECT
public:
    PinchZoom(QWidget *canvas, QObject *parent);

Q_SIGNALS:
    void began();
    /// Since the last time. \param factor < 1: shows less \param about between the fingers [px]
    /// \param by that this place has moved [px]
    void zoomed(double factor, const QPointF &about, const QPointF &by);
    void ended();

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    bool take(QGestureEvent *event);

    QWidget *m_canvas;
};

}  // namespace qplc
