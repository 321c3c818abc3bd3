// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DeviceRegister.h"
#include "QPlcDriver.h"
#include "QPlcWriteChannel.h"
#include "RegisterDevice.h"

#include <vector>

namespace qplc {

/// A device whose registers the configuration names, independent of its bus. Keys
/// `register-numbers`, `burst`, `identity`, `setup`, `register.NAME`.
class RegistersDriver : public QPlcDriver
{
protected:
    /// How the bus tells that a device is missing.
    enum Answer : quint8 {
        Acknowledged,  // transfers fail
        Silent         // not at all: the driver reads `identity` before the values
    };

    explicit RegistersDriver(Answer answer)
        : QPlcDriver(OwnPace)
        , m_answer(answer)
    {
    }

    /// Reads the keys of the bus.
    virtual void configureBus(QPlcDriverSettings &settings) = 0;
    /// \return null, with the reason and the remedy in \a error
    virtual std::unique_ptr<RegisterBus> openBus(QString *error) = 0;
    /// "the device at 0x68 of /dev/i2c-1"
    virtual QString place() const = 0;
    /// What to look at when another device answers.
    virtual QString remedyOfIdentity() const = 0;

    RegisterBus::Numbers numbers() const { return m_numbers; }

    void configure(QPlcDriverSettings &settings) override;
    bool open() override;
    void close() override { m_device.close(); }
    bool read() override;
    bool write() override;

private:
    template<typename Channel>
    struct Item
    {
        Item(QPlcDriver *driver, const QString &name, const DeviceRegister &what)
            : reg(what)
            , channel(driver, name)
        {
        }
        const DeviceRegister reg;
        Channel channel;
    };
    using Input = Item<QPlcReadChannel>;
    using Output = Item<QPlcWriteChannel>;
    /// Registers that are read in one transaction.
    struct Burst
    {
        int first = 0;
        int size = 0;  // [byte]
        std::vector<Input *> inputs;
    };
    struct ByteValue
    {
        int reg = 0;
        quint8 value = 0;
    };

    QString readBytes(const QStringList &words, std::vector<ByteValue> *result) const;
    void configureBytes(QPlcDriverSettings &settings, const QString &key, std::vector<ByteValue> *result);
    void addOutput(QPlcDriverSettings &settings, const QString &key, const QString &name, const DeviceRegister &reg);
    void planBursts();
    bool checkIdentity();
    bool keepAfter(int reg, const QString &what);
    bool failAt(int reg, const QString &what);

    const Answer m_answer;
    RegisterBus::Numbers m_numbers = RegisterBus::EightBits;
    bool m_isBurst = false;
    std::vector<Burst> m_bursts;        // what read() does
    std::vector<ByteValue> m_identity;  // what the device must say of itself
    std::vector<ByteValue> m_setUp;     // what it is told first
    std::vector<std::unique_ptr<Input>> m_inputs;
    std::vector<std::unique_ptr<Output>> m_outputs;
    RegisterDevice m_device{this};
};

}  // namespace qplc
