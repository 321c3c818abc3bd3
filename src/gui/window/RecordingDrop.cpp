// SPDX-License-Identifier: Apache-2.0
#include "RecordingDrop.h"

#include <QtCore/QFileInfo>
#include <QtCore/QMimeData>
#include <QtCore/QUrl>
#include <QtGui/QDropEvent>
#include <QtWidgets/QWidget>

namespace qplc {

RecordingDrop::RecordingDrop(QWidget *window, std::function<void(const QStringList &paths)> dropped)
    : QObject(window)
    , m_dropped(std::move(dropped))
{
    window->setAcceptDrops(true);
    window->installEventFilter(this);
}

QStringList RecordingDrop::pathsOf(const QMimeData *data)
{
    QStringList paths;
    for (const QUrl &url : data->urls()) {
        const QFileInfo file(url.toLocalFile());
        if (!file.isDir() && file.suffix() != QLatin1String("mcap"))
            return {};
        paths << file.filePath();
    }
    return paths;
}

bool RecordingDrop::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() != QEvent::DragEnter && event->type() != QEvent::Drop)
        return QObject::eventFilter(watched, event);
    auto *drop = static_cast<QDropEvent *>(event);
    const QStringList paths = pathsOf(drop->mimeData());
    if (paths.isEmpty())
        return QObject::eventFilter(watched, event);
    drop->acceptProposedAction();
    if (event->type() == QEvent::Drop)
        m_dropped(paths);
    return true;
}

}  // namespace qplc
