// SPDX-License-Identifier: Apache-2.0
#include "CanCycles.h"

#include "CanPartner.h"
#include "hardware/DriverCatalog.h"
#include "realtime/CycleClock.h"

#include <cmath>

namespace {

constexpr int ownChannels = 3;          // before those of the messages
constexpr int inChannels = 3;           // of each message that comes in
constexpr qint64 stampTolerance = 100;  // [us] the stamps of the kernel are of the other clock

}  // namespace

CanCycles::CanCycles(const QString &device, int frames, qint64 period)
    : m_device(device)
    , m_frames(frames)
    , m_period(period)
{
}

QByteArray CanCycles::configurationText(const QString &device, int frames)
{
    QByteArray text = "[bench]\ndriver = can\ndevice = " + device.toUtf8() + "\n";
    const auto add = [&text](const QByteArray &name, quint32 id) {
        text += "frame." + name + " = " + QByteArray::number(id) + ", 8 bytes\nsignal." + name + ".Count = 0|24@1+\n";
    };
    for (int i = 0; i < frames; ++i) {
        add("To" + QByteArray::number(i), CanStamp::ToPartner + quint32(i));
        const QByteArray from = "From" + QByteArray::number(i);
        add(from, CanStamp::FromPartner + quint32(i));
        text += "signal." + from + ".Time = 24|24@1+\nsignal." + from + ".Took = 48|16@1+\n";
    }
    return text;
}

bool CanCycles::makeDriver()
{
    m_configuration = std::make_unique<qplc::HardwareConfiguration>(configurationText(m_device, m_frames), QString());
    if (m_configuration->errors().isEmpty()) {
        m_runner = std::make_unique<qplc::DriverRunner>(
            QStringLiteral("bench"), QStringLiteral("can"),
            qplc::DriverCatalog::instance().kinds().value(QStringLiteral("can")).make());
        m_runner->configure(*m_configuration->settings(m_configuration->drivers().first()));
    }
    m_error = QPlcParseError::toString(m_configuration->errors());
    if (!m_error.isEmpty())
        return false;
    for (const char *name : {"@received", "@lost", "@unsent"})
        m_runner->wire(QString::fromLatin1(name), QPlcChannel::Read, &m_error);
    for (int i = 0; i < m_frames; ++i) {
        for (const char *signal : {"Count", "Time", "Took"})
            m_runner->wire(QStringLiteral("From%1.%2").arg(i).arg(QLatin1String(signal)), QPlcChannel::Read, &m_error);
        m_runner->wire(QStringLiteral("To%1.Count").arg(i), QPlcChannel::Write, &m_error);
    }
    return m_error.isEmpty();
}

bool CanCycles::begin(bool withCan)
{
    m_withCan = withCan;
    m_received = 0.0;
    if (withCan) {
        m_last.assign(std::size_t(m_frames), Seen());
        if (!makeDriver())
            return false;
        if (!m_runner->openNow()) {
            m_error = m_runner->driver().errorString();
            return false;
        }
    }
    m_stop = false;
    m_thread = std::thread([this] { run(); });
    return true;
}

void CanCycles::end()
{
    m_stop = true;
    m_thread.join();
    if (!m_withCan)
        return;
    const qint64 now = qplc::monotonicNow();
    m_runner->read(now);
    m_received = m_runner->sample(0, now).value;
    m_lost += quint64(m_runner->sample(1, now).value);
    m_unsent += quint64(m_runner->sample(2, now).value);
    m_runner->closeNow();
    m_runner.reset();
}

void CanCycles::run()
{
    qplc::CycleClock clock(qplc::TimeSource::monotonic(), m_period);
    clock.start();
    quint32 cycle = 0;
    while (!m_stop.load(std::memory_order_relaxed)) {
        const qplc::CycleClock::Tick tick = clock.next([] { return false; });
        m_lateness[m_withCan].record(tick.lateness);
        m_skipped[m_withCan] += tick.skipped;
        if (m_withCan)
            exchange(tick.woken, ++cycle);
        m_execution[m_withCan].record(qplc::monotonicNow() - tick.woken);
    }
}

void CanCycles::exchange(qint64 now, quint32 cycle)
{
    m_runner->read(now);
    for (std::size_t i = 0; i < m_last.size(); ++i)
        look(i, now);
    for (int i = 0; i < m_frames; ++i)
        m_runner->setValue(i, cycle, false);
    m_runner->write(now);
}

void CanCycles::look(std::size_t message, qint64 now)
{
    const int channel = ownChannels + inChannels * int(message);
    const qplc::DriverRunner::Sample sample = m_runner->sample(channel, now);
    if (!sample.isFresh)
        return;
    const auto valueOf = [&](int which) { return quint32(m_runner->sample(channel + which, now).value); };
    const quint32 count = quint32(sample.value);
    Seen &seen = m_last[message];
    m_wentBack += count < seen.count ? 1 : 0;
    if (count == seen.count)
        return;
    judge(seen, count, valueOf(2));
    // The low bits of a difference are those of the time between.
    const quint32 delay = (quint32(sample.time / 1000) - valueOf(1)) & CanStamp::TimeMask;
    seen = {count, delay <= CanStamp::TimeMask / 2 ? qint64(delay) : qint64(delay) - CanStamp::TimeMask - 1};
    m_age.record(now - sample.time);
}

void CanCycles::judge(const Seen &seen, quint32 count, quint32 took)
{
    if (seen.count == 0 || count != seen.count + 1 || took == CanStamp::LongestTook)
        return;  // the frame that told how long it was is not there
    ++m_judgedAges;
    m_wrongAges += seen.delay < -stampTolerance || seen.delay > took + stampTolerance ? 1 : 0;
}

void CanCycles::addFigures(QJsonObject *fields, const QString &name, const qplc::Histogram &histogram) const
{
    const auto add = [&](const char *figure, double value) {
        fields->insert(name + QLatin1Char('_') + QLatin1String(figure) + QStringLiteral("_us"),
                       std::round(value * 1e-2) / 10.0);
    };
    add("p50", double(histogram.quantile(0.5)));
    add("p99", double(histogram.quantile(0.99)));
    add("p999", double(histogram.quantile(0.999)));
    add("max", double(histogram.maximum()));
}

QJsonObject CanCycles::result() const
{
    QJsonObject fields;
    for (const bool withCan : {false, true}) {
        const QString kind = withCan ? QStringLiteral("with_can") : QStringLiteral("without_can");
        fields.insert(kind + QStringLiteral("_cycles"), double(m_lateness[withCan].count()));
        fields.insert(kind + QStringLiteral("_skipped"), double(m_skipped[withCan]));
        addFigures(&fields, kind + QStringLiteral("_lateness"), m_lateness[withCan]);
        addFigures(&fields, kind + QStringLiteral("_execution"), m_execution[withCan]);
    }
    addFigures(&fields, QStringLiteral("age"), m_age);
    fields.insert(QStringLiteral("reordered_here"), double(m_wentBack));
    fields.insert(QStringLiteral("judged_ages"), double(m_judgedAges));
    fields.insert(QStringLiteral("wrong_ages"), double(m_wrongAges));
    fields.insert(QStringLiteral("queue_overflows"), double(m_lost));
    fields.insert(QStringLiteral("unsent_here"), double(m_unsent));
    return fields;
}
