// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcTheme.h"
#include "ZoomedAxes.h"
#include "gui/models/SiPrefix.h"
#include "gui/plot/XyCurve.h"

#include <qwt_plot.h>

class QwtPlotGrid;

namespace qplc {

/// The plot of an XY panel: curves, axes that hold what is shown, and the rule when to draw.
class XyCanvas : public QwtPlot, public ZoomedAxes
{
    Q_OBJECT
public:
    using Time = QPlcPast::Time;
    enum Aspect { Free, Equal };

    /// What a picture depends on besides curves and looks.
    struct Moment
    {
        Time begin = 0;
        Time end = 0;
        std::optional<Time> dot;  // empty: the newest values
        bool isStale = false;     // the dot is where the plant was
    };

    explicit XyCanvas(QWidget *parent = nullptr);
    ~XyCanvas() override;

    /// Shows these instead. Colours not given are those of the theme. The caller owns nothing of
    /// them any more.
    void setCurves(std::vector<std::unique_ptr<XyCurve>> curves, const std::vector<QColor> &colors);
    const std::vector<std::unique_ptr<XyCurve>> &curves() const { return m_curves; }
    void setTheme(const QPlcTheme &theme);
    void setAspect(Aspect aspect);
    /// Titles and colours of the curves as rich text; empty for less than two.
    QString legend() const;
    void zoom(double xFactor, double yFactor, QPointF about) override;
    void pan(QPointF by) override;
    void zoomTo(const QRectF &box) override;
    /// Axes that a person has zoomed stay so.
    bool isHeld() const { return m_isHeld; }
    /// Axes follow the curves again.
    void release() override;
    /// What is at a place of the canvas [px].
    QPointF valueAt(QPointF place) const;
    /// Draws what was at a moment, if the picture is another one than before. \return whether it
    /// was drawn
    bool show(const Moment &moment);

protected:
    void resizeEvent(QResizeEvent *event) override;

private:
    struct Span
    {
        double begin = 0.0;
        double end = 0.0;
        double length() const { return end - begin; }
    };
    /// All that makes a picture.
    struct Picture
    {
        Moment moment;
        std::vector<QPlcPast::Row> newest;  // of the curves, in the view
        quint64 looks = 0;
        bool operator==(const Picture &other) const;
    };

    Picture pictureOf(const Moment &moment) const;
    Span dataSpan(bool isOfX) const;
    static Span fitted(Span shown, Span data);
    Span shownSpan(QwtPlot::Axis axis) const;
    void hold(Span x, Span y);
    void scaleAxes();
    void makeUnitsEqual(Span *x, Span *y) const;
    void showTitles();
    QString axisText(bool isOfX) const;
    /// Empty when curves have different ones.
    QString commonUnit(bool isOfX) const;
    bool fitPrefix(QwtPlot::Axis axis, const Span &shown, SiPrefix *prefix);
    void colorCurves();

    std::vector<std::unique_ptr<XyCurve>> m_curves;
    std::vector<QColor> m_colors;
    QPlcTheme m_theme;
    Aspect m_aspect = Free;
    std::unique_ptr<QwtPlotGrid> m_grid;
    Span m_x;  // empty: not yet
    Span m_y;
    SiPrefix m_xPrefix;
    SiPrefix m_yPrefix;
    bool m_isHeld = false;
    Picture m_picture;
    quint64 m_looks = 1;
};

}  // namespace qplc
