// SPDX-License-Identifier: Apache-2.0
#include "Spectrum.h"

#include <kiss_fftr.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace qplc {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double mostOverlap = 0.9;

/// Coefficients of cosines. The flat top is the usual one of five terms.
std::vector<double> windowOf(Spectrum::Window window, std::size_t length)
{
    static const std::vector<double> terms[]
        = {{1.0}, {0.5, -0.5}, {0.21557895, -0.41663158, 0.277263158, -0.083578947, 0.006947368}};
    std::vector<double> weights(length, 0.0);
    for (std::size_t i = 0; i < length; ++i) {
        const double angle = 2.0 * pi * double(i) / double(length);
        const std::vector<double> &cosines = terms[window];
        for (std::size_t k = 0; k < cosines.size(); ++k)
            weights[i] += cosines[k] * std::cos(double(k) * angle);
    }
    return weights;
}

std::size_t powerOfTwoUpTo(double size)
{
    std::size_t power = 1;
    while (double(2 * power) <= size)
        power *= 2;
    return power;
}

}  // namespace

// ---- which samples ----

void EvenRun::add(Time time, double value, bool beginsAnew)
{
    const std::size_t number = m_next++;
    if (!std::isfinite(value)) {
        ++m_missingValues;
        m_run = Run();
        return;
    }
    const Run before = m_run;
    const bool isFirst = before.size == 0;
    if (isFirst || beginsAnew) {
        if (beginsAnew && number > 0)
            ++m_interruptions;
        m_run = {number, 1, time, time};
    } else {
        const double usual = before.size < 2 ? double(time - before.last)
                                             : double(before.last - before.first) / double(before.size - 1);
        if (std::fabs(double(time - before.last) - usual) > Tolerance * usual) {
            ++m_otherDistances;
            m_run = {number - 1, 1, before.last, before.last};  // the distance may be that of what follows
        }
        ++m_run.size;
        m_run.last = time;
    }
    if (m_run.size >= m_longest.size)
        m_longest = m_run;
}

double EvenRun::period() const
{
    return m_longest.size < 2 ? 0.0 : double(m_longest.last - m_longest.first) * 1e-9 / double(m_longest.size - 1);
}

// ---- the transform ----

/// Squares of the lines of samples that a window weighs.
class Spectrum::Transform
{
public:
    Transform(Window window, std::size_t length)
        : m_weights(windowOf(window, length))
        , m_weighted(length)
        , m_lines(length / 2 + 1)
        , m_plan(kiss_fftr_alloc(int(length), 0, nullptr, nullptr), release)
    {
    }

    std::size_t length() const { return m_weights.size(); }
    std::size_t lines() const { return m_lines.size(); }
    double sumOfWeights() const { return std::accumulate(m_weights.begin(), m_weights.end(), 0.0); }
    double sumOfSquares() const
    {
        return std::inner_product(m_weights.begin(), m_weights.end(), m_weights.begin(), 0.0);
    }

    void transform(const float *samples)
    {
        const double mean = std::accumulate(samples, samples + length(), 0.0) / double(length());
        for (std::size_t i = 0; i < length(); ++i)
            m_weighted[i] = kiss_fft_scalar(m_weights[i] * (double(samples[i]) - mean));
        kiss_fftr(m_plan.get(), m_weighted.data(), m_lines.data());
    }

    double square(std::size_t line) const
    {
        const double real = double(m_lines[line].r);
        const double imaginary = double(m_lines[line].i);
        return real * real + imaginary * imaginary;
    }
    /// The first and the last line stand for one frequency, all others for two: +f and -f.
    double sides(std::size_t line) const { return line == 0 || line + 1 == lines() ? 1.0 : 2.0; }

private:
    static void release(kiss_fftr_state *plan) { kiss_fftr_free(plan); }

    std::vector<double> m_weights;
    std::vector<kiss_fft_scalar> m_weighted;
    std::vector<kiss_fft_cpx> m_lines;
    std::unique_ptr<kiss_fftr_state, void (*)(kiss_fftr_state *)> m_plan;
};

std::size_t Spectrum::fastLength(std::size_t size)
{
    const std::size_t half = size / 2;
    std::size_t best = 1;
    for (std::size_t fives = 1; fives <= half; fives *= 5) {
        for (std::size_t threes = fives; threes <= half; threes *= 3) {
            std::size_t twos = threes;
            while (2 * twos <= half)
                twos *= 2;
            best = std::max(best, twos);
        }
    }
    return 2 * best;
}

std::size_t Spectrum::usualLength(std::size_t samples)
{
    return std::max(std::min(powerOfTwoUpTo(double(samples) / 4.5), std::size_t(65536)), LeastSamples);
}

std::size_t Spectrum::usualPictureLength(std::size_t samples)
{
    return std::clamp(powerOfTwoUpTo(2.0 * std::sqrt(double(samples))), LeastSamples, std::size_t(4096));
}

std::size_t Spectrum::Lines::highest() const
{
    if (values.size() < 2)
        return 0;
    return std::size_t(std::max_element(values.begin() + 1, values.end()) - values.begin());
}

Spectrum::Lines Spectrum::amplitudes(const Samples &samples, double period, Window window, const Flag &isUnwanted)
{
    if (samples.size() < LeastSamples || isUnwanted)
        return {};
    const std::size_t length = fastLength(std::min(samples.size(), MostSamples));
    Transform transform(window, length);
    transform.transform(samples.data() + (samples.size() - length));
    const double sum = transform.sumOfWeights();
    Lines lines{1.0 / (double(length) * period), length, 1, {}};
    for (std::size_t line = 0; line < transform.lines() && !isUnwanted; ++line)
        lines.values.push_back(transform.sides(line) * std::sqrt(transform.square(line)) / sum);
    return isUnwanted ? Lines() : lines;
}

namespace {

/// Where segments begin, from the first sample that is used on.
struct Division
{
    std::size_t length;
    std::size_t hop;
    std::size_t segments;
    std::size_t begin;  // first sample
    std::size_t samples() const { return length + (segments - 1) * hop; }
};

/// The newest samples, and no part of a segment.
Division divide(std::size_t samples, std::size_t usual, const Spectrum::Segments &wanted)
{
    const std::size_t size = std::min(samples, Spectrum::MostSamples);
    Division division{};
    division.length = Spectrum::fastLength(std::min(wanted.length != 0 ? wanted.length : usual, size));
    const double share = 1.0 - std::clamp(wanted.overlap, 0.0, mostOverlap);
    division.hop = std::max<std::size_t>(std::size_t(std::llround(share * double(division.length))), 1);
    division.segments = 1 + (size - division.length) / division.hop;
    division.begin = samples - division.samples();
    return division;
}

}  // namespace

Spectrum::Lines Spectrum::densities(const Samples &samples, double period, Window window, Segments segments,
                                    const Flag &isUnwanted)
{
    if (samples.size() < LeastSamples)
        return {};
    const Division division = divide(samples.size(), usualLength(samples.size()), segments);
    Transform transform(window, division.length);
    Lines lines{1.0 / (double(division.length) * period), division.samples(), division.segments, {}};
    lines.values.assign(transform.lines(), 0.0);
    const double scale = period / (transform.sumOfSquares() * double(division.segments));
    for (std::size_t segment = 0; segment < division.segments; ++segment) {
        if (isUnwanted)
            return {};
        transform.transform(samples.data() + division.begin + segment * division.hop);
        for (std::size_t line = 0; line < lines.values.size(); ++line)
            lines.values[line] += scale * transform.sides(line) * transform.square(line);
    }
    return lines;
}

namespace {

/// From a low one of the values, but not more than eight decades, to the highest.
void fitScale(Spectrum::Picture *picture)
{
    constexpr std::size_t lowShare = 20;  // one in so many values is below
    constexpr float mostDecades = 1e-8F;
    std::vector<float> values = picture->values;
    if (values.empty())
        return;
    const auto low = values.begin() + std::ptrdiff_t(values.size() / lowShare);
    std::nth_element(values.begin(), low, values.end());
    picture->highest = *std::max_element(low, values.end());
    picture->lowest = std::max(*low, mostDecades * picture->highest);
}

}  // namespace

Spectrum::Picture Spectrum::picture(const Samples &samples, double period, Window window, Segments segments,
                                    const Flag &isUnwanted)
{
    if (samples.size() < LeastSamples)
        return {};
    const Division division = divide(samples.size(), usualPictureLength(samples.size()), segments);
    const std::size_t ofColumn = (division.segments + MostColumns - 1) / MostColumns;
    Transform transform(window, division.length);
    Picture picture;
    picture.step = 1.0 / (double(division.length) * period);
    picture.samples = division.samples();
    picture.lines = transform.lines();
    picture.columns = division.segments / ofColumn;
    // A column is about the middle of its segments, and as wide as their distance.
    picture.duration = double(ofColumn * division.hop) * period;
    picture.begin = (double(division.begin) + 0.5 * double(division.length) - 0.5 * double(division.hop)) * period;
    picture.values.assign(picture.columns * picture.lines, 0.0F);
    const double scale = period / (transform.sumOfSquares() * double(ofColumn));
    for (std::size_t segment = 0; segment < picture.columns * ofColumn; ++segment) {
        if (isUnwanted)
            return {};
        transform.transform(samples.data() + division.begin + segment * division.hop);
        float *column = picture.values.data() + (segment / ofColumn) * picture.lines;
        for (std::size_t line = 0; line < picture.lines; ++line)
            column[line] += float(scale * transform.sides(line) * transform.square(line));
    }
    fitScale(&picture);
    return picture;
}

}  // namespace qplc
