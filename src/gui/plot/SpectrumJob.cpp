// SPDX-License-Identifier: Apache-2.0
#include "SpectrumJob.h"

#include <QtCore/QLocale>
#include <QtCore/QStringList>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr int pollPeriod = 5;  // [ms]

QString secondsText(double seconds)
{
    return SpectrumJob::tr("%1 s").arg(seconds, 0, 'g', 4);
}

QString countText(std::size_t count, const QString &one, const QString &many)
{
    return count == 1 ? one : many.arg(count);
}

/// Why the values are no whole piece.
QString reasonsOf(const EvenRun &run)
{
    QStringList reasons;
    if (run.interruptions() > 0)
        reasons << countText(run.interruptions(), SpectrumJob::tr("1 gap"), SpectrumJob::tr("%1 gaps"));
    if (run.missingValues() > 0)
        reasons << countText(run.missingValues(), SpectrumJob::tr("1 value missing"),
                             SpectrumJob::tr("%1 values missing"));
    if (run.otherDistances() > 0)
        reasons << countText(run.otherDistances(), SpectrumJob::tr("1 change of the cycle"),
                             SpectrumJob::tr("%1 changes of the cycle"));
    return reasons.join(QStringLiteral(", "));
}

struct PieceRows
{
    QPlcPast::Row begin;
    QPlcPast::Row end;
    bool areCut;  // there are more of them before
};

PieceRows pieceRowsOf(const QPlcPast &past, const SpectrumJob::Wish &wish)
{
    PieceRows rows{past.rowAt(wish.begin), past.rowAt(wish.end + 1), false};
    rows.end = std::max(rows.begin, rows.end);
    rows.areCut = rows.end - rows.begin > Spectrum::MostSamples;
    if (rows.areCut)
        rows.begin = rows.end - Spectrum::MostSamples;
    return rows;
}

/// Values that another one stands in for count as missing.
EvenRun runOf(const QPlcPast &past, const PieceRows &rows)
{
    const bool haveSubstitutes = past.quality(rows.begin, rows.end) >= QPlcQuality::Safe;
    EvenRun run;
    for (QPlcPast::Row row = rows.begin; row < rows.end; ++row) {
        const bool isSubstitute = haveSubstitutes && past.quality(row, row + 1) >= QPlcQuality::Safe;
        run.add(past.time(row), isSubstitute ? std::nan("") : past.value(row), past.beginsAnew(row));
    }
    return run;
}

QString remarkOf(const EvenRun &run, const PieceRows &rows, const SpectrumJob::Wish &wish)
{
    QStringList remarks;
    const double used = double(run.size()) * run.period();
    const double wished = double(wish.end - wish.begin) * 1e-9;
    constexpr double nearlyAll = 0.98;
    if (run.size() < run.samples())
        remarks << SpectrumJob::tr("the longest whole piece of %1: %2").arg(secondsText(wished), reasonsOf(run));
    else if (rows.areCut)
        remarks << SpectrumJob::tr("the newest %1 cycles of %2")
                       .arg(QLocale().toString(qulonglong(Spectrum::MostSamples)), secondsText(wished));
    else if (used < nearlyAll * wished)
        remarks << SpectrumJob::tr("of %1, of which the window has no more").arg(secondsText(wished));
    return remarks.join(QStringLiteral("; "));
}

/// The values of the longest whole piece; none if there is a problem.
Spectrum::Samples gatherFrom(const QPlcPast &past, const SpectrumJob::Wish &wish, SpectrumJob::Result *result)
{
    if (!past) {
        result->problem = past.problem;
        return {};
    }
    if (past.isOverview()) {
        result->problem = SpectrumJob::tr("%1: the window has only an overview of this time. Remedy: show less of it, "
                                          "and place the cursors there.")
                              .arg(past.text());
        return {};
    }
    const PieceRows rows = pieceRowsOf(past, wish);
    const EvenRun run = runOf(past, rows);
    if (run.size() < Spectrum::LeastSamples) {
        const QString reasons = reasonsOf(run);
        result->problem
            = SpectrumJob::tr("%1 has %2 evenly spaced values in %3%4; a spectrum needs %5.")
                  .arg(past.text(), QString::number(run.size()), secondsText(double(wish.end - wish.begin) * 1e-9),
                       reasons.isEmpty() ? QString() : QStringLiteral(" (%1)").arg(reasons),
                       QString::number(Spectrum::LeastSamples));
        return {};
    }
    Spectrum::Samples samples;
    samples.reserve(run.size());
    const QPlcPast::Row begin = rows.begin + run.begin();
    for (QPlcPast::Row row = begin; row < begin + run.size(); ++row)
        samples.push_back(float(past.value(row)));
    result->begin = past.time(begin);
    result->period = run.period();
    result->values = run.size();
    result->remark = remarkOf(run, rows, wish);
    return samples;
}

void compute(const SpectrumJob::Wish &wish, const Spectrum::Samples &samples, const Spectrum::Flag &isUnwanted,
             SpectrumJob::Result *result)
{
    if (samples.empty())
        return;
    if (wish.kind == SpectrumJob::Amplitude)
        result->lines = Spectrum::amplitudes(samples, result->period, wish.window, isUnwanted);
    else if (wish.kind == SpectrumJob::Density)
        result->lines = Spectrum::densities(samples, result->period, wish.window, wish.segments, isUnwanted);
    else
        result->picture = Spectrum::picture(samples, result->period, wish.window, wish.segments, isUnwanted);
}

}  // namespace

bool SpectrumJob::Wish::operator==(const Wish &other) const
{
    return kind == other.kind && window == other.window && segments.length == other.segments.length
        && segments.overlap == other.segments.overlap && begin == other.begin && end == other.end;
}

SpectrumJob::SpectrumJob(QObject *parent)
    : QObject(parent)
{
    connect(&m_timer, &QTimer::timeout, this, &SpectrumJob::goOn);
}

SpectrumJob::~SpectrumJob()
{
    cancel();
}

void SpectrumJob::begin(const std::vector<QPlcPast> &pasts, const Wish &wish)
{
    cancel();
    m_wish = wish;
    m_pasts = pasts;
    m_timer.start(0);
}

/// The future waits for its thread, which looks at the flag.
void SpectrumJob::cancel()
{
    m_timer.stop();
    if (m_isUnwanted)
        *m_isUnwanted = true;
    m_work = {};
    m_isUnwanted.reset();
    m_pasts.clear();
    m_samples.clear();
    m_results.clear();
}

void SpectrumJob::goOn()
{
    if (m_work.valid()) {
        if (m_work.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
            return;
        m_timer.stop();
        m_results = m_work.get();
        m_isUnwanted.reset();
        Q_EMIT finished();
    } else if (m_samples.size() < m_pasts.size()) {
        gather();
    } else {
        start();
    }
}

void SpectrumJob::gather()
{
    Result result;
    m_samples.push_back(gatherFrom(m_pasts[m_samples.size()], m_wish, &result));
    m_results.push_back(std::move(result));
}

void SpectrumJob::start()
{
    m_pasts.clear();
    m_isUnwanted = std::make_shared<Spectrum::Flag>(false);
    const auto work = [wish = m_wish, isUnwanted = m_isUnwanted](std::vector<Result> results,
                                                                 const std::vector<Spectrum::Samples> &samples) {
        for (std::size_t i = 0; i < results.size() && !*isUnwanted; ++i)
            compute(wish, samples[i], *isUnwanted, &results[i]);
        return results;
    };
    m_work = std::async(std::launch::async, work, std::move(m_results), std::move(m_samples));
    m_results.clear();
    m_samples.clear();
    m_timer.start(pollPeriod);
}

}  // namespace qplc
