// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plant/PlantList.h"

#include <memory>
#include <optional>

namespace qplc {

class DerivedSignal;
class DerivedSignals;

/// Where a curve comes from: a channel of a store, with what is known of it. A value type.
///
/// The store of a derived signal lives as long as a CurveSource of it: keep the CurveSource as long
/// as its store is drawn.
struct CurveSource
{
    Plant *plant = nullptr;
    SignalStore *store = nullptr;  // null: nothing to show, error says why
    int channel = -1;
    QString title;
    QString unit;
    std::optional<double> minimum;  // limits of the table
    std::optional<double> maximum;
    QPlcValueNames names{};  // of the values; empty: none
    bool isStepped = false;  // integers and booleans hold until the next value
    QString error;
    std::shared_ptr<DerivedSignal> derived;  // what owns the store, if it is not the plant

    explicit operator bool() const { return store != nullptr; }
    /// What people read of an expression: formulas without the "=" in front.
    static QString textOf(const QString &expression);
};

/// Finds what an expression means at the moment: a signal, "kite.elevation",
/// "east/kite.position[2]", or, behind "=", something calculated of signals (Formula): "=
/// mean(power, 5)".
///
/// Derived signals have the same rows as the store of their plant. When one is made, its past is
/// there within some turns of the event loop; then it is updated when its plant is, before plots
/// draw.
///
/// Threads: that of the window.
class CurveSources : public QObject
{
    Q_OBJECT
public:
    explicit CurveSources(PlantList *plants, QObject *parent = nullptr);
    ~CurveSources() override;

    /// What is found is right until changed(), and must not be kept longer: stores come and go with
    /// tables.
    /// \param pin  the plant that signals without a plant are of; empty: the selected one
    CurveSource find(const QString &expression, const QString &pin = QString()) const;

Q_SIGNALS:
    /// Everything has to be found again.
    void changed();
    /// A derived signal has more of its past: frozen views should be drawn again.
    void filled();

private:
    CurveSource findFormula(const QString &expression, const QString &pin) const;
    void follow(Plant *plant);

    PlantList *m_plants;
    std::unique_ptr<DerivedSignals> m_derived;
};

}  // namespace qplc
