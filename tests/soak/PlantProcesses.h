// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "History.h"
#include "Intruder.h"
#include "ReferenceClock.h"
#include "TestedPlant.h"

#include <QtCore/QProcess>

#include <memory>

namespace soak {

/// A process of the plant. It dies with the runner, and its words go to a file.
class PlantProcess : public QProcess
{
    Q_OBJECT
public:
    PlantProcess(const QString &program, const QStringList &arguments, const QString &logFile);
    ~PlantProcess() override;
    void sendSignal(int number) const;
    /// SIGKILL, and waits until it is gone.
    void destroy();
    /// SIGTERM, and waits. \return false when it had to be killed
    bool end();

protected:
    void setupChildProcess() override;
};

/// A plant of processes.
class PlantProcesses final : public TestedPlant
{
public:
    /// \param folder  empty; all processes of the plant write there
    PlantProcesses(const Profile &profile, quint64 seed, const QString &folder, HistoryWriter &history);
    ~PlantProcesses() override;

    bool prepare(QString *error) override;
    bool startMaster(QString *error) override;
    void killMaster() override { m_master->destroy(); }
    QPlcUnderlyingProtocol master() const override
    {
        return QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, m_port);
    }
    void startNode(int node, const QString &linkFaults) override;
    void setStopped(int node, bool stopped) override;
    int inject(const Fault &fault, Operator &person) override;
    bool beginBeside(QString *error) override;
    void endBeside() override;
    void recordUsage(bool compare) override;
    QStringList end() override;

private:
    struct Node
    {
        std::unique_ptr<PlantProcess> process;
        quint32 life = 0;
    };
    QString file(const QString &name) const;
    QStringList priorityArguments() const;
    QStringList securityArguments(const QString &identity) const;

    const Profile &m_profile;
    const quint64 m_seed;
    const QString m_folder;
    HistoryWriter &m_history;
    std::unique_ptr<PlantProcess> m_master;
    quint32 m_masterLife = 0;
    quint16 m_port = 0;
    std::vector<Node> m_nodes;
    std::unique_ptr<ReferenceClock> m_reference;
    std::unique_ptr<PlantProcess> m_load;
    std::unique_ptr<Intruder> m_intruder;
};

}  // namespace soak
