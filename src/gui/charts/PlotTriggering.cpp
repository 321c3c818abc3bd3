// SPDX-License-Identifier: Apache-2.0
// The trigger of a time plot: its settings, and the files of its events.
#include "QPlcTimePlotPrivate.h"

using namespace qplc;

/// What a trigger shows goes into files; what goes wrong with them into the event log.
void QPlcTimePlot::Private::connectTrigger()
{
    connect(triggerBar, &TriggerBar::triggered, this, [this] { schedule(); });
    connect(triggerBar, &TriggerBar::settingsEdited, this, [this] {
        takeTrigger();
        Q_EMIT q->settingsEdited();
    });
    connect(triggerBar, &TriggerBar::savingBegins, this, [this] { eventFiles->begin(triggerBar->fileSettings()); });
    connect(triggerBar, &TriggerBar::eventCame, this, [this](Time event, Time begin, Time end) {
        const QString signal = triggerBar->settings().value(QStringLiteral("signal")).toString();
        eventFiles->save(event, signal, table(begin, end)(TableText::Csv));
    });
    connect(eventFiles, &EventFiles::savedChanged, this, [this] { triggerBar->showSaved(eventFiles->saved()); });
    connect(eventFiles, &EventFiles::failed, this, [this](const QString &sentence) {
        context()->report(QPlcPanelContext::Warning, QPlcTimePlot::tr("Trigger"), sentence);
    });
    connect(context(), &QPlcPanelContext::signalsChanged, this,
            [this] { eventFiles->cancel(QPlcTimePlot::tr("The signals have changed while an event was saved.")); });
}

/// Its time axis begins with the span that is seen.
void QPlcTimePlot::Private::toggleTrigger()
{
    PlotSettings wanted = settings;
    wanted.setTriggerOn(!settings.hasTrigger());
    wanted.runs.isOn = wanted.runs.isOn && !wanted.hasTrigger();
    if (!settings.hasOwnTime)
        wanted.span = wanted.hasTrigger() ? double(time.view()->span()) * 1e-9 : PlotSettings::defaultSpan;
    edit(wanted);
}

void QPlcTimePlot::Private::showTrigger()
{
    QStringList expressions;
    for (const PlotCurveSettings &curve : qAsConst(settings.curves))
        expressions << curve.signal;
    if (!settings.hasTrigger())
        triggerBar->hide();
    if (settings.trigger != shownTrigger)
        triggerBar->applySettings(settings.trigger);
    shownTrigger = settings.trigger;
    if (settings.hasTrigger()) {
        triggerBar->setSignals(expressions);
        triggerBar->show();
    }
    triggerAction->setChecked(settings.hasTrigger());
}

/// What a person has chosen in the bar; keys that nobody knows stay.
void QPlcTimePlot::Private::takeTrigger()
{
    for (const QString &key : TriggerBar::keys())
        settings.trigger.remove(key);
    const QJsonObject chosen = triggerBar->settings();
    for (auto entry = chosen.begin(); entry != chosen.end(); ++entry)
        settings.trigger.insert(entry.key(), entry.value());
    shownTrigger = settings.trigger;
    change();
}
