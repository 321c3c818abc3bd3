// SPDX-License-Identifier: Apache-2.0
#include "PlotBench.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QFile>
#include <QtWidgets/QGridLayout>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <thread>
#include <unistd.h>

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin)
{
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

double processorTime()
{
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
}

/// Of this process [bytes]
double residentMemory()
{
    QFile file(QStringLiteral("/proc/self/statm"));
    if (!file.open(QIODevice::ReadOnly))
        return 0.0;
    return file.readAll().split(' ').value(1).toDouble() * double(::sysconf(_SC_PAGESIZE));
}

double percentile(std::vector<double> values, double share)
{
    if (values.empty())
        return 0.0;
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() - 1, std::size_t(share * double(values.size())))];
}

/// Smallest and largest value of 6000 rows, all over the store [s]
double rangeTime(const qplc::SignalStore &store)
{
    constexpr qplc::SignalStore::Row rows = 6000;
    double sum = 0.0;  // so that nothing is left out
    int count = 0;
    const auto begin = Clock::now();
    for (int channel = 0; channel < store.channels(); ++channel) {
        for (auto row = store.firstRow(); row + rows <= store.endRow(); row += rows + 1000, ++count)
            sum += double(store.range(channel, row, row + rows).maximum);
    }
    const double time = secondsSince(begin);
    return count > 0 && std::isfinite(sum) ? time / count : 0.0;
}

}  // namespace

PlotBench::PlotBench(const PlotBenchOptions &options)
    : m_options(options)
    , m_residentBefore(residentMemory())
    , m_store(options.channels, options.rows())
    , m_source(&m_store, options.noise)
{
    const auto begin = Clock::now();
    m_source.append(options.rows());
    m_appendTime = secondsSince(begin) / double(options.rows()) / options.channels;
    m_residentOfStore = residentMemory() - m_residentBefore;
    layOut();
}

/// The plots in two columns on the screen of a laptop.
void PlotBench::layOut()
{
    auto *grid = new QGridLayout(&m_window);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setSpacing(0);
    grid->setSizeConstraint(QLayout::SetNoConstraint);
    for (int i = 0; i < m_options.plots; ++i) {
        m_plots.push_back(new BenchPlot(m_store, i * m_options.curves, m_options));
        m_plots.back()->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);
        m_plots.back()->setMinimumSize(1, 1);
        grid->addWidget(m_plots.back(), i / 2, i % 2);
    }
    m_window.resize(1366, 768);
    m_window.show();
    for (int i = 0; i < 10; ++i)  // sizes of axes settle
        drawFrame();
    m_drawnPlots = 0;
}

void PlotBench::drawFrame()
{
    for (BenchPlot *plot : m_plots)
        m_drawnPlots += plot->showNewest() ? 1 : 0;
    QCoreApplication::processEvents();
}

void PlotBench::run()
{
    const auto frames = std::max(1, int(std::lround(m_options.seconds * m_options.fps)));
    const auto rows = int(1'000'000'000 / BenchSource::period / m_options.fps);
    const auto period = std::chrono::nanoseconds(1'000'000'000 / m_options.fps);
    m_frames.reserve(std::size_t(frames));
    auto next = Clock::now();
    const double before = processorTime();
    for (int frame = 0; frame < frames; ++frame) {
        std::this_thread::sleep_until(next += period);
        const auto begin = Clock::now();
        m_source.append(rows);
        drawFrame();
        m_frames.push_back(secondsSince(begin));
    }
    m_processorTime = processorTime() - before;
}

QJsonObject PlotBench::result() const
{
    const double frames = double(m_frames.size());
    const double samples = double(m_options.channels) * m_options.rows();
    const BenchPlot &plot = *m_plots.front();
    return {{QStringLiteral("plots"), m_options.plots},
            {QStringLiteral("curves"), m_options.curves},
            {QStringLiteral("points"), m_options.points},
            {QStringLiteral("channels"), m_options.channels},
            {QStringLiteral("fps"), m_options.fps},
            {QStringLiteral("line_width"), m_options.lineWidth},
            {QStringLiteral("noise"), m_options.noise},
            {QStringLiteral("mode"),
             m_options.drawsEveryFrame ? QStringLiteral("every-frame") : QStringLiteral("new-column")},
            {QStringLiteral("columns"), int(std::lround(plot.canvas()->width() * plot.devicePixelRatioF()))},
            {QStringLiteral("frames"), frames},
            {QStringLiteral("drawn_plots"), m_drawnPlots},
            {QStringLiteral("cpu_percent"), 100.0 * m_processorTime * m_options.fps / frames},
            {QStringLiteral("frame_p50_ms"), 1e3 * percentile(m_frames, 0.5)},
            {QStringLiteral("frame_p99_ms"), 1e3 * percentile(m_frames, 0.99)},
            {QStringLiteral("append_ns"), 1e9 * m_appendTime},
            {QStringLiteral("range_ns"), 1e9 * rangeTime(m_store)},
            {QStringLiteral("bytes_per_sample"), double(m_store.memory()) / samples},
            {QStringLiteral("store_mb"), 1e-6 * m_residentOfStore},
            {QStringLiteral("resident_mb"), 1e-6 * residentMemory()}};
}

bool PlotBench::savePicture()
{
    return m_window.grab().save(m_options.picture);
}
