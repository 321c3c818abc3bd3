// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QString>

#include <optional>

namespace qplc {

/// The first name that an object of the JSON text \a json has twice; nothing when all names are
/// unique.
///
/// To be asked before the text is given to QJsonDocument: where a name is doubled, that of Qt 5.15
/// takes the last value and never frees the others, so that a stranger could use up the memory.
/// What a text with errors gives does not matter, since no parser takes it. \pre its nesting is not
/// deep
std::optional<QString> doubledJsonName(const QByteArray &json);

}  // namespace qplc
