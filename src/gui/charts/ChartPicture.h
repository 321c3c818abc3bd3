// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>
#include <QtGui/QImage>

class QwtPlot;

namespace qplc {

/// Pictures of a chart, drawn anew at any size: as pixels for screens of high density, or as
/// vectors.
class ChartPicture
{
public:
    static constexpr int scale = 2;  // pixels of a picture for each of the window

    /// \param legend  below the plot, rich text; empty: none
    explicit ChartPicture(QwtPlot *plot, const QString &legend = QString());
    virtual ~ChartPicture();

    QImage image() const;
    /// By the ending of the name: ".svg" and ".pdf" for vectors, else PNG. \return a sentence when
    /// it failed
    QString save(const QString &fileName) const;

protected:
    virtual QSize size() const;
    virtual void paint(QPainter *painter) const;
    void paintPlot(QPainter *painter) const;

private:
    int legendHeight() const;
    QByteArray svg() const;
    QByteArray pdf() const;
    QByteArray png() const;

    QwtPlot *m_plot;
    QString m_legend;
};

}  // namespace qplc
