// SPDX-License-Identifier: Apache-2.0
#include "Screenshot.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QFileInfo>
#include <QtCore/QSaveFile>
#include <QtGui/QImageWriter>
#include <QtGui/QScreen>

namespace awe {

namespace {

/// What the screen shows, with views that draw by OpenGL; of what it does not show, or keeps to
/// itself (Wayland), what the widgets draw.
QImage pictureOf(QWidget *window)
{
    QScreen *screen = window->screen();
    if (!screen->virtualGeometry().contains(window->geometry()))
        return window->grab().toImage();
    const QPixmap shown = screen->grabWindow(window->winId());
    return shown.isNull() ? window->grab().toImage() : shown.toImage();
}

}  // namespace

bool writeScreenshot(QWidget *window, const QString &fileName, QString *error)
{
    const QFileInfo place(fileName);
    if (place.exists() && !place.isFile()) {  // a device would be replaced by a file
        *error = QCoreApplication::translate("awe::Screenshot",
                                             "the picture '%1' cannot be written: this is no ordinary file")
                     .arg(fileName);
        return false;
    }
    QSaveFile file(fileName);
    QImageWriter writer(&file, place.suffix().toLatin1());
    writer.setCompression(100);
    if (file.open(QIODevice::WriteOnly) && writer.write(pictureOf(window)) && file.commit())
        return true;
    *error = QCoreApplication::translate("awe::Screenshot",
                                         "the picture '%1' cannot be written (%2): check folder, rights and space")
                 .arg(fileName, file.error() == QFileDevice::NoError ? writer.errorString() : file.errorString());
    return false;
}

}  // namespace awe
