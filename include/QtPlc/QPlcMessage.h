// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QByteArray>
#include <QtCore/QJsonObject>
#include <QtCore/QMetaType>
#include <QtCore/QString>

/// A message on the control channel between master and node: a kind and fields by name.
///
/// On the wire: `u32 length (LE) | u8 kind | UTF-8 JSON object`, where length counts kind and JSON. docs/protocol.md lists the fields of each kind.
/// A value type.
class QTPLC_EXPORT QPlcMessage
{
    Q_GADGET
public:
    enum Kind : quint8 {
        Invalid = 0,
        Hello = 1,                  ///< both ways, first: protocol version, who, table
        Register = 2,               ///< node -> master: name, policy, inputs, outputs, cyclic channel
        Registered = 3,             ///< master -> node: node id, session
        Rejected = 4,               ///< master -> node: why the last message was refused; the connection is closed
        AttachCyclicChannel = 5,    ///< node -> master, first on a cyclic TCP connection: which node it belongs to
        CyclicChannelAttached = 6,  ///< master -> node: the cyclic TCP connection (or UDP address) is in use
        MasterEnds = 7,             ///< master -> node or tool: it ends as wanted, the connection closes
        InitializeAllStates = 10,   ///< anyone -> master
        SendYourInitialOutputStates = 11,   ///< master -> node
        ReceiveMyInitialOutputStates = 12,  ///< node -> master: values
        InitializeWithValues = 13,          ///< master -> node: values
        Initialized = 14,                   ///< node -> master: initialize() has returned
        StatesInitialized = 15,             ///< master -> all: the initialization has ended
        StartRealTime = 20,                 ///< anyone -> master
        RealTimeStarted = 21,               ///< master -> node: period, clock, first cycle
        RealTimeReady = 22,                 ///< node -> master: waiting for the first cyclic frame
        Stop = 23,                          ///< anyone -> master
        RealTimeStopped = 24,               ///< master -> node
        SafeStop = 25,                      ///< anyone -> master: stops safely, until Reset
        Reset = 26,                         ///< anyone -> master: leaves SafeStop or Fault
        Arm = 27,                           ///< anyone -> master: permits one StartRealTime
        Armed = 28,                         ///< master -> asker: token, and how long it is valid
        GetState = 30,                      ///< anyone -> master
        State = 31,                         ///< master -> asker
        GetSignals = 32,                    ///< anyone -> master: names, or none for all
        Signals = 33,                       ///< master -> asker: definitions and values
        SetSignals = 34,                    ///< anyone -> master: values of signals that no node writes
        Done = 35,                          ///< master -> asker: the request was carried out
        Failed = 36,                        ///< master -> asker: the request was refused, and why; the connection stays
        NodeFault = 40,                     ///< node -> master: the node cannot go on (exception in user code)
        GetStatistics = 50,                 ///< anyone -> master: with histograms, or without
        Statistics = 51,                    ///< master -> asker: durations, counters and worst cycles
        GetSchedule = 52,                   ///< anyone -> master
        Schedule = 53,                      ///< master -> asker: stages of a cycle, and the age of every link
        TakeLease = 60,      ///< anyone -> master: takes signals over, also from the nodes that write them
        ReleaseLease = 61,   ///< anyone -> master: gives signals back
        GetLeases = 62,      ///< anyone -> master
        Leases = 63,         ///< master -> asker: who has taken over which signal
        LeasesChanged = 64,  ///< master -> who offers feature "leases": all of them, after each change
        GetEvents = 65,      ///< anyone -> master: what has happened since
        Events = 66          ///< master -> asker, and -> who offers feature "events": what has happened
    };
    Q_ENUM(Kind)

    QPlcMessage() = default;
    QPlcMessage(Kind kind, const QJsonObject &fields = QJsonObject())
        : m_kind(kind)
        , m_fields(fields)
    {
    }

    Kind kind() const { return m_kind; }
    /// "Register"; "unknown kind 77" for one that this version does not know.
    QString kindName() const;
    static QString kindName(Kind kind);
    QJsonObject fields() const { return m_fields; }

    QString text(const QString &field) const { return m_fields.value(field).toString(); }
    /// A 64-bit number, which travels as a text of 16 hexadecimal digits since JSON numbers are doubles; 0 when missing or malformed.
    quint64 hex64(const QString &field) const;
    static QString fromHex64(quint64 number);
    /// Bytes, which travel as base64; empty when missing or malformed.
    QByteArray bytes(const QString &field) const;
    static QString fromBytes(const QByteArray &bytes);

    friend bool operator==(const QPlcMessage &a, const QPlcMessage &b)
    {
        return a.m_kind == b.m_kind && a.m_fields == b.m_fields;
    }
    friend bool operator!=(const QPlcMessage &a, const QPlcMessage &b) { return !(a == b); }

private:
    Kind m_kind = Invalid;
    QJsonObject m_fields;
};

Q_DECLARE_METATYPE(QPlcMessage)
