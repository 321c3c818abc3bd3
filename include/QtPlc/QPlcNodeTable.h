// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// A panel with masters and nodes of all plants: health (OK, Warning, Error, Unavailable), state,
/// lateness, execution time, round trip, and counters of late, lost, duplicated, rejected and
/// forged answers.
///
/// \code
/// QPlcNodeTable table;
/// const QJsonArray columns{"node", "health", "late"};
/// table.applySettings({{"columns", columns}, {"sort", "late"}, {"descending", true}});
/// \endcode
///
/// Settings:
/// - `columns`: keys of the columns: plant, node, health, transport, address, policy, state,
///   latenessP99, executionP50, executionP99, executionMaximum, roundTripP50, roundTripP99,
///   roundTripMaximum, late, lost, duplicated, rejected, forged.
/// - `sort`: key of the column by which rows are sorted; `descending`: true or false.
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcNodeTable : public QPlcWidget
{
    Q_OBJECT
public:
    /// Returns "Node table", the name of this kind of panel in layouts.
    static QString typeName() { return QStringLiteral("Node table"); }

    /// Makes a panel; it has no nodes outside of a window.
    explicit QPlcNodeTable(QWidget *parent = nullptr);
    ~QPlcNodeTable() override;

    QString kind() const override { return typeName(); }
    bool showsAllPlants() const override { return true; }
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QSize sizeHint() const override;

protected:
    void contextChanged() override;

private:
    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
/// The factory of this panel.
///
/// \ingroup panels
using QPlcNodeTableFactory = QPlcWidgetFactoryOf<QPlcNodeTable>;
