// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

namespace qplc {

/// What is dragged from trees and tables to panels: signals, as a JSON array of references
/// (plant/SignalReference.h).
inline QString signalsMimeType()
{
    return QStringLiteral("application/x-qtplc-signals");
}

}  // namespace qplc
