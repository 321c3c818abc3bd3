// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/store/SignalStore.h"

#include <vector>

/// A plant that fills a store at 1 kHz: sines of different periods with noise, and now and then a
/// spike of one sample.
class BenchSource
{
public:
    static constexpr qplc::SignalStore::Time period = 1'000'000;  // [ns]

    BenchSource(qplc::SignalStore *store, double noiseAmplitude);
    void append(int rows);

private:
    struct Oscillator
    {
        float sine;
        float cosine;
        float stepSine;  // of the angle of one period
        float stepCosine;
    };

    float noise();
    float next(Oscillator *oscillator);

    qplc::SignalStore *m_store;
    float m_noiseAmplitude;
    std::vector<Oscillator> m_oscillators;
    std::vector<float> m_values;
    qplc::SignalStore::Time m_time = 0;
    std::uint32_t m_random = 1;
};
