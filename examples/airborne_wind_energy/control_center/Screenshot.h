// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QWidget>

namespace awe {

/// Writes a picture of a window as it is on the screen. \return false, and \a error as a sentence,
/// when it cannot be made or written
bool writeScreenshot(QWidget *window, const QString &fileName, QString *error);

}  // namespace awe
