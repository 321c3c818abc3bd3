// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// What happened, newest last: filtered by severity and words, and acknowledged. A double click, or Enter, shows the time of the event in all plots of the window.
///
/// N writes a note of a person into the log.
///
/// It follows the newest event unless somebody has scrolled up; who scrolls down again follows again.
///
/// Settings: `severity` ("information", default; "warning", "error": at least so severe), `unacknowledged` (true: only what asks to be acknowledged), `search`, and `columns` (keys of those that are
/// shown: time, severity, source, event).
///
/// Threads: the thread of the window.
class QTPLC_GUI_EXPORT QPlcEventLog : public QPlcWidget
{
    Q_OBJECT
public:
    static QString typeName() { return QStringLiteral("Event log"); }

    explicit QPlcEventLog(QWidget *parent = nullptr);
    ~QPlcEventLog() override;

    QString kind() const override { return typeName(); }
    bool showsAllPlants() const override { return true; }
    QJsonObject settings() const override;
    /// Settings that are missing have their defaults from here on.
    void applySettings(const QJsonObject &settings) override;
    QSize sizeHint() const override;

protected:
    void contextChanged() override;

private:
    void makeActions();
    void filter();

    struct Private;
    std::unique_ptr<Private> d;
};
using QPlcEventLogFactory = QPlcWidgetFactoryOf<QPlcEventLog>;
