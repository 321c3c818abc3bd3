// SPDX-License-Identifier: Apache-2.0
#include "QPlcNodeRunner.h"

#include "QPlcSignalIndexTable.h"
#include "QPlcSlaveNodePrivate.h"
#include "node/cycle/NodeRegistry.h"
#include "node/cycle/PeriodRange.h"
#include "node/cycle/ProfileDefaults.h"
#include "node/cycle/SafeValues.h"

#include <cstring>

using qplc::PayloadLayout;
using qplc::SignalGuard;

namespace {

constexpr std::chrono::hours LongestTime{24 * 365 * 100};  // of a phase

/// Without `writer`: one node is all that there is, so none of its signals is contested.
QPlcSignalTable withoutWriters(const QPlcSignalTable &table)
{
    QPlcSignalTable result;
    for (QPlcSignalDefinition signal : table) {
        signal.writers.clear();
        result.append(signal);
    }
    return result;
}

QPlcSignalType elementOf(QPlcSignalType type)
{
    return type.isDateTime() ? QPlcSignalType(QPlcSignalType::Int64) : QPlcSignalType(type.scalar());
}

}  // namespace

/// What a master is to one node: an image of all signals, its guard, and the order of a cycle.
class QPlcNodeRunnerPrivate : private SignalGuard::Observer
{
public:
    QPlcNodeRunnerPrivate(QPlcSlaveNode &slave, std::chrono::nanoseconds time)
        : node(QPlcSlaveNodePrivate::of(slave))
        , period(time)
    {
    }

    /// What a signal is to the node.
    struct Place
    {
        enum Kind : quint8 { None, Input, Output };
        Kind kind = None;
        char *bytes = nullptr;    // in `given`, or in the image
        char *quality = nullptr;  // that is given with an input
    };

    bool fail(const QString &text) const;
    bool failForInput(QPlcSignalIndex index) const;
    bool failForValue(QPlcSignalIndex index, const QPlcValue &value) const;
    bool bind(const QPlcSignalTable &newTable);
    void findPlaces(const QVector<QPlcSignalIndex> &inputs);
    bool reset();
    bool isAllowed();
    void initialize(QString *error);
    void beginPhase();
    const char *cutInputs(std::int64_t cycle) noexcept;
    void storeOutputs(std::int64_t cycle) noexcept;
    void showSafeOutputs();
    bool step() noexcept;
    void stop();
    const Place &place(QPlcSignalIndex index) const
    {
        static const Place none;
        return index < places.size() ? places[index] : none;
    }
    QPlcQuality qualityOf(QPlcSignalIndex index) const
    {
        return place(index).kind == Place::None ? QPlcQuality() : m_image.quality(index);
    }
    QVector<QPlcSignalIndex> all(Place::Kind kind) const;
    char *element(QPlcSignalIndex index, int element) const;
    bool setElement(QPlcSignalIndex index, int element, const QPlcValue &value) const;

    QPlcSlaveNodePrivate &node;
    std::chrono::nanoseconds period;
    QPlcProfile::Value profile = QPlcProfile::Simulation;
    mutable QString error;
    bool isBound = false;
    bool isReset = false;
    bool isRunning = false;
    quint64 number = 0;   // of the next cycle
    quint64 skipped = 0;  // before it
    quint64 digest = 0;
    QPlcSignalTable table;
    std::vector<Place> places;  // of each signal
    std::optional<SignalGuard> guard;

private:
    void valueRefused(std::uint16_t, SignalGuard::Place, const qplc::ValueFault &, bool) noexcept override {}
    void signalBecameSafe(SignalGuard::Place) noexcept override {}
    void sourceChanged(SignalGuard::Place, std::uint16_t, std::uint16_t) noexcept override {}

    qplc::ProcessImage m_image;
    SignalGuard::Frame m_givenFrame;
    SignalGuard::Frame m_outputFrame;
    SignalGuard::Writer m_giver;
    SignalGuard::Writer m_writer;
    std::vector<char> m_given;    // inputs as they were set, with their qualities
    std::vector<char> m_initial;  // what they are at a reset
    std::vector<char> m_inputs;   // as the node gets them
    std::vector<qplc::CopyRun> m_inputRuns;
    bool m_isSafeShown = false;
};

bool QPlcNodeRunnerPrivate::fail(const QString &text) const
{
    error = QStringLiteral("node '%1': %2").arg(node.name, text);
    return false;
}

bool QPlcNodeRunnerPrivate::bind(const QPlcSignalTable &newTable)
{
    stop();
    isBound = isReset = false;
    places.clear();
    if (node.state != QPlcSlaveNode::Disconnected || node.localMaster)
        return fail(QStringLiteral("it is the node of a master; disconnect it first, or run another object"));
    if (QPlcSignalIndexTable::current().isEmpty())
        QPlcSignalIndexTable::setCurrent(newTable);  // what lists of signals look their names up in
    if (!node.runtime.bind(newTable, &error))
        return false;
    qplc::Refusal refusal;
    if (!qplc::NodeRegistry(newTable).admit(qplc::NodeDeclaration::fromRuntime(node.runtime), &refusal))
        return fail(refusal.text);
    table = newTable;
    m_image = qplc::ProcessImage(withoutWriters(table));
    places.resize(std::size_t(table.size()));
    for (const PayloadLayout::Field &output : node.runtime.outputLayout().fields())
        places[output.signal] = {Place::Output, m_image.data() + m_image.offset(output.signal)};
    QVector<QPlcSignalIndex> inputs;
    for (const PayloadLayout::Field &input : node.runtime.inputLayout().fields()) {
        if (places[input.signal].kind == Place::None)
            inputs.append(input.signal);
    }
    findPlaces(inputs);
    m_outputFrame = SignalGuard::frameFor(m_image, node.runtime.outputLayout());
    m_inputRuns = m_image.gatherRuns(node.runtime.inputLayout());
    m_inputs.assign(node.runtime.inputLayout().size(), 0);
    return isBound = true;
}

void QPlcNodeRunnerPrivate::findPlaces(const QVector<QPlcSignalIndex> &inputs)
{
    const PayloadLayout layout(table, inputs, PayloadLayout::WithQualities);
    m_givenFrame = SignalGuard::frameFor(m_image, layout);
    m_given.assign(layout.size(), char(QPlcQuality(QPlcQuality::Good).toByte()));
    for (std::size_t i = 0; i < layout.fields().size(); ++i) {
        const PayloadLayout::Field &field = layout.fields()[i];
        places[field.signal] = {Place::Input, m_given.data() + field.offset, m_given.data() + layout.valueSize() + i};
        const QPlcSignalDefinition &signal = table.at(field.signal);
        (signal.initial.isFinite() ? signal.initial : signal.safeValue()).toBytes(m_given.data() + field.offset);
    }
    m_initial = m_given;
}

/// Initial outputs are those of the cycle before the first one, or, where they are known before it,
/// those of the first one.
bool QPlcNodeRunnerPrivate::reset()
{
    stop();
    isReset = false;
    if (!isBound)
        return fail(QStringLiteral("it has no signal table; call bind() first"));
    number = skipped = digest = 0;
    m_isSafeShown = false;
    m_giver = m_writer = {};
    std::copy(m_initial.begin(), m_initial.end(), m_given.begin());
    m_image.reset();
    guard.emplace(m_image, static_cast<SignalGuard::Observer *>(this));
    guard->setUsualHold(qplc::ProfileDefaults::of(profile).hold);
    node.phaseProfile = profile;
    QString text;
    if (!node.runtime.reset(&text))
        return fail(text);
    if (!isAllowed())
        return false;
    storeOutputs(node.twoPhase ? 0 : -1);
    return isReset = true;
}

bool QPlcNodeRunnerPrivate::isAllowed()
{
    for (const SignalGuard::Frame::Field &field : m_outputFrame.fields) {
        const QPlcSignalDefinition &signal = table.at(QPlcSignalIndex(field.place));
        if (const qplc::ValueFault fault = m_outputFrame.fault(field, node.runtime.outputs()))
            return fail(QStringLiteral("the initial value of signal '%1': %2")
                            .arg(signal.name, qplc::faultText(signal, fault)));
    }
    return true;
}

void QPlcNodeRunnerPrivate::initialize(QString *text)
{
    if (node.runtime.initialize(cutInputs(-1), text))
        beginPhase();
}

void QPlcNodeRunnerPrivate::beginPhase()
{
    node.runtime.beginPhase(true, qplc::TimeSource::monotonic(), qplc::ProfileDefaults::of(profile).hold);
    guard->settle(-1);
    guard->clearCounters();
    isReset = false;  // the next phase needs another one
    isRunning = true;
}

/// What is set comes from a node that has computed before this one, in the same cycle.
const char *QPlcNodeRunnerPrivate::cutInputs(std::int64_t cycle) noexcept
{
    guard->store(m_givenFrame, m_giver, m_given.data(), cycle, cycle);
    guard->miss(m_givenFrame, m_giver, cycle);
    qplc::copyRuns(m_inputRuns, m_image.data(), m_inputs.data());
    return m_inputs.data();
}

void QPlcNodeRunnerPrivate::storeOutputs(std::int64_t cycle) noexcept
{
    guard->store(m_outputFrame, m_writer, node.runtime.outputs(), cycle, cycle);
}

/// In the order of MasterCycle and NodeExchange.
bool QPlcNodeRunnerPrivate::step() noexcept
{
    const auto cycle = std::int64_t(number);
    if (node.runtime.wantsSafeStop())
        node.runtime.makeSafe(QPlcSlaveNode::MasterStopsSafely);
    if (skipped > 0)
        guard->settle(cycle - 1);
    const char *inputs = cutInputs(cycle);
    const bool hasComputed = node.runtime.step(QPlcCycle(number, period, skipped), inputs);
    ++number;
    skipped = 0;
    if (node.runtime.isSafe()) {
        showSafeOutputs();
        guard->settle(cycle);
        digest = m_image.digest(digest);
        return hasComputed;
    }
    if (!node.twoPhase)
        storeOutputs(cycle);
    guard->miss(m_outputFrame, m_writer, cycle);
    guard->settle(cycle);
    digest = m_image.digest(digest);
    if (node.twoPhase)
        storeOutputs(cycle + 1);
    return true;
}

void QPlcNodeRunnerPrivate::showSafeOutputs()
{
    if (m_isSafeShown)
        return;
    m_isSafeShown = true;
    for (std::size_t index = 0; index < places.size(); ++index) {
        if (places[index].kind != Place::Output)
            continue;
        table.at(QPlcSignalIndex(index)).safeValue().toBytes(places[index].bytes);
        guard->set(SignalGuard::Place(index), QPlcQuality::Safe);
    }
}

void QPlcNodeRunnerPrivate::stop()
{
    if (!isRunning)
        return;
    isRunning = false;
    node.runtime.makeSafe(QPlcSlaveNode::PhaseEnded);
    node.runtime.stopped();
}

QVector<QPlcSignalIndex> QPlcNodeRunnerPrivate::all(Place::Kind kind) const
{
    QVector<QPlcSignalIndex> result;
    const PayloadLayout &layout = kind == Place::Input ? node.runtime.inputLayout() : node.runtime.outputLayout();
    for (const PayloadLayout::Field &field : layout.fields()) {
        if (place(field.signal).kind == kind)
            result.append(field.signal);
    }
    return result;
}

bool QPlcNodeRunnerPrivate::failForInput(QPlcSignalIndex index) const
{
    if (place(index).kind == Place::Output)
        return fail(QStringLiteral("signal '%1' is an output; set inputs only").arg(table.at(index).name));
    return fail(index < places.size()
                    ? QStringLiteral("it does not read signal '%1'; declare a port for it").arg(table.at(index).name)
                    : QStringLiteral("there is no signal with the index %1; get it with indexOf()").arg(index));
}

bool QPlcNodeRunnerPrivate::failForValue(QPlcSignalIndex index, const QPlcValue &value) const
{
    const QPlcSignalDefinition &signal = table.at(index);
    return fail(QStringLiteral("the value %1 (%2) does not fit signal '%3' of type %4")
                    .arg(value.toString(), value.type().name(), signal.name, signal.type.name()));
}

/// \return null when there is no such number
char *QPlcNodeRunnerPrivate::element(QPlcSignalIndex index, int element) const
{
    const Place &where = place(index);
    if (where.kind == Place::None)
        return nullptr;
    const QPlcSignalType type = table.at(index).type;
    return type.isString() || element < 0 || element >= type.count() ? nullptr
                                                                     : where.bytes + element * type.elementSize();
}

/// \return false when there is no such number of an input, or \a value does not fit
bool QPlcNodeRunnerPrivate::setElement(QPlcSignalIndex index, int element, const QPlcValue &value) const
{
    if (place(index).kind != Place::Input)
        return failForInput(index);
    char *bytes = this->element(index, element);
    if (!bytes)
        return fail(QStringLiteral("signal '%1' of type %2 has no number %3")
                        .arg(table.at(index).name, table.at(index).type.name())
                        .arg(element));
    const QPlcValue converted = value.convertedTo(elementOf(table.at(index).type));
    if (!converted.isValid())
        return failForValue(index, value);
    converted.toBytes(bytes);
    return true;
}

// ---- the public class ----

QPlcNodeRunner::QPlcNodeRunner(QPlcSlaveNode &node, std::chrono::nanoseconds period)
    : d(std::make_unique<QPlcNodeRunnerPrivate>(node, std::chrono::milliseconds(10)))
{
    setPeriod(period);
}

QPlcNodeRunner::~QPlcNodeRunner()
{
    d->stop();
}

bool QPlcNodeRunner::bind(const QPlcSignalTable &table)
{
    return d->bind(table);
}

bool QPlcNodeRunner::isBound() const
{
    return d->isBound;
}

bool QPlcNodeRunner::setPeriod(std::chrono::nanoseconds period)
{
    if (period < qplc::ShortestPeriod || period > qplc::LongestPeriod)
        return d->fail(QStringLiteral("a period of %1 ns is out of range; use 10 us to 10 s").arg(period.count()));
    if (d->isRunning)
        return d->fail(QStringLiteral("the period cannot change while cycles run; call stop() first"));
    d->period = period;
    return true;
}

std::chrono::nanoseconds QPlcNodeRunner::period() const
{
    return d->period;
}

void QPlcNodeRunner::setProfile(QPlcProfile::Value profile)
{
    d->profile = profile == QPlcProfile::Automatic ? QPlcProfile::Simulation : profile;
}

bool QPlcNodeRunner::reset()
{
    return d->reset();
}

bool QPlcNodeRunner::initialize()
{
    if (!d->isReset && !d->reset())
        return false;
    QString text;
    d->initialize(&text);
    return d->isRunning || d->fail(text);
}

bool QPlcNodeRunner::step()
{
    if (!d->isRunning)
        return d->fail(QStringLiteral("no phase has begun; call initialize() first"));
    const bool hadFailed = hasFailed();
    if (d->step())
        return true;
    if (!hadFailed)
        d->fail(QStringLiteral("step() of cycle %1 threw: %2; the node is in its safe state")
                    .arg(d->number - 1)
                    .arg(QString::fromLocal8Bit(d->node.runtime.faultText())));
    return false;
}

bool QPlcNodeRunner::skip(quint64 cycles)
{
    const auto most = quint64(LongestTime / d->period);
    if (!d->isRunning)
        return d->fail(QStringLiteral("no phase has begun; call initialize() first"));
    if (cycles > most - std::min(d->number, most))
        return d->fail(
            QStringLiteral("%1 cycles are too many to skip; the last cycle of a phase with this period is %2")
                .arg(cycles)
                .arg(most));  // time() has room for all cycles that follow
    d->number += cycles;
    d->skipped += cycles;
    return true;
}

void QPlcNodeRunner::makeSafe(QPlcSlaveNode::SafeStateReason reason)
{
    if (!d->isRunning)
        return;
    d->node.runtime.makeSafe(reason);
    d->showSafeOutputs();
}

void QPlcNodeRunner::stop()
{
    d->stop();
}

bool QPlcNodeRunner::isRunning() const
{
    return d->isRunning;
}

quint64 QPlcNodeRunner::nextCycle() const
{
    return d->number;
}

std::chrono::nanoseconds QPlcNodeRunner::time() const
{
    return d->period * qint64(d->number);
}

bool QPlcNodeRunner::isSafe() const
{
    return d->isRunning && d->node.runtime.isSafe();
}

bool QPlcNodeRunner::hasFailed() const
{
    return d->node.runtime.hasFailed();
}

bool QPlcNodeRunner::wantsSafeStop() const
{
    return d->node.runtime.wantsSafeStop();
}

QString QPlcNodeRunner::errorString() const
{
    return d->error;
}

quint64 QPlcNodeRunner::digest() const
{
    return d->digest;
}

// ---- signals ----

const QPlcSignalTable &QPlcNodeRunner::table() const
{
    return d->table;
}

QVector<QPlcSignalIndex> QPlcNodeRunner::inputs() const
{
    return d->all(QPlcNodeRunnerPrivate::Place::Input);
}

QVector<QPlcSignalIndex> QPlcNodeRunner::outputs() const
{
    return d->all(QPlcNodeRunnerPrivate::Place::Output);
}

QPlcSignalIndex QPlcNodeRunner::indexOf(const QString &name) const
{
    const QPlcSignalIndex index = d->table.indexOf(name);
    if (isInput(index) || isOutput(index))
        return index;
    d->fail(index == QPlcInvalidSignalIndex
                ? d->table.unknownSignalText(name)
                : QStringLiteral("it neither reads nor writes signal '%1'; declare a port for it").arg(name));
    return QPlcInvalidSignalIndex;
}

bool QPlcNodeRunner::isInput(QPlcSignalIndex index) const
{
    return d->place(index).kind == QPlcNodeRunnerPrivate::Place::Input;
}

bool QPlcNodeRunner::isOutput(QPlcSignalIndex index) const
{
    return d->place(index).kind == QPlcNodeRunnerPrivate::Place::Output;
}

bool QPlcNodeRunner::set(const QString &name, const QPlcValue &value)
{
    const QPlcSignalIndex index = indexOf(name);
    if (index == QPlcInvalidSignalIndex)
        return false;
    if (!isInput(index))
        return d->failForInput(index);
    const QPlcSignalDefinition &signal = d->table.at(index);
    if (!value.type().isString() || signal.type.isString())
        return setValue(index, value);
    QString text;
    const QPlcValue named = signal.valueFromText(value.toString(), &text);
    return named.isValid() ? setValue(index, named) : d->fail(QStringLiteral("signal '%1': %2").arg(name, text));
}

QPlcValue QPlcNodeRunner::value(const QString &name) const
{
    const QPlcSignalIndex index = indexOf(name);
    return index == QPlcInvalidSignalIndex ? QPlcValue() : value(index);
}

QString QPlcNodeRunner::text(const QString &name) const
{
    const QPlcSignalIndex index = indexOf(name);
    return index == QPlcInvalidSignalIndex ? QString() : d->table.at(index).textOf(value(index));
}

bool QPlcNodeRunner::setValue(QPlcSignalIndex index, const QPlcValue &value)
{
    if (!isInput(index))
        return d->failForInput(index);
    const QPlcValue converted = value.convertedTo(d->table.at(index).type);
    if (!converted.isValid())
        return d->failForValue(index, value);
    converted.toBytes(d->place(index).bytes);
    return true;
}

bool QPlcNodeRunner::setReal(QPlcSignalIndex index, double value, int element)
{
    return d->setElement(index, element, QPlcValue(value));
}

bool QPlcNodeRunner::setInteger(QPlcSignalIndex index, qint64 value, int element)
{
    return d->setElement(index, element, QPlcValue(value));
}

bool QPlcNodeRunner::setBytes(QPlcSignalIndex index, const void *bytes)
{
    if (!isInput(index))
        return d->failForInput(index);
    std::memcpy(d->place(index).bytes, bytes, std::size_t(d->table.at(index).type.size()));
    return true;
}

QPlcValue QPlcNodeRunner::value(QPlcSignalIndex index) const
{
    const char *bytes = this->bytes(index);
    return bytes ? QPlcValue::fromBytes(d->table.at(index).type, bytes) : QPlcValue();
}

double QPlcNodeRunner::real(QPlcSignalIndex index, int element) const
{
    const char *bytes = d->element(index, element);
    return bytes ? QPlcValue::fromBytes(elementOf(d->table.at(index).type), bytes).toReal() : 0.0;
}

qint64 QPlcNodeRunner::integer(QPlcSignalIndex index, int element) const
{
    const char *bytes = d->element(index, element);
    return bytes ? QPlcValue::fromBytes(elementOf(d->table.at(index).type), bytes).toInt64() : 0;
}

const char *QPlcNodeRunner::bytes(QPlcSignalIndex index) const
{
    return d->place(index).bytes;
}

bool QPlcNodeRunner::setQuality(QPlcSignalIndex index, QPlcQuality quality)
{
    if (!isInput(index))
        return d->failForInput(index);
    *d->place(index).quality = char(quality.toByte());
    return true;
}

QPlcQuality QPlcNodeRunner::quality(QPlcSignalIndex index) const
{
    return d->qualityOf(index);
}

quint64 QPlcNodeRunner::refusedValues(QPlcSignalIndex index) const
{
    return d->guard && d->place(index).kind != QPlcNodeRunnerPrivate::Place::None
        ? d->guard->nonFinite(index) + d->guard->outOfRange(index)
        : 0;
}
