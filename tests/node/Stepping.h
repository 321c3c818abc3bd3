// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeFixtures.h"
#include "realtime/CycleThread.h"

#include <atomic>

using StepResult = QPlcMasterNode::StepResult;
using namespace std::chrono_literals;

/// Steps on a thread of its own, as a host does, while the thread of the master handles its events.
class Host
{
public:
    explicit Host(QPlcMasterNode &master)
    {
        if (!m_thread.start("host", {}, [this, &master] { m_result = int(master.step()); }))
            qFatal("no thread");
    }

    bool isInside() const { return m_result < 0; }
    StepResult result()
    {
        if (!waitUntil([this] { return !isInside(); }, 30s))
            qFatal("a step does not return");
        return StepResult(m_result.load());
    }

    StepResult resultWithoutEvents()
    {
        while (isInside())
            beBusyFor(1ms);
        return result();
    }

private:
    std::atomic<int> m_result{-1};
    qplc::CycleThread m_thread;  // a strand, where there are no threads
};

inline StepResult stepAside(QPlcMasterNode &master)
{
    return Host(master).result();
}

/// An echo that hangs while the test wants it.
class HangingNode : public EchoNode
{
public:
    explicit HangingNode(RealTimeViolationPolicy policy = ErrorZeroOrderHold)
        : EchoNode("Hanging", policy)
    {
        onStep = [this](const QPlcCycle &) {
            for (; hangs; beBusyFor(1ms))
                isHanging = true;
            isHanging = false;
        };
    }
    ~HangingNode() override { hangs = false; }

    std::atomic<bool> hangs{false};
    std::atomic<bool> isHanging{false};
};

/// A master whose clock the test turns.
class External : public TestMaster
{
public:
    explicit External(std::chrono::milliseconds longestWait = 20s)
        : TestMaster(QPlcClock::external())
    {
        setLongestWait(longestWait);
    }
    bool begin() { return startRealTime() && waitForState(RealTime); }
};
