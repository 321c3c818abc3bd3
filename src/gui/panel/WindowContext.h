// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcTimeAxis.h"
#include "Theme.h"
#include "gui/models/EventLogModel.h"
#include "gui/plant/LimitAlarms.h"
#include "gui/plant/PlantList.h"
#include "gui/plot/CurveSources.h"

namespace qplc {

/// What all panels of a window share: plants, events, time, and colours. Panels see it through
/// QPlcPanelContext.
///
/// Threads: that of the window.
class WindowContext : public QObject
{
    Q_OBJECT
public:
    explicit WindowContext(QObject *parent = nullptr);
    ~WindowContext() override;

    PlantList *plants() { return &m_plants; }
    EventLogModel *events() { return &m_events; }
    CurveSources *curveSources() { return &m_curveSources; }
    QPlcTimeAxis *timeAxis() { return &m_timeAxis; }
    /// Names of the plants of signals and formulas, each once. \param pin the plant of those
    /// without one; empty: the selected one
    QStringList plantsOf(const QStringList &expressions, const QString &pin) const;
    const Theme &theme() const { return m_theme; }
    void setTheme(const Theme &theme);

Q_SIGNALS:
    void themeChanged();
    /// There are new values, or old ones are gone; timeAxis() knows the newest time.
    void valuesChanged();

private:
    void follow(Plant *plant);
    void renewNewest();

    PlantList m_plants;
    LimitAlarms m_limitAlarms{&m_plants};
    EventLogModel m_events;
    CurveSources m_curveSources{&m_plants};
    QPlcTimeAxis m_timeAxis;
    Theme m_theme = Theme::byName(Theme::System);
};

}  // namespace qplc
