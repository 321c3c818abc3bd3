// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanBus.h"
#include "QPlcDriver.h"
#include "QPlcReadChannel.h"

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace qplc {

/// What the drivers of a CAN bus have in common: the bus, its loss, and channels in which a driver
/// tells of itself (`@sent`).
class CanBusDriver : public QPlcDriver
{
public:
    using QPlcDriver::QPlcDriver;

protected:
    /// \param device  empty: its error was told
    void makeBus(const QString &device, QPlcDriverSettings &settings);
    /// \pre a bus was made, as for all below
    bool openBus(const CanBus::Options &options);
    CanBus &bus() { return *m_bus; }

    QString remedy(int errorNumber) const override;

    // ---- channels ----
    /// Lets the driver have the read channel \a name. \param number  its value, without memory
    void addOwn(const char *name, std::function<quint64()> number);
    QStringList ownNames() const;
    /// \return null if the driver has no channel of this name
    QPlcChannel *ownChannel(const QString &name);

    // ---- in the cycle; without memory ----
    /// Gives values to the channels of addOwn().
    void showOwn() noexcept;
    /// Takes what has come in. \param take  gets each frame \return false when the bus is lost
    template<typename Take>
    bool receive(Take take) noexcept;
    /// \param sent  how many the bus has taken; null: it does not matter \return as above
    bool send(const CanFrame *frames, int count, int *sent = nullptr) noexcept;
    /// \return false when the controller has not come back by itself in time
    bool checkBusOff() noexcept;

private:
    struct Own
    {
        const char *name;
        std::function<quint64()> number;
        std::unique_ptr<QPlcReadChannel> channel;  // null until it is wired
    };

    static constexpr int BatchSize = 64;
    static constexpr int MostBatches = 64;  // of one cycle, so that it ends

    bool failToReceive() noexcept { return fail(m_receiveText.constData(), m_bus->errorNumber()); }

    QString m_device;
    std::unique_ptr<CanBus> m_bus;
    QByteArray m_receiveText;  // for errors
    QByteArray m_sendText;
    std::vector<Own> m_own;
    std::array<CanFrame, BatchSize> m_incoming;
    qint64 m_busOffSince = -1;  // [ns]; -1: it is not
};

template<typename Take>
bool CanBusDriver::receive(Take take) noexcept
{
    for (int batch = 0; batch < MostBatches; ++batch) {
        const int count = m_bus->receive(m_incoming.data(), BatchSize);
        if (count < 0)
            return failToReceive();
        for (int i = 0; i < count; ++i)
            take(m_incoming[std::size_t(i)]);
        if (count < BatchSize)
            break;
    }
    return true;
}

}  // namespace qplc
