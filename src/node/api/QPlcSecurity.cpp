// SPDX-License-Identifier: Apache-2.0
#include "QPlcSecurity.h"

#include "node/security/TlsSettings.h"
#include "signals/ProgramScope.h"

namespace {

// A type that no other library sees.
struct ProgramSecurity
{
    QPlcSecurity security;
};

QPlcSecurity &currentSecurity()
{
    return qplc::ProgramScope::current().the<ProgramSecurity>().security;
}

}  // namespace

QPlcSecurity QPlcSecurity::preSharedKeys(const QString &keysFile, const QString &identity)
{
    QPlcSecurity security;
    security.m_mode = PreSharedKeys;
    security.m_keysFile = keysFile;
    security.m_identity = identity;
    return security;
}

QPlcSecurity QPlcSecurity::certificates(const QString &certificateFile, const QString &privateKeyFile,
                                        const QString &authorityFile)
{
    QPlcSecurity security;
    security.m_mode = Certificates;
    security.m_certificateFile = certificateFile;
    security.m_privateKeyFile = privateKeyFile;
    security.m_authorityFile = authorityFile;
    return security;
}

QString QPlcSecurity::modeName() const
{
    switch (m_mode) {
    case None:
        return QStringLiteral("none");
    case PreSharedKeys:
        return QStringLiteral("psk");
    case Certificates:
        return QStringLiteral("cert");
    }
    return {};
}

QString QPlcSecurity::errorString(Side side) const
{
    qplc::TlsSettings settings;
    QString error;
    qplc::TlsSettings::read(*this, side, &settings, &error);
    return error;
}

QPlcSecurity QPlcSecurity::current()
{
    return currentSecurity();
}

void QPlcSecurity::setCurrent(const QPlcSecurity &security)
{
    currentSecurity() = security;
}
