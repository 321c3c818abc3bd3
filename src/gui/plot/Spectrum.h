// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace qplc {

/// The longest run of samples that a spectrum can be of: one distance in time, no gap, no missing
/// value.
///
/// Samples come one after another, oldest first. Of runs of the same length the newest one counts.
class EvenRun
{
public:
    using Time = std::int64_t;  // [ns]
    /// Distances in time that differ by so much of the first one are still one distance.
    static constexpr double Tolerance = 0.05;

    /// \param value  NaN: there is none \param beginsAnew  it follows an interruption
    void add(Time time, double value, bool beginsAnew);

    /// Number of samples added.
    std::size_t samples() const { return m_next; }
    /// Of the longest run: number of its first sample, and how many it has.
    std::size_t begin() const { return m_longest.begin; }
    std::size_t size() const { return m_longest.size; }
    /// Mean distance in time of the longest run [s]; 0: it has less than two samples.
    double period() const;

    /// Why there are several runs: how often each was seen.
    std::size_t interruptions() const { return m_interruptions; }
    std::size_t missingValues() const { return m_missingValues; }
    std::size_t otherDistances() const { return m_otherDistances; }

private:
    struct Run
    {
        std::size_t begin = 0;
        std::size_t size = 0;
        Time first = 0;
        Time last = 0;
    };

    Run m_run;  // that the newest sample belongs to
    Run m_longest;
    std::size_t m_next = 0;
    std::size_t m_interruptions = 0;
    std::size_t m_missingValues = 0;
    std::size_t m_otherDistances = 0;
};

/// What a discrete Fourier transform tells of evenly spaced samples. The unit of the samples is
/// [u] below.
///
/// The mean is taken off first: of all samples for amplitudes(), of each segment for the others.
/// Line k has the frequency k * step.
///
/// Functions end early, with an empty result, when \a isUnwanted becomes true: another thread may
/// set it.
///
/// \threadsafe all functions are pure
class Spectrum
{
public:
    enum Window {
        Rectangular,  ///< exact for whole periods, else it leaks
        Hann,         ///< the usual one
        FlatTop       ///< amplitudes are right also between two lines (0.1 %), lines are broad
    };
    using Samples = std::vector<float>;
    using Flag = std::atomic<bool>;

    static constexpr std::size_t LeastSamples = 16;
    static constexpr std::size_t MostSamples = std::size_t(1) << 20;
    static constexpr std::size_t MostColumns = 4096;

    struct Lines
    {
        double step = 0.0;            // [Hz] between two lines; 0: there are none
        std::size_t samples = 0;      // that were used: the newest ones
        std::size_t segments = 0;     // whose mean it is
        std::vector<double> values;   // [u] or [u^2/Hz]
        std::size_t highest() const;  // line, but for the first; 0: there is none
    };
    /// Of a spectrogram: densities of pieces of time.
    struct Picture
    {
        double step = 0.0;      // [Hz]
        double begin = 0.0;     // [s] of the first column since the first sample
        double duration = 0.0;  // [s] of a column
        std::size_t samples = 0;
        std::size_t lines = 0;  // of a column
        std::size_t columns = 0;
        std::vector<float> values;  // [u^2/Hz], column after column
        float lowest = 0.0F;        // of a scale that shows it well
        float highest = 0.0F;
        float at(std::size_t column, std::size_t line) const { return values[column * lines + line]; }
    };
    /// Segments of Welch's method.
    struct Segments
    {
        std::size_t length = 0;  // samples, even, fastLength(); 0: usual
        double overlap = 0.5;    // share, 0 to 0.9
    };

    /// A sine of the amplitude a has the height a in a line of its frequency [u].
    static Lines amplitudes(const Samples &samples, double period, Window window, const Flag &isUnwanted);
    /// One-sided power spectral density [u^2/Hz], mean of segments (Welch). Its integral over the
    /// frequency is the mean square of the samples without their mean.
    static Lines densities(const Samples &samples, double period, Window window, Segments segments,
                           const Flag &isUnwanted);
    /// The same for each piece of time, at most MostColumns of them.
    static Picture picture(const Samples &samples, double period, Window window, Segments segments,
                           const Flag &isUnwanted);

    /// The greatest length up to \a size whose transform is quick: even, of the factors 2, 3 and 5.
    /// \pre size >= 2
    static std::size_t fastLength(std::size_t size);
    /// Lengths of segments if none is chosen: about eight segments; of pictures, about as many
    /// columns as lines.
    static std::size_t usualLength(std::size_t samples);
    static std::size_t usualPictureLength(std::size_t samples);

private:
    class Transform;
};

}  // namespace qplc
