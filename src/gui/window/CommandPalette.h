// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/WindowContext.h"

#include <QtWidgets/QFrame>

#include <functional>

class QLineEdit;
class QListWidget;

namespace qplc {

/// One thing that the palette can do.
struct PaletteItem
{
    QString text;
    QString group;  // "Layout", "Panel", "Signal": shown muted
    QString keys;
    std::function<void()> run;
};

/// Everything that the window can do, found by typing some of its letters; Enter does it, Escape
/// closes.
class CommandPalette : public QFrame
{
    Q_OBJECT
public:
    /// \param context  outlives the palette
    explicit CommandPalette(WindowContext *context, QWidget *parent);

    /// Opens over the parent. \param question  stands in the empty line
    void open(const QVector<PaletteItem> &items, const QString &question);
    QLineEdit *line() const { return m_line; }
    QListWidget *list() const { return m_list; }

    /// Places of the items that fit, best first, at most so many.
    static QVector<int> matches(const QVector<PaletteItem> &items, const QString &pattern, int most);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void fill();
    void runCurrent();

    WindowContext *m_context;
    QLineEdit *m_line;
    QListWidget *m_list;
    QVector<PaletteItem> m_items;
};

}  // namespace qplc
