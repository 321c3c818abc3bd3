// SPDX-License-Identifier: Apache-2.0
#include "PlantParameters.h"

#include "Near.h"

#include <functional>
#include <limits>

using awe::PlantParameters;
using awe::PlantState;

class tst_PlantParameters : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void defaultsAreThoseOfTheThesisAndValid();
    void kiteStartsDownwindAtRestOnATautTether();
    void badValueIsNamedWithItsRemedy_data();
    void badValueIsNamedWithItsRemedy();
};

void tst_PlantParameters::defaultsAreThoseOfTheThesisAndValid()
{
    const PlantParameters parameters;
    QVERIFY2(parameters.validate().empty(), parameters.validate().c_str());
    QCOMPARE(parameters.mass, 5.0);
    QCOMPARE(parameters.tetherStiffness, 1000.0);
    QCOMPARE(parameters.tetherDamping, 0.0);
    QCOMPARE(parameters.step, 0.010);
}

void tst_PlantParameters::kiteStartsDownwindAtRestOnATautTether()
{
    const PlantState state = PlantParameters().initialState;
    COMPARE_NEAR(state.position.norm(), 100.0, 1e-12);
    COMPARE_NEAR(state.position.z(), 50.0, 1e-12);
    COMPARE_NEAR(state.position.y() / state.position.x(), 0.6, 1e-12);
    QCOMPARE(state.velocity.norm(), 0.0);
    QCOMPARE(state.tetherLength, 100.0);
}

using Change = std::function<void(PlantParameters &)>;
Q_DECLARE_METATYPE(Change)

void tst_PlantParameters::badValueIsNamedWithItsRemedy_data()
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    QTest::addColumn<Change>("change");
    QTest::addColumn<QString>("name");
    QTest::newRow("no mass") << Change([](PlantParameters &p) { p.mass = 0.0; }) << "mass is 0 kg";
    QTest::newRow("negative area") << Change([](PlantParameters &p) { p.area = -10.0; }) << "area is -10 m²";
    QTest::newRow("vacuum") << Change([](PlantParameters &p) { p.airDensity = 0.0; }) << "airDensity";
    QTest::newRow("NaN stiffness") << Change([=](PlantParameters &p) { p.tetherStiffness = nan; })
                                   << "tetherStiffness is nan";
    QTest::newRow("infinite damping") << Change([=](PlantParameters &p) { p.tetherDamping = infinity; })
                                      << "tetherDamping is inf";
    QTest::newRow("long step") << Change([](PlantParameters &p) { p.step = 1.0; }) << "step is 1 s";
    QTest::newRow("no drag") << Change([](PlantParameters &p) { p.dragFactor = 0.0; }) << "dragFactor";
    QTest::newRow("at the origin") << Change([](PlantParameters &p) { p.initialState.position.setZero(); })
                                   << "distance of initialState.position";
    QTest::newRow("NaN velocity") << Change([=](PlantParameters &p) { p.initialState.velocity.y() = nan; })
                                  << "initialState.velocity";
    QTest::newRow("no tether") << Change([](PlantParameters &p) { p.initialState.tetherLength = 0.0; })
                               << "initialState.tetherLength is 0 m";
}

void tst_PlantParameters::badValueIsNamedWithItsRemedy()
{
    QFETCH(Change, change);
    QFETCH(QString, name);
    PlantParameters parameters;
    change(parameters);
    VERIFY_CONTAINS(parameters.validate(), name.toStdString());
    VERIFY_CONTAINS(parameters.validate(), "; choose a value from ");
}

QTEST_APPLESS_MAIN(tst_PlantParameters)
#include "tst_PlantParameters.moc"
