// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plot/CurveSources.h"

namespace qplc {

/// Where a gauge of a window has its values from: a signal of a plant, one element of it, or, behind "=", something calculated of signals (CurveSources). A value type.
///
/// What is calculated is a real number of each cycle; the table knows no limits for it.
class GaugeSource
{
public:
    GaugeSource() = default;
    /// What \a text means at the moment; find again after CurveSources::changed().
    GaugeSource(const QString &text, const PlantList &plants, const CurveSources &formulas, const QString &pin);

    /// Null: nothing is there, and error() may say why.
    Plant *plant() const { return m_plant; }
    const QString &error() const { return m_error; }
    bool isFormula() const { return m_formula.derived != nullptr; }
    /// An empty name when nothing is there.
    const QPlcSignalDefinition &definition() const { return m_definition; }
    /// Null where there is none, or no plant.
    const SignalStore *store() const;
    /// Of a shown element, 0, 1, ..., in store().
    int channel(int element) const;

    /// Invalid before the first. Where no cycles come, a formula is calculated of the newest values that the signals have; one with a past keeps the result of the last cycle.
    QPlcValue newestValue() const;
    /// Whether newestValue() is that of the last cycle where no cycles run.
    bool isOfLastCycle() const;
    /// Of the newest value; what is calculated is as good as the worst value that it is calculated of.
    QPlcQuality newestQuality() const;
    QPlcValue valueAt(SignalStore::Time time) const;

    /// Whether both mean the same, whatever their stores.
    bool isSame(const GaugeSource &other) const;

private:
    Plant *m_plant = nullptr;
    PlantList::Signal m_signal;
    CurveSource m_formula;  // keeps the store
    QPlcSignalDefinition m_definition;
    QString m_error;
};

}  // namespace qplc
