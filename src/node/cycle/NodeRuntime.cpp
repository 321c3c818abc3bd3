// SPDX-License-Identifier: Apache-2.0
#include "NodeRuntime.h"

#include "QSplitPrimitive.h"
#include "SafeValues.h"

#include <QtCore/QSet>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace qplc {

namespace {

constexpr char unknownException[] = "an exception that is not derived from std::exception";

QString describeException(std::exception_ptr exception)
{
    try {
        std::rethrow_exception(exception);
    } catch (const std::exception &thrown) {
        return QString::fromLocal8Bit(thrown.what());
    } catch (...) {
        return QLatin1String(unknownException);
    }
}

/// Calls code of the user. \return false with the text of what it threw
template<typename Code>
bool guarded(const char *function, QString *error, Code code)
{
    try {
        code();
        return true;
    } catch (...) {
        *error
            = QStringLiteral("%1 threw: %2").arg(QLatin1String(function), describeException(std::current_exception()));
        return false;
    }
}

QStringList repeatedNames(const QPlcSignalTable &table, const QVector<QPlcSignalIndex> &indices)
{
    QSet<QPlcSignalIndex> seen;
    QStringList repeated;
    for (QPlcSignalIndex index : indices) {
        if (seen.contains(index))
            repeated << table.at(index).name;
        seen.insert(index);
    }
    return repeated;
}

}  // namespace

NodeRuntime::NodeRuntime(NodeCode &code, const NodeTraits &traits)
    : m_code(code)
    , m_traits(traits)
{
}

bool NodeRuntime::bind(const QPlcSignalTable &table, QString *error)
{
    NodeCode::Declaration declared;
    QStringList errors;
    QString text;
    m_table = table;
    bool bound = false;
    m_isCodeGone = false;
    if (!guarded("the declaration of signals", &text, [&] { bound = m_code.declare(table, &declared, &text); })
        || !bound)
        errors << text;
    else
        bindWorkloadSignal(&declared.outputs, &errors);
    for (const QString &name : repeatedNames(table, declared.inputs) + repeatedNames(table, declared.outputs))
        errors << QStringLiteral("signal '%1' is declared twice; declare it once").arg(name);
    if (!errors.isEmpty()) {
        *error = QStringLiteral("node '%1': %2").arg(m_traits.name, errors.join(QStringLiteral("; ")));
        return false;
    }
    bindInputs(declared.inputs);
    const quint64 former = m_outputLayout.hash();
    m_outputLayout
        = PayloadLayout(table, declared.outputs,
                        m_traits.outputQuality ? PayloadLayout::WithQualities : PayloadLayout::WithoutQualities);
    m_sameCycle.clear();
    for (QPlcSignalIndex input : qAsConst(declared.inputs))
        m_sameCycle.push_back(m_traits.sameCycle || declared.sameCycle.contains(input));
    m_outputs.assign(m_outputLayout.size(), 0);
    if (m_outputLayout.hash() != former)
        m_scratch.assign(m_outputLayout.size(), 0);
    m_safeInputs = safeFrame(table, m_seenLayout);
    m_safeOutputs = safeFrame(table, m_outputLayout);
    m_workload = nullptr;
    for (const PayloadLayout::Field &field : m_outputLayout.fields()) {
        if (!m_workloadSignal.isEmpty() && table.at(field.signal).name == m_workloadSignal)
            m_workload = &field;
    }
    m_code.bind(table, m_seenLayout, m_outputLayout);
    return true;
}

void NodeRuntime::bindInputs(const QVector<QPlcSignalIndex> &inputs)
{
    const auto wanted = m_traits.quality ? PayloadLayout::WithQualities : PayloadLayout::WithoutQualities;
    m_seenLayout = PayloadLayout(m_table, inputs, wanted);
    m_inputLayout = m_qualityOffered ? m_seenLayout : PayloadLayout(m_table, inputs);
    m_inputFrame = SignalGuard::frameFor(m_table, m_inputLayout);
    m_inputs.assign(m_seenLayout.size(), 0);
    m_ownQualities.assign(m_seenLayout.fields().size(), 0);
    restartGuard();
}

void NodeRuntime::restartGuard()
{
    m_guard.emplace(m_table, m_seenLayout, m_inputs.data(), m_ownQualities.data(),
                    static_cast<SignalGuard::Observer *>(this));
    m_master = {};
    m_refusedInputs.set(0);
}

/// The master guards its image; a frame may still be that of another table, or a fault that nobody
/// thought of. What moves things looks for itself.
const char *NodeRuntime::guardedInputs(const char *payload, std::int64_t cycle) noexcept
{
    m_guard->store(m_inputFrame, m_master, payload, cycle, cycle);
    m_guard->settle(cycle);
    if (!m_seenLayout.hasQualities())
        return m_inputs.data();
    const char *given = m_inputLayout.hasQualities() ? payload + m_inputLayout.valueSize() : m_ownQualities.data();
    char *seen = m_inputs.data() + m_seenLayout.valueSize();
    std::memcpy(seen, given, m_ownQualities.size());
    for (std::size_t i = 0; !m_master.isWhole && i < m_ownQualities.size(); ++i)
        seen[i] = char(std::max(quint8(seen[i]), quint8(m_ownQualities[i])));  // the greater byte is the worse quality
    return m_inputs.data();
}

void NodeRuntime::bindWorkloadSignal(QVector<QPlcSignalIndex> *outputs, QStringList *errors)
{
    if (m_workloadSignal.isEmpty())
        return;
    const QPlcSignalIndex index = m_table.indexOf(m_workloadSignal);
    if (index == QPlcInvalidSignalIndex) {
        *errors << m_table.unknownSignalText(m_workloadSignal);
        return;
    }
    const QPlcSignalType type = m_table.at(index).type;
    if (!type.isReal() || type.isArray())
        *errors
            << QStringLiteral("workload signal '%1' is %2; give it the type Real").arg(m_workloadSignal, type.name());
    else if (!outputs->contains(index))
        outputs->append(index);
}

bool NodeRuntime::reset(QString *error)
{
    m_faultText[0] = '\0';
    for (const PayloadLayout::Field &field : m_outputLayout.fields())
        m_table.at(field.signal).initial.toBytes(m_scratch.data() + field.offset);
    if (!guarded("the initialization", error, [this] { m_code.reset(m_scratch.data()); }))
        return false;
    writeWorkload(0);
    m_outputs = m_scratch;
    return true;
}

bool NodeRuntime::initialize(const char *inputs, QString *error)
{
    storeInputs(inputs);
    return guarded("initialize()", error, [&] { m_code.initialize(m_inputs.data()); });
}

void NodeRuntime::storeInputs(const char *inputs)
{
    restartGuard();
    guardedInputs(inputs, -1);
}

void NodeRuntime::stopped()
{
    if (m_isCodeGone.load(std::memory_order_relaxed))
        return;
    QString text;
    if (!guarded("stopped()", &text, [this] { m_code.stopped(); }))
        setFault(text.toLocal8Bit().constData());
}

void NodeRuntime::beginPhase(bool isLockstep, TimeSource &time, std::int64_t usualHold)
{
    m_time = isLockstep ? nullptr : &time;
    m_guard->setUsualHold(usualHold);
    m_isSafe = m_hasFailed = false;
    m_wantsSafeStop.store(false, std::memory_order_relaxed);
}

void NodeRuntime::makeSafe(QPlcSlaveNode::SafeStateReason reason) noexcept
{
    if (m_isSafe)
        return;
    m_isSafe = true;
    m_outputs = m_safeOutputs;
    if (!m_isCodeGone.load(std::memory_order_relaxed))
        attempt([&] { m_code.makeSafe(reason, m_safeInputs.data()); });
}

/// Calls code of the user in a cycle. \return false when it threw
template<typename Code>
bool NodeRuntime::attempt(Code code) noexcept
{
    try {
        code();
        return true;
    } catch (const std::exception &thrown) {
        setFault(thrown.what());
    } catch (...) {
        setFault(unknownException);
    }
    return false;
}

bool NodeRuntime::step(const QPlcCycle &cycle, const char *inputs) noexcept
{
    if (m_hasFailed || (m_isSafe && !m_traits.listener))
        return !m_hasFailed;
    const std::int64_t begin = now();
    m_cycle = cycle;
    const char *seen = guardedInputs(inputs, std::int64_t(cycle.number()));
    const bool isComputed = attempt([&] { m_code.step(cycle, seen, m_scratch.data()); });
    measure(begin);
    if (!isComputed) {
        m_hasFailed = true;
        makeSafe(QPlcSlaveNode::CodeFailed);
        return false;
    }
    if (WakeUp *wakeUp = m_stepWakeUp.load(std::memory_order_acquire))
        wakeUp->notify();
    if (m_isSafe)
        return true;  // a listener that watches: what it writes stays safe
    writeWorkload(m_executionTime);
    m_outputs = m_scratch;
    return true;
}

WakeUp &NodeRuntime::stepWakeUp()
{
    if (!m_ownStepWakeUp) {
        m_ownStepWakeUp = std::make_unique<WakeUp>();
        m_stepWakeUp.store(m_ownStepWakeUp.get(), std::memory_order_release);
    }
    return *m_ownStepWakeUp;
}

void NodeRuntime::measure(std::int64_t begin) noexcept
{
    m_endOfStep = now();
    m_executionTime = m_endOfStep - begin;
}

void NodeRuntime::writeWorkload(std::int64_t duration)
{
    if (!m_workload)
        return;
    const double seconds = double(duration) * 1e-9;
    if (m_workload->type.scalar() == QPlcSignalType::Real32)
        QSplitPrimitive<float>(float(seconds)).toBytes(m_scratch.data() + m_workload->offset);
    else
        QSplitPrimitive<double>(seconds).toBytes(m_scratch.data() + m_workload->offset);
}

/// Keeps the first text of a phase: its owner reads it while cycles go on, and what follows is an
/// echo.
void NodeRuntime::setFault(const char *text) noexcept
{
    if (m_faultText[0] == '\0')
        std::snprintf(m_faultText.data(), m_faultText.size(), "%s", text);
}

QPlcSignalList NodeRuntime::toList(const PayloadLayout &layout, const char *frame)
{
    QPlcSignalList list;
    list.reserve(int(layout.fields().size()));
    for (const PayloadLayout::Field &field : layout.fields())
        list.insert(field.signal, QPlcValue::fromBytes(field.type, frame + field.offset));
    return list;
}

void NodeRuntime::fromList(const QPlcSignalList &list, const QPlcSignalTable &table, const PayloadLayout &layout,
                           char *frame)
{
    int used = 0;
    for (const PayloadLayout::Field &field : layout.fields()) {
        const QPlcValue value = list.value(field.signal);
        if (!value.isValid())
            continue;
        const QPlcValue converted = value.convertedTo(field.type);
        if (!converted.isValid()) {
            const QString text
                = QStringLiteral("the value %1 (%2) does not fit signal '%3' of type %4")
                      .arg(value.toString(), value.type().name(), table.at(field.signal).name, field.type.name());
            throw std::runtime_error(text.toStdString());
        }
        converted.toBytes(frame + field.offset);
        ++used;
    }
    if (used == list.size())
        return;
    for (const QPlcSignalList::Entry &entry : list) {
        if (std::none_of(layout.fields().begin(), layout.fields().end(),
                         [&](const PayloadLayout::Field &field) { return field.signal == entry.index; }))
            throw std::runtime_error(QStringLiteral("signal '%1' is not declared as an output")
                                         .arg(table.at(entry.index).name)
                                         .toStdString());
    }
}

}  // namespace qplc
