// SPDX-License-Identifier: Apache-2.0
#include "FullScreen.h"

#include "TerminalText.h"

#include <cerrno>
#include <unistd.h>

namespace tools {

namespace {

const QString alternateScreen = QStringLiteral("\033[?1049h\033[?25l\033[?7l");  // no cursor, no line breaks
const QString usualScreen = QStringLiteral("\033[?7h\033[?25h\033[?1049l");
const QString home = QStringLiteral("\033[H");
const QString restOfLine = QStringLiteral("\033[K");
const QString restOfScreen = QStringLiteral("\033[J");

struct KeyCode
{
    const char *bytes;
    FullScreen::Key key;
};

// Letters, and what terminals send for the keys with arrows.
const KeyCode keyCodes[] = {
    {"q", FullScreen::Quit},         {"Q", FullScreen::Quit},
    {"r", FullScreen::Reset},        {"k", FullScreen::Up},
    {"j", FullScreen::Down},         {" ", FullScreen::PageDown},
    {"g", FullScreen::Home},         {"G", FullScreen::End},
    {"\033[A", FullScreen::Up},      {"\033OA", FullScreen::Up},
    {"\033[B", FullScreen::Down},    {"\033OB", FullScreen::Down},
    {"\033[5~", FullScreen::PageUp}, {"\033[H", FullScreen::Home},
    {"\033[1~", FullScreen::Home},   {"\033[6~", FullScreen::PageDown},
    {"\033[F", FullScreen::End},     {"\033[4~", FullScreen::End},
};

}  // namespace

FullScreen::FullScreen()
{
    if (::tcgetattr(STDIN_FILENO, &m_before) == 0) {
        termios now = m_before;
        now.c_lflag &= ~tcflag_t(ICANON | ECHO);
        now.c_cc[VSUSP] = _POSIX_VDISABLE;  // a stopped program could not give the terminal back
        ::tcsetattr(STDIN_FILENO, TCSANOW, &now);
        m_keys = std::make_unique<QSocketNotifier>(STDIN_FILENO, QSocketNotifier::Read);
        connect(m_keys.get(), &QSocketNotifier::activated, this, [this] { readKeys(); });
    }
    printText(alternateScreen);
}

FullScreen::~FullScreen()
{
    printText(usualScreen);
    if (!m_keys)
        return;
    while (::tcsetattr(STDIN_FILENO, TCSADRAIN, &m_before) != 0 && errno == EINTR) {}  // a signal ends its wait
}

void FullScreen::show(const QStringList &lines)
{
    const TerminalSize size = terminalSize();
    QString text = home;
    const int count = qMin(lines.size(), size.lines);
    for (int i = 0; i < count; ++i) {
        // Erased before it is written: behind a full line the cursor stands on its last character.
        text
            += (i > 0 ? QStringLiteral("\r\n") : QString()) + (i + 1 < count ? restOfLine : restOfScreen) + lines.at(i);
    }
    printText(text);
}

void FullScreen::readKeys()
{
    char buffer[64];
    const ssize_t count = ::read(STDIN_FILENO, buffer, sizeof buffer);
    if (count <= 0) {  // the terminal is gone
        m_keys->setEnabled(false);
        Q_EMIT pressed(Quit);
        return;
    }
    QByteArray bytes(buffer, int(count));
    while (!bytes.isEmpty()) {
        int length = 1;
        for (const KeyCode &code : keyCodes) {
            if (bytes.startsWith(code.bytes)) {
                length = int(qstrlen(code.bytes));
                Q_EMIT pressed(code.key);
                break;
            }
        }
        bytes.remove(0, length);
    }
}

}  // namespace tools
