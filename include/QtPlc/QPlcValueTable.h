// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// Chosen signals with value, smallest and largest value since reset, unit, quality, age and rate. Signals are added (dropped on the panel, or by name after Insert), dragged out, sorted, and copied as text with tabs.
///
/// Settings: `signals` (references, in order), `columns` (keys of those that are shown: signal, value, unit, minimum, maximum, quality, age, rate), `sort` (key of a column), `descending`, and
/// `search`: words, all of which have to occur in name, unit, description, node or plant of the rows that are shown; Ctrl+F opens a line for them, Escape closes it.
///
/// A signal that does not exist (yet) stays as a grey row. In a window whose plots are frozen it shows the values of the time that is looked at.
///
/// Threads: the thread of the window.
class QTPLC_GUI_EXPORT QPlcValueTable : public QPlcWidget
{
    Q_OBJECT
public:
    static QString typeName() { return QStringLiteral("Value table"); }

    explicit QPlcValueTable(QWidget *parent = nullptr);
    ~QPlcValueTable() override;

    QString kind() const override { return typeName(); }
    QJsonObject settings() const override;
    /// Settings that are missing have their defaults from here on.
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;
    QStringList shownSignals() const override;
    bool addSignals(const QStringList &references) override;
    QSize sizeHint() const override;

protected:
    void contextChanged() override;

private:
    void makeActions();
    void openAdding();
    void openSearch();
    void makeSearch();
    void closeSearch();
    void search(const QString &text);
    void takeSignals();

    struct Private;
    std::unique_ptr<Private> d;
};
using QPlcValueTableFactory = QPlcWidgetFactoryOf<QPlcValueTable>;
