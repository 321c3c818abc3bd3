// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanFrame.h"
#include "CanProtection.h"
#include "DbcFile.h"

#include <QtCore/QStringList>

#include <chrono>

class QPlcDriverSettings;

namespace qplc {

/// When a message is sent. More than one of them: as soon as one says so.
struct CanSendRule
{
    bool everyCycle = false;
    bool onChange = false;
    bool onRequest = false;
    std::chrono::nanoseconds period{0};  // 0: not periodically
    std::chrono::nanoseconds gap{0};     // at least between two frames, but before a safe value; 0: none
};

/// A message of the bus: what it carries, when it is sent, and how long it is fresh.
struct CanMessage
{
    DbcMessage description;
    CanSendRule rule;
    CanProtection protection;
    std::chrono::nanoseconds timeout{0};   // 0: that of the driver
    int source = -1;                       // address of J1939 of its frames; -1: that in the id, or any
    quint32 mask = CanFrame::ExtendedIds;  // bits of the id that its frames have in common
    bool sharesId = false;                 // with other messages: the multiplexor says whose frame it is

    /// Of frames that are sent.
    quint32 sentId() const { return source < 0 ? description.id : (description.id & ~0xFFU) | quint32(source); }
    /// Whether the id of a frame that was received is that of the message.
    bool accepts(quint32 id) const { return ((id ^ sentId()) & mask) == 0; }
};

/// The keys of a CanDriver, which describes them.
class CanConfiguration
{
public:
    /// What is wrong is told to \a settings.
    void read(QPlcDriverSettings &settings);

    QString device() const { return m_device; }
    QString logFile() const { return m_logFile; }
    int bitRate() const { return m_bitRate; }          ///< [bit/s]; 0: not said
    int dataBitRate() const { return m_dataBitRate; }  ///< likewise, of the data of CAN FD
    const QVector<CanMessage> &messages() const { return m_messages; }
    /// Null if the bus has no such message.
    const CanMessage *find(const QString &message) const;

    /// Reads a bit rate, which is an error for a bus that does not set its own. \return 0: not said
    static int readBitRate(const QString &device, const QString &key, int minimum, int maximum,
                           QPlcDriverSettings &settings);

private:
    void readDbc(QPlcDriverSettings &settings);
    void readFrames(QPlcDriverSettings &settings);
    void readSignals(QPlcDriverSettings &settings);
    void readRules(QPlcDriverSettings &settings);
    void readTimeouts(QPlcDriverSettings &settings);
    void readSources(QPlcDriverSettings &settings);
    void readProtections(QPlcDriverSettings &settings);
    void finish(QPlcDriverSettings &settings);
    void finishIds(QPlcDriverSettings &settings);
    bool addFrame(const QString &name, const QStringList &words, QString *error);
    void warnOfOverlaps(QPlcDriverSettings &settings) const;
    bool addSignal(const QString &name, const QString &text, QString *error);
    CanMessage *messageOf(const QString &name, const QString &key, QPlcDriverSettings &settings);
    QStringList names() const;

    QString m_device;
    QString m_logFile;
    int m_bitRate = 0;
    int m_dataBitRate = 0;
    QVector<CanMessage> m_messages;
};

}  // namespace qplc
