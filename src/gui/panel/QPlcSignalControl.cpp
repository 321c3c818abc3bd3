// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalControl.h"

#include "QPlcPanelContext.h"
#include "ValueStream.h"
#include "WindowContext.h"
#include "gui/LimitOf.h"
#include "gui/models/SiPrefix.h"

#include <QtCore/QPointer>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

using namespace qplc;

namespace {

/// The value that a signal, or an element, gets when it has no writer.
QPlcValue neutralValue(const PlantList::Signal &signal)
{
    const QPlcValue whole = signal.definition().safeValue();
    if (signal.element == SignalReference::Whole)
        return whole;
    return QPlcValue(whole.toReal(signal.element)).convertedTo(QPlcSignalType(signal.definition().type.scalar()));
}

/// The value of a whole signal with a number in the element that \a signal stands for.
/// \param others  value of the other elements
/// \return an invalid value if the number does not fit, or others are not known yet
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

double limited(const QPlcSignalDefinition &definition, double value)
{
    if (const std::optional<double> limit = limitOf(definition.maximum))
        value = std::min(value, *limit);
    if (const std::optional<double> limit = limitOf(definition.minimum))
        value = std::max(value, *limit);
    return value;
}

bool isNumber(const PlantList::Signal &signal)
{
    return signal && signal.definition().type.isNumeric();
}

bool isHeldByThisWindow(const PlantList::Signal &signal)
{
    if (!signal || !signal.plant->isConnected())
        return false;
    const std::optional<LeaseStatus> lease = signal.plant->lease(signal.definition().name);
    return lease && lease->isMine;
}

}  // namespace

struct QPlcSignalControl::Private : public QObject
{
    using Values = std::map<Plant *, ValueStream::Values>;

    Private(QPlcSignalControl *control, QPlcPanelContext *panel)
        : q(control)
        , context(panel)
    {
    }

    void renew()
    {
        setPin(context->pin());
        PlantList *list = context->window() ? context->window()->plants() : nullptr;
        if (list != plants)
            setPlants(list);
    }

    void setPlants(PlantList *list)
    {
        if (plants)
            plants->disconnect(this);
        plants = list;
        if (list) {
            list->forEach(this, &Private::listenTo);
            connect(list, &PlantList::signalsChanged, this, &Private::resolve);
            connect(list, &PlantList::aboutToSelect, this, [this] {
                if (pin.isEmpty() && hasPlainReference())
                    leave();
            });
        }
        resolve();
    }

    void setPin(const QString &plant)
    {
        if (plant == pin)
            return;
        if (hasPlainReference())
            leave();
        pin = plant;
        resolve();
    }

    void listenTo(Plant *plant)
    {
        for (const auto change : {&Plant::leasesChanged, &Plant::writersChanged, &Plant::stateChanged})
            connect(plant, change, this, &Private::judge, Qt::UniqueConnection);
        connect(plant, &Plant::commandFailed, this, [this, plant](int command, const QString &sentence) {
            if (commands.removeOne({plant, command}))
                Q_EMIT q->failed(sentence);
        });
        connect(plant, &Plant::commandDone, this, [this, plant](int command) { commands.removeOne({plant, command}); });
    }

    /// Whether the plant of a signal is the one of the pin or of the window.
    bool hasPlainReference() const
    {
        return std::any_of(references.begin(), references.end(),
                           [](const SignalReference &reference) { return reference.plant.isEmpty(); });
    }

    void resolve()
    {
        resolved.clear();
        for (const SignalReference &reference : qAsConst(references))
            resolved.append(plants ? plants->resolve(reference, pin) : PlantList::Signal());
        for (auto stream = streams.begin(); stream != streams.end();) {  // some of their plants may be gone
            const bool isUsed = std::any_of(resolved.begin(), resolved.end(), [&](const PlantList::Signal &signal) {
                return signal.plant == stream->first;
            });
            stream = isUsed ? std::next(stream) : streams.erase(stream);
        }
        assess();
        loseHold();
        Q_EMIT q->changed();
    }

    void judge()
    {
        if (!assess())
            return;
        loseHold();
        Q_EMIT q->changed();
    }

    /// \return whether state(), who(), text() or mayTake() are other ones
    bool assess()
    {
        const State stateBefore = state;
        const QStringList whoBefore = who;
        const QString plantTextBefore = plantText;
        state = resolved.isEmpty() ? Missing : Mine;
        who.clear();
        plantText.clear();
        for (const PlantList::Signal &signal : qAsConst(resolved)) {
            QStringList writers;
            const State each = stateOf(signal, &writers);
            if (each > state)
                who.clear();  // what they have is not what counts
            if (each >= state)
                who << writers;
            state = std::max(state, each);
            if (each == Offline)
                plantText = signal.plant->stateText();
        }
        who.removeAll(QString());
        who.removeDuplicates();
        const bool couldTakeBefore = couldTake;
        couldTake = q->mayTake();  // what a master knows is heard after its state
        return couldTake != couldTakeBefore || state != stateBefore || who != whoBefore || plantText != plantTextBefore;
    }

    State stateOf(const PlantList::Signal &signal, QStringList *writers) const
    {
        if (!signal)
            return Missing;
        if (!signal.plant->isConnected())
            return Offline;
        const QString writer = signal.plant->writer(signal.index);
        const std::optional<LeaseStatus> lease = signal.plant->lease(signal.definition().name);
        *writers << (lease ? lease->holder : writer);
        if (lease)
            return lease->state == LeaseStatus::Lost ? Lost : lease->isMine ? Mine : Other;
        if (writer.isEmpty())
            return Free;
        return writer == QLatin1String("Master") ? Unwritable : Written;
    }

    QString firstMissing() const
    {
        for (int i = 0; i < resolved.size(); ++i) {
            if (!resolved.at(i))
                return names.at(i);
        }
        return {};
    }

    QHash<Plant *, QStringList> namesByPlant() const
    {
        QHash<Plant *, QStringList> all;
        for (const PlantList::Signal &signal : resolved) {
            if (signal && !all.value(signal.plant).contains(signal.definition().name))
                all[signal.plant] << signal.definition().name;
        }
        return all;
    }

    PlantList::Signal find(const QString &reference) const { return resolved.value(names.indexOf(reference)); }
    /// \return false if the signal is not a number, or another element is not known yet
    bool add(const QString &reference, double number, Values *values) const
    {
        const PlantList::Signal signal = find(reference);
        if (!isNumber(signal))
            return false;
        const QPlcSignalDefinition &definition = signal.definition();
        ValueStream::Values &ofPlant = (*values)[signal.plant];
        const QPlcValue others = ofPlant.value(definition.name, signal.plant->value(signal.index));
        const QPlcValue whole = wholeValue(signal, limited(definition, number), others);
        if (whole.isValid())
            ofPlant.insert(definition.name, whole);
        return whole.isValid();
    }

    ValueStream &streamTo(Plant *plant)
    {
        std::unique_ptr<ValueStream> &stream = streams[plant];
        if (!stream) {
            stream = std::make_unique<ValueStream>();
            stream->setPlant(plant);
            connect(stream.get(), &ValueStream::failed, q, &QPlcSignalControl::failed);
        }
        return *stream;
    }

    /// Behind what is in progress, without leaving out anything.
    void sendNow(const Values &values)
    {
        for (const auto &[plant, ofPlant] : values) {
            streamTo(plant).flush();
            follow(plant, plant->setValues(ofPlant));
        }
    }

    void follow(Plant *plant, int command) { commands.append({plant, command}); }
    void endHold()
    {
        const QStringList all = std::exchange(held, {});
        const QStringList leases = std::exchange(leased, {});
        Values values;
        for (const QString &reference : all)
            add(reference, q->neutral(reference), &values);
        if (q->mayWrite())
            sendNow(values);
        for (const QString &reference : leases) {
            if (const PlantList::Signal signal = find(reference))
                signal.plant->releaseLease({signal.definition().name});
        }
    }

    /// What is held must not go on for another person.
    void loseHold()
    {
        if (held.isEmpty() || q->mayWrite())
            return;
        held.clear();
        leased.clear();
        for (const auto &stream : streams)
            stream.second->clear();
        Q_EMIT q->holdLost();
    }

    /// What was set in a plant reaches that plant, and does not go on in another one.
    void finish()
    {
        endHold();
        for (const auto &stream : streams)
            stream.second->flush();
        streams.clear();
    }

    void leave()
    {
        const bool wasHolding = q->isHolding();
        finish();
        if (wasHolding)
            Q_EMIT q->holdLost();
        Q_EMIT q->leaving();
    }

    void end()
    {
        if (!plants)
            return;
        finish();
        if (state == Mine && !keepsControl)
            q->giveBack();
    }

    QPlcSignalControl *q;
    QPlcPanelContext *context;
    QPointer<PlantList> plants;
    QString pin;
    QStringList names;
    QVector<SignalReference> references;
    QVector<PlantList::Signal> resolved;  // what the references mean now, in their order; false: missing
    State state = Missing;
    Beginning beginning = Present;
    bool keepsControl = false;
    QStringList who;
    QString plantText;  // of one that is not connected
    bool couldTake = false;
    QVector<QPair<Plant *, int>> commands;  // whose outcome is told
    std::map<Plant *, std::unique_ptr<ValueStream>> streams;
    QStringList held;    // references of hold()
    QStringList leased;  // those of them that are leased only as long as they are held
};

// ---- who has control ----

QPlcSignalControl::QPlcSignalControl(QPlcPanelContext *context, QObject *parent)
    : QObject(parent)
    , d(std::make_unique<Private>(this, context))
{
    connect(context, &QPlcPanelContext::signalsChanged, d.get(), &Private::renew);
    d->renew();
}

QPlcSignalControl::~QPlcSignalControl()
{
    blockSignals(true);  // nobody may look at it any more
    d->end();
}

void QPlcSignalControl::setSignals(const QStringList &references)
{
    if (references == d->names)
        return;
    d->end();
    d->names = references;
    d->references.clear();
    for (const QString &text : references)
        d->references.append(SignalReference::fromString(text));
    d->resolve();
}

QStringList QPlcSignalControl::signalNames() const
{
    return d->names;
}

void QPlcSignalControl::setKeepsControl(bool keepsControl)
{
    d->keepsControl = keepsControl;
}

void QPlcSignalControl::setBeginning(Beginning beginning)
{
    d->beginning = beginning;
}

QPlcSignalControl::State QPlcSignalControl::state() const
{
    return d->state;
}

bool QPlcSignalControl::mayWrite() const
{
    return d->state == Mine || d->state == Free;
}

bool QPlcSignalControl::mayTake() const
{
    const bool isWanted = d->state == Free || d->state == Written || d->state == Lost || d->state == Other;
    return isWanted && std::all_of(d->resolved.begin(), d->resolved.end(), [](const PlantList::Signal &signal) {
               return signal && signal.plant->hasLeases();  // a plant may just have gone
           });
}

bool QPlcSignalControl::mayGiveBack() const
{
    return d->state == Mine || d->state == Lost;
}

QString QPlcSignalControl::who() const
{
    return d->who.join(QStringLiteral(", "));
}

QString QPlcSignalControl::text() const
{
    switch (d->state) {
    case Mine:
        return tr("You have control");
    case Free:
        return d->resolved.constFirst().plant->feed() ? tr("The program says whether this is taken")
                                                      : tr("No node writes this");
    case Written:
        return mayTake() ? tr("%1 writes this").arg(who())
                         : tr("%1 writes this, and this master does not support leases: update it").arg(who());
    case Lost:
        return tr("%1 was lost: neutral until a person takes control or gives it back").arg(who());
    case Other:
        return tr("Held by %1").arg(who());
    case Unwritable:
        return tr("Measured by the master: it cannot be set");
    case Offline:
        return d->plantText;
    case Missing:
        break;
    }
    return d->names.isEmpty() ? tr("No signal yet: drop one here, or choose it in the settings")
                              : tr("There is no signal '%1' at the moment").arg(d->firstMissing());
}

QString QPlcSignalControl::plantNames() const
{
    QStringList all;
    for (const PlantList::Signal &signal : qAsConst(d->resolved)) {
        if (signal && !all.contains(signal.plant->name()))
            all << signal.plant->name();
    }
    return d->plants && d->plants->size() > 1 ? all.join(QStringLiteral(", ")) : QString();
}

double QPlcSignalControl::neutral(const QString &reference) const
{
    const PlantList::Signal signal = d->find(reference);
    return isNumber(signal) ? neutralValue(signal).toReal() : std::numeric_limits<double>::quiet_NaN();
}

QString QPlcSignalControl::neutralText() const
{
    QStringList texts;
    bool isAllZero = true;
    for (const PlantList::Signal &signal : qAsConst(d->resolved)) {
        if (!signal)
            continue;
        isAllZero = isAllZero && neutralValue(signal).toReal() == 0.0;
        const QPlcSignalDefinition &definition = signal.definition();
        const QString unit = SiPrefix::unitText(definition.unit);
        texts << QStringLiteral("%1 %2 %3").arg(definition.name, neutralValue(signal).toString(), unit).trimmed();
    }
    return isAllZero && texts.size() > 1 ? tr("all 0") : texts.join(QStringLiteral(", "));
}

void QPlcSignalControl::take(TakeOver takeOver)
{
    if (!mayTake() || (d->state == Other && takeOver == OnlyFree))
        return;
    const QHash<Plant *, QStringList> names = d->namesByPlant();
    for (auto of = names.begin(); of != names.end(); ++of) {
        // A signal without a value keeps the one that its writer gave it last.
        QHash<QString, QPlcValue> values;
        const QStringList set = d->beginning == Neutral ? of.value() : QStringList();
        for (const QString &name : set)
            values.insert(name, of.key()->table().at(of.key()->table().indexOf(name)).safeValue());
        const auto from = takeOver == AlsoFromOthers ? Plant::AlsoFromOthers : Plant::OnlyFree;
        d->follow(of.key(), of.key()->takeLease(of.value(), values, from));
    }
}

void QPlcSignalControl::giveBack()
{
    if (!mayGiveBack())
        return;
    d->finish();
    const QHash<Plant *, QStringList> names = d->namesByPlant();
    for (auto of = names.begin(); of != names.end(); ++of)
        d->follow(of.key(), of.key()->releaseLease(of.value()));
}

// ---- values ----

bool QPlcSignalControl::set(const QString &reference, double value)
{
    return set({{reference, value}});
}

bool QPlcSignalControl::set(const QHash<QString, double> &values)
{
    Private::Values whole;
    for (auto value = values.begin(); value != values.end(); ++value) {
        if (!mayWrite() || !d->add(value.key(), value.value(), &whole))
            return false;
    }
    for (const auto &[plant, ofPlant] : whole)
        d->streamTo(plant).send(ofPlant);
    return true;
}

bool QPlcSignalControl::send(const QString &reference, const QPlcValue &value)
{
    const PlantList::Signal signal = d->find(reference);
    if (!signal || !mayWrite() || !value.isValid())
        return false;
    Private::Values values;
    if (isNumber(signal) && value.type().isNumeric() && !value.type().isArray()) {
        if (!d->add(reference, value.toReal(), &values))
            return false;
    } else {
        const QPlcValue whole = value.convertedTo(signal.definition().type);
        if (!whole.isValid() || signal.element != SignalReference::Whole)
            return false;
        values[signal.plant].insert(signal.definition().name, whole);
    }
    d->sendNow(values);
    return true;
}

void QPlcSignalControl::setNeutral()
{
    Private::Values values;
    for (int i = 0; i < d->resolved.size(); ++i) {
        if (isHeldByThisWindow(d->resolved.at(i)))
            d->add(d->names.at(i), neutral(d->names.at(i)), &values);
    }
    d->sendNow(values);
}

// ---- values for a while ----

bool QPlcSignalControl::hold(const QString &reference, double value)
{
    const PlantList::Signal signal = d->find(reference);
    Private::Values values;
    if (!mayWrite() || !d->add(reference, value, &values))
        return false;
    const bool isLeased = !d->leased.contains(reference) && state() == Free && signal.plant->hasLeases();
    d->held.removeOne(reference);
    d->held << reference;
    if (!isLeased)
        return set(reference, value);
    d->leased << reference;
    d->follow(signal.plant, signal.plant->takeLease({signal.definition().name}, values[signal.plant]));
    return true;
}

bool QPlcSignalControl::isHolding() const
{
    return !d->held.isEmpty();
}

void QPlcSignalControl::endHold()
{
    d->endHold();
}
