// SPDX-License-Identifier: Apache-2.0
#include "QPlcPast.h"

#include "CurveSources.h"
#include "DerivedSignal.h"
#include "PastRows.h"

#include <QtCore/QPointer>

#include <algorithm>
#include <limits>

using namespace qplc;

struct QPlcPast::Private
{
    std::shared_ptr<const SignalStore> store;
    int channel;
    std::shared_ptr<const SignalStore> ofPlant;  // another one than that of a formula
    QPointer<Plant> plant;
};

PastRows PastRows::of(const QPlcPast &past)
{
    return past ? PastRows{past.d->store.get(), past.d->channel} : PastRows();
}

QPlcPast PastRows::past(std::shared_ptr<const SignalStore> store, int channel)
{
    QPlcPast past;
    past.d = std::make_shared<const QPlcPast::Private>(QPlcPast::Private{store, channel, store, nullptr});
    return past;
}

QPlcPast PastRows::past(const CurveSource &source)
{
    QPlcPast past;
    past.expression = source.title;
    past.problem = source.error;
    if (!source)
        return past;
    past.plant = source.plant->name();
    past.unit = source.unit;
    past.minimum = source.minimum;
    past.maximum = source.maximum;
    past.names = source.names;
    past.isStepped = source.isStepped;
    const std::shared_ptr<const SignalStore> ofPlant = source.plant->sharedStore();
    const auto store
        = source.derived ? std::shared_ptr<const SignalStore>(source.derived, &source.derived->store()) : ofPlant;
    past.d = std::make_shared<const QPlcPast::Private>(QPlcPast::Private{store, source.channel, ofPlant, source.plant});
    return past;
}

QPlcPast::Range QPlcPast::Range::empty()
{
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none};
}

QPlcPast::Range QPlcPast::Range::united(const Range &other) const
{
    return isEmpty()      ? other
        : other.isEmpty() ? *this
                          : Range{std::min(minimum, other.minimum), std::max(maximum, other.maximum)};
}

QPlcPast::QPlcPast() = default;
QPlcPast::~QPlcPast() = default;
QPlcPast::QPlcPast(const QPlcPast &other) = default;
QPlcPast &QPlcPast::operator=(const QPlcPast &other) = default;

QString QPlcPast::textOf(const QString &expression)
{
    return CurveSource::textOf(expression);
}

bool QPlcPast::isCurrent() const
{
    return d->plant && d->plant->quality() != Plant::Stale;
}

double QPlcPast::age() const
{
    return d->plant ? d->plant->age() : -1.0;
}

QPlcPast::Time QPlcPast::newestTime() const
{
    return d->ofPlant->newestTime();
}

bool QPlcPast::sharesRows(const QPlcPast &other) const
{
    return d->store == other.d->store;
}

bool QPlcPast::isOverview() const
{
    return d->ofPlant->isOverview();
}

QPlcPast::Row QPlcPast::firstRow() const
{
    return d->store->firstRow();
}

QPlcPast::Row QPlcPast::endRow() const
{
    return d->store->endRow();
}

QPlcPast::Row QPlcPast::rowAt(Time time) const
{
    return d->store->rowAt(time);
}

std::optional<QPlcPast::Row> QPlcPast::rowHoldingAt(Time time) const
{
    const std::optional<SignalStore::Row> row = d->store->rowHoldingAt(time);
    return row ? std::optional<Row>(*row) : std::nullopt;
}

QPlcPast::Time QPlcPast::time(Row row) const
{
    return d->store->time(row);
}

double QPlcPast::value(Row row) const
{
    return double(d->store->value(d->channel, row));
}

bool QPlcPast::beginsAnew(Row row) const
{
    return d->store->beginsAnew(row);
}

QPlcQuality::Kind QPlcPast::quality(Row begin, Row end) const
{
    return QPlcQuality::Kind(d->store->greatestMark(d->channel, begin, end));
}

QPlcPast::Range QPlcPast::range(Row begin, Row end) const
{
    const SignalStore::Range range = d->store->range(d->channel, begin, end);
    return {double(range.minimum), double(range.maximum)};
}
