// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QByteArray>
#include <QtCore/QJsonObject>
#include <QtCore/QMetaType>
#include <QtCore/QString>

/// A message on the control channel between master and node or tool: a kind, and fields by name.
///
/// \code
/// const QPlcMessage request(QPlcMessage::GetSignals, {{"names", QJsonArray{"tetherSpeed"}}});
/// QPlcIOSlaveNode node("Operator");
/// node.sendMessageToMaster(request);
/// \endcode
///
/// On the wire it is `u32 length (LE) | u8 kind | UTF-8 JSON object`; the length counts kind and
/// JSON. docs/protocol.md lists the fields of each kind.
///
/// \threadsafe a value type: several threads may read one object
///
/// \ingroup network
class QTPLC_EXPORT QPlcMessage
{
    Q_GADGET
public:
    /// Kinds of messages. *Any* stands for a node or a tool.
    enum Kind : quint8 {
        Invalid = 0,  ///< no message
        Hello = 1,    ///< both ways, first: protocol version, role, signal table
        /// Node -> master: name, policy, inputs, outputs, cyclic channel.
        Register = 2,
        Registered = 3,  ///< master -> node: number of the node, session
        /// Master -> node: why the last message was refused; the connection is closed.
        Rejected = 4,
        /// Node -> master, first on a cyclic TCP connection: token of the node.
        AttachCyclicChannel = 5,
        CyclicChannelAttached = 6,  ///< master -> node: the cyclic channel is in use
        /// Master -> node or tool: the master ends in order; the connection closes.
        MasterEnds = 7,
        InitializeAllStates = 10,           ///< any -> master: initialize all nodes
        SendYourInitialOutputStates = 11,   ///< master -> node: send your initial outputs
        ReceiveMyInitialOutputStates = 12,  ///< node -> master: values of the outputs
        InitializeWithValues = 13,          ///< master -> node: values of the inputs
        Initialized = 14,                   ///< node -> master: initialize() has returned
        /// Master -> all: the initialization has ended, and how.
        StatesInitialized = 15,
        StartRealTime = 20,    ///< any -> master: start the real-time phase
        RealTimeStarted = 21,  ///< master -> node: period, clock, first cycle
        RealTimeReady = 22,    ///< node -> master: it waits for the first cyclic frame
        Stop = 23,             ///< any -> master: stop the real-time phase
        RealTimeStopped = 24,  ///< master -> node: the phase has ended
        SafeStop = 25,         ///< any -> master: stop safely, until Reset
        Reset = 26,            ///< any -> master: leave SafeStop or Fault
        Arm = 27,              ///< any -> master: permit one StartRealTime
        Armed = 28,            ///< master -> asker: token, and how long it is valid
        GetState = 30,         ///< any -> master: ask for the state
        State = 31,            ///< master -> asker: state, nodes, period, and more
        GetSignals = 32,       ///< any -> master: names of signals; none: all
        Signals = 33,          ///< master -> asker: definitions and values
        /// Any -> master: values of signals that no node writes.
        SetSignals = 34,
        Done = 35,  ///< master -> asker: the request was carried out
        /// Master -> asker: the request was refused, and why; the connection stays.
        Failed = 36,
        /// Node -> master: the node cannot go on (exception in its code).
        NodeFault = 40,
        /// Node -> master: an event of its devices or its work, for the event log and recordings.
        NodeEvent = 41,
        /// Any -> master: ask for statistics, with or without histograms.
        GetStatistics = 50,
        /// Master -> asker: durations, counters and worst cycles.
        Statistics = 51,
        GetSchedule = 52,  ///< any -> master: ask for the order of the nodes
        /// Master -> asker: stages of a cycle, and the age of each value.
        Schedule = 53,
        /// Any -> master: take leases of signals, also if nodes write them.
        TakeLease = 60,
        ReleaseLease = 61,  ///< any -> master: release leases of signals
        GetLeases = 62,     ///< any -> master: ask for all leases
        Leases = 63,        ///< master -> asker: all leases and their holders
        /// Master -> all with the feature "leases": all leases, after each change.
        LeasesChanged = 64,
        GetEvents = 65,  ///< any -> master: ask for the events since a number
        /// Master -> asker, and -> all with the feature "events": events.
        Events = 66,
        Note = 67,        ///< any -> master: a remark of a person, for the event log and recordings
        GetRecords = 68,  ///< any -> master: ask for records of cycles, as a recorder
        Records = 69,     ///< master -> asker: bytes of the ring of a phase
        /// Any -> master: end all connections of a node or person, and refuse new ones.
        Evict = 70,
        Admit = 71  ///< any -> master: let somebody in again who was evicted
    };
    Q_ENUM(Kind)

    /// Makes an invalid message.
    QPlcMessage() = default;
    /// Makes a message. The fields are not checked.
    QPlcMessage(Kind kind, const QJsonObject &fields = QJsonObject())
        : m_kind(kind)
        , m_fields(fields)
    {
    }

    /// Returns what the message asks for or tells; it decides which fields it needs.
    Kind kind() const { return m_kind; }
    /// Returns the name of the kind: "Register"; "unknown kind 77" for a kind that this version
    /// does not know.
    QString kindName() const;
    /// Returns the name of a kind, as above.
    static QString kindName(Kind kind);
    /// Returns the fields as JSON, by name: as they travel in the frame.
    QJsonObject fields() const { return m_fields; }

    /// Returns a text field; empty if it is missing or not a text.
    QString text(const QString &field) const { return m_fields.value(field).toString(); }
    /// Returns a 64-bit number. Such numbers travel as texts of 16 hexadecimal digits, because JSON
    /// numbers are doubles. 0 if the field is missing or malformed.
    quint64 hex64(const QString &field) const;
    /// Returns the text of a 64-bit number for a field: 16 digits, lower case.
    static QString fromHex64(quint64 number);
    /// Returns bytes, which travel as base64; empty if the field is missing or malformed.
    QByteArray bytes(const QString &field) const;
    /// Returns the base64 text of bytes for a field.
    static QString fromBytes(const QByteArray &bytes);

    /// Returns true if kind and fields are the same.
    friend bool operator==(const QPlcMessage &a, const QPlcMessage &b)
    {
        return a.m_kind == b.m_kind && a.m_fields == b.m_fields;
    }
    /// Returns true if kind or fields differ.
    friend bool operator!=(const QPlcMessage &a, const QPlcMessage &b) { return !(a == b); }

private:
    Kind m_kind = Invalid;
    QJsonObject m_fields;
};

Q_DECLARE_METATYPE(QPlcMessage)
