// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QStringList>

namespace qplc {

/// Finds the folder of the documents (docs/control-center.md and others): installed with the
/// library, or in the source tree where it was built.
/// \param folders  where to begin: in these folders and those above them
/// \return empty: there is none
QString documentationFolder(const QStringList &folders);
/// Where this library and this program are.
QStringList documentationStarts();

}  // namespace qplc
