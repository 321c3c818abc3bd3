// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcTheme.h"

#include <QtCore/QVector>
#include <QtWidgets/QWidget>

#include <optional>

namespace qplc {

/// What moves over the curves of a plot without drawing them again: cursors, the line below the
/// mouse, the box of a zoom, and a hint where there is nothing to see.
class PlotOverlay : public QWidget
{
    Q_OBJECT
public:
    struct Dot
    {
        QPointF position;
        QColor color;
        friend bool operator==(const Dot &a, const Dot &b) { return a.position == b.position && a.color == b.color; }
    };
    struct Note
    {
        int place;  // [px] from the left edge
        QString text;
        friend bool operator==(const Note &a, const Note &b) { return a.place == b.place && a.text == b.text; }
    };
    struct Picture
    {
        std::optional<int> cursorA;  // [px] from the left edge
        std::optional<int> cursorB;
        std::optional<int> pointer;
        std::optional<int> playhead;
        QString pointerText;
        QVector<Dot> dots;  // where the pointer, or else the playhead, meets the curves
        QRect box;
        QString hint;
        std::optional<int> event;  // of a trigger
        QVector<Dot> levels;       // of a trigger, on the curve of its signal: only the height counts
        QVector<Note> notes;       // from left to right
    };

    explicit PlotOverlay(QWidget *canvas);

    void setTheme(const QPlcTheme &theme);
    const Picture &picture() const { return m_picture; }
    /// Drawn when it is another one.
    void show(const Picture &picture);
    /// Of the flags of the cursors, along the upper edge [px]
    int flagHeight() const { return fontMetrics().height(); }
    /// The same on any painter whose origin is that of the canvas.
    void paint(QPainter *painter) const;

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;
    void paintEvent(QPaintEvent *event) override;

private:
    void paintPlayhead(QPainter *painter) const;
    void paintPointer(QPainter *painter) const;
    void paintNotes(QPainter *painter) const;
    void paintDots(QPainter *painter) const;
    void paintCursor(QPainter *painter, int x, const QString &name) const;
    void paintTrigger(QPainter *painter) const;
    void paintBetween(QPainter *painter) const;

    QPlcTheme m_theme;
    Picture m_picture;
};

}  // namespace qplc
