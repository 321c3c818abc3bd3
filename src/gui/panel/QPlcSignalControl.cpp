// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalControl.h"

#include "QPlcPanelContext.h"
#include "SignalControl.h"
#include "ValueStream.h"
#include "gui/plant/LimitOf.h"

#include <algorithm>
#include <limits>
#include <map>

using namespace qplc;

static_assert(int(QPlcSignalControl::Mine) == int(SignalControl::Mine)
              && int(QPlcSignalControl::Missing) == int(SignalControl::Missing));

struct QPlcSignalControl::Private
{
    ValueStream &streamTo(QPlcSignalControl *q, Plant *plant)
    {
        std::unique_ptr<ValueStream> &stream = streams[plant];
        if (!stream) {
            stream = std::make_unique<ValueStream>();
            stream->setPlant(plant);
            connect(stream.get(), &ValueStream::failed, q, &QPlcSignalControl::failed);
        }
        return *stream;
    }

    /// What was set in one plant reaches that one, and does not go on in another one.
    void leave()
    {
        for (const auto &entry : streams)
            entry.second->flush();
        streams.clear();
    }

    PlantList::Signal find(const QString &reference) const
    {
        return control.resolved().value(names.indexOf(reference));
    }

    QStringList names;
    SignalControl control;
    std::map<Plant *, std::unique_ptr<ValueStream>> streams;
};

QPlcSignalControl::QPlcSignalControl(QPlcPanelContext *context, QObject *parent)
    : QObject(parent)
    , d(std::make_unique<Private>())
{
    connect(&d->control, &SignalControl::leaving, this, [this] {
        d->leave();
        Q_EMIT leaving();
    });
    connect(&d->control, &SignalControl::signalsChanged, this, [this] {
        d->streams.clear();
        Q_EMIT changed();
    });
    connect(&d->control, &SignalControl::changed, this, &QPlcSignalControl::changed);
    connect(&d->control, &SignalControl::failed, this, &QPlcSignalControl::failed);
    d->control.setContext(context);
}

QPlcSignalControl::~QPlcSignalControl()
{
    d->control.disconnect(this);
    if (!d->control.hasPlants())
        return;
    d->leave();
    if (state() == Mine)
        d->control.giveBack();
}

void QPlcSignalControl::setSignals(const QStringList &references)
{
    if (references == d->names)
        return;
    d->leave();
    if (state() == Mine)
        d->control.giveBack();
    d->names = references;
    QVector<SignalReference> all;
    for (const QString &text : references)
        all.append(SignalReference::fromString(text));
    d->control.setSignals(all);
}

QStringList QPlcSignalControl::signalNames() const
{
    return d->names;
}

QPlcSignalControl::State QPlcSignalControl::state() const
{
    return State(d->control.state());
}

bool QPlcSignalControl::mayWrite() const
{
    return d->control.mayWrite();
}

bool QPlcSignalControl::mayTake() const
{
    return d->control.mayTake();
}

bool QPlcSignalControl::mayGiveBack() const
{
    return d->control.mayGiveBack();
}

QString QPlcSignalControl::who() const
{
    return d->control.who();
}

QString QPlcSignalControl::text() const
{
    return d->control.text();
}

double QPlcSignalControl::neutral(const QString &reference) const
{
    const PlantList::Signal signal = d->find(reference);
    const bool isNumber = signal && signal.definition().type.isNumeric();
    return isNumber ? neutralValue(signal).toReal() : std::numeric_limits<double>::quiet_NaN();
}

void QPlcSignalControl::take(TakeOver takeOver)
{
    d->control.take(takeOver == AlsoFromOthers ? Plant::AlsoFromOthers : Plant::OnlyFree);
}

void QPlcSignalControl::giveBack()
{
    d->leave();
    d->control.giveBack();
}

bool QPlcSignalControl::set(const QString &reference, double value)
{
    const PlantList::Signal signal = d->find(reference);
    if (!signal || !mayWrite() || !signal.definition().type.isNumeric())
        return false;
    const QPlcSignalDefinition &definition = signal.definition();
    if (const std::optional<double> limit = limitOf(definition.maximum))
        value = std::min(value, *limit);
    if (const std::optional<double> limit = limitOf(definition.minimum))
        value = std::max(value, *limit);
    const QPlcValue whole = wholeValue(signal, value);
    if (!whole.isValid())
        return false;
    d->streamTo(this, signal.plant).send({{definition.name, whole}});
    return true;
}
