// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Layout.h"

#include <QtCore/QJsonObject>

namespace qplc {

/// Makes a layout of JSON. \return none: \a error is the first thing that is wrong, with its place:
/// "tabs[0].tree.children[1].share must be ..."
std::optional<Layout> readLayout(const QJsonObject &root, QString *error);

/// Words of a file, in the order of their values.
const QStringList &layoutOrientationWords();  // horizontal, vertical
const QStringList &layoutSideWords();         // as LayoutSide

}  // namespace qplc
