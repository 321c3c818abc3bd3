// SPDX-License-Identifier: Apache-2.0
#include "ValueStream.h"

namespace qplc {

void ValueStream::setPlant(Plant *plant)
{
    if (plant == m_plant)
        return;
    if (m_plant)
        m_plant->disconnect(this);
    m_plant = plant;
    m_underWay = 0;
    clear();
    if (!plant)
        return;
    connect(plant, &Plant::commandDone, this, [this](int command) {
        if (command != m_underWay)
            return;
        m_underWay = 0;
        sendWaiting();
    });
    connect(plant, &Plant::commandFailed, this, [this](int command, const QString &sentence) {
        if (command != m_underWay)
            return;
        m_underWay = 0;
        clear();
        Q_EMIT failed(sentence);
    });
    connect(plant, &Plant::stateChanged, this, [this] {
        if (m_plant->isConnected())
            return;
        m_underWay = 0;
        clear();
    });
}

void ValueStream::send(const Values &values)
{
    for (auto value = values.begin(); value != values.end(); ++value)
        m_waiting.insert(value.key(), value.value());
    sendWaiting();
}

void ValueStream::flush()
{
    m_underWay = 0;
    sendWaiting();
}

void ValueStream::sendWaiting()
{
    if (!m_plant || m_underWay != 0 || m_waiting.isEmpty())
        return;
    const Values values = m_waiting;
    clear();
    m_underWay = m_plant->setValues(values);
}

}  // namespace qplc
