// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// All signals of all plants of a window, below the nodes that write them, with their present values and a search that is always there.
///
/// Enter or a double click asks for a plot of the selected signals (showRequested()), G for a gauge, W for a value table; they are dragged to panels too.
///
/// Settings: `search`, `columns` (keys of those that are shown: name, value, unit, age, description), `collapsed` and `expanded` (what is unlike the default: plants and nodes
/// are unfolded, triples are not).
///
/// Threads: the thread of the window.
class QTPLC_GUI_EXPORT QPlcSignalTree : public QPlcWidget
{
    Q_OBJECT
public:
    static constexpr int staticType = SignalTree;
    static QString typeName() { return QStringLiteral("Signal tree"); }

    explicit QPlcSignalTree(QWidget *parent = nullptr);
    ~QPlcSignalTree() override;

    int type() const override { return staticType; }
    QJsonObject settings() const override;
    /// Settings that are missing have their defaults from here on.
    void applySettings(const QJsonObject &settings) override;
    QSize sizeHint() const override;
    /// What is selected; plants and nodes stand for all of their signals. When nothing is selected and something searched for: the first that was found.
    QStringList selectedReferences() const;
    /// Gives the search the focus.
    void startSearch();

protected:
    void contextChanged() override;

private:
    void makeActions();
    void search(const QString &text);
    void request(const QString &typeName);

    struct Private;
    std::unique_ptr<Private> d;
};
using QPlcSignalTreeFactory = QPlcWidgetFactoryOf<QPlcSignalTree>;
