// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "WindowFixtures.h"
#include "gui/window/InsecureNotice.h"

using namespace qplc;

/// What the window says of masters that anybody in the network can command, and only of those.
class tst_InsecureNotice : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() { m_settings = std::make_unique<TestSettings>(); }
    void localMasterShowsNoInsecureNotice();
    void anOpenMasterIsNamedUntilItIsLeft();

private:
    std::unique_ptr<TestSettings> m_settings;
};

void tst_InsecureNotice::localMasterShowsNoInsecureNotice()
{
    RunningMaster master;
    WindowFixture fixture;
    fixture.connectTo(master.address());
    QTRY_VERIFY(fixture.window.isConnected(master.address()));
    QCOMPARE(fixture.part<InsecureNotice>()->text(), QString());
}

void tst_InsecureNotice::anOpenMasterIsNamedUntilItIsLeft()
{
    QTest::ignoreMessage(QtWarningMsg, QRegularExpression(QStringLiteral("WITHOUT SECURITY")));
    TestMaster master;
    master.setInsecureNetworkAllowed(true);
    QVERIFY(master.listen(QHostAddress::AnyIPv4));
    const QString address = QStringLiteral("127.0.0.1:%1").arg(master.serverPort());
    WindowFixture fixture;
    fixture.connectTo(address);
    QTRY_COMPARE(fixture.part<InsecureNotice>()->text(),
                 QStringLiteral("Without security: everybody in the network can read and command %1.").arg(address));
    QVERIFY(fixture.part<InsecureNotice>()->isVisible());
    fixture.window.disconnectFromMaster(address);
    QTRY_COMPARE(fixture.part<InsecureNotice>()->text(), QString());
}

QTEST_MAIN(tst_InsecureNotice)
#include "tst_InsecureNotice.moc"
