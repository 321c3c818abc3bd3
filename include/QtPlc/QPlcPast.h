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

/// The history of one number, row by row and without a copy: for charts that draw much of it many
/// times a second. Most panels need only QPlcPanelContext::history(), which gives copied steps.
///
/// \code
/// class Chart : public QPlcWidget
/// {
/// protected:
///     void paintEvent(QPaintEvent *) override
///     {
///         const QPlcPast past = context()->past("power");
///         if (!past)
///             return;
///         const QPlcPast::Row end = past.endRow();
///         const QPlcPast::Range range = past.range(past.firstRow(), end);  // quick
///         QPolygonF line;
///         for (QPlcPast::Row row = past.firstRow(); row < end; ++row)
///             line.append({double(line.size()), past.value(row) - range.minimum});
///         QPainter(this).drawPolyline(line);
///     }
/// };
/// \endcode
///
/// A row is one cycle of the plant. Its number never changes. The window keeps the rows from
/// firstRow() to endRow(), 10 minutes by default. In each turn of the event loop new rows may come
/// and old ones go. Values have 32-bit precision; NaN means that there is no value.
///
/// You can keep an object as long as you like, also when its plant is removed. After
/// QPlcPanelContext::signalsChanged() it gets no new rows: ask QPlcPanelContext::past() again. The
/// history of a formula is calculated as long as an object of it exists.
///
/// \threadsafe a value type that shares its data: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcPast
{
public:
    using Time = qint64;  ///< time [ns] since 1970-01-01 UTC, on the clock of the plant
    using Row = quint64;  ///< number of a row
    /// Smallest and largest value of some rows.
    struct QTPLC_GUI_EXPORT Range
    {
        double minimum;  ///< smallest value; NaN: there is no value
        double maximum;  ///< largest value; NaN: there is no value
        /// Returns a range without values.
        static Range empty();
        /// Returns true if the range has no values.
        bool isEmpty() const { return !(minimum <= maximum); }
        /// Returns the smallest range that contains both.
        Range united(const Range &other) const;
    };

    /// Makes an object without a number.
    QPlcPast();
    /// Releases its share of the data.
    ~QPlcPast();
    /// Makes an object that shares the data of \a other.
    QPlcPast(const QPlcPast &other);
    /// Shares the data of \a other from now on.
    QPlcPast &operator=(const QPlcPast &other);

    /// Returns true if there is such a number. If not, read only expression, problem, text() and
    /// textOf().
    explicit operator bool() const { return d != nullptr; }

    QString expression;  ///< what was asked for: a reference, or a formula behind `=`
    QString problem;     ///< why there is no history, for people; empty: there is one
    QString plant;       ///< name of its plant
    /// Unit of the signal table; of a formula, what follows from its signals.
    QString unit;
    std::optional<double> minimum;  ///< lower limit of the signal table [unit]; not set: no limit
    std::optional<double> maximum;  ///< upper limit of the signal table [unit]; not set: no limit
    QPlcValueNames names;           ///< names of its values; empty: numbers
    bool isStepped = false;         ///< an integer or boolean: a value is valid until the next one

    /// Returns the expression for people: a formula without `=`.
    QString text() const { return textOf(expression); }
    /// Returns an expression for people: "power", "mean(power, 5)".
    static QString textOf(const QString &expression);
    /// Returns true if the newest values are current: the plant is connected, and its cycles
    /// arrive.
    bool isCurrent() const;
    /// Returns the age of the newest values [s]; -1: there are none, or the plant was removed.
    double age() const;
    /// Returns the time of the newest row of the plant; the history of a formula may not have it
    /// yet. 0: there is none.
    Time newestTime() const;
    /// Returns true if both histories have the same rows: equal numbers have equal times.
    bool sharesRows(const QPlcPast &other) const;

    /// Returns true if rows are not those of cycles: the window shows an overview of a recording
    /// that is too large for its memory. Two rows in turn then have the smallest and the largest
    /// value of an interval. When less of it is seen, the window reads all cycles, and emits
    /// QPlcPanelContext::signalsChanged().
    bool isOverview() const;

    /// Returns the number of the oldest row that is kept.
    Row firstRow() const;
    /// Returns the number behind the newest row.
    Row endRow() const;
    /// Returns true if no rows are kept.
    bool isEmpty() const { return firstRow() == endRow(); }
    /// Returns the first row at or after a time; endRow(): there is none.
    Row rowAt(Time time) const;
    /// Returns the row whose values were valid at a time; not set before the first row, and where
    /// the plant was interrupted.
    std::optional<Row> rowHoldingAt(Time time) const;
    /// Returns the time of a row.
    /// \pre firstRow() <= row < endRow(), as for all functions below
    Time time(Row row) const;
    /// Returns the value of a row; NaN: there is none.
    double value(Row row) const;
    /// Returns true if a row follows an interruption: no line leads to it.
    bool beginsAnew(Row row) const;
    /// Returns the worst quality of rows from \a begin to before \a end.
    QPlcQuality::Kind quality(Row begin, Row end) const;
    /// Returns the smallest and largest value of rows from \a begin to before \a end. Quick for any
    /// number of rows.
    Range range(Row begin, Row end) const;

private:
    friend struct qplc::PastRows;

    struct Q_DECL_HIDDEN Private;
    std::shared_ptr<const Private> d;
};
