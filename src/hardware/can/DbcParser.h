// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DbcFile.h"
#include "DbcReader.h"

#include <QtCore/QHash>

namespace qplc {

/// Reads the statements of a DBC file into messages.
class DbcParser
{
public:
    DbcParser(const QString &text, const QString &fileName);

    /// The whole file. \return empty when there are errors()
    QVector<DbcMessage> parse();
    QVector<QPlcParseError> errors() const { return m_reader.errors(); }

private:
    using Statement = void (DbcParser::*)();
    struct Attribute
    {
        int message = -1;  // index
        QString name;
        DbcToken value;
    };

    static Statement statementOf(const QString &keyword);
    static bool isKeyword(const QString &word);

    void skip() { m_reader.skipStatement(); }
    void skipLines();
    void newSymbols();
    void message();
    void signal();
    void valueNames();
    void floatKind();
    void extendedMultiplexing();
    void attribute();
    void attributeDefault();

    bool readId(DbcMessage *message);
    bool readSize(DbcMessage *message);
    bool addMessage(const DbcToken &at, const DbcMessage &message);
    bool addSignal(const DbcToken &at, const DbcSignal &signal, bool isExtended);
    DbcMessage *expectMessage();
    DbcSignal *expectSignal(DbcMessage *message);
    void setAttribute(DbcMessage *message, const Attribute &attribute);
    void finish();

    DbcReader m_reader;
    QVector<DbcMessage> m_messages;
    QHash<quint64, int> m_indexOfId;
    QHash<QString, int> m_indexOfName;
    QVector<Attribute> m_defaults;
    QVector<Attribute> m_attributes;  // of messages
    double m_startValue = 0.0;        // raw, of signals that have none of their own
    int m_signalCount = 0;
    int m_current = -1;        // the message that SG_ belongs to; -1: none
    bool m_isSkipped = false;  // SG_ belongs to a message that is no message
};

}  // namespace qplc
