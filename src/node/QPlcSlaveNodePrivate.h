// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ListeningInterval.h"
#include "NodeRuntime.h"
#include "QPlcMasterNode.h"
#include "QPlcMasterSocket.h"
#include "QPlcSlaveNode.h"
#include "SlaveCycle.h"

#include <QtCore/QJsonArray>
#include <QtCore/QPointer>
#include <QtCore/QSocketNotifier>

#include <memory>
#include <optional>

/// The control side of a slave: registration, and the phases that the master announces.
class QPlcSlaveNodePrivate
{
public:
    QPlcSlaveNodePrivate(QPlcSlaveNode *node, const QString &name, QPlcSlaveNode::RealTimeViolationPolicy policy);

    void connectToMaster(const QPlcUnderlyingProtocol &master);
    void disconnectFromMaster();

    /// Emits hasInitialized() with the bytes of the inputs, when anybody listens.
    void tellInitialized(const QByteArray &inputs);

    void setState(QPlcSlaveNode::State newState);
    void setError(QPlcSlaveNode::Error newError, const QString &text);

    QPlcSlaveNode *const q;
    QString name;
    QPlcSlaveNode::RealTimeViolationPolicy policy;
    bool listener = false;
    qplc::ListeningInterval interval;
    bool sameCycle = false;  // all inputs
    bool twoPhase = false;
    QString faultPlan;
    QPlcSignalTable ownTable;
    QPlcRealTimeOptions realTimeOptions;
    std::chrono::nanoseconds watchdog{0};
    std::optional<QPlcSecurity> security;  // else that of the process
    qplc::NodeRuntime runtime;
    QPlcSlaveNode::State state = QPlcSlaveNode::Disconnected;
    QPlcSlaveNode::Error error = QPlcSlaveNode::NoError;
    QString errorString;
    std::unique_ptr<qplc::SlaveCycle> cycle;
    QPlcUnderlyingProtocol master;
    QPointer<QPlcMasterNode> localMaster;  // in whose process the node runs
    QPlcMasterSocket *control = nullptr;

private:
    bool isExpected(QPlcMessage::Kind kind) const;
    void receive(const QPlcMessage &message);
    bool isOrdered() const;
    QJsonArray features() const;
    void greet();
    void receiveHello(const QPlcMessage &message);
    bool chooseTable(const QPlcMessage &hello, QPlcSignalTable *table);
    void registerAtMaster();
    void receiveRegistered(const QPlcMessage &message);
    bool makeUdpLink(quint16 *port);
    bool openLocalLink(const QPlcMessage &registered);
    bool joinGroup(const QPlcMessage &registered);
    void giveLink(std::unique_ptr<qplc::CyclicLink> link);
    void connectCyclicChannel();
    void cyclicChannelAttached();
    void sendInitialOutputs();
    void initializeWith(const QPlcMessage &message);
    void startCycles(const QPlcMessage &message);
    void stopCycles();
    void initializationFailed();
    void masterLost(QPlcAbstractSocket::Error socketError, const QString &text);
    void closeSockets();
    void giveUp(QPlcSlaveNode::Error newError, const QString &text);
    void takeReports();
    void report(const qplc::CycleEvent &event);

    QPlcMasterSocket *m_cyclicSocket = nullptr;
    bool m_outputsAwaited = false;             // by the master, which knows already that the cyclic connection is there
    std::unique_ptr<qplc::CyclicLink> m_link;  // until the cycle takes it
    std::unique_ptr<QSocketNotifier> m_reportNotifier;
    QString m_uuid;
    quint64 m_session = 0;
    QString m_token;
    int m_id = 0;
};
