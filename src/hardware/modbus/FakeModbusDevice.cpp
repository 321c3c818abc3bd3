// SPDX-License-Identifier: Apache-2.0
#include "FakeModbusDevice.h"

#include <algorithm>

namespace qplc {

std::shared_ptr<FakeModbusDevice> FakeModbusDevice::named(const QString &name)
{
    static std::mutex mutex;
    static std::map<QString, std::weak_ptr<FakeModbusDevice>> devices;
    const std::lock_guard<std::mutex> lock(mutex);
    std::shared_ptr<FakeModbusDevice> device = devices[name].lock();
    if (!device) {
        device = std::make_shared<FakeModbusDevice>();
        devices[name] = device;
    }
    return device;
}

void FakeModbusDevice::set(ModbusRegister::Space space, quint16 first, const std::vector<quint16> &values, quint8 unit)
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    std::copy(values.begin(), values.end(), m_values[{unit, space}].begin() + first);
}

std::vector<quint16> FakeModbusDevice::values(ModbusRegister::Space space, quint16 first, int count, quint8 unit) const
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    const auto found = m_values.find({unit, space});
    if (found == m_values.end())
        return std::vector<quint16>(std::size_t(count), 0);
    const auto begin = found->second.begin() + first;
    return std::vector<quint16>(begin, begin + count);
}

void FakeModbusDevice::setPresent(bool isPresent)
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_isPresent = isPresent;
}

void FakeModbusDevice::answerWith(ModbusException exception, ModbusRegister::Space space, quint16 address)
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_exception = exception;
    m_exceptionSpace = space;
    m_exceptionAddress = address;
}

void FakeModbusDevice::damageAnswers(double share, quint8 unit)
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_damagedShare = share;
    m_damagedUnit = unit;
}

void FakeModbusDevice::damageNext(int count, quint8 unit)
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_damagedNext = count;
    m_damagedUnit = unit;
}

quint64 FakeModbusDevice::damaged() const
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    return m_damaged;
}

std::vector<ModbusRequest> FakeModbusDevice::takeReads()
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    return std::exchange(m_reads, {});
}

std::vector<ModbusRequest> FakeModbusDevice::takeWrites()
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    return std::exchange(m_writes, {});
}

ModbusException FakeModbusDevice::exceptionFor(const ModbusRequest &request) const
{
    const bool isMeant = request.space == m_exceptionSpace && m_exceptionAddress >= request.first
        && m_exceptionAddress < request.first + request.count;
    return isMeant ? m_exception : ModbusException::None;
}

bool FakeModbusDevice::isDamaged(const ModbusRequest &request)
{
    if (m_damagedUnit != 0 && m_damagedUnit != request.unit)
        return false;
    m_chance = m_chance * 6364136223846793005U + 1442695040888963407U;  // the same numbers in every run
    const double chance = double(m_chance >> 11) * 0x1p-53;
    if (m_damagedNext == 0 && !(chance < m_damagedShare))
        return false;
    m_damagedNext = std::max(m_damagedNext - 1, 0);
    ++m_damaged;
    return true;
}

bool FakeModbusLink::open()
{
    const std::lock_guard<std::mutex> lock(m_device->m_mutex);
    return m_device->m_isPresent || fail(QStringLiteral("there is no device now; the test has taken it away"));
}

bool FakeModbusLink::check(const ModbusRequest &request)
{
    if (!m_device->m_isPresent)
        return fail(QStringLiteral("no answer; the test has taken the device away"));
    const ModbusException exception = m_device->exceptionFor(request);
    return exception == ModbusException::None || fail(exception);
}

bool FakeModbusLink::answer(const ModbusRequest &request)
{
    return !m_device->isDamaged(request) || failAnswer(QStringLiteral("the answer is damaged; the test wants it so"));
}

bool FakeModbusLink::read(const ModbusRequest &request, quint16 *values)
{
    const std::lock_guard<std::mutex> lock(m_device->m_mutex);
    m_device->m_reads.push_back(request);
    if (!check(request))
        return false;
    const auto begin = m_device->m_values[{request.unit, request.space}].begin() + request.first;
    std::copy(begin, begin + request.count, values);
    return answer(request);
}

bool FakeModbusLink::write(const ModbusRequest &request, const quint16 *values)
{
    const std::lock_guard<std::mutex> lock(m_device->m_mutex);
    m_device->m_writes.push_back(request);
    if (!check(request))
        return false;
    std::copy(values, values + request.count,
              m_device->m_values[{request.unit, request.space}].begin() + request.first);
    return answer(request);
}

}  // namespace qplc
