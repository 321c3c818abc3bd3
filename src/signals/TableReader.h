// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "IniParser.h"
#include "QPlcParseError.h"
#include "SignalRules.h"

#include <QtCore/QHash>

#include <array>

namespace qplc {

/// What is wrong with a file: all of it is counted, the first hundred are kept.
class ErrorCollector
{
public:
    static constexpr int MaximumErrors = 100;

    explicit ErrorCollector(const QString &file)
        : m_file(file)
    {
    }
    void add(int line, int column, const QString &message);
    int count() const { return m_count; }
    /// In the order of the file; a last one says how many more there are.
    QVector<QPlcParseError> errors() const;

private:
    QString m_file;
    QVector<QPlcParseError> m_errors;
    int m_count = 0;
};

/// Reads the signals of a table and finds everything that is wrong with it.
class TableReader
{
public:
    enum class UnknownKeys : quint8 { Refused, Ignored };

    TableReader(const QByteArray &text, const QString &fileName, UnknownKeys unknownKeys);

    /// The signals in the order of the text; not to be used when there are errors.
    QVector<QPlcSignalDefinition> read();
    QVector<QPlcParseError> errors() const { return m_errors.errors(); }

private:
    struct Entry
    {
        int line = 0;  // 0: the section has no such key
        int column = 0;
        int valueColumn = 0;
        bool isWrong = false;  // reported already
        QString value;
    };

    void openSection(const IniItem &item);
    void addEntry(const IniItem &item);
    void closeSection();
    void readType();
    void readValues();
    void readValue(SignalKey key, QPlcSignalType type, QPlcValue *value);
    void readNames();
    void readWriters();
    void readNan();
    void readSlope();
    void readVolatile();
    void complain(const Complaint &complaint);
    Entry &entry(SignalKey key) { return m_entries[std::size_t(key)]; }

    IniParser m_parser;
    UnknownKeys m_unknownKeys;
    ErrorCollector m_errors;
    QVector<QPlcSignalDefinition> m_signals;
    QHash<QString, int> m_firstLines;  // of signal names

    // the open section
    enum class State : quint8 {
        BeforeFirst,
        Open,
        Wrong
    };  // Wrong: its first line is broken, so its name is not known
    State m_state = State::BeforeFirst;
    QPlcSignalDefinition m_signal;
    int m_nameColumn = 0;
    bool m_hasBrokenLine = false;  // it may be the one that is missed
    std::array<Entry, signalKeyCount> m_entries;
};

}  // namespace qplc
