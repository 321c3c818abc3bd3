// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>

namespace qplc {

constexpr quint64 fnv1a64Start = 0xcbf29ce484222325u;

/// FNV-1a-64 of \a size bytes; \a hash continues an earlier one.
constexpr quint64 fnv1a64(const char *bytes, int size, quint64 hash = fnv1a64Start)
{
    for (int i = 0; i < size; ++i)
        hash = (hash ^ quint8(bytes[i])) * 0x100000001b3u;
    return hash;
}

inline quint64 fnv1a64(const QByteArray &bytes, quint64 hash = fnv1a64Start)
{
    return fnv1a64(bytes.constData(), bytes.size(), hash);
}

}  // namespace qplc
