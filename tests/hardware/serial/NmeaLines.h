// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hardware/serial/NmeaSentence.h"

/// A sentence with its checksum and end, as it comes from a line.
inline QByteArray nmeaLine(const QByteArray &body)
{
    return '$' + body + '*'
        + QByteArray::number(qplc::NmeaSentence::checksum(body.constData(), body.size()), 16).rightJustified(2, '0')
        + "\r\n";
}
