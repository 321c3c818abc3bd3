// SPDX-License-Identifier: Apache-2.0
#include "QPlcChannel.h"

#include "QPlcDriver.h"
#include "QPlcReadChannel.h"
#include "QPlcWriteChannel.h"

#include <algorithm>

QPlcChannel::QPlcChannel(QPlcDriver *driver, const QString &name, Direction direction)
    : m_driver(driver)
    , m_name(name)
    , m_direction(direction)
{
    m_driver->m_channels.push_back(this);
}

QPlcChannel::~QPlcChannel()
{
    std::vector<QPlcChannel *> &channels = m_driver->m_channels;
    channels.erase(std::remove(channels.begin(), channels.end(), this), channels.end());
}

QPlcReadChannel::QPlcReadChannel(QPlcDriver *driver, const QString &name)
    : QPlcChannel(driver, name, Read)
{
}

void QPlcReadChannel::set(double value)
{
    set(value, m_driver->m_now);
}

QPlcWriteChannel::QPlcWriteChannel(QPlcDriver *driver, const QString &name)
    : QPlcChannel(driver, name, Write)
{
}
