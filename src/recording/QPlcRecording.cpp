// SPDX-License-Identifier: Apache-2.0
#include "QPlcRecording.h"

#include "Happenings.h"
#include "QPlcRecordedRows.h"
#include "QPlcRecordingPrivate.h"

#include <algorithm>

namespace {

using qplc::Happening;

QString textIn(const Happening &happening, const char *key)
{
    return happening.text.value(QLatin1String(key)).toString();
}

QStringList listIn(const Happening &happening, const char *key)
{
    return happening.text.value(QLatin1String(key)).toVariant().toStringList();
}

void read(const Happening &happening, QPlcRecording::Event *event)
{
    event->severity = happening.severity();
    event->kind = happening.kind();
    event->text = textIn(happening, "text");
    event->alarm = textIn(happening, "alarm");
    event->isActive = happening.text.value(QLatin1String("active")).toBool();
}

void read(const Happening &happening, QPlcRecording::Command *command)
{
    command->command = textIn(happening, "command");
    command->signalName = textIn(happening, "signal");
    command->from = textIn(happening, "from");
    command->to = textIn(happening, "to");
    command->how = textIn(happening, "how");
    command->count = quint64(std::max(happening.text.value(QLatin1String("count")).toDouble(), 1.0));
    command->isAdopted = happening.text.value(QLatin1String("adopted")).toBool(true);
}

void read(const Happening &happening, QPlcRecording::Lease *lease)
{
    lease->what = textIn(happening, "what");
    lease->signalNames = listIn(happening, "signals");
    lease->from = listIn(happening, "from");
    lease->reason = textIn(happening, "reason");
}

/// \param d  QPlcRecording::Private
template<typename Kind, typename Private>
QVector<Kind> happenings(Private *d, int topic, qint64 begin, qint64 end, int most)
{
    QVector<Kind> result;
    d->error.clear();
    if (!d->isOpen) {
        d->error = QStringLiteral("no recording is open");
        return result;
    }
    qplc::HappeningReader reader(d->recording, topic);
    for (Happening happening; result.size() < most && reader.next(&happening);) {
        if (happening.time < begin || happening.time > end || happening.text.contains(QLatin1String("lost")))
            continue;
        Kind kind;
        kind.time = happening.time;
        kind.wallTime = happening.wallTime;
        kind.cycle = happening.cycle();
        kind.isBefore = happening.text.value(QLatin1String("before")).toBool();
        kind.by = happening.source();
        kind.role = textIn(happening, "role");
        kind.address = textIn(happening, "address");
        kind.client = textIn(happening, "client");
        read(happening, &kind);
        result.append(kind);
    }
    d->damages += reader.damages();
    return result;
}

}  // namespace

QPlcRecording::QPlcRecording()
    : d(std::make_unique<Private>())
{
}

QPlcRecording::~QPlcRecording() = default;
QPlcRecording::QPlcRecording(QPlcRecording &&other) noexcept = default;
QPlcRecording &QPlcRecording::operator=(QPlcRecording &&other) noexcept = default;

bool QPlcRecording::open(const QString &path)
{
    return open(QStringList{path});
}

bool QPlcRecording::open(const QStringList &paths)
{
    *d = {};
    d->isOpen = d->recording.open(paths, &d->error);
    return d->isOpen;
}

QString QPlcRecording::errorString() const
{
    return d->error;
}

QStringList QPlcRecording::notes() const
{
    return d->recording.notes();
}

QString QPlcRecording::plant() const
{
    return d->isOpen ? d->recording.description().plant : QString();
}

std::chrono::nanoseconds QPlcRecording::period() const
{
    return std::chrono::nanoseconds(d->isOpen ? d->recording.description().period : 0);
}

QPlcSignalTable QPlcRecording::signalTable() const
{
    return d->isOpen ? d->recording.table() : QPlcSignalTable();
}

qint64 QPlcRecording::begin() const
{
    return d->isOpen ? d->recording.begin() : 0;
}

qint64 QPlcRecording::end() const
{
    return d->isOpen ? d->recording.end() : 0;
}

bool QPlcRecording::isTimed() const
{
    return d->isOpen && d->recording.isTimed();
}

QVector<QPlcRecording::File> QPlcRecording::files() const
{
    QVector<File> files;
    if (!d->isOpen)
        return files;
    for (const qplc::RecordedFile &file : d->recording.files())
        files.append({file.name, file.begin, file.end, file.description.session, file.description.phase,
                      file.isFinished, file.name.contains(QLatin1String("_marked.mcap"))});
    return files;
}

QPlcRecording::Columns QPlcRecording::columns(const QStringList &names, qint64 begin, qint64 end, int most)
{
    Columns result;
    d->error.clear();
    QPlcRecordedRows rows(*this, names, begin, end);
    if (!rows.isValid()) {
        d->error = rows.errorString();
        return result;
    }
    for (const QString &name : names) {
        const QPlcSignalType type = d->recording.table().at(d->recording.table().indexOf(name)).type;
        if (type.isString()) {
            d->error = QStringLiteral("signal '%1' is a text; read it with QPlcRecordedRows").arg(name);
            return {};
        }
        Columns::Column column;
        column.size = type.count();
        result.columns.append(column);
    }
    while (result.times.size() < most && rows.next()) {
        result.times.append(rows.time());
        result.cycles.append(rows.cycle());
        for (int i = 0; i < result.columns.size(); ++i) {
            Columns::Column &column = result.columns[i];
            for (int element = 0; element < column.size; ++element)
                column.numbers.append(rows.number(i, element));
            column.qualities.append(rows.quality(i).toByte());
        }
    }
    d->damages += rows.damages();
    return result;
}

QVector<QPlcRecording::Message> QPlcRecording::messages(const QString &channel, qint64 begin, qint64 end, int most)
{
    QVector<Message> result;
    d->error.clear();
    if (!d->isOpen) {
        d->error = QStringLiteral("no recording is open");
        return result;
    }
    const QByteArray wanted = channel.toUtf8();
    qplc::RecordedRows rows(d->recording, {}, begin, end);
    rows.setOther([&](const QByteArray &topic, const qplc::mcap::Message &message) {
        if (topic == wanted && qint64(message.time) <= end && result.size() < most)
            result.append({qint64(message.time), QByteArray(message.bytes, int(message.size))});
    });
    while (result.size() < most && rows.next())
        continue;
    d->damages += rows.damages();
    return result;
}

QVector<QPlcRecording::Event> QPlcRecording::events(qint64 begin, qint64 end, int most)
{
    return happenings<Event>(d.get(), qplc::Happening::Event, begin, end, most);
}

QVector<QPlcRecording::Command> QPlcRecording::commands(qint64 begin, qint64 end, int most)
{
    return happenings<Command>(d.get(), qplc::Happening::Command, begin, end, most);
}

QVector<QPlcRecording::Lease> QPlcRecording::leases(qint64 begin, qint64 end, int most)
{
    return happenings<Lease>(d.get(), qplc::Happening::Lease, begin, end, most);
}

QVector<QPlcRecording::Extremes> QPlcRecording::overview(const QString &name, int element, qint64 begin, qint64 end,
                                                         int count)
{
    QVector<Extremes> result(std::max(count, 0));
    const int signal = d->isOpen ? d->recording.indexOf(name) : -1;
    if (signal < 0)
        return result;
    const QPlcSignalType type = d->recording.signalList()[std::size_t(signal)].definition.type;
    if (type.isString() || element < 0 || element >= type.count())
        return result;
    const std::vector<qplc::overview::Bucket> buckets = d->recording.overview(signal, element, begin, end, count);
    for (std::size_t i = 0; i < buckets.size(); ++i) {
        const quint8 flags = buckets[i].flags;
        const bool hasValue = (flags & qplc::overview::HasValue) != 0;
        result[int(i)] = {hasValue ? buckets[i].minimum : 0.0, hasValue ? buckets[i].maximum : 0.0, hasValue,
                          flags == qplc::overview::HasValue};
    }
    return result;
}

int QPlcRecording::damages() const
{
    return d->damages;
}
