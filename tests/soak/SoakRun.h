// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Operator.h"
#include "TestedPlant.h"

namespace soak {

/// Runs a plant, and does to it what a plan says. What happened is in the histories.
class SoakRun
{
public:
    /// \param seconds  of a run without faults
    SoakRun(const Profile &profile, int seconds, const std::vector<Fault> &plan, TestedPlant &plant,
            HistoryWriter &history);
    ~SoakRun();

    /// \return false when the plant did not come to motion, again or at all: errorString() says why
    bool run();
    QString errorString() const { return m_errorString; }

private:
    bool start();
    bool recover();
    bool suffer(const Fault &fault);
    bool comeBack(FaultKind last, bool wereSeveral);
    bool sufferAll();
    void rest(int seconds);
    int inject(const Fault &fault);
    void stopFor(int node, int milliseconds);
    int keepOut(const Fault &fault);
    bool setError(const QString &text);

    const Profile &m_profile;
    const int m_seconds;
    const std::vector<Fault> &m_plan;
    TestedPlant &m_plant;
    HistoryWriter &m_history;
    Operator m_operator;
    QString m_errorString;
    bool m_isCrowded = false;    // the plant has not recovered from the last fault
    bool m_isMasterNew = false;  // since the last recovery: it gives other numbers to its nodes
};

}  // namespace soak
