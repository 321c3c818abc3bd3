// SPDX-License-Identifier: Apache-2.0
#include "PlantConfiguration.h"

#include "SectionKeys.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QSet>

#include <functional>
#include <vector>

// Resources of a static library are found only by programs that ask for them, outside of any
// namespace.
static void loadHardware()
{
    Q_INIT_RESOURCE(hardware);
}

namespace awe {

namespace {

const QString winchSection = QStringLiteral("winch");
constexpr int largestFile = 1 << 20;  // [byte]
constexpr int longestLine = 1000;     // [characters] without its comment

/// All of \a file, which may be a pipe: it tells neither its size nor its end beforehand. One byte
/// more than the largest file at most.
QByteArray contentOf(QFile &file)
{
    QByteArray content;
    QByteArray part;
    do {
        part = file.read(largestFile + 1 - content.size());
        content += part;
    } while (!part.isEmpty() && content.size() <= largestFile);
    return content;
}

QString withoutComment(const QByteArray &line)
{
    const QString text = QString::fromUtf8(line).trimmed();
    if (text.startsWith(QLatin1Char(';')) || text.startsWith(QLatin1Char('#')))
        return {};
    return text.section(QStringLiteral(" ;"), 0, 0).trimmed();
}

/// \return empty, or what is wrong and the remedy
QString setWinch(PlantConfiguration *configuration, const QString &folder, const QString &key, const QString &value)
{
    if (key == QLatin1String("kind"))
        return winchKindFromText(value, &configuration->winch)
            ? QString()
            : QStringLiteral("kind = %1: use ideal or drive").arg(value);
    if (key == QLatin1String("hardware"))
        configuration->winchHardware = value.isEmpty() ? QString() : QDir(folder).filePath(value);
    else if (key == QLatin1String("simulated"))
        configuration->simulatedWinch = value;
    else
        return QStringLiteral("'%1' is not a key of [winch]; use one of kind, hardware, simulated").arg(key);
    return {};
}

QString setWind(AirParameters *air, const QString &key, const QString &value)
{
    SectionKeys keys(QStringLiteral("wind"));
    keys.addChoice<WindProfile>(
        "profile", &air->profile,
        {{"uniform", WindProfile::Uniform}, {"power", WindProfile::Power}, {"log", WindProfile::Log}});
    keys.addChoice<bool>("density", &air->isThinner, {{"constant", false}, {"falling", true}});
    keys.addConstants(air);
    return keys.set(key, value);
}

QString setTether(TetherParameters *tether, const QString &key, const QString &value)
{
    SectionKeys keys(QStringLiteral("tether"));
    keys.addChoice<TetherKind>(
        "kind", &tether->kind,
        {{"spring", TetherKind::Spring}, {"straight", TetherKind::Straight}, {"segments", TetherKind::Segments}});
    keys.addInteger("segments", &tether->segments, 1, TetherParameters::mostSegments);
    keys.addConstants(tether);
    return keys.set(key, value);
}

/// Reads a file line by line into a configuration.
class PlantReader
{
public:
    PlantReader(const QString &folder, PlantConfiguration *configuration)
        : m_configuration(configuration)
        , m_sections{
              {winchSection,
               [=](const QString &key, const QString &value) { return setWinch(configuration, folder, key, value); }},
              {QStringLiteral("kite"),
               [=](const QString &key, const QString &value) { return configuration->kite.set(key, value); }},
              {QStringLiteral("wind"),
               [=](const QString &key, const QString &value) {
                   return setWind(&configuration->options.air, key, value);
               }},
              {QStringLiteral("tether"), [=](const QString &key, const QString &value) {
                   return setTether(&configuration->options.tether, key, value);
               }}}
    {
    }

    /// Takes one line without its comment. \return empty, or what is wrong and the remedy
    QString take(const QString &line)
    {
        if (line.size() > longestLine)
            return QStringLiteral("the line has %1 characters; write %2 at most").arg(line.size()).arg(longestLine);
        if (line.startsWith(QLatin1Char('[')))
            return enter(line);
        const QString key = line.section(QLatin1Char('='), 0, 0).trimmed();
        if (!m_section)
            return QStringLiteral("'%1' is outside of a section; write one of %2 above it").arg(key, shownSections());
        if (!line.contains(QLatin1Char('=')))
            return QStringLiteral("'%1' has no value; write %1 = VALUE").arg(key);
        const QString name = m_section->name + QLatin1Char('/') + key;
        if (m_seen.contains(name))
            return QStringLiteral("'%1' is there twice; give it once").arg(key);
        m_seen.insert(name);
        const QString value = line.section(QLatin1Char('='), 1).trimmed();
        return m_section->set(key, value);
    }

private:
    struct Section
    {
        QString name;
        /// Sets a key. \return empty, or what is wrong and the remedy
        std::function<QString(const QString &key, const QString &value)> set;
    };

    QString shownSections() const
    {
        QStringList shown;
        for (const Section &section : m_sections)
            shown << QStringLiteral("[%1]").arg(section.name);
        return shown.join(QStringLiteral(", "));
    }

    QString enter(const QString &line)
    {
        for (const Section &section : m_sections) {
            if (line != QStringLiteral("[%1]").arg(section.name))
                continue;
            m_section = &section;
            if (section.name == winchSection && !m_hasWinch)  // a file that speaks of the winch says all of it
                forgetWinch();
            return {};
        }
        return QStringLiteral("'%1' is not a section of a plant; use one of %2").arg(line, shownSections());
    }

    void forgetWinch()
    {
        m_hasWinch = true;
        m_configuration->winch = WinchKind::Ideal;
        m_configuration->winchHardware.clear();
        m_configuration->simulatedWinch.clear();
    }

    PlantConfiguration *m_configuration;
    const std::vector<Section> m_sections;
    const Section *m_section = nullptr;  // that of the lines that come
    bool m_hasWinch = false;
    QSet<QString> m_seen;
};

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
    if (fileName != builtInFile() && !read(builtInFile(), configuration, error))  // for a section that is left out
        return false;
    const QByteArray content = contentOf(file);
    if (content.size() > largestFile) {
        *error
            = QStringLiteral("the plant %1 has more than %2 bytes; choose another file").arg(fileName).arg(largestFile);
        return false;
    }
    PlantReader reader(QFileInfo(fileName).path(), configuration);
    int number = 0;
    for (const QByteArray &text : content.split('\n')) {
        ++number;
        const QString line = withoutComment(text);
        const QString wrong = line.isEmpty() ? QString() : reader.take(line);
        if (wrong.isEmpty())
            continue;
        *error = QStringLiteral("%1:%2: %3").arg(fileName).arg(number).arg(wrong);
        return false;
    }
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
