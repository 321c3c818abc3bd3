// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plant/PlantStatus.h"

#include <QtCore/QVector>

namespace qplc {

/// Violations of real time of a plant: cycles that began too late and answers that came too late,
/// since the phase began and in the last 10 s. A value type.
class ViolationWatch
{
public:
    static constexpr qint64 Window = 10'000;  // [ms]

    /// Since the phase began.
    static quint64 totalOf(const PlantStatus &status);

    /// What there was before the first call is not of the last 10 s. \param now [ms] of any clock
    /// that only goes on
    void take(quint64 total, qint64 now);
    quint64 total() const { return m_steps.isEmpty() ? 0 : m_steps.last().total; }
    /// In the last 10 s.
    quint64 recent() const { return m_steps.isEmpty() ? 0 : m_steps.last().total - m_steps.first().total; }
    /// "2 violations in 10 s" while they grow; else what was since the phase began: "17
    /// violations".
    QString text() const;

private:
    struct Step
    {
        qint64 until;  // [ms] until when there were not more
        quint64 total;
    };
    QVector<Step> m_steps;  // growing; the first one is what there was before the window
};

}  // namespace qplc
