// SPDX-License-Identifier: Apache-2.0
// A window at a master that answers nonsense.
#include "../../common/Waiting.h"
#include "NodeFixtures.h"
#include "gui/models/EventLogModel.h"
#include "gui/plant/PlantList.h"

#include <QtCore/QJsonArray>
#include <QtNetwork/QTcpServer>

using namespace qplc;

namespace {

/// A master that greets as it should, and answers each request as the test says; Invalid: not at
/// all.
class AnsweringMaster : public QObject
{
public:
    AnsweringMaster()
    {
        m_server.listen(QHostAddress::LocalHost, 0);
        connect(&m_server, &QTcpServer::newConnection, this, [this] {
            auto *socket = new QPlcSlaveSocket(m_server.nextPendingConnection(), this);
            connect(socket, &QPlcAbstractSocket::messageReceived, this, [this, socket](const QPlcMessage &request) {
                ++requests[request.kind()];
                const QPlcMessage reply = request.kind() == QPlcMessage::Hello ? greeting() : answer(request);
                if (reply.kind() != QPlcMessage::Invalid)
                    socket->sendMessage(reply);
            });
        });
    }
    QString address() const { return QStringLiteral("127.0.0.1:%1").arg(m_server.serverPort()); }

    std::function<QPlcMessage(const QPlcMessage &)> answer;
    QMap<QPlcMessage::Kind, int> requests;

private:
    static QPlcMessage greeting()
    {
        return {QPlcMessage::Hello,
                {{"protocol", 2},
                 {"session", QPlcMessage::fromHex64(7)},
                 {"state", "Off"},
                 {"period", 1e7},
                 {"table", "[speed]\ntype = Real\n"},
                 {"features", QJsonArray{"leases", "events"}}}};
    }

    QTcpServer m_server;
};

/// What answers a question, without the fields.
QPlcMessage::Kind answerTo(QPlcMessage::Kind question)
{
    switch (question) {
    case QPlcMessage::GetState:
        return QPlcMessage::State;
    case QPlcMessage::GetSignals:
        return QPlcMessage::Signals;
    case QPlcMessage::GetStatistics:
        return QPlcMessage::Statistics;
    case QPlcMessage::GetSchedule:
        return QPlcMessage::Schedule;
    case QPlcMessage::GetLeases:
        return QPlcMessage::Leases;
    case QPlcMessage::GetEvents:
        return QPlcMessage::Events;
    default:
        return QPlcMessage::Invalid;  // the listener of the window
    }
}

QPlcMessage honest(const QPlcMessage &request)
{
    const QPlcMessage::Kind kind = answerTo(request.kind());
    if (kind == QPlcMessage::Events)
        return {kind, {{"events", QJsonArray()}, {"more", false}}};
    return {kind, kind == QPlcMessage::State ? QJsonObject{{"state", "RealTime"}} : QJsonObject()};
}

struct Window
{
    explicit Window(const QString &address)
    {
        QObject::connect(&plants, &PlantList::eventOccurred, &log, &EventLogModel::append);
        plant = plants.add(address, QStringLiteral("kite"));
    }
    QStringList texts() const
    {
        QStringList all;
        for (int row = 0; row < log.rowCount(); ++row)
            all << log.at(row).text;
        return all;
    }

    PlantList plants;
    EventLogModel log;
    Plant *plant;
};

}  // namespace

class tst_HostilePlant : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void invalidAnswersLeaveTheWindowUsable_data();
    void invalidAnswersLeaveTheWindowUsable();
    void windowStopsReadingAnEndlessEventList();
};

void tst_HostilePlant::invalidAnswersLeaveTheWindowUsable_data()
{
    QTest::addColumn<QJsonObject>("fields");
    QTest::addColumn<int>("kind");  // -1: the one that answers
    const QJsonArray mixed{1, "x", QJsonValue(), QJsonObject{{"name", 3}, {"signal", QJsonArray()}, {"sequence", "x"}}};
    const QJsonObject wrong{{"state", 7},         {"period", "long"}, {"nodes", "many"}, {"counters", 1},
                            {"stopped", "x"},     {"master", 3},      {"worst", true},   {"stages", QJsonObject()},
                            {"links", 5},         {"signals", "all"}, {"leases", 1e300}, {"events", QJsonValue()},
                            {"clock", "Sundial"}, {"more", "perhaps"}};
    const QJsonObject elements{{"nodes", mixed},  {"signals", mixed}, {"leases", mixed}, {"events", mixed},
                               {"stages", mixed}, {"links", mixed},   {"worst", mixed},  {"more", true}};
    const QJsonObject node{
        {"name", "Winch"}, {"inputs", -1e300}, {"id", 1e300}, {"counters", QJsonObject{{"late", -1}}}};
    const QJsonObject numbers{{"period", -1e300},
                              {"scale", -1.0},
                              {"cycle", "x"},
                              {"session", "zz"},
                              {"nodes", QJsonArray{node}},
                              {"master", QJsonObject{{"counters", QJsonObject{{"overruns", 1e300}}}}}};
    QTest::newRow("wrong types") << wrong << -1;
    QTest::newRow("wrong elements") << elements << -1;
    QTest::newRow("wrong numbers") << numbers << -1;
    QTest::newRow("nothing") << QJsonObject() << -1;
    QTest::newRow("done") << QJsonObject() << int(QPlcMessage::Done);
    QTest::newRow("refusals") << QJsonObject{{"error", 1}, {"text", QJsonArray()}} << int(QPlcMessage::Failed);
    QTest::newRow("another answer") << elements << int(QPlcMessage::Statistics);
}

void tst_HostilePlant::invalidAnswersLeaveTheWindowUsable()
{
    QFETCH(QJsonObject, fields);
    QFETCH(int, kind);
    AnsweringMaster master;
    master.answer = [&](const QPlcMessage &request) {
        const QPlcMessage::Kind wanted = answerTo(request.kind());
        const bool isOfWindow = wanted != QPlcMessage::Invalid;
        return isOfWindow ? QPlcMessage(kind < 0 ? wanted : QPlcMessage::Kind(kind), fields) : QPlcMessage();
    };
    Window window(master.address());
    QTRY_VERIFY(master.requests.value(QPlcMessage::GetState) > 2);
    QVERIFY(window.plant->isConnected());
    QVERIFY(!window.plant->status().isRunning());
    master.answer = honest;
    QTRY_COMPARE(window.plant->stateText(), QStringLiteral("Real time"));
    QVERIFY(window.plant->leases().isEmpty());
}

void tst_HostilePlant::windowStopsReadingAnEndlessEventList()
{
    AnsweringMaster master;
    master.answer = [](const QPlcMessage &request) {
        if (request.kind() != QPlcMessage::GetEvents)
            return honest(request);
        const int next = request.fields().value("since").toInt() + 1;
        return QPlcMessage(
            QPlcMessage::Events,
            {{"events", QJsonArray{QJsonObject{{"sequence", next}, {"text", "again"}}}}, {"more", true}});
    };
    Window window(master.address());
    const QString connected = QStringLiteral("connected to the master at %1").arg(master.address());
    QTRY_VERIFY(window.texts().contains(connected));  // it waits for the events of before
    QTRY_COMPARE(window.plant->stateText(), QStringLiteral("Real time"));
}

QTEST_GUILESS_MAIN(tst_HostilePlant)
#include "tst_HostilePlant.moc"
