// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedMaster.h"
#include "node/api/QPlcSlaveNodePrivate.h"
#include "node/cycle/SlaveCycle.h"

#include <QtCore/QDir>
#include <QtCore/QElapsedTimer>

// One datagram for many nodes.
class tst_Multicast : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void multicastDatagramsCarryInputsOfManyNodes();
    void joiningNodeDoesNotDisturbOthers();
    void masterWithoutAGroupRefusesMulticastNodes();
    void sameCycleNodesAreRefusedOverMulticast();
    void inputsThatFillMoreThanADatagramAreRefused();
    void invalidGroupAddressIsReported_data();
    void invalidGroupAddressIsReported();
    void datagramsOfOtherMastersAreIgnored();
    void datagramsForOthersDoNotResetTheWatchdog();
    void inputsLieInsideOfTheDatagram_data();
    void inputsLieInsideOfTheDatagram();
    void aNodeThatLeavesKeepsNothingOpen();

private:
    static QPlcUnderlyingProtocol protocol(const QPlcMasterNode &master)
    {
        return QPlcUnderlyingProtocol::udpMulticast(QHostAddress::LocalHost, master.serverPort());
    }
};

namespace {

const QHostAddress group(QStringLiteral("239.255.76.68"));

/// Reads in<N> (RealTriple) and writes its sum to out<N>.
class Summer : public QPlcCompactSlaveNode
{
public:
    explicit Summer(int number)
        : QPlcCompactSlaveNode(QStringLiteral("Summer%1").arg(number), ErrorWait)
        , m_in(this, "in" + QByteArray::number(number))
        , m_out(this, "out" + QByteArray::number(number))
    {
    }

private:
    void step(const QPlcCycle &) override { m_out = m_in.value()[0] + m_in.value()[1] + m_in.value()[2]; }
    QPlcInput<std::array<double, 3>> m_in;
    QPlcOutput<double> m_out;
};

QPlcSignalTable manySignals(int nodes)
{
    QByteArray ini;
    for (int i = 0; i < nodes; ++i)
        ini += "[in" + QByteArray::number(i) + "]\ntype = Real64Triple\n[out" + QByteArray::number(i)
            + "]\ntype = Real64\n";
    return QPlcSignalTable::fromIni(ini);
}

}  // namespace

void tst_Multicast::multicastDatagramsCarryInputsOfManyNodes()
{
    constexpr int count = 100;  // 2400 bytes of inputs: two parts
    TestMaster master(QPlcClock::lockstep(), manySignals(count));
    master.setMulticastGroup(group);
    master.setCycleLimit(50);
    QVERIFY2(master.listen(), qPrintable(master.errorString()));
    std::vector<std::unique_ptr<Summer>> nodes;
    for (int i = 0; i < count; ++i) {
        nodes.push_back(std::make_unique<Summer>(i));
        QVERIFY2(nodes.back()->connectToMasterAndWaitForConnected(protocol(master)),
                 qPrintable(nodes.back()->errorString()));
        QVERIFY(
            master.setSignalValue(QStringLiteral("in%1").arg(i), QPlcValue(std::array<double, 3>{1.0 * i, 0.5, 0.25})));
    }
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    for (int i = 0; i < count; ++i) {
        QCOMPARE(master.signalValue(QStringLiteral("out%1").arg(i)).toReal(), i + 0.75);
        QCOMPARE(nodes[std::size_t(i)]->counters().rejected, quint64(0));  // the other part is no error
        QCOMPARE(nodes[std::size_t(i)]->counters().cycles, quint64(50));
        nodes[std::size_t(i)]->disconnectFromMaster();
    }
}

void tst_Multicast::joiningNodeDoesNotDisturbOthers()
{
    TestMaster master(QPlcClock::lockstep(), manySignals(3));
    master.setMulticastGroup(group);
    QVERIFY(master.listen());
    Summer first(0);
    Summer second(1);
    Summer third(2);
    for (int i = 0; i < 3; ++i)
        master.setSignalValue(QStringLiteral("in%1").arg(i), QPlcValue(std::array<double, 3>{1.0, 2.0, double(i)}));
    QVERIFY(first.connectToMasterAndWaitForConnected(protocol(master)));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(20));
    QVERIFY(second.connectToMasterAndWaitForConnected(protocol(master)));
    QVERIFY(third.connectToMasterAndWaitForConnected(protocol(master)));
    QTRY_VERIFY(third.counters().cycles > 10 && second.counters().cycles > 10);
    second.disconnectFromMaster();
    QTRY_COMPARE(master.nodes().size(), 2);
    const quint64 before = third.counters().cycles;
    QTRY_VERIFY(third.counters().cycles > before + 10);
    master.stop();
    QCOMPARE(first.counters().missed, quint64(0));
    QCOMPARE(first.counters().rejected + third.counters().rejected, quint64(0));
    QCOMPARE(master.signalValue("out2").toReal(), 5.0);
    first.disconnectFromMaster();
    third.disconnectFromMaster();
}

void tst_Multicast::masterWithoutAGroupRefusesMulticastNodes()
{
    TestMaster master(QPlcClock::lockstep(), manySignals(1));
    QVERIFY(master.listen());
    Summer node(0);
    QVERIFY(!node.connectToMasterAndWaitForConnected(protocol(master)));
    QVERIFY2(node.errorString().contains("no multicast group"), qPrintable(node.errorString()));
}

void tst_Multicast::sameCycleNodesAreRefusedOverMulticast()
{
    TestMaster master(QPlcClock::lockstep(), manySignals(1));
    master.setMulticastGroup(group);
    QVERIFY(master.listen());
    Summer node(0);
    node.setSameCycle(true);
    QVERIFY(!node.connectToMasterAndWaitForConnected(protocol(master)));
    QVERIFY2(node.errorString().contains("asked alone"), qPrintable(node.errorString()));
}

void tst_Multicast::inputsThatFillMoreThanADatagramAreRefused()
{
    class Wide : public QPlcCompactSlaveNode
    {
    public:
        Wide()
            : QPlcCompactSlaveNode(QStringLiteral("Wide"))
        {
        }
        void step(const QPlcCycle &) override {}
        QPlcInput<std::array<double, 180>> m_a{this, "a"};
        QPlcInput<double> m_b{this, "b"};
        QPlcInput<double> m_c{this, "c"};
    } node;
    TestMaster master(QPlcClock::lockstep(),
                      QPlcSignalTable::fromIni("[a]\ntype = Real64[180]\n[b]\ntype = Real64\n[c]\ntype = Real64\n"));
    master.setMulticastGroup(group);
    QVERIFY(master.listen());
    QVERIFY(!node.connectToMasterAndWaitForConnected(protocol(master)));
    QVERIFY2(node.errorString().contains("1456 bytes of inputs"), qPrintable(node.errorString()));
}

void tst_Multicast::invalidGroupAddressIsReported_data()
{
    QTest::addColumn<QString>("address");
    QTest::newRow("no multicast address") << "10.0.0.1";
    QTest::newRow("IPv6") << "ff02::1";
}

void tst_Multicast::invalidGroupAddressIsReported()
{
    QFETCH(QString, address);
    TestMaster master(QPlcClock::lockstep(), manySignals(1));
    master.setMulticastGroup(QHostAddress(address));
    QVERIFY(!master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)));
    QVERIFY2(master.errorString().contains(address), qPrintable(master.errorString()));
    QCOMPARE(master.serverPort(), quint16(0));
    master.setMulticastGroup(QHostAddress());
    QVERIFY(master.listen());
}

/// Two masters may share a group: each has a port and a session of its own.
void tst_Multicast::datagramsOfOtherMastersAreIgnored()
{
    TestMaster one(QPlcClock::lockstep(), manySignals(1));
    TestMaster other(QPlcClock::lockstep(), manySignals(1));
    Summer node(0);
    Summer otherNode(0);
    for (TestMaster *master : {&one, &other}) {
        master->setMulticastGroup(group);
        QVERIFY(master->listen());
    }
    QVERIFY(node.connectToMasterAndWaitForConnected(protocol(one)));
    QVERIFY(otherNode.connectToMasterAndWaitForConnected(protocol(other)));
    QVERIFY(one.startRealTime());
    QVERIFY(other.startRealTime());
    QVERIFY(one.waitForCycles(50));
    QVERIFY(other.waitForCycles(50));
    one.stop();
    other.stop();
    QCOMPARE(node.counters().rejected + otherNode.counters().rejected, quint64(0));
    node.disconnectFromMaster();
    otherNode.disconnectFromMaster();
}

/// A link on which only the part of other nodes ever comes.
class LinkOfOthers : public qplc::CyclicLink
{
public:
    LinkOfOthers()
        : CyclicLink(-1)
    {
    }
    Status receive(const char **frame, std::size_t *size) noexcept override { return poll(frame, size); }
    Status poll(const char **frame, std::size_t *size) noexcept override
    {
        *frame = m_frame.data();
        *size = m_frame.size();
        return Received;
    }
    bool send(const char *, std::size_t) noexcept override { return true; }

private:
    std::array<char, 40> m_frame{};  // part 0
};

void tst_Multicast::datagramsForOthersDoNotResetTheWatchdog()
{
    Summer node(0);
    qplc::NodeRuntime &runtime = QPlcSlaveNodePrivate::of(node).runtime;
    QString error;
    QVERIFY2(runtime.bind(manySignals(1), &error), qPrintable(error));
    qplc::SlaveCycle cycle(runtime, {1, 1}, false);
    cycle.setLink(std::make_unique<LinkOfOthers>());
    qplc::SlaveCycle::Phase phase;
    phase.period = std::chrono::milliseconds(1);
    phase.watchdog = std::chrono::milliseconds(10);
    phase.longestStart = std::chrono::nanoseconds(0);
    phase.group = {1, 2, 26, 5};
    QVERIFY2(cycle.start(phase), qPrintable(cycle.errorString()));
    QTRY_COMPARE(cycle.counters().watchdog, quint64(1));
    cycle.stop();
    QCOMPARE(cycle.counters().rejected + cycle.counters().cycles, quint64(0));
}

void tst_Multicast::inputsLieInsideOfTheDatagram_data()
{
    QTest::addColumn<int>("offset");
    QTest::addColumn<int>("size");
    QTest::addColumn<bool>("isGood");
    QTest::newRow("behind the number of the part") << 2 << 26 << true;
    QTest::newRow("at the end") << 16 << 40 << true;
    QTest::newRow("in the number of the part") << 1 << 26 << false;
    QTest::newRow("before the datagram") << -8 << 26 << false;
    QTest::newRow("beyond the end") << 17 << 40 << false;
}

void tst_Multicast::inputsLieInsideOfTheDatagram()
{
    QFETCH(int, offset);
    QFETCH(int, size);
    QFETCH(bool, isGood);
    constexpr quint64 hash = 5;
    ScriptedMaster master(manySignals(1));
    Summer node(0);
    QVERIFY(master.admit(node, master.udp()));
    QJsonObject fields = master.startFields("Lockstep");
    fields.insert("group",
                  QJsonObject{{"part", 0}, {"offset", offset}, {"size", size}, {"hash", QPlcMessage::fromHex64(hash)}});
    QVERIFY(master.startWith(fields));
    const qplc::FrameEncoder encoder(qplc::FrameKind::GroupInputs, {ScriptedMaster::Session, 0, hash},
                                     {0, std::uint32_t(size)});
    qplc::FrameHeader header;
    header.cycle = master.first;
    QByteArray frame(int(encoder.partSize(0)), '\0');
    encoder.encode(0, header, QByteArray(size, '\0').constData(), frame.data());
    master.sendFrame(frame);
    QTRY_COMPARE(node.counters().cycles + node.counters().rejected, quint64(1));
    QCOMPARE(node.counters().cycles, quint64(isGood ? 1 : 0));
}

void tst_Multicast::aNodeThatLeavesKeepsNothingOpen()
{
    const auto openDescriptors
        = [] { return QDir("/proc/self/fd").entryList(QDir::AllEntries | QDir::System | QDir::NoDotAndDotDot).size(); };
    TestMaster master(QPlcClock::lockstep(), manySignals(1));
    master.setMulticastGroup(group);
    QVERIFY(master.listen());
    int before = 0;
    for (int turn = 0; turn < 3; ++turn) {
        Summer node(0);
        QVERIFY(node.connectToMasterAndWaitForConnected(protocol(master)));
        QVERIFY(master.startRealTime());
        QVERIFY(master.waitForCycles(5));
        master.stop();
        node.disconnectFromMaster();
        QTRY_VERIFY(master.nodes().isEmpty());
        if (turn == 0)
            before = openDescriptors();  // what is opened once is open by now
    }
    QTRY_COMPARE(openDescriptors(), before);
}

QTEST_GUILESS_MAIN(tst_Multicast)
#include "tst_Multicast.moc"
