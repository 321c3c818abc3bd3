// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ModbusLink.h"

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace qplc {

/// A device of this process, `device = fake:NAME`: all bits and registers of all units are there,
/// are 0 at first, and keep what is written. For tests, and for trying a configuration without the
/// device. Threads: any.
class FakeModbusDevice
{
public:
    /// That of a name; it exists as long as somebody keeps it.
    static std::shared_ptr<FakeModbusDevice> named(const QString &name);

    /// \param values  one for each bit or register
    void set(ModbusRegister::Space space, quint16 first, const std::vector<quint16> &values, quint8 unit = 1);
    std::vector<quint16> values(ModbusRegister::Space space, quint16 first, int count, quint8 unit = 1) const;

    /// The way to a device that is not there is gone: it cannot be opened.
    void setPresent(bool isPresent);
    /// From here on the device answers requests that touch this place with an exception; None: it
    /// no longer does.
    void answerWith(ModbusException exception, ModbusRegister::Space space, quint16 address);
    /// From here on this share of all answers is damaged on the way, the same ones in every run.
    /// \param share  0 ... 1 \param unit  whose answers; 0: those of all units
    void damageAnswers(double share, quint8 unit = 0);
    /// As above, but the next answers only, all of them.
    void damageNext(int count, quint8 unit = 0);
    /// How many answers were damaged.
    quint64 damaged() const;
    /// All requests since the last call.
    std::vector<ModbusRequest> takeReads();
    std::vector<ModbusRequest> takeWrites();

private:
    friend class FakeModbusLink;
    using Place = std::pair<quint8, ModbusRegister::Space>;  // unit

    ModbusException exceptionFor(const ModbusRequest &request) const;
    bool isDamaged(const ModbusRequest &request);

    mutable std::mutex m_mutex;
    std::map<Place, std::array<quint16, 0x10000>> m_values;
    bool m_isPresent = true;
    ModbusException m_exception = ModbusException::None;
    ModbusRegister::Space m_exceptionSpace = ModbusRegister::Holding;
    quint16 m_exceptionAddress = 0;
    double m_damagedShare = 0.0;
    quint8 m_damagedUnit = 0;
    int m_damagedNext = 0;
    quint64 m_damaged = 0;
    quint64 m_chance = 1;
    std::vector<ModbusRequest> m_reads;
    std::vector<ModbusRequest> m_writes;
};

/// The way to a device of this process.
class FakeModbusLink final : public ModbusLink
{
public:
    explicit FakeModbusLink(const QString &name)
        : m_device(FakeModbusDevice::named(name))
    {
    }

    bool open() override;
    void close() override {}
    bool read(const ModbusRequest &request, quint16 *values) override;
    bool write(const ModbusRequest &request, const quint16 *values) override;

private:
    bool check(const ModbusRequest &request);
    bool answer(const ModbusRequest &request);

    const std::shared_ptr<FakeModbusDevice> m_device;
};

}  // namespace qplc
