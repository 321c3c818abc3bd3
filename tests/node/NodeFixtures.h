// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../common/Waiting.h"
#include "realtime/Host.h"
#include "realtime/TimeSource.h"

#include <QtPlcCore>

#include <QtTest/QSignalSpy>

#include <chrono>
#include <functional>

/// As a step of a node that computes for long, or a thread that has other work.
inline void beBusyFor(std::chrono::nanoseconds duration)
{
    qplc::TimeSource::monotonic().sleepUntil(qplc::monotonicNow() + duration.count());
}

/// The transport whose frames travel one by one: that of the machine, or that of the simulator.
inline QString datagrams()
{
    return qplc::Host::current().controlNetwork() ? QStringLiteral("sim") : QStringLiteral("udp");
}

/// The table of most node tests. Values are held for long: a computer that is busy with other tests
/// makes no signal safe.
inline QPlcSignalTable testTable()
{
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni(R"(
[time]
type = DateTime
[jitter]
type = Real
[masterWorkload]
type = Real64
[workload]
type = Real
hold = 1000
[setpoint]
type = Real64
hold = 1000
min = -10
max = 10
unit = m/s
[count]
type = Int32
hold = 1000
initial = 7
[echo]
type = Real64
hold = 1000
[sum]
type = Real64
hold = 1000
unit = m
[vector]
type = Real64Triple
hold = 1000
[free]
type = Real32
hold = 1000
)",
                                                           &errors);
    Q_ASSERT_X(errors.isEmpty(), "testTable", qPrintable(QPlcParseError::toString(errors)));
    return table;
}

inline QPlcSignalIndexList indices(const QStringList &names)
{
    QPlcSignalIndexList list;
    for (const QString &name : names)
        list.insert(name);
    return list;
}

inline QPlcSignalList valueOf(const char *name, const QPlcValue &value)
{
    QPlcSignalList list;
    list.insert(QString(name), value);
    return list;
}

/// A master on a free loopback port with the table of the tests, as strict as a plant; tst_Profiles
/// has the other profile.
class TestMaster : public QPlcMasterNode
{
    Q_OBJECT
public:
    explicit TestMaster(QPlcClock clock = QPlcClock::lockstep(), const QPlcSignalTable &table = testTable())
    {
        setSignalTable(table);
        setClock(clock);
        setProfile(QPlcProfile::Plant);
    }
    bool listen(const QHostAddress &address = QHostAddress::LocalHost)
    {
        return startServer(QPlcUnderlyingProtocol::tcp(address, 0));
    }
    QPlcUnderlyingProtocol protocol(const QString &kind) const
    {
        return QPlcUnderlyingProtocol::fromString(QStringLiteral("%1://127.0.0.1:%2").arg(kind).arg(serverPort()));
    }
    /// \param kind  "local": in this process; else the protocol over which the node connects
    bool admit(QPlcSlaveNode &node, const QString &kind)
    {
        return kind == QLatin1String("local") ? addLocalNode(&node)
                                              : node.connectToMasterAndWaitForConnected(protocol(kind));
    }
    /// The steps of a start where arming is required.
    bool startArmed() { return initializeAllStates() && waitForState(Ready) && arm() && startRealTime(); }
    bool waitForCycles(quint64 cycles)
    {
        return waitUntil([&] { return statistics().cycles >= cycles; }, 10000);
    }
    /// A short phase may be over before anybody looks: after startRealTime() wait for Off, not for
    /// RealTime and then for Off.
    bool waitForState(State wanted)
    {
        return waitUntil([&] { return state() == wanted; }, 10000);
    }
};

/// What is logged while this object lives.
class LogCapture
{
public:
    LogCapture()
    {
        lines().clear();
        m_before = qInstallMessageHandler(&take);
    }
    ~LogCapture() { qInstallMessageHandler(m_before); }
    QStringList matching(const QString &part) const { return lines().filter(part); }
    QStringList all() const { return lines(); }

private:
    static QStringList &lines()
    {
        static QStringList list;
        return list;
    }
    static void take(QtMsgType, const QMessageLogContext &context, const QString &text)
    {
        lines() << QStringLiteral("%1: %2").arg(QString::fromLatin1(context.category), text);
    }
    QtMessageHandler m_before;
};

/// Counts its cycles into "count" and adds the echo up in "sum".
class CounterNode : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    explicit CounterNode(const QString &name = QStringLiteral("Counter"),
                         RealTimeViolationPolicy policy = ErrorZeroOrderHold)
        : QPlcCompactSlaveNode(name, policy)
    {
    }
    std::function<void(const QPlcCycle &)> onStep;
    int resets = 0;
    int initializations = 0;
    int stops = 0;
    double initialEcho = -1.0;
    quint64 lastCycle = 0;

    /// Its steps since the last reset; for onStep.
    int count() const { return m_count; }
    /// The echo that its step reads; for onStep.
    double newestEcho() const { return m_echo; }

protected:
    void reset() override
    {
        ++resets;
        m_count = 0;
        m_sum = 0.0;
    }
    void initialized() override
    {
        ++initializations;
        initialEcho = m_echo;
    }
    void step(const QPlcCycle &cycle) override
    {
        lastCycle = cycle.number();
        m_count = m_count + 1;
        m_sum = m_sum + m_echo;
        if (onStep)
            onStep(cycle);
    }
    void stopped() override { ++stops; }

private:
    QPlcInput<double> m_echo{this, "echo"};
    QPlcOutput<int> m_count{this, "count"};
    QPlcOutput<double> m_sum{this, "sum"};
};

/// A listener of "count" that keeps the cycles that it hears.
class CountListener : public QPlcIOBufferSlaveNode
{
    Q_OBJECT
public:
    /// \param interval [cycles] of which it hears one
    explicit CountListener(int interval = 1)
        : QPlcIOBufferSlaveNode(QStringLiteral("Listener"))
    {
        setInputSignalIndices(indices({"count"}));
        setListeningInterval(interval);
    }
    QVector<quint64> takeCycles()
    {
        QVector<quint64> cycles;
        takeFrames([&](const Frame &frame) { cycles << frame.cycle; });
        return cycles;
    }
};

/// Gives "count" back as "echo".
class EchoNode : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    explicit EchoNode(const QString &name = QStringLiteral("Echo"), RealTimeViolationPolicy policy = ErrorZeroOrderHold)
        : QPlcCompactSlaveNode(name, policy)
    {
    }
    std::function<void(const QPlcCycle &)> onStep;

protected:
    void reset() override { m_echo = 0.5; }
    void step(const QPlcCycle &cycle) override
    {
        m_echo = double(m_count);
        if (onStep)
            onStep(cycle);
    }

private:
    QPlcInput<int> m_count{this, "count"};
    QPlcOutput<double> m_echo{this, "echo"};
};
