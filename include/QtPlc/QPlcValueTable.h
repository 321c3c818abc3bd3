// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// A panel with chosen signals: value, smallest and largest value since reset, unit, quality, age
/// and rate.
///
/// \code
/// QPlcValueTable table;
/// table.applySettings({{"signals", QJsonArray{"power", "position[2]"}}, {"search", "tether"}});
/// \endcode
///
/// People add signals (drop them, or type a name after Insert), drag them out, sort them, and copy
/// them as text with tabs. A signal that does not exist stays as a grey row until it does. If a
/// person looks at the past, the table shows the values of that time.
///
/// Settings:
/// - `signals`: references in their order.
/// - `columns`: keys of the columns: signal, value, unit, minimum, maximum, quality, age, rate.
/// - `sort`: key of the column by which rows are sorted; `descending`: true or false.
/// - `search`: words that have to occur in name, unit, description, node or plant of a row. Ctrl+F
///   opens a line for them, Escape closes it.
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcValueTable : public QPlcWidget
{
    Q_OBJECT
public:
    /// Returns "Value table", the name of this kind of panel in layouts.
    static QString typeName() { return QStringLiteral("Value table"); }

    /// Makes an empty panel.
    explicit QPlcValueTable(QWidget *parent = nullptr);
    ~QPlcValueTable() override;

    QString kind() const override { return typeName(); }
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;
    QStringList shownSignals() const override;
    bool addSignals(const QStringList &references) override;
    QSize sizeHint() const override;

protected:
    void contextChanged() override;

private:
    Q_DECL_HIDDEN void makeActions();
    Q_DECL_HIDDEN void openAdding();
    Q_DECL_HIDDEN void openSearch();
    Q_DECL_HIDDEN void makeSearch();
    Q_DECL_HIDDEN void closeSearch();
    Q_DECL_HIDDEN void search(const QString &text);
    void takeSignals();

    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
/// The factory of this panel.
///
/// \ingroup panels
using QPlcValueTableFactory = QPlcWidgetFactoryOf<QPlcValueTable>;
