// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "I2cBus.h"
#include "I2cRegister.h"
#include "QPlcDriver.h"
#include "QPlcReadChannel.h"
#include "QPlcWriteChannel.h"

#include <memory>
#include <vector>

namespace qplc {

/// Kind `i2c-registers`: any I2C device, its registers named by the configuration. See
/// docs/hardware/i2c.md.
class I2cRegistersDriver : public QPlcDriver
{
public:
    I2cRegistersDriver();

protected:
    void configure(QPlcDriverSettings &settings) override;
    bool open() override;
    void close() override { m_bus.reset(); }
    bool read() override;
    bool write() override;
    QString remedy(int errorNumber) const override;

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
    struct ByteValue
    {
        quint8 reg = 0;
        quint8 value = 0;
    };
    static QString readBytes(const QStringList &words, std::vector<ByteValue> *result);
    void configureBytes(QPlcDriverSettings &settings, const QString &key, std::vector<ByteValue> *result);
    bool failAt(quint8 reg, const QString &what);

    QString m_device;
    int m_address = 0;
    std::vector<ByteValue> m_identity;  // what the device must say of itself
    std::vector<ByteValue> m_setUp;     // what it is told first
    std::vector<std::unique_ptr<Item<QPlcReadChannel>>> m_inputs;
    std::vector<std::unique_ptr<Item<QPlcWriteChannel>>> m_outputs;
    std::unique_ptr<I2cBus> m_bus;
};

}  // namespace qplc
