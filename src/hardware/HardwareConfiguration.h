// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcChannel.h"
#include "QPlcDriverSettings.h"

#include <QtCore/QVector>

#include <memory>

class QJsonObject;

namespace qplc {

/// A line of a configuration: `key = value`, and where it stands.
struct ConfigurationEntry
{
    QString key;
    QString value;
    int line = 0;    // 0: not known (JSON)
    int column = 0;  // of the value
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

/// What the file of a hardware node says, before anybody knows what it means: the node, and a
/// section for each driver with its wires.
class HardwareConfiguration
{
public:
    /// `target = source`
    struct Wire
    {
        QPlcChannel::Direction direction = QPlcChannel::Read;
        ConfigurationTerm target;  // without factor and offset
        ConfigurationTerm source;
        ConfigurationEntry entry;
    };
    struct SafeValue
    {
        QString channel;
        double value = 0.0;
        ConfigurationEntry entry;
    };
    struct Driver
    {
        QString name;
        QString kind;
        ConfigurationEntry entry;  // that names the kind
        QVector<ConfigurationEntry> keys;
        QVector<Wire> wires;
        QVector<SafeValue> safeValues;
    };
    struct Watched
    {
        QString driver;
        QString channel;
        ConfigurationEntry entry;
    };

    /// Reads \a text. All that is wrong with it is in errors().
    HardwareConfiguration(const QByteArray &text, const QString &fileName);

    QString nodeName() const { return m_nodeName; }
    /// Channels that stop the plant.
    const QVector<Watched> &safeStops() const { return m_safeStops; }
    const QVector<Driver> &drivers() const { return m_drivers; }
    /// Whether a driver has another device than one that is played (`device = fake:NAME`).
    bool hasRealDevices() const;

    /// The keys of \a driver, to be read by it; errors go to errors(). They outlive the result.
    std::unique_ptr<QPlcDriverSettings> settings(const Driver &driver);
    /// After the driver has read its keys: those that are left are misspelt.
    void checkUse(const QPlcDriverSettings &settings);

    void addError(const ConfigurationEntry &entry, const QString &message);
    const QVector<QPlcParseError> &errors() const { return m_errors; }

private:
    struct Section
    {
        QString name;
        int line = 0;
        QVector<ConfigurationEntry> entries;
    };

    void readIni(const QByteArray &text);
    void readJson(const QByteArray &text);
    void readJsonSection(const QString &name, const QJsonObject &object, bool isPart);
    void addSection(const QString &name, int line, int column);
    void addEntry(const ConfigurationEntry &entry);
    void interpret();
    void readNode(const Section &section);
    void readDriver(const Section &section);
    void readPart(const Section &section, const QString &driver, const QString &part);
    void readWire(Driver *driver, QPlcChannel::Direction direction, const ConfigurationEntry &entry);
    void readSafeValue(Driver *driver, const ConfigurationEntry &entry);
    void addError(int line, int column, const QString &message);

    QString m_fileName;
    QVector<Section> m_sections;
    QString m_nodeName;
    QVector<Watched> m_safeStops;
    QVector<Driver> m_drivers;
    QVector<QPlcParseError> m_errors;
};

}  // namespace qplc
