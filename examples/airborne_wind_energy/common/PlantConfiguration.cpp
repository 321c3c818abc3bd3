// SPDX-License-Identifier: Apache-2.0
#include "PlantConfiguration.h"

#include "SectionKeys.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QHash>

#include <cmath>
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
const QString kiteSection = QStringLiteral("kite");
const QString windSection = QStringLiteral("wind");
const QString tetherSection = QStringLiteral("tether");
const QString steeringSection = QStringLiteral("steering");
const QString turbineSection = QStringLiteral("turbines");
const QString mastSection = QStringLiteral("mast");
const QString kindKey = QStringLiteral("kind");
const QString namedPlants = QStringLiteral(":/plants");
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
    SectionKeys keys(winchSection);
    keys.addChoice<WinchKind>("kind", &configuration->winch,
                              {{"ideal", WinchKind::Ideal},
                               {"machine", WinchKind::Machine},
                               {"drive", WinchKind::Drive},
                               {"canopen", WinchKind::CanOpen}});
    const auto pathOf = [=](const QString &name) { return name.isEmpty() ? QString() : QDir(folder).filePath(name); };
    keys.addText("hardware", [=](const QString &name) { configuration->winchHardware = pathOf(name); });
    keys.addText("canOpenHardware", [=](const QString &name) { configuration->canOpenHardware = pathOf(name); });
    keys.addText("simulated", [=](const QString &bus) { configuration->simulatedWinch = bus; });
    keys.addConstants(&configuration->options.machine);
    return keys.set(key, value);
}

QString setWind(AirParameters *air, const QString &key, const QString &value)
{
    SectionKeys keys(windSection);
    keys.addChoice<WindProfile>(
        "profile", &air->profile,
        {{"uniform", WindProfile::Uniform}, {"power", WindProfile::Power}, {"log", WindProfile::Log}});
    keys.addChoice<bool>("density", &air->isThinner, {{"constant", false}, {"falling", true}});
    keys.addConstants(air);
    return keys.set(key, value);
}

QString setTether(TetherParameters *tether, const QString &key, const QString &value)
{
    SectionKeys keys(tetherSection);
    keys.addChoice<TetherKind>(
        "kind", &tether->kind,
        {{"spring", TetherKind::Spring}, {"straight", TetherKind::Straight}, {"segments", TetherKind::Segments}});
    keys.addInteger("segments", &tether->segments, 1, TetherParameters::mostSegments);
    keys.addConstants(tether);
    return keys.set(key, value);
}

QString setSteering(SteeringParameters *steering, const QString &key, const QString &value)
{
    SectionKeys keys(steeringSection);
    keys.addChoice<SteeringKind>("kind", &steering->kind,
                                 {{"kinematic", SteeringKind::Kinematic}, {"turn-rate", SteeringKind::TurnRate}});
    keys.addConstants(steering);
    return keys.set(key, value);
}

QString setTurbines(TurbineSettings *turbines, const QString &key, const QString &value)
{
    SectionKeys keys(QStringLiteral("turbines"));
    keys.addNumber("coefficient", &turbines->coefficient, 0.0, 10.0, "");
    keys.addNumber("tetherLength", &turbines->tetherLength, 20.0, 1000.0, "m");
    return keys.set(key, value);
}

QString setMast(PlantConfiguration *configuration, const QString &key, const QString &value)
{
    SectionKeys keys(mastSection);
    keys.addChoice<bool>("kind", &configuration->options.mast.isPresent, {{"none", false}, {"fixed", true}});
    keys.addConstants(&configuration->options.mast);
    MastGains *gains = &configuration->mastGains;
    for (const auto &[name, wind] :
         {std::pair("startWind", &gains->startWind), std::pair("landWind", &gains->landWind),
          std::pair("stormStartWind", &gains->stormStartWind), std::pair("stormLandWind", &gains->stormLandWind)})
        keys.addNumber(name, wind, 0.0, 100.0, "m/s");
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
              {kiteSection,
               [=](const QString &key, const QString &value) { return configuration->kite.set(key, value); }},
              {windSection,
               [=](const QString &key, const QString &value) {
                   return setWind(&configuration->options.air, key, value);
               }},
              {tetherSection,
               [=](const QString &key, const QString &value) {
                   return setTether(&configuration->options.tether, key, value);
               }},
              {steeringSection,
               [=](const QString &key, const QString &value) {
                   return setSteering(&configuration->options.steering, key, value);
               }},
              {turbineSection,
               [=](const QString &key, const QString &value) {
                   return setTurbines(&configuration->turbines, key, value);
               }},
              {mastSection,
               [=](const QString &key, const QString &value) { return setMast(configuration, key, value); }}}
    {
    }

    /// Takes one line without its comment. \return empty, or what is wrong and the remedy
    QString take(const QString &line, int number)
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
        QHash<QString, int> &lines = m_lines[m_section->name];
        if (lines.contains(key))
            return QStringLiteral("'%1' is there twice; give it once").arg(key);
        lines.insert(key, number);
        const QString value = line.section(QLatin1Char('='), 1).trimmed();
        return m_section->set(key, value);
    }

    /// The line of a key; 0 if the file does not have it.
    int lineOf(const QString &section, const QString &key) const { return m_lines.value(section).value(key); }
    /// The keys of a section that the file has, in alphabetical order.
    QStringList keysOf(const QString &section) const
    {
        QStringList keys = m_lines.value(section).keys();
        keys.sort();
        return keys;
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
        m_configuration->canOpenHardware.clear();
        m_configuration->simulatedWinch.clear();
        m_configuration->options.machine = WinchDriveParameters();
    }

    PlantConfiguration *m_configuration;
    const std::vector<Section> m_sections;
    const Section *m_section = nullptr;  // that of the lines that come
    bool m_hasWinch = false;
    QHash<QString, QHash<QString, int>> m_lines;  // of each key of each section
};

/// Reads the text of a file. \return empty, or what is wrong and the remedy
QString take(PlantReader *reader, const QString &fileName, const QByteArray &content)
{
    int number = 0;
    for (const QByteArray &text : content.split('\n')) {
        ++number;
        const QString line = withoutComment(text);
        const QString wrong = line.isEmpty() ? QString() : reader->take(line, number);
        if (!wrong.isEmpty())
            return QStringLiteral("%1:%2: %3").arg(fileName).arg(number).arg(wrong);
    }
    return {};
}

/// \return empty, or which word of the command line is wrong and the remedy
QString takeWords(const PlantWords &words, PlantConfiguration *configuration)
{
    if (!words.winch.isEmpty() && !setWinch(configuration, {}, kindKey, words.winch).isEmpty())
        return QStringLiteral("--winch %1: use ideal, machine, drive or canopen").arg(words.winch);
    if (!words.mode.isEmpty() && !configuration->kite.setMode(words.mode))
        return QStringLiteral("--mode %1: use pumping or drag").arg(words.mode);
    return {};
}

/// Keys of a section that say nothing here. \return empty, or the first of \a keys with its place,
/// \a reason and remedy
QString needless(const PlantReader &reader, const QString &fileName, const QString &section, const QStringList &keys,
                 const QString &reason)
{
    if (keys.isEmpty())
        return {};
    return QStringLiteral("%1:%2: '%3' has no meaning %4")
        .arg(fileName)
        .arg(reader.lineOf(section, keys.first()))
        .arg(keys.first(), reason);
}

/// The keys of [kite] that say how the flight starts.
QStringList startKeysOf(const PlantReader &reader)
{
    static const QStringList all{QStringLiteral("azimuth"),      QStringLiteral("distance"),
                                 QStringLiteral("elevation"),    QStringLiteral("pitchAngle"),
                                 QStringLiteral("tetherLength"), QStringLiteral("velocity"),
                                 QStringLiteral("yawAngle")};
    QStringList given;
    for (const QString &key : reader.keysOf(kiteSection)) {
        if (all.contains(key))
            given << key;
    }
    return given;
}

/// Keys of a section that say something only if an option is on.
struct OptionKeys
{
    bool isOn;
    QString section;
    QStringList keys;
    QString reason;  // why they say nothing otherwise, and the remedy
};

/// Those of wind, tether and steering that \a reader has found.
QVector<OptionKeys> optionKeys(const PlantReader &reader, const PlantOptions &options)
{
    const AirParameters &air = options.air;
    const TetherKind tether = options.tether.kind;
    const auto given = [&reader](const QString &section, const char *names) {
        QStringList keys;
        for (const QString &key : QString::fromLatin1(names).split(QLatin1Char(' '))) {
            if (reader.lineOf(section, key) > 0)
                keys << key;
        }
        return keys;
    };
    const auto allBesideKind = [&reader](const QString &section) {
        QStringList keys = reader.keysOf(section);
        keys.removeAll(kindKey);
        return keys;
    };
    return {{air.profile != WindProfile::Uniform, windSection, given(windSection, "exponent referenceHeight roughness"),
             QStringLiteral("in a uniform wind; write profile = power or profile = log in [wind], or leave it out")},
            {air.profile == WindProfile::Power, windSection, given(windSection, "exponent"),
             QStringLiteral("in a log profile; write profile = power in [wind], or leave it out")},
            {air.profile == WindProfile::Log, windSection, given(windSection, "roughness"),
             QStringLiteral("in a power profile; write profile = log in [wind], or leave it out")},
            {air.isThinner, windSection, given(windSection, "scaleHeight"),
             QStringLiteral("in a constant density; write density = falling in [wind], or leave it out")},
            {tether != TetherKind::Spring, tetherSection, allBesideKind(tetherSection),
             QStringLiteral("for a spring without drag and mass; write kind = straight or kind = segments in "
                            "[tether], or leave it out")},
            {tether == TetherKind::Segments, tetherSection,
             given(tetherSection, "axialStiffness segmentDamping segments"),
             QStringLiteral("for a straight tether; write kind = segments in [tether], or leave it out")},
            {tether != TetherKind::Segments, kiteSection, given(kiteSection, "tetherDamping tetherStiffness"),
             QStringLiteral("with a tether in segments; use axialStiffness and segmentDamping in [tether]")},
            {options.steering.kind == SteeringKind::TurnRate, steeringSection, allBesideKind(steeringSection),
             QStringLiteral("while the yaw speed is the command; write kind = turn-rate in [steering], or leave it "
                            "out")}};
}

/// What the file and the command line say together. \return empty, or what excludes each other and
/// the remedy
QString contradiction(const PlantReader &reader, const QString &fileName, const PlantWords &words,
                      const PlantConfiguration &configuration)
{
    const bool isDrag = configuration.kite.mode == FlightMode::Drag;
    if (isDrag && configuration.winch == WinchKind::Machine)
        return (words.winch.isEmpty()
                    ? QStringLiteral("%1:%2: kind = machine").arg(fileName).arg(reader.lineOf(winchSection, kindKey))
                    : QStringLiteral("--winch machine"))
            + QStringLiteral(" and mode drag exclude each other, because the winch then only holds the tether; use "
                             "--winch ideal or kind = ideal in [winch], or --mode pumping or mode = pumping in [kite]");
    const auto isNeedless = [&](const QString &section, const QStringList &keys, const QString &reason) {
        return needless(reader, fileName, section, keys, reason);
    };
    QStringList machineKeys = reader.keysOf(winchSection);
    for (const QString &key :
         {kindKey, QStringLiteral("hardware"), QStringLiteral("canOpenHardware"), QStringLiteral("simulated")})
        machineKeys.removeAll(key);
    QString error;
    if (configuration.winch != WinchKind::Machine && words.winch.isEmpty())
        error = isNeedless(winchSection, machineKeys,
                           QStringLiteral("without an electrical machine; write kind = machine in [winch], or leave it "
                                          "out"));
    if (!isDrag && words.mode.isEmpty() && error.isEmpty())
        error = isNeedless(turbineSection, reader.keysOf(turbineSection),
                           QStringLiteral("without turbines on board; write mode = drag in [kite], or leave out "
                                          "[turbines]"));
    for (const OptionKeys &option : optionKeys(reader, configuration.options)) {
        if (!option.isOn && error.isEmpty())
            error = isNeedless(option.section, option.keys, option.reason);
    }
    if (!error.isEmpty())
        return error;
    if (configuration.options.mast.isPresent)
        return isNeedless(kiteSection, startKeysOf(reader),
                          QStringLiteral("with a mast, because the flight begins there; leave it out, or write kind = "
                                         "none in [mast]"));
    QStringList mastKeys = reader.keysOf(mastSection);
    mastKeys.removeAll(kindKey);
    return isNeedless(mastSection, mastKeys,
                      QStringLiteral("without a mast; write kind = fixed in [mast], or leave it out"));
}

}  // namespace

QString PlantConfiguration::builtInFile()
{
    loadHardware();
    return QStringLiteral(":/hardware/plant.ini");
}

QStringList PlantConfiguration::names()
{
    loadHardware();
    QStringList names;
    const QFileInfoList files = QDir(namedPlants).entryInfoList({QStringLiteral("*.ini")}, QDir::Files, QDir::Name);
    for (const QFileInfo &file : files)
        names << file.completeBaseName();
    return names;
}

QString PlantConfiguration::description(const QString &name)
{
    loadHardware();
    QFile file(QStringLiteral("%1/%2.ini").arg(namedPlants, name));
    if (!file.open(QIODevice::ReadOnly))
        return {};
    const QString comment = QString::fromUtf8(file.readLine()).mid(2).trimmed();
    return comment.section(QStringLiteral(". "), 0, 0) + QLatin1Char('.');
}

PlantOptions PlantConfiguration::optionsIn(const WindParameters &wind) const
{
    PlantOptions all = options;
    if (std::isnan(all.mast.azimuth))
        all.mast.azimuth = downwindAzimuth(wind);
    return all;
}

MastGains PlantConfiguration::gainsOfMast() const
{
    MastGains gains = mastGains;
    gains.isPresent = options.mast.isPresent;
    gains.distance = options.mast.distance;
    gains.elevation = options.mast.elevation;
    gains.mass = kite.plant.mass;
    gains.area = kite.plant.area;
    gains.density = kite.plant.airDensity;
    gains.gravity = kite.plant.gravity;
    return gains;
}

bool PlantConfiguration::read(const QString &plant, PlantConfiguration *configuration, QString *error,
                              const PlantWords &words)
{
    const bool isName = names().contains(plant);
    const QString fileName = isName ? QStringLiteral("%1/%2.ini").arg(namedPlants, plant) : plant;
    QFile file(fileName);
    if (!file.open(QIODevice::ReadOnly)) {
        *error = QStringLiteral("cannot read the plant %1: %2; choose another file, or one of %3")
                     .arg(fileName, file.errorString(), names().join(QStringLiteral(", ")));
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
    const QString &shownName = isName ? plant : fileName;
    PlantReader reader(QFileInfo(fileName).path(), configuration);
    *error = take(&reader, shownName, content);
    if (error->isEmpty())
        *error = takeWords(words, configuration);
    if (error->isEmpty())
        *error = contradiction(reader, shownName, words, *configuration);
    configuration->options.hasMachine = configuration->winch == WinchKind::Machine;
    configuration->options.hasTurbines = configuration->kite.mode == FlightMode::Drag;
    return error->isEmpty();
}

const char *winchSpeedSignal(WinchKind kind)
{
    return isDrive(kind) ? "winchSpeed" : "tetherSpeed";
}

}  // namespace awe
