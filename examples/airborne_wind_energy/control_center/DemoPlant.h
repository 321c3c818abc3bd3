// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ChildProcess.h"

#include <QtCore/QDir>
#include <QtCore/QTimer>

#include <memory>
#include <vector>

namespace awe {

/// The kite of the demo: awe_master, awe_model and awe_autopilot as ordinary processes beside this
/// program, on a free port of this machine. It takes off by itself.
///
/// Nothing is waited for, and nothing is left behind: the programs end with this object, and with
/// this program however it ends. When one of them ends without being asked to, the others stay as
/// they are, so that people see what is left of the plant, until restart().
///
/// Threads: that of the window.
class DemoPlant : public QObject
{
    Q_OBJECT
public:
    /// \param folder  where the programs are; empty: beside this one
    explicit DemoPlant(const QString &folder = QString(), QObject *parent = nullptr);
    ~DemoPlant() override;

    /// The plant that the next start() or restart() flies: see PlantConfiguration::names(). Empty:
    /// that of the thesis.
    void setPlant(const QString &name) { m_plant = name; }
    /// Starts the programs, anew if one of them has ended; while they run, listening() comes at
    /// once. failed() when one of them is not there.
    void start();
    /// Ends what runs and starts all of it again, on the same port: windows find it again by
    /// themselves.
    void restart();

    bool isRunning() const { return !m_programs.empty(); }
    /// Of the master, "127.0.0.1:41234"; empty before it listens.
    QString address() const;
    /// What a person would type in a shell for the programs that run, a line for each of them;
    /// empty when none does.
    QString commands() const;

Q_SIGNALS:
    void listening(const QString &address);
    /// A program is missing, or has ended: which one, its last words, and the remedy.
    void failed(const QString &sentence);

private:
    struct Program;

    bool areAllThere();
    void run(const QString &name, const QStringList &arguments);
    void startMaster();
    void readMaster(Program *master);
    void startNodes();
    QStringList plantOption() const;
    void ended(Program *program);
    void blame(const Program &program);
    void terminate();

    QDir m_folder;
    QString m_plant;                                   // name; empty: that of the thesis
    QString m_flownPlant;                              // of the programs that run
    std::vector<std::unique_ptr<Program>> m_programs;  // in the order of their start
    QTimer m_patience;                                 // with programs that are asked to end
    quint16 m_port = 0;                                // 0: none yet
    bool m_isListening = false;
    bool m_isRestarting = false;
    bool m_hasFailed = false;  // one of them has ended without being asked to
    QTimer m_telling;          // until it is told
    QString m_sentence;        // of it
    int m_suspicion = 0;       // that it is the cause
};

}  // namespace awe
