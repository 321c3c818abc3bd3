// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlantEvent.h"
#include "node/session/ControlClient.h"

#include <QtCore/QMap>
#include <QtCore/QVector>

namespace qplc {

/// The events that a master tells: those that it still has are fetched after connecting, and then
/// they come by themselves. Each one is told once, in order, also over lost connections.
class MasterJournal : public QObject
{
    Q_OBJECT
public:
    explicit MasterJournal(ControlClient &control, QObject *parent = nullptr);

    /// A connection begins. \param session of the master
    /// \param hasFeature whether it tells events
    void begin(quint64 session, bool hasFeature);
    void end();
    /// Whether the master tells what happens to it: nobody else should.
    bool hasFeature() const { return m_hasFeature; }
    /// Whether events of before are still on their way.
    bool isFetching() const { return m_isFetching; }

    /// Events that came by themselves.
    void handle(const messages::Events &pushed);

Q_SIGNALS:
    /// Its source is the name of a node, empty for the master itself.
    void happened(const qplc::PlantEvent &event);
    /// Those of before are told, or there is nobody to ask any more.
    void fetched();

private:
    void fetch();
    void handleFetched(const ControlClient::Reply<messages::GetEvents> &reply);
    void endFetching();
    void tellNew(const messages::Events &events);
    void tell(messages::EventEntry event);
    void endAlarms();

    ControlClient &m_control;
    bool m_hasFeature = false;
    bool m_isFetching = false;
    int m_answers = 0;  // while fetching
    quint64 m_session = 0;
    QMap<QString, PlantEvent> m_alarms;      // that last
    quint64 m_newest = 0;                    // sequence number of the last event that was told
    std::vector<messages::Events> m_pushed;  // while fetching
};

}  // namespace qplc
