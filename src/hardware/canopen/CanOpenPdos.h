// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanOpenConfiguration.h"
#include "QPlcReadChannel.h"
#include "QPlcWriteChannel.h"
#include "hardware/can/CanFrame.h"

#include <memory>
#include <optional>
#include <vector>

class QPlcDriver;

namespace qplc {

/// The process data of one device: channels of the objects in its PDOs.
class CanOpenPdos
{
public:
    explicit CanOpenPdos(QPlcDriver *driver)
        : m_driver(driver)
    {
    }

    void setPlan(const CanOpenConfiguration &plan);
    /// \param object  address or name of what the channel \a name reads \return null when no PDO of
    /// the device has it
    QPlcReadChannel *readChannel(const QString &object, const QString &name);
    /// As above; null, too, for an object that only the axis may write.
    QPlcWriteChannel *writeChannel(const QString &name);
    QStringList names(bool isRead) const;

    // ---- in the cycle; without memory ----
    /// Before the first frame of a device that was started.
    void begin() noexcept;
    /// Takes a frame of the device. \return the PDO; null: it is none
    const Pdo *take(const CanFrame &frame, qint64 time) noexcept;
    /// The frames to send, of the PDOs whose channels have values. \param axis  null: the objects
    /// of a drive have no values \return their number
    int collect(const AxisOutputs *axis, CanFrame *frames) noexcept;
    /// A SYNC goes out, or has come in: what the device had to send since the one before is here,
    /// or missed.
    void noteSync() noexcept;

    /// Whether the device takes values at a SYNC.
    bool waitsForSync() const noexcept;
    /// Synchronous PDOs of the device that did not come between two SYNCs.
    quint64 missed() const { return m_missed; }
    /// Values that did not fit into their object.
    quint64 saturated() const { return m_saturated; }

private:
    /// Bits of a PDO that belong to a channel.
    template<typename Channel>
    struct Field
    {
        int first;  // bit
        RawNumber number;
        std::unique_ptr<Channel> channel;
    };
    struct Input
    {
        Pdo pdo;
        std::vector<Field<QPlcReadChannel>> fields;
        std::chrono::nanoseconds freshTime{0};  // of its values; 0: as long as the device lives
        bool isDue = false;                     // a SYNC was seen
        bool hasCome = false;                   // since the last SYNC
    };
    struct Output
    {
        Pdo pdo;
        std::vector<Field<QPlcWriteChannel>> fields;
        bool isOfAxis = false;
        CanFrame frame;  // with the values of objects that nobody writes
    };
    /// Returns the value for the object \a index, or no value if the object is not one of the axis.
    static std::optional<double> targetOf(const AxisOutputs &axis, quint16 index) noexcept;
    bool isOfAxis(const PdoEntry &entry) const noexcept { return m_isAxis && targetOf({}, entry.address.index); }
    void encode(const RawNumber &number, int first, double value, CanFrame *frame) noexcept;
    void encodeAxis(const Pdo &pdo, const AxisOutputs &axis, CanFrame *frame) noexcept;

    QPlcDriver *m_driver;
    bool m_isAxis = false;
    std::vector<Input> m_inputs;
    std::vector<Output> m_outputs;
    quint64 m_missed = 0;
    quint64 m_saturated = 0;
};

}  // namespace qplc
