// SPDX-License-Identifier: Apache-2.0
#include "BenchSource.h"

#include <cmath>

namespace {

constexpr float twoPi = 6.2831853F;
constexpr float slowest = 300'000.0F;                    // [samples] for a period
constexpr std::uint32_t spikes = 0xFFFFFFFFU / 50'000U;  // one of so many samples
constexpr float spikeHeight = 1.5F;

}  // namespace

BenchSource::BenchSource(qplc::SignalStore *store, double noiseAmplitude)
    : m_store(store)
    , m_noiseAmplitude(float(noiseAmplitude))
    , m_values(std::size_t(store->channels()))
{
    for (int channel = 0; channel < store->channels(); ++channel) {
        const float step = twoPi * (1.0F + 0.5F * float(channel % 4)) / slowest;
        const float phase = 0.7F * float(channel);
        m_oscillators.push_back({std::sin(phase), std::cos(phase), std::sin(step), std::cos(step)});
    }
}

/// -1 ... 1, by a linear congruential generator: the noise may be simple, it has to be quick.
float BenchSource::noise()
{
    m_random = m_random * 1664525U + 1013904223U;
    return float(std::int32_t(m_random)) * 4.656613e-10F;
}

float BenchSource::next(Oscillator *oscillator)
{
    const Oscillator last = *oscillator;
    oscillator->sine = last.sine * last.stepCosine + last.cosine * last.stepSine;
    oscillator->cosine = last.cosine * last.stepCosine - last.sine * last.stepSine;
    const float value = last.sine + m_noiseAmplitude * noise();
    return m_random < spikes ? spikeHeight : value;
}

void BenchSource::append(int rows)
{
    for (int row = 0; row < rows; ++row) {
        for (std::size_t channel = 0; channel < m_values.size(); ++channel)
            m_values[channel] = next(&m_oscillators[channel]);
        m_time += period;
        m_store->append(m_time, m_values.data());
    }
}
