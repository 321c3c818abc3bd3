// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DropZone.h"
#include "LayoutEditor.h"
#include "QPlcWidget.h"

#include <QtCore/QHash>
#include <QtCore/QMap>
#include <QtCore/QMimeData>

class QMenu;
class QPlcWidgetFactory;
class QStackedWidget;
class QToolButton;

namespace qplc {

class FloatingWindow;
class LayoutTabBar;
class PageView;
class PanelFrame;

/// Shows the layout of an editor: tabs, splitters, panels, and floating windows. It holds no truth
/// of its own: what a person does becomes edits, and what is shown follows the layout.
///
/// A widget lives as long as a panel with its id and type is in the layout, wherever it is moved.
///
/// Threads: that of the window.
class LayoutView : public QWidget
{
    Q_OBJECT
public:
    /// \param editor  outlives the view
    explicit LayoutView(LayoutEditor *editor, QWidget *parent = nullptr);
    ~LayoutView() override;

    /// What can be shown. Placeholders whose factory comes are replaced. \param factories owned by
    /// others, outlive the view
    void setFactories(const QList<QPlcWidgetFactory *> &factories);
    LayoutEditor *editor() const { return m_editor; }
    /// Null when there is none; a placeholder has no widget.
    PanelFrame *frame(const QString &panelId) const { return m_frames.value(panelId); }
    QPlcWidget *widget(const QString &panelId) const;
    LayoutTabBar *tabBar() const { return m_tabBar; }
    /// That of the tab in front.
    PageView *currentPage() const;
    QList<FloatingWindow *> floatingWindows() const { return m_windows.values(); }
    /// Adds a panel to the current tab, where it fits (fittingPlace()). \return its id; empty when
    /// the layout is full
    QString addPanel(const QString &type, const QJsonObject &settings = {});

Q_SIGNALS:
    /// A person wants to add something: the button beside the tabs, or that of an empty tab, was
    /// clicked.
    void addRequested();
    /// A widget has been made for a panel.
    void widgetAdded(const QString &panelId, QPlcWidget *widget);
    /// The widget is deleted when control returns to the event loop.
    void widgetRemoved(const QString &panelId, QPlcWidget *widget);
    /// Signals (mime type signalsMimeType()) were dropped. \a panelId is empty, for the current tab
    /// (\a zone is the center) and for a new one.
    void signalsDropped(const QString &panelId, qplc::DropZone zone, const QMimeData *data);

private:
    friend class PanelDrag;

    void follow();
    void followPages();
    void makeFrames();
    void dropFrames(QHash<QString, PanelFrame *> gone);
    void makeFrame(const LayoutPanel &panel);
    PageView *newPage();
    void makeActions();
    void focusPanel(int step);
    QSize wantedSize(const QString &type);

    LayoutEditor *m_editor;
    QList<QPlcWidgetFactory *> m_factories;
    LayoutTabBar *m_tabBar;
    QToolButton *m_add;
    QStackedWidget *m_stack;
    QHash<QString, QSize> m_wantedSizes;  // by type
    QHash<QString, PanelFrame *> m_frames;
    QMap<QString, PageView *> m_pages;
    QMap<QString, FloatingWindow *> m_windows;
    class PanelDrag *m_drag;
};

}  // namespace qplc
