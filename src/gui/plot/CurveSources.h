// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plant/PlantList.h"

#include <optional>

namespace qplc {

/// Where a curve comes from: a channel of a store, with what is known of it. A value type.
struct CurveSource
{
    Plant *plant = nullptr;
    SignalStore *store = nullptr;  // null: nothing to show, error says why
    int channel = -1;
    QString title;
    QString unit;
    std::optional<double> minimum;  // limits of the table
    std::optional<double> maximum;
    bool isStepped = false;  // integers and booleans hold until the next value
    QString error;

    explicit operator bool() const { return store != nullptr; }
};

/// Finds what an expression means at the moment: "kite.elevation", "east/kite.position[2]".
///
/// Threads: that of the window.
class CurveSources : public QObject
{
    Q_OBJECT
public:
    explicit CurveSources(PlantList *plants, QObject *parent = nullptr);

    /// What is found is right until changed(), and must not be kept longer: stores come and go with tables.
    CurveSource find(const QString &expression) const;

Q_SIGNALS:
    /// Everything has to be found again.
    void changed();

private:
    void follow(Plant *plant);

    PlantList *m_plants;
};

}  // namespace qplc
