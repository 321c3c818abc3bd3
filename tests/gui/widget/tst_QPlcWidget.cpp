// SPDX-License-Identifier: Apache-2.0
#include "QPlcWidget.h"
#include "QPlcWidgetFactory.h"

#include <QtTest/QtTest>

namespace {

class Compass : public QPlcWidget
{
    Q_OBJECT
public:
    enum { Type = UserType + 1 };

    int type() const override { return Type; }
    using QPlcWidget::setInitialOutputSignals;
    using QPlcWidget::setInputSignalIndices;
    using QPlcWidget::setOutputSignalIndices;
};

/// A widget that nobody has made a factory for.
class Lonely : public QPlcWidget
{
    Q_OBJECT
public:
    int type() const override { return UserType + 2; }
};

class CompassFactory : public QPlcWidgetFactory
{
public:
    int type() const override { return Compass::Type; }
    QString name() const override { return QStringLiteral("Compass"); }
    QPlcWidget *createNew(QWidget *parent) const override
    {
        auto *made = new Compass;
        made->setParent(parent);
        return made;
    }
};

}  // namespace

class tst_QPlcWidget : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void factoryIsFoundByTypeAndName();
    void unknownFactoryIsNull();
    void factoryThatIsRegisteredTwiceIsOne();
    void factoryMakesWidgetsOfItsType();
    void titleDefaultsToTheFactoryName();
    void newTitleIsSignalledOnce();
    void settingsAreRestored();
    void settingsThatAreNotKnownAreKept();
    void missingSettingsLeaveThingsAsTheyAre();
    void removedTitleIsNotASetting();
    void changedSignalListsAreSignalled();

private:
    QPlcWidgetFactory *m_factory = nullptr;
};

void tst_QPlcWidget::initTestCase()
{
    m_factory = QPlcWidget::registerFactory(new CompassFactory);
    QVERIFY(m_factory);
}

void tst_QPlcWidget::factoryIsFoundByTypeAndName()
{
    QCOMPARE(QPlcWidget::factory(Compass::Type), m_factory);
    QCOMPARE(QPlcWidget::factory(QStringLiteral("Compass")), m_factory);
    QCOMPARE(Compass().factory(), m_factory);
}

void tst_QPlcWidget::unknownFactoryIsNull()
{
    QVERIFY(!QPlcWidget::factory(Compass::Type + 1));
    QVERIFY(!QPlcWidget::factory(QStringLiteral("compass")));
    QVERIFY(!QPlcWidget::factory(QString()));
    QVERIFY(!Lonely().factory());
}

void tst_QPlcWidget::factoryThatIsRegisteredTwiceIsOne()
{
    QCOMPARE(QPlcWidget::registerFactory(m_factory), m_factory);
    QCOMPARE(QPlcWidget::factory(Compass::Type), m_factory);
}

void tst_QPlcWidget::factoryMakesWidgetsOfItsType()
{
    QWidget parent;
    const QPlcWidget *made = m_factory->createNew(&parent);
    QCOMPARE(made->type(), m_factory->type());
    QCOMPARE(made->parentWidget(), &parent);
}

void tst_QPlcWidget::titleDefaultsToTheFactoryName()
{
    Compass compass;
    QCOMPARE(compass.title(), QStringLiteral("Compass"));
    compass.setTitle(QStringLiteral("Heading"));
    QCOMPARE(compass.title(), QStringLiteral("Heading"));
    compass.setTitle(QString());
    QCOMPARE(compass.title(), QStringLiteral("Compass"));
    QCOMPARE(Lonely().title(), QString());
}

void tst_QPlcWidget::newTitleIsSignalledOnce()
{
    Compass compass;
    const QSignalSpy told(&compass, &QPlcWidget::titleChanged);
    compass.setTitle(QStringLiteral("Heading"));
    compass.setTitle(QStringLiteral("Heading"));
    QCOMPARE(told.count(), 1);
}

void tst_QPlcWidget::settingsAreRestored()
{
    Compass compass;
    QCOMPARE(compass.settings(), QJsonObject());
    compass.setTitle(QStringLiteral("Heading"));
    QCOMPARE(compass.settings(), (QJsonObject{{"title", "Heading"}}));
    Compass other;
    const QSignalSpy edited(&other, &QPlcWidget::settingsEdited);
    other.applySettings(compass.settings());
    QCOMPARE(other.title(), QStringLiteral("Heading"));
    QCOMPARE(other.settings(), compass.settings());
    QCOMPARE(edited.count(), 0);  // no person did that
}

void tst_QPlcWidget::settingsThatAreNotKnownAreKept()
{
    Compass compass;
    const QJsonObject later{{"later", QJsonObject{{"a", 1}}}, {"title", "Heading"}};
    compass.applySettings(later);
    QCOMPARE(compass.settings(), later);
}

void tst_QPlcWidget::missingSettingsLeaveThingsAsTheyAre()
{
    Compass compass;
    compass.applySettings({{"later", 1}, {"title", "Heading"}});
    compass.applySettings({{"other", 2}});
    QCOMPARE(compass.settings(), (QJsonObject{{"later", 1}, {"other", 2}, {"title", "Heading"}}));
}

void tst_QPlcWidget::removedTitleIsNotASetting()
{
    Compass compass;
    compass.applySettings({{"title", "Heading"}});
    compass.setTitle(QString());
    QCOMPARE(compass.settings(), QJsonObject());
    compass.applySettings({{"title", ""}});
    QCOMPARE(compass.settings(), QJsonObject());
}

void tst_QPlcWidget::changedSignalListsAreSignalled()
{
    Compass compass;
    const QSignalSpy inputs(&compass, &QPlcWidget::inputSignalIndicesChanged);
    const QSignalSpy outputs(&compass, &QPlcWidget::outputSignalIndicesChanged);
    const QSignalSpy initial(&compass, &QPlcWidget::initialOutputSignalsChanged);
    QPlcSignalIndexList three;
    three.insert(QPlcSignalIndex(3));
    compass.setInputSignalIndices(three);
    QCOMPARE(inputs.count(), 1);
    QCOMPARE(compass.inputSignalIndices(), three);
    QVERIFY(compass.outputSignalIndices().isEmpty());
    compass.setOutputSignalIndices(three);
    QCOMPARE(outputs.count(), 1);
    QCOMPARE(compass.outputSignalIndices(), three);
    compass.setInitialOutputSignals(QPlcSignalList());
    QCOMPARE(initial.count(), 1);
}

QTEST_MAIN(tst_QPlcWidget)
#include "tst_QPlcWidget.moc"
