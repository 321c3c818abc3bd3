// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ExportedNode.h"
#include "HeldPlantConfiguration.h"
#include "QPlcCompactSlaveNode.h"
#include "QPlcEmbeddedMaster.h"

#include <array>
#include <cstring>
#include <map>
#include <utility>

namespace qplc_export {

/// The variable of a signal that is known by name only.
class BytesPort final : public QPlcPort
{
public:
    using Bytes = std::array<char, QPlcSignalType::MaximumSize>;

    BytesPort(QPlcCompactSlaveNode *node, const QPlcSignalDefinition &signal, Direction direction,
              QPlcInputTiming::Value timing = QPlcInputTiming::LastCycle);
    ~BytesPort() override { leaveNode(); }
    const char *bytes() const { return m_bytes.data(); }
    /// \return true when they are others than before
    bool set(const char *bytes);

private:
    QString variableType() const override { return m_type.name(); }
    bool accepts(QPlcSignalType type) const override { return type == m_type; }
    void attach(QPlcSignalType) override {}
    void load(const char *bytes) override { set(bytes); }
    void store(char *bytes) const override { std::memcpy(bytes, m_bytes.data(), std::size_t(m_type.size())); }

    QPlcSignalType m_type;
    Bytes m_bytes{};
};
using BytesPorts = std::vector<std::unique_ptr<BytesPort>>;

/// A node of the plant that is the host: what it writes, or what it reads.
class HostNode : public QPlcCompactSlaveNode
{
public:
    HostNode(const QString &name, const QVector<QPlcSignalDefinition> &signalList, QPlcPort::Direction direction);
    ~HostNode() override { disconnectFromMaster(); }
    /// Where the host writes before a step, or reads after it.
    const BytesPorts &ports() const { return m_ports; }

private:
    void step(const QPlcCycle &) override {}

    BytesPorts m_ports;
};

/// Comes first, so that an application is there before the first object of Qt.
struct PlantMaster
{
    std::unique_ptr<QPlcEmbeddedMaster> m_master = std::make_unique<QPlcEmbeddedMaster>();
};

/// A plant as a node: its inputs are what a host gives to it, its outputs what the host gets. Each
/// cycle of the node is one cycle of the plant, whose nodes are on the network.
///
/// Two nodes in the process of the master stand for the host. One comes first in a cycle, the other
/// one last: from host to plant and back there is no delay but that of the nodes.
class HeldPlantNode final : private PlantMaster, public QPlcCompactSlaveNode, public HeldPlant
{
public:
    /// \param configuration  see HeldPlantConfiguration
    explicit HeldPlantNode(const char *configuration);
    ~HeldPlantNode() override;

    bool prepare(const QPlcSignalTable &table, QPlcSignalTable *host, QString *error) override;
    bool readSetting(const QString &key, const QString &text, QPlcValue *value, QString *error) const override
    {
        return m_configuration.readSetting(key, text, value, error);
    }
    bool open(const QPlcNodeRunner &runner, QString *error) override;
    void close() override { m_isOpen = false; }
    QString warning() const override { return m_warning; }
    QString endReason() const override { return m_endReason; }
    void setTeller(const std::function<void(News news, const QString &text)> &tell) override { m_tell = tell; }

private:
    using State = QPlcMasterNode::State;

    void reset() override;
    void initialized() override;
    void step(const QPlcCycle &cycle) override;
    void stopped() override;

    bool setUp(const QPlcNodeRunner &runner, QString *error);
    bool configure(QPlcMasterNode &master, const QPlcNodeRunner &runner, QString *error) const;
    bool addHost();
    bool listen(const QPlcNodeRunner &runner);
    bool makeReady(QString *error);
    bool giveInputs();
    void takeOutputs();
    QString failure();
    [[noreturn]] void fail(const QString &text);
    QString lateText(quint64 cycle);

    const QByteArray m_text;
    HeldPlantConfiguration m_configuration;
    QPlcSignalTable m_table;
    QVector<QPlcValue> m_settings;  // with which the master listens; empty: it does not
    HostNode *m_giver = nullptr;    // of the master; null: the host gives nothing
    HostNode *m_reader = nullptr;   // of the master; null: the host gets nothing
    BytesPorts m_settingPorts;
    BytesPorts m_inputs;
    BytesPorts m_outputs;
    bool m_isOpen = false;
    std::chrono::milliseconds m_startTimeout{0};
    std::map<QString, quint64> m_late;  // answers of each node
    QString m_warning;
    QString m_endReason;
    std::function<void(News news, const QString &text)> m_tell = [](News, const QString &) {};
};

}  // namespace qplc_export
