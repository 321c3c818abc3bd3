// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlotCurves.h"
#include "gui/plot/CursorStatistics.h"

#include <QtWidgets/QWidget>

#include <optional>
#include <vector>

class QLabel;
class QTableWidget;
class QToolButton;

namespace qplc {

/// What happens between cursors A and B: one line with times, and a table with a line for each
/// curve, which can be folded away. Where runs are compared, it has their durations, too.
///
/// Long ranges are looked at a piece at a time; numbers that are not complete have "…".
class StatisticsView : public QWidget
{
    Q_OBJECT
public:
    explicit StatisticsView(QWidget *parent = nullptr);

    /// Shows the curves that are seen, and looks at some more rows.
    void show(const PlotCurves &curves, std::optional<CursorStatistics::Time> a,
              std::optional<CursorStatistics::Time> b);
    /// Shows the curves that are seen in all of the view, where runs are compared without cursors.
    void showView(const PlotCurves &curves, CursorStatistics::Time begin, CursorStatistics::Time end);
    /// Stores are others now.
    void reset() { m_statistics.clear(); }
    bool isUnfolded() const;
    void setUnfolded(bool isUnfolded);
    /// What the table may take at most [px]; there is always one line, and the rest is scrolled.
    void setRoom(int room);
    QTableWidget *table() const { return m_table; }
    /// "A 12:03:15.250   B 12:03:18.460   Δt 3.21 s   1/Δt 0.3115 Hz"
    QString timesText() const;

Q_SIGNALS:
    void unfoldedChanged();

protected:
    void resizeEvent(QResizeEvent *event) override;

private:
    void showTimes(std::optional<CursorStatistics::Time> a, std::optional<CursorStatistics::Time> b);
    void showCurves(const PlotCurves &curves, CursorStatistics::Time a, CursorStatistics::Time b);
    void showRow(int row, const PlotCurve &curve, CursorStatistics *statistics, CursorStatistics::Time a,
                 CursorStatistics::Time b);
    /// \return whether it is another one
    bool setText(int row, int column, const QString &text);
    void showColumns(bool hasCursors, bool hasRuns);
    int leastNumberWidth() const;
    int nameWidth() const;
    void fitWidth();
    void fitHeight();

    QToolButton *m_fold;
    QLabel *m_times;
    int m_room = 1000;  // [px]
    QTableWidget *m_table;
    std::vector<CursorStatistics> m_statistics;
};

}  // namespace qplc
