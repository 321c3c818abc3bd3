// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"
#include "QPlcQuality.h"
#include "QPlcValueNames.h"

#include <QtCore/QString>

#include <memory>
#include <optional>

namespace qplc {
struct PastRows;
}

/// The past of one number, row by row and without a copy: for charts that draw much of it many times a second.
///
/// ```cpp
/// const QPlcPast past = context()->past(QStringLiteral("power"));
/// QPlcPast::Range range = past.range(past.rowAt(begin), past.rowAt(end));  // some steps, for a million rows
/// for (QPlcPast::Row row = past.rowAt(begin); row < past.rowAt(end); ++row)
///     addPoint(past.time(row), past.value(row), past.beginsAnew(row));
/// ```
/// A row is one cycle of the plant. Rows have numbers that never change. The window keeps those from firstRow()
/// up to endRow(), 10 minutes by default: in each turn of the event loop new ones may come, and old ones go.
/// Values have 32-bit precision; NaN: there is none. QPlcPanelContext::history() gives copied steps instead,
/// and is all that most panels need.
///
/// A past may be kept as long as you like, also when its plant goes. It ends with
/// QPlcPanelContext::signalsChanged(): from then on nothing is added to it, and past() gives the one that goes
/// on. The past of a formula is calculated as long as somebody keeps it.
///
/// A value type that shares its data. Threads: the thread of the window.
class QTPLC_GUI_EXPORT QPlcPast
{
public:
    using Time = qint64;  ///< [ns] since 1970, on the clock of the plant
    using Row = quint64;  ///< number of a row
    /// Smallest and largest value of rows.
    struct QTPLC_GUI_EXPORT Range
    {
        double minimum;  ///< NaN: there is no value
        double maximum;  ///< NaN: there is no value
        /// Returns a range that contains nothing.
        static Range empty();
        bool isEmpty() const { return !(minimum <= maximum); }
        /// Returns the smallest range that contains both.
        Range united(const Range &other) const;
    };

    QPlcPast();
    ~QPlcPast();
    QPlcPast(const QPlcPast &other);
    QPlcPast &operator=(const QPlcPast &other);

    /// Whether there is such a number. Else nothing but expression and problem may be read.
    explicit operator bool() const { return d != nullptr; }

    QString expression;             ///< what it was asked for: a reference, or a formula behind `=`
    QString problem;                ///< why there is nothing, for people; empty: there is a past
    QString plant;                  ///< name of its plant
    QString unit;                   ///< as in the signal table; of a formula, what follows from its signals
    std::optional<double> minimum;  ///< limit of the signal table
    std::optional<double> maximum;  ///< limit of the signal table
    QPlcValueNames names;           ///< names of its values; empty: numbers
    bool isStepped = false;         ///< an integer or a boolean: a value holds until the next one

    /// Returns what people read of it: formulas without `=`.
    QString text() const { return textOf(expression); }
    /// Returns what people read of an expression: "power", "mean(power, 5)".
    static QString textOf(const QString &expression);
    /// Whether the newest values are those of now: the plant is connected, and its cycles arrive.
    bool isCurrent() const;
    /// Returns the time since the newest values were true [s]; -1: there are none, or the plant has gone.
    double age() const;
    /// Returns the time of the newest row of the plant, which the past of a formula may not have yet; 0: there is none.
    Time newestTime() const;
    /// Whether its rows are those of \a other: the same numbers have the same times.
    bool sharesRows(const QPlcPast &other) const;

    /// Returns the first row that is kept.
    Row firstRow() const;
    /// Returns the row behind the last one.
    Row endRow() const;
    bool isEmpty() const { return firstRow() == endRow(); }
    /// Returns the first row at or after a time; endRow(): there is none.
    Row rowAt(Time time) const;
    /// Returns the row whose values held at a time. None before the first row, and where the plant was interrupted.
    std::optional<Row> rowHoldingAt(Time time) const;
    /// Returns the time of a row. \pre firstRow() <= row < endRow(), as for all that follows
    Time time(Row row) const;
    /// Returns the value of a row; NaN: there is none.
    double value(Row row) const;
    /// Whether a row begins after an interruption: no line leads to it.
    bool beginsAnew(Row row) const;
    /// Returns the least good quality of rows \a begin up to \a end, without \a end.
    QPlcQuality::Kind quality(Row begin, Row end) const;
    /// Returns smallest and largest value of rows \a begin up to \a end, without \a end. Takes some steps for any
    /// number of rows.
    Range range(Row begin, Row end) const;

private:
    friend struct qplc::PastRows;

    struct Private;
    std::shared_ptr<const Private> d;
};
