// SPDX-License-Identifier: Apache-2.0
#include "I2cDevice.h"
#include "I2cRegister.h"
#include "QPlcDriverSettings.h"
#include "QPlcReadChannel.h"
#include "QPlcWriteChannel.h"
#include "hardware/Drivers.h"
#include "signals/MessageText.h"

#include <algorithm>
#include <cerrno>
#include <vector>

namespace qplc {

namespace {

/// Kind `i2c-registers`: any I2C device, its registers named by the configuration. See
/// docs/hardware/i2c.md.
class I2cRegistersDriver final : public QPlcDriver
{
public:
    I2cRegistersDriver()
        : QPlcDriver(OwnPace)
    {
    }

protected:
    void configure(QPlcDriverSettings &settings) override
    {
        m_device = settings.requiredText(QStringLiteral("device"), QStringLiteral("/dev/i2c-1"));
        settings.requiredText(QStringLiteral("address"), QStringLiteral("0x68"));
        m_address = int(settings.integer(QStringLiteral("address"), I2cBus::FirstAddress, I2cBus::FirstAddress,
                                         I2cBus::LastAddress));
        m_bus.configure(m_device, m_address, settings);
        m_numbers
            = settings.choice(QStringLiteral("register-numbers"), {QStringLiteral("8 bits"), QStringLiteral("16 bits")})
                == 1
            ? I2cBus::SixteenBits
            : I2cBus::EightBits;
        m_isBurst = settings.truth(QStringLiteral("burst"), false);
        configureBytes(settings, QStringLiteral("identity"), &m_identity);
        configureBytes(settings, QStringLiteral("setup"), &m_setUp);
        const QString prefix = QStringLiteral("register.");
        const QStringList names = settings.namesBehind(prefix);
        for (const QString &name : names) {
            I2cRegister reg;
            const QString error
                = I2cRegister::read(settings.list(prefix + name), &reg, I2cBus::lastRegister(m_numbers));
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

    bool open() override
    {
        QString error;
        if (!m_bus.open(m_device, m_address, &error, m_numbers))
            return fail(error);
        for (const ByteValue &wanted : m_identity) {
            quint8 found = 0;
            if (!m_bus.read(wanted.reg, &found, 1))
                return failAt(wanted.reg, QStringLiteral("read"));
            if (found != wanted.value)
                return fail(
                    QStringLiteral("register %1 of the device at %2 of %3 is %4, and not %5 as 'identity' requires; "
                                   "this is another device: look at 'address' and 'identity'")
                        .arg(i2cAddressText(wanted.reg), i2cAddressText(m_address), m_device, i2cAddressText(found),
                             i2cAddressText(wanted.value)));
        }
        for (const ByteValue &order : m_setUp) {
            if (!m_bus.write(order.reg, &order.value, 1))
                return failAt(order.reg, QStringLiteral("write"));
        }
        planBursts();
        return true;
    }

    void close() override { m_bus.close(); }
    bool read() override
    {
        if (m_bus.hasFailed())
            return true;  // as write() has told
        for (const Burst &burst : m_bursts) {
            quint8 bytes[I2cBus::MostAtOnce] = {};
            if (!m_bus.read(burst.first, bytes, burst.size))
                return keepAfter(burst.first, QStringLiteral("read"));
            for (Input *input : burst.inputs)
                input->channel.set(input->reg.valueOf(bytes + (input->reg.first - burst.first)));
        }
        m_bus.succeed(now());
        return true;
    }

    // In each interval, changed or not: a device that was reset has its value back.
    bool write() override
    {
        m_bus.begin();
        for (const auto &output : m_outputs) {
            quint8 bytes[I2cRegister::MostBytes] = {};
            if (!output->channel.hasValue())
                continue;
            if (output->reg.isField() && !m_bus.read(output->reg.first, bytes, output->reg.size))
                return keepAfter(output->reg.first, QStringLiteral("read"));
            output->reg.bytesOf(output->channel.value(), bytes);
            if (!m_bus.write(output->reg.first, bytes, output->reg.size))
                return keepAfter(output->reg.first, QStringLiteral("write"));
        }
        return true;
    }

    QString remedy(int errorNumber) const override
    {
        const QString text = i2cRemedy(errorNumber);
        return text.isEmpty() ? QPlcDriver::remedy(errorNumber) : text;
    }

private:
    template<typename Channel>
    struct Item
    {
        Item(QPlcDriver *driver, const QString &name, const I2cRegister &what)
            : reg(what)
            , channel(driver, name)
        {
        }
        const I2cRegister reg;
        Channel channel;
    };
    using Input = Item<QPlcReadChannel>;
    /// Registers that are read in one transaction.
    struct Burst
    {
        int first = 0;
        int size = 0;  // [byte]
        std::vector<Input *> inputs;
    };

    /// Neighbours among the wired inputs become one transaction, if the device counts up by itself.
    void planBursts()
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
            const I2cRegister &reg = input->reg;
            Burst *last = m_bursts.empty() ? nullptr : &m_bursts.back();
            const int size = last ? std::max(last->size, reg.first + reg.size - last->first) : 0;
            const bool isNext = last && m_isBurst && reg.first != I2cBus::NoRegister
                && last->first != I2cBus::NoRegister && reg.first <= last->first + last->size
                && size <= I2cBus::MostAtOnce;
            if (!isNext)
                m_bursts.push_back({reg.first, reg.size, {}});
            else
                last->size = size;
            m_bursts.back().inputs.push_back(input);
        }
    }

    void addOutput(QPlcDriverSettings &settings, const QString &key, const QString &name, const I2cRegister &reg)
    {
        for (const auto &other : m_outputs) {
            if (reg.overlaps(other->reg))
                settings.addError(key,
                                  QStringLiteral("%1 and %2 write the same register; write one of them")
                                      .arg(quoted(name), quoted(other->channel.name())));
        }
        m_outputs.push_back(std::make_unique<Item<QPlcWriteChannel>>(this, name, reg));
        const RawNumber::Limits limits = reg.limits();
        m_outputs.back()->channel.setRange(limits.lowest, limits.highest);
    }

    struct ByteValue
    {
        int reg = 0;
        quint8 value = 0;
    };
    QString readBytes(const QStringList &words, std::vector<ByteValue> *result) const
    {
        for (const QString &word : words) {
            const QStringList parts = word.simplified().split(QLatin1Char(' '));
            bool isRegister = false;
            bool isValue = false;
            const uint reg = parts.value(0).toUInt(&isRegister, 0);
            const uint value = parts.value(1).toUInt(&isValue, 0);
            if (parts.size() != 2 || !isRegister || !isValue || reg > uint(I2cBus::lastRegister(m_numbers))
                || value > 0xff)
                return QStringLiteral(
                           "%1 is not a register with its value; write '0x6b 0x00', with commas between several")
                    .arg(quoted(word));
            result->push_back({int(reg), quint8(value)});
        }
        return QString();
    }

    void configureBytes(QPlcDriverSettings &settings, const QString &key, std::vector<ByteValue> *result)
    {
        const QString error = readBytes(settings.list(key), result);
        if (!error.isEmpty())
            settings.addError(key, error);
    }

    /// \return false when the device is lost
    bool keepAfter(int reg, const QString &what)
    {
        failAt(reg, what);
        return m_bus.keep(now(), timeout().count());
    }

    bool failAt(int reg, const QString &what)
    {
        const int errorNumber = errno;
        return fail(QStringLiteral("cannot %1 %2 of the device at %3 of %4: %5; %6")
                        .arg(what, i2cRegisterText(reg), i2cAddressText(m_address), m_device,
                             qt_error_string(errorNumber), remedy(errorNumber)));
    }

    QString m_device;
    int m_address = 0;
    I2cBus::Numbers m_numbers = I2cBus::EightBits;
    bool m_isBurst = false;
    std::vector<Burst> m_bursts;        // what read() does
    std::vector<ByteValue> m_identity;  // what the device must say of itself
    std::vector<ByteValue> m_setUp;     // what it is told first
    std::vector<std::unique_ptr<Input>> m_inputs;
    std::vector<std::unique_ptr<Item<QPlcWriteChannel>>> m_outputs;
    I2cDevice m_bus{this};
};

}  // namespace

std::unique_ptr<QPlcDriver> createI2cRegistersDriver()
{
    return std::make_unique<I2cRegistersDriver>();
}

}  // namespace qplc
