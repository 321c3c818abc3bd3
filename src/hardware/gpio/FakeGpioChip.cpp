// SPDX-License-Identifier: Apache-2.0
#include "FakeGpioChip.h"

#include <cerrno>

namespace qplc {

namespace {

class FakeGpioLine : public GpioLine
{
public:
    FakeGpioLine(const FakeMemory &memory, std::size_t offset, const GpioLineRequest &request)
        : m_memory(memory)
        , m_byte(memory.at(offset))
        , m_isActiveLow(request.isActiveLow)
    {
        if (request.isOutput)
            drive(request.isOn);
        else
            m_byte.fetch_and(FakeGpioChip::Pulled);
    }

    int value() noexcept override
    {
        if (!isThere())
            return -1;
        const quint8 byte = m_byte.load();
        const quint8 level = byte & (byte & FakeGpioChip::IsOutput ? FakeGpioChip::Driven : FakeGpioChip::Pulled);
        return (level != 0) != m_isActiveLow ? 1 : 0;
    }

    bool setValue(bool isOn) noexcept override
    {
        if (!isThere())
            return false;
        drive(isOn);
        return true;
    }

    int takeEdges(GpioEdge *, int) noexcept override { return 0; }  // levels are sampled

private:
    bool isThere() const noexcept
    {
        const bool is = m_memory.isThere();
        errno = is ? 0 : ENODEV;
        return is;
    }

    void drive(bool isOn) noexcept
    {
        const bool isHigh = isOn != m_isActiveLow;
        const auto driven = quint8(FakeGpioChip::IsOutput | (isHigh ? FakeGpioChip::Driven : 0));
        quint8 byte = m_byte.load();
        while (!m_byte.compare_exchange_weak(byte, quint8((byte & FakeGpioChip::Pulled) | driven)))
            continue;
    }

    const FakeMemory &m_memory;
    std::atomic<quint8> &m_byte;
    const bool m_isActiveLow;
};

}  // namespace

std::unique_ptr<FakeGpioChip> FakeGpioChip::open(const QString &device, QString *error)
{
    auto chip = std::make_unique<FakeGpioChip>();
    chip->m_device = device;
    return chip->m_memory.open(device, 0, error) ? std::move(chip) : nullptr;
}

bool FakeGpioChip::isFree(const QString &line, QString *error)
{
    bool isNumber = false;
    const uint offset = line.toUInt(&isNumber);
    if (isNumber && offset < m_memory.size())
        return true;
    *error = noSuchLine(m_device, line, m_memory.size());
    return false;
}

std::unique_ptr<GpioLine> FakeGpioChip::request(const GpioLineRequest &request, QString *error)
{
    if (!isFree(request.line, error))
        return nullptr;
    return std::make_unique<FakeGpioLine>(m_memory, request.line.toUInt(), request);
}

}  // namespace qplc
