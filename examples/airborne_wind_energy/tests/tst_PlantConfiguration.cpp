// SPDX-License-Identifier: Apache-2.0
#include "PlantConfiguration.h"

#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QRegularExpression>
#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

#include <fcntl.h>
#include <unistd.h>

using namespace awe;

class tst_PlantConfiguration : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void withoutAFileTheWinchIsIdeal();
    void winchKindSelectsTheDrive();
    void oneWordSelectsADriveOnCanOpen();
    void builtInFileDescribesTheKiteOfTheThesis();
    void everyKeyAcceptsExactlyItsDocumentedRange();
    void kiteStartsInTheConfiguredState();
    void optionsOfThePlantAreRead();
    void builtInFileDescribesTheOptions();
    void builtInFileDescribesTheMachine();
    void builtInFileDescribesTheMast();
    void mastStandsDownwindUnlessTheFileSaysWhere();
    void autopilotKnowsMastAndWing();
    void namedPlantsAreFiles();
    void wordsOfTheCommandLineAreStronger();
    void contradictionIsRefused_data();
    void contradictionIsRefused();
    void sectionThatIsLeftOutIsTheBuiltInOne();
    void withoutAnAzimuthTheKiteStartsDownwind();
    void badLineIsNamedWithItsRemedy_data();
    void badLineIsNamedWithItsRemedy();
    void missingFileIsNamed();
    void aPipeIsReadToItsEnd();
    void fileThatIsTooLargeIsRefused();
    void longLineIsNotRepeated();

private:
    QString write(const QByteArray &text);

    QTemporaryDir m_folder;
};

QString tst_PlantConfiguration::write(const QByteArray &text)
{
    QFile file(m_folder.filePath(QStringLiteral("plant.ini")));
    return file.open(QIODevice::WriteOnly) && file.write(text) == text.size() ? file.fileName() : QString();
}

void tst_PlantConfiguration::withoutAFileTheWinchIsIdeal()
{
    PlantConfiguration plant;
    QString error;
    QVERIFY2(PlantConfiguration::read(PlantConfiguration::builtInFile(), &plant, &error), qPrintable(error));
    QVERIFY(!plant.hasDrive());
    QCOMPARE(winchSpeedSignal(plant.winch), "tetherSpeed");
    QVERIFY(QFile::exists(plant.winchHardware));
    QVERIFY(plant.simulatedWinch.startsWith(QLatin1String("fake:")));
}

void tst_PlantConfiguration::winchKindSelectsTheDrive()
{
    QFile builtIn(PlantConfiguration::builtInFile());
    QVERIFY(builtIn.open(QIODevice::ReadOnly));
    const QString name = write(builtIn.readAll().replace("kind = ideal", "kind = drive"));
    PlantConfiguration plant;
    QString error;
    QVERIFY2(PlantConfiguration::read(name, &plant, &error), qPrintable(error));
    QVERIFY(plant.hasDrive());
    QCOMPARE(winchSpeedSignal(plant.winch), "winchSpeed");
    QCOMPARE(plant.winchHardware, m_folder.filePath(QStringLiteral("winch.ini")));
}

void tst_PlantConfiguration::oneWordSelectsADriveOnCanOpen()
{
    PlantConfiguration plant;
    QString error;
    QVERIFY2(PlantConfiguration::read(PlantConfiguration::builtInFile(), &plant, &error, {"canopen", {}}),
             qPrintable(error));
    QVERIFY(plant.hasDrive());
    QCOMPARE(winchSpeedSignal(plant.winch), "winchSpeed");
    QVERIFY(plant.hardware().endsWith(QLatin1String("/winch-canopen.ini")));
    QVERIFY(QFile::exists(plant.hardware()));
    QVERIFY(plant.simulatedWinch.startsWith(QLatin1String("fake:")));

    PlantConfiguration ofFile;
    QVERIFY2(PlantConfiguration::read(write("[winch]\nkind = canopen\ncanOpenHardware = servo.ini\n"), &ofFile, &error),
             qPrintable(error));
    QCOMPARE(ofFile.hardware(), m_folder.filePath(QStringLiteral("servo.ini")));
    QVERIFY(ofFile.simulatedWinch.isEmpty());
}

/// One line of the built-in file that shows a key of a section:
/// ";mass = 5    ; kg, from 0.001 to 1e+06".
struct ShownKey
{
    QString section, name, value, text;

    bool isOfMachine() const { return section == QLatin1String("winch"); }
    bool isOfMast() const { return section == QLatin1String("mast") && name != QLatin1String("kind"); }
    bool isOfOption() const { return !needed().isEmpty(); }
    /// What the section has to say so that the key says something.
    QString needed() const
    {
        static const QHash<QString, QString> ofWind{{"referenceHeight", "profile = log\n"},
                                                    {"exponent", "profile = power\n"},
                                                    {"roughness", "profile = log\n"},
                                                    {"scaleHeight", "density = falling\n"}};
        static const QHash<QString, QString> ofSection{{"winch", "kind = machine\n"},
                                                       {"tether", "kind = segments\n"},
                                                       {"steering", "kind = turn-rate\n"},
                                                       {"mast", "kind = fixed\n"},
                                                       {"turbines", "[kite]\nmode = drag\n"}};
        if (section == QLatin1String("wind"))
            return ofWind.value(name);
        return name == QLatin1String("kind") ? QString() : ofSection.value(section);
    }
    QString line(const QString &wanted) const
    {
        return QStringLiteral("[%1]\n%2 = %3\n").arg(section, name, wanted) + needed();
    }
};

static QVector<ShownKey> shownKeys()
{
    QFile file(PlantConfiguration::builtInFile());
    if (!file.open(QIODevice::ReadOnly))
        return {};
    QVector<ShownKey> keys;
    static const QRegularExpression line(QStringLiteral("^(?:\\[(\\w+)\\]|;(\\w+) = (\\S+) +; (.*))$"),
                                         QRegularExpression::MultilineOption);
    QString section;
    for (auto found = line.globalMatch(QString::fromUtf8(file.readAll())); found.hasNext();) {
        const QRegularExpressionMatch match = found.next();
        if (match.captured(2).isEmpty())
            section = match.captured(1);
        else
            keys.append({section, match.captured(2), match.captured(3), match.captured(4)});
    }
    return keys;
}

void tst_PlantConfiguration::builtInFileDescribesTheKiteOfTheThesis()
{
    QByteArray text;
    const QVector<ShownKey> keys = shownKeys();
    QCOMPARE(keys.size(), 74);
    for (const ShownKey &key : keys) {
        if (key.name != QLatin1String("azimuth") && !key.isOfOption())  // without it: downwind
            text += key.line(key.value).toUtf8();
    }
    PlantConfiguration shown, silent;
    QString error;
    QVERIFY2(PlantConfiguration::read(write(text), &shown, &error), qPrintable(error));
    QVERIFY2(PlantConfiguration::read(PlantConfiguration::builtInFile(), &silent, &error), qPrintable(error));
    const WindParameters wind;
    PlantParameters expected;
    expected.groundContact = GroundContact::Hold;
    for (const PlantConfiguration &configuration : {shown, silent}) {
        const PlantParameters plant = configuration.kite.plantIn(configuration.kite.wind);
        QVector<double> values, wanted;
        const auto collect = [](QVector<double> *into) {
            return [into](const char *, double value, double, double, const char *) { into->append(value); };
        };
        PlantParameters::visitConstants(plant, collect(&values));
        PlantParameters::visitConstants(expected, collect(&wanted));
        WindParameters::visitConstants(configuration.kite.wind, collect(&values));
        WindParameters::visitConstants(wind, collect(&wanted));
        QCOMPARE(values, wanted);
        QVERIFY(configuration.options.isThesis());
        QVERIFY(configuration.kite.wind.meanVelocity == WindParameters().meanVelocity);
        QCOMPARE(configuration.kite.wind.seed, WindParameters().seed);
        QCOMPARE(configuration.kite.wind.turbulenceModel, TurbulenceModel::FirstOrder);
        QCOMPARE(configuration.kite.substeps, 1);
        QCOMPARE(plant.groundContact, GroundContact::Hold);
        QCOMPARE(plant.angleOfAttackRange, AngleOfAttackRange::Folded);
        QVERIFY((plant.initialState.position - expected.initialState.position).norm() < 1e-9);
        QVERIFY(plant.initialState.velocity == expected.initialState.velocity);
        QCOMPARE(plant.initialState.pitchAngle, expected.initialState.pitchAngle);
        QCOMPARE(plant.initialState.yawAngle, expected.initialState.yawAngle);
        QCOMPARE(plant.initialState.tetherLength, expected.initialState.tetherLength);
    }
}

/// The ranges and units that the built-in file tells are those that are kept.
void tst_PlantConfiguration::everyKeyAcceptsExactlyItsDocumentedRange()
{
    static const QRegularExpression range(QStringLiteral("^(?:([^,]+), )?(each )?from (\\S+?) to ([^\\s:]+)"));
    int ranges = 0;
    for (const ShownKey &key : shownKeys()) {
        const QRegularExpressionMatch match = range.match(key.text);
        if (!match.hasMatch())
            continue;  // a choice of words
        ++ranges;
        const bool isVector = !match.captured(2).isEmpty();
        const auto line
            = [&](const QString &value) { return key.line(isVector ? value + QStringLiteral(",0,0") : value); };
        for (const int border : {3, 4}) {
            const double limit = match.captured(border).toDouble();
            const double beyond = border == 3 ? limit - 1.0 : limit * 1.1 + 1.0;
            PlantConfiguration plant;
            QString error;
            QVERIFY2(PlantConfiguration::read(write(line(match.captured(border)).toUtf8()), &plant, &error),
                     qPrintable(error));
            QVERIFY2(!PlantConfiguration::read(write(line(QString::number(beyond, 'f', 0)).toUtf8()), &plant, &error),
                     qPrintable(key.name));
            const QString said = QStringLiteral("from %1 to %2").arg(match.captured(3), match.captured(4));
            QVERIFY2(error.contains(QStringLiteral("plant.ini:2: %1 = ").arg(key.name)) && error.contains(said)
                         && error.endsWith(match.captured(1)),
                     qPrintable(error));
        }
    }
    QCOMPARE(ranges, 65);
}

void tst_PlantConfiguration::kiteStartsInTheConfiguredState()
{
    PlantConfiguration plant;
    QString error;
    const QString name = write("[winch]\nkind = drive\n[kite]\nelevation = 90\ndistance = 50\ntetherLength = 51 ; m\n"
                               "velocity = 1,2,3\npitchAngle = -90\nyawAngle = 80\nmass = 2.5\nwind = 8,0,0\n");
    QVERIFY2(PlantConfiguration::read(name, &plant, &error), qPrintable(error));
    QVERIFY(plant.hasDrive());
    const PlantParameters parameters = plant.kite.plantIn(plant.kite.wind);
    QVERIFY((parameters.initialState.position - Eigen::Vector3d(0.0, 0.0, 50.0)).norm() < 1e-9);
    QVERIFY(parameters.initialState.velocity == Eigen::Vector3d(1.0, 2.0, 3.0));
    QCOMPARE(parameters.initialState.tetherLength, 51.0);
    QCOMPARE(parameters.initialState.pitchAngle, -90.0);
    QCOMPARE(parameters.initialState.yawAngle, 80.0);
    QCOMPARE(parameters.mass, 2.5);
    QVERIFY(plant.kite.wind.meanVelocity == Eigen::Vector3d(8.0, 0.0, 0.0));
}

void tst_PlantConfiguration::optionsOfThePlantAreRead()
{
    PlantConfiguration plant;
    QString error;
    const QString name = write("[wind]\nprofile = log\nreferenceHeight = 10\nroughness = 0.1\ndensity = falling\n"
                               "[tether]\nkind = segments\nsegments = 4\ndiameter = 0.005\n");
    QVERIFY2(PlantConfiguration::read(name, &plant, &error), qPrintable(error));
    QVERIFY(!plant.options.isThesis());
    QCOMPARE(plant.options.air.profile, WindProfile::Log);
    QCOMPARE(plant.options.air.referenceHeight, 10.0);
    QCOMPARE(plant.options.air.roughness, 0.1);
    QVERIFY(plant.options.air.isThinner);
    QCOMPARE(plant.options.tether.kind, TetherKind::Segments);
    QCOMPARE(plant.options.tether.segments, 4);
    QCOMPARE(plant.options.tether.diameter, 0.005);
}

/// Each key that an option needs, with this option, has the value that holds without the key.
void tst_PlantConfiguration::builtInFileDescribesTheOptions()
{
    int keys = 0;
    for (const ShownKey &key : shownKeys()) {
        if (key.section != QLatin1String("wind") && key.section != QLatin1String("tether")
            && key.section != QLatin1String("steering"))
            continue;
        ++keys;
        PlantConfiguration plant;
        QString error;
        QVERIFY2(PlantConfiguration::read(write(key.line(key.value).toUtf8()), &plant, &error), qPrintable(error));
        QVector<double> values, wanted;
        const auto collect = [](QVector<double> *into) {
            return [into](const char *, double value, double, double, const char *) { into->append(value); };
        };
        const PlantOptions options = plant.options, expected;
        AirParameters::visitConstants(options.air, collect(&values));
        AirParameters::visitConstants(expected.air, collect(&wanted));
        TetherParameters::visitConstants(options.tether, collect(&values));
        TetherParameters::visitConstants(expected.tether, collect(&wanted));
        SteeringParameters::visitConstants(options.steering, collect(&values));
        SteeringParameters::visitConstants(expected.steering, collect(&wanted));
        for (int i = 0; i < wanted.size(); ++i)
            QVERIFY2(std::abs(values[i] - wanted[i]) <= 1e-6 * std::abs(wanted[i]) + 1e-9, qPrintable(key.name));
        QCOMPARE(options.tether.segments, expected.tether.segments);
    }
    QCOMPARE(keys, 19);
}

void tst_PlantConfiguration::builtInFileDescribesTheMachine()
{
    QByteArray text = "[winch]\nkind = machine\n";
    for (const ShownKey &key : shownKeys()) {
        if (key.isOfMachine())
            text += QStringLiteral("%1 = %2\n").arg(key.name, key.value).toUtf8();
    }
    PlantConfiguration shown;
    QString error;
    QVERIFY2(PlantConfiguration::read(write(text), &shown, &error), qPrintable(error));
    QVERIFY(shown.options.hasMachine);
    QVector<double> values, wanted;
    const auto collect = [](QVector<double> *into) {
        return [into](const char *, double value, double, double, const char *) { into->append(value); };
    };
    WinchDriveParameters::visitConstants(shown.options.machine, collect(&values));
    const WinchDriveParameters expected;
    WinchDriveParameters::visitConstants(expected, collect(&wanted));
    QCOMPARE(values, wanted);
    QVERIFY2(PlantConfiguration::read(write("[winch]\nkind = machine\ngearRatio = 7\n"), &shown, &error),
             qPrintable(error));
    QCOMPARE(shown.options.machine.gearRatio, 7.0);
    QVERIFY2(PlantConfiguration::read(write("[winch]\nkind = machine\ngearRatio = 7\n"), &shown, &error,
                                      {QStringLiteral("ideal"), QString()}),
             qPrintable(error));
    QVERIFY(!shown.options.hasMachine);
}

/// The values that the built-in file shows are those of a file that says only that there is one.
void tst_PlantConfiguration::builtInFileDescribesTheMast()
{
    QByteArray text = "[mast]\nkind = fixed\n";
    for (const ShownKey &key : shownKeys()) {
        if (key.isOfMast())
            text += QStringLiteral("%1 = %2\n").arg(key.name, key.value).toUtf8();
    }
    PlantConfiguration shown, silent;
    QString error;
    QVERIFY2(PlantConfiguration::read(write(text), &shown, &error), qPrintable(error));
    QVERIFY2(PlantConfiguration::read(write("[mast]\nkind = fixed\n"), &silent, &error), qPrintable(error));
    QVERIFY(!shown.options.isThesis() && !silent.options.isThesis());
    QCOMPARE(shown.options.mast.azimuth, std::round(silent.optionsIn(WindParameters()).mast.azimuth));
    const MastParameters expected;
    const MastGains gains;
    for (const PlantConfiguration &configuration : {shown, silent}) {
        QVERIFY(configuration.options.mast.isPresent);
        QCOMPARE(configuration.options.mast.distance, expected.distance);
        QCOMPARE(configuration.options.mast.elevation, expected.elevation);
        QCOMPARE(configuration.options.mast.reach, expected.reach);
        QCOMPARE(configuration.mastGains.startWind, gains.startWind);
        QCOMPARE(configuration.mastGains.landWind, gains.landWind);
        QCOMPARE(configuration.mastGains.stormStartWind, gains.stormStartWind);
        QCOMPARE(configuration.mastGains.stormLandWind, gains.stormLandWind);
    }
}

void tst_PlantConfiguration::mastStandsDownwindUnlessTheFileSaysWhere()
{
    PlantConfiguration silent, fixed;
    QString error;
    QVERIFY2(PlantConfiguration::read(write("[mast]\nkind = fixed\n"), &silent, &error), qPrintable(error));
    QVERIFY2(PlantConfiguration::read(write("[mast]\nkind = fixed\nazimuth = 12\n"), &fixed, &error),
             qPrintable(error));
    WindParameters northwards;
    northwards.meanVelocity = Eigen::Vector3d(0.0, 7.0, 0.0);
    QCOMPARE(silent.optionsIn(northwards).mast.azimuth, 90.0);
    QCOMPARE(silent.optionsIn(northwards).validate(), std::string());
    QCOMPARE(fixed.optionsIn(northwards).mast.azimuth, 12.0);
}

void tst_PlantConfiguration::autopilotKnowsMastAndWing()
{
    PlantConfiguration plant;
    QString error;
    QVERIFY2(PlantConfiguration::read(write("[kite]\nmass = 7\narea = 12\nairDensity = 1.1\ngravity = 9\n[mast]\n"
                                            "kind = fixed\ndistance = 15\nelevation = 65\nstartWind = 7\n"),
                                      &plant, &error),
             qPrintable(error));
    const MastGains gains = plant.gainsOfMast();
    QVERIFY(gains.isPresent);
    QCOMPARE(gains.distance, 15.0);
    QCOMPARE(gains.elevation, 65.0);
    QCOMPARE(gains.startWind, 7.0);
    QCOMPARE(gains.mass, 7.0);
    QCOMPARE(gains.area, 12.0);
    QCOMPARE(gains.density, 1.1);
    QCOMPARE(gains.gravity, 9.0);
    QVERIFY(!PlantConfiguration().gainsOfMast().isPresent);
}

void tst_PlantConfiguration::namedPlantsAreFiles()
{
    const QStringList expected{QStringLiteral("drag"), QStringLiteral("mast"), QStringLiteral("realistic"),
                               QStringLiteral("thesis")};
    QCOMPARE(PlantConfiguration::names(), expected);
    PlantConfiguration thesis, realistic, drag;
    QString error;
    QVERIFY2(PlantConfiguration::read(QStringLiteral("thesis"), &thesis, &error), qPrintable(error));
    QVERIFY(thesis.options.isThesis());
    QVERIFY2(PlantConfiguration::read(QStringLiteral("realistic"), &realistic, &error), qPrintable(error));
    const PlantOptions options = realistic.options, known = PlantOptions::realistic();
    QVERIFY(options.hasMachine && !options.hasTurbines);
    QCOMPARE(realistic.winch, WinchKind::Machine);
    QVERIFY(!realistic.hasDrive());
    QCOMPARE(options.air.profile, known.air.profile);
    QCOMPARE(options.air.referenceHeight, known.air.referenceHeight);
    QCOMPARE(options.tether.kind, known.tether.kind);
    QCOMPARE(options.tether.segments, known.tether.segments);
    QCOMPARE(options.steering.kind, known.steering.kind);
    QCOMPARE(options.steering.turnRateFactor, known.steering.turnRateFactor);
    QVERIFY2(PlantConfiguration::read(QStringLiteral("drag"), &drag, &error), qPrintable(error));
    QVERIFY(drag.options.hasTurbines && !drag.options.hasMachine);
    QCOMPARE(drag.kite.plantIn(drag.kite.wind).initialState.tetherLength, drag.turbines.tetherLength);
    for (const QString &name : expected) {
        const QString sentence = PlantConfiguration::description(name);
        QVERIFY2(sentence.size() > 20 && sentence.size() < 120 && !sentence.startsWith(QLatin1Char(';')),
                 qPrintable(sentence));
    }
    QVERIFY(!PlantConfiguration::read(QStringLiteral("thesi"), &drag, &error));
    QVERIFY2(error.endsWith(QLatin1String("choose another file, or one of drag, mast, realistic, thesis")),
             qPrintable(error));
}

void tst_PlantConfiguration::wordsOfTheCommandLineAreStronger()
{
    PlantConfiguration plant;
    QString error;
    const QString realistic = QStringLiteral("realistic");
    const auto read = [&](const QString &winch, const QString &mode) {
        return PlantConfiguration::read(realistic, &plant, &error, {winch, mode});
    };
    QVERIFY2(read(QStringLiteral("ideal"), QStringLiteral("drag")), qPrintable(error));
    QVERIFY(plant.options.hasTurbines && !plant.options.hasMachine);
    QVERIFY2(PlantConfiguration::read(QStringLiteral("drag"), &plant, &error, {{}, QStringLiteral("pumping")}),
             qPrintable(error));
    QVERIFY(!plant.options.hasTurbines);
    QVERIFY(!read({}, QStringLiteral("drag")));
    QVERIFY2(error.startsWith(QLatin1String("realistic:4: kind = machine and mode drag exclude each other")),
             qPrintable(error));
    QVERIFY(!read(QStringLiteral("steam"), {}));
    QCOMPARE(error, QStringLiteral("--winch steam: use ideal, machine, drive or canopen"));
    QVERIFY(!read({}, QStringLiteral("fast")));
    QCOMPARE(error, QStringLiteral("--mode fast: use pumping or drag"));
}

void tst_PlantConfiguration::contradictionIsRefused_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("winch");
    QTest::addColumn<QString>("mode");
    QTest::addColumn<QString>("expected");
    const QString machine = QStringLiteral(" and mode drag exclude each other, because the winch then only holds the "
                                           "tether; use --winch ideal or kind = ideal in [winch], or --mode "
                                           "pumping or mode = pumping in [kite]");
    QTest::newRow("machine, mode in the file") << QByteArray("[kite]\nmode = drag\n[winch]\nkind = machine\n")
                                               << QString() << QString() << "plant.ini:4: kind = machine" + machine;
    QTest::newRow("machine, mode given") << QByteArray("[winch]\nkind = machine\n") << QString()
                                         << QStringLiteral("drag") << "plant.ini:2: kind = machine" + machine;
    QTest::newRow("machine given") << QByteArray("[kite]\nmode = drag\n") << QStringLiteral("machine") << QString()
                                   << "--winch machine" + machine;
    QTest::newRow("constant of a machine that is not there")
        << QByteArray("[winch]\nkind = ideal\ngearRatio = 7\n") << QString() << QString()
        << QStringLiteral("plant.ini:3: 'gearRatio' has no meaning without an electrical machine; write kind = machine "
                          "in [winch], or leave it out");
    QTest::newRow("start of a kite at a mast")
        << QByteArray("[mast]\nkind = fixed\n[kite]\nmass = 5\ndistance = 90\n") << QString() << QString()
        << QStringLiteral("plant.ini:5: 'distance' has no meaning with a mast, because the flight begins there; leave "
                          "it out, or write kind = none in [mast]");
    QTest::newRow("key of a mast that is not there")
        << QByteArray("[mast]\nreach = 2\nkind = none\n") << QString() << QString()
        << QStringLiteral("plant.ini:2: 'reach' has no meaning without a mast; write kind = fixed in [mast], or leave "
                          "it out");
    const auto add = [](const char *text, const char *expected) {
        QTest::newRow(QByteArray(text).replace('\n', ' '))
            << QByteArray(text) << QString() << QString() << QString::fromLatin1(expected);
    };
    add("[wind]\nroughness = 0.1\n",
        "plant.ini:2: 'roughness' has no meaning in a uniform wind; write profile = power or profile = log in [wind], "
        "or leave it out");
    add("[wind]\nprofile = log\nexponent = 0.2\n",
        "plant.ini:3: 'exponent' has no meaning in a log profile; write profile = power in [wind], or leave it out");
    add("[wind]\nprofile = power\nroughness = 0.1\n",
        "plant.ini:3: 'roughness' has no meaning in a power profile; write profile = log in [wind], or leave it out");
    add("[wind]\nscaleHeight = 8000\n",
        "plant.ini:2: 'scaleHeight' has no meaning in a constant density; write density = falling in [wind], or leave "
        "it out");
    add("[tether]\nsegments = 10\n",
        "plant.ini:2: 'segments' has no meaning for a spring without drag and mass; write kind = straight or kind = "
        "segments in [tether], or leave it out");
    add("[tether]\nkind = straight\nsegments = 10\n",
        "plant.ini:3: 'segments' has no meaning for a straight tether; write kind = segments in [tether], or leave it "
        "out");
    add("[kite]\ntetherStiffness = 5000\n[tether]\nkind = segments\n",
        "plant.ini:2: 'tetherStiffness' has no meaning with a tether in segments; use axialStiffness and "
        "segmentDamping in [tether]");
    add("[steering]\nturnRateFactor = 0.2\n",
        "plant.ini:2: 'turnRateFactor' has no meaning while the yaw speed is the command; write kind = turn-rate in "
        "[steering], or leave it out");
    QTest::newRow("turbines without their mode")
        << QByteArray("[turbines]\ncoefficient = 0.2\n") << QString() << QString()
        << QStringLiteral("plant.ini:2: 'coefficient' has no meaning without turbines on board; write mode = drag in "
                          "[kite], or leave out [turbines]");
}

void tst_PlantConfiguration::contradictionIsRefused()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, winch);
    QFETCH(QString, mode);
    QFETCH(QString, expected);
    PlantConfiguration plant;
    QString error;
    QVERIFY(!PlantConfiguration::read(write(text), &plant, &error, {winch, mode}));
    QVERIFY2(error.endsWith(expected), qPrintable(error));
}

void tst_PlantConfiguration::sectionThatIsLeftOutIsTheBuiltInOne()
{
    PlantConfiguration builtIn, kite, winch;
    QString error;
    QVERIFY2(PlantConfiguration::read(PlantConfiguration::builtInFile(), &builtIn, &error), qPrintable(error));
    QVERIFY2(PlantConfiguration::read(write("[kite]\nmass = 3\n"), &kite, &error), qPrintable(error));
    QCOMPARE(kite.winchHardware, builtIn.winchHardware);
    QCOMPARE(kite.simulatedWinch, builtIn.simulatedWinch);
    QVERIFY2(PlantConfiguration::read(write("[winch]\nkind = drive\n"), &winch, &error), qPrintable(error));
    QVERIFY2(winch.simulatedWinch.isEmpty(), "a drive that the file does not call simulated is a real one");
    QCOMPARE(winch.kite.plant.mass, 5.0);
}

void tst_PlantConfiguration::withoutAnAzimuthTheKiteStartsDownwind()
{
    PlantConfiguration plant;
    QString error;
    QVERIFY2(PlantConfiguration::read(write("[kite]\nelevation = 0\ndistance = 10\n"), &plant, &error),
             qPrintable(error));
    WindParameters northwards;
    northwards.meanVelocity = Eigen::Vector3d(0.0, 7.0, 0.0);
    const PlantState start = plant.kite.plantIn(northwards).initialState;
    QVERIFY((start.position - Eigen::Vector3d(0.0, 10.0, 0.0)).norm() < 1e-9);
    QCOMPARE(start.tetherLength, 10.0);
}

void tst_PlantConfiguration::badLineIsNamedWithItsRemedy_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("expected");
    const auto add = [](const char *name, const char *text, const char *expected) {
        QTest::newRow(name) << QByteArray(text) << QString::fromUtf8(expected);
    };
    add("kind", "[winch]\nkind = steam\n", "plant.ini:2: kind = steam: use ideal, machine, drive or canopen");
    add("key of the winch", "[winch]\n; a comment\nkin = drive\n",
        "plant.ini:3: 'kin' is not a key of [winch]; did you mean 'kind'?");
    add("other key of the winch", "[winch]\nropes = 2\n",
        "plant.ini:2: 'ropes' is not a key of [winch]; use one of kind, hardware, canOpenHardware, simulated, "
        "drumRadius, ");
    add("constant of the machine", "[winch]\nkind = machine\ngearRatio = 0\n",
        "plant.ini:3: gearRatio = 0: use a number from 0.01 to 10000");
    add("section", "[kites]\n",
        "plant.ini:1: '[kites]' is not a section of a plant; use one of [winch], [kite], [wind], [tether], "
        "[steering], [turbines], [mast]");
    add("mode", "[kite]\nmode = fast\n", "plant.ini:2: mode = fast: use pumping or drag");
    add("word of the steering", "[steering]\nkind = wheel\n", "kind = wheel: use kinematic or turn-rate");
    add("word of the mast", "[mast]\nkind = tall\n", "plant.ini:2: kind = tall: use none or fixed");
    add("key of the mast", "[mast]\nheight = 2\n",
        "plant.ini:2: 'height' is not a key of [mast]; use one of kind, distance, elevation, azimuth, reach, "
        "startWind, "
        "landWind, stormStartWind, stormLandWind");
    add("key of the turbines", "[turbines]\nnumber = 2\n",
        "plant.ini:2: 'number' is not a key of [turbines]; use one of coefficient, tetherLength");
    add("word of the wind", "[wind]\nprofile = strong\n", "profile = strong: use uniform, power or log");
    add("word of the tether", "[tether]\nkind = rope\n", "kind = rope: use spring, straight or segments");
    add("key of the tether", "[tether]\nmass = 1\n", "'mass' is not a key of [tether]; use one of kind, segments, ");
    add("segments", "[tether]\nsegments = 21\n", "segments = 21: use a whole number from 1 to 20");
    add("before the section", "\nkind = drive\n", "plant.ini:2: 'kind' is outside of a section");
    add("no value", "[winch]\nkind\n", "plant.ini:2: 'kind' has no value; write kind = VALUE");
    add("close key of the kite", "[kite]\nmas = 3\n",
        "plant.ini:2: 'mas' is not a key of [kite]; did you mean 'mass'?");
    add("key of the kite", "[kite]\nqqqqqqqqqqqq = 3\n",
        "'qqqqqqqqqqqq' is not a key of [kite]; use one of mode, mass, area,");
    add("negative mass", "[kite]\n\nmass = -3\n", "plant.ini:3: mass = -3: use a number from 0.001 to 1e+06 kg");
    add("no number", "[kite]\narea = wide\n", "plant.ini:2: area = wide: use a number from 0.001 to 1e+06 m²");
    add("not a number", "[kite]\ndragFactor = nan\n", "dragFactor = nan: use a number from 0.001 to 1000");
    add("infinite", "[kite]\nmass = inf\n", "mass = inf: use a number from 0.001");
    add("empty", "[kite]\nmass =\n", "plant.ini:2: mass = : use a number from 0.001 to 1e+06 kg");
    add("two numbers for a vector", "[kite]\nwind = 5,3\n",
        "wind = 5,3: use three numbers X,Y,Z (east, north, up), each from -100 to 100 m/s");
    add("storm", "[kite]\nwind = 5,300,0\n", "wind = 5,300,0: use three numbers");
    add("NaN in a vector", "[kite]\nvelocity = nan,0,0\n", "velocity = nan,0,0: use three numbers");
    add("half a step", "[kite]\nsubsteps = 1.5\n", "substeps = 1.5: use a whole number from 1 to 100");
    add("choice", "[kite]\nground = soft\n", "ground = soft: use hold or ignore");
    add("twice", "[kite]\nmass = 3\nmass = 4\n", "plant.ini:3: 'mass' is there twice; give it once");
    add("twice, in two parts", "[kite]\nmass = 3\n[winch]\n[kite]\nmass = 4\n", "plant.ini:5: 'mass' is there twice");
}

void tst_PlantConfiguration::badLineIsNamedWithItsRemedy()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, expected);
    PlantConfiguration plant;
    QString error;
    QVERIFY(!PlantConfiguration::read(write(text), &plant, &error));
    QVERIFY2(error.contains(expected), qPrintable(error));
}

void tst_PlantConfiguration::missingFileIsNamed()
{
    PlantConfiguration plant;
    QString error;
    QVERIFY(!PlantConfiguration::read(QStringLiteral("/nowhere/plant.ini"), &plant, &error));
    QVERIFY2(error.contains(QLatin1String("/nowhere/plant.ini")), qPrintable(error));
}

/// As in --plant <(generate-a-kite).
void tst_PlantConfiguration::aPipeIsReadToItsEnd()
{
    int ends[2] = {-1, -1};
    QCOMPARE(::pipe2(ends, O_CLOEXEC), 0);
    const QByteArray text = "[kite]\nmass = 20\n";
    QCOMPARE(::write(ends[1], text.constData(), size_t(text.size())), text.size());
    ::close(ends[1]);
    PlantConfiguration plant;
    QString error;
    const bool isRead = PlantConfiguration::read(QStringLiteral("/proc/self/fd/%1").arg(ends[0]), &plant, &error);
    ::close(ends[0]);
    QVERIFY2(isRead, qPrintable(error));
    QCOMPARE(plant.kite.plant.mass, 20.0);
}

void tst_PlantConfiguration::fileThatIsTooLargeIsRefused()
{
    PlantConfiguration plant;
    QString error;
    const QString name = write("[kite]\n" + QByteArray(10'000'000, ';'));
    QVERIFY(!PlantConfiguration::read(name, &plant, &error));
    QVERIFY2(error.contains(QLatin1String("has more than 1048576 bytes")), qPrintable(error));
    QVERIFY(!PlantConfiguration::read(QStringLiteral("/dev/zero"), &plant, &error));
    QVERIFY2(error.contains(QLatin1String("has more than 1048576 bytes")), qPrintable(error));
}

void tst_PlantConfiguration::longLineIsNotRepeated()
{
    PlantConfiguration plant;
    QString error;
    QVERIFY(!PlantConfiguration::read(write("[kite]\nmass = 5\n" + QByteArray(5000, 'a') + "\n"), &plant, &error));
    QVERIFY2(error.endsWith(QLatin1String(":3: the line has 5000 characters; write 1000 at most")), qPrintable(error));
}

QTEST_APPLESS_MAIN(tst_PlantConfiguration)
#include "tst_PlantConfiguration.moc"
