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
        , m_pull(request.pull)
    {
        if (request.isOutput)
            drive(request.isOn);
        else
            m_byte.fetch_and(Outside);
    }

    int value() noexcept override
    {
        if (!isThere())
            return -1;
        return isHigh(m_byte.load()) != m_isActiveLow ? 1 : 0;
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
    static constexpr quint8 Outside = FakeGpioChip::Pulled | FakeGpioChip::IsTorn;

    bool isHigh(quint8 byte) noexcept
    {
        if (byte & FakeGpioChip::IsOutput)
            return byte & FakeGpioChip::Driven;
        if (!(byte & FakeGpioChip::IsTorn))
            return byte & FakeGpioChip::Pulled;
        const bool hasPull = m_pull == GpioLineRequest::PullUp || m_pull == GpioLineRequest::PullDown;
        m_noise = !m_noise;
        return hasPull ? m_pull == GpioLineRequest::PullUp : m_noise;
    }

    bool isThere() const noexcept
    {
        const bool is = m_memory.isThere();
        errno = is ? 0 : ENODEV;
        return is;
    }

    void drive(bool isOn) noexcept
    {
        const bool isUp = isOn != m_isActiveLow;
        const auto driven = quint8(FakeGpioChip::IsOutput | (isUp ? FakeGpioChip::Driven : 0));
        quint8 byte = m_byte.load();
        while (!m_byte.compare_exchange_weak(byte, quint8((byte & Outside) | driven)))
            continue;
    }

    const FakeMemory &m_memory;
    std::atomic<quint8> &m_byte;
    const bool m_isActiveLow;
    const GpioLineRequest::Pull m_pull;
    bool m_noise = true;  // of a line that floats
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
