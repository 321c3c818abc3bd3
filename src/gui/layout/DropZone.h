// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QWidget>

namespace qplc {

/// Where in a panel something is dropped, or in no panel but a new tab. Area: a SignalDropArea of
/// the panel.
enum class DropZone { Left, Right, Above, Below, Center, NewTab, Area };
enum class DropCenter { IsAZone, BelongsToTheNearestEdge };

/// The zone of \a area at \a position, which may be outside. The center has the middle half of
/// width and height.
DropZone dropZoneAt(const QRect &area, const QPoint &position, DropCenter center);
/// What would be filled by what is dropped there.
QRect dropZoneRect(const QRect &area, DropZone zone);

/// A translucent rectangle over a widget that says where something would go.
class DropOverlay : public QWidget
{
    Q_OBJECT
public:
    DropOverlay();
    /// \param text  in the middle of it
    void showOver(QWidget *widget, const QRect &rect, const QString &text = QString());

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    QString m_text;
};

}  // namespace qplc

Q_DECLARE_METATYPE(qplc::DropZone)
