// SPDX-License-Identifier: Apache-2.0
#include "SignalControl.h"

#include "QPlcPanelContext.h"
#include "WindowContext.h"
#include "gui/models/SiPrefix.h"

#include <algorithm>
#include <cmath>

namespace qplc {

QPlcValue neutralValue(const PlantList::Signal &signal)
{
    const QPlcValue whole = signal.definition().safeValue();
    if (signal.element == SignalReference::Whole)
        return whole;
    return QPlcValue(whole.toReal(signal.element)).convertedTo(QPlcSignalType(signal.definition().type.scalar()));
}

QPlcValue wholeValue(const PlantList::Signal &signal, double number)
{
    return wholeValue(signal, number, signal.plant->value(signal.index));
}

QPlcValue wholeValue(const PlantList::Signal &signal, double number, const QPlcValue &others)
{
    const QPlcSignalType type = signal.definition().type;
    const double rounded = type.isReal() ? number : std::round(number);
    const QPlcValue element = QPlcValue(rounded).convertedTo(QPlcSignalType(type.scalar()));
    if (signal.element == SignalReference::Whole || !element.isValid())
        return element.convertedTo(type);
    if (!others.isValid())
        return {};
    QByteArray bytes = others.toBytes();
    bytes.replace(signal.element * type.elementSize(), type.elementSize(), element.toBytes());
    return QPlcValue::fromBytes(type, bytes);
}

void SignalControl::setContext(QPlcPanelContext *context)
{
    const auto renew = [this, context] {
        setPin(context->pin());
        PlantList *plants = context->window() ? context->window()->plants() : nullptr;
        if (plants != m_plants)
            setPlants(plants);
    };
    connect(context, &QPlcPanelContext::signalsChanged, this, renew);
    renew();
}

void SignalControl::setPlants(PlantList *plants)
{
    if (m_plants)
        m_plants->disconnect(this);
    m_plants = plants;
    if (plants) {
        plants->forEach(this, &SignalControl::listenTo);
        connect(plants, &PlantList::signalsChanged, this, &SignalControl::resolve);
        connect(plants, &PlantList::aboutToSelect, this, [this] {
            if (m_pin.isEmpty() && hasPlainReference())
                Q_EMIT leaving();
        });
    }
    resolve();
}

/// Whether the plant of a signal is the one of the pin or of the window.
bool SignalControl::hasPlainReference() const
{
    return std::any_of(m_references.begin(), m_references.end(),
                       [](const SignalReference &reference) { return reference.plant.isEmpty(); });
}

void SignalControl::setPin(const QString &plant)
{
    if (plant == m_pin)
        return;
    if (hasPlainReference())
        Q_EMIT leaving();
    m_pin = plant;
    resolve();
}

QString SignalControl::plantNames() const
{
    QStringList names;
    for (const PlantList::Signal &signal : m_resolved) {
        if (signal && !names.contains(signal.plant->name()))
            names << signal.plant->name();
    }
    return m_plants && m_plants->size() > 1 ? names.join(QStringLiteral(", ")) : QString();
}

void SignalControl::listenTo(Plant *plant)
{
    for (const auto change : {&Plant::leasesChanged, &Plant::writersChanged, &Plant::stateChanged})
        connect(plant, change, this, &SignalControl::judge, Qt::UniqueConnection);
    connect(plant, &Plant::updated, this, &SignalControl::updated, Qt::UniqueConnection);
    connect(plant, &Plant::commandFailed, this, [this, plant](int command, const QString &sentence) {
        if (m_commands.removeOne({plant, command}))
            Q_EMIT failed(sentence);
    });
    connect(plant, &Plant::commandDone, this, [this, plant](int command) { m_commands.removeOne({plant, command}); });
}

void SignalControl::setSignals(const QVector<SignalReference> &references)
{
    m_references = references;
    resolve();
}

void SignalControl::resolve()
{
    m_resolved.clear();
    for (const SignalReference &reference : qAsConst(m_references))
        m_resolved.append(m_plants ? m_plants->resolve(reference, m_pin) : PlantList::Signal());
    const bool isOther = assess();  // who hears of other signals sees what is true of them
    Q_EMIT signalsChanged();
    if (isOther)
        Q_EMIT changed();
}

SignalControl::State SignalControl::stateOf(const PlantList::Signal &signal, QStringList *who) const
{
    if (!signal)
        return Missing;
    if (!signal.plant->isConnected())
        return Offline;
    const QString writer = signal.plant->writer(signal.index);
    const std::optional<LeaseStatus> lease = signal.plant->lease(signal.definition().name);
    *who << (lease ? lease->holder : writer);
    if (lease)
        return lease->state == LeaseStatus::Lost ? Lost : lease->isMine ? Mine : Other;
    if (writer.isEmpty())
        return Free;
    return writer == QLatin1String("Master") ? Unwritable : Written;
}

void SignalControl::judge()
{
    if (assess())
        Q_EMIT changed();
}

/// \return whether state(), who(), text() or mayTake() are other ones
bool SignalControl::assess()
{
    const State stateBefore = m_state;
    const QStringList whoBefore = m_who;
    const QString plantTextBefore = m_plantText;
    m_state = m_resolved.isEmpty() ? Missing : Mine;
    m_who.clear();
    m_plantText.clear();
    for (const PlantList::Signal &signal : qAsConst(m_resolved)) {
        QStringList who;
        const State state = stateOf(signal, &who);
        if (state > m_state)
            m_who.clear();  // what they have is not what counts
        if (state >= m_state)
            m_who << who;
        m_state = std::max(m_state, state);
        if (state == Offline)
            m_plantText = signal.plant->stateText();
    }
    m_who.removeAll(QString());
    m_who.removeDuplicates();
    const bool couldTake = m_couldTake;
    m_couldTake = mayTake();  // what a master knows is heard after its state
    return m_couldTake != couldTake || m_state != stateBefore || m_who != whoBefore || m_plantText != plantTextBefore;
}

bool SignalControl::mayTake() const
{
    const bool isWanted = m_state == Free || m_state == Written || m_state == Lost || m_state == Other;
    return isWanted && std::all_of(m_resolved.begin(), m_resolved.end(), [](const PlantList::Signal &signal) {
               return signal && signal.plant->hasLeases();  // a plant may just have gone
           });
}

QString SignalControl::firstMissing() const
{
    for (int i = 0; i < m_resolved.size(); ++i) {
        if (!m_resolved.at(i))
            return m_references.at(i).toString();
    }
    return {};
}

QString SignalControl::text() const
{
    switch (m_state) {
    case Mine:
        return tr("You have control");
    case Free:
        return m_resolved.constFirst().plant->feed() ? tr("The program says whether this is taken")
                                                     : tr("Nobody writes this");
    case Written:
        return mayTake() ? tr("%1 writes this").arg(who())
                         : tr("%1 writes this, and this master knows no leases: update it").arg(who());
    case Lost:
        return tr("%1 was lost: neutral until somebody takes control or gives it back").arg(who());
    case Other:
        return tr("Held by %1").arg(who());
    case Unwritable:
        return tr("Measured by the master: it cannot be set");
    case Offline:
        return m_plantText;
    case Missing:
        break;
    }
    return m_references.isEmpty() ? tr("No signal yet: drop one here, or choose it in the settings")
                                  : tr("There is no signal '%1' now").arg(firstMissing());
}

QHash<Plant *, QStringList> SignalControl::namesByPlant() const
{
    QHash<Plant *, QStringList> names;
    for (const PlantList::Signal &signal : m_resolved) {
        if (signal && !names.value(signal.plant).contains(signal.definition().name))
            names[signal.plant] << signal.definition().name;
    }
    return names;
}

void SignalControl::take(Plant::TakeOver takeOver)
{
    if (!mayTake() || (m_state == Other && takeOver == Plant::OnlyFree))
        return;
    const QHash<Plant *, QStringList> names = namesByPlant();
    for (auto of = names.begin(); of != names.end(); ++of) {
        // A signal without a value keeps the one that its writer gave it last.
        QHash<QString, QPlcValue> values;
        const QStringList set = m_beginning == Neutral ? of.value() : QStringList();
        for (const QString &name : set)
            values.insert(name, of.key()->table().at(of.key()->table().indexOf(name)).safeValue());
        m_commands.append({of.key(), of.key()->takeLease(of.value(), values, takeOver)});
    }
}

QString SignalControl::neutralText() const
{
    QStringList texts;
    bool isAllZero = true;
    for (const PlantList::Signal &signal : m_resolved) {
        if (!signal)
            continue;
        isAllZero = isAllZero && neutralValue(signal).toReal() == 0.0;
        const QPlcSignalDefinition &definition = signal.definition();
        const QString unit = SiPrefix::unitText(definition.unit);
        texts << QStringLiteral("%1 %2 %3").arg(definition.name, neutralValue(signal).toString(), unit).trimmed();
    }
    return isAllZero && texts.size() > 1 ? tr("all 0") : texts.join(QStringLiteral(", "));
}

void SignalControl::giveBack()
{
    if (!mayGiveBack())
        return;
    const QHash<Plant *, QStringList> names = namesByPlant();
    for (auto of = names.begin(); of != names.end(); ++of)
        m_commands.append({of.key(), of.key()->releaseLease(of.value())});
}

}  // namespace qplc
