// SPDX-License-Identifier: Apache-2.0
// A node as a controller DLL of Bladed, OpenFAST and HAWC2.
#include "DisconMapping.h"
#include "ExportedNode.h"

#include <cmath>
#include <cstring>

using namespace qplc_export;

namespace {

// Records are counted from 1.
constexpr int StatusRecord = 1;
constexpr float FirstCall = 0.0F;
constexpr float StepCall = 1.0F;
constexpr float LastCall = -1.0F;
constexpr int TimeRecord = 2;           // [s]
constexpr int PeriodRecord = 3;         // [s] between two calls
constexpr int MessageSizeRecord = 49;   // [characters] of avcMSG
constexpr int FileNameSizeRecord = 50;  // [characters] of accINFILE
constexpr std::size_t LongestFileName = 4096;
constexpr std::size_t LongestMessage = 1024;

/// What the host gives with a call.
struct Call
{
    float *records;
    const char *file;

    float record(int number) const { return records[number - 1]; }
    /// Of a size; 0 if it is none.
    int whole(int number) const
    {
        const float value = record(number);
        return std::abs(value) < 1e9F ? int(std::lround(value)) : 0;
    }
    QString fileName() const
    {
        const int given = whole(FileNameSizeRecord);
        const std::size_t most = given > 0 ? std::min(std::size_t(given), LongestFileName) : LongestFileName;
        return file ? QString::fromLocal8Bit(file, int(::strnlen(file, most))).trimmed() : QString();
    }
};

/// The node from a first call to the last one.
class Controller
{
public:
    /// \return false, with a sentence in text()
    bool call(const Call &call);
    QString text() const { return m_text; }
    /// What was wrong although the call has succeeded; empty: nothing.
    QString warning() const { return m_node && m_node->plant() ? m_node->plant()->warning() : QString(); }

private:
    bool fail(const QString &text)
    {
        m_text = text;
        return false;
    }
    bool begin(const Call &call);
    bool prepare(const Call &call);
    bool hasEnded(const QString &failure);
    bool setPeriod(float seconds);
    bool step(const Call &call);
    bool readInputs(const Call &call);
    void writeOutputs(const Call &call) const;

    std::unique_ptr<ExportedNode> m_node;
    DisconMapping m_mapping;
    QString m_text;
    QString m_failure;  // that has ended the phase, or kept it from its begin; empty: none
    bool m_isRunning = false;
    double m_start = 0.0;  // [s] time of cycle 0
};

bool Controller::call(const Call &call)
{
    m_text.clear();
    const float status = call.record(StatusRecord);
    if (status != FirstCall && status != StepCall && status != LastCall)
        return fail(
            QStringLiteral("record 1 is %1; use 0 (first call), 1 (step) or -1 (last call)").arg(double(status)));
    if (status == FirstCall)
        return begin(call);
    const bool wasRunning = m_isRunning;
    if (status == LastCall) {
        m_isRunning = false;
        m_node.reset();  // also after a failure: a plant leaves its port
    }
    if (!m_failure.isEmpty())
        return fail(m_failure);
    if (!wasRunning)
        return fail(QStringLiteral("there was no first call (record 1 = 0) before this one (record 1 = %1)")
                        .arg(double(status)));
    return status == LastCall || step(call);
}

/// All calls until the next first one tell what has failed first.
bool Controller::hasEnded(const QString &failure)
{
    m_isRunning = false;
    m_failure = failure;
    return fail(failure);
}

bool Controller::begin(const Call &call)
{
    m_failure.clear();
    m_isRunning = prepare(call);
    if (m_isRunning)
        return step(call);
    m_node.reset();  // a plant leaves its port
    return hasEnded(m_text);
}

bool Controller::prepare(const Call &call)
{
    m_node = std::make_unique<ExportedNode>();
    QString error;
    if (!m_node->make(&error))
        return fail(error);
    QPlcNodeRunner &runner = m_node->runner();
    if (!runner.reset())
        return fail(runner.errorString());
    if (!m_mapping.read(call.fileName(), *m_node, &error))
        return fail(error);
    if (!setPeriod(call.record(PeriodRecord)))
        return false;
    m_start = double(call.record(TimeRecord));
    if (!std::isfinite(m_start))
        return fail(QStringLiteral("the time in record 2 is not a finite number"));
    if (!readInputs(call))
        return false;
    if (!m_node->open(&error))
        return fail(error);
    return runner.initialize() || fail(m_node->failure());
}

/// The host decides, unless the library was made for one period.
bool Controller::setPeriod(float seconds)
{
    QPlcNodeRunner &runner = m_node->runner();
    const double given = double(seconds);
    if (!(given >= 1e-5 && given <= 10.0))
        return fail(QStringLiteral("the period in record 3 is %1 s; use 10 us to 10 s").arg(given));
    const double own = double(runner.period().count()) * 1e-9;
    if (identity.period == 0)  // 0.1F is 0.100000001 s
        return runner.setPeriod(std::chrono::nanoseconds(std::llround(given * 1e6) * 1000))
            || fail(runner.errorString());
    if (std::abs(given - own) <= 1e-6 * own)
        return true;
    return fail(QStringLiteral("the period in record 3 is %1 s, and this controller is made for %2 s; set the host to "
                               "that (OpenFAST: DLL_DT)")
                    .arg(given)
                    .arg(own));
}

/// Hosts repeat a call in iterations, and may leave times out.
bool Controller::step(const Call &call)
{
    QPlcNodeRunner &runner = m_node->runner();
    const double period = double(runner.period().count()) * 1e-9;
    if (!std::isfinite(call.record(TimeRecord)))
        return fail(QStringLiteral("the time in record 2 is not a finite number"));
    const double now = std::round((double(call.record(TimeRecord)) - m_start) / period);
    const auto next = double(runner.nextCycle());
    if (now < next - 1.0)
        return fail(QStringLiteral("the time in record 2 is %1 s, and the controller is at %2 s; time must not go back")
                        .arg(double(call.record(TimeRecord)))
                        .arg(m_start + (next - 1.0) * period));
    if (now >= next) {
        if (!readInputs(call))
            return false;
        if (!(now < 1e12) || !runner.skip(quint64(now - next)))
            return fail(QStringLiteral("the time in record 2 is %1 s, which is too late for a controller with a period "
                                       "of %2 s")
                            .arg(double(call.record(TimeRecord)))
                            .arg(period));
        const bool hasComputed = runner.step();
        writeOutputs(call);
        if (!hasComputed)
            return hasEnded(m_node->failure());
        if (runner.wantsSafeStop())
            return fail(m_node->plant() ? m_node->plant()->endReason()
                                        : QStringLiteral("the controller wants a safe stop"));
        return true;
    }
    writeOutputs(call);
    return true;
}

bool Controller::readInputs(const Call &call)
{
    for (const DisconMapping::Entry &entry : m_mapping.inputs()) {
        const double value = double(call.record(entry.record)) * entry.factor;
        if (!m_node->runner().setReal(entry.signal, value, entry.element))
            return fail(QStringLiteral("%1 in record %2 does not fit signal '%3' of type %4")
                            .arg(value)
                            .arg(entry.record)
                            .arg(m_node->signal(entry.signal).name, m_node->signal(entry.signal).type.name()));
    }
    return true;
}

void Controller::writeOutputs(const Call &call) const
{
    for (const DisconMapping::Constant &constant : m_mapping.constants())
        call.records[constant.record - 1] = float(constant.value);
    for (const DisconMapping::Entry &entry : m_mapping.outputs())
        call.records[entry.record - 1] = float(m_node->runner().real(entry.signal, entry.element) * entry.factor);
}

/// As long as the host has room for it.
void tell(const Call &call, const QString &text, char *message)
{
    const int given = call.whole(MessageSizeRecord);
    if (!message || given <= 0)
        return;
    const QByteArray bytes = (QLatin1String(identity.name) + QStringLiteral(": ") + text).toUtf8();
    const std::size_t room = std::min(std::size_t(given), LongestMessage) - 1;
    const std::size_t size = std::min(room, std::size_t(bytes.size()));
    std::memcpy(message, bytes.constData(), size);
    message[size] = '\0';
}

}  // namespace

/// One turbine for each copy of the library, as the interface wants it.
extern "C" __attribute__((visibility("default"))) void DISCON(float *avrSWAP, int *aviFAIL, const char *accINFILE,
                                                              char *, char *avcMSG)
{
    static Controller controller;
    if (!aviFAIL)
        return;
    *aviFAIL = -1;
    if (!avrSWAP)
        return;
    const Call call{avrSWAP, accINFILE};
    const bool isDone = controller.call(call);
    const QString warning = controller.warning();
    *aviFAIL = !isDone ? -1 : warning.isEmpty() ? 0 : 1;
    tell(call, isDone ? warning : controller.text(), *aviFAIL == 0 ? nullptr : avcMSG);
}
