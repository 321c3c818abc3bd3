// SPDX-License-Identifier: Apache-2.0
#include "CanCycles.h"

#include "CanPartner.h"
#include "hardware/DriverCatalog.h"
#include "realtime/CycleClock.h"

#include <cmath>

namespace {

constexpr int ownChannels = 3;           // before those of the messages
constexpr qint64 stampTolerance = 1000;  // [us] that a frame may need from its making to the bus, besides a period

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
        text += "frame." + name + " = " + QByteArray::number(id) + ", 8 bytes\nsignal." + name
            + ".Count = 0|32@1+\nsignal." + name + ".Time = 32|32@1+\n";
    };
    for (int i = 0; i < frames; ++i) {
        add("To" + QByteArray::number(i), CanStamp::ToPartner + quint32(i));
        add("From" + QByteArray::number(i), CanStamp::FromPartner + quint32(i));
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
        for (const QString &signal : {QStringLiteral("Count"), QStringLiteral("Time")}) {
            m_runner->wire(QStringLiteral("From%1.%2").arg(i).arg(signal), QPlcChannel::Read, &m_error);
            m_runner->wire(QStringLiteral("To%1.%2").arg(i).arg(signal), QPlcChannel::Write, &m_error);
        }
    }
    return m_error.isEmpty();
}

bool CanCycles::begin(bool withCan)
{
    m_withCan = withCan;
    m_received = 0.0;
    if (withCan) {
        m_last.assign(std::size_t(m_frames), 0);
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
    for (int i = 0; i < m_frames; ++i) {
        m_runner->setValue(2 * i, cycle, false);
        m_runner->setValue(2 * i + 1, double(quint32(now / 1000)), false);
    }
    m_runner->write(now);
}

void CanCycles::look(std::size_t message, qint64 now)
{
    const int channel = ownChannels + 2 * int(message);
    const qplc::DriverRunner::Sample count = m_runner->sample(channel, now);
    if (!count.isFresh)
        return;
    m_wentBack += quint32(count.value) < m_last[message] ? 1 : 0;
    if (quint32(count.value) != m_last[message]) {
        const auto made = quint32(m_runner->sample(channel + 1, now).value);
        const auto delay = qint32(quint32(count.time / 1000) - made);  // [us]
        m_wrongAges += delay < 0 || delay > stampTolerance + m_period / 1000 || count.time > now + 1'000'000 ? 1 : 0;
        m_age.record(now - count.time);
    }
    m_last[message] = quint32(count.value);
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
    fields.insert(QStringLiteral("wrong_ages"), double(m_wrongAges));
    fields.insert(QStringLiteral("queue_overflows"), double(m_lost));
    fields.insert(QStringLiteral("unsent_here"), double(m_unsent));
    return fields;
}
