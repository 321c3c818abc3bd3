// SPDX-License-Identifier: Apache-2.0
#include "QPlcPanelContext.h"

#include "DrawNow.h"
#include "FigureFont.h"
#include "QPlcTimeAxis.h"
#include "QPlcWidget.h"
#include "SignalEdit.h"
#include "WindowContext.h"
#include "formulas/Formula.h"
#include "gui/models/NodeTableModel.h"
#include "gui/models/SiPrefix.h"
#include "gui/models/SignalTreeModel.h"
#include "gui/models/ValueFormat.h"
#include "gui/plant/PastValue.h"
#include "gui/plot/DerivedSignal.h"
#include "gui/plot/PastRows.h"
#include "signals/MessageText.h"

#include <QtCore/QDateTime>
#include <QtCore/QEvent>
#include <QtCore/QPointer>
#include <QtCore/QTimer>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace qplc;

namespace {

using Row = SignalStore::Row;

/// Rows of a step: a power of two, so that steps stay where they are while time goes on.
Row rowsOfStep(Row rows, int most)
{
    Row step = 1;
    while (rows > Row(most) && rows / step + 2 > Row(most))
        step *= 2;
    return step;
}

/// \return whether there is a number in the rows
bool readStep(const SignalStore &store, int channel, Row begin, Row end, QPlcPanelContext::Sample *sample)
{
    while (begin < end && std::isnan(store.value(channel, begin)))
        ++begin;
    if (begin == end)
        return false;
    const SignalStore::Range range = store.range(channel, begin, end);
    sample->time = store.time(begin);
    sample->value = double(store.value(channel, begin));
    sample->minimum = double(range.minimum);
    sample->maximum = double(range.maximum);
    sample->quality = QPlcQuality::Kind(store.greatestMark(channel, begin, end));
    return true;
}

QPlcQuality qualityOf(QPlcQuality::Kind kind)
{
    return kind == QPlcQuality::Held ? QPlcQuality::held(1) : QPlcQuality(kind);
}

/// Where no cycles come, a formula is calculated of the newest values that the signals have; one
/// with a past keeps the result of the last cycle.
QPlcValue newestValue(const CurveSource &formula)
{
    const qplc::Plant &plant = *formula.plant;
    const bool hasPast = formula.derived && formula.derived->hasPast();
    if (formula.derived && !hasPast && plant.quality() != qplc::Plant::Good)
        return plant.values().hasValues() ? QPlcValue(formula.derived->resultOf(plant.values().newestChannels()))
                                          : QPlcValue();
    const SignalStore &rows = *formula.store;
    const SignalStore *cycles = plant.store();
    // While the past is being calculated, its last row is not the newest one.
    const bool isNow = cycles && !rows.isEmpty() && !cycles->isEmpty()
        && rows.time(rows.endRow() - 1) == cycles->time(cycles->endRow() - 1);
    return isNow ? QPlcValue(double(rows.value(formula.channel, rows.endRow() - 1))) : QPlcValue();
}

QString timeText(const QPlcValue &value, QPlcPanelContext::Time time)
{
    const QString clock = QDateTime::fromMSecsSinceEpoch(time / 1'000'000).toString(QStringLiteral("HH:mm:ss.zzz"));
    return value.isValid() ? QPlcPanelContext::tr("at %1").arg(clock)
                           : QPlcPanelContext::tr("no value at %1").arg(clock);
}

/// Why a value of now is not what its writer says now; empty: it is.
QString doubtText(QPlcQuality quality)
{
    switch (quality.kind()) {
    case QPlcQuality::Held:
        return QPlcPanelContext::tr("held %1 cycles").arg(quality.heldCycles());
    case QPlcQuality::Safe:
        return QPlcPanelContext::tr("safe value");
    case QPlcQuality::Invalid:
        return QPlcPanelContext::tr("not written yet");
    case QPlcQuality::Good:
        break;
    }
    return {};
}

/// A held value was valid before it was held; -1: it has never been, or is unusable.
double ageOf(const qplc::Plant &plant, QPlcQuality quality)
{
    const double age = plant.age();
    if (plant.quality() != qplc::Plant::Good)
        return age;
    return age < 0.0 || !quality.isUsable() ? -1.0
                                            : age + quality.heldCycles() * double(plant.values().period()) * 1e-9;
}

QString noteOf(const qplc::Plant &plant, QPlcQuality quality, bool isOfLastCycle)
{
    switch (plant.quality()) {
    case qplc::Plant::NoValue:
        return QPlcPanelContext::tr("no value yet");
    case qplc::Plant::Stale:
        return QPlcPanelContext::tr("stale, %1").arg(qplc::ageText(plant.age()));
    case qplc::Plant::AtRest:
        return isOfLastCycle ? QPlcPanelContext::tr("at rest, last cycle") : QPlcPanelContext::tr("at rest");
    case qplc::Plant::Good:
        break;
    }
    return doubtText(quality);
}

QVector<QPlcPanelContext::Duration> durationsOf(const messages::Statistics &statistics)
{
    QVector<QPlcPanelContext::Duration> all;
    const auto append
        = [&](const QString &owner, const char *name, const std::optional<QPlcDurationStatistics> &duration) {
              if (duration)
                  all.append({printable(owner), QString::fromLatin1(name), *duration});
          };
    append(messages::masterName, "lateness", statistics.master.lateness);
    append(messages::masterName, "execution", statistics.master.execution);
    append(messages::masterName, "roundTrip", statistics.master.roundTrip);
    for (const messages::NodeMeasures &node : statistics.nodes) {
        append(node.name, "execution", node.execution);
        append(node.name, "roundTrip", node.roundTrip);
    }
    return all;
}

}  // namespace

static_assert(int(QPlcPanelContext::ReferenceRole) == int(SignalTreeModel::ReferenceRole)
              && int(QPlcPanelContext::SortRole) == int(NodeTableModel::SortRole)
              && int(QPlcPanelContext::HealthRole) == int(NodeTableModel::HealthRole)
              && int(QPlcPanelContext::EventTimeRole) == int(EventLogModel::TimeRole)
              && int(QPlcPanelContext::NoteRole) == int(EventLogModel::NoteRole));

struct QPlcPanelContext::Private : public QObject
{
    Private(QPlcPanelContext *context, QPlcWidget *widget)
        : q(context)
        , panel(widget)
    {
        constexpr int frameTime = 33;  // [ms]
        frame.setSingleShot(true);
        frame.setInterval(frameTime);
        connect(&frame, &QTimer::timeout, this, &Private::tell);
        timeTurn.setSingleShot(true);
        timeTurn.setInterval(0);
        connect(&timeTurn, &QTimer::timeout, this, &Private::touch);
        panel->installEventFilter(this);
    }

    bool eventFilter(QObject *watched, QEvent *event) override
    {
        if (watched == panel && (event->type() == QEvent::Show || event->type() == DrawNow::Kind)) {
            isDue = isDue || timeTurn.isActive();
            timeTurn.stop();
            tell();
        }
        return QObject::eventFilter(watched, event);
    }

    void touch()
    {
        isDue = true;
        if (!frame.isActive())
            tell();
    }

    void tell()
    {
        if (!isDue || !panel->isVisible())
            return;
        isDue = false;
        frame.start();
        Q_EMIT q->changed();
    }

    void forget()
    {
        formulas.clear();
        Q_EMIT q->signalsChanged();
        touch();
    }

    void followTime(const QPlcTimeAxis *time)
    {
        for (const auto changed :
             {&QPlcTimeAxis::viewChanged, &QPlcTimeAxis::cursorsChanged, &QPlcTimeAxis::pointerChanged,
              &QPlcTimeAxis::playheadChanged, &QPlcTimeAxis::displayTimeChanged})
            connect(time, changed, this, [this] {
                Q_EMIT q->timeChanged();
                timeTurn.start();
            });
    }

    void follow(qplc::Plant *plant)
    {
        connect(plant, &qplc::Plant::stateChanged, this, [this, plant] {
            Q_EMIT q->plantStateChanged(plant->name());
            touch();
        });
    }

    QString pin() const { return panel->pinnedPlant(); }
    qplc::Plant *plant(const QString &name) const
    {
        SignalReference reference;
        reference.plant = name;
        return window ? window->plants()->plantOf(reference, pin()) : nullptr;
    }
    /// A formula is calculated as long as somebody has it.
    CurveSource source(const QString &expression)
    {
        if (!Formula::isFormula(expression))
            return window->curveSources()->find(expression, pin());
        if (!formulas.contains(expression))
            formulas.insert(expression, window->curveSources()->find(expression, pin()));
        return formulas.value(expression);
    }
    Signal formula(const QString &expression, std::optional<Time> time);
    Signal signal(const QString &expression, std::optional<Time> time);

    QPlcPanelContext *q;
    QPlcWidget *panel;
    QPointer<WindowContext> window;
    QPlcTimeAxis ownTime;  // outside of a window
    QHash<QString, CurveSource> formulas;
    QTimer frame;     // runs while the panel was told so recently that it has to wait
    QTimer timeTurn;  // the time that is shown changes in several steps: panels draw the last of them
    bool isDue = false;
};

QPlcPanelContext::Signal QPlcPanelContext::Private::formula(const QString &expression, std::optional<Time> time)
{
    Signal signal;
    const CurveSource found = source(expression);
    signal.problem = found.error;
    if (!found)
        return signal;
    signal.plant = found.plant->name();
    signal.definition.name = CurveSource::textOf(expression);
    signal.definition.type = QPlcSignalType(QPlcSignalType::Real64);
    signal.definition.unit = found.unit;
    signal.value = time ? pastValue(*found.store, found.channel, *time) : newestValue(found);
    const std::optional<Row> row = time ? found.store->rowHoldingAt(*time) : found.store->newestRow();
    if (row)
        signal.quality = qualityOf(QPlcQuality::Kind(found.store->greatestMark(found.channel, *row, *row + 1)));
    const bool isAtRest = !time && found.plant->quality() == qplc::Plant::AtRest;
    signal.isCurrent = signal.value.isValid() && (isAtRest || signal.quality.isUsable())
        && (time || found.plant->quality() != qplc::Plant::Stale);
    if (!time && signal.value.isValid())
        signal.age = ageOf(*found.plant, signal.quality);
    const bool isOfLastCycle = found.derived && found.derived->hasPast();
    signal.note = time            ? timeText(signal.value, *time)
        : !signal.value.isValid() ? tr("no value yet")
                                  : noteOf(*found.plant, signal.quality, isOfLastCycle);
    return signal;
}

QPlcPanelContext::Signal QPlcPanelContext::Private::signal(const QString &expression, std::optional<Time> time)
{
    Signal signal;
    if (!window || window->plants()->size() == 0) {
        signal.problem = tr("No plant is connected.");
        return signal;
    }
    if (Formula::isFormula(expression))
        return formula(expression, time);
    const SignalReference reference = SignalReference::fromString(expression, &signal.problem);
    if (!reference.isValid())
        return signal;
    const PlantList::Signal found = window->plants()->resolve(reference, pin());
    if (!found) {
        signal.problem = tr("There is no signal %1 at the moment.").arg(expression);
        return signal;
    }
    signal.plant = found.plant->name();
    signal.definition = found.definition();
    signal.element = found.element;
    signal.writer = found.plant->writer(found.index);
    if (!time) {
        signal.value = found.value();
        signal.quality = found.quality();
        signal.isCurrent = isTrusted(found);
        signal.age = ageOf(*found.plant, signal.quality);
        signal.note = noteOf(*found.plant, signal.quality, false);
        return signal;
    }
    signal.value = pastValue(found, *time);
    const int channel = found.plant->values().channels().channel(found.index, std::max(found.element, 0));
    const SignalStore *store = found.plant->store();
    const std::optional<Row> row = store ? store->rowHoldingAt(*time) : std::nullopt;
    if (row && channel != ChannelMap::NoChannel)
        signal.quality = qualityOf(QPlcQuality::Kind(store->greatestMark(channel, *row, *row + 1)));
    signal.isCurrent = signal.value.isValid() && signal.quality.isUsable();
    signal.note = timeText(signal.value, *time);
    return signal;
}

double QPlcPanelContext::Signal::number(int index) const
{
    bool isNumber = false;
    const double number = value.isValid() ? value.toReal(index, &isNumber) : 0.0;
    return isNumber ? number : std::numeric_limits<double>::quiet_NaN();
}

QPlcPanelContext::QPlcPanelContext(QPlcWidget *panel)
    : d(std::make_unique<Private>(this, panel))
{
    connect(panel, &QPlcWidget::pinnedPlantChanged, d.get(), &Private::forget);
    d->followTime(&d->ownTime);
}

QPlcPanelContext::~QPlcPanelContext() = default;

WindowContext *QPlcPanelContext::window() const
{
    return d->window;
}

QString QPlcPanelContext::pin() const
{
    return d->pin();
}

void QPlcPanelContext::setWindow(WindowContext *window)
{
    if (d->window) {
        d->window->disconnect(d.get());
        d->window->plants()->disconnect(d.get());
        d->window->timeAxis()->disconnect(d.get());
        d->window->curveSources()->disconnect(d.get());
        d->window->events()->disconnect(d.get());
    }
    d->window = window;
    if (!window)
        return;
    Private *own = d.get();
    window->plants()->forEach(own, &Private::follow);
    connect(window->curveSources(), &CurveSources::changed, own, &Private::forget);
    connect(window->curveSources(), &CurveSources::filled, own, [this, own] {
        Q_EMIT pastChanged();
        own->touch();
    });
    connect(window, &WindowContext::valuesChanged, own, [this, own] {
        Q_EMIT valuesChanged();
        own->touch();
    });
    connect(window, &WindowContext::themeChanged, own, [this, own] {
        Q_EMIT themeChanged();
        own->touch();
    });
    own->followTime(window->timeAxis());
    connect(window->events(), &EventLogModel::unacknowledgedChanged, own,
            [this] { Q_EMIT unacknowledgedEventsChanged(); });
    Q_EMIT themeChanged();
    own->forget();
}

QPlcPanelContext::Signal QPlcPanelContext::signal(const QString &expression) const
{
    return d->signal(expression, std::nullopt);
}

QPlcPanelContext::Signal QPlcPanelContext::signal(const QString &expression, Time time) const
{
    return d->signal(expression, time);
}

QPlcPanelContext::Signal QPlcPanelContext::shown(const QString &expression) const
{
    return d->signal(expression, shownTime());
}

QVector<QPlcPanelContext::Sample> QPlcPanelContext::history(const QString &expression, Time begin, Time end,
                                                            int most) const
{
    const CurveSource source = d->window ? d->source(expression) : CurveSource();
    if (!source || source.store->isEmpty() || end < begin)
        return {};
    const SignalStore &store = *source.store;
    const Row first = store.rowAt(begin);
    const Row behind = store.rowAt(end + 1);
    if (first >= behind)
        return {};
    const Row step = rowsOfStep(behind - first, std::max(most, 4));
    QVector<Sample> samples;
    samples.reserve(int((behind - first) / step) + 2);
    Row before = first;
    bool isInterrupted = true;
    for (Row row = first; row < behind;) {
        const Row next = std::min((row / step + 1) * step, behind);
        Sample sample;
        isInterrupted = isInterrupted || store.nextBeginAnew(before + 1, row + 1) <= row;
        before = row;
        if (readStep(store, source.channel, row, next, &sample)) {
            sample.isJoined = !isInterrupted;
            samples.append(sample);
        }
        isInterrupted = samples.isEmpty() || std::isnan(store.value(source.channel, row));
        row = next;
    }
    // The end of a step that is not complete is what people look at.
    Sample newest;
    if (!samples.isEmpty() && (behind - 1) % step != 0 && readStep(store, source.channel, behind - 1, behind, &newest)
        && newest.time > samples.constLast().time) {
        newest.isJoined = store.nextBeginAnew(before + 1, behind) == behind;
        samples.append(newest);
    }
    return samples;
}

QPlcPast QPlcPanelContext::past(const QString &expression) const
{
    return past(expression, d->pin());
}

QPlcPast QPlcPanelContext::past(const QString &expression, const QString &plant) const
{
    if (d->window)
        return PastRows::past(d->window->curveSources()->find(expression, plant));
    QPlcPast past;
    past.expression = expression;
    past.problem = tr("No plant is connected.");
    return past;
}

QStringList QPlcPanelContext::numberNames() const
{
    return d->window ? SignalEdit::names(*d->window->plants(), SignalEdit::Curves) : QStringList();
}

QStringList QPlcPanelContext::signalNames() const
{
    return d->window ? SignalEdit::names(*d->window->plants(), SignalEdit::AllSignals) : QStringList();
}

QPlcTimeAxis *QPlcPanelContext::timeAxis() const
{
    return d->window ? d->window->timeAxis() : &d->ownTime;
}

bool QPlcPanelContext::isLive() const
{
    return timeAxis()->isLive();
}

QPlcPanelContext::Time QPlcPanelContext::begin() const
{
    return d->window ? end() - timeAxis()->span() : 0;
}

QPlcPanelContext::Time QPlcPanelContext::end() const
{
    if (!d->window)
        return 0;
    if (!isLive())
        return timeAxis()->end();
    Time newest = 0;
    for (const QString &name : d->window->plantsOf(d->panel->shownSignals(), d->pin())) {
        if (const qplc::Plant *plant = d->window->plants()->find(name))
            newest = std::max<Time>(newest, plant->newestTime());
    }
    return newest > 0 ? newest : timeAxis()->end();
}

std::optional<QPlcPanelContext::Time> QPlcPanelContext::shownTime() const
{
    return timeAxis()->displayTime();
}

void QPlcPanelContext::showRange(Time begin, Time end)
{
    timeAxis()->show(begin, end);
}

void QPlcPanelContext::goLive()
{
    timeAxis()->goLive();
}

std::optional<QPlcPanelContext::Time> QPlcPanelContext::cursor(Cursor which) const
{
    return timeAxis()->cursor(QPlcTimeAxis::Cursor(which));
}

void QPlcPanelContext::setCursor(Cursor which, std::optional<Time> time)
{
    timeAxis()->setCursor(QPlcTimeAxis::Cursor(which), time);
}

std::optional<QPlcPanelContext::Time> QPlcPanelContext::pointer() const
{
    return timeAxis()->pointer();
}

void QPlcPanelContext::setPointer(std::optional<Time> time)
{
    timeAxis()->setPointer(time);
}

QStringList QPlcPanelContext::plants() const
{
    return d->window ? d->window->plants()->names() : QStringList();
}

QPlcPanelContext::Plant QPlcPanelContext::plant(const QString &name) const
{
    Plant plant;
    const qplc::Plant *found = d->plant(name);
    if (!found)
        return plant;
    plant.name = found->name();
    plant.color = d->window->theme().plant(found->number());
    plant.isConnected = found->isConnected();
    plant.isLive = found->quality() == qplc::Plant::Good;
    plant.isRunning = found->status().isRunning();
    plant.isStale = found->quality() == qplc::Plant::Stale;
    plant.state = stateWord(*found);
    plant.stateText = found->stateText();
    plant.clock = QLatin1String(messages::nameOf(found->status().master.clock));
    plant.age = found->age();
    plant.rate = found->updateRate();
    plant.newest = found->newestTime();
    return plant;
}

void QPlcPanelContext::stop(const QString &name)
{
    if (qplc::Plant *found = d->plant(name))
        found->stop(d->panel->title());
}

bool QPlcPanelContext::askDurations(QObject *receiver, const std::function<void(const QVector<Duration> &)> &answered,
                                    const QString &name)
{
    using Reply = ControlClient::Reply<messages::GetStatistics>;
    qplc::Plant *found = d->plant(name);
    const auto pass = [guard = QPointer<QObject>(receiver), answered](const Reply &reply) {
        const auto *statistics = std::get_if<messages::Statistics>(&reply);
        if (guard && statistics)
            answered(durationsOf(*statistics));
    };
    return found && found->ask(messages::GetStatistics{true}, pass);
}

bool QPlcPanelContext::ask(const QPlcMessage &question, QObject *receiver,
                           const std::function<void(const QPlcMessage &)> &answered, const QString &name)
{
    qplc::Plant *found = d->plant(name);
    return found && found->ask(question, [guard = QPointer<QObject>(receiver), answered](const QPlcMessage &answer) {
        if (guard)
            answered(answer);
    });
}

static_assert(int(QPlcPanelContext::Information) == int(PlantEvent::Information)
              && int(QPlcPanelContext::Warning) == int(PlantEvent::Warning)
              && int(QPlcPanelContext::Error) == int(PlantEvent::Error));

void QPlcPanelContext::report(Severity severity, const QString &source, const QString &text)
{
    if (d->window)
        d->window->events()->append(
            {QDateTime::currentDateTime(), PlantEvent::Severity(severity), source, text, false});
}

QAbstractItemModel *QPlcPanelContext::createSignalModel(QObject *parent) const
{
    if (!d->window)
        return nullptr;
    auto *model = new SignalTreeModel(d->window->plants(), parent);
    const auto show = [this, shown = QPointer<SignalTreeModel>(model)] {
        if (shown)
            shown->setDisplayTime(shownTime());
    };
    connect(timeAxis(), &QPlcTimeAxis::displayTimeChanged, this, show);
    show();
    return model;
}

QAbstractItemModel *QPlcPanelContext::createNodeModel(QObject *parent) const
{
    return d->window ? new NodeTableModel(d->window->plants(), parent) : nullptr;
}

QAbstractItemModel *QPlcPanelContext::eventModel() const
{
    return d->window ? d->window->events() : nullptr;
}

int QPlcPanelContext::unacknowledgedEvents() const
{
    return d->window ? d->window->events()->unacknowledged() : 0;
}

void QPlcPanelContext::acknowledgeEvents()
{
    if (d->window)
        d->window->events()->acknowledgeAll();
}

QPlcTheme QPlcPanelContext::theme() const
{
    QPlcTheme theme = d->window ? d->window->theme() : Theme::byName(Theme::System);
    theme.font = d->panel->font();
    theme.labelFont = theme.font;
    constexpr double labelSize = 0.85;
    if (theme.font.pointSizeF() > 0)
        theme.labelFont.setPointSizeF(std::max(7.0, theme.font.pointSizeF() * labelSize));
    else
        theme.labelFont.setPixelSize(std::max(9, int(theme.font.pixelSize() * labelSize)));
    theme.figureFont = figureFont(theme.font);
    return theme;
}

QString QPlcPanelContext::text(const Signal &signal, int digits)
{
    const QPlcSignalDefinition &definition = signal.definition;
    const bool isArray = definition.type.isArray() && signal.element < 0;
    if (!signal.value.isValid() || (definition.type.isNumeric() && definition.valueNames.isEmpty() && !isArray))
        return text(signal.number(), definition.unit, digits);
    const QString value = valueText(signal.value, definition);
    return QStringLiteral("%1 %2").arg(value, SiPrefix::unitText(definition.unit)).trimmed();
}

QString QPlcPanelContext::text(double number, const QString &unit, int digits)
{
    const Prefix shown = prefix(unit, std::abs(number));
    return QStringLiteral("%1 %2").arg(steadyNumberText(number * shown.factor, digits), shown.unit).trimmed();
}

QString QPlcPanelContext::ageText(double seconds)
{
    return qplc::ageText(seconds);
}

QPlcPanelContext::Prefix QPlcPanelContext::prefix(const QString &unit, double size)
{
    const SiPrefix fitting = SiPrefix::fitting(unit, size);
    return {fitting.factor(), fitting.unit()};
}
