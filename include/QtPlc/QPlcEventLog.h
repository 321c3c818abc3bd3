// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// A panel with the events of all plants, newest last: filtered by severity and words, and
/// acknowledged.
///
/// A double click, or Enter, shows the time of the event in all plots of the window. The panel
/// follows the newest event unless a person has scrolled up.
///
/// \code
/// QPlcEventLog log;
/// log.applySettings({{"severity", "warning"}, {"unacknowledged", true}});
/// \endcode
///
/// Settings:
/// - `severity`: "information" (default), "warning" or "error": at least this severity.
/// - `unacknowledged`: true shows only events that have to be acknowledged. Default false.
/// - `search`: words that have to occur.
/// - `columns`: keys of the columns: time, severity, source, event.
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcEventLog : public QPlcWidget
{
    Q_OBJECT
public:
    /// Returns "Event log", the name of this kind of panel in layouts.
    static QString typeName() { return QStringLiteral("Event log"); }

    /// Makes a panel; it has no events outside of a window.
    explicit QPlcEventLog(QWidget *parent = nullptr);
    ~QPlcEventLog() override;

    QString kind() const override { return typeName(); }
    bool showsAllPlants() const override { return true; }
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QSize sizeHint() const override;

protected:
    void contextChanged() override;

private:
    Q_DECL_HIDDEN void makeActions();
    Q_DECL_HIDDEN void filter();

    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
/// The factory of this panel.
///
/// \ingroup panels
using QPlcEventLogFactory = QPlcWidgetFactoryOf<QPlcEventLog>;
