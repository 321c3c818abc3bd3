// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plant/Plant.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QPointer>

namespace qplc {

/// What a person can do about a row of the nodes: evict the node or person, or admit it again. A
/// value type; its plant may end before it.
class NodeEviction
{
    Q_DECLARE_TR_FUNCTIONS(NodeEviction)
public:
    NodeEviction() = default;
    /// \param name  of a node or person; empty: the master
    NodeEviction(Plant *plant, const QString &name);

    QString name() const { return m_name; }
    /// Whether the name is evicted now, and would be admitted.
    bool isAdmission() const { return m_isAdmission; }
    /// "Evict 'Winch'"
    QString title() const { return titleOf(m_name, m_isAdmission); }
    /// \param name  empty: of nobody
    static QString titleOf(const QString &name, bool isAdmission);
    /// Why this window cannot do it; empty: it can.
    QString obstacle() const;
    /// A question with all that would happen now.
    QString question() const;
    void carryOut() const;

private:
    QString effectOnCycles() const;
    QString effectOnLeases() const;

    QPointer<Plant> m_plant;
    QString m_name;
    bool m_isAdmission = false;
};

}  // namespace qplc
