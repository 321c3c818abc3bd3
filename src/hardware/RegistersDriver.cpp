// SPDX-License-Identifier: Apache-2.0
#include "RegistersDriver.h"

#include "QPlcDriverSettings.h"
#include "signals/MessageText.h"

#include <algorithm>
#include <cerrno>

namespace qplc {

// ---- keys ----

void RegistersDriver::configure(QPlcDriverSettings &settings)
{
    const QStringList numbers{QStringLiteral("8 bits"), QStringLiteral("16 bits")};
    m_numbers = settings.choice(QStringLiteral("register-numbers"), numbers) == 1 ? RegisterBus::SixteenBits
                                                                                  : RegisterBus::EightBits;
    configureBus(settings);
    m_device.configure(settings);
    m_isBurst = settings.truth(QStringLiteral("burst"), false);
    configureBytes(settings, QStringLiteral("identity"), &m_identity);
    configureBytes(settings, QStringLiteral("setup"), &m_setUp);
    const QString prefix = QStringLiteral("register.");
    const QStringList names = settings.namesBehind(prefix);
    for (const QString &name : names) {
        DeviceRegister reg;
        const QString error
            = DeviceRegister::read(settings.list(prefix + name), &reg, RegisterBus::lastRegister(m_numbers));
        if (!error.isEmpty())
            settings.addError(prefix + name, error);
        else if (reg.isWritten)
            addOutput(settings, prefix + name, name, reg);
        else
            m_inputs.push_back(std::make_unique<Input>(this, name, reg));
    }
    if (names.isEmpty())
        settings.addError(QString(),
                          QStringLiteral("no register of the device is used; say 'register.NAME = 0x3b, int16'"));
}

void RegistersDriver::addOutput(QPlcDriverSettings &settings, const QString &key, const QString &name,
                                const DeviceRegister &reg)
{
    for (const auto &other : m_outputs) {
        if (reg.overlaps(other->reg))
            settings.addError(key,
                              QStringLiteral("%1 and %2 write the same register; write one of them")
                                  .arg(quoted(name), quoted(other->channel.name())));
    }
    m_outputs.push_back(std::make_unique<Output>(this, name, reg));
    const RawNumber::Limits limits = reg.limits();
    m_outputs.back()->channel.setRange(limits.lowest, limits.highest);
}

QString RegistersDriver::readBytes(const QStringList &words, std::vector<ByteValue> *result) const
{
    for (const QString &word : words) {
        const QStringList parts = word.simplified().split(QLatin1Char(' '));
        bool isRegister = false;
        bool isValue = false;
        const uint reg = parts.value(0).toUInt(&isRegister, 0);
        const uint value = parts.value(1).toUInt(&isValue, 0);
        if (parts.size() != 2 || !isRegister || !isValue || reg > uint(RegisterBus::lastRegister(m_numbers))
            || value > 0xff)
            return QStringLiteral("%1 is not a register with its value; write '0x6b 0x00', with commas between several")
                .arg(quoted(word));
        result->push_back({int(reg), quint8(value)});
    }
    return QString();
}

void RegistersDriver::configureBytes(QPlcDriverSettings &settings, const QString &key, std::vector<ByteValue> *result)
{
    const QString error = readBytes(settings.list(key), result);
    if (!error.isEmpty())
        settings.addError(key, error);
}

// ---- the device ----

bool RegistersDriver::open()
{
    QString error;
    if (!m_device.open(openBus(&error)))
        return fail(error);
    if (!checkIdentity())
        return false;
    for (const ByteValue &order : m_setUp) {
        if (!m_device.write(order.reg, &order.value, 1))
            return failAt(order.reg, QStringLiteral("write"));
    }
    planBursts();
    return true;
}

bool RegistersDriver::checkIdentity()
{
    for (const ByteValue &wanted : m_identity) {
        quint8 found = 0;
        if (!m_device.read(wanted.reg, &found, 1))
            return failAt(wanted.reg, QStringLiteral("read"));
        if (found == wanted.value)
            continue;
        m_device.reject();
        return fail(QStringLiteral("register %1 of %2 is %3, and not %4 as 'identity' requires; this is another "
                                   "device: %5")
                        .arg(RegisterBus::byteText(wanted.reg), place(), RegisterBus::byteText(found),
                             RegisterBus::byteText(wanted.value), remedyOfIdentity()));
    }
    return true;
}

/// Neighbours among the wired inputs become one transaction, if the device counts up by itself.
void RegistersDriver::planBursts()
{
    std::vector<Input *> wired;
    for (const auto &input : m_inputs) {
        if (input->channel.isWired())
            wired.push_back(input.get());
    }
    std::stable_sort(wired.begin(), wired.end(),
                     [](const Input *a, const Input *b) { return a->reg.first < b->reg.first; });
    m_bursts.clear();
    for (Input *input : wired) {
        const DeviceRegister &reg = input->reg;
        Burst *last = m_bursts.empty() ? nullptr : &m_bursts.back();
        const int size = last ? std::max(last->size, reg.first + reg.size - last->first) : 0;
        const bool isNext = last && m_isBurst && reg.first != RegisterBus::NoRegister
            && last->first != RegisterBus::NoRegister && reg.first <= last->first + last->size
            && size <= RegisterBus::MostAtOnce;
        if (!isNext)
            m_bursts.push_back({reg.first, reg.size, {}});
        else
            last->size = size;
        m_bursts.back().inputs.push_back(input);
    }
}

bool RegistersDriver::read()
{
    if (m_device.hasFailed())
        return true;  // as write() has told
    if (m_answer == Silent && !checkIdentity())
        return m_device.keep(now(), timeout().count());
    for (const Burst &burst : m_bursts) {
        quint8 bytes[RegisterBus::MostAtOnce] = {};
        if (!m_device.read(burst.first, bytes, burst.size))
            return keepAfter(burst.first, QStringLiteral("read"));
        for (Input *input : burst.inputs)
            input->channel.set(input->reg.valueOf(bytes + (input->reg.first - burst.first)));
    }
    m_device.succeed(now());
    return true;
}

// In each interval, changed or not: a device that was reset has its value back.
bool RegistersDriver::write()
{
    m_device.begin();
    for (const auto &output : m_outputs) {
        quint8 bytes[DeviceRegister::MostBytes] = {};
        if (!output->channel.hasValue())
            continue;
        if (output->reg.isField() && !m_device.read(output->reg.first, bytes, output->reg.size))
            return keepAfter(output->reg.first, QStringLiteral("read"));
        output->reg.bytesOf(output->channel.value(), bytes);
        if (!m_device.write(output->reg.first, bytes, output->reg.size))
            return keepAfter(output->reg.first, QStringLiteral("write"));
    }
    return true;
}

/// \return false when the device is lost
bool RegistersDriver::keepAfter(int reg, const QString &what)
{
    failAt(reg, what);
    return m_device.keep(now(), timeout().count());
}

bool RegistersDriver::failAt(int reg, const QString &what)
{
    const int errorNumber = errno;
    return fail(
        QStringLiteral("cannot %1 %2 of %3: %4; %5")
            .arg(what, RegisterBus::registerText(reg), place(), qt_error_string(errorNumber), remedy(errorNumber)));
}

}  // namespace qplc
