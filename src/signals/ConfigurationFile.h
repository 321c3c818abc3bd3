// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcParseError.h"

#include <QtCore/QString>
#include <QtCore/QVector>

namespace qplc {

/// A line of a configuration: `key = value`, and where it stands.
struct ConfigurationEntry
{
    QString key;
    QString value;
    int line = 0;    // 0: not known (JSON)
    int column = 0;  // of the value
};

/// A section of a configuration: `[name]`, and its lines.
struct ConfigurationSection
{
    QString name;
    int line = 0;
    QVector<ConfigurationEntry> entries;
};

/// A name of something that is a number, converted: `acceleration[2] * 9.81 + 0.1`.
struct ConfigurationTerm
{
    QString name;
    int element = -1;  // of an array; -1: it is none
    double factor = 1.0;
    double offset = 0.0;

    /// \return false, with what would be right in \a error
    static bool fromText(const QString &text, ConfigurationTerm *term, QString *error);
};

/// The sections of the configuration of a node, and all errors that are found in it, before anybody
/// knows what it means.
class ConfigurationFile
{
public:
    /// \param fileName  for messages
    explicit ConfigurationFile(const QString &fileName)
        : m_fileName(fileName)
    {
    }

    /// Reads an INI text. \param firstSections  what it should begin with, for a message
    void readIni(const QByteArray &text, const QString &firstSections);
    void addSection(const QString &name, int line, int column);
    /// \param section  its number in sections()
    void addEntry(int section, const ConfigurationEntry &entry);
    const QVector<ConfigurationSection> &sections() const { return m_sections; }

    const QString &fileName() const { return m_fileName; }
    void addError(int line, int column, const QString &message);
    void addError(const ConfigurationEntry &entry, const QString &message);
    const QVector<QPlcParseError> &errors() const { return m_errors; }

protected:
    QVector<QPlcParseError> *errorList() { return &m_errors; }

private:
    QString m_fileName;
    QVector<ConfigurationSection> m_sections;
    QVector<QPlcParseError> m_errors;
};

/// \return false when \a text is not a number, or not a finite one
bool finiteNumberFromText(const QString &text, double *number);

}  // namespace qplc
