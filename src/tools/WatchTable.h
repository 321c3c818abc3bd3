// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcCore>

namespace tools {

/// The table of watch: a row for each element of each signal, with its value, the extremes seen,
/// and when it changed last, or its quality where that is not good.
class WatchTable
{
public:
    explicit WatchTable(const QVector<QPlcSignalDefinition> &definitions);

    /// \param values  one for each definition \param now  [s] on any clock that does not step
    /// \param qualities  one for each definition; empty: all good
    void update(const QVector<QPlcValue> &values, double now, const QVector<QPlcQuality> &qualities = {});
    /// The extremes begin with the next values.
    void forgetExtremes();
    int rowCount() const { return m_rows.size(); }
    /// Title and rows, from row \a first on, as many as fit. \param width, height of the place for
    /// it
    QStringList lines(int first, int width, int height, double now) const;

private:
    struct Row
    {
        QString name;
        QString unit;
        bool isNumber;
        QString value;
        double number = 0.0;
        double minimum = 0.0;
        double maximum = 0.0;
        bool hasExtremes = false;
        double changedAt = 0.0;  // [s]
        QPlcQuality quality = QPlcQuality::Good;
    };
    struct Widths
    {
        int name, value, unit;
        bool hasExtremes;
    };
    static void update(Row *row, const QString &text, double number, double now);
    Widths widths(int first, int count, int width) const;

    QVector<QPlcSignalDefinition> m_definitions;
    QVector<Row> m_rows;
};

}  // namespace tools
