// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "DriverBench.h"
#include "TestCanPlugin.h"
#include "hardware/can/QtCanBus.h"

#include <QtCore/QtPlugin>

#include <cerrno>

Q_IMPORT_PLUGIN(TestCanPlugin)

using namespace qplc;
using namespace std::chrono_literals;

namespace {

CanFrame frameOf(quint32 id)
{
    CanFrame frame;
    frame.id = id;
    return frame;
}

class StandingClock : public TimeSource
{
public:
    std::int64_t now() noexcept override { return m_now; }
    bool sleepUntil(std::int64_t) noexcept override { return true; }
    void advance(std::chrono::nanoseconds time) { m_now += time.count(); }

private:
    std::atomic<std::int64_t> m_now{1};
};

}  // namespace

class tst_QtCanBus : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void cleanup();
    void bitRatesReachThePlugin();
    void dataBitRateEnablesCanFd();
    void missingOptionsLeaveThePluginUnconfigured();
    void bitRateThatThePluginRefusesIsNamed();
    void frameThatThePluginRefusesIsUnsent();
    void frameThatFailsLaterIsUnsent();
    void changeThatFailedIsSentAgain();
    void temporaryErrorsKeepTheBusOpen_data();
    void temporaryErrorsKeepTheBusOpen();
    void lastingErrorsEndTheBus_data();
    void lastingErrorsEndTheBus();
    void errorOfTheConnectionEndsTheBus();
    void otherErrorsKeepTheBusOpen();
    void lostDeviceEndsTheBus();
    void busIsOpenedAgainAfterItsEnd();
    void controllerStateIsReported();
    void closeSendsTheLastFrameFirst();
    void deviceThatNeverWritesMayBeClosed();

private:
    /// What the driver would hear.
    int receive()
    {
        CanFrame frame;
        return m_bus->receive(&frame, 1);
    }
    quint64 unsent()
    {
        receive();
        return m_bus->counters().unsent;
    }
    void send(quint32 id)
    {
        const CanFrame frame = frameOf(id);
        QCOMPARE(m_bus->send(&frame, 1), 1);
    }
    static void tell(QCanBusDevice::CanBusError error)
    {
        TestCanDevice::ask([error](TestCanDevice &device) { device.tellError(error); });
    }
    static int written()
    {
        int count = 0;
        TestCanDevice::ask([&count](TestCanDevice &) { count = TestCanDevice::play().written.size(); });
        return count;
    }
    static void announceTheEnd() { QTest::ignoreMessage(QtWarningMsg, "qtcan:test:can0: an error of the test"); }

    StandingClock m_clock;
    std::unique_ptr<QtCanBus> m_bus;
    CanBus::Options m_options;
};

void tst_QtCanBus::init()
{
    TestCanDevice::play() = {};
    m_options = {};
    m_options.receivesAll = true;
    m_bus = std::make_unique<QtCanBus>(QStringLiteral("test"), QStringLiteral("can0"), m_clock);
}

void tst_QtCanBus::cleanup()
{
    m_bus.reset();
}

void tst_QtCanBus::bitRatesReachThePlugin()
{
    m_options.bitRate = 250000;
    m_options.dataBitRate = 2000000;
    QVERIFY2(m_bus->open(m_options), qPrintable(m_bus->errorString()));
    const auto &configuration = TestCanDevice::play().configuration;
    QCOMPARE(configuration.value(QCanBusDevice::BitRateKey).toInt(), 250000);
    QCOMPARE(configuration.value(QCanBusDevice::DataBitRateKey).toInt(), 2000000);
}

// A controller without CAN FD would disturb the frames of the others.
void tst_QtCanBus::dataBitRateEnablesCanFd()
{
    m_options.dataBitRate = 2000000;
    QVERIFY(m_bus->open(m_options));
    QCOMPARE(TestCanDevice::play().configuration.value(QCanBusDevice::CanFdKey), QVariant(true));
}

void tst_QtCanBus::missingOptionsLeaveThePluginUnconfigured()
{
    QVERIFY(m_bus->open(m_options));
    QVERIFY(TestCanDevice::play().configuration.isEmpty());
}

void tst_QtCanBus::bitRateThatThePluginRefusesIsNamed()
{
    m_options.bitRate = 123456;
    TestCanDevice::play().refusedBitRate = 123456;
    QVERIFY(!m_bus->open(m_options));
    QCOMPARE(m_bus->errorString(),
             QStringLiteral("qtcan:test:can0 does not take bitrate = 123456: no such rate; "
                            "see what the adapter can do"));
}

void tst_QtCanBus::frameThatThePluginRefusesIsUnsent()
{
    TestCanDevice::play().manner = TestCanDevice::Refused;
    QVERIFY(m_bus->open(m_options));
    send(0x123);
    QTRY_COMPARE(unsent(), quint64(1));
    QCOMPARE(m_bus->counters().sent, quint64(0));
}

void tst_QtCanBus::frameThatFailsLaterIsUnsent()
{
    TestCanDevice::play().manner = TestCanDevice::Failed;
    QVERIFY(m_bus->open(m_options));
    send(0x123);
    QTRY_COMPARE(unsent(), quint64(1));
    QCOMPARE(m_bus->counters().sent, quint64(0));
}

// A safe value, perhaps: nothing else would send it.
void tst_QtCanBus::changeThatFailedIsSentAgain()
{
    DriverBench bench(QStringLiteral("can"),
                      "device = qtcan:test:can0\nframe.A = 0x123, 1 byte\nsignal.A.S = 0|8@1+\nsend.A = on change\n");
    QCOMPARE(bench.errors(), QString());
    const QString channel = QStringLiteral("A.S");
    bench.wireRead(QStringLiteral("@unsent"));
    bench.wireWrite(channel);
    TestCanDevice::play().manner = TestCanDevice::Failed;
    QVERIFY2(bench.open(), qPrintable(bench.errorString()));
    bench.set(channel, 1.0);
    QTRY_VERIFY(bench.exchange() && bench.value(QStringLiteral("@unsent")) > 0.0);
    TestCanDevice::ask([](TestCanDevice &) { TestCanDevice::play().manner = TestCanDevice::Written; });
    QTRY_VERIFY(bench.exchange() && written() > 0);
    const auto isQuiet = [&bench] {  // as soon as those that were under way have failed
        const int before = written();
        for (int i = 0; i < 10; ++i)
            bench.exchange();
        return written() == before;
    };
    QTRY_VERIFY(isQuiet());
}

void tst_QtCanBus::temporaryErrorsKeepTheBusOpen_data()
{
    QTest::addColumn<int>("error");
    QTest::addColumn<bool>("isSending");
    QTest::newRow("reading fails, a frame is sent") << int(QCanBusDevice::ReadError) << true;
    QTest::newRow("writing fails, a frame is sent") << int(QCanBusDevice::WriteError) << true;
    QTest::newRow("writing fails, a frame comes in") << int(QCanBusDevice::WriteError) << false;
}

void tst_QtCanBus::temporaryErrorsKeepTheBusOpen()
{
    QFETCH(int, error);
    QFETCH(bool, isSending);
    QVERIFY(m_bus->open(m_options));
    for (int round = 1; round <= 3; ++round) {
        tell(QCanBusDevice::CanBusError(error));
        m_clock.advance(900ms);
        tell(QCanBusDevice::CanBusError(error));
        if (isSending) {
            send(0x123);
            QTRY_COMPARE(written(), round);
        } else {
            TestCanDevice::ask([](TestCanDevice &device) { device.tellFrame(0x55); });
            QCOMPARE(receive(), 1);
        }
        m_clock.advance(900ms);
    }
    QCOMPARE(receive(), 0);
}

void tst_QtCanBus::lastingErrorsEndTheBus_data()
{
    QTest::addColumn<int>("error");
    QTest::newRow("reading") << int(QCanBusDevice::ReadError);
    QTest::newRow("writing") << int(QCanBusDevice::WriteError);
}

void tst_QtCanBus::lastingErrorsEndTheBus()
{
    QFETCH(int, error);
    QVERIFY(m_bus->open(m_options));
    tell(QCanBusDevice::CanBusError(error));
    m_clock.advance(999ms);
    tell(QCanBusDevice::CanBusError(error));
    QCOMPARE(receive(), 0);
    m_clock.advance(1ms);
    announceTheEnd();
    tell(QCanBusDevice::CanBusError(error));
    QCOMPARE(receive(), -1);
    QCOMPARE(m_bus->errorNumber(), EIO);
    const CanFrame frame = frameOf(1);
    QCOMPARE(m_bus->send(&frame, 1), -1);
}

void tst_QtCanBus::errorOfTheConnectionEndsTheBus()
{
    QVERIFY(m_bus->open(m_options));
    announceTheEnd();
    tell(QCanBusDevice::ConnectionError);
    QCOMPARE(receive(), -1);
    QCOMPARE(m_bus->errorNumber(), EIO);
}

void tst_QtCanBus::otherErrorsKeepTheBusOpen()
{
    QVERIFY(m_bus->open(m_options));
    for (const auto error : {QCanBusDevice::ConfigurationError, QCanBusDevice::OperationError,
                             QCanBusDevice::TimeoutError, QCanBusDevice::UnknownError}) {
        tell(error);
        m_clock.advance(2s);
    }
    QCOMPARE(receive(), 0);
    QCOMPARE(unsent(), quint64(0));
}

void tst_QtCanBus::lostDeviceEndsTheBus()
{
    QVERIFY(m_bus->open(m_options));
    TestCanDevice::ask([](TestCanDevice &device) { device.lose(); });
    QCOMPARE(receive(), -1);
    QCOMPARE(m_bus->errorNumber(), ENODEV);
}

void tst_QtCanBus::busIsOpenedAgainAfterItsEnd()
{
    QVERIFY(m_bus->open(m_options));
    announceTheEnd();
    tell(QCanBusDevice::ConnectionError);
    QCOMPARE(receive(), -1);
    m_bus->close();
    QVERIFY(m_bus->open(m_options));
    QCOMPARE(receive(), 0);
    tell(QCanBusDevice::WriteError);
    QCOMPARE(receive(), 0);
}

void tst_QtCanBus::controllerStateIsReported()
{
    using Status = QCanBusDevice::CanBusStatus;
    QVERIFY(m_bus->open(m_options));
    const auto stateAt = [this](Status status) {
        TestCanDevice::ask([status](TestCanDevice &) { TestCanDevice::play().status = status; });
        receive();
        return m_bus->state();
    };
    QTRY_COMPARE(stateAt(Status::Warning), CanBus::Warning);
    QTRY_COMPARE(stateAt(Status::Error), CanBus::Passive);
    QTRY_COMPARE(stateAt(Status::BusOff), CanBus::BusOff);
    QTRY_COMPARE(stateAt(Status::Good), CanBus::Active);
    QCOMPARE(m_bus->counters().busOffs, quint64(1));
}

void tst_QtCanBus::closeSendsTheLastFrameFirst()
{
    TestCanDevice::play().manner = TestCanDevice::Later;
    QVERIFY(m_bus->open(m_options));
    send(0x7FF);
    m_bus->close();
    QCOMPARE(TestCanDevice::play().written, QVector<quint32>{0x7FF});
}

void tst_QtCanBus::deviceThatNeverWritesMayBeClosed()
{
    TestCanDevice::play().manner = TestCanDevice::Never;
    QVERIFY(m_bus->open(m_options));
    send(0x7FF);
    m_bus->close();
    QVERIFY(TestCanDevice::play().written.isEmpty());
}

QTEST_GUILESS_MAIN(tst_QtCanBus)
#include "tst_QtCanBus.moc"
