// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcTheme.h"
#include "ZoomedAxes.h"
#include "gui/plot/SpectrumTable.h"

#include <QtCore/QVector>

#include <qwt_plot.h>

#include <optional>

class QwtPlotGrid;

namespace qplc {

class SpectrumCurve;
class SpectrogramItem;
class SpectrumCursor;

/// The plot of a panel of spectra: lines over the frequency, or a spectrogram, whose frequencies go
/// up; and a cursor at a frequency.
class SpectrumCanvas : public QwtPlot, public ZoomedAxes
{
    Q_OBJECT
public:
    struct Curve
    {
        QString title;
        QString unit;  // of the signal
        QColor color;
        Spectrum::Lines lines;
        bool isDensity = false;
    };
    struct Spectrogram
    {
        QString title;
        QString unit;  // of the signal
        Spectrum::Picture picture;
    };
    struct Looks
    {
        bool isLogFrequency = false;
        bool isLogValue = true;
    };

    explicit SpectrumCanvas(QWidget *parent = nullptr);
    ~SpectrumCanvas() override;

    void setTheme(const QPlcTheme &theme);
    void setLooks(const Looks &looks);
    /// Shows these instead; none: an empty plot.
    void show(const QVector<Curve> &curves);
    void show(const Spectrogram &spectrogram);
    const QVector<Curve> &curves() const { return m_curves; }
    bool isSpectrogram() const { return m_spectrogram != nullptr; }

    void zoom(double xFactor, double yFactor, QPointF about) override;
    void pan(QPointF by) override;
    void zoomTo(const QRectF &box) override;
    void release() override;
    bool isHeld() const { return m_isHeld; }

    /// Not set: there is none [Hz].
    void placeCursor(std::optional<double> frequency);
    std::optional<double> cursorFrequency() const { return m_cursor; }
    /// What is at a place of the canvas [px].
    double frequencyAt(QPointF place) const;
    double timeAt(QPointF place) const;  // [s], in a spectrogram
    /// The highest line near a frequency, as near as a hand is; 0: there is none.
    std::size_t lineNear(const Spectrum::Lines &lines, double frequency) const;
    /// The value of the spectrogram at a place; not set: there is none.
    std::optional<double> densityAt(double time, double frequency) const;

    /// What is seen of the axes: all of it, until somebody zooms.
    SeenRange seenFrequencies() const { return seen(frequencyAxis()); }
    SeenRange seenTimes() const { return seen(xBottom); }  // [s], in a spectrogram

    /// "m²/Hz", "(m/s)²/Hz"
    static QString densityUnit(const QString &unit);

protected:
    void resizeEvent(QResizeEvent *event) override;

private:
    void setEngines();
    void showAll();
    void scaleFrequency(double highest, double step);
    void scaleValues();
    void showColors();
    void showTitles();
    std::optional<QString> commonUnit() const;
    SeenRange seen(int axis) const;
    int frequencyAxis() const { return isSpectrogram() ? yLeft : xBottom; }
    void hold(QPointF topLeft, QPointF bottomRight);

    QPlcTheme m_theme;
    Looks m_looks;
    QVector<Curve> m_curves;
    std::vector<std::unique_ptr<SpectrumCurve>> m_items;
    std::unique_ptr<SpectrogramItem> m_spectrogram;  // null: lines are shown
    QString m_title;                                 // of the spectrogram
    QString m_unit;
    std::unique_ptr<SpectrumCursor> m_cursorItem;
    std::unique_ptr<QwtPlotGrid> m_grid;
    std::optional<double> m_cursor;
    bool m_isHeld = false;
};

}  // namespace qplc
