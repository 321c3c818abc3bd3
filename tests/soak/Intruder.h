// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "History.h"
#include "Strangers.h"

#include <QtPlcCore>

#include <QtCore/QTimer>

#include <memory>

namespace soak {

/// Tries all the time to do what it may not, while the event loop runs: strangers send garbage and
/// commands without TLS, somebody has the name of the operator and a wrong key, and an observer
/// with a right key sends the commands of an operator. What was tried, and what of it was refused,
/// is written down.
class Intruder : public QObject
{
    Q_OBJECT
public:
    /// \param attempts  per second; 0: none
    /// \param folder  where the keys of the plant are
    Intruder(quint16 port, int attempts, quint64 seed, const QString &folder, HistoryWriter &history);
    ~Intruder() override;

    /// Tries nothing more, and waits until all that was tried has had its answer, but not for ever.
    /// The observer stays connected: the master uses as much at last as at first.
    void end();

private:
    void tryAgain();
    void knockWithWrongKey();
    void command();
    void enterAsObserver();
    void receiveAsObserver(const QPlcMessage &message);
    bool isSettled() const { return m_ended == m_made && m_denials == m_commands; }
    void record();

    static constexpr int Interval = 100;  // [ms]
    const quint16 m_port;
    const int m_attempts;  // in each interval
    const QString m_folder;
    HistoryWriter &m_history;
    Strangers m_strangers;
    QTimer m_timer;
    std::unique_ptr<QPlcMasterSocket> m_liar;  // with the wrong key
    QPlcMasterSocket m_observer;
    bool m_isObserverIn = false;
    int m_turn = 0;
    quint64 m_made = 0;      // connections of strangers
    quint64 m_ended = 0;     // of them, by the master
    quint64 m_commands = 0;  // of the observer
    quint64 m_denials = 0;   // of them
};

}  // namespace soak
