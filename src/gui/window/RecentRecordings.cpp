// SPDX-License-Identifier: Apache-2.0
#include "RecentRecordings.h"

#include "WindowSettings.h"
#include "gui/WindowText.h"

#include <QtCore/QFileInfo>
#include <QtCore/QVariant>

namespace qplc {

namespace {

constexpr int mostRecordings = 8;

QString keyOfRecordings()
{
    return QStringLiteral("ControlCenter/recentRecordings");
}

}  // namespace

QVector<QStringList> RecentRecordings::all() const
{
    QVector<QStringList> recordings;
    const QVariantList kept = WindowSettings().value(keyOfRecordings()).toList();
    for (const QVariant &each : kept) {
        const QStringList paths = each.toStringList();
        if (!paths.isEmpty() && recordings.size() < mostRecordings)
            recordings.append(paths);
    }
    return recordings;
}

void RecentRecordings::add(const QStringList &paths)
{
    QStringList whole;
    for (const QString &path : paths)
        whole << QFileInfo(path).absoluteFilePath();
    QVector<QStringList> recordings = all();
    recordings.removeAll(whole);
    recordings.prepend(whole);
    QVariantList kept;
    for (const QStringList &each : recordings.mid(0, mostRecordings))
        kept << QVariant(each);
    WindowSettings().setValue(keyOfRecordings(), kept);
}

QString RecentRecordings::textOf(const QStringList &paths)
{
    const QFileInfo first(paths.value(0));
    const QString name = first.fileName().isEmpty() ? first.path() : first.fileName();
    return paths.size() < 2 ? name : WindowText::tr("%1 and %2 more").arg(name).arg(paths.size() - 1);
}

}  // namespace qplc
