// SPDX-License-Identifier: Apache-2.0
#include "QPlcRecordedRows.h"

#include "QPlcRecordingPrivate.h"

#include <limits>

struct QPlcRecordedRows::Private
{
    bool hasRow() const { return rows && isThere; }
    const char *value(int column) const
    {
        return hasRow() && column >= 0 && std::size_t(column) < types.size() ? rows->value(std::size_t(column))
                                                                             : nullptr;
    }

    std::unique_ptr<qplc::RecordedRows> rows;
    std::vector<QPlcSignalType> types;
    bool isThere = false;
    QString error;
};

QPlcRecordedRows::QPlcRecordedRows(QPlcRecording &recording, const QStringList &names, qint64 begin, qint64 end)
    : d(std::make_unique<Private>())
{
    if (!recording.d->isOpen) {
        d->error = QStringLiteral("no recording is open");
        return;
    }
    qplc::Recording &inside = recording.d->recording;
    std::vector<int> columns;
    for (const QString &name : names) {
        const int signal = inside.indexOf(name);
        if (signal < 0) {
            d->error = QStringLiteral("the recording has no signal '%1'").arg(name);
            return;
        }
        columns.push_back(signal);
        d->types.push_back(inside.signalList()[std::size_t(signal)].definition.type);
    }
    d->rows = std::make_unique<qplc::RecordedRows>(inside, std::move(columns), begin, end);
}

QPlcRecordedRows::~QPlcRecordedRows() = default;

bool QPlcRecordedRows::isValid() const
{
    return d->rows != nullptr;
}

QString QPlcRecordedRows::errorString() const
{
    return d->error;
}

bool QPlcRecordedRows::next()
{
    d->isThere = d->rows && d->rows->next();
    return d->isThere;
}

qint64 QPlcRecordedRows::time() const
{
    return d->hasRow() ? d->rows->time() : 0;
}

qint64 QPlcRecordedRows::wallTime() const
{
    return d->hasRow() ? d->rows->wallTime() : 0;
}

quint64 QPlcRecordedRows::cycle() const
{
    return d->hasRow() ? d->rows->cycle().number : 0;
}

quint64 QPlcRecordedRows::skipped() const
{
    return d->hasRow() ? d->rows->cycle().skipped : 0;
}

qint64 QPlcRecordedRows::lateness() const
{
    return d->hasRow() ? d->rows->cycle().lateness : 0;
}

bool QPlcRecordedRows::hasValue(int column) const
{
    return d->value(column) != nullptr;
}

double QPlcRecordedRows::number(int column, int element) const
{
    const bool isNumber = d->value(column) && !d->types[std::size_t(column)].isString() && element >= 0
        && element < d->types[std::size_t(column)].count();
    return isNumber ? d->rows->number(std::size_t(column), element) : std::numeric_limits<double>::quiet_NaN();
}

QPlcValue QPlcRecordedRows::value(int column) const
{
    const char *bytes = d->value(column);
    if (!bytes)
        return {};
    const QPlcSignalType type = d->types[std::size_t(column)];
    const int size = int(d->rows->size(std::size_t(column)));
    if (!type.isString())
        return QPlcValue::fromBytes(type, QByteArray(bytes, size));
    const QPlcValue text(QString::fromUtf8(bytes, size));
    return text.convertedTo(type);
}

QPlcQuality QPlcRecordedRows::quality(int column) const
{
    return d->value(column) ? d->rows->quality(std::size_t(column)) : QPlcQuality(QPlcQuality::Invalid);
}

int QPlcRecordedRows::damages() const
{
    return d->rows ? d->rows->damages() : 0;
}
