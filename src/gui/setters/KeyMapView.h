// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/Theme.h"
#include "gui/plant/SignalReference.h"

#include <QtWidgets/QWidget>

namespace qplc {

class ManualControl;

/// The keys and axes of a manual control as on a keyboard: a row for each signal, with its actual value, its keys, which light up while they are held, and what they do.
class KeyMapView : public QWidget
{
    Q_OBJECT
public:
    /// \param control  outlives the view
    KeyMapView(const ManualControl *control, QWidget *parent);
    void setTheme(const Theme &theme);
    /// Axes are shown where there is something to move them with.
    void setAxesShown(bool shown);
    /// Bindings, what is held, or actual values are other ones.
    void refresh();
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    struct Cap
    {
        QString text;
        QString effect;  // "-40"
        bool isLit = false;
    };
    struct Row
    {
        QString name;
        QString actual;
        bool isStale = false;
        QVector<Cap> caps;
    };
    QVector<Row> rows() const;
    QVector<Cap> capsOf(const SignalReference &reference) const;
    QFont smallFont() const;
    int capSize() const;
    int rowHeight() const;
    int widthOf(const Cap &cap) const;
    void paintRow(QPainter &painter, const Row &row, int top) const;
    void paintCap(QPainter &painter, const Cap &cap, const QRectF &place) const;

    const ManualControl *m_control;
    bool m_areAxesShown = false;
    Theme m_theme = Theme::byName(Theme::System);
};

}  // namespace qplc
