// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "TlsSettings.h"

#include <QtCore/QObject>
#include <QtCore/QTimer>

namespace qplc {

/// Reads the files of keys and rights of a master again when they have changed.
class RightsWatch : public QObject
{
    Q_OBJECT
public:
    RightsWatch();

    /// Without security nothing is watched.
    void begin(const QPlcSecurity &security);
    void end() { m_timer.stop(); }
    /// Looks whether they have changed; the time does so, too.
    void check();
    /// All that may come, as the files have said when they could be read last.
    const QMap<QString, Peer> &peers() const { return m_peers; }

Q_SIGNALS:
    /// peers() are others.
    void changed();
    void unreadable(const QString &error);

private:
    QByteArray content() const;

    QPlcSecurity m_security;
    QTimer m_timer;
    QByteArray m_content;  // a digest: keys stay in their file
    QMap<QString, Peer> m_peers;
};

}  // namespace qplc
