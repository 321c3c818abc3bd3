// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "models/FmuModel.h"

namespace fmu {

/// Inputs of an FMU over time, from a CSV file: a line with `time` and names of variables, then a
/// line for each time. Between two lines, continuous variables are interpolated, and others keep
/// their value. Of lines with the same time the last one counts. Elements of an array are separated
/// by blanks.
class CsvFile
{
public:
    static constexpr qint64 LargestFile = 256 * 1024 * 1024;  // [byte]

    /// Reads the file, and adds its variables to the inputs of \a model. \return false, with the
    /// reason and the place in \a error
    bool open(const QString &fileName, qplc::FmuModel *model, QString *error);
    /// Gives the inputs of \a time to the model. \param time  [s]
    void apply(double time);

private:
    struct Column
    {
        const qplc::FmuVariable *variable = nullptr;
        qplc::FmuExchange::Place place;
        QPlcSignalType type;        // of an element
        QVector<QByteArray> bytes;  // of each line
    };

    bool readHeader(const QByteArray &line, QString *error);
    bool readLine(const QByteArray &line, QString *error);

    qplc::FmuModel *m_model = nullptr;
    QVector<double> m_times;  // [s]
    QVector<Column> m_columns;
    int m_row = 0;  // of the last time
};

}  // namespace fmu
