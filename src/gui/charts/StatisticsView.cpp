// SPDX-License-Identifier: Apache-2.0
#include "StatisticsView.h"

#include "ChartLook.h"
#include "TimeTicks.h"
#include "gui/models/SiPrefix.h"
#include "gui/models/ValueFormat.h"
#include "gui/panel/FigureFont.h"
#include "gui/plot/PastRows.h"

#include <QtWidgets/QBoxLayout>
#include <QtWidgets/QHeaderView>
#include <QtWidgets/QLabel>
#include <QtWidgets/QTableWidget>
#include <QtWidgets/QToolButton>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

using Time = CursorStatistics::Time;

constexpr int mostRowsOfUpdate = 200'000;  // of all curves together: some milliseconds
constexpr int statisticsDigits = 4;
constexpr int cellMargin = 8;           // [px]
constexpr int swatch = 10;              // [px]
constexpr int mostLines = 6;            // of the table, before it scrolls
constexpr Time resolution = 1'000'000;  // of times in words [ns]

enum Column { Signal, ValueA, ValueB, Difference, Minimum, Maximum, Mean, Rms, Sigma, Integral, Duration, ColumnCount };

QString differenceText(Time difference)
{
    return durationText(double(difference));
}

/// Of the rows of a curve between two times of the plot.
QString lengthText(const PlotCurve &curve, Time a, Time b)
{
    const QPlcPast &past = curve.source;
    const auto [begin, end] = curve.ownTimes(a, b);
    const QPlcPast::Row first = past.rowAt(begin);
    const QPlcPast::Row behind = past.rowAt(end + 1);
    return first < behind ? differenceText(past.time(behind - 1) - past.time(first)) : QString();
}

}  // namespace

StatisticsView::StatisticsView(QWidget *parent)
    : QWidget(parent)
    , m_fold(new QToolButton(this))
    , m_times(new QLabel(this))
    , m_table(new QTableWidget(0, ColumnCount, this))
{
    const QFont small = smallFont(font());
    m_times->setFont(small);
    m_times->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_times->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_fold->setAutoRaise(true);
    m_fold->setFocusPolicy(Qt::TabFocus);
    m_fold->setIconSize(QSize(12, 12));
    m_fold->setAccessibleName(tr("Statistics between the cursors"));
    m_table->setFont(figureFont(small));
    m_table->setAccessibleName(tr("Values between cursors A and B"));
    m_table->setHorizontalHeaderLabels({tr("Signal"), QStringLiteral("A"), QStringLiteral("B"), tr("B − A"), tr("min"),
                                        tr("max"), tr("mean"), tr("rms"), QStringLiteral("σ"), QStringLiteral("∫ dt"),
                                        tr("duration")});
    m_table->horizontalHeader()->setFont(small);
    m_table->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
    m_table->horizontalHeader()->setSectionResizeMode(Signal, QHeaderView::Fixed);
    m_table->horizontalHeader()->setMinimumSectionSize(leastNumberWidth());
    m_table->horizontalHeader()->setHighlightSections(false);
    m_table->horizontalHeader()->setDefaultAlignment(Qt::AlignRight | Qt::AlignVCenter);
    m_table->horizontalHeaderItem(Signal)->setTextAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    m_table->setIconSize(QSize(swatch, swatch));
    m_table->setTextElideMode(Qt::ElideMiddle);
    m_table->setWordWrap(false);
    m_table->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
    m_table->verticalHeader()->hide();
    m_table->verticalHeader()->setMinimumSectionSize(1);
    m_table->verticalHeader()->setDefaultSectionSize(QFontMetrics(small).height() + 3);
    m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_table->setSelectionMode(QAbstractItemView::NoSelection);
    m_table->setFocusPolicy(Qt::NoFocus);
    m_table->setFrameShape(QFrame::NoFrame);
    m_table->setShowGrid(false);
    auto *line = new QHBoxLayout;
    line->addWidget(m_fold);
    line->addWidget(m_times, 1);
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addLayout(line);
    column->addWidget(m_table);
    connect(m_fold, &QToolButton::clicked, this, [this] {
        setUnfolded(!isUnfolded());
        Q_EMIT unfoldedChanged();
    });
    setUnfolded(true);
    showColumns(true, false);
}

bool StatisticsView::isUnfolded() const
{
    return !m_table->isHidden();
}

void StatisticsView::setUnfolded(bool isUnfolded)
{
    m_table->setVisible(isUnfolded);
    m_fold->setArrowType(isUnfolded ? Qt::DownArrow : Qt::RightArrow);
    m_fold->setToolTip(isUnfolded ? tr("Fold the statistics (S)") : tr("Show statistics between the cursors (S)"));
}

void StatisticsView::setRoom(int room)
{
    if (room == m_room)
        return;
    m_room = room;
    fitHeight();
}

QString StatisticsView::timesText() const
{
    return m_times->text();
}

void StatisticsView::show(const PlotCurves &curves, std::optional<Time> a, std::optional<Time> b)
{
    showTimes(a, b);
    if (!isUnfolded() || !(a || b))
        return;
    showColumns(true, curves.hasRuns());
    showCurves(curves, a ? *a : *b, b ? *b : *a);
}

void StatisticsView::showView(const PlotCurves &curves, Time begin, Time end)
{
    m_times->setText(tr("All that is seen, %1").arg(differenceText(end + 1 - begin)));
    if (!isUnfolded())
        return;
    showColumns(false, true);
    showCurves(curves, begin, end);
}

void StatisticsView::showColumns(bool hasCursors, bool hasRuns)
{
    if (hasCursors == !m_table->isColumnHidden(ValueA) && hasRuns == !m_table->isColumnHidden(Duration))
        return;
    for (const int column : {ValueA, ValueB, Difference, Sigma, Integral})
        m_table->setColumnHidden(column, !hasCursors);
    m_table->setColumnHidden(Duration, !hasRuns);
    fitWidth();
}

void StatisticsView::showTimes(std::optional<Time> a, std::optional<Time> b)
{
    QStringList parts;
    if (a)
        parts << QStringLiteral("A %1").arg(TimeTicks::clockText(*a, resolution));
    if (b)
        parts << QStringLiteral("B %1").arg(TimeTicks::clockText(*b, resolution));
    if (a && b) {
        parts << QStringLiteral("Δt %1").arg(differenceText(*b - *a));
        if (*a != *b)
            parts << QStringLiteral("1/Δt %1 Hz").arg(numberText(1e9 / double(*b - *a), statisticsDigits));
    }
    m_times->setText(parts.join(QStringLiteral("    ")));
}

void StatisticsView::showCurves(const PlotCurves &curves, Time a, Time b)
{
    std::vector<const PlotCurve *> seen;
    for (const PlotCurve &curve : curves) {
        if (curve.isSeen())
            seen.push_back(&curve);
    }
    if (m_table->rowCount() != int(seen.size())) {
        m_table->setRowCount(int(seen.size()));
        fitHeight();
    }
    m_statistics.resize(seen.size());
    for (int row = 0; row < int(seen.size()); ++row) {
        CursorStatistics &statistics = m_statistics[std::size_t(row)];
        const PlotCurve &curve = *seen[std::size_t(row)];
        const PastRows rows = PastRows::of(curve.source);
        const auto [begin, end] = curve.ownTimes(a, b);
        statistics.set(rows.store, rows.channel, curve.scaling(), begin, end);
        statistics.advance(mostRowsOfUpdate / int(seen.size()));
        showRow(row, curve, &statistics, a, b);
    }
}

void StatisticsView::showRow(int row, const PlotCurve &curve, CursorStatistics *statistics, Time a, Time b)
{
    const CursorStatistics::Result result = statistics->result();
    const double atA = curve.value(a);
    const double atB = curve.value(b);
    // One prefix for the line, but not for states and for the integral, whose unit is another one.
    double largest = 0.0;
    for (const double value : {atA, atB, result.minimum, result.maximum})
        largest = std::isnan(value) ? largest : std::max(largest, std::abs(value));
    const SiPrefix prefix = curve.names().isEmpty() ? SiPrefix::fitting(curve.source.unit, largest) : SiPrefix();
    const auto shown = [&](double value) { return numberText(prefix.shown(value), statisticsDigits, curve.names()); };
    const auto between = [&](double value) {
        return numberText(prefix.shown(value), statisticsDigits)
            + (statistics->isComplete() ? QString() : QStringLiteral(" …"));
    };
    if (setText(row, Signal, withUnit(curve.text(), prefix.unit())))
        fitWidth();
    m_table->item(row, Signal)->setData(Qt::DecorationRole, curve.swatchColor(atB));
    setText(row, ValueA, shown(atA));
    setText(row, ValueB, shown(atB));
    setText(row, Difference, numberText(prefix.shown(atB - atA), statisticsDigits));
    setText(row, Minimum, between(result.minimum));
    setText(row, Maximum, between(result.maximum));
    setText(row, Mean, between(result.mean));
    setText(row, Rms, between(result.rms));
    setText(row, Sigma, between(result.sigma));
    setText(row, Integral, between(result.integral));
    setText(row, Duration, lengthText(curve, a, b));
}

bool StatisticsView::setText(int row, int column, const QString &text)
{
    QTableWidgetItem *item = m_table->item(row, column);
    if (!item) {
        item = new QTableWidgetItem;
        item->setTextAlignment(Qt::AlignVCenter | (column == Signal ? Qt::AlignLeft : Qt::AlignRight));
        m_table->setItem(row, column, item);
    }
    const bool isOther = item->text() != text;
    if (isOther)
        item->setText(text);
    return isOther;
}

int StatisticsView::leastNumberWidth() const
{
    return QFontMetrics(m_table->font()).horizontalAdvance(QStringLiteral("-0.08888")) + cellMargin;
}

int StatisticsView::nameWidth() const
{
    int widest = 0;
    for (int row = 0; row < m_table->rowCount(); ++row) {
        const QTableWidgetItem *item = m_table->item(row, Signal);
        const int text = item ? QFontMetrics(m_table->font()).horizontalAdvance(item->text()) : 0;
        widest = std::max(widest, text + 2 * swatch);
    }
    return widest;
}

/// Names get what they need, if numbers keep enough.
void StatisticsView::fitWidth()
{
    const int forNumbers = (ColumnCount - 1 - m_table->horizontalHeader()->hiddenSectionCount()) * leastNumberWidth();
    const int least = 2 * leastNumberWidth();
    const int wanted = nameWidth() + cellMargin;
    m_table->setColumnWidth(Signal, std::max(least, std::min(wanted, width() - forNumbers)));
}

void StatisticsView::resizeEvent(QResizeEvent *event)
{
    QWidget::resizeEvent(event);
    fitWidth();
}

void StatisticsView::fitHeight()
{
    const int line = m_table->verticalHeader()->defaultSectionSize();
    const int header = m_table->horizontalHeader()->sizeHint().height() + 2;
    const int linesWithRoom = std::max((m_room - header) / line, 1);
    const int lines = std::min({m_table->rowCount(), mostLines, linesWithRoom});
    m_table->setFixedHeight(header + lines * line);
}

}  // namespace qplc
