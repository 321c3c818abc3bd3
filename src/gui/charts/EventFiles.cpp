// SPDX-License-Identifier: Apache-2.0
#include "EventFiles.h"

#include <QtCore/QDateTime>
#include <QtCore/QDir>
#include <QtCore/QStandardPaths>

#include <algorithm>

namespace qplc {

namespace {

const QString savesKey = QStringLiteral("on");
const QString folderKey = QStringLiteral("folder");
const QString mostKey = QStringLiteral("most");
const QString begins = QStringLiteral("event_");
constexpr int longestSignal = 60;  // [characters] of a file name

}  // namespace

// ---- settings ----

QString EventFileSettings::usualFolder()
{
    return QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation) + QStringLiteral("/events");
}

QJsonObject EventFileSettings::toJson() const
{
    QJsonObject object;
    if (isOn)
        object.insert(savesKey, true);
    if (!folder.isEmpty())
        object.insert(folderKey, folder);
    if (most != UsualMost)
        object.insert(mostKey, most);
    return object;
}

EventFileSettings EventFileSettings::fromJson(const QJsonObject &object)
{
    return {object.value(savesKey).toBool(), object.value(folderKey).toString(),
            std::clamp(object.value(mostKey).toInt(UsualMost), 1, LargestMost)};
}

// ---- files ----

EventFiles::EventFiles(QObject *parent)
    : QObject(parent)
    , m_export(this)
{
    connect(&m_export, &PlotExport::finished, this, [this] {
        ++m_saved;
        Q_EMIT savedChanged();
        next();
    });
    connect(&m_export, &PlotExport::failed, this, [this](const QString &sentence) {
        fail(sentence);
        next();
    });
}

void EventFiles::begin(const EventFileSettings &settings)
{
    m_settings = settings;
    m_saved = 0;
    m_hasFailed = false;
    Q_EMIT savedChanged();
}

/// What no file system minds.
QString EventFiles::fileName(QPlcPast::Time event, const QString &signal)
{
    QString name;
    for (const QChar character : signal.left(longestSignal)) {
        const bool isPlain
            = character.unicode() < 0x80 && (character.isLetterOrNumber() || character == QLatin1Char('.'));
        name += isPlain ? character : QLatin1Char('-');
    }
    const QDateTime time = QDateTime::fromMSecsSinceEpoch(event / 1'000'000);
    return begins + time.toString(QStringLiteral("yyyy-MM-dd_HH-mm-ss.zzz_")) + name + QStringLiteral(".csv");
}

void EventFiles::save(QPlcPast::Time event, const QString &signal, std::shared_ptr<TextTable> table)
{
    if (m_waiting.size() == MostWaiting) {
        fail(tr("An event is not saved: events come faster than they can be written. Give the trigger a hold-off."));
        return;
    }
    m_waiting.push_back({fileName(event, signal), std::move(table)});
    next();
}

void EventFiles::next()
{
    if (m_export.isBusy() || m_waiting.empty())
        return;
    const Wanted wanted = m_waiting.front();
    m_waiting.pop_front();
    const QDir folder(m_settings.usedFolder());
    const int files = folder.entryList({begins + QStringLiteral("*.csv")}, QDir::Files).size();
    if (!folder.mkpath(QStringLiteral("."))) {
        fail(tr("Events are not saved: the folder %1 cannot be made. Choose another one.").arg(folder.path()));
    } else if (files >= m_settings.most) {
        fail(tr("Events are not saved any more: %1 has %2 files of events. Empty it, choose another folder, or allow "
                "more files.")
                 .arg(folder.path())
                 .arg(files));
    } else if (!folder.exists(wanted.file)) {
        m_export.save(wanted.table, folder.filePath(wanted.file));
        return;
    }
    next();
}

void EventFiles::cancel(const QString &reason)
{
    m_waiting.clear();
    m_export.cancel(reason);
}

void EventFiles::fail(const QString &sentence)
{
    if (!m_hasFailed)
        Q_EMIT failed(sentence);
    m_hasFailed = true;
}

}  // namespace qplc
