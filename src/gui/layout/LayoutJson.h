// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Layout.h"
#include "QPlcParseError.h"

#include <QtCore/QByteArray>

#include <optional>

namespace qplc {

/// The version of layouts that this program writes, and the last one that it reads.
constexpr int LayoutVersion = 1;

/// A layout as JSON: keys sorted, one a line, so that versions can be compared. The same layout
/// always gives the same text.
QByteArray layoutToJson(const Layout &layout);

/// The layout of a text that layoutToJson() or a person wrote. Keys that are not known stay in the
/// layout; types of panels are not looked at.
/// \return nothing, and \a error with the place and the remedy, when the text is not a layout or is
///         of a newer version
std::optional<Layout> layoutFromJson(const QByteArray &text, QPlcParseError *error = nullptr);

/// Reads a layout from a file, which may have 16 MiB.
std::optional<Layout> readLayoutFile(const QString &fileName, QPlcParseError *error = nullptr);

/// Writes a layout to a file as a whole, or leaves the file as it was. \return false, and \a error
/// as a sentence, when it cannot be written
bool writeLayoutFile(const Layout &layout, const QString &fileName, QString *error = nullptr);

}  // namespace qplc
