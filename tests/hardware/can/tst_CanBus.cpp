// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "hardware/can/CanBus.h"
#include "hardware/can/CanLink.h"
#include "hardware/can/FakeCanBus.h"
#include "hardware/can/WallTimeConverter.h"
#include "realtime/TimeSource.h"

#include <cstring>
#include <linux/can/error.h>
#include <linux/can/netlink.h>
#include <linux/rtnetlink.h>
#include <memory>
#include <net/if.h>
#include <poll.h>

using namespace qplc;

namespace {

CanFrame frameOf(quint32 id, quint8 flags = 0)
{
    CanFrame frame;
    frame.id = id;
    frame.flags = flags;
    frame.size = 2;
    frame.data[0] = quint8(id);
    frame.data[1] = quint8(id >> 8);
    return frame;
}

CanBus::Options everything()
{
    CanBus::Options options;
    options.receivesAll = true;
    return options;
}

std::unique_ptr<CanBus> join(const QString &device, const CanBus::Options &options = everything())
{
    QString error;
    auto bus = CanBus::make(device, &error);
    if (!bus || !bus->open(options))
        qFatal("%s", qPrintable(bus ? bus->errorString() : error));
    return bus;
}

std::vector<CanFrame> receiveAll(CanBus &bus)
{
    std::vector<CanFrame> frames;
    CanFrame frame;
    while (bus.receive(&frame, 1) == 1)
        frames.push_back(frame);
    return frames;
}

bool hasQtSerialBus()
{
    QString error;
    return CanBus::make(QStringLiteral("qtcan:virtualcan:can0"), &error) != nullptr;
}

const QString testBus = QStringLiteral("fake:test");

// What has come in when it is `count` frames, or after some seconds: a bus of the kernel needs a
// moment.
std::vector<CanFrame> receive(CanBus &bus, std::size_t count)
{
    std::vector<CanFrame> frames;
    for (int turn = 0; turn < 500 && frames.size() < count; ++turn) {
        pollfd descriptor{bus.descriptor(), POLLIN, 0};
        poll(&descriptor, 1, 10);
        const auto more = receiveAll(bus);
        frames.insert(frames.end(), more.begin(), more.end());
    }
    return frames;
}

// Buses that have to behave alike: a fake one, and an interface of the kernel, if QTPLC_TEST_CAN
// names one.
void addBuses()
{
    QTest::addColumn<QString>("device");
    QTest::newRow("fake") << testBus;
    const QString interface = qEnvironmentVariable("QTPLC_TEST_CAN");
    if (!interface.isEmpty())
        QTest::newRow("kernel") << interface;
}

constexpr quint32 echoFlag = 1U << 18;  // IFF_ECHO of <linux/if.h>, which <net/if.h> does not go with

CanBus::Options sends(quint32 key)
{
    CanBus::Options options;
    options.sentKeys = {key};
    return options;
}

// A bus that confirms frames when the test says so.
class ScriptedBus : public CanBus
{
public:
    // How many of so many frames it takes.
    int give(int count)
    {
        const std::vector<CanFrame> frames(std::size_t(count), frameOf(1));
        return send(frames.data(), count, now);
    }
    // Takes what has come in, and so many confirmations.
    void turn(int confirmations = 0)
    {
        m_confirmations = confirmations;
        receiveAll(*this);
    }
    void close() override {}

    qint64 now = 0;  // [ns]
    bool isQueued = false;
    bool isPassive = false;
    std::vector<CanFrame> incoming;

protected:
    bool join(const Options &) override
    {
        expectConfirmations();
        return true;
    }
    int readFrames(CanFrame *frames, int) noexcept override
    {
        confirm(m_confirmations);
        m_confirmations = 0;
        if (isPassive)
            setState(Passive);
        if (incoming.empty())
            return 0;
        frames[0] = incoming.front();
        incoming.erase(incoming.begin());
        return 1;
    }
    int writeFrames(const CanFrame *, int count) noexcept override { return count; }
    bool hasQueue() const noexcept override { return isQueued; }

private:
    int m_confirmations = 0;
};

QByteArray attribute(int kind, const QByteArray &content)
{
    rtattr head;
    head.rta_type = quint16(kind);
    head.rta_len = quint16(RTA_LENGTH(content.size()));
    QByteArray bytes(reinterpret_cast<const char *>(&head), sizeof head);
    bytes += content;
    return bytes.leftJustified(int(RTA_SPACE(content.size())), '\0');
}

template<typename T>
QByteArray bytesOf(const T &value)
{
    return {reinterpret_cast<const char *>(&value), int(sizeof value)};
}

// An answer of the kernel to RTM_GETLINK of a CAN interface.
QByteArray linkMessage(quint32 flags, quint32 state, quint32 mode)
{
    ifinfomsg info;
    std::memset(&info, 0, sizeof info);
    info.ifi_flags = flags;
    const can_ctrlmode modes{0xFFFFFFFF, mode};
    const QByteArray can = attribute(IFLA_CAN_CTRLMODE, bytesOf(modes)) + attribute(IFLA_CAN_STATE, bytesOf(state));
    const QByteArray body = bytesOf(info) + attribute(IFLA_IFNAME, QByteArray("can0", 5))
        + attribute(IFLA_LINKINFO, attribute(IFLA_INFO_KIND, "can") + attribute(IFLA_INFO_DATA, can));
    nlmsghdr header;
    std::memset(&header, 0, sizeof header);
    header.nlmsg_type = RTM_NEWLINK;
    header.nlmsg_len = quint32(NLMSG_LENGTH(body.size()));
    return bytesOf(header) + body;
}

}  // namespace

class tst_CanBus : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void cleanup();
    void invalidBusNameIsRefused_data();
    void invalidBusNameIsRefused();
    void missingInterfaceIsNamed();
    void frameGoesToAllOthersUnchanged_data() { addBuses(); }
    void frameGoesToAllOthersUnchanged();
    void frameStaysOnItsOwnBus();
    void filterPassesOnlySelectedMessages_data() { addBuses(); }
    void filterPassesOnlySelectedMessages();
    void framesStayInOrder_data() { addBuses(); }
    void framesStayInOrder();
    void framesThatAreSentAtOnceArriveAtOnce();
    void slowReceiverLosesNothingThatFits();
    void receiverCountsFramesThatDoNotFit();
    void lateParticipantReceivesNoEarlierFrames();
    void placeOfKilledParticipantIsReused();
    void tooManyParticipantsAreRefused();
    void folderWithALongNameIsRefused();
    void errorFramesSetTheControllerState_data() { addBuses(); }
    void errorFramesSetTheControllerState();
    void overflowOfTheControllerIsALoss_data() { addBuses(); }
    void overflowOfTheControllerIsALoss();
    void framesOfTheBusAreConfirmed_data() { addBuses(); }
    void framesOfTheBusAreConfirmed();
    void kernelHoldsOneFrameOfASlowQueue();
    void busHoldsBackUntilFramesAreConfirmed();
    void framesOfOneTurnDoNotWaitForEachOther();
    void busWithoutSentKeysHoldsNothingBack();
    void droppedFramesAreGivenUpAfterATime_data();
    void droppedFramesAreGivenUpAfterATime();
    void framesInAQueueAreNotGivenUp();
    void restartOfTheControllerEndsTheWait();
    void queueOfAnUnacknowledgedBusIsShort();
    void kernelTellsStateEchoAndOneShot();
    void damagedLinkMessageIsRead();
    void processesExchangeFramesOverTheBus();
    void stampsFollowTheMonotonicClock();
    void stampsSurviveAStepOfTheWallClock();
    void virtualPluginCarriesFrames();
    void missingPluginIsNamed();

private:
    std::unique_ptr<QTemporaryDir> m_folder;
};

void tst_CanBus::init()
{
    m_folder = std::make_unique<QTemporaryDir>();
    qputenv("QTPLC_FAKE_DEVICES", m_folder->path().toLocal8Bit());
}

void tst_CanBus::cleanup()
{
    qunsetenv("QTPLC_FAKE_DEVICES");
}

void tst_CanBus::invalidBusNameIsRefused_data()
{
    QTest::addColumn<QString>("error");
    const auto row = [](const char *device, const char *error) { QTest::newRow(device) << QString::fromLatin1(error); };
    row("", "'' does not name a CAN bus; write an interface like can0");
    row("an interface", "'an interface' does not name a CAN bus");
    row("interface0123456", "'interface0123456' does not name a CAN bus");
    row("/dev/can0", "'/dev/can0' does not name a CAN bus");
    row("fake:", "'fake:' does not name a fake bus; write fake:NAME");
    row("fake:../x", "'fake:../x' does not name a fake bus");
    row("qtcan:peakcan", "'qtcan:peakcan");
}

void tst_CanBus::invalidBusNameIsRefused()
{
    QFETCH(QString, error);
    QString message;
    QVERIFY(!CanBus::make(QString::fromLatin1(QTest::currentDataTag()), &message));
    QVERIFY2(message.startsWith(error), qPrintable(message));
}

void tst_CanBus::missingInterfaceIsNamed()
{
    QString error;
    const auto bus = CanBus::make(QStringLiteral("nocan7"), &error);
    QVERIFY(bus);
    QVERIFY(!bus->open(everything()));
    QVERIFY2(bus->errorString().startsWith(QLatin1String("nocan7: the kernel does not support CAN"))
                 || bus->errorString().startsWith(QLatin1String("nocan7: there is no such interface")),
             qPrintable(bus->errorString()));
}

void tst_CanBus::frameGoesToAllOthersUnchanged()
{
    QFETCH(QString, device);
    const auto a = join(device);
    const auto b = join(device);
    const auto c = join(device);
    CanFrame frame = frameOf(0x18FEDFFE, CanFrame::Extended | CanFrame::Fd | CanFrame::BitRateSwitch);
    frame.size = 64;
    frame.data[63] = 0xAB;
    const qint64 before = monotonicNow();
    QCOMPARE(a->send(&frame, 1), 1);
    for (CanBus *bus : {b.get(), c.get()}) {
        const auto frames = receive(*bus, 1);
        QCOMPARE(frames.size(), std::size_t(1));
        QCOMPARE(frames[0].id, frame.id);
        QCOMPARE(frames[0].flags, frame.flags);
        QCOMPARE(frames[0].size, frame.size);
        QVERIFY(frames[0].data == frame.data);
        QVERIFY(frames[0].time >= before - 1'000'000 && frames[0].time <= monotonicNow());
    }
    QVERIFY(receiveAll(*a).empty());
    QCOMPARE(a->counters().sent, quint64(1));
    QCOMPARE(b->counters().received, quint64(1));
}

void tst_CanBus::frameStaysOnItsOwnBus()
{
    const auto a = join(testBus);
    const auto b = join(QStringLiteral("fake:other"));
    const CanFrame frame = frameOf(1);
    a->send(&frame, 1);
    QVERIFY(receiveAll(*b).empty());
}

void tst_CanBus::filterPassesOnlySelectedMessages()
{
    QFETCH(QString, device);
    CanBus::Options options;
    options.keys = {0x123, 0x80000005};
    const auto a = join(device);
    const auto b = join(device, options);
    const CanFrame frames[] = {frameOf(0x122),
                               frameOf(0x123),
                               frameOf(5),
                               frameOf(5, CanFrame::Extended),
                               frameOf(0x123, CanFrame::Remote),
                               frameOf(0x123, CanFrame::Extended)};
    a->send(frames, 6);
    const auto received = receive(*b, 3);
    QCOMPARE(received.size(), std::size_t(3));
    QCOMPARE(received[0].key(), 0x123U);
    QCOMPARE(received[1].key(), 0x80000005U);
    QVERIFY(received[2].has(CanFrame::Remote));
}

void tst_CanBus::framesStayInOrder()
{
    QFETCH(QString, device);
    const auto a = join(device);
    const auto b = join(device);
    quint32 sent = 0;
    quint32 expected = 0;
    for (int round = 0; round < 200; ++round) {
        std::vector<CanFrame> frames;
        for (int i = 0; i < round % 7; ++i)
            frames.push_back(frameOf(sent++));
        QCOMPARE(a->send(frames.data(), int(frames.size())), int(frames.size()));
        if (round % 5 == 0) {
            for (const CanFrame &frame : receiveAll(*b))
                QCOMPARE(frame.id, expected++);
        }
    }
    for (const CanFrame &frame : receive(*b, sent - expected))
        QCOMPARE(frame.id, expected++);
    QCOMPARE(expected, sent);
}

/// Also where the queue of a sender is at its end: the kernel takes ten packets for a receiver who
/// is busy.
void tst_CanBus::framesThatAreSentAtOnceArriveAtOnce()
{
    const auto receiver = join(testBus);
    std::vector<std::unique_ptr<CanBus>> senders(6);
    for (auto &sender : senders)
        sender = join(testBus);
    const auto sendAll = [&](int count) {
        const std::vector<CanFrame> frames(std::size_t(count), frameOf(1));
        for (const auto &sender : senders)
            QCOMPARE(sender->send(frames.data(), count), count);
        for (const auto &sender : senders)
            receiveAll(*sender);
        QCOMPARE(receiveAll(*receiver).size(), senders.size() * frames.size());
    };
    for (int sent = 0; sent < FakeCanBus::Backlog - 1; sent += 63)
        sendAll(63);
    sendAll(2);
}

void tst_CanBus::slowReceiverLosesNothingThatFits()
{
    const auto a = join(testBus);
    const auto b = join(testBus);
    for (quint32 i = 0; i < 1000; ++i) {
        const CanFrame frame = frameOf(i);
        a->send(&frame, 1);
    }
    quint32 expected = 0;
    for (int turn = 0; turn < 1000 && expected < 1000; ++turn) {
        for (const CanFrame &frame : receiveAll(*b))
            QCOMPARE(frame.id, expected++);
        receiveAll(*a);  // gives on what has waited for room
    }
    QCOMPARE(expected, 1000U);
    QCOMPARE(b->counters().lost, quint64(0));
}

void tst_CanBus::receiverCountsFramesThatDoNotFit()
{
    const auto a = join(testBus);
    const auto b = join(testBus);
    for (quint32 i = 0; i < 10000; ++i) {
        const CanFrame frame = frameOf(i);
        a->send(&frame, 1);
    }
    quint64 received = 0;
    for (std::size_t count = 1; count > 0;) {
        count = receiveAll(*b).size();
        received += count;
        receiveAll(*a);
    }
    QVERIFY(b->counters().lost > 0);
    QCOMPARE(received + b->counters().lost, quint64(10000));
}

void tst_CanBus::lateParticipantReceivesNoEarlierFrames()
{
    const auto a = join(testBus);
    auto b = join(testBus);
    for (quint32 i = 0; i < 100; ++i) {
        const CanFrame frame = frameOf(i);
        a->send(&frame, 1);
    }
    b.reset();
    b = join(testBus);
    const CanFrame last = frameOf(0x777);
    a->send(&last, 1);
    const auto frames = receiveAll(*b);
    QCOMPARE(frames.size(), std::size_t(1));
    QCOMPARE(frames[0].id, 0x777U);
}

void tst_CanBus::placeOfKilledParticipantIsReused()
{
    const auto a = join(testBus);
    for (int i = 0; i < FakeCanBus::MaximumPlaces + 2; ++i) {
        QProcess partner;
        partner.start(QStringLiteral(CAN_PARTNER), {testBus});
        QVERIFY(partner.waitForReadyRead());
        partner.kill();
        QVERIFY(partner.waitForFinished());
        const CanFrame frame = frameOf(1);
        QCOMPARE(a->send(&frame, 1), 1);
    }
}

void tst_CanBus::tooManyParticipantsAreRefused()
{
    std::vector<std::unique_ptr<CanBus>> all;
    for (int i = 0; i < FakeCanBus::MaximumPlaces; ++i)
        all.push_back(join(testBus));
    QString error;
    const auto one = CanBus::make(testBus, &error);
    QVERIFY(!one->open(everything()));
    QCOMPARE(one->errorString(), QStringLiteral("fake:test has 16 participants already; end one of them"));
}

void tst_CanBus::folderWithALongNameIsRefused()
{
    qputenv("QTPLC_FAKE_DEVICES", m_folder->path().toLocal8Bit() + '/' + QByteArray(100, 'x'));
    QString error;
    const auto bus = CanBus::make(testBus, &error);
    QVERIFY(!bus->open(everything()));
    QVERIFY2(bus->errorString().contains(QLatin1String("set QTPLC_FAKE_DEVICES to a shorter one")),
             qPrintable(bus->errorString()));
}

void tst_CanBus::errorFramesSetTheControllerState()
{
    QFETCH(QString, device);
    const auto a = join(device);
    const auto b = join(device, CanBus::Options());
    const auto tell = [&](quint32 error, quint8 controller) {
        CanFrame frame = frameOf(error, CanFrame::Error);
        frame.size = 8;
        frame.data = {};
        frame.data[1] = controller;
        a->send(&frame, 1);
        receive(*b, 1);
        return b->state();
    };
    QCOMPARE(tell(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING), CanBus::Warning);
    QCOMPARE(tell(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_PASSIVE), CanBus::Passive);
    QCOMPARE(tell(CAN_ERR_ACK, 0), CanBus::Passive);
    QCOMPARE(tell(CAN_ERR_BUSOFF, 0), CanBus::BusOff);
    QCOMPARE(tell(CAN_ERR_BUSOFF, 0), CanBus::BusOff);
    QCOMPARE(tell(CAN_ERR_RESTARTED, 0), CanBus::Active);
    QCOMPARE(tell(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING), CanBus::Warning);
    QCOMPARE(tell(CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE), CanBus::Active);
    QCOMPARE(b->counters().errorFrames, quint64(8));
    QCOMPARE(b->counters().busOffs, quint64(1));
    QCOMPARE(b->counters().received, quint64(0));
}

void tst_CanBus::overflowOfTheControllerIsALoss()
{
    QFETCH(QString, device);
    const auto a = join(device);
    const auto b = join(device);
    CanFrame frame = frameOf(CAN_ERR_CRTL, CanFrame::Error);
    frame.data[1] = CAN_ERR_CRTL_RX_OVERFLOW;
    a->send(&frame, 1);
    receive(*b, 1);
    QCOMPARE(b->counters().lost, quint64(1));
    QCOMPARE(b->state(), CanBus::Active);
}

// ---- confirmations ----

// A vcan confirms if it was loaded with echo=1; without, nothing is ever unconfirmed.
void tst_CanBus::framesOfTheBusAreConfirmed()
{
    QFETCH(QString, device);
    const auto a = join(device, sends(5));
    const auto b = join(device);
    const CanFrame frame = frameOf(5);
    for (int i = 0; i < 20; ++i) {
        QCOMPARE(a->send(&frame, 1), 1);
        QCOMPARE(receive(*b, 1).size(), std::size_t(1));
        QTRY_COMPARE((receiveAll(*a), a->unconfirmed()), 0);
    }
    QCOMPARE(a->counters().received, quint64(0));
    QCOMPARE(a->counters().unsent, quint64(0));
}

// The queue of the kernel as in an outage: a token bucket lets a frame pass each half second.
void tst_CanBus::kernelHoldsOneFrameOfASlowQueue()
{
    const QString interface = qEnvironmentVariable("QTPLC_TEST_CAN");
    if (interface.isEmpty() || !CanLink::read(int(if_nametoindex(interface.toLatin1()))).hasEcho)
        QSKIP("set QTPLC_TEST_CAN to a CAN interface with echo, such as vcan0 after 'modprobe vcan echo=1'");
    const auto tc = [&interface](const QStringList &bucket) {
        const QStringList place{QStringLiteral("dev"), interface, QStringLiteral("root")};
        return QProcess::execute(QStringLiteral("tc"),
                                 QStringList{QStringLiteral("qdisc"), bucket.first()} + place + bucket.mid(1));
    };
    const auto a = join(interface, sends(5));
    QCOMPARE(tc(QStringLiteral("add tbf rate 256bit burst 20 limit 2000").split(QLatin1Char(' '))), 0);
    const auto restore = qScopeGuard([&tc] { tc({QStringLiteral("del")}); });
    int most = 0;
    for (int i = 0; i < 100; ++i) {
        const CanFrame frame = frameOf(5);
        receiveAll(*a);
        a->send(&frame, 1, monotonicNow());
        most = std::max(most, a->unconfirmed());
        QThread::msleep(10);
    }
    QCOMPARE(most, 1);
    QCOMPARE(a->counters().failed, quint64(0));  // it waits in the queue, so it was not dropped
    QVERIFY(a->counters().sent > 0 && a->counters().unsent > a->counters().sent);
}

void tst_CanBus::busHoldsBackUntilFramesAreConfirmed()
{
    ScriptedBus bus;
    QVERIFY(bus.open(sends(1)));
    QCOMPARE(bus.give(2), 2);
    bus.turn();
    QCOMPARE(bus.give(2), 0);
    bus.turn(1);
    QCOMPARE(bus.unconfirmed(), 1);
    QCOMPARE(bus.give(2), 0);
    bus.turn(1);
    QCOMPARE(bus.unconfirmed(), 0);
    QCOMPARE(bus.give(2), 2);
    QCOMPARE(bus.counters().sent, quint64(4));
    QCOMPARE(bus.counters().unsent, quint64(4));
}

void tst_CanBus::framesOfOneTurnDoNotWaitForEachOther()
{
    ScriptedBus bus;
    QVERIFY(bus.open(sends(1)));
    bus.turn();
    QCOMPARE(bus.give(1), 1);
    QCOMPARE(bus.give(3), 3);
    QCOMPARE(bus.unconfirmed(), 4);
}

void tst_CanBus::busWithoutSentKeysHoldsNothingBack()
{
    const auto a = join(testBus);
    QVERIFY(FakeCanBus::setAcknowledged(QStringLiteral("test"), false));
    const CanFrame frame = frameOf(1);
    for (int i = 0; i < 3; ++i) {
        QCOMPARE(a->send(&frame, 1), 1);
        receiveAll(*a);
    }
    QCOMPARE(a->unconfirmed(), 0);
}

void tst_CanBus::droppedFramesAreGivenUpAfterATime_data()
{
    QTest::addColumn<bool>("isPassive");
    QTest::addColumn<qint64>("milliseconds");
    QTest::newRow("the controller is well") << false << qint64(100);
    QTest::newRow("the controller is error passive, as without an acknowledgement") << true << qint64(10'000);
}

void tst_CanBus::droppedFramesAreGivenUpAfterATime()
{
    QFETCH(bool, isPassive);
    QFETCH(qint64, milliseconds);
    ScriptedBus bus;
    QVERIFY(bus.open(sends(1)));
    bus.isPassive = isPassive;
    bus.now = 1'000'000'000;
    QCOMPARE(bus.give(2), 2);
    bus.turn();
    bus.now += milliseconds * 1'000'000 - 1;
    QCOMPARE(bus.give(1), 0);
    bus.now += 1;
    QCOMPARE(bus.give(1), 1);
    QCOMPARE(bus.unconfirmed(), 1);
    QCOMPARE(bus.counters().failed, quint64(2));
    QCOMPARE(bus.counters().sent, quint64(1));
}

void tst_CanBus::framesInAQueueAreNotGivenUp()
{
    ScriptedBus bus;
    QVERIFY(bus.open(sends(1)));
    bus.isQueued = true;
    bus.give(2);
    bus.turn();
    bus.now += 3600'000'000'000;
    QCOMPARE(bus.give(1), 0);
    bus.isQueued = false;
    QCOMPARE(bus.give(1), 1);
}

void tst_CanBus::restartOfTheControllerEndsTheWait()
{
    ScriptedBus bus;
    QVERIFY(bus.open(sends(1)));
    bus.give(3);
    bus.turn();
    CanFrame busOff = frameOf(CAN_ERR_BUSOFF, CanFrame::Error);
    bus.incoming = {busOff};
    bus.turn();
    QCOMPARE(bus.give(1), 0);
    bus.incoming = {frameOf(CAN_ERR_RESTARTED, CanFrame::Error)};
    bus.turn();
    QCOMPARE(bus.give(1), 1);
    QCOMPARE(bus.counters().failed, quint64(3));
}

void tst_CanBus::queueOfAnUnacknowledgedBusIsShort()
{
    const auto a = join(testBus);
    const auto b = join(testBus);
    QVERIFY(FakeCanBus::setAcknowledged(QStringLiteral("test"), false));
    std::vector<CanFrame> frames;
    for (quint32 i = 0; i < 20; ++i)
        frames.push_back(frameOf(i));
    QCOMPARE(a->send(frames.data(), 20), FakeCanBus::QueueLength + 1);
    QCOMPARE(a->send(frames.data(), 20), 0);
    receiveAll(*a);
    QCOMPARE(a->state(), CanBus::Passive);
    QVERIFY(receiveAll(*b).empty());
    QVERIFY(FakeCanBus::setAcknowledged(QStringLiteral("test"), true));
    const CanFrame last = frameOf(0x777);
    QCOMPARE(a->send(&last, 1), 1);
    const auto received = receiveAll(*b);
    QCOMPARE(received.size(), std::size_t(FakeCanBus::QueueLength + 2));
    QCOMPARE(received.front().id, 0U);
    QCOMPARE(received.back().id, 0x777U);
    receiveAll(*a);
    QCOMPARE(a->state(), CanBus::Active);
}

// ---- the interface, as the kernel tells of it ----

void tst_CanBus::kernelTellsStateEchoAndOneShot()
{
    const QByteArray well = linkMessage(IFF_UP | echoFlag, CAN_STATE_ERROR_ACTIVE, 0);
    const CanLink link = CanLink::fromMessage(well.constData(), well.size());
    QCOMPARE(link.state, CanBus::Active);
    QVERIFY(link.hasEcho);
    QVERIFY(!link.isOneShot);
    const QByteArray other = linkMessage(IFF_UP, CAN_STATE_ERROR_PASSIVE, CAN_CTRLMODE_ONE_SHOT | CAN_CTRLMODE_FD);
    const CanLink otherLink = CanLink::fromMessage(other.constData(), other.size());
    QCOMPARE(otherLink.state, CanBus::Passive);
    QVERIFY(!otherLink.hasEcho);
    QVERIFY(otherLink.isOneShot);
    QCOMPARE(CanLink::read(int(if_nametoindex("lo"))).state, CanBus::Active);  // no CAN interface: the defaults
    QVERIFY(!CanLink::read(int(if_nametoindex("lo"))).isOneShot);
}

void tst_CanBus::damagedLinkMessageIsRead()
{
    const QByteArray message = linkMessage(IFF_UP, CAN_STATE_ERROR_PASSIVE, CAN_CTRLMODE_ONE_SHOT);
    for (int size = 0; size < message.size(); ++size) {
        const QByteArray part = message.left(size);  // a copy, so that a sanitizer sees what is read behind it
        QVERIFY(CanLink::fromMessage(part.constData(), part.size()).state <= CanBus::Passive);
    }
    for (int i = int(sizeof(nlmsghdr)); i < message.size(); ++i) {
        for (const char value : {'\0', '\1', '\xff'}) {
            QByteArray changed = message;
            changed[i] = value;
            QVERIFY(CanLink::fromMessage(changed.constData(), changed.size()).state <= CanBus::BusOff);
        }
    }
}

void tst_CanBus::processesExchangeFramesOverTheBus()
{
    const auto a = join(testBus);
    QProcess partner;
    partner.start(QStringLiteral(CAN_PARTNER), {testBus});
    QVERIFY(partner.waitForReadyRead());
    for (quint32 i = 0; i < 100; ++i) {
        const CanFrame frame = frameOf(i);
        a->send(&frame, 1);
    }
    quint32 expected = 0;
    QTRY_VERIFY_WITH_TIMEOUT(([&] {
                                 for (const CanFrame &frame : receiveAll(*a)) {
                                     if (frame.id != ++expected)
                                         qFatal("frame %u instead of %u", frame.id, expected);
                                 }
                                 return expected == 100;
                             }()),
                             10000);
    const CanFrame last = frameOf(CanFrame::StandardIds);
    a->send(&last, 1);
    QVERIFY(partner.waitForFinished());
    QCOMPARE(partner.exitCode(), 0);
}

void tst_CanBus::stampsFollowTheMonotonicClock()
{
    WallTimeConverter converter;
    converter.look(1000, 5'000'000'000);
    converter.drained(1000);
    converter.look(3000, 5'000'002'000);
    QCOMPARE(converter.toMonotonic(5'000'001'500), 2500LL);
    QCOMPARE(converter.toMonotonic(5'000'002'600), 3000LL);  // never in the future
}

void tst_CanBus::stampsSurviveAStepOfTheWallClock()
{
    constexpr qint64 second = 1'000'000'000;
    WallTimeConverter converter;
    converter.look(10 * second, 5000 * second);
    converter.drained(10 * second);
    converter.look(11 * second, 8601 * second);  // set forward by an hour after the frame
    QCOMPARE(converter.toMonotonic(5000 * second + second / 2), 10 * second + second / 2);
    QCOMPARE(converter.toMonotonic(8600 * second + second / 2), 10 * second + second / 2);
    QCOMPARE(converter.toMonotonic(17 * second), 11 * second);  // whatever that was
    converter.look(11 * second + 1000, 8601 * second + 1000);   // the next frames of the same queue
    QCOMPARE(converter.toMonotonic(5000 * second + second / 2), 10 * second + second / 2);
}

void tst_CanBus::virtualPluginCarriesFrames()
{
    if (!hasQtSerialBus())
        QSKIP("this build has no Qt Serial Bus (libqt5serialbus5-dev)");
    // Its usual port is one that the kernel gives away to clients, too, and keeps for a minute
    // after their end.
    const int port = 20000 + int(QCoreApplication::applicationPid() % 10000);
    const QString device = QStringLiteral("qtcan:virtualcan:tcp://127.0.0.1:%1/can0").arg(port);
    const auto a = join(device);  // its thread has the server of the plugin
    const auto b = join(device);
    // The plugin calls b connected before its server has heard of b: what is sent until then is not
    // for b.
    const CanFrame probe = frameOf(CanFrame::StandardIds);
    bool isHeard = false;
    QTRY_VERIFY_WITH_TIMEOUT((a->send(&probe, 1), isHeard = isHeard || !receiveAll(*b).empty()), 10000);
    std::vector<CanFrame> frames;
    for (quint32 i = 0; i < 50; ++i)
        frames.push_back(frameOf(i));
    QCOMPARE(a->send(frames.data(), 50), 50);
    quint32 expected = 0;
    QTRY_VERIFY_WITH_TIMEOUT(([&] {
                                 for (const CanFrame &frame : receiveAll(*b)) {
                                     if (frame.id != probe.id && frame.id != expected++)
                                         qFatal("frame %u instead of %u", frame.id, expected - 1);
                                 }
                                 return expected == 50;
                             }()),
                             10000);
    const CanFrame last = frameOf(0x123);
    QCOMPARE(b->send(&last, 1), 1);
    b->close();
    QTRY_COMPARE_WITH_TIMEOUT((receiveAll(*a), a->counters().received), quint64(1), 10000);
}

void tst_CanBus::missingPluginIsNamed()
{
    if (!hasQtSerialBus())
        QSKIP("this build has no Qt Serial Bus (libqt5serialbus5-dev)");
    QString error;
    const auto bus = CanBus::make(QStringLiteral("qtcan:nosuchplugin:can0"), &error);
    QVERIFY(!bus->open(everything()));
    QVERIFY2(
        bus->errorString().startsWith(QLatin1String("Qt Serial Bus has no device 'can0' of plugin 'nosuchplugin'")),
        qPrintable(bus->errorString()));
}

QTEST_GUILESS_MAIN(tst_CanBus)
#include "tst_CanBus.moc"
