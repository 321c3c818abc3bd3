// SPDX-License-Identifier: Apache-2.0
// The part of QPlcApplicationOptions that makes a QPlcSecurity of options.
#include "QPlcApplicationOptions.h"

namespace {

struct SecurityOption
{
    const char *name;
    const char *value;
    const char *description;
};

constexpr SecurityOption options[] = {
    {"security", "psk|cert", "TLS with pre-shared keys, or with certificates. Without it: none."},
    {"keys", "FILE", "Keys of identities, for --security psk: see qtplc help keys."},
    {"certificate", "FILE", "Certificate of this program (PEM), for --security cert."},
    {"key", "FILE", "Private key of the certificate (PEM), which only its owner may read."},
    {"authority", "FILE", "Certificate of the authority that made all certificates (PEM)."},
};
constexpr SecurityOption nodeOption{"identity", "NAME",
                                    "Identity of this program, for --security psk. Default: the only one in the file."};
constexpr SecurityOption masterOption{"access", "FILE", "Roles of identities, and the signals that they may write."};

QString nameOf(const SecurityOption &option)
{
    return QString::fromLatin1(option.name);
}

void add(QPlcApplicationOptions &application, const SecurityOption &option)
{
    application.addOption(
        QCommandLineOption(nameOf(option), QString::fromLatin1(option.description), QString::fromLatin1(option.value)));
}

}  // namespace

void QPlcApplicationOptions::addSecurityOptions(QPlcSecurity::Side side)
{
    for (const SecurityOption &option : options)
        add(*this, option);
    add(*this, side == QPlcSecurity::MasterSide ? masterOption : nodeOption);
}

bool QPlcApplicationOptions::readSecurityOptions(QPlcSecurity::Side side, QPlcSecurity *security)
{
    const auto fail = [this](const QString &text) {
        usageError(text);
        return false;
    };
    const QString mode = value(QStringLiteral("security"));
    *security = QPlcSecurity();
    if (mode.isEmpty()) {
        const bool isMaster = side == QPlcSecurity::MasterSide;
        for (const char *name : {"keys", "certificate", "key", "authority", isMaster ? "access" : "identity"}) {
            if (isSet(QString::fromLatin1(name)))
                return fail(QStringLiteral("--%1 is for --security psk or --security cert: give one of them")
                                .arg(QLatin1String(name)));
        }
        return true;
    }
    if (mode == QLatin1String("psk")) {
        if (!isSet(QStringLiteral("keys")))
            return fail(QStringLiteral("--security psk needs --keys FILE; make one by qtplc keys new"));
        *security = QPlcSecurity::preSharedKeys(value(QStringLiteral("keys")),
                                                side == QPlcSecurity::NodeSide ? value(QStringLiteral("identity"))
                                                                               : QString());
    } else if (mode == QLatin1String("cert")) {
        for (const char *name : {"certificate", "key", "authority"}) {
            if (!isSet(QString::fromLatin1(name)))
                return fail(QStringLiteral("--security cert needs --%1 FILE").arg(QLatin1String(name)));
        }
        *security = QPlcSecurity::certificates(value(QStringLiteral("certificate")), value(QStringLiteral("key")),
                                               value(QStringLiteral("authority")));
    } else {
        return fail(QStringLiteral("--security '%1': use psk or cert").arg(mode));
    }
    if (side == QPlcSecurity::MasterSide)
        security->setAccessFile(value(QStringLiteral("access")));
    const QString error = security->errorString(side);
    return error.isEmpty() || fail(error);
}
