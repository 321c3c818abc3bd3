// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Operator.h"
#include "PlantProcesses.h"

namespace soak {

/// Runs a plant, and does to it what the plan of the profile says. What happened is in the histories of the folder.
class SoakRun
{
public:
    /// \param folder  empty; all processes of the plant write there
    SoakRun(const Profile &profile, int seconds, quint64 seed, const QString &folder);
    ~SoakRun();

    /// \return false when the plant did not come to motion, again or at all: errorString() says why
    bool run();
    QString errorString() const { return m_errorString; }

private:
    bool secure();
    bool start();
    bool startLoad(std::unique_ptr<PlantProcess> *load);
    bool recover();
    bool suffer(const Fault &fault);
    void rest(int seconds);
    int inject(const Fault &fault);
    void stopFor(PlantProcess &process, int milliseconds);
    bool setError(const QString &text);

    const Profile &m_profile;
    const int m_seconds;
    const quint64 m_seed;
    const QString m_folder;
    HistoryWriter m_history;
    PlantProcesses m_plant;
    Operator m_operator;
    QString m_errorString;
};

}  // namespace soak
