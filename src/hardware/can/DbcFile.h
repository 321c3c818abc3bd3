// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DbcSignal.h"
#include "QPlcParseError.h"

#include <QtCore/QVector>

#include <chrono>

namespace qplc {

/// One message of a DBC file: what the frames of an id carry.
struct DbcMessage
{
    QString name;
    quint32 id = 0;
    bool isExtended = false;                // id of 29 bits
    bool isFd = false;                      // frames of CAN FD
    bool hasBitRateSwitch = true;           // CAN FD only
    int size = 8;                           // [byte]
    std::chrono::nanoseconds cycleTime{0};  // between two frames; 0: not cyclic, or not said
    QVector<DbcSignal> content;
    int multiplexor = -1;  // index in content; -1: none
    QString unsupported;   // why its frames cannot be used; empty: they can

    const DbcSignal *find(const QString &signal) const;
};

/// What a DBC file says of the messages of a CAN bus.
///
/// Read are messages (BO_), signals (SG_) with one multiplexor, floats (SIG_VALTYPE_), names of
/// values (VAL_), and of the attributes (BA_, BA_DEF_DEF_) GenMsgCycleTime, GenSigStartValue,
/// VFrameFormat and CANFD_BRS. Everything else is skipped. A message with more than one multiplexor
/// (extended multiplexing) or a size that no frame has is kept with the reason why it cannot be
/// used, so that a large file can be used for its other messages. The text is UTF-8, else Latin-1.
class DbcFile
{
public:
    static constexpr int MaximumSize = 32 << 20;  // [byte]
    static constexpr int MaximumMessages = 20000;
    static constexpr int MaximumSignals = 200000;  // of all messages
    static constexpr int MaximumErrors = 20;       // that are told

    /// \param fileName  for errors \return empty when there are \a errors
    static DbcFile fromText(const QByteArray &text, const QString &fileName, QVector<QPlcParseError> *errors);
    /// As above; a file that cannot be read is an error of line 0.
    static DbcFile fromFile(const QString &fileName, QVector<QPlcParseError> *errors);
    /// The part of a line SG_ behind its name: `m3 8|16@1- (0.1,0) [0|100] "rpm"`, of which only
    /// `8|16@1-` is needed. `@1f` and `@0f` are floats.
    /// \return false, with what is wrong in \a error
    static bool readSignal(const QString &text, DbcSignal *signal, QString *error);
    /// Checks what holds between the parts of a message and the message. \return what is wrong,
    /// empty when nothing is
    static QString problemOf(const DbcMessage &message, const DbcSignal &signal);

    bool isEmpty() const { return m_messages.isEmpty(); }
    const QVector<DbcMessage> &messages() const { return m_messages; }
    const DbcMessage *find(const QString &message) const;

private:
    QVector<DbcMessage> m_messages;
};

}  // namespace qplc
