// SPDX-License-Identifier: Apache-2.0
#include "WindowContext.h"

namespace qplc {

WindowContext::WindowContext(QObject *parent)
    : QObject(parent)
{
    connect(&m_plants, &PlantList::eventOccurred, &m_events, &EventLogModel::append);
    connect(&m_limitAlarms, &LimitAlarms::eventOccurred, &m_events, &EventLogModel::append);
    connect(&m_plants, &PlantList::added, this, &WindowContext::follow);
}

WindowContext::~WindowContext() = default;

void WindowContext::setTheme(const Theme &theme)
{
    m_theme = theme;
    Q_EMIT themeChanged();
}

void WindowContext::follow(Plant *plant)
{
    connect(plant, &Plant::updated, this, [this, plant] {
        const SignalStore *store = plant->store();
        if (store && !store->isEmpty())
            m_timeView.setNewest(store->time(store->endRow() - 1));
    });
}

}  // namespace qplc
