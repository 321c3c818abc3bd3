// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPanelContext.h"
#include "formulas/SignalReference.h"
#include "gui/models/SiPrefix.h"

#include <QtWidgets/QWidget>

namespace qplc {

class ManualControl;

/// The keys and axes of a manual control as on a keyboard: a row for each signal, with its actual
/// value, its keys, which light up while they are held, and what they do.
class KeyMapView : public QWidget
{
    Q_OBJECT
public:
    /// \param control  outlives the view
    KeyMapView(const ManualControl *control, QWidget *parent);
    void setTheme(const QPlcTheme &theme);
    /// Axes are shown where there is something to move them with.
    void setAxesShown(bool shown);
    /// Bindings, what is held, or actual values are other ones.
    void refresh();
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return {leastWidth(), rowHeight(NameBeside)}; }
    int heightForWidth(int width) const override;
    /// What a row says of its signal.
    QString valueText(int row) const { return rows().value(row).actual; }

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
    SiPrefix prefixOf(const SignalReference &reference, const QPlcPanelContext::Signal &signal) const;
    QVector<Cap> capsOf(const SignalReference &reference, const SiPrefix &prefix) const;
    QFont smallFont() const;
    int capSize() const;
    enum NamePlace { NameBeside, NameAbove };
    /// Names that have no room beside their keys are above them.
    NamePlace namePlace(int width) const;
    int rowHeight(NamePlace place) const;
    int capsWidth(const Row &row) const;
    int leastWidth() const;
    int widthOf(const Cap &cap) const;
    void paintRow(QPainter &painter, const Row &row, int top, NamePlace place) const;
    void paintCap(QPainter &painter, const Cap &cap, const QRectF &place) const;

    const ManualControl *m_control;
    bool m_areAxesShown = false;
    QPlcTheme m_theme;
};

}  // namespace qplc
