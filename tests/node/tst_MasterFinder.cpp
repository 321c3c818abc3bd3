// SPDX-License-Identifier: Apache-2.0
#include "../common/RuntimeFolder.h"
#include "../common/Waiting.h"
#include "NodeFixtures.h"
#include "VirtualTime.h"
#include "node/session/MasterBeacon.h"
#include "node/session/MasterFinder.h"

#include <QtNetwork/QNetworkInterface>
#include <QtNetwork/QUdpSocket>

using qplc::Beacon;
using qplc::FoundMaster;
using qplc::MasterFinder;
using namespace std::chrono_literals;

/// Masters are found without an address: on this machine by their notices, on networks by their
/// beacons. Files and datagrams are those of the machine; the timers that look at them are in
/// virtual time.
class tst_MasterFinder : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        m_folder = std::make_unique<RuntimeFolder>();
        m_machine = std::make_unique<OnTheMachine>();
    }
    void cleanup()
    {
        m_machine.reset();
        m_folder.reset();
    }
    void localMasterIsFoundAndItsEndIsNoticed();
    void theNameOfAMasterIsShown();
    void networkMastersAreFoundAndOneDisappears();
    void theFirstBeaconIsSentAtOnce();
    void masterSendsNoBeaconByDefault();
    void localMasterWithABeaconIsListedOnce();
    void beaconExpiresAfterSixSecondsOfSilence();
    void malformedBeaconsAreIgnored();
    void floodOfBeaconsIsLimitedByTheListSize();
    void aFloodOfDatagramsIsReadInPortions();
    void repeatedBeaconIsListedOnce();
    void namesAreSanitizedForDisplay_data();
    void namesAreSanitizedForDisplay();
    void localMastersAreFoundWithoutMulticast();
    void stopClearsTheList();

private:
    struct FakeClock : qplc::TimeSource
    {
        std::int64_t now() noexcept override { return time; }
        bool sleepUntil(std::int64_t deadline) noexcept override { return time = deadline, true; }
        std::int64_t time = 1'000'000'000;
    };
    /// That of the timers.
    struct VirtualClock : qplc::TimeSource
    {
        std::int64_t now() noexcept override { return simulator.now(); }
        bool sleepUntil(std::int64_t deadline) noexcept override
        {
            simulator.runFor(deadline - now());
            return true;
        }
        bool waits(const std::function<bool()> &isReached, std::chrono::nanoseconds longest)
        {
            return simulator.runUntil(isReached, longest.count());
        }
        qplc::Simulator &simulator = static_cast<qplc::Simulator &>(*QAbstractEventDispatcher::instance());
    };
    static void hear(MasterFinder &finder, const Beacon &beacon, const char *sender = "192.0.2.77")
    {
        const QByteArray bytes = beacon.encoded();
        finder.handle(bytes.constData(), bytes.size(), QHostAddress(QLatin1String(sender)));
    }
    static QString addressOf(const QPlcMasterNode &master)
    {
        return QStringLiteral("127.0.0.1:%1").arg(master.serverPort());
    }
    static const FoundMaster *find(const QVector<FoundMaster> &masters, const QString &address)
    {
        const auto isIt = [&](const FoundMaster &master) { return master.address == address; };
        const auto found = std::find_if(masters.begin(), masters.end(), isIt);
        return found == masters.end() ? nullptr : &*found;
    }
    static bool finds(const MasterFinder &finder, const QPlcMasterNode &master)
    {
        const QVector<FoundMaster> masters = finder.masters();
        return find(masters, addressOf(master)) != nullptr;
    }
    /// Masters are not seen as those of this machine from now on.
    static void hideNotices() { qputenv("XDG_RUNTIME_DIR", "/proc/nowhere"); }

    static constexpr std::chrono::milliseconds heard = 250ms;  // the longest time to the next look at datagrams
    static constexpr std::chrono::milliseconds noticed = 1s;   // and at notices
    static constexpr std::chrono::milliseconds interval{qplc::MasterBeacon::Interval};
    static constexpr std::chrono::nanoseconds lifetime{MasterFinder::Lifetime};
    std::unique_ptr<RuntimeFolder> m_folder;
    std::unique_ptr<OnTheMachine> m_machine;
};

void tst_MasterFinder::localMasterIsFoundAndItsEndIsNoticed()
{
    VirtualClock clock;
    MasterFinder finder(nullptr, clock);
    QSignalSpy changed(&finder, &MasterFinder::changed);
    finder.start();
    TestMaster master;
    QVERIFY(master.listen());
    QVERIFY(clock.waits([&] { return finds(finder, master); }, noticed));
    const QVector<FoundMaster> masters = finder.masters();
    QVERIFY(masters.constFirst().isLocal && !masters.constFirst().isSecured);
    QCOMPARE(masters.constFirst().tableHash, master.signalTable().hash());
    QCOMPARE(changed.count(), 1);
    master.stopServer();
    QVERIFY(clock.waits([&] { return finder.masters().isEmpty(); }, noticed));
    QCOMPARE(changed.count(), 2);
}

void tst_MasterFinder::theNameOfAMasterIsShown()
{
    TestMaster named;
    named.setLocalName(QStringLiteral("north-winch"));
    QVERIFY(named.listen());
    TestMaster nameless;
    QVERIFY(nameless.listen());
    MasterFinder finder;
    finder.start();  // looks at once
    const QVector<FoundMaster> masters = finder.masters();
    QCOMPARE(masters.size(), 2);
    QCOMPARE(find(masters, addressOf(named))->name, QStringLiteral("north-winch"));
    QCOMPARE(find(masters, addressOf(nameless))->name, QCoreApplication::applicationName());
}

void tst_MasterFinder::networkMastersAreFoundAndOneDisappears()
{
    hideNotices();
    VirtualClock clock;
    MasterFinder finder(nullptr, clock);
    finder.start();
    TestMaster one, other;
    for (TestMaster *master : {&one, &other}) {
        master->setBeacon(true);
        QVERIFY(master->listen());
    }
    QVERIFY(clock.waits([&] { return finds(finder, one) && finds(finder, other); }, heard));
    const QVector<FoundMaster> masters = finder.masters();
    QVERIFY(!find(masters, addressOf(one))->isLocal);
    QCOMPARE(find(masters, addressOf(one))->tableHash, one.signalTable().hash());
    const QString gone = addressOf(one);
    one.stopServer();
    QVERIFY(!clock.waits([&] { return !find(finder.masters(), gone); }, lifetime - interval));
    QVERIFY(clock.waits([&] { return !find(finder.masters(), gone); }, interval + heard));
    QVERIFY(finds(finder, other));
}

void tst_MasterFinder::theFirstBeaconIsSentAtOnce()
{
    QUdpSocket ear;
    QVERIFY(
        ear.bind(QHostAddress::AnyIPv4, Beacon::GroupPort, QUdpSocket::ShareAddress | QUdpSocket::ReuseAddressHint));
    for (const QNetworkInterface &network : QNetworkInterface::allInterfaces()) {
        if (network.flags().testFlag(QNetworkInterface::IsLoopBack))
            QVERIFY(ear.joinMulticastGroup(QHostAddress(QLatin1String(Beacon::Group)), network));
    }
    Beacon content;
    content.port = 12345;
    content.name = QStringLiteral("the first one");
    qplc::MasterBeacon beacon;
    beacon.begin(QHostAddress::LocalHost, content, true);
    bool isHeard = false;
    while (ear.hasPendingDatagrams()) {
        QByteArray bytes(int(ear.pendingDatagramSize()), '\0');
        ear.readDatagram(bytes.data(), bytes.size());
        isHeard = isHeard || bytes == content.encoded();
    }
    QVERIFY(isHeard);
}

void tst_MasterFinder::masterSendsNoBeaconByDefault()
{
    hideNotices();
    VirtualClock clock;
    MasterFinder finder(nullptr, clock);
    finder.start();
    TestMaster silent, loud;
    QVERIFY(silent.listen());
    loud.setBeacon(true);
    QVERIFY(loud.listen());
    QVERIFY(clock.waits([&] { return finds(finder, loud); }, heard));
    QVERIFY(!clock.waits([&] { return finds(finder, silent); }, interval + heard));
}

void tst_MasterFinder::localMasterWithABeaconIsListedOnce()
{
    TestMaster master;
    master.setBeacon(true);
    VirtualClock clock;
    MasterFinder finder(nullptr, clock);
    finder.start();
    QVERIFY(master.listen());
    QVERIFY(clock.waits([&] { return finds(finder, master); }, noticed));
    clock.simulator.runFor(std::chrono::nanoseconds(interval + heard).count());
    QCOMPARE(finder.masters().size(), 1);
    QVERIFY(finder.masters().constFirst().isLocal);
}

void tst_MasterFinder::beaconExpiresAfterSixSecondsOfSilence()
{
    FakeClock clock;
    MasterFinder finder(nullptr, clock);
    hear(finder, {50000, false, 1, QStringLiteral("one")});
    clock.time += 3'000'000'000;
    hear(finder, {50001, true, 2, QStringLiteral("other")});
    finder.look();
    QCOMPARE(finder.masters().size(), 2);
    QCOMPARE(finder.masters().constFirst().address, QStringLiteral("192.0.2.77:50000"));  // "one" < "other"
    QVERIFY(!finder.masters().constFirst().isSecured && finder.masters().constLast().isSecured);
    clock.time += 3'000'000'000;  // 6 s, and not more
    finder.look();
    QCOMPARE(finder.masters().size(), 2);
    clock.time += 1;
    finder.look();
    QCOMPARE(finder.masters().size(), 1);
    QCOMPARE(finder.masters().constFirst().name, QStringLiteral("other"));
}

void tst_MasterFinder::malformedBeaconsAreIgnored()
{
    MasterFinder finder;
    QSignalSpy changed(&finder, &MasterFinder::changed);
    const QByteArray good = Beacon{50000, false, 1, QStringLiteral("kite")}.encoded();
    for (const QByteArray &bytes : {QByteArray(), QByteArray("x"), QByteArray(1000, '\xff'), good.chopped(1),
                                    good + good, QByteArray("QPLB"), "QPLC" + good.mid(4)})
        finder.handle(bytes.constData(), bytes.size(), QHostAddress(QStringLiteral("192.0.2.77")));
    finder.handle(good.constData(), good.size(), QHostAddress(QStringLiteral("fe80::1")));  // beacons travel over IPv4
    finder.look();
    QVERIFY(finder.masters().isEmpty());
    QCOMPARE(changed.count(), 0);
}

void tst_MasterFinder::floodOfBeaconsIsLimitedByTheListSize()
{
    FakeClock clock;
    MasterFinder finder(nullptr, clock);
    const Beacon first{1, false, 0, QStringLiteral("the first")};
    hear(finder, first);
    for (int port = 2; port < 1000; ++port)
        hear(finder, {quint16(port), false, 0, QStringLiteral("liar %1").arg(port)});
    finder.look();
    QCOMPARE(finder.masters().size(), int(MasterFinder::MostBeacons));
    QCOMPARE(finder.masters().constLast().name, first.name);  // who was there stays
    clock.time += MasterFinder::Lifetime + 1;
    finder.look();
    QVERIFY(finder.masters().isEmpty());
}

void tst_MasterFinder::aFloodOfDatagramsIsReadInPortions()
{
    hideNotices();
    FakeClock clock;
    MasterFinder finder(nullptr, clock);
    finder.start();
    QUdpSocket liar;
    QVERIFY(liar.bind(QHostAddress::LocalHost, 0));
    const QList<QNetworkInterface> networks = QNetworkInterface::allInterfaces();
    for (const QNetworkInterface &network : networks) {
        if (network.flags().testFlag(QNetworkInterface::IsLoopBack))
            liar.setMulticastInterface(network);
    }
    const auto send = [&](const QByteArray &bytes) {
        liar.writeDatagram(bytes, QHostAddress(QLatin1String(Beacon::Group)), Beacon::GroupPort);
    };
    for (int i = 0; i < MasterFinder::DatagramsAtOnce; ++i)
        send(QByteArray(i, 'x'));
    send(Beacon{60000, false, 0, QStringLiteral("behind garbage")}.encoded());
    finder.look();
    QVERIFY(finder.masters().isEmpty());  // its turn comes
    finder.look();
    QCOMPARE(finder.masters().size(), 1);
}

void tst_MasterFinder::repeatedBeaconIsListedOnce()
{
    MasterFinder finder;
    QSignalSpy changed(&finder, &MasterFinder::changed);
    for (int i = 0; i < 10; ++i) {
        hear(finder, {50000, false, 1, QStringLiteral("kite")});
        finder.look();
    }
    QCOMPARE(changed.count(), 1);
    hear(finder, {50000, false, 1, QStringLiteral("a new name")});
    hear(finder, {50000, false, 1, QStringLiteral("kite")}, "192.0.2.78");  // another machine
    finder.look();
    QCOMPARE(changed.count(), 2);
    QCOMPARE(finder.masters().size(), 2);
    QCOMPARE(finder.masters().constFirst().name, QStringLiteral("a new name"));
}

void tst_MasterFinder::namesAreSanitizedForDisplay_data()
{
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("shown");
    const auto text = [](const char *utf8) { return QString::fromUtf8(utf8); };
    QTest::newRow("plain") << text("Höhenwind 3") << text("Höhenwind 3");
    QTest::newRow("commands of a terminal") << text("a\x1b[2Jb\x07") << text("a?[2Jb?");
    QTest::newRow("lines") << text("one\ntwo\tthree ") << text("one two three");
    QTest::newRow("turned text") << text("kite\u202Eelbisivni") << text("kite?elbisivni");
    QTest::newRow("nothing to be seen") << text("\u200B\u200B") << text("??");
    QTest::newRow("40 characters") << QString(40, QLatin1Char('x')) << QString(40, QLatin1Char('x'));
    QTest::newRow("41 characters") << QString(41, QLatin1Char('x')) << QString(39, QLatin1Char('x')) + text("…");
}

void tst_MasterFinder::namesAreSanitizedForDisplay()
{
    QFETCH(QString, name);
    MasterFinder finder;
    hear(finder, {50000, false, 1, name});
    finder.look();
    QCOMPARE(finder.masters().size(), 1);
    QTEST(finder.masters().constFirst().name, "shown");
}

void tst_MasterFinder::localMastersAreFoundWithoutMulticast()
{
    LogCapture log;
    QUdpSocket other;  // has the port for itself
    QVERIFY(other.bind(QHostAddress(QLatin1String(Beacon::Group)), Beacon::GroupPort, QUdpSocket::DontShareAddress));
    TestMaster master;
    master.setBeacon(true);
    QVERIFY(master.listen());
    const int said = log.all().size();
    VirtualClock clock;
    MasterFinder finder(nullptr, clock);
    finder.start();
    QVERIFY(clock.waits([&] { return finds(finder, master); }, noticed));
    QVERIFY2(log.all().size() == said, qPrintable(log.all().join(QLatin1Char(10))));
}

void tst_MasterFinder::stopClearsTheList()
{
    TestMaster master;
    QVERIFY(master.listen());
    MasterFinder finder;
    finder.start();
    hear(finder, {50000, false, 1, QStringLiteral("kite")});
    finder.look();
    QCOMPARE(finder.masters().size(), 2);
    finder.stop();
    QVERIFY(finder.masters().isEmpty());
    finder.look();
    QVERIFY(finder.masters().isEmpty());
    finder.start();
    QVERIFY(finds(finder, master));
}

QTPLC_VIRTUAL_TIME_MAIN(tst_MasterFinder)
#include "tst_MasterFinder.moc"
