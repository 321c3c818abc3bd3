// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "node/session/MasterFinder.h"

#include <QtCore/QSet>

class QWidget;

namespace qplc {

/// Looks for masters while somebody wants to see them, and not while a plant is flown.
class MasterSearch : public QObject
{
    Q_OBJECT
public:
    explicit MasterSearch(QObject *parent = nullptr);

    /// From now on the search goes on whenever \a place is visible.
    void watch(QWidget *place);
    /// Whether nothing is looked for, whatever is visible; a test tells its own by found().
    void setSilent(bool isSilent);

    bool eventFilter(QObject *place, QEvent *event) override;

Q_SIGNALS:
    void found(const QVector<qplc::FoundMaster> &masters);

private:
    void begin(QObject *place);
    void end(QObject *place);

    MasterFinder m_finder;
    QSet<QObject *> m_visible;
    bool m_isSilent = false;
};

}  // namespace qplc
