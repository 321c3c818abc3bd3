// SPDX-License-Identifier: Apache-2.0
#include "NodeFixtures.h"

#include <QtTest/QtTest>

#include <atomic>
#include <cstdlib>

// Every allocation of the program goes through here; those of cycle threads are counted while the flag is set.
namespace {

std::atomic<bool> counting{false};
std::atomic<quint64> allocations{0};
thread_local bool isCycleThread = false;

void note()
{
    if (isCycleThread && counting.load(std::memory_order_relaxed))
        allocations.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define QTPLC_SANITIZED
#elif defined(__has_feature)  // by clang; Qt gives one that is always 0 to the others
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define QTPLC_SANITIZED
#endif
#endif
#ifndef QTPLC_SANITIZED
// operator new of the standard library ends here, too.
extern "C" {
void *__libc_malloc(std::size_t size);
void *__libc_calloc(std::size_t count, std::size_t size);
void *__libc_realloc(void *bytes, std::size_t size);
void *malloc(std::size_t size)
{
    note();
    return __libc_malloc(size);
}
void *calloc(std::size_t count, std::size_t size)
{
    note();
    return __libc_calloc(count, size);
}
void *realloc(void *bytes, std::size_t size)
{
    note();
    return __libc_realloc(bytes, size);
}
}
#endif

// A cycle is free of allocations, whatever the ports.
class tst_Allocations : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void aMillionCyclesInProcess();
    void cyclesOverTheNetwork_data();
    void cyclesOverTheNetwork();
    void buffersAndIoNodes();
};

namespace {

QPlcSignalTable everyType()
{
    return QPlcSignalTable::fromIni(R"(
[real]
type = Real64
[single]
type = Real32
[integer]
type = Int32
[truth]
type = Bool
[triple]
type = RealTriple
[time]
type = DateTime
[realOut]
type = Real64
[singleOut]
type = Real32
[wideOut]
type = Int64
[truthOut]
type = Bool
[tripleOut]
type = Real64Triple
[compactOut]
type = Real64Triple
[workload]
type = Real64
)");
}

/// Ports of every kind. The first step tells the counter that this is a cycle thread.
class Everything : public QPlcCompactSlaveNode
{
public:
    Everything()
        : QPlcCompactSlaveNode("Everything")
    {
        activateWorkloadMeasurement("workload");
    }

private:
    QPlcInput<double> m_real{this, "real"};
    QPlcInput<double> m_single{this, "single"};
    QPlcInput<qint64> m_integer{this, "integer"};
    QPlcInput<bool> m_truth{this, "truth"};
    QPlcInput<std::array<double, 3>> m_triple{this, "triple"};
    QPlcInput<qint64> m_time{this, "time"};
    QPlcOutput<double> m_realOut{this, "realOut"};
    QPlcOutput<double> m_singleOut{this, "singleOut"};
    QPlcOutput<int> m_wideOut{this, "wideOut"};
    QPlcOutput<bool> m_truthOut{this, "truthOut"};
    QPlcOutput<std::array<double, 3>> m_tripleOut{this, "tripleOut"};
    QPlcCompactSignal m_compactOut = QPlcCompactSignal("compactOut", QPlcCompactSignal::Output, this);

    void step(const QPlcCycle &cycle) override
    {
        isCycleThread = true;
        m_realOut = m_real + cycle.dt();
        m_singleOut = m_single + m_triple.value()[1];
        m_wideOut = int(m_integer) + 1;
        m_truthOut = !m_truth;
        m_tripleOut = std::array<double, 3>{1.0, double(m_time), m_realOut};
        m_compactOut = m_tripleOut.value();
    }
};

}  // namespace

void tst_Allocations::initTestCase()
{
#ifdef QTPLC_SANITIZED
    QSKIP("the sanitizer owns malloc", "");
#endif
    // The counter counts: a test that sees nothing would prove nothing.
    isCycleThread = counting = true;
    std::free(std::malloc(3));
    delete new QObject;
    isCycleThread = counting = false;
    QVERIFY(allocations.exchange(0) >= 3);
}

void tst_Allocations::aMillionCyclesInProcess()
{
    TestMaster master(QPlcClock::lockstep(), everyType());
    QVERIFY(master.setTimeSignal("time"));
    Everything node;
    QVERIFY2(master.addLocalNode(&node), qPrintable(master.errorString()));
    master.setCycleLimit(1'000'100);
    QVERIFY(master.startRealTime());
    QVERIFY(QTest::qWaitFor([&] { return master.statistics().cycles >= 100; }, 5000));
    counting = true;
    QVERIFY(QTest::qWaitFor([&] { return master.state() == QPlcMasterNode::Off; }, 50000));
    counting = false;
    QCOMPARE(master.statistics().cycles, quint64(1'000'100));
    QCOMPARE(allocations.exchange(0), quint64(0));
}

void tst_Allocations::cyclesOverTheNetwork_data()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("udp") << "udp";
    QTest::newRow("tcp") << "tcp";
}

void tst_Allocations::cyclesOverTheNetwork()
{
    QFETCH(QString, kind);
    class Marker : public QPlcCompactSlaveNode  // marks the cycle thread of the master
    {
    public:
        Marker()
            : QPlcCompactSlaveNode("Marker")
        {
        }
        void step(const QPlcCycle &) override { isCycleThread = true; }
    } marker;
    TestMaster master(QPlcClock::lockstep(), everyType());
    QVERIFY(master.setTimeSignal("time"));
    QVERIFY(master.addLocalNode(&marker));
    QVERIFY(master.listen());
    Everything node;
    QVERIFY2(node.connectToMasterAndWaitForConnected(master.protocol(kind)), qPrintable(node.errorString()));
    master.setCycleLimit(20'100);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(100));
    counting = true;
    QVERIFY(QTest::qWaitFor([&] { return master.statistics().cycles >= 20'050; }, 50000));
    counting = false;
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(allocations.exchange(0), quint64(0));
    node.disconnectFromMaster();
    QPlcSignalIndexTable::setCurrent({});
}

void tst_Allocations::buffersAndIoNodes()
{
    QPlcSignalIndexTable::setCurrent(everyType());
    TestMaster master(QPlcClock::lockstep(), everyType());
    QPlcIOBufferSlaveNode viewer("Viewer");
    QPlcSignalIndexList inputs;
    inputs.insert("real");
    inputs.insert("triple");
    QPlcSignalIndexList outputs;
    outputs.insert("single");
    viewer.setInputSignalIndices(inputs);
    viewer.setOutputSignalIndices(outputs);
    Everything node;
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(master.addLocalNode(&viewer));
    master.setCycleLimit(10'100);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(100));
    counting = true;
    QVERIFY(master.waitForCycles(10'050));
    counting = false;
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(allocations.exchange(0), quint64(0));
    QPlcSignalIndexTable::setCurrent({});
}

QTEST_GUILESS_MAIN(tst_Allocations)
#include "tst_Allocations.moc"
