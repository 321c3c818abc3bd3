// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QCoreApplication>

namespace awe {

/// KiteText::tr() translates the texts of what has no class of its own that could.
class KiteText
{
    Q_DECLARE_TR_FUNCTIONS(awe::KiteText)
};

}  // namespace awe
