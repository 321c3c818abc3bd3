// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QPlcPanelContext.h>
#include <QPlcWidget.h>

#include <QtCore/QVector>

class QPainter;

namespace awe {

/// What the options of a plant show (docs/plant.md): electrical power and efficiency, steering,
/// tension at both ends of the tether, turbines on board, wind and density at heights, mast.
///
/// A row with a bar for each of these signals that the plant has, so a plant without options has
/// none. It has no settings of its own.
///
/// Threads: the thread of the window.
class OptionFigures : public QPlcWidget
{
    Q_OBJECT
public:
    static QString typeName() { return QStringLiteral("Plant options"); }

    explicit OptionFigures(QWidget *parent = nullptr);

    QString kind() const override { return typeName(); }
    /// Those that the plant has.
    QStringList shownSignals() const override;

    QSize minimumSizeHint() const override;
    QSize sizeHint() const override;

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    struct Row
    {
        QString title;
        QString reference;
        double minimum;  // of the bar
        double maximum;
        QPlcPanelContext::Signal signal;
    };
    QVector<Row> rows() const;
    void drawRow(QPainter *painter, const QRectF &area, const Row &row) const;
};

}  // namespace awe
