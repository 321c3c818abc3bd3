// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlantValues.h"
#include "QPlcMasterSocket.h"
#include "QPlcSignalList.h"
#include "protocol/messages/Vocabulary.h"

#include <QtCore/QObject>
#include <QtCore/QTimer>

namespace qplc {

class Plant;

/// What a plant lives from that somebody else connects: a program tells its state and values, and
/// gets its commands.
///
/// Nobody says when its cycles were, so rows follow the wall clock: a period is found that keeps
/// them evenly spaced and never far from it.
///
/// Threads: that of the window.
class PlantFeed : public QObject
{
    Q_OBJECT
public:
    /// \param plant  owns the feed; never open()ed
    explicit PlantFeed(Plant *plant);

    bool isConnected() const { return m_isConnected; }
    void connected(const QPlcSignalTable &table);
    void disconnected();
    /// The node that feeds cannot connect, or has lost its master. \param sentence  why
    void failed(const QString &sentence);
    /// The values with which a phase begins.
    void initialize(const QPlcSignalList &values);
    void started();
    void stopped();
    /// The values of cycles that follow each other, oldest first. \param wallTime of the last one
    /// [ns since 1970]
    void add(const QList<QPlcSignalList> &cycles, PlantValues::Time wallTime);

Q_SIGNALS:
    /// A command of a person.
    void commanded(const QPlcMessage &message);

private:
    using Time = PlantValues::Time;

    void setState(messages::MasterState state);
    void tellQuality();
    void put(const QPlcSignalList &values);
    void begin(int cycles, Time wallTime);
    double step(int cycles, Time wallTime);

    Plant *m_plant;
    QTimer m_watch;     // of cycles that do not come
    int m_quality = 0;  // Plant::Quality that was told
    std::vector<char> m_payload;
    bool m_isConnected = false;
    bool m_isInStep = false;  // rows follow the wall clock
    bool m_isSecondBatch = false;
    Time m_lastTime = 0;      // of a row
    Time m_lastWallTime = 0;  // of a batch
    double m_period = 10e6;   // [ns]
};

}  // namespace qplc
