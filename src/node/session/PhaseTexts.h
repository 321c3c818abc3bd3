// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MasterLeases.h"
#include "MasterServer.h"
#include "RealTimePhase.h"
#include "protocol/messages/RecordedTexts.h"
#include "transport/TokenBucket.h"

#include <QtCore/QTimer>

#include <deque>
#include <map>

namespace qplc {

/// Tells the recorders of a phase what happens beside its cycles: events, commands and set values,
/// leases, and once a second the statistics. docs/recording.md has the texts.
///
/// All of it is limited: values that are set more often than MostTexts times a second are told
/// together, and of other things, what is more is only counted.
/// Threads: that of the master.
class PhaseTexts : public QObject
{
public:
    static constexpr int MostTexts = 50;              // in each second, of values that are set, and of the rest
    static constexpr int MostTextsAtOnce = 1000;      // that were saved up
    static constexpr std::size_t MostBefore = 200;    // events and commands before a phase that it begins with
    static constexpr std::size_t MostSignals = 1000;  // whose newest value is known to the next phase, or waits
    static constexpr int MostNodes = 64;              // in one text with statistics

    /// All of them outlive this object.
    PhaseTexts(const MasterServer &server, Journal &journal, const MasterWrites &writes, const MasterLeases &leases,
               RealTimePhase &phase, const MasterCycle &cycle, const NodeRegistry &registry);

    /// The phase is over, and the journal knows it.
    void close();

private:
    /// A value that was set; several ones of one signal and person are one.
    struct Setting
    {
        messages::RecordedSetting text;
        quint64 number = 0;
        quint64 count = 1;
        qint64 time = 0;  // [ns since 1970]
    };

    void begin();
    /// \param text  a struct of protocol/messages/RecordedTexts.h
    template<typename Text>
    void tell(RecordedText::Topic topic, const Text &text, quint64 number = 0, qint64 time = 0);
    void eventsHappened();
    void set(const SettingCause &cause, QPlcSignalIndex signal, const QPlcValue &former, const QPlcValue &value,
             quint64 number);
    void tellSetting(const Setting &setting);
    void tellWaiting();
    bool hasRoom(TokenBucket *bucket);
    void commanded(const MasterConnection &connection, const QPlcMessage &message);
    void leaseChanged(const LeaseNews &news);
    void tellStatistics();
    template<typename Text>
    void setPerson(const QObject *socket, Text *text) const;
    QStringList names(const std::vector<QPlcSignalIndex> &indices) const;

    const MasterServer &m_server;
    Journal &m_journal;
    const MasterLeases &m_leases;
    RealTimePhase &m_phase;
    const MasterCycle &m_cycle;
    const NodeRegistry &m_registry;
    const QPlcSignalTable &m_table;
    quint64 m_toldEvents = 0;                                             // sequence number of the newest one
    std::deque<std::pair<messages::RecordedCommand, qint64>> m_commands;  // since the last phase, with their times
    std::map<QPlcSignalIndex, Setting> m_newest;                          // of signals that were set
    TokenBucket m_room{MostTexts, MostTextsAtOnce};                       // for values
    TokenBucket m_otherRoom{MostTexts, MostTextsAtOnce};                  // for events, commands and leases
    std::map<std::pair<QPlcSignalIndex, QString>, Setting> m_waiting;     // for room: of a signal, by somebody
    QTimer m_waitingTimer;
    QTimer m_statisticsTimer;
    int m_seconds = 0;
    int m_nextNode = 0;       // whose statistics come next
    bool m_isBefore = false;  // the phase has a ring, and no cycles yet
};

}  // namespace qplc
