// SPDX-License-Identifier: Apache-2.0
#include "RightsWatch.h"

#include "SecretFile.h"

#include <QtCore/QCryptographicHash>

namespace qplc {

RightsWatch::RightsWatch()
{
    m_timer.setInterval(500);  // [ms]
    connect(&m_timer, &QTimer::timeout, this, &RightsWatch::check);
}

void RightsWatch::begin(const QPlcSecurity &security)
{
    end();
    m_security = security;
    m_content.clear();
    m_peers.clear();
    if (security.isNone())
        return;
    m_timer.start();
    check();
}

/// A digest of what the files say, or of why they say nothing. Times of files are too coarse to
/// tell two changes apart.
QByteArray RightsWatch::content() const
{
    QCryptographicHash digest(QCryptographicHash::Sha256);
    const auto add = [&](const QString &fileName, SecretFile::Need need) {
        QByteArray text;
        QString error;
        if (!fileName.isEmpty())
            digest.addData(SecretFile::read(fileName, need, &text, &error) ? text : error.toUtf8());
        digest.addData("\0", 1);
    };
    if (m_security.mode() == QPlcSecurity::PreSharedKeys)
        add(m_security.keysFile(), SecretFile::Secret);
    add(m_security.accessFile(), SecretFile::Trusted);
    return digest.result();
}

void RightsWatch::check()
{
    if (m_security.isNone())
        return;
    const QByteArray present = content();
    if (present == m_content)
        return;
    m_content = present;
    TlsSettings settings;
    QString error;
    if (TlsSettings::read(m_security, QPlcSecurity::MasterSide, &settings, &error)) {
        m_peers = settings.peers();
        Q_EMIT changed();
    } else {
        Q_EMIT unreadable(error);
    }
}

}  // namespace qplc
