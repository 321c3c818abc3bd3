// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcHardwareGlobal.h"
#include "QPlcSlaveNode.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

/// What has happened at a device, for people and the event log of the plant: a drive tells an
/// emergency, and later that it is over. A driver makes it in QPlcDriver::describeEvent().
///
/// \code
/// QPlcHardwareNode node("Winch");
/// QObject::connect(&node, &QPlcHardwareNode::deviceEvent, &node,
///                  [](const QPlcDeviceEvent &event) { qInfo("%s", qPrintable(event.text)); });
/// \endcode
///
/// \threadsafe a value type: each thread may use its own copy
/// \ingroup hardware
struct QPlcDeviceEvent
{
    /// Name of the section of the device; the node sets it.
    QString driver;
    /// How much the event matters.
    QPlcSlaveNode::EventSeverity severity = QPlcSlaveNode::InfoEvent;
    /// A sentence for people: device, what has happened, and the numbers that its manual explains.
    QString text;
    /// Name of the condition that begins or ends; empty: the event is over at once.
    QString alarm;
    /// With an alarm: true: it begins, or has another text; false: it is over.
    bool isActive = false;
    /// What the driver has noted (QPlcDriver::noteEvent()). Of the driver canopen these are the 8
    /// bytes of the emergency message, the first one as the lowest: the error code in the bits 0 to
    /// 15, the error register in 16 to 23, the bytes of the manufacturer above.
    quint64 data = 0;
};

Q_DECLARE_METATYPE(QPlcDeviceEvent)
