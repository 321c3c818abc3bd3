// SPDX-License-Identifier: Apache-2.0
#include "ClosedLoopFlight.h"
#include "ExampleOptions.h"

#include <QtCore/QFile>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QRegularExpression>
#include <QtCore/QTemporaryDir>
#include <QtPlcGui>
#include <QtTest/QtTest>

#include <algorithm>
#include <functional>
#include <iterator>

namespace {

const QString fileName = QStringLiteral(AWE_LAYOUTS "/airborne_wind_energy.json");
const QString plantOptions = QStringLiteral(AWE_LAYOUTS "/plant_options.json");
const QString mast = QStringLiteral(AWE_LAYOUTS "/mast.json");
const QString steeredWing = QStringLiteral(AWE_LAYOUTS "/steered_wing.json");
const QString fourViews = QStringLiteral(AWE_LAYOUTS "/four_views.json");

QByteArray layoutText(const QString &name = fileName)
{
    QFile file(name);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

/// All texts below \a value whose key says that they name a signal.
QStringList signalTexts(const QJsonValue &value, const QString &key = QString())
{
    static const QStringList keys{QStringLiteral("signal"), QStringLiteral("x"), QStringLiteral("y")};
    if (value.isString())
        return keys.contains(key) ? QStringList{value.toString()} : QStringList();
    QStringList all;
    for (const QJsonValue &each : value.toArray())
        all += signalTexts(each, key);
    const QJsonObject object = value.toObject();
    for (auto entry = object.begin(); entry != object.end(); ++entry)
        all += signalTexts(entry.value(), entry.key());
    return all;
}

/// The settings of all gauges below \a value.
QVector<QJsonObject> gaugesIn(const QJsonValue &value)
{
    QVector<QJsonObject> all;
    for (const QJsonValue &each : value.toArray())
        all += gaugesIn(each);
    const QJsonObject object = value.toObject();
    if (object.value(QStringLiteral("type")).toString() == QLatin1String("Gauge"))
        all << object.value(QStringLiteral("settings")).toObject();
    for (const QJsonValue &each : object)
        all += gaugesIn(each);
    return all;
}

/// A dial of the layout, and what the flight shows on it.
struct Dial
{
    QString signal;
    double minimum;
    double maximum;
    std::function<double(const awe::PlantOutputs &)> shown;
    double least;
    double greatest;
};

QVector<Dial> dialsOfTheLayout()
{
    const QHash<QString, std::function<double(const awe::PlantOutputs &)>> known{
        {QStringLiteral("bodyPosition_earth[2]"), [](const awe::PlantOutputs &now) { return now.position.z(); }},
        {QStringLiteral("= norm(bodyVelocity_earth)"),
         [](const awe::PlantOutputs &now) { return now.velocity.norm(); }},
        {QStringLiteral("tetherLength"), [](const awe::PlantOutputs &now) { return now.tetherLength; }},
        {QStringLiteral("= norm(tetherForce_earth)"),
         [](const awe::PlantOutputs &now) { return now.tetherForce.norm(); }},
        {QStringLiteral("power"), [](const awe::PlantOutputs &now) { return now.power; }}};
    QVector<Dial> dials;
    for (const QJsonObject &gauge : gaugesIn(QJsonDocument::fromJson(layoutText()).object())) {
        if (gauge.value(QStringLiteral("style")).toString() != QLatin1String("dial"))
            continue;
        const QString signal = gauge.value(QStringLiteral("signal")).toString();
        dials.append({signal, gauge.value(QStringLiteral("minimum")).toDouble(),
                      gauge.value(QStringLiteral("maximum")).toDouble(), known.value(signal), 1e9, -1e9});
    }
    return dials;
}

}  // namespace

/// The layout that comes with awe_control_center.
class tst_BuiltInLayout : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void layoutIsLoadedAndShown();
    void layoutIsWrittenAsItIsShown();
    void everySignalIsInTheTable_data();
    void everySignalIsInTheTable();
    void theDialsHoldTheFlightOfTheDemo();
    void fourViewsLayoutMatchesTheManual();
    void mastLayoutHasTheRequestOfTheOperator();
    void keysTurnASteeredWingTheSameWay();
};

void tst_BuiltInLayout::layoutIsLoadedAndShown()
{
    QPlcControlCenter window;
    QString error;
    QVERIFY2(window.addLayout(QStringLiteral("built in"), layoutText(), &error), qPrintable(error));
    for (const char *tab : {"Fly", "Ground station", "Real time"})
        QVERIFY2(window.showTab(QString::fromLatin1(tab)), tab);
    QVERIFY(!window.showTab(QStringLiteral("Kitchen")));
}

void tst_BuiltInLayout::layoutIsWrittenAsItIsShown()
{
    QPlcControlCenter window;
    QVERIFY(window.openLayout(fileName));
    QTemporaryDir folder;
    const QString copy = folder.filePath(QStringLiteral("copy.json"));
    QVERIFY(window.saveLayout(copy));
    QFile file(copy);
    QVERIFY(file.open(QIODevice::ReadOnly));
    QCOMPARE(QJsonDocument::fromJson(file.readAll()), QJsonDocument::fromJson(layoutText()));
}

void tst_BuiltInLayout::everySignalIsInTheTable_data()
{
    QTest::addColumn<QString>("file");
    QTest::addColumn<int>("least");
    QTest::newRow("Airborne wind energy") << fileName << 15;
    QTest::newRow("Four views") << fourViews << 10;
    QTest::newRow("Options of the plant") << plantOptions << 2;
    QTest::newRow("Start and landing") << mast << 6;
    QTest::newRow("Steered wing") << steeredWing << 10;
}

void tst_BuiltInLayout::everySignalIsInTheTable()
{
    QFETCH(QString, file);
    QFETCH(int, least);
    QPlcSignalTable table = QPlcSignalTable::fromIniFile(awe::builtInSignals());
    QVERIFY(table.size() > 0);
    if (file == mast || file == steeredWing) {
        for (const QPlcSignalDefinition &signal : QPlcSignalTable::fromIniFile(awe::builtInOptionSignals()))
            QVERIFY(table.append(signal));
    }
    const QStringList texts = signalTexts(QJsonDocument::fromJson(layoutText(file)).object());
    QVERIFY(texts.size() > least);
    static const QRegularExpression name(QStringLiteral("\\b[A-Za-z_]\\w*(?!\\w*\\()"));
    for (const QString &text : texts) {
        QRegularExpressionMatchIterator names = name.globalMatch(text);
        QVERIFY2(names.hasNext(), qPrintable(text));
        while (names.hasNext()) {
            const QString signal = names.next().captured();
            QVERIFY2(table.contains(signal), qPrintable(text));
        }
    }
}

/// A quarter of an hour with the turbulence of the demo. A dial that is used to less than the half
/// is no better than one that ends too early.
void tst_BuiltInLayout::theDialsHoldTheFlightOfTheDemo()
{
    QVector<Dial> dials = dialsOfTheLayout();
    QCOMPARE(dials.size(), 5);
    awe::ClosedLoopParameters parameters;
    parameters.wind.turbulenceIntensity = 0.1;
    awe::ClosedLoopFlight flight(parameters);
    for (int cycle = 0; cycle < 90000; ++cycle) {
        flight.step();
        for (Dial &dial : dials) {
            const double value = dial.shown(flight.outputs());
            dial.least = std::min(dial.least, value);
            dial.greatest = std::max(dial.greatest, value);
        }
    }
    for (const Dial &dial : qAsConst(dials)) {
        const QString figures = QStringLiteral("%1: %2 ... %3 on a dial of %4 ... %5")
                                    .arg(dial.signal)
                                    .arg(dial.least)
                                    .arg(dial.greatest)
                                    .arg(dial.minimum)
                                    .arg(dial.maximum);
        QVERIFY2(dial.minimum <= dial.least && dial.greatest <= dial.maximum, qPrintable(figures));
        QVERIFY2(dial.greatest >= 0.5 * dial.maximum, qPrintable(figures));
    }
}

/// One panel of keys, four gauges, two plots, and four views of the kite: two of them with the path
/// of the last three minutes, the largest with that of the last 10 s.
void tst_BuiltInLayout::fourViewsLayoutMatchesTheManual()
{
    QPlcControlCenter window;
    QString error;
    QVERIFY2(window.addLayout(QStringLiteral("built in"), layoutText(), &error), qPrintable(error));
    QVERIFY2(window.addLayout(QStringLiteral("Four views"), layoutText(fourViews), &error), qPrintable(error));
    QVERIFY(window.showLayout(QStringLiteral("Four views")));
    QHash<QString, int> types;
    QVector<double> trails;
    const std::function<void(const QJsonObject &)> walk = [&](const QJsonObject &node) {
        if (node.contains(QStringLiteral("type")))
            ++types[node[QStringLiteral("type")].toString()];
        if (node[QStringLiteral("type")].toString() == QLatin1String("3D view"))
            trails << node[QStringLiteral("settings")].toObject()[QStringLiteral("trail")].toDouble(30.0);
        const QJsonArray children = node[QStringLiteral("children")].toArray();
        for (const QJsonValue &child : children)
            walk(child.toObject());
    };
    const QJsonArray tabs = QJsonDocument::fromJson(window.layoutJson()).object()[QStringLiteral("tabs")].toArray();
    QCOMPARE(tabs.size(), 1);
    walk(tabs.first().toObject()[QStringLiteral("tree")].toObject());
    QCOMPARE(types,
             (QHash<QString, int>{{QStringLiteral("Keyboard control"), 1},
                                  {QStringLiteral("Gauge"), 4},
                                  {QStringLiteral("Time plot"), 2},
                                  {QStringLiteral("3D view"), 4}}));
    QCOMPARE(trails.count(180.0), 2);
    QCOMPARE(trails.count(10.0), 1);
}

/// Its setter is a list of the requests that the signal table names.
void tst_BuiltInLayout::mastLayoutHasTheRequestOfTheOperator()
{
    QPlcControlCenter window;
    QString error;
    QVERIFY2(window.addLayout(QStringLiteral("Start and landing"), layoutText(mast), &error), qPrintable(error));
    QVERIFY(window.showLayout(QStringLiteral("Start and landing")));
    const auto *setter = window.findChild<QPlcSetter *>();
    QVERIFY(setter);
    QCOMPARE(setter->settings().value(QStringLiteral("signal")).toString(), QStringLiteral("flightRequest"));
    QCOMPARE(setter->settings().value(QStringLiteral("style")).toString(), QStringLiteral("list"));
    const QPlcSignalTable table = QPlcSignalTable::fromIniFile(awe::builtInOptionSignals());
    const QPlcSignalDefinition &request = table.at(table.indexOf(QStringLiteral("flightRequest")));
    const std::pair<const char *, awe::FlightRequest> requests[] = {{"Automatic", awe::FlightRequest::Automatic},
                                                                    {"Fly", awe::FlightRequest::Fly},
                                                                    {"Land", awe::FlightRequest::Land}};
    QCOMPARE(request.valueNames.size(), int(std::size(requests)));
    for (const auto &[name, number] : requests)
        QCOMPARE(request.valueNames.nameOf(int(number)), QString::fromLatin1(name));
    QCOMPARE(request.initial.toInt(), int(awe::FlightRequest::Automatic));
    QCOMPARE(request.safeValue().toInt(), int(awe::FlightRequest::Land));
}

/// By how much a held key turns the wing within a second: the change of its yaw angle [deg].
static double turnedBy(const QString &layout, const char *key, const char *signal, double awe::PlantInputs::*input,
                       awe::SteeringKind steering)
{
    QPlcControlCenter window;
    const QString name = QStringLiteral("built in");
    if (!window.addLayout(name, layoutText(layout)) || !window.showLayout(name))
        return 0.0;
    const auto *panel = window.findChild<QPlcKeyboardControl *>();
    const QJsonArray keys = panel ? panel->settings().value(QStringLiteral("keys")).toArray() : QJsonArray();
    awe::PlantInputs inputs;
    inputs.windVelocity = awe::WindParameters().meanVelocity;
    for (const QJsonValue &each : keys) {
        const QJsonObject binding = each.toObject();
        if (binding.value(QStringLiteral("key")).toString() == QLatin1String(key)
            && binding.value(QStringLiteral("signal")).toString() == QLatin1String(signal))
            inputs.*input = binding.value(QStringLiteral("value")).toDouble();
    }
    awe::PlantOptions options;
    options.steering.kind = steering;
    awe::ExtendedPlant plant(awe::PlantParameters(), options);
    const double before = plant.state().yawAngle;
    for (int cycle = 0; cycle < 100; ++cycle)
        plant.step(inputs);
    return plant.state().yawAngle - before;
}

/// Left is left, whether the yaw speed is the command or the air turns the wing.
void tst_BuiltInLayout::keysTurnASteeredWingTheSameWay()
{
    const auto ideal = [](const char *key) {
        return turnedBy(fileName, key, "bodyControlYawSpeed", &awe::PlantInputs::yawSpeed,
                        awe::SteeringKind::Kinematic);
    };
    const auto steered = [](const char *key) {
        return turnedBy(steeredWing, key, "steeringCommand", &awe::PlantInputs::steering, awe::SteeringKind::TurnRate);
    };
    QVERIFY(ideal("Left") < -10.0 && ideal("Right") > 10.0);
    QVERIFY(steered("Left") < -5.0 && steered("Right") > 5.0);
}

QTEST_MAIN(tst_BuiltInLayout)
#include "tst_BuiltInLayout.moc"
