// SPDX-License-Identifier: Apache-2.0
#include "CsvFile.h"

#include "QPlcValue.h"
#include "signals/ConfigurationFile.h"
#include "signals/MessageText.h"

#include <QtCore/QFile>

#include <cmath>
#include <cstring>

namespace fmu {

using qplc::FmuVariable;
using qplc::quoted;

namespace {

QStringList cellsOf(const QByteArray &line)
{
    QStringList cells;
    const QStringList parts = QString::fromUtf8(line).split(QLatin1Char(','));
    for (const QString &part : parts) {
        QString cell = part.trimmed();
        if (cell.size() > 1 && cell.startsWith(QLatin1Char('"')) && cell.endsWith(QLatin1Char('"')))
            cell = cell.mid(1, cell.size() - 2);
        cells << cell;
    }
    return cells;
}

bool isContinuous(const FmuVariable &variable)
{
    return variable.variability == FmuVariable::Continuous
        && (variable.kind == FmuVariable::Float64 || variable.kind == FmuVariable::Float32);
}

template<typename Real>
void interpolate(const char *before, const char *after, double share, int count, char *result)
{
    for (int i = 0; i < count; ++i) {
        Real a = 0;
        Real b = 0;
        std::memcpy(&a, before + std::size_t(i) * sizeof(Real), sizeof(Real));
        std::memcpy(&b, after + std::size_t(i) * sizeof(Real), sizeof(Real));
        const Real value = Real(double(a) + share * (double(b) - double(a)));
        std::memcpy(result + std::size_t(i) * sizeof(Real), &value, sizeof(Real));
    }
}

}  // namespace

bool CsvFile::open(const QString &fileName, qplc::FmuModel *model, QString *error)
{
    m_model = model;
    QFile file(fileName);
    if (!file.open(QIODevice::ReadOnly)) {
        *error = QStringLiteral("%1 cannot be read: %2").arg(fileName, file.errorString());
        return false;
    }
    if (file.size() > LargestFile) {
        *error = QStringLiteral("%1 has more than %2 MiB").arg(fileName).arg(LargestFile >> 20);
        return false;
    }
    for (int number = 1; !file.atEnd(); ++number) {
        const QByteArray line = file.readLine().trimmed();
        if (line.isEmpty())
            continue;
        if (number == 1 ? !readHeader(line, error) : !readLine(line, error)) {
            *error = QStringLiteral("%1:%2: %3").arg(fileName).arg(number).arg(*error);
            return false;
        }
    }
    if (m_times.isEmpty())
        *error = QStringLiteral("%1 has no line with values").arg(fileName);
    return !m_times.isEmpty();
}

bool CsvFile::readHeader(const QByteArray &line, QString *error)
{
    const QStringList names = cellsOf(line);
    if (names.first() != QLatin1String("time")) {
        *error = QStringLiteral("the first column is %1; begin with 'time' and names of variables")
                     .arg(quoted(names.first()));
        return false;
    }
    for (const QString &name : names.mid(1)) {
        const FmuVariable *variable = m_model->description().find(name);
        if (!variable || !variable->isNumber() || !variable->isSettable()) {
            *error = variable ? QStringLiteral("%1 (%2) is not an input that is a number")
                                    .arg(quoted(name), variable->causalityText())
                              : QStringLiteral("the FMU has no variable %1%2")
                                    .arg(quoted(name), qplc::didYouMean(m_model->description().closeNames(name)));
            return false;
        }
        m_model->inputs().add(*variable);
        m_columns.append({variable, {}, QPlcSignalType(variable->scalar(m_model->description().version)), {}});
    }
    for (Column &column : m_columns)
        column.place = m_model->inputs().add(*column.variable);
    return true;
}

bool CsvFile::readLine(const QByteArray &line, QString *error)
{
    const QStringList cells = cellsOf(line);
    double time = 0.0;
    if (cells.size() != m_columns.size() + 1 || !qplc::finiteNumberFromText(cells.first(), &time)
        || (!m_times.isEmpty() && time < m_times.last())) {
        *error = QStringLiteral("a line needs %1 values, and a time that is not before the last one")
                     .arg(m_columns.size() + 1);
        return false;
    }
    m_times.append(time);
    for (int i = 0; i < m_columns.size(); ++i) {
        Column &column = m_columns[i];
        const QStringList texts = cells.at(i + 1).split(QLatin1Char(' '), Qt::SkipEmptyParts);
        QByteArray bytes;
        for (const QString &text : texts) {
            const QPlcValue value = QPlcValue::fromString(column.type, text, error);
            if (!value.isValid())
                return false;
            bytes += column.variable->kind == FmuVariable::Boolean
                ? QPlcValue(value.toBool()).convertedTo(column.type).toBytes()
                : value.toBytes();
        }
        if (texts.size() != column.variable->count) {
            *error
                = QStringLiteral("%1 needs %2 values").arg(quoted(column.variable->name)).arg(column.variable->count);
            return false;
        }
        column.bytes.append(bytes);
    }
    return true;
}

void CsvFile::apply(double time)
{
    constexpr double close = 0.5e-9;  // [s]
    while (m_row + 1 < m_times.size() && m_times.at(m_row + 1) <= time + close)
        ++m_row;
    const bool isLast = m_row + 1 == m_times.size() || time <= m_times.at(m_row);
    const double share = isLast ? 0.0 : (time - m_times.at(m_row)) / (m_times.at(m_row + 1) - m_times.at(m_row));
    for (const Column &column : qAsConst(m_columns)) {
        char *target = m_model->inputs().at(column.place);
        const QByteArray &before = column.bytes.at(m_row);
        if (share == 0.0 || !isContinuous(*column.variable))
            std::memcpy(target, before.constData(), std::size_t(before.size()));
        else if (column.variable->kind == FmuVariable::Float64)
            interpolate<double>(before.constData(), column.bytes.at(m_row + 1).constData(), share,
                                column.variable->count, target);
        else
            interpolate<float>(before.constData(), column.bytes.at(m_row + 1).constData(), share,
                               column.variable->count, target);
    }
}

}  // namespace fmu
