// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AddressResolver.h"
#include "Listener.h"
#include "PlantAddress.h"
#include "node/session/ControlClient.h"

#include <QtCore/QTimer>

namespace qplc {

/// The connection of a window to one master: tries for ever, and brings the listener back whenever
/// it is lost.
class PlantConnection : public QObject
{
    Q_OBJECT
public:
    enum State { Disconnected, Connecting, Connected };
    Q_ENUM(State)

    /// \param address  as PlantAddress::fromString() reads it
    /// \param nodeName under which the master knows the listener; empty: "<person>-<pid>", where
    ///         the person is PlantLeases::whoever()
    PlantConnection(const QString &address, const QString &nodeName, QObject *parent = nullptr);
    ~PlantConnection() override;

    QString address() const { return m_address; }
    QString nodeName() const { return m_nodeName; }
    void open();
    void close();
    /// Whether it is wanted: between open() and close().
    bool isOpen() const { return m_isOpen; }

    State state() const { return m_state; }
    /// Wants at most so many frames a second; 0: one for each cycle, as at the begin. The listener
    /// registers again when that makes a difference.
    void setRate(double framesPerSecond);
    /// Tells the time between two cycles on the clock of people [ns], where it is another one than
    /// the master said first.
    void setPeriod(qint64 period);
    /// Cycles for each frame that is wanted.
    int every() const { return m_every; }

    /// Why there is no connection; empty while there is one.
    QString reason() const { return m_reason; }
    /// Time until the next attempt [s]; -1 when none waits.
    double nextAttempt() const { return m_retry.isActive() ? m_retry.remainingTime() * 1e-3 : -1.0; }
    /// The person whose window \a node is, by the name that ends all of its connections; empty: the
    /// node is no window.
    static QString personOf(const QPlcNodeInfo &node);
    ControlClient &control() { return m_control; }
    const ControlClient &control() const { return m_control; }
    Listener &listener() { return m_listener; }

    /// Pause before an attempt after so many in vain: 250 ms, doubled each time, at most 5 s.
    static int pauseAfter(int failures);

Q_SIGNALS:
    void stateChanged();
    /// control().master() has what the master says of itself.
    void connected(const QPlcSignalTable &table);
    void disconnected(const QString &reason);
    /// A master is there, but this window cannot work with it. Attempts go on.
    void refused(const QString &reason);
    /// The listener is not taken, or was lost, while the master answers.
    void listenerFailed(const QString &sentence);

private:
    void attempt();
    void greeted();
    void lost(ControlClient::Loss loss, const QString &reason);
    enum Failure { NotThere, CannotWork };
    void failed(const QString &reason, Failure failure = NotThere);
    void listen();
    void chooseInterval();
    void listenerLost(const QString &sentence);
    void setState(State state, const QString &reason);

    QString m_address;
    PlantAddress m_parts;
    QString m_addressError;  // empty: it can be used
    QString m_nodeName;
    AddressResolver m_resolver;
    ControlClient m_control;
    Listener m_listener;
    QTimer m_retry;
    QTimer m_listenerRetry;
    QString m_listenerReason;
    State m_state = Disconnected;
    QString m_reason;
    bool m_isOpen = false;
    int m_failures = 0;
    int m_listenerFailures = 0;
    QPlcUnderlyingProtocol m_master;
    QPlcSignalTable m_table;
    qint64 m_period = 0;  // [ns]
    double m_rate = 0.0;  // [1/s]; 0: every cycle
    int m_every = 1;
};

}  // namespace qplc
