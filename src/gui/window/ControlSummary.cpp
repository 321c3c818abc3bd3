// SPDX-License-Identifier: Apache-2.0
#include "ControlSummary.h"

#include "gui/WindowText.h"

#include <algorithm>

namespace qplc {

namespace {

ControlFact::Kind kindOf(const LeaseStatus &lease)
{
    if (lease.state == LeaseStatus::Lost)
        return ControlFact::Lost;
    return lease.isMine ? ControlFact::Mine : ControlFact::Others;
}

void addTo(QVector<ControlFact> *facts, const LeaseStatus &lease, const QString &reference)
{
    const ControlFact::Kind kind = kindOf(lease);
    const auto same = std::find_if(facts->begin(), facts->end(), [&](const ControlFact &fact) {
        return fact.kind == kind && (kind == ControlFact::Mine || fact.holder == lease.holder);
    });
    if (same != facts->end())
        same->references << reference;
    else
        facts->append({kind, lease.holder, {reference}});
}

QStringList signalsOf(const Plant &plant, ControlFact::Kind kind)
{
    QStringList names;
    for (const LeaseStatus &lease : plant.leases()) {
        if (kindOf(lease) == kind)
            names << lease.signal;
    }
    return names;
}

bool giveBack(const PlantList &plants, ControlFact::Kind kind)
{
    bool isAny = false;
    for (Plant *plant : plants.all()) {
        const QStringList names = signalsOf(*plant, kind);
        if (!names.isEmpty())
            plant->releaseLease(names);
        isAny = isAny || !names.isEmpty();
    }
    return isAny;
}

}  // namespace

QString ControlFact::headline() const
{
    switch (kind) {
    case Mine:
        return WindowText::tr("You control");
    case Lost:
        return WindowText::tr("Control is lost: neutral");
    case Others:
        break;
    }
    return WindowText::tr("%1 controls").arg(holder);
}

QString ControlFact::sentence() const
{
    const QString names = references.join(QStringLiteral(", "));
    return kind == Lost ? WindowText::tr("Control of %1 is lost: neutral").arg(names)
                        : QStringLiteral("%1 %2").arg(headline(), names);
}

QString ControlFact::remedy() const
{
    switch (kind) {
    case Mine:
        return WindowText::tr("Give back: the nodes write them again.");
    case Lost:
        return WindowText::tr("%1 is gone. Take control in a setter, or give back: the nodes write them again.")
            .arg(holder);
    case Others:
        break;
    }
    return WindowText::tr("A setter can take control from %1.").arg(holder);
}

QVector<ControlFact> ControlFact::of(const PlantList &plants)
{
    QVector<ControlFact> facts;
    for (const Plant *plant : plants.all()) {
        for (const LeaseStatus &lease : plant->leases()) {
            const bool isKnown = plant->table().contains(lease.signal);
            addTo(&facts, lease,
                  isKnown ? plants.reference(plant, plant->table().indexOf(lease.signal)).toString() : lease.signal);
        }
    }
    std::stable_sort(facts.begin(), facts.end(),
                     [](const ControlFact &a, const ControlFact &b) { return a.kind < b.kind; });
    return facts;
}

void giveBackControl(const PlantList &plants)
{
    if (!giveBack(plants, ControlFact::Mine))
        giveBack(plants, ControlFact::Lost);
}

}  // namespace qplc
