// SPDX-License-Identifier: Apache-2.0
#include "NodeFixtures.h"
#include "PairTransport.h"
#include "ScriptedNode.h"
#include "realtime/Host.h"
#include "transport/CyclicHub.h"
#include "transport/TransportRegistry.h"

#include <QtCore/QFile>
#include <QtTest/QtTest>

#include <algorithm>

using qplc::ChannelError;
using qplc::ControlEnds;
using qplc::CyclicHub;
using qplc::Newcomer;
using qplc::SocketAddress;
using qplc::TransportKind;
using qplc::TransportRegistry;

// A transport is its own files and a row; one that joins at run time is like those of the library.
class tst_TransportRegistry : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void registryNumbersMatchTheTransportKinds();
    void addressesAcceptAddedTransports();
    void masterAndNodeRunOverAnAddedTransport_data();
    void masterAndNodeRunOverAnAddedTransport();
    void unsuitableTransportIsRefusedWithTheReason();
    void unknownAddressErrorListsKnownTransports();
    void unknownChannelErrorListsKnownTransports();
    void usedOrInvalidTransportNameIsRefused_data();
    void usedOrInvalidTransportNameIsRefused();
    void documentNamesTheFieldsOfEachTransport();
};

namespace {

QPlcUnderlyingProtocol address(const QString &kind, const TestMaster &master)
{
    return QPlcUnderlyingProtocol::fromString(QStringLiteral("%1://127.0.0.1:%2").arg(kind).arg(master.serverPort()));
}

/// A row that has a name only.
class NamedKind final : public TransportKind
{
public:
    explicit NamedKind(QString name)
        : m_name(std::move(name))
    {
    }
    QString name() const override { return m_name; }
    bool admits(const CyclicHub &, const Newcomer &, ChannelError *) const override { return true; }

private:
    const QString m_name;
};

}  // namespace

void tst_TransportRegistry::initTestCase()
{
    QString error;
    QVERIFY2(TransportRegistry::instance().add(std::make_unique<PairKind>(), &error), qPrintable(error));
}

void tst_TransportRegistry::registryNumbersMatchTheTransportKinds()
{
    const TransportRegistry &registry = TransportRegistry::instance();
    QCOMPARE(registry.numberOf("tcp"), int(QPlcUnderlyingProtocol::Tcp));
    QCOMPARE(registry.numberOf("udp"), int(QPlcUnderlyingProtocol::Udp));
    QCOMPARE(registry.numberOf("udp-multicast"), int(QPlcUnderlyingProtocol::UdpMulticast));
    QCOMPARE(registry.numberOf("local"), int(QPlcUnderlyingProtocol::Local));
    QCOMPARE(registry.numberOf("auto"), int(QPlcUnderlyingProtocol::Automatic));
    QCOMPARE(registry.numberOf("pair"), int(QPlcUnderlyingProtocol::Automatic) + 1);
    QCOMPARE(registry.numberOf("invalid"), int(QPlcUnderlyingProtocol::Invalid));
    QVERIFY(!registry.at(0) && !registry.at(7) && !registry.named("invalid"));
}

void tst_TransportRegistry::addressesAcceptAddedTransports()
{
    const auto pair = QPlcUnderlyingProtocol::fromString(QStringLiteral("pair://localhost:4711"));
    QVERIFY(pair.isValid());
    QCOMPARE(pair.kindName(), QString("pair"));
    QCOMPARE(pair.toString(), QString("pair://127.0.0.1:4711"));
    QVERIFY(pair != QPlcUnderlyingProtocol::udp(QHostAddress::LocalHost, 4711));
}

void tst_TransportRegistry::masterAndNodeRunOverAnAddedTransport_data()
{
    QTest::addColumn<QString>("counterKind");
    QTest::addColumn<QString>("echoKind");
    QTest::newRow("alone") << "pair"
                           << "pair";
    QTest::newRow("beside udp") << "pair"
                                << "udp";
    QTest::newRow("beside tcp") << "tcp"
                                << "pair";
    QTest::newRow("beside shared memory") << "local"
                                          << "pair";
}

void tst_TransportRegistry::masterAndNodeRunOverAnAddedTransport()
{
    QFETCH(QString, counterKind);
    QFETCH(QString, echoKind);
    const auto digestOver = [](const QString &first, const QString &second) {
        TestMaster master;
        master.setCycleLimit(500);
        CounterNode counter;
        EchoNode echo;
        if (!master.listen() || !counter.connectToMasterAndWaitForConnected(address(first, master))
            || !echo.connectToMasterAndWaitForConnected(address(second, master)) || !master.startRealTime()
            || !master.waitForState(QPlcMasterNode::Off))
            qFatal("%s %s %s", qPrintable(master.errorString()), qPrintable(counter.errorString()),
                   qPrintable(echo.errorString()));
        const QVector<QPlcNodeInfo> nodes = master.nodes();
        const auto hasKind = [&](const QString &name, const QString &kind) {
            return std::any_of(nodes.begin(), nodes.end(),
                               [&](const QPlcNodeInfo &node) { return node.name == name && node.transport == kind; });
        };
        const bool areNamed = hasKind(counter.name(), first) && hasKind(echo.name(), second);
        counter.disconnectFromMaster();
        echo.disconnectFromMaster();
        return areNamed && master.signalValue("count").toInt() == 500 ? master.statistics().imageDigest : 0;
    };
    const quint64 digest = digestOver(counterKind, echoKind);
    QVERIFY(digest != 0);
    QCOMPARE(digest, digestOver("tcp", "tcp"));
}

void tst_TransportRegistry::unsuitableTransportIsRefusedWithTheReason()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode node;
    node.cyclic = QStringLiteral("udp-multicast");
    QVERIFY(node.connectTo(master.serverPort()));
    node.send(QPlcMessage::Hello, node.helloFields());
    QCOMPARE(node.next().kind(), QPlcMessage::Hello);
    node.send(QPlcMessage::Register, node.registerFields());
    const QPlcMessage answer = node.next();
    QCOMPARE(answer.kind(), QPlcMessage::Rejected);
    QCOMPARE(answer.text("text"), QString("this master has no multicast group; give it one, or use udp"));
}

void tst_TransportRegistry::unknownAddressErrorListsKnownTransports()
{
    QString error;
    QVERIFY(!QPlcUnderlyingProtocol::fromString("pigeon://127.0.0.1", QPlcUnderlyingProtocol::Tcp, &error).isValid());
    QCOMPARE(
        error,
        QString("unknown transport 'pigeon://'; use tcp://, udp://, udp-multicast://, local://, auto:// or pair://"));
}

void tst_TransportRegistry::unknownChannelErrorListsKnownTransports()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode node;
    node.cyclic = QStringLiteral("pigeon");
    QVERIFY(node.connectTo(master.serverPort()));
    node.send(QPlcMessage::Hello, node.helloFields());
    QCOMPARE(node.next().kind(), QPlcMessage::Hello);
    node.send(QPlcMessage::Register, node.registerFields());
    const QPlcMessage answer = node.next();
    QCOMPARE(answer.kind(), QPlcMessage::Rejected);
    QCOMPARE(answer.text("text"),
             QString("unknown cyclic channel 'pigeon'; use tcp, udp, udp-multicast, local, auto or pair"));
}

void tst_TransportRegistry::usedOrInvalidTransportNameIsRefused_data()
{
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("expected");
    QTest::newRow("of the library") << "udp"
                                    << "transport 'udp' exists already; use another name than tcp, udp, udp-multicast, "
                                       "local, auto or pair";
    QTest::newRow("of one that has joined") << "pair"
                                            << "transport 'pair' exists already; use another name than tcp, udp, "
                                               "udp-multicast, local, auto or pair";
    QTest::newRow("empty") << ""
                           << "'' is not a valid name of a transport; use small letters, digits and '-'";
    QTest::newRow("none for addresses")
        << "my:bus"
        << "'my:bus' is not a valid name of a transport; use small letters, digits and '-'";
}

void tst_TransportRegistry::usedOrInvalidTransportNameIsRefused()
{
    QFETCH(QString, name);
    QFETCH(QString, expected);
    const std::size_t before = TransportRegistry::instance().kinds().size();
    QString error;
    QVERIFY(!TransportRegistry::instance().add(std::make_unique<NamedKind>(name), &error));
    QCOMPARE(error, expected);
    QCOMPARE(TransportRegistry::instance().kinds().size(), before);
}

void tst_TransportRegistry::documentNamesTheFieldsOfEachTransport()
{
    QFile file(QStringLiteral(PROTOCOL_DOCUMENT));
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QString document = QString::fromUtf8(file.readAll());
    const QHostAddress here(QHostAddress::LocalHost);
    CyclicHub hub;
    QString error;
    QVERIFY2(hub.open(SocketAddress(here, 0), &error), qPrintable(error));
    const quint64 session = qplc::Host::machine().random();
    QStringList names;
    for (int number = QPlcUnderlyingProtocol::Tcp; number <= QPlcUnderlyingProtocol::Local; ++number) {
        const TransportKind *kind = TransportRegistry::instance().at(number);
        QVERIFY2(kind->open(hub, {here, QHostAddress("239.255.76.69"), false, session}, &error), qPrintable(error));
        std::unique_ptr<qplc::CyclicLink> link;
        Newcomer node;
        node.address = here;
        const ControlEnds ends{SocketAddress(here, 1), SocketAddress(here, 2), session, {}};
        QVERIFY2(kind->beginLink(ends, &node.request, &link, &error), qPrintable(error));
        QJsonObject answer;
        ChannelError refusal;
        QVERIFY2(kind->admits(hub, node, &refusal), qPrintable(refusal.text));
        QVERIFY2(kind->hasStreams() || kind->makePeer(hub, node, &answer, &refusal), qPrintable(refusal.text));
        names += node.request.keys() + answer.keys();
        QVERIFY2(document.contains(QStringLiteral("`%1`").arg(kind->name())), qPrintable(kind->name()));
    }
    names.removeDuplicates();
    QCOMPARE(names.size(), 4);
    for (const QString &name : names)
        QVERIFY2(document.contains(QStringLiteral("`%1`").arg(name)), qPrintable(name));
}

QTEST_GUILESS_MAIN(tst_TransportRegistry)
#include "tst_TransportRegistry.moc"
