// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcChannel.h"
#include "QPlcDriverSettings.h"
#include "signals/ConfigurationFile.h"

#include <QtCore/QMap>
#include <QtCore/QVector>

#include <memory>

class QJsonObject;

namespace qplc {

/// What the file of a hardware node says, before anybody knows what it means: the node, and a
/// section for each driver with its wires.
class HardwareConfiguration : public ConfigurationFile
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

    /// Of what is used once.
    struct Claim
    {
        int line = 0;
        QString user;  // who may use it again; empty: nobody
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
    /// Whether an error of the settings may be the reason why a driver has no such channel.
    static bool isExcused(const QPlcDriverSettings &settings, const QString &channel);

    /// What is doubtful, and no error.
    const QVector<QPlcParseError> &warnings() const { return m_warnings; }
    void addWarning(const ConfigurationEntry &entry, const QString &message);

private:
    void readJson(const QByteArray &text);
    void readJsonSection(const QString &name, const QJsonObject &object, bool isPart);
    void interpret();
    void readNode(const ConfigurationSection &section);
    void readDriver(const ConfigurationSection &section);
    void readPart(const ConfigurationSection &section, const QString &driver, const QString &part);
    void readWire(Driver *driver, QPlcChannel::Direction direction, const ConfigurationEntry &entry);
    void readSafeValue(Driver *driver, const ConfigurationEntry &entry);

    QString m_nodeName;
    QVector<Watched> m_safeStops;
    QVector<Driver> m_drivers;
    QVector<QPlcParseError> m_warnings;
    QMap<QString, Claim> m_claims;
};

}  // namespace qplc
