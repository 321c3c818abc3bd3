// SPDX-License-Identifier: Apache-2.0
#include "PlantSummary.h"

#include "gui/WindowText.h"
#include "gui/models/ValueFormat.h"
#include "node/state/StateText.h"

#include <QtCore/QStringList>

#include <cmath>

namespace qplc {

QString linkText(double roundTrip, quint64 lost)
{
    const QString time = WindowText::tr("link %1").arg(durationText(roundTrip));
    return lost > 0 ? WindowText::tr("%1, %2 lost").arg(time).arg(lost) : time;
}

namespace {

QString figuresOf(const Plant &plant, const ViolationWatch &violations)
{
    const PlantStatus &status = plant.status();
    QStringList parts;
    if (!plant.identity().isEmpty())
        parts << WindowText::tr("%1 (%2)").arg(plant.identity(), plant.role());
    if (!status.master.profile.isEmpty())
        parts << status.master.profile;
    const qint64 ofMaster = status.master.period.count();
    const double period = double(ofMaster > 0 ? ofMaster : plant.values().period());
    if (period > 1.0) {
        const double rate = 1e9 / period;
        const QString text = WindowText::tr("%1 Hz").arg(rate, 0, 'g', 4);
        parts << (plant.every() == 1 ? text
                                     : WindowText::tr("%1, %2 shown").arg(text).arg(rate / plant.every(), 0, 'g', 4));
    }
    const QPlcDistribution &lateness = status.statistics.lateness.last10s;
    if (lateness.count > 0)
        parts << WindowText::tr("jitter %1 p99").arg(durationText(double(lateness.p99)));
    if (status.isRunning() && !plant.feed())
        parts << violations.text();
    const QPlcDistribution &roundTrip = status.statistics.roundTrip.last10s;
    if (roundTrip.count > 0)
        parts << linkText(double(roundTrip.p50), plant.ownNode() ? plant.ownNode()->statistics.lost : 0);
    return parts.join(QStringLiteral(" · "));
}

PlantSummary withoutConnection(const Plant &plant)
{
    const QString reason = plant.stateText();
    const bool wasThere = plant.store() != nullptr;
    if (plant.connectionState() == PlantConnection::Connecting)
        return {wasThere ? Tone::Alarm : Tone::Warning,
                wasThere ? WindowText::tr("lost; connecting") : WindowText::tr("connecting"),
                reason,
                {}};
    const double pause = plant.nextAttempt();
    const QString what = !plant.refusal().isEmpty() ? plant.refusal().section(QLatin1Char(':'), 0, 0)
        : wasThere                                  ? WindowText::tr("lost")
                                                    : WindowText::tr("not there");
    const QString next
        = pause >= 0.0 ? WindowText::tr("%1; next attempt in %2 s").arg(what).arg(std::ceil(pause)) : what;
    return {wasThere ? Tone::Alarm : Tone::Warning, next, reason, {}};
}

}  // namespace

QColor colorOf(const Theme &theme, Tone tone)
{
    switch (tone) {
    case Tone::Good:
        return theme.good;
    case Tone::Warning:
        return theme.warning;
    case Tone::Alarm:
        return theme.alarm;
    case Tone::Calm:
        break;
    }
    return theme.mutedText;
}

namespace {

PlantSummary conditionOf(const Plant &plant)
{
    if (plant.status().isLatched())
        return {Tone::Alarm,
                plant.status().master.state == messages::MasterState::Fault ? WindowText::tr("fault")
                                                                            : WindowText::tr("stopped safely"),
                {},
                {}};
    switch (plant.quality()) {
    case Plant::Good:
        return {Tone::Good, WindowText::tr("live"), {}, {}};
    case Plant::AtRest:
        return {Tone::Calm, WindowText::tr("at rest"), {}, {}};
    case Plant::Stale:
        return {Tone::Warning, WindowText::tr("values stale for %1").arg(ageText(plant.age())), {}, {}};
    case Plant::NoValue:
        break;
    }
    return {Tone::Calm, WindowText::tr("no values yet"), {}, {}};
}

}  // namespace

PlantSummary PlantSummary::of(const Plant &plant, const ViolationWatch &violations)
{
    if (plant.recording())
        return {Tone::Calm, WindowText::tr("recording"), plant.stateText(), {}};
    if (!plant.isConnected())
        return withoutConnection(plant);
    PlantSummary summary = conditionOf(plant);
    if (!plant.status().gone.isEmpty()) {
        summary.tone = summary.tone == Tone::Alarm ? Tone::Alarm : Tone::Warning;
        summary.condition
            = WindowText::tr("%1; %2 gone").arg(summary.condition, plant.status().gone.join(QStringLiteral(", ")));
    }
    summary.figures = figuresOf(plant, violations);
    if (violations.recent() > 0)
        summary.violations = violations.text();
    return summary;
}

QString StateStep::name(Step step)
{
    switch (step) {
    case Off:
        return WindowText::tr("Off");
    case Initialized:
        return WindowText::tr("Initialized");
    case RealTime:
        return WindowText::tr("Real time");
    case None:
        break;
    }
    return {};
}

StateStep StateStep::of(const Plant *plant, bool isInitialized)
{
    if (!plant || !plant->isConnected())
        return {};
    using State = messages::MasterState;
    const State state = plant->status().master.state;
    if (plant->status().isRunning() && plant->quality() == Plant::Stale)
        return {RealTime, Tone::Warning, WindowText::tr("No cycles")};
    switch (state) {
    case State::RealTime:
        return {RealTime, Tone::Good, {}};
    case State::WaitingForLateSlaves:
        return {RealTime, Tone::Warning, stateText(state)};
    case State::SafeStop:
        return {RealTime, Tone::Alarm, stateText(state)};
    case State::Fault:
        return {Off, Tone::Alarm, WindowText::tr("Fault")};
    case State::Initializing:
        return {Initialized, Tone::Calm, WindowText::tr("Initializing …")};
    case State::Ready:
        if (plant->status().master.armed)
            return {Initialized, Tone::Warning, WindowText::tr("Armed")};
        return {Initialized, Tone::Calm, WindowText::tr("Ready")};
    case State::Off:
    case State::Unknown:
        break;
    }
    if (isInitialized)
        return {Initialized, Tone::Calm, {}};
    return {Off, Tone::Calm, {}};
}

}  // namespace qplc
