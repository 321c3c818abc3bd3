// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "NodeFixtures.h"

#include <atomic>
#include <memory>
#include <optional>
#include <thread>

using namespace std::chrono_literals;

// Nodes that are destroyed while their cycles run.
class tst_Destruction : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void destructorOfPortsEndsTheCyclesFirst_data() { addKinds(); }
    void destructorOfPortsEndsTheCyclesFirst();
    void aNodeThatDisconnectsFirstIsMadeSafe_data() { addKinds(); }
    void aNodeThatDisconnectsFirstIsMadeSafe();
    void destroyedNodeWithoutPortsWarnsAndDoesNotCrash_data() { addKinds(); }
    void destroyedNodeWithoutPortsWarnsAndDoesNotCrash();
    void aNodeDrivenFromOutsideMayEndAtAnyTime_data() { addKinds(); }
    void aNodeDrivenFromOutsideMayEndAtAnyTime();
    void aPortMayLiveLongerThanItsNode();
    void missingRealTimeoutIsReportedAsFault();

private:
    static constexpr int Rounds = 20;
    static void addKinds()
    {
        QTest::addColumn<QString>("kind");
        for (const char *kind : {"local", "udp", "tcp"})
            QTest::newRow(kind) << kind;
    }
    /// Destroys a node that computes in a plant as fast as it can be. \return the warnings of it;
    /// none: it could not fly, or the master keeps it
    static std::optional<QStringList> warningsOfDestroying(std::unique_ptr<QPlcSlaveNode> node, const QString &kind);
};

namespace {

/// What step() needs beside its ports. It is destroyed behind them, slowly.
struct Tool
{
    ~Tool()
    {
        isGone = true;
        std::this_thread::sleep_for(3ms);
    }
    std::atomic<bool> isGone{false};
};

class Winch : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    explicit Winch(std::atomic<int> &late)
        : QPlcCompactSlaveNode(QStringLiteral("Winch"))
        , m_late(late)
    {
    }

private:
    void step(const QPlcCycle &) override
    {
        if (m_tool.isGone)
            ++m_late;
        *m_length = *m_length + m_setpoint;
        m_echo = *m_length;
    }
    void safeState(SafeStateReason) override
    {
        if (m_tool.isGone)
            ++m_late;
    }

    std::atomic<int> &m_late;
    Tool m_tool;
    std::unique_ptr<double> m_length = std::make_unique<double>(0.0);
    QPlcInput<double> m_setpoint{this, "setpoint"};
    QPlcOutput<double> m_echo{this, "echo"};
    QPlcCompactSignal m_free{"free", QPlcPort::Input, this};  // the first to go: it is loaded by a virtual function
};

/// As Winch, with lists.
class ListNode : public QPlcSlaveNode
{
    Q_OBJECT
public:
    enum Leaving { ByItself, NotAtAll };

    ListNode(Leaving leaving, std::atomic<int> &safeStates)
        : QPlcSlaveNode(QStringLiteral("Lists"))
        , m_leaving(leaving)
        , m_safeStates(safeStates)
    {
    }
    ~ListNode() override
    {
        if (m_leaving == ByItself)
            disconnectFromMaster();
    }

private:
    QPlcSignalIndexList declareInputSignals() override { return indices({"setpoint"}); }
    QPlcSignalList realTimeout(const QPlcSignalList &) override { return {}; }
    void safeState(SafeStateReason) override { ++m_safeStates; }

    const Leaving m_leaving;
    std::atomic<int> &m_safeStates;
};

const QString Warning = QStringLiteral("is destroyed while its cycles run");

}  // namespace

std::optional<QStringList> tst_Destruction::warningsOfDestroying(std::unique_ptr<QPlcSlaveNode> node,
                                                                 const QString &kind)
{
    LogCapture log;
    TestMaster master;
    const bool flies = (kind == QLatin1String("local") || master.listen()) && master.admit(*node, kind)
        && master.startRealTime() && master.waitForState(QPlcMasterNode::RealTime) && master.waitForCycles(3);
    node.reset();
    const bool isGone = waitUntil([&] { return master.nodes().isEmpty(); });
    return flies && isGone ? std::optional<QStringList>(log.matching(Warning)) : std::nullopt;
}

void tst_Destruction::destructorOfPortsEndsTheCyclesFirst()
{
    QFETCH(QString, kind);
    for (int i = 0; i < Rounds; ++i) {
        std::atomic<int> late{0};
        const auto warnings = warningsOfDestroying(std::make_unique<Winch>(late), kind);
        QVERIFY(warnings);
        QCOMPARE(late.load(), 0);
        QCOMPARE(warnings->size(), 1);
        QVERIFY(warnings->first().contains("node Winch " + Warning));
        QVERIFY(warnings->first().contains("call disconnectFromMaster() first"));
    }
}

void tst_Destruction::aNodeThatDisconnectsFirstIsMadeSafe()
{
    QFETCH(QString, kind);
    QPlcSignalIndexTable::setCurrent(testTable());
    for (int i = 0; i < Rounds; ++i) {
        std::atomic<int> safeStates{0};
        const auto warnings = warningsOfDestroying(std::make_unique<ListNode>(ListNode::ByItself, safeStates), kind);
        QVERIFY(warnings);
        QCOMPARE(*warnings, QStringList());
        QCOMPARE(safeStates.load(), 1);
    }
}

void tst_Destruction::destroyedNodeWithoutPortsWarnsAndDoesNotCrash()
{
    QFETCH(QString, kind);
    QPlcSignalIndexTable::setCurrent(testTable());
    for (int i = 0; i < Rounds; ++i) {
        std::atomic<int> safeStates{0};
        const auto warnings = warningsOfDestroying(std::make_unique<ListNode>(ListNode::NotAtAll, safeStates), kind);
        QVERIFY(warnings);
        QCOMPARE(warnings->size(), 1);
        QVERIFY(warnings->first().contains("node Lists " + Warning));
    }
}

void tst_Destruction::aNodeDrivenFromOutsideMayEndAtAnyTime()
{
    QFETCH(QString, kind);
    QPlcSignalIndexTable::setCurrent(testTable());
    for (int i = 0; i < Rounds; ++i) {
        std::unique_ptr<QPlcIOSlaveNode> node;
        if (i % 2 == 0)
            node = std::make_unique<QPlcIOSlaveNode>(QStringLiteral("Panel"));
        else
            node = std::make_unique<QPlcIOBufferSlaveNode>(QStringLiteral("Panel"));
        node->setInputSignalIndices(indices({"setpoint"}));
        const auto warnings = warningsOfDestroying(std::move(node), kind);
        QVERIFY(warnings);
        QCOMPARE(*warnings, QStringList());
    }
}

void tst_Destruction::aPortMayLiveLongerThanItsNode()
{
    std::unique_ptr<QPlcInput<double>> port;
    {
        EchoNode node;
        port = std::make_unique<QPlcInput<double>>(&node, "setpoint");
    }
    port.reset();
    EchoNode node;
    {
        const QPlcInput<double> gone(&node, "no such signal");
    }
    TestMaster master;
    QVERIFY2(master.addLocalNode(&node), qPrintable(master.errorString()));
}

namespace {

class Empty : public QPlcSlaveNode
{
public:
    Empty()
        : QPlcSlaveNode(QStringLiteral("Empty"))
    {
    }
};

}  // namespace

void tst_Destruction::missingRealTimeoutIsReportedAsFault()
{
    LogCapture log;
    TestMaster master;
    Empty node;
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(master.startRealTime());
    QTRY_VERIFY2(master.errorString().contains("override it"), qPrintable(master.errorString()));
    node.disconnectFromMaster();
    QVERIFY(master.nodes().isEmpty());
}

QTEST_GUILESS_MAIN(tst_Destruction)
#include "tst_Destruction.moc"
