// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcNodeRunner.h"

#include <functional>
#include <memory>

namespace qplc_export {

/// What the functions of QtPlcExport.cmake write down for their library.
struct Identity
{
    const char *name;         // of the target: letters, digits, underscores
    const char *description;  // for people; may be empty
    const char *table;        // text of the signal table
    qint64 period;            // [ns]; 0: the one of the host
    std::unique_ptr<QPlcSlaveNode> (*make)();
};
extern const Identity identity;

/// What a node is beyond a node if a whole plant is behind it (HeldPlantNode).
///
/// Its settings are signals with the name "plant.KEY" that it reads: a host sets them as it sets
/// inputs, and open() takes them.
class HeldPlant
{
public:
    virtual ~HeldPlant() = default;
    /// Reads the configuration. To be called once, before bind().
    /// \param host  gets the table as the host sees it: settings, and no `writer`
    /// \return false, with a sentence in \a error
    virtual bool prepare(const QPlcSignalTable &table, QPlcSignalTable *host, QString *error) = 0;
    /// Reads the value of a setting from a text. \return false, with a sentence in \a error
    virtual bool readSetting(const QString &key, const QString &text, QPlcValue *value, QString *error) const = 0;
    /// Listens, waits for the nodes, and initializes them, all that within the start timeout. Then
    /// reset() of the node has their initial values.
    /// \param runner  of this node: its inputs, settings and period
    /// \return false, with a sentence in \a error
    virtual bool open(const QPlcNodeRunner &runner, QString *error) = 0;
    /// The next reset() has the values of the table; nodes stay connected.
    virtual void close() = 0;
    /// What was wrong in the last cycle, although it counts; empty: nothing.
    virtual QString warning() const = 0;
    /// Why the phase has failed, or why the simulation shall end; empty: neither.
    virtual QString endReason() const = 0;
    /// What the plant tells: where it listens, and what it has computed.
    enum class News : quint8 { Address, Result };
    /// Sets who is told: the log of the host.
    virtual void setTeller(const std::function<void(News news, const QString &text)> &tell) = 0;
};

/// A node that somebody else's program calls, with its own table.
class ExportedNode
{
public:
    /// \return false, with a sentence in \a error
    bool make(QString *error);
    /// Brings up the plant behind the node, if there is one. Inputs stay as they are.
    /// \pre the runner is reset
    /// \return false, with a sentence in \a error
    bool open(QString *error);
    /// Sets a setting of the plant from a text. \return false, with a sentence in \a error
    bool setSetting(const QString &key, const QString &text, QString *error);
    /// Why the runner has failed.
    QString failure() const;
    bool isSetting(QPlcSignalIndex index) const
    {
        return m_plant && signal(index).name.startsWith(QLatin1String(SettingPrefix));
    }
    /// Null: there is none.
    HeldPlant *plant() { return m_plant; }
    const HeldPlant *plant() const { return m_plant; }
    QPlcNodeRunner &runner() { return *m_runner; }
    const QPlcNodeRunner &runner() const { return *m_runner; }
    const QPlcSlaveNode &node() const { return *m_node; }
    const QPlcSignalDefinition &signal(QPlcSignalIndex index) const { return m_runner->table().at(index); }

    static constexpr const char *SettingPrefix = "plant.";

private:
    std::unique_ptr<QPlcSlaveNode> m_node;
    HeldPlant *m_plant = nullptr;  // the node, if it is one
    std::unique_ptr<QPlcNodeRunner> m_runner;
};

}  // namespace qplc_export
