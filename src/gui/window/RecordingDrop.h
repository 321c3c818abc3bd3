// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QObject>
#include <QtCore/QStringList>

#include <functional>

class QMimeData;
class QWidget;

namespace qplc {

/// Lets people drop recordings, files or folders, anywhere on a window.
class RecordingDrop : public QObject
{
    Q_OBJECT
public:
    /// \param window  owns the object
    RecordingDrop(QWidget *window, std::function<void(const QStringList &paths)> dropped);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    /// The recordings of what is dragged; empty: there is something else, too.
    static QStringList pathsOf(const QMimeData *data);

    std::function<void(const QStringList &paths)> m_dropped;
};

}  // namespace qplc
