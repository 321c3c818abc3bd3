// SPDX-License-Identifier: Apache-2.0
#include "PlantConfiguration.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QHash>

// Resources of a static library are found only by programs that ask for them, outside of any namespace.
static void loadHardware()
{
    Q_INIT_RESOURCE(hardware);
}

namespace awe {

namespace {

const QString winchSection = QStringLiteral("winch");
const QStringList winchKeys{QStringLiteral("kind"), QStringLiteral("hardware"), QStringLiteral("simulated")};

QString withoutComment(const QByteArray &line)
{
    const QString text = QString::fromUtf8(line).trimmed();
    if (text.startsWith(QLatin1Char(';')) || text.startsWith(QLatin1Char('#')))
        return {};
    return text.section(QStringLiteral(" ;"), 0, 0).trimmed();
}

/// The keys of section [winch]. \return false, with line and remedy in \a error
bool readWinchSection(QFile *file, QHash<QString, QString> *values, QString *error)
{
    bool isInside = false;
    for (int number = 1; !file->atEnd(); ++number) {
        const QString line = withoutComment(file->readLine());
        const QString key = line.section(QLatin1Char('='), 0, 0).trimmed();
        if (line.isEmpty())
            continue;
        if (line == QStringLiteral("[%1]").arg(winchSection))
            isInside = true;
        else if (!isInside)
            *error = QStringLiteral("'%1' is not known here; the only section is [%2]").arg(line, winchSection);
        else if (!line.contains(QLatin1Char('=')) || !winchKeys.contains(key))
            *error = QStringLiteral("'%1' is no key of [%2]; its keys are %3")
                         .arg(key, winchSection, winchKeys.join(QStringLiteral(", ")));
        else
            values->insert(key, line.section(QLatin1Char('='), 1).trimmed());
        if (!error->isEmpty()) {
            *error = QStringLiteral("%1:%2: %3").arg(file->fileName()).arg(number).arg(*error);
            return false;
        }
    }
    return true;
}

}  // namespace

QString PlantConfiguration::builtInFile()
{
    loadHardware();
    return QStringLiteral(":/hardware/plant.ini");
}

bool PlantConfiguration::read(const QString &fileName, PlantConfiguration *configuration, QString *error)
{
    QFile file(fileName);
    if (!file.open(QIODevice::ReadOnly)) {
        *error = QStringLiteral("cannot read the plant %1: %2; choose another file").arg(fileName, file.errorString());
        return false;
    }
    QHash<QString, QString> values;
    if (!readWinchSection(&file, &values, error))
        return false;
    const QString kind = values.value(QStringLiteral("kind"), QStringLiteral("ideal"));
    if (!winchKindFromText(kind, &configuration->winch)) {
        *error = QStringLiteral("%1: kind = %2: use ideal or drive").arg(fileName, kind);
        return false;
    }
    const QString hardware = values.value(QStringLiteral("hardware"));
    configuration->winchHardware = hardware.isEmpty() ? QString() : QFileInfo(fileName).dir().filePath(hardware);
    configuration->simulatedWinch = values.value(QStringLiteral("simulated"));
    return true;
}

bool winchKindFromText(const QString &word, WinchKind *kind)
{
    if (word != QLatin1String("ideal") && word != QLatin1String("drive"))
        return false;
    *kind = word == QLatin1String("drive") ? WinchKind::Drive : WinchKind::Ideal;
    return true;
}

const char *winchSpeedSignal(WinchKind kind)
{
    return kind == WinchKind::Drive ? "winchSpeed" : "tetherSpeed";
}

}  // namespace awe
