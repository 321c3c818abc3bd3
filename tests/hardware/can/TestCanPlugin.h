// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QMap>
#include <QtCore/QVariant>
#include <QtCore/QVector>
#include <QtSerialBus/QCanBusDevice>

#include <functional>

/// A device of the plugin "test" of Qt Serial Bus, which does what a test says. One at a time.
class TestCanDevice : public QCanBusDevice
{
    Q_OBJECT

public:
    /// What becomes of a frame.
    enum Manner {
        Written,  ///< at once
        Later,    ///< is kept for some milliseconds, as adapters with a queue do
        Never,    ///< is kept for ever
        Refused,  ///< writeFrame() says so
        Failed    ///< is taken, and fails some time later
    };
    /// Outlives the device. Changed before it is made, or by ask().
    struct Play
    {
        Manner manner = Written;
        CanBusStatus status = CanBusStatus::Good;
        int refusedBitRate = 0;
        QVector<quint32> written;  // ids
        QMap<int, QVariant> configuration;
    };
    static Play &play();
    /// Runs something in the thread of the device, and waits for its end.
    static void ask(const std::function<void(TestCanDevice &)> &what);

    TestCanDevice();
    ~TestCanDevice() override;

    void tellError(CanBusError error) { setError(QStringLiteral("an error of the test"), error); }
    void tellFrame(quint32 id) { enqueueReceivedFrames({QCanBusFrame(id, QByteArray(2, 'x'))}); }
    void lose() { setState(UnconnectedState); }

    void setConfigurationParameter(int key, const QVariant &value) override;
    bool writeFrame(const QCanBusFrame &frame) override;
    QString interpretErrorFrame(const QCanBusFrame &) override { return {}; }

protected:
    bool open() override;
    void close() override { setState(UnconnectedState); }

private:
    void writeNext();
};
