// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

namespace tools {

/// A line on the standard error that says how far a command is while a person waits for it. Each
/// text takes the place of the one before; at the end the line is gone. Shows nothing where there
/// is no terminal.
class WaitLine
{
public:
    WaitLine() = default;
    ~WaitLine();

    void show(const QString &text);

private:
    bool m_isShown = false;

    Q_DISABLE_COPY(WaitLine)
};

}  // namespace tools
