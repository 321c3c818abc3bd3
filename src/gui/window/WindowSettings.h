// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QSettings>

namespace qplc {

/// What a window remembers: the settings of the organization and application that the program
/// names, or of QtPLC where it names no organization.
///
/// Windows of programs without an organization had them in a folder "Unknown Organization": what is
/// there and belongs to the window is taken over once.
class WindowSettings : public QSettings
{
public:
    WindowSettings();
};

}  // namespace qplc
