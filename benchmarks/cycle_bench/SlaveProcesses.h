// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QStringList>
#include <QtCore/QVector>

/// Child processes that run this program again; they end with their parent.
class SlaveProcesses
{
public:
    ~SlaveProcesses();
    /// \return false when a process could not be made
    bool start(const QStringList &arguments);
    QVector<qint64> ids() const { return m_ids; }
    bool allAlive() const;

private:
    QVector<qint64> m_ids;
};
