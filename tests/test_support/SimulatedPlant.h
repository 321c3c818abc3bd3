// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Evidence.h"
#include "SoakMaster.h"
#include "SoakNode.h"
#include "Strangers.h"
#include "TestedPlant.h"
#include "test_support/SimulatedHost.h"

QT_BEGIN_NAMESPACE
class QTcpSocket;
QT_END_NAMESPACE

namespace soak {

/// A history in memory. A program that does not run writes nothing more.
class HistoryMemory final : public HistoryWriter
{
public:
    /// \param host  of the program; null: the runner
    HistoryMemory(qplc::Simulator &simulator, const qplc::SimulatedHost *host, const QString &name, int node,
                  quint32 life);

    using HistoryWriter::append;
    void append(Record record) noexcept override;
    const History &history() const { return m_history; }

private:
    qplc::Simulator &m_simulator;
    const qplc::SimulatedHost *const m_host;
    History m_history;
};

/// The soak's plant in a simulator, each of its programs on a host with clocks of its own.
class SimulatedPlant final : public TestedPlant
{
public:
    SimulatedPlant(qplc::Simulator &simulator, const Profile &profile);
    ~SimulatedPlant() override;

    HistoryWriter &runnerHistory() { return m_runnerHistory; }
    /// On which the runner and its operator are.
    qplc::SimulatedHost &operatorHost() { return m_operatorHost; }
    Evidence evidence() const;

    bool prepare(QString *error) override;
    bool startMaster(QString *error) override;
    void killMaster() override { m_master.host->kill(); }
    QPlcUnderlyingProtocol master() const override;
    void startNode(int node, const QString &linkFaults) override;
    void setStopped(int node, bool stopped) override;
    int inject(const Fault &fault, Operator &person) override;
    void waitForCauses() override;
    QStringList end() override;

private:
    struct Program
    {
        std::unique_ptr<qplc::SimulatedHost> host;
        quint32 life = 0;
    };
    using Connections = std::vector<std::unique_ptr<QTcpSocket>>;
    using Hosts = std::vector<std::unique_ptr<qplc::SimulatedHost>>;

    QPlcManifest manifest() const;
    HistoryMemory &newHistory(const Program &program, const QString &name, int node);
    void switchOff(const Fault &fault);
    void cut(const Fault &fault);
    void worsen(const Fault &fault);
    void stepClock(qplc::SimulatedHost &host);
    /// \a undo is called when the fault has lasted as long as it should.
    void last(const Fault &fault, const std::function<void()> &undo);
    int sendDatagrams(const Fault &fault, bool toNodes);
    Connections connect(int count);
    Connections connectFrom(qplc::SimulatedHost &host, int count);
    int sendGarbage(const Fault &fault);
    int askWithoutReading(const Fault &fault);
    int listenSlowly(const Fault &fault);
    int flood(const Fault &fault);
    int leaveOut(const Fault &fault, Operator &person);
    int besiege(const Fault &fault, Operator &person);
    int changeParameters(const Fault &fault, Operator &person);
    int joinSilently(const Fault &fault, Operator &person);
    PlantShape shape() const;
    QPlcUnderlyingProtocol cyclicPlace() const;

    qplc::Simulator &m_simulator;
    const Profile &m_profile;
    std::vector<std::unique_ptr<HistoryMemory>>
        m_histories;  // before the hosts: their programs write there as they end
    Program m_master;
    std::vector<Program> m_nodes;
    qplc::SimulatedHost m_operatorHost;
    qplc::SimulatedHost m_strangerHost;
    HistoryMemory m_runnerHistory;
    SoakMaster *m_masterProgram = nullptr;
    int m_edition = 0;       // of the safety parameters of programs that start
    QObject m_causes;        // of faults that have not ended yet
    qint64 m_lastCause = 0;  // [ms] when the last cause ends
};

}  // namespace soak
