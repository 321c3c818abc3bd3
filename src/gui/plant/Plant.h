// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MasterJournal.h"
#include "PlantConnection.h"
#include "PlantEvent.h"
#include "PlantLeases.h"
#include "PlantStatus.h"
#include "PlantValues.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QHash>

namespace qplc {

class PlantFeed;
class PlantPast;
class PlantRecording;
class Recording;

/// One plant as a window sees it: its signals with values and age, its state and the next thing to
/// do, its nodes, and its commands.
///
/// Never blocks and never gives up: open() once, and the plant comes and goes as it likes.
/// Everything happens in the thread of the window; cycles arrive in a thread of their own.
class Plant : public QObject
{
    Q_OBJECT
public:
    /// How far a value can be trusted.
    enum Quality {
        NoValue,  // none has come yet
        Good,
        AtRest,  // no cycles run; the value is what the master holds
        Stale    // no new values for longer than staleAfter(), or no connection
    };
    Q_ENUM(Quality)
    enum Action { NoAction, Initialize, Arm, Start, StopAction, Reset };
    Q_ENUM(Action)

    /// \param address, nodeName  as for PlantConnection
    /// \param name  for references and people; empty: the address
    explicit Plant(const QString &address, const QString &name = QString(), const QString &nodeName = QString(),
                   QObject *parent = nullptr);
    ~Plant() override;

    QString name() const { return m_name; }
    /// 0, 1, ...: by which its colour is chosen (Theme::plant()); of no other plant of the window,
    /// and the same as long as the plant is there.
    int number() const { return m_number; }
    void setNumber(int number) { m_number = number; }
    QString address() const { return m_connection.address(); }
    /// Connects, now and whenever the connection is lost.
    void open() { m_connection.open(); }
    void close() { m_connection.close(); }
    /// Makes this a plant that a program feeds in place of open(); the plant owns the feed.
    PlantFeed *makeFeed();
    /// Null for a plant with a connection of its own.
    PlantFeed *feed() const { return m_feed; }
    /// Makes this a plant whose values come from files, in place of open(); the plant owns the
    /// recording. Its master is never connected.
    PlantRecording *makeRecording(std::unique_ptr<Recording> recording);
    /// Null for a plant that runs, or may run.
    PlantRecording *recording() const { return m_recording; }

    // -- state --
    PlantConnection::State connectionState() const;
    /// Time until the next attempt to connect [s]; -1 when none waits.
    double nextAttempt() const { return m_connection.nextAttempt(); }
    /// Why this window cannot work with a master that is there: "versions differ: ..."; empty: it
    /// can, or there is none.
    QString refusal() const { return m_refusal; }
    bool isConnected() const { return connectionState() == PlantConnection::Connected; }
    /// Whether the master listens to a network, and asks nobody who he is.
    bool isInsecure() const { return m_isInsecure; }
    /// Who this window is for a master with security: the proven identity and its role. Empty
    /// without security.
    QString identity() const { return m_identity; }
    QString role() const { return m_role; }
    /// What the master tells of this window, which is a node that listens; null: nothing yet.
    const NodeStatus *ownNode() const { return m_status.node(m_connection.nodeName()); }
    /// One line for people: "Real time", "Disconnected: Connection refused".
    QString stateText() const;
    /// The one thing that comes next: Start when the master is off (Initialize, Arm and Start,
    /// where it wants starts to be armed), Stop while it runs, Reset when a fault is latched.
    Action nextAction() const;
    static QString actionText(Action action);
    const PlantStatus &status() const { return m_status; }

    // -- values --
    const QPlcSignalTable &table() const { return m_values.table(); }
    const PlantValues &values() const { return m_values; }
    /// Null before the first connection. storeChanged() tells of another one, as when it has got
    /// what the plant has done before (PlantPast).
    SignalStore *store() const { return m_values.store(); }
    /// The same, for who keeps it when the plant has another one or is gone.
    std::shared_ptr<const SignalStore> sharedStore() const { return m_values.sharedStore(); }
    /// Of the newest row of the store, on the clock of this plant [ns]; 0: there is none.
    SignalStore::Time newestTime() const { return store() ? store()->newestTime() : 0; }
    QPlcValue value(QPlcSignalIndex signal) const { return m_values.value(signal); }
    /// Node that writes a signal, "Master"; empty: nobody.
    QString writer(QPlcSignalIndex signal) const { return m_writers.value(signal); }
    Quality quality() const;
    /// Time since the values were true [s]; -1 before the first.
    double age() const;
    /// Wants the values at most so many times a second, for slow links; 0: in each cycle, as at the
    /// begin. What happens in between is not seen.
    void setRate(double timesPerSecond) { m_connection.setRate(timesPerSecond); }
    /// Cycles for each row of values.
    int every() const { return m_connection.every(); }
    /// Age from which on values of a running plant are stale: 3 rows, at least 0.5 s [s].
    double staleAfter() const;
    /// Rows of values that came per second, over the last 2 s.
    double updateRate() const { return m_updateRate; }

    // -- leases: one writer at a time --
    /// Whether the master knows leases; without them takeLease() is refused.
    bool hasLeases() const { return m_leases.hasFeature(); }
    /// All signals that somebody has taken over, in the order of the table.
    const QVector<LeaseStatus> &leases() const { return m_leases.all(); }
    /// Who has taken \a signal over; empty: nobody.
    std::optional<LeaseStatus> lease(const QString &signal) const { return m_leases.find(signal); }

    // -- commands; \return a number that commandDone() or commandFailed() will tell --
    int initialize();
    int start();
    /// \param how  what the person did, for people: "Esc Esc"
    int stop(const QString &how = QString());
    int perform(Action action);
    /// Writes a remark of the person into the event log of the master, and so into recordings.
    /// \param text  one line, at most messages::Note::longest characters
    int note(const QString &text);
    /// Ends all connections of a node or person, and keeps it out until admit().
    int evict(const QString &name);
    /// Lets the node or person in again.
    int admit(const QString &name);
    /// Whether the role of this window allows commands of \a kind.
    bool may(QPlcMessage::Kind kind) const { return m_connection.control().may(kind); }
    /// Sets signals that no node writes, all or none. \param duration 0 for good; else the values
    /// from before come back after it
    int setValues(const QHash<QString, QPlcValue> &values,
                  std::chrono::nanoseconds duration = std::chrono::nanoseconds(0));
    enum TakeOver { OnlyFree, AlsoFromOthers };
    /// Takes signals over for this window, all or none: from then on they have the values of
    /// setValues(), whatever the nodes answer that write them. The window holds them until
    /// releaseLease(), or until it is lost: then they go to their neutral values. \param values to
    /// begin with; may be fewer
    int takeLease(const QStringList &signalNames, const QHash<QString, QPlcValue> &values = {},
                  TakeOver takeOver = OnlyFree);
    /// Gives signals back to the nodes that write them; also those of a lost holder.
    int releaseLease(const QStringList &signalNames);

    static constexpr int MostQuestions = 16;  // of ask() that wait for their answers

    /// Asks for more than the plant does by itself: GetStatistics with histograms, ... \a handler
    /// gets a ControlClient::Reply.
    /// \return false: nothing was asked, as there is no connection, a command waits for its answer,
    ///         or MostQuestions do
    template<typename Question, typename Handler, typename = typename Question::Answer>
    bool ask(const Question &question, const Handler &handler)
    {
        return ask(messages::toMessage(question), [handler](const QPlcMessage &answer) {
            handler(ControlClient::replyOf<typename Question::Answer>(answer));
        });
    }
    /// As above, for a message that is passed on as it is. \a handler gets `Failed` if there is no
    /// answer. \return false also if the message is no question
    bool ask(const QPlcMessage &question, const ControlClient::RawHandler &handler);
    /// Asks the master for its state now; the plant does so twice a second anyway.
    void refresh();

Q_SIGNALS:
    /// Connection, state of the master, or next action.
    void stateChanged();
    /// Nodes or their figures.
    void statusChanged();
    /// Another table: indices mean something else from here on. Never twice for the same table,
    /// also over reconnections.
    void tableChanged();
    void writersChanged();
    /// Somebody has taken, given back or lost a signal. Values of leases() are new ones.
    void leasesChanged();
    /// The store is another object now, with rows of other numbers; the one before is gone.
    void storeChanged();
    /// New values, at most 50 times a second.
    void updated();
    void commandDone(int command);
    void commandFailed(int command, const QString &sentence);
    void eventOccurred(const qplc::PlantEvent &event);
    /// All nodes have their initial values.
    void initialized();

private:
    friend class PlantFeed;
    friend class PlantPast;
    friend class PlantRecording;

    void giveValues(PlantValues values);
    QString refusalToCommand() const;
    void connected(const QPlcSignalTable &table);
    void disconnected(const QString &reason);
    void rejoin();
    void refused(const QString &reason);
    void takeFrames();
    void measureRate();
    void poll();
    void askState();
    void askSignals();
    void handleState(const messages::State &answer);
    void handleStatistics(const messages::Statistics &answer);
    void handleSignals(const messages::Signals &answer);
    void handleSchedule(const messages::Schedule &answer);
    template<typename Question, typename Answer>
    void askFor(const Question &question, void (Plant::*take)(const Answer &));
    template<typename Request>
    int command(const Request &request);
    void tellOutcome(int number, QPlcMessage::Kind command, const messages::Failed *failed);
    template<typename Task>
    void callLater(Task task);
    void nodesChanged(const QStringList &before, const QStringList &now);
    QString sourceOf(const QString &node) const;
    void handleUnasked(const QPlcMessage &message);
    void tell(PlantEvent::Severity severity, const QString &text, const QString &node = QString());
    void tell(const PlantEvent &event);
    enum EventKind { IsOther, IsStateChange };
    void tellOfMaster(PlantEvent::Severity severity, const QString &text, const QString &node = QString(),
                      EventKind kind = IsOther);
    void tellWaiting();
    QStringList nodeNames() const;

    QString m_name;
    int m_number = 0;
    int m_questions = 0;  // of ask() without an answer
    PlantConnection m_connection;
    std::optional<messages::Hex64> m_token;  // that permits a start
    PlantFeed *m_feed = nullptr;
    PlantRecording *m_recording = nullptr;
    PlantValues m_values;
    PlantStatus m_status;
    PlantLeases m_leases{m_connection.control()};
    MasterJournal m_journal{m_connection.control()};
    QString m_refusal;                    // that was told; empty: none
    QVector<PlantEvent> m_waitingEvents;  // of this window, while older ones of the master are on their way
    QVector<QString> m_writers;
    QTimer m_frameTimer;
    QTimer m_pollTimer;
    int m_polls = 0;
    bool m_hasNewValues = false;
    QElapsedTimer m_sinceValues;
    QElapsedTimer m_sinceRejoined;  // began to listen again
    QElapsedTimer m_sinceRate;
    quint64 m_rowsAtRate = 0;
    double m_updateRate = 0.0;
    bool m_isInsecure = false;
    QString m_identity;
    QString m_role;
    int m_lastCommand = 0;
};

}  // namespace qplc

Q_DECLARE_METATYPE(qplc::Plant *)
