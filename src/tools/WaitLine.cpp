// SPDX-License-Identifier: Apache-2.0
#include "WaitLine.h"

#include "TerminalText.h"

#include <cstdio>
#include <unistd.h>

namespace tools {

namespace {

void writeToErrors(const QByteArray &text)
{
    std::fwrite(text.constData(), 1, std::size_t(text.size()), stderr);
    std::fflush(stderr);
}

}  // namespace

WaitLine::~WaitLine()
{
    if (m_isShown)
        writeToErrors("\r\033[K");
}

void WaitLine::show(const QString &text)
{
    if (::isatty(STDERR_FILENO) == 0 || qgetenv("TERM") == "dumb")
        return;
    m_isShown = true;
    writeToErrors("\r" + cut(text, terminalSize().columns - 1).toUtf8() + "\033[K");
}

}  // namespace tools
