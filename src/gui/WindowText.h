// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QCoreApplication>

namespace qplc {

/// WindowText::tr() translates the texts of what has no class of its own that could.
class WindowText
{
    Q_DECLARE_TR_FUNCTIONS(qplc::WindowText)
};

}  // namespace qplc
