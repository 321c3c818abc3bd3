// SPDX-License-Identifier: Apache-2.0
// A window at a master of another version.
#include "../../common/Waiting.h"
#include "ScriptedMaster.h"
#include "gui/models/EventLogModel.h"
#include "gui/plant/PlantList.h"

using namespace qplc;

namespace {

/// A master that answers the greeting of a window as the test wants, each time that it comes.
class OtherMaster : public QObject
{
public:
    OtherMaster()
    {
        m_server.listen(QHostAddress::LocalHost, 0);
        connect(&m_server, &QTcpServer::newConnection, this, [this] {
            auto *socket = new QPlcSlaveSocket(m_server.nextPendingConnection(), this);
            connect(socket, &QPlcAbstractSocket::messageReceived, this, [this, socket](const QPlcMessage &message) {
                greetings += message.kind() == QPlcMessage::Hello ? 1 : 0;
                socket->sendMessage(answer);
            });
        });
    }
    QString address() const { return QStringLiteral("127.0.0.1:%1").arg(m_server.serverPort()); }

    QPlcMessage answer;
    int greetings = 0;

private:
    QTcpServer m_server;
};

QPlcMessage helloOf(int protocol, const QByteArray &table)
{
    return QPlcMessage(QPlcMessage::Hello,
                       {{"protocol", protocol},
                        {"name", "Master"},
                        {"session", QPlcMessage::fromHex64(7)},
                        {"state", "Off"},
                        {"period", 1e7},
                        {"table", QString::fromUtf8(table)}});
}

/// A plant of a window, and its log.
struct Window
{
    explicit Window(const QString &address)
    {
        QObject::connect(&plants, &PlantList::eventOccurred, &log, &EventLogModel::append);
        plant = plants.add(address, QStringLiteral("kite"));
    }
    QString lastEvent() const { return log.rowCount() > 0 ? log.at(log.rowCount() - 1).text : QString(); }

    PlantList plants;
    EventLogModel log;
    Plant *plant;
};

}  // namespace

class tst_PlantVersions : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void aMasterOfAnotherVersionIsNamedInOneSentenceAndOnce();
    void masterThatRefusesThisVersionIsReportedOnce();
    void whenTheVersionsFitAgainTheWindowWorks();
    void aTableOfANewerMasterIsReadAsFarAsItIsKnown();
    void replacedMasterKeepsTheRecordedValues();
};

void tst_PlantVersions::aMasterOfAnotherVersionIsNamedInOneSentenceAndOnce()
{
    OtherMaster master;
    master.answer = helloOf(3, "[speed]\ntype = Real\n");
    Window window(master.address());
    QTRY_VERIFY(master.greetings >= 2);  // it goes on trying
    QCOMPARE(window.log.rowCount(), 1);
    QCOMPARE(window.lastEvent(),
             QStringLiteral("cannot work with the master at %1: versions differ: the master speaks protocol version 3, "
                            "this window version 2; update the older one")
                 .arg(master.address()));
    QCOMPARE(window.log.active(), 1);
    QVERIFY(window.plant->refusal().startsWith(QStringLiteral("versions differ: ")));
    QTRY_VERIFY(window.plant->stateText().contains(QStringLiteral("version 3")));
}

void tst_PlantVersions::masterThatRefusesThisVersionIsReportedOnce()
{
    OtherMaster master;
    master.answer = QPlcMessage(
        QPlcMessage::Rejected,
        {{"error", "VersionMismatch"},
         {"text", "protocol version 1 of 'ControlCenter' is not spoken here; this master speaks version 2"}});
    Window window(master.address());
    QTRY_COMPARE(window.log.rowCount(), 1);
    QVERIFY2(window.lastEvent().endsWith(
                 QStringLiteral("versions differ: protocol version 1 of 'ControlCenter' is not spoken here; this "
                                "master speaks version 2; update the older one")),
             qPrintable(window.lastEvent()));
}

void tst_PlantVersions::whenTheVersionsFitAgainTheWindowWorks()
{
    OtherMaster master;
    master.answer = helloOf(3, "[speed]\ntype = Real\n");
    Window window(master.address());
    QTRY_COMPARE(window.log.active(), 1);
    master.answer = helloOf(2, "[speed]\ntype = Real\n");
    QTRY_VERIFY(window.plant->isConnected());
    QCOMPARE(window.log.active(), 0);
    QCOMPARE(window.plant->refusal(), QString());
}

void tst_PlantVersions::aTableOfANewerMasterIsReadAsFarAsItIsKnown()
{
    OtherMaster master;
    master.answer = helloOf(2, "[speed]\ntype = Real\nmood = good\nvalues.of.tomorrow = 1\n");
    Window window(master.address());
    QTRY_VERIFY(window.plant->isConnected());
    QVERIFY(window.plant->table().contains(QStringLiteral("speed")));
}

void tst_PlantVersions::replacedMasterKeepsTheRecordedValues()
{
    OtherMaster master;
    master.answer = helloOf(2, "[speed]\ntype = Real\n");
    Window window(master.address());
    QTRY_VERIFY(window.plant->isConnected());
    master.answer = QPlcMessage(QPlcMessage::MasterEnds);
    QTRY_VERIFY(!window.plant->isConnected());
    master.answer = helloOf(3, "[other]\ntype = Real\n");
    QTRY_VERIFY(!window.plant->refusal().isEmpty());
    QVERIFY(window.plant->store());
    QVERIFY(window.plant->table().contains(QStringLiteral("speed")));
}

QTEST_MAIN(tst_PlantVersions)
#include "tst_PlantVersions.moc"
