// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Commands.h"

#include <QtCore/QTimer>

namespace tools {

/// Joins the plant as a listener: hears the signals of every cycle, and asks the master now and
/// then for what a cycle does not tell.
class SignalListener : public QObject
{
    Q_OBJECT
public:
    struct Sample
    {
        quint64 cycle;
        QVector<QPlcValue> values;  // in the order of names()
        QVector<QPlcQuality> qualities;
    };

    /// \param call  its client, which is connected, asks the master
    /// \param purpose  becomes part of the name under which the master knows this listener
    /// \param pause  time between two heard() [ms]
    SignalListener(const CommandCall &call, const QString &purpose, const QPlcSignalTable &table,
                   const QStringList &names, int pause);
    ~SignalListener() override;

    /// Hears one of so many cycles only. Before join().
    void setInterval(int cycles) { m_node.setListeningInterval(cycles); }
    const QVector<QPlcSignalDefinition> &definitions() const { return m_definitions; }
    /// Names and values of one sample, as JSON.
    QJsonObject toJson(const QVector<QPlcValue> &values) const;
    void handleState(const qplc::messages::State &state);
    /// \param values  of names()
    void handleValues(const std::vector<qplc::messages::SignalEntry> &values);
    const QStringList &names() const { return m_names; }
    /// Registers and listens from now on. \return false, with the message out
    bool join();
    /// Asks for the state, and while no cycle runs for the values, which come as valuesAtRest().
    void askForState();

    bool isRunning() const { return m_isRunning; }
    qplc::messages::MasterState state() const { return m_state; }
    /// Nominal time of a cycle since the start [s].
    double timeOf(quint64 cycle) const { return double(cycle) * m_period; }
    /// Whether the master has ended as wanted, or is still there.
    bool isSound() const { return m_node.error() == QPlcSlaveNode::NoError; }

Q_SIGNALS:
    /// Cycles that came since the last time, oldest first. Empty: none came.
    void heard(const QVector<tools::SignalListener::Sample> &samples);
    /// The values while no cycle runs: after each answer about the state.
    void valuesAtRest(const QVector<QPlcValue> &values, const QVector<QPlcQuality> &qualities);
    void masterEnded();

private:
    void takeCycles();
    using Values = std::vector<qplc::messages::SignalEntry>;
    void askForValues(const std::shared_ptr<Values> &known);
    template<typename Request, typename Take>
    void ask(const Request &request, Take take);

    const CommandCall &m_call;
    QStringList m_names;
    QVector<QPlcSignalDefinition> m_definitions;
    QVector<int> m_places;   // of names() among the inputs of the node
    QVector<int> m_offsets;  // and of their values in a frame [byte]
    QPlcIOBufferSlaveNode m_node;
    QTimer m_timer;
    QTimer m_joinTimer;
    double m_period = 0.0;  // [s]
    qplc::messages::MasterState m_state = qplc::messages::MasterState::Unknown;
    bool m_isRunning = false;
    bool m_isAsking = false;  // for the values
};

}  // namespace tools
