// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QtGlobal>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace fuzz {

/// Reads an input from its begin to its end; behind the end everything is 0 and empty.
class Input
{
public:
    Input(const std::uint8_t *data, std::size_t size)
        : m_data(reinterpret_cast<const char *>(data))
        , m_left(size)
    {
    }

    bool atEnd() const { return m_left == 0; }
    /// A little-endian number.
    template<typename T>
    T number()
    {
        T value = 0;
        const std::size_t size = std::min(sizeof value, m_left);
        if (size > 0)
            std::memcpy(&value, m_data, size);
        skip(size);
        return value;
    }
    /// The next \a size bytes, or what there is, in memory of their own: a look behind them is seen
    /// by the sanitizer.
    QByteArray bytes(std::size_t size)
    {
        size = std::min(size, m_left);
        const QByteArray result(m_data, int(size));
        skip(size);
        return result;
    }

private:
    void skip(std::size_t size)
    {
        m_data += size;
        m_left -= size;
    }

    const char *m_data;
    std::size_t m_left;
};

/// What must hold for every input. A plain assert() would be gone with NDEBUG.
inline void check(bool holds, const char *sentence)
{
    if (!holds)
        qFatal("%s", sentence);
}

}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);
