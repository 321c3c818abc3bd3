// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// Masters and nodes of all plants: a stop-light (OK, Warning, Error, Unavailable), state, lateness, execution time, round trip, and answers that were late, lost, duplicated, rejected or forged.
///
/// Settings: `columns` (keys of those that are shown: plant, node, health, transport, address, policy, state, latenessP99, executionP50, executionP99, executionMaximum, roundTripP50, roundTripP99,
/// roundTripMaximum, late, lost, duplicated, rejected, forged), `sort` (key of a column) and `descending`.
///
/// Threads: the thread of the window.
class QTPLC_GUI_EXPORT QPlcNodeTable : public QPlcWidget
{
    Q_OBJECT
public:
    static QString typeName() { return QStringLiteral("Node table"); }

    explicit QPlcNodeTable(QWidget *parent = nullptr);
    ~QPlcNodeTable() override;

    QString kind() const override { return typeName(); }
    bool showsAllPlants() const override { return true; }
    QJsonObject settings() const override;
    /// Settings that are missing have their defaults from here on.
    void applySettings(const QJsonObject &settings) override;
    QSize sizeHint() const override;

protected:
    void contextChanged() override;

private:
    struct Private;
    std::unique_ptr<Private> d;
};
using QPlcNodeTableFactory = QPlcWidgetFactoryOf<QPlcNodeTable>;
