// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QIODevice>

namespace qplc {

/// Reads a file that is to have at most \a largest bytes. One that has more gives a little more of
/// it. In portions: QIODevice::read() makes room for all that it is asked for, before it reads.
inline QByteArray readBounded(QIODevice *device, qint64 largest)
{
    constexpr qint64 portion = 64 << 10;  // [byte]
    QByteArray text;
    for (QByteArray read = device->read(portion); !read.isEmpty(); read = device->read(portion)) {
        text += read;
        if (text.size() > largest)
            break;
    }
    return text;
}

}  // namespace qplc
