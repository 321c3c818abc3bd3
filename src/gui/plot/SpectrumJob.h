// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPast.h"
#include "Spectrum.h"

#include <QtCore/QObject>
#include <QtCore/QTimer>

#include <future>
#include <vector>

namespace qplc {

/// Computes the spectra of signals on a thread of its own: it copies the values of one signal after
/// another between events of the window, so that the window goes on.
class SpectrumJob : public QObject
{
    Q_OBJECT
public:
    using Time = QPlcPast::Time;
    enum Kind { Amplitude, Density, Picture };

    struct Wish
    {
        Kind kind = Amplitude;
        Spectrum::Window window = Spectrum::Hann;
        Spectrum::Segments segments;
        Time begin = 0;
        Time end = 0;  // the last time

        bool operator==(const Wish &other) const;
    };
    /// Of one signal.
    struct Result
    {
        QString problem;      // why there is none, for people; empty: there is one
        QString remark;       // what was left out, for people; may be empty
        Time begin = 0;       // of the first value [ns]
        double period = 0.0;  // [s] between two values; 0: there is none
        std::size_t values = 0;
        Spectrum::Lines lines;
        Spectrum::Picture picture;
    };

    explicit SpectrumJob(QObject *parent = nullptr);
    /// Waits until the thread has seen that nobody wants the spectra any more: one transform at
    /// most.
    ~SpectrumJob() override;

    /// Begins; what is in work is given up.
    void begin(const std::vector<QPlcPast> &pasts, const Wish &wish);
    void cancel();
    bool isBusy() const { return m_timer.isActive(); }
    /// Of each past of begin(), when finished.
    const std::vector<Result> &results() const { return m_results; }

Q_SIGNALS:
    void finished();

private:
    void goOn();
    void gather();
    void start();

    QTimer m_timer;
    Wish m_wish;
    std::vector<QPlcPast> m_pasts;
    std::vector<Spectrum::Samples> m_samples;  // gathered so far
    std::vector<Result> m_results;             // the same; when finished: all
    std::future<std::vector<Result>> m_work;
    std::shared_ptr<Spectrum::Flag> m_isUnwanted;
};

}  // namespace qplc
