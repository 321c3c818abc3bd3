// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// All signals of all plants of a window, below the nodes that write them, with their present values and a search that is always there.
///
/// Enter or a double click asks for a plot of the selected signals (showRequested()), X for an XY plot, G for a gauge, W for a value table, S for a setter; they are dragged to panels too.
/// The context menu has all of these, and whatever else is among the actions().
///
/// Settings: `search`, `columns` (keys of those that are shown: name, value, unit, age, description), `collapsed` and `expanded` (what is unlike the default: plants and nodes
/// are unfolded, triples are not).
///
/// Threads: the thread of the window.
class QTPLC_GUI_EXPORT QPlcSignalTree : public QPlcWidget
{
    Q_OBJECT
public:
    static QString typeName() { return QStringLiteral("Signal tree"); }

    explicit QPlcSignalTree(QWidget *parent = nullptr);
    ~QPlcSignalTree() override;

    QString kind() const override { return typeName(); }
    bool showsAllPlants() const override { return true; }
    QJsonObject settings() const override;
    /// Settings that are missing have their defaults from here on.
    void applySettings(const QJsonObject &settings) override;
    QSize sizeHint() const override;
    /// What is selected; plants and nodes stand for all of their signals. When nothing is selected and something searched for: the first that was found.
    QStringList selectedReferences() const;
    /// Gives the search the focus.
    void startSearch();

Q_SIGNALS:
    /// selectedReferences() may be other ones.
    void selectionChanged();

protected:
    void contextChanged() override;
    void contextMenuEvent(QContextMenuEvent *event) override;

private:
    void makeActions();
    void updateActions();
    void openMenu(const QPoint &place);
    void openMenuAtRow();
    void search(const QString &text);
    void request(const QString &typeName);

    struct Private;
    std::unique_ptr<Private> d;
};
using QPlcSignalTreeFactory = QPlcWidgetFactoryOf<QPlcSignalTree>;
