// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "signals/ConfigurationFile.h"

#include <chrono>
#include <optional>

namespace qplc {

/// What the file of an FMU node says, before the FMU is opened.
class FmuConfiguration : public ConfigurationFile
{
public:
    /// Reads \a text. All that is wrong with it is in errors().
    FmuConfiguration(const QByteArray &text, const QString &fileName);
    /// That of a node whose signals are named as its variables.
    /// \param fmu  file name of the FMU
    explicit FmuConfiguration(const QString &fmu);

    const QString &nodeName() const { return m_nodeName; }
    /// The file of the FMU, relative to the folder of this file.
    QString fmuName() const;
    const ConfigurationEntry &fmuEntry() const { return m_fmu; }
    std::chrono::nanoseconds step() const { return m_step; }  // 0: the period
    std::optional<double> tolerance() const { return m_tolerance; }
    bool logs() const { return m_logs; }
    const QVector<ConfigurationEntry> &starts() const { return m_starts; }
    const QVector<ConfigurationEntry> &reads() const { return m_reads; }
    const QVector<ConfigurationEntry> &writes() const { return m_writes; }
    /// Whether there is a section for wires; without one, names decide.
    bool hasWires() const { return m_hasWires; }

private:
    void interpret();
    void readNode(const ConfigurationEntry &entry);
    void readFmu(const ConfigurationEntry &entry);

    QString m_nodeName;
    ConfigurationEntry m_fmu;
    std::chrono::nanoseconds m_step{0};
    std::optional<double> m_tolerance;
    bool m_logs = false;
    bool m_hasWires = false;
    QVector<ConfigurationEntry> m_starts;
    QVector<ConfigurationEntry> m_reads;
    QVector<ConfigurationEntry> m_writes;
};

}  // namespace qplc
