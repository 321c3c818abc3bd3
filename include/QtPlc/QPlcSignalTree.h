// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// A panel with all signals of all plants of a window, below the nodes that write them, with
/// present values and a search.
///
/// \code
/// QPlcSignalTree tree;
/// QObject::connect(&tree, &QPlcSignalTree::selectionChanged, [&tree] {
///     qInfo("%s", qPrintable(tree.selectedReferences().join(", ")));
/// });
/// \endcode
///
/// Enter or a double click asks for a plot of the selected signals (showRequested()), X for an XY
/// plot, G for a gauge, W for a value table, S for a setter. People also drag signals to panels.
/// The context menu has these commands and all other actions().
///
/// Settings:
/// - `search`: words of the search.
/// - `columns`: keys of the columns: name, value, unit, age, description.
/// - `collapsed` and `expanded`: rows that differ from the default. By default plants and nodes are
///   expanded, and arrays are not.
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcSignalTree : public QPlcWidget
{
    Q_OBJECT
public:
    /// Returns "Signal tree", the name of this kind of panel in layouts.
    static QString typeName() { return QStringLiteral("Signal tree"); }

    /// Makes a panel; it has no signals outside of a window.
    explicit QPlcSignalTree(QWidget *parent = nullptr);
    ~QPlcSignalTree() override;

    QString kind() const override { return typeName(); }
    bool showsAllPlants() const override { return true; }
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QSize sizeHint() const override;
    /// Returns references of the selected signals. A plant or node stands for all of its signals.
    /// Without a selection it is the first signal that the search has found.
    QStringList selectedReferences() const;
    /// Moves the keyboard focus to the search.
    void startSearch();

Q_SIGNALS:
    /// Emitted when selectedReferences() may have changed.
    void selectionChanged();

protected:
    void contextChanged() override;
    void contextMenuEvent(QContextMenuEvent *event) override;

private:
    Q_DECL_HIDDEN void makeActions();
    Q_DECL_HIDDEN void updateActions();
    Q_DECL_HIDDEN void openMenu(const QPoint &place);
    Q_DECL_HIDDEN void openMenuAtRow();
    Q_DECL_HIDDEN void search(const QString &text);
    Q_DECL_HIDDEN void request(const QString &typeName);

    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
/// The factory of this panel.
///
/// \ingroup panels
using QPlcSignalTreeFactory = QPlcWidgetFactoryOf<QPlcSignalTree>;
