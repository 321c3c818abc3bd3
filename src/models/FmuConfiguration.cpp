// SPDX-License-Identifier: Apache-2.0
#include "FmuConfiguration.h"

#include "signals/DurationText.h"
#include "signals/MessageText.h"

#include <QtCore/QDir>
#include <QtCore/QFileInfo>

#include <cmath>

namespace qplc {

namespace {

const QString firstSections = QStringLiteral("[node] or [fmu]");
const QStringList sectionNames{QStringLiteral("node"), QStringLiteral("fmu"), QStringLiteral("fmu.start"),
                               QStringLiteral("fmu.read"), QStringLiteral("fmu.write")};
const QStringList fmuKeys{QStringLiteral("file"), QStringLiteral("step"), QStringLiteral("tolerance"),
                          QStringLiteral("log")};
constexpr double longestStep = 10e9;  // [ns]

}  // namespace

FmuConfiguration::FmuConfiguration(const QByteArray &text, const QString &fileName)
    : ConfigurationFile(fileName)
{
    readIni(text, firstSections);
    interpret();
}

FmuConfiguration::FmuConfiguration(const QString &fmu)
    : ConfigurationFile(fmu)
{
    m_fmu.value = QFileInfo(fmu).absoluteFilePath();
}

QString FmuConfiguration::fmuName() const
{
    return QDir::cleanPath(QFileInfo(fileName()).dir().filePath(m_fmu.value));
}

void FmuConfiguration::interpret()
{
    for (const ConfigurationSection &section : sections()) {
        switch (sectionNames.indexOf(section.name)) {
        case 0:
            for (const ConfigurationEntry &entry : section.entries)
                readNode(entry);
            break;
        case 1:
            for (const ConfigurationEntry &entry : section.entries)
                readFmu(entry);
            break;
        case 2:
            m_starts = section.entries;
            break;
        case 3:
            m_reads = section.entries;
            m_hasWires = true;
            break;
        case 4:
            m_writes = section.entries;
            m_hasWires = true;
            break;
        default:
            addError(section.line, 2,
                     QStringLiteral("there is no section %1%2%3")
                         .arg(quoted(section.name), didYouMean(qplc::closeNames(section.name, sectionNames)),
                              knownAre(sectionNames)));
        }
    }
    if (m_fmu.value.isEmpty())
        addError(0, 0, QStringLiteral("no FMU is named; add [fmu] with 'file = model.fmu'"));
}

void FmuConfiguration::readNode(const ConfigurationEntry &entry)
{
    if (entry.key == QLatin1String("name"))
        m_nodeName = entry.value;
    else
        addError(entry, QStringLiteral("%1 is not a key of [node]; its key is 'name'").arg(quoted(entry.key)));
}

void FmuConfiguration::readFmu(const ConfigurationEntry &entry)
{
    double number = 0.0;
    switch (fmuKeys.indexOf(entry.key)) {
    case 0:
        m_fmu = entry;
        break;
    case 1:
        if (durationFromText(entry.value, &number) && number >= 1.0 && number <= longestStep
            && number == std::floor(number))
            m_step = std::chrono::nanoseconds(qint64(number));
        else
            addError(
                entry,
                QStringLiteral("%1 is not a step; write for example '10 ms', at most '10 s'").arg(quoted(entry.value)));
        break;
    case 2:
        if (finiteNumberFromText(entry.value, &number) && number > 0.0)
            m_tolerance = number;
        else
            addError(entry, QStringLiteral("%1 is not a tolerance; write for example '1e-6'").arg(quoted(entry.value)));
        break;
    case 3:
        m_logs = entry.value == QLatin1String("on");
        if (!m_logs && entry.value != QLatin1String("off"))
            addError(entry, QStringLiteral("%1 is neither 'on' nor 'off'").arg(quoted(entry.value)));
        break;
    default:
        addError(entry,
                 QStringLiteral("%1 is not a key of [fmu]%2%3")
                     .arg(quoted(entry.key), didYouMean(qplc::closeNames(entry.key, fmuKeys)), knownAre(fmuKeys)));
    }
}

}  // namespace qplc
