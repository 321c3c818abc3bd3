// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DbcSignal.h"
#include "QPlcParseError.h"

#include <QtCore/QPair>
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
    bool isJ1939 = false;                   // a parameter group of J1939, which any source may send
    int size = 8;                           // [byte]
    std::chrono::nanoseconds cycleTime{0};  // between two frames; 0: not cyclic, or not said
    std::chrono::nanoseconds delayTime{0};  // at least between two frames; 0: not said
    QVector<DbcSignal> content;
    QString unsupported;  // why its frames cannot be used; empty: they can

    const DbcSignal *find(const QString &signal) const;
    bool isMultiplexed() const;
    /// Gives each multiplexed signal its multiplexor, if the file has not said which one it is.
    /// \return an error text; empty if each has one
    QString connectMultiplexors();

    // ---- after connectMultiplexors() ----
    /// Multiplexors between a frame and a signal: 0 for one that is always there.
    int depthOf(const DbcSignal &signal) const noexcept;
    /// Whether \a data holds the signal: its multiplexor, and the multiplexors of that one, say so.
    bool isThere(const DbcSignal &signal, const quint8 *data) const noexcept;
    /// Whether \a data holds any of its multiplexed signals.
    bool hasPage(const quint8 *data) const noexcept;
    /// Whether a frame can hold both signals, with a bit in common.
    bool overlap(const DbcSignal &a, const DbcSignal &b) const;
    /// Signals that overlap(), at most 20 pairs. Of a message with very many signals only the first
    /// ones are compared.
    QVector<QPair<QString, QString>> overlappingSignals() const;
};

/// What a DBC file says of the messages of a CAN bus.
///
/// Read are messages (BO_), signals (SG_), also with extended multiplexing (SG_MUL_VAL_), floats
/// (SIG_VALTYPE_), names of values (VAL_), and of the attributes (BA_, BA_DEF_DEF_)
/// GenMsgCycleTime, GenMsgDelayTime, GenSigStartValue, VFrameFormat, CANFD_BRS and ProtocolType.
/// Everything else is skipped. A message whose multiplexors are not clear, or with a size that no
/// frame has, is kept with the reason why it cannot be used, so that a large file can be used for
/// its other messages. The text is UTF-8, else Latin-1.
class DbcFile
{
public:
    static constexpr int MaximumSize = 32 << 20;  // [byte]
    static constexpr int MaximumMessages = 20000;
    static constexpr int MaximumSignals = 200000;  // of all messages
    static constexpr int MaximumErrors = 20;       // that are told
    static constexpr int LongestMessage = 1785;    // [byte] of J1939, by its transport protocol

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
    /// Why no frame can have the size of a message; empty if one can.
    static QString sizeProblemOf(const DbcMessage &message);

    bool isEmpty() const { return m_messages.isEmpty(); }
    const QVector<DbcMessage> &messages() const { return m_messages; }
    const DbcMessage *find(const QString &message) const;

private:
    QVector<DbcMessage> m_messages;
};

}  // namespace qplc
