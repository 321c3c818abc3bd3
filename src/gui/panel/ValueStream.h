// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plant/Plant.h"

#include <QtCore/QPointer>

namespace qplc {

/// Sends values that change quickly to one plant: one command is under way, behind it the newest
/// values wait. What lay between is left out, the last one never: a slow network makes no queue of
/// old values.
class ValueStream : public QObject
{
    Q_OBJECT
public:
    using Values = QHash<QString, QPlcValue>;

    using QObject::QObject;

    /// What was under way to another plant is forgotten.
    void setPlant(Plant *plant);
    void send(const Values &values);
    /// Sends what waits at once, as the last before this stream goes to another plant.
    void flush();
    /// Forgets what waits.
    void clear() { m_waiting.clear(); }

Q_SIGNALS:
    /// The master has refused a value; what waited behind it is forgotten.
    void failed(const QString &sentence);

private:
    void sendWaiting();

    QPointer<Plant> m_plant;
    int m_underWay = 0;  // number of a command
    Values m_waiting;
};

}  // namespace qplc
