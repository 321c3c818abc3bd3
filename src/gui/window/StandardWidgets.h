// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QList>

class QPlcWidgetFactory;

namespace qplc {

/// The factories of all panels that come with QtPlc::Gui, in the order of menus; made and
/// registered once in a program.
QList<QPlcWidgetFactory *> standardWidgets();

}  // namespace qplc
