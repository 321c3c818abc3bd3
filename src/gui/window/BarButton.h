// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/WindowContext.h"

#include <QtWidgets/QAbstractButton>

namespace qplc {

/// A button of the bars: flat, with a second line where it needs one, and sharp at every scale.
class BarButton : public QAbstractButton
{
    Q_OBJECT
public:
    enum Kind {
        Quiet,     // a text
        Outlined,  // a text in a frame, where Quiet would not be seen to be a button
        Link,      // a text that leads somewhere
        Primary,   // the next thing to do
        Stop       // red, always
    };

    /// \param context  outlives the button
    BarButton(Kind kind, WindowContext *context, QWidget *parent = nullptr);

    /// What stands after the text, muted: the keys, or a plant.
    void setDetail(const QString &detail);
    QString detail() const { return m_detail; }
    /// Quiet: in which colour the text is; invalid: as other texts.
    void setTextColor(const QColor &color);
    /// Quiet, without detail: in the middle unless set.
    void setTextAlignment(Qt::Alignment alignment) { m_alignment = alignment; }

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    QFont textFont() const;
    QFont detailFont() const;
    QColor background() const;
    QColor foreground() const;

    Kind m_kind;
    WindowContext *m_context;
    QString m_detail;
    QColor m_textColor;
    Qt::Alignment m_alignment = Qt::AlignCenter;
};

/// Draws the frame by which a person sees where keys go. \param rect  of the widget
void drawFocusRing(QPainter *painter, const QRectF &rect, const Theme &theme);

}  // namespace qplc
