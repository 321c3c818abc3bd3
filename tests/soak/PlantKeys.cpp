// SPDX-License-Identifier: Apache-2.0
#include "PlantKeys.h"

#include "SoakPlant.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QRandomGenerator>

namespace soak {

namespace {

constexpr QLatin1String OperatorName("operator");
constexpr QLatin1String ObserverName("observer");

QString strangerFileIn(const QString &folder)
{
    return QDir(folder).filePath(QStringLiteral("stranger.ini"));
}

QByteArray section(const QString &identity, const char *role)
{
    QByteArray key(32, '\0');
    for (char &byte : key)
        byte = char(QRandomGenerator::system()->generate());
    return '[' + identity.toUtf8() + "]\nkey = " + key.toHex() + "\nrole = " + role + "\n\n";
}

bool writeSecret(const QString &fileName, const QByteArray &text, QString *error)
{
    QFile file(fileName);
    const bool isWritten = file.open(QIODevice::WriteOnly)
        && file.setPermissions(QFileDevice::ReadOwner | QFileDevice::WriteOwner) && file.write(text) == text.size()
        && file.flush();
    if (!isWritten)
        *error = QStringLiteral("cannot write %1: %2").arg(fileName, file.errorString());
    return isWritten;
}

}  // namespace

bool PlantKeys::write(const QString &folder, int nodes, QString *error)
{
    QByteArray text = section(OperatorName, "Operator") + section(ObserverName, "Observer");
    for (int node = 0; node < nodes; ++node)
        text += section(nodeName(node), "Node");
    return writeSecret(fileIn(folder), text, error)
        && writeSecret(strangerFileIn(folder), section(OperatorName, "Operator"), error);
}

QString PlantKeys::fileIn(const QString &folder)
{
    return QDir(folder).filePath(QStringLiteral("keys.ini"));
}

QPlcSecurity PlantKeys::ofOperator(const QString &folder)
{
    return QPlcSecurity::preSharedKeys(fileIn(folder), OperatorName);
}

QPlcSecurity PlantKeys::ofObserver(const QString &folder)
{
    return QPlcSecurity::preSharedKeys(fileIn(folder), ObserverName);
}

QPlcSecurity PlantKeys::ofStranger(const QString &folder)
{
    return QPlcSecurity::preSharedKeys(strangerFileIn(folder), OperatorName);
}

}  // namespace soak
