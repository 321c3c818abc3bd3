// SPDX-License-Identifier: Apache-2.0
// What of a time plot goes into files and the clipboard.
#include "ChartAction.h"
#include "QPlcTimePlotPrivate.h"

#include <algorithm>

using namespace qplc;

void QPlcTimePlot::Private::makeExportActions()
{
    exporter()->addTableActions([this] { return shownTable(); });
    addChartAction(q, QPlcTimePlot::tr("Export A ... B as CSV..."), {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_E)},
                   "saveBetween", [this] { exporter()->saveTable(tableBetweenCursors()); });
    addChartAction(q, QPlcTimePlot::tr("Copy A ... B as table"), {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_C)},
                   "copyBetween", [this] { exporter()->copyTable(tableBetweenCursors()); });
    exporter()->addPictureActions();
}

ChartExport::Table QPlcTimePlot::Private::table(Time begin, Time end) const
{
    return [this, begin, end](TableExport::Format format) {
        std::vector<TableExport::Column> columns;
        for (const PlotCurve &curve : curves) {
            if (curve.isSeen())
                columns.push_back(TableExport::Column::of(curve.source, curve.settings.text(), curve.settings.gain,
                                                          curve.settings.offset));
        }
        return TableExport(format, std::move(columns), begin, end);
    };
}

/// The range is that of the moment of the wish, whatever is seen when the name has been chosen.
ChartExport::Table QPlcTimePlot::Private::shownTable() const
{
    return table(canvas->begin(), canvas->end() - 1);
}

bool QPlcTimePlot::Private::hasBothCursors() const
{
    return shared()->cursor(QPlcTimeAxis::A) && shared()->cursor(QPlcTimeAxis::B);
}

ChartExport::Table QPlcTimePlot::Private::tableBetweenCursors() const
{
    if (!hasBothCursors())
        return shownTable();
    const Time a = *shared()->cursor(QPlcTimeAxis::A);
    const Time b = *shared()->cursor(QPlcTimeAxis::B);
    return table(std::min(a, b), std::max(a, b));
}

/// What a trigger shows goes into files; what goes wrong with them into the event log.
void QPlcTimePlot::Private::connectEventFiles()
{
    connect(triggerBar, &TriggerBar::savingBegins, this, [this] { eventFiles->begin(triggerBar->fileSettings()); });
    connect(triggerBar, &TriggerBar::eventCame, this, [this](Time event, Time begin, Time end) {
        const QString signal = triggerBar->settings().value(QStringLiteral("signal")).toString();
        eventFiles->save(event, signal, table(begin, end)(TableExport::Csv));
    });
    connect(eventFiles, &EventFiles::savedChanged, this, [this] { triggerBar->showSaved(eventFiles->saved()); });
    connect(eventFiles, &EventFiles::failed, this, [this](const QString &sentence) {
        context()->report(QPlcPanelContext::Warning, QPlcTimePlot::tr("Trigger"), sentence);
    });
    connect(context(), &QPlcPanelContext::signalsChanged, this,
            [this] { eventFiles->cancel(QPlcTimePlot::tr("The signals have changed while an event was saved.")); });
}
