// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "History.h"
#include "NemesisPlan.h"

#include <QtCore/QProcess>

#include <memory>

namespace soak {

inline constexpr int Patience = 20'000;  // [ms] with what is to come at once: far more than a loaded machine needs

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

/// The processes of a plant: one master, and the nodes of the profile, each in its newest life.
class PlantProcesses
{
public:
    PlantProcesses(const Profile &profile, const QString &folder, HistoryWriter &history);
    ~PlantProcesses();

    /// Starts a master, again on the port of the one before. \return false when it does not listen
    bool startMaster(QString *error);
    /// \param extraArguments  for this life of the node
    void startNode(int node, const QStringList &extraArguments = {});
    PlantProcess &master() { return *m_master; }
    PlantProcess &node(int node) { return *m_nodes[std::size_t(node)].process; }
    quint16 port() const { return m_port; }
    quint32 masterLife() const { return m_masterLife; }
    /// Writes down what all processes use. \param compare  the whole plant runs: numbers are to be the same each time
    void recordUsage(bool compare);
    /// Ends all nodes, then the master, in an orderly way. \return those that did not
    QStringList end();

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
    const QString m_folder;
    HistoryWriter &m_history;
    std::unique_ptr<PlantProcess> m_master;
    quint32 m_masterLife = 0;
    quint16 m_port = 0;
    std::vector<Node> m_nodes;
};

}  // namespace soak
