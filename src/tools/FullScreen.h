// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QSocketNotifier>
#include <QtCore/QStringList>

#include <memory>
#include <termios.h>

namespace tools {

/// The whole terminal for one program: its alternate screen, without a cursor, keys one by one. The
/// terminal is given back as it was when the object goes.
class FullScreen : public QObject
{
    Q_OBJECT
public:
    enum Key { Quit, Up, Down, PageUp, PageDown, Home, End, Reset };

    FullScreen();
    ~FullScreen() override;

    /// Shows \a lines from the top; what is too long or too much for the terminal is left out.
    void show(const QStringList &lines);

Q_SIGNALS:
    void pressed(tools::FullScreen::Key key);

private:
    void readKeys();

    std::unique_ptr<QSocketNotifier> m_keys;  // null: the standard input is no terminal
    termios m_before{};
};

}  // namespace tools
