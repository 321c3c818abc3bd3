// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "SecurityFixtures.h"
#include "WindowFixtures.h"

using namespace qplc;

/// A window at a master that wants to know who it is, over TLS with pre-shared keys.
class tst_SecuredPlant : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() { m_settings = std::make_unique<TestSettings>(); }
    void init();
    void cleanup();
    void anOperatorInitializesArmsAndStarts();
    void operatorStartsDirectlyWhenArmingIsNotRequired();
    void anObserverSeesAndMayStopAndNothingElse();
    void unknownIdentityIsReported();
    void aPlainAndASecuredPlantAreInOneWindow();
    void unusableAddressIsReported_data();
    void unusableAddressIsReported();

private:
    /// Presses the one next thing to do when it is \a text.
    bool next(WindowFixture *fixture, const char *text)
    {
        BarButton *button = fixture->topBar()->nextButton();
        if (!waitUntil([&] { return button->isVisible() && button->text() == QLatin1String(text); }))
            return false;
        QTest::mouseClick(button, Qt::LeftButton);
        return true;
    }

    QString address() const { return QStringLiteral("127.0.0.1:%1").arg(m_master->serverPort()); }

    std::unique_ptr<TestSettings> m_settings;
    SecurityFiles m_files;
    CounterNode m_counter;
    std::unique_ptr<TestMaster> m_master;
};

void tst_SecuredPlant::init()
{
    m_master = std::make_unique<TestMaster>(QPlcClock::realTime());
    m_master->setInterval(std::chrono::milliseconds(10));
    m_master->setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(m_master->addLocalNode(&m_counter));
    QVERIFY(m_master->listen());
}

void tst_SecuredPlant::cleanup()
{
    m_master.reset();
    QPlcSecurity::setCurrent(QPlcSecurity());
}

void tst_SecuredPlant::anOperatorInitializesArmsAndStarts()
{
    QPlcSecurity::setCurrent(m_files.anna());
    WindowFixture fixture;
    fixture.connectTo(address());
    QVERIFY(next(&fixture, "Initialize"));
    QVERIFY(next(&fixture, "Arm"));
    QVERIFY(next(&fixture, "Start"));
    QVERIFY(m_master->waitForState(QPlcMasterNode::RealTime));
    QTRY_VERIFY(fixture.plant()->store()->endRow() > 5);
    QTest::mouseClick(fixture.topBar()->stopButton(), Qt::LeftButton);
    QVERIFY(m_master->waitForState(QPlcMasterNode::Off));
}

void tst_SecuredPlant::operatorStartsDirectlyWhenArmingIsNotRequired()
{
    m_master->setArmingRequired(false);
    QPlcSecurity::setCurrent(m_files.anna());
    WindowFixture fixture;
    fixture.connectTo(address());
    QVERIFY(next(&fixture, "Start"));
    QVERIFY(m_master->waitForState(QPlcMasterNode::RealTime));
}

void tst_SecuredPlant::anObserverSeesAndMayStopAndNothingElse()
{
    QPlcSecurity::setCurrent(m_files.bert());
    WindowFixture fixture;
    fixture.connectTo(address());
    QVERIFY(next(&fixture, "Initialize"));
    QTRY_VERIFY(fixture.hint().contains(QLatin1String("role Observer may not")));
    QCOMPARE(m_master->state(), QPlcMasterNode::Off);
    QVERIFY(m_master->startArmed());
    QTRY_VERIFY(fixture.plant()->store()->endRow() > 5);
    QTest::mouseClick(fixture.topBar()->stopButton(), Qt::LeftButton);
    QVERIFY(m_master->waitForState(QPlcMasterNode::Off));
}

void tst_SecuredPlant::unknownIdentityIsReported()
{
    QPlcSecurity::setCurrent(m_files.of(QStringLiteral("mallory"), 'f'));
    WindowFixture fixture;
    fixture.connectTo(address());
    QTRY_VERIFY(fixture.plant()->stateText().contains(QLatin1String("does not know identity 'mallory'")));
    QVERIFY(!fixture.window.isConnected(address()));
}

void tst_SecuredPlant::aPlainAndASecuredPlantAreInOneWindow()
{
    m_files.anna();
    TestMaster plain;
    QVERIFY(plain.listen());
    WindowFixture fixture;
    fixture.connectTo(QStringLiteral("127.0.0.1:%1").arg(plain.serverPort()));
    QTRY_VERIFY(fixture.plant(0)->isConnected());
    fixture.connectTo(address() + QStringLiteral("?keys=") + m_files.path(QStringLiteral("anna.ini")));
    QTRY_COMPARE(fixture.window.plants().size(), 2);
    QTRY_VERIFY(fixture.plant(1)->isConnected());
    QTRY_VERIFY(fixture.plant(1)->ownNode());  // its listener is known by the key, too
    const PlantSelector *selector = fixture.topBar()->selector();
    QCOMPARE(fixture.plant(1)->name(), address());
    QTRY_VERIFY(selector->figures().startsWith(QStringLiteral("anna (Operator)")));
    const QString profile = QStringLiteral("Profile Plant: set at the master");
    QTRY_COMPARE(selector->accessibleDescription(), profile);
    QVERIFY2(selector->toolTip().endsWith(profile), qPrintable(selector->toolTip()));
    fixture.press(Qt::Key_P, Qt::ControlModifier);
    QTRY_VERIFY(!selector->figures().contains(QStringLiteral("anna")));
    QVERIFY(next(&fixture, "Start"));
    QVERIFY(plain.waitForState(QPlcMasterNode::RealTime));
    QCOMPARE(m_master->state(), QPlcMasterNode::Off);
}

void tst_SecuredPlant::unusableAddressIsReported_data()
{
    QTest::addColumn<QString>("query");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("unknown option") << "?keyz=a.ini"
                                    << "'keyz' in the address";
    QTest::newRow("no way to connect") << "?identity=anna"
                                       << "does not say how to connect";
    QTest::newRow("no such file") << "?keys=/nowhere/anna.ini"
                                  << "/nowhere/anna.ini";
}

void tst_SecuredPlant::unusableAddressIsReported()
{
    QFETCH(QString, query);
    QFETCH(QString, sentence);
    WindowFixture fixture;
    fixture.window.connectToMaster(address() + query);
    QTRY_VERIFY(fixture.plant()->stateText().contains(sentence));
}

QTEST_MAIN(tst_SecuredPlant)
#include "tst_SecuredPlant.moc"
