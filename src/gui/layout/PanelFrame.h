// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DropZone.h"
#include "LayoutEditor.h"

#include <QtCore/QMimeData>
#include <QtWidgets/QWidget>

#include <functional>

class QAction;
class QMenu;
class QPlcWidget;
class QPlcWidgetFactory;

namespace qplc {

class PanelTitleBar;
class SignalDropArea;

/// A panel on the screen: title bar, and below it the widget, or a placeholder where nobody can
/// make it.
///
/// What a person does here becomes edits; what the layout says comes by showPanel(). It draws its
/// line itself: styles leave out the right and the lower one at scale factors between whole
/// numbers.
class PanelFrame : public QWidget
{
    Q_OBJECT
public:
    /// \param editor     outlives the frame
    /// \param factories of all types; the widget is made by the one with the name of the panel's
    ///         type
    PanelFrame(LayoutEditor *editor, const LayoutPanel &panel, const QList<QPlcWidgetFactory *> &factories,
               QWidget *parent);

    ~PanelFrame() override;

    const QString &panelId() const { return m_id; }
    const QString &type() const { return m_type; }
    /// Null for a placeholder.
    QPlcWidget *widget() const { return m_widget; }
    PanelTitleBar *titleBar() const { return m_titleBar; }
    void setFactories(const QList<QPlcWidgetFactory *> &factories) { m_factories = factories; }
    /// Shows settings, title and the state of the buttons.
    void showPanel(const LayoutPanel &panel, const Layout &layout);

    /// What is done with the panel; all have texts and names, and those with buttons have icons.
    QAction *settingsAction() const { return m_settings; }
    QAction *floatAction() const { return m_float; }
    QAction *maximizeAction() const { return m_maximize; }
    QAction *closeAction() const { return m_close; }
    QAction *renameAction() const { return m_rename; }
    /// Makes the menu that is in the menu of the panel and opens by a click on the badge of its
    /// title, as a child of the widget that it gets; null: there is none now.
    using MakeMenu = std::function<QMenu *(QWidget *parent)>;
    void setPlantMenu(const MakeMenu &make) { m_makePlantMenu = make; }
    /// All that can be done with the panel: what its widget can, then where it stands. The caller
    /// owns it.
    QMenu *createMenu();

Q_SIGNALS:
    void signalsDropped(qplc::DropZone zone, const QMimeData *data);

protected:
    void contextMenuEvent(QContextMenuEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void dragEnterEvent(QDragEnterEvent *event) override;
    void dragMoveEvent(QDragMoveEvent *event) override;
    void dragLeaveEvent(QDragLeaveEvent *event) override;
    void dropEvent(QDropEvent *event) override;
    void paintEvent(QPaintEvent *event) override;

private:
    void makeActions();
    void makeContent(const LayoutPanel &panel, const QPlcWidgetFactory *factory);
    void connectActions();
    void applySettings(const LayoutPanel &panel);
    void takeSettings();
    void updateTitle();
    void openSettings();
    const SignalDropArea *dropAreaAt(QPoint position) const;
    void openMenu(const QPoint &place);
    void toggleFloating();
    void toggleMaximized();
    void offerMenuToWidget();
    void addOwnActions(QMenu *menu);
    void addPanelActions(QMenu *menu);
    QMenu *createSplitMenu(LayoutSide side, const QString &text, QWidget *parent);
    QMenu *createMoveMenu(QWidget *parent);
    QMenu *createSizeMenu(QWidget *parent);

    LayoutEditor *m_editor;
    QString m_id;
    QString m_type;
    QList<QPlcWidgetFactory *> m_factories;
    PanelTitleBar *m_titleBar;
    QPlcWidget *m_widget = nullptr;
    QJsonObject m_initialSettings;  // of the new widget: what a missing key means
    QJsonObject m_shownSettings;
    bool m_isApplying = false;
    QAction *m_settings = nullptr;
    QAction *m_float = nullptr;
    QAction *m_maximize = nullptr;
    QAction *m_close = nullptr;
    QAction *m_rename = nullptr;
    DropOverlay *m_overlay = nullptr;
    MakeMenu m_makePlantMenu;
};

}  // namespace qplc
