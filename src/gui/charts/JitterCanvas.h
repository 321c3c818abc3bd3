// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "JitterDistributions.h"
#include "QPlcTheme.h"

#include <qwt_plot.h>

#include <memory>
#include <vector>

class QwtPlotGrid;

namespace qplc {

class JitterCurve;
class JitterFigures;

/// Histograms over a logarithmic axis of time [us], with logarithmic counts: one late cycle of a
/// million is seen as well as the bulk.
class JitterCanvas : public QwtPlot
{
    Q_OBJECT
public:
    explicit JitterCanvas(QWidget *parent = nullptr);
    ~JitterCanvas() override;

    void setTheme(const QPlcTheme &theme);
    /// Draws these instead. \param isStale  they are not those of now
    void show(const QVector<JitterDistribution> &distributions, bool isStale);
    /// Titles and colours as rich text; empty for less than two.
    QString legend() const;

protected:
    void resizeEvent(QResizeEvent *event) override;

private:
    void showTitles();
    void scaleAxes(const QVector<JitterDistribution> &distributions);
    void colorCurves();

    QPlcTheme m_theme;
    bool m_isStale = false;
    std::unique_ptr<QwtPlotGrid> m_grid;
    std::vector<std::unique_ptr<JitterCurve>> m_curves;
    std::vector<std::unique_ptr<JitterFigures>> m_figures;  // of each curve
};

}  // namespace qplc
