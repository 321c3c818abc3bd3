// SPDX-License-Identifier: Apache-2.0
#include "KiteFixtures.h"
#include "kite/OptionFigures.h"

#include <QtPlcCore>

using namespace awe;
using qplc::WindowContext;

namespace {

/// A plant with two of the options.
QPlcSignalTable optionTable()
{
    return QPlcSignalTable::fromIni("[electricalPower]\ntype = Real\nunit = W\n[steering]\ntype = Real\n"
                                    "[power]\ntype = Real\nunit = W\n");
}

class OptionNode : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    OptionNode()
        : QPlcCompactSlaveNode(QStringLiteral("Model"))
    {
    }

private:
    void step(const QPlcCycle &) override
    {
        m_power = 900.0;
        m_steering = -0.5;
    }

    QPlcOutput<double> m_power{this, "electricalPower"};
    QPlcOutput<double> m_steering{this, "steering"};
};

}  // namespace

class tst_OptionFigures : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void panelWithoutPlantIsDrawnAtAnySize();
    void plantWithoutOptionsHasNoRows();
    void rowsAreThoseOfTheOptionsThatThePlantHas();

private:
    static QImage picture(OptionFigures *panel, const QSize &size)
    {
        panel->resize(size);
        return panel->grab().toImage();
    }
};

void tst_OptionFigures::panelWithoutPlantIsDrawnAtAnySize()
{
    OptionFigures panel;
    QVERIFY(!picture(&panel, {240, 160}).isNull());
    QVERIFY(!picture(&panel, {1, 1}).isNull());
    QCOMPARE(panel.shownSignals(), QStringList());
}

void tst_OptionFigures::plantWithoutOptionsHasNoRows()
{
    FlyingPlant plant;
    QVERIFY(plant.fly());
    OptionFigures panel;
    panel.setContext(&plant.context);
    QCOMPARE(panel.shownSignals(), QStringList());
}

void tst_OptionFigures::rowsAreThoseOfTheOptionsThatThePlantHas()
{
    TestMaster master(QPlcClock::realTime(), optionTable());
    OptionNode node;
    QVERIFY(master.listen());
    QVERIFY(master.admit(node, QStringLiteral("local")));
    WindowContext context;
    context.plants()->add(QStringLiteral("127.0.0.1:%1").arg(master.serverPort()));
    qplc::Plant *plant = context.plants()->at(0);
    QVERIFY(waitUntil([plant] { return plant->nextAction() == qplc::Plant::Start; }, 10'000));
    plant->start();
    QVERIFY(waitUntil([plant] { return plant->store() && plant->store()->endRow() > 20; }, 10'000));
    OptionFigures panel;
    panel.setContext(&context);
    const QStringList expected{QStringLiteral("electricalPower"), QStringLiteral("steering")};
    QCOMPARE(panel.shownSignals(), expected);
    const QColor accent = context.theme().accent;
    const auto isBar = [&accent](const QColor &pixel) { return pixel == accent; };
    const QImage seen = picture(&panel, {240, 160});
    const QRect left(0, 0, 120, 160), right(120, 0, 120, 160);
    QVERIFY(countPixels(seen, left, isBar) > 100);  // steering to the left, power from -4 kW ... 8 kW
    QVERIFY(countPixels(seen, right, isBar) < 100);
    node.disconnectFromMaster();
}

QTEST_MAIN(tst_OptionFigures)
#include "tst_OptionFigures.moc"
