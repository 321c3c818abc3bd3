// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "EntryStrip.h"
#include "node/session/MasterFinder.h"

namespace qplc {

class BarButton;
class FoundMasters;

/// Asks for the address of a master.
class ConnectStrip : public EntryStrip
{
    Q_OBJECT
public:
    /// \param context  outlives the strip
    explicit ConnectStrip(WindowContext *context, QWidget *parent = nullptr);

    void setRecentMasters(const QStringList &addresses);
    void setFoundMasters(const QVector<FoundMaster> &masters);
    /// Shows the strip, with the keys in its field.
    void open();

    /// What is wrong with an address; empty: nothing.
    static QString errorOf(const QString &address);

Q_SIGNALS:
    void connectRequested(const QString &address);

private:
    QWidget *makeFoundRow();
    void choose(const QString &address);
    void accept() override;

    QWidget *m_recent;
    QHBoxLayout *m_recentRow;
    BarButton *m_close;
    FoundMasters *m_found;
    QWidget *m_foundRow;
};

}  // namespace qplc
