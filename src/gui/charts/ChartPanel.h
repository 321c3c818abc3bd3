// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ChartExport.h"
#include "QPlcPanelContext.h"

#include <QtCore/QElapsedTimer>

#include <functional>
#include <initializer_list>

class QAction;
class QMenu;
class QPlcWidget;

namespace qplc {

/// What all charts are as panels: they follow their window, draw only while they are seen and not
/// too often, look like the window, and have a menu and an export.
///
/// Each chart derives its private part from it, and says what it draws. A panel begins with
/// showLook(), which binds.
class ChartPanel
{
public:
    virtual ~ChartPanel();

    /// Takes over the colours of the window, and binds.
    void showLook();

protected:
    /// \param picture  of what is seen, for the export
    ChartPanel(QPlcWidget *panel, const ChartExport::Picture &picture);
    Q_DISABLE_COPY(ChartPanel)

    /// Finds what the settings mean now.
    virtual void bind() = 0;
    virtual void draw() = 0;
    /// After the palette of the panel.
    virtual void showTheme(const QPlcTheme &theme) = 0;
    virtual void takeValues() { schedule(); }
    /// Time axis, cursors or pointer.
    virtual void takeTime() { schedule(); }
    /// The past that was drawn is another one.
    virtual void takePast() { schedule(); }
    /// Often, while the panel is seen, and when it comes.
    virtual void tick() { schedule(); }
    virtual void resized() {}
    /// Null: that of the frame around.
    virtual QMenu *createMenu() { return nullptr; }

    QPlcPanelContext *context() const;
    ChartExport *exporter() const { return m_exporter; }
    /// Whether pictures are made for a video (Filming).
    bool isFilmed() const { return m_isFilmed; }
    /// Draws soon: at once, but not before setPause() is over.
    void schedule();
    /// Between the begins of two pictures [ms]
    void setPause(int pause) { m_pause = pause; }
    /// [ms]
    void setTickPeriod(int period) { m_ticks.setInterval(period); }
    /// Texts are as quiet as the numbers of axes.
    void setQuietTexts() { m_hasQuietTexts = true; }
    /// As addPanelAction(), to this panel.
    QAction *addAction(const QString &text, const QList<QKeySequence> &keys, const char *name,
                       const std::function<void()> &act) const;
    /// A menu that ends when it closes, with the actions of the panel of these names: groups, and
    /// what the frame around adds.
    QMenu *makeMenu(std::initializer_list<std::initializer_list<const char *>> groups) const;
    void addTo(QMenu *menu, std::initializer_list<const char *> names) const;
    /// The receiver of what a chart connects: it ends first.
    QObject *receiver() const;

private:
    class Events;
    void drawNow();

    QPlcWidget *m_panel;
    std::unique_ptr<Events> m_events;
    ChartExport *m_exporter;
    QTimer m_timer;
    QTimer m_ticks;
    QElapsedTimer m_sinceDrawing;
    int m_pause = 20;
    bool m_hasQuietTexts = false;
    bool m_isFilmed = false;
    QColor m_surface;  // that the panel has
    QFont m_font;
};

}  // namespace qplc
