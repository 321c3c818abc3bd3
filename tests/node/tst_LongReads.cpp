// SPDX-License-Identifier: Apache-2.0
#include "NodeFixtures.h"
#include "SecurityFixtures.h"
#include "node/api/QPlcMasterNodePrivate.h"
#include "protocol/LittleEndian.h"

#include <condition_variable>
#include <mutex>
#include <thread>

namespace {

// The thread that reads long messages, which a server keeps to itself: an explicit instantiation
// may name what is private.
qplc::Worker &readerOf(qplc::MasterServer &server);
template<qplc::Worker qplc::MasterServer::*Reader>
struct Members
{
    friend qplc::Worker &readerOf(qplc::MasterServer &server) { return server.*Reader; }
};
template struct Members<&qplc::MasterServer::m_reader>;

/// While it lives, the master reads no long message.
class ReaderHeld
{
public:
    explicit ReaderHeld(const QPlcMasterNode &master)
    {
        readerOf(QPlcMasterNodePrivate::of(master).parts->server).begin([share = m_gate] {
            std::unique_lock<std::mutex> lock(share->mutex);
            share->changed.wait(lock, [&share] { return share->isOpen; });
        });
    }
    ~ReaderHeld() { letGo(); }
    void letGo()
    {
        const std::lock_guard<std::mutex> lock(m_gate->mutex);
        m_gate->isOpen = true;
        m_gate->changed.notify_all();
    }

private:
    struct Gate
    {
        std::mutex mutex;
        std::condition_variable changed;
        bool isOpen = false;
    };
    std::shared_ptr<Gate> m_gate = std::make_shared<Gate>();
};

constexpr int Long = 70 * 1024;  // [byte] more than is read at once
constexpr int Signals = 2000;

QPlcSignalTable table()
{
    QByteArray ini;
    for (int i = 0; i < Signals; ++i)
        ini += "[signal_" + QByteArray::number(i) + "]\ntype = Real64\n";
    return QPlcSignalTable::fromIni(ini);
}

/// Its registration is long.
void listenToAll(ScriptedNode *node)
{
    node->table = table();
    node->onlyListen();
    node->inputs.clear();
    for (int i = 0; i < Signals; ++i)
        node->inputs << QStringLiteral("signal_%1").arg(i);
}

const QJsonObject longWish{{"values", QJsonObject{{"nothing", QString(Long, 'x')}}}};

struct OpenSocket : QPlcMasterSocket
{
    static QTcpSocket *of(QPlcMasterSocket &socket) { return (socket.*&OpenSocket::socket)(); }
};

/// A frame of \a kind with so many bytes that are no JSON.
QByteArray longGarbage(QPlcMessage::Kind kind)
{
    QByteArray frame(4, Qt::Uninitialized);
    qplc::storeLittle(quint32(1 + Long), frame.data());
    return frame + char(kind) + QByteArray(Long, 'x');
}

}  // namespace

// A long message is read on another thread, while the event loop of a master serves everybody else.
class tst_LongReads : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void othersAreServedMeanwhile();
    void laterMessagesOfTheConnectionWait();
    void stopBehindALongMessageDoesNotWait();
    void whatWasReadForSomebodyGoneIsDropped();
    void masterThatEndsMeanwhileLeavesNothing();
    void whoMayNotSendItIsRefusedBeforeItIsRead();
    void longGarbageEndsItsConnection();
    void nodeWithManySignalsRegisters();
    void manySignalsAreComparedWithTheTableMeanwhile();
    void nodeWithMoreSignalsThanTheTableIsRefused();
    void registrationWithManyUnknownFieldsIsRefused();

private:
    SecurityFiles m_files;
    QScopedPointer<TestMaster> m_master;
    std::unique_ptr<ScriptedTool> m_sender, m_other;
};

void tst_LongReads::init()
{
    m_sender = std::make_unique<ScriptedTool>(QStringLiteral("sender"));
    m_other = std::make_unique<ScriptedTool>(QStringLiteral("other"));
    m_master.reset(new TestMaster(QPlcClock::realTime(), table()));
    QVERIFY(m_master->listen());
    QVERIFY(m_sender->greetAt(m_master->serverPort()));
    QVERIFY(m_other->greetAt(m_master->serverPort()));
}

void tst_LongReads::othersAreServedMeanwhile()
{
    ReaderHeld held(*m_master);
    m_sender->forgetMessages();
    m_sender->send(QPlcMessage::SetSignals, longWish);
    for (int i = 0; i < 20; ++i)
        QCOMPARE(m_other->ask(QPlcMessage::GetState).kind(), QPlcMessage::State);
    QVERIFY(m_sender->messages.isEmpty());
    held.letGo();
    const QPlcMessage answer = m_sender->next();
    QCOMPARE(answer.kind(), QPlcMessage::Failed);
    QCOMPARE(answer.text("error"), QString("UnknownSignal"));
}

void tst_LongReads::laterMessagesOfTheConnectionWait()
{
    ReaderHeld held(*m_master);
    m_sender->forgetMessages();
    m_sender->send(QPlcMessage::SetSignals, longWish);
    m_sender->send(QPlcMessage::GetState);
    QCOMPARE(m_other->ask(QPlcMessage::GetState).kind(), QPlcMessage::State);
    QVERIFY(m_sender->messages.isEmpty());
    held.letGo();
    QCOMPARE(m_sender->next().kind(), QPlcMessage::Failed);
    QCOMPARE(m_sender->next().kind(), QPlcMessage::State);
}

void tst_LongReads::stopBehindALongMessageDoesNotWait()
{
    QVERIFY(m_master->startRealTime());
    QVERIFY(m_master->waitForState(QPlcMasterNode::RealTime));
    QVERIFY(m_sender->waitForMessage(QPlcMessage::StatesInitialized));
    ReaderHeld held(*m_master);
    m_sender->forgetMessages();
    m_sender->send(QPlcMessage::SetSignals, longWish);
    m_sender->send(QPlcMessage::Stop);
    QVERIFY(m_master->waitForState(QPlcMasterNode::Off));
    QVERIFY(m_sender->messages.isEmpty());
    held.letGo();
    const QPlcMessage answer = m_sender->next();
    QCOMPARE(answer.kind(), QPlcMessage::Failed);
    QCOMPARE(answer.text("error"), QString("WrongState"));  // it was overtaken by a stop
    QCOMPARE(m_sender->next().kind(), QPlcMessage::Done);
}

void tst_LongReads::whatWasReadForSomebodyGoneIsDropped()
{
    ReaderHeld held(*m_master);
    m_sender->send(QPlcMessage::SetSignals, longWish);
    QCOMPARE(m_other->ask(QPlcMessage::GetState).kind(), QPlcMessage::State);
    m_sender.reset();
    const qplc::MasterServer &server = QPlcMasterNodePrivate::of(*m_master).parts->server;
    QVERIFY(waitUntil([&] { return server.connections().size() == 1; }));
    held.letGo();
    m_other->send(QPlcMessage::SetSignals, longWish);  // read behind the other one
    QCOMPARE(m_other->next().kind(), QPlcMessage::Failed);
}

void tst_LongReads::masterThatEndsMeanwhileLeavesNothing()
{
    std::thread late;
    {
        auto held = std::make_shared<ReaderHeld>(*m_master);
        m_sender->send(QPlcMessage::SetSignals, longWish);
        QCOMPARE(m_other->ask(QPlcMessage::GetState).kind(), QPlcMessage::State);
        late = std::thread([held = std::move(held)] { held->letGo(); });
        m_master.reset();
    }
    late.join();
    QVERIFY(waitUntil([&] { return !m_sender->control.isConnected(); }));
}

void tst_LongReads::whoMayNotSendItIsRefusedBeforeItIsRead()
{
    m_master.reset(new TestMaster(QPlcClock::realTime(), table()));
    m_master->setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
    QVERIFY(m_master->listen());
    SecuredTool observer(m_files.bert());
    QVERIFY(observer.greetAt(m_master->serverPort()));
    const ReaderHeld held(*m_master);
    OpenSocket::of(observer.control)->write(longGarbage(QPlcMessage::SetSignals));
    const QPlcMessage answer = observer.next();
    QCOMPARE(answer.kind(), QPlcMessage::Failed);
    QCOMPARE(answer.text("error"), QString("Denied"));
    QCOMPARE(observer.ask(QPlcMessage::GetState).kind(), QPlcMessage::State);
}

void tst_LongReads::longGarbageEndsItsConnection()
{
    OpenSocket::of(m_sender->control)->write(longGarbage(QPlcMessage::Register));
    const QPlcMessage answer = m_sender->next();
    QCOMPARE(answer.kind(), QPlcMessage::Rejected);
    QCOMPARE(answer.text("error"), QString("MalformedMessage"));
    QVERIFY2(answer.text("text").contains("control frame (Register) at byte"), qPrintable(answer.text("text")));
    QVERIFY(waitUntil([&] { return !m_sender->control.isConnected(); }));
}

void tst_LongReads::nodeWithManySignalsRegisters()
{
    ScriptedNode node("Counter");
    listenToAll(&node);
    QVERIFY(QJsonDocument(node.registerFields()).toJson(QJsonDocument::Compact).size()
            > int(qplc::ControlFrameReader::ReadAtOnce));
    QVERIFY(node.registerAt(m_master->serverPort()));
    QCOMPARE(m_master->nodes().size(), 1);
}

void tst_LongReads::manySignalsAreComparedWithTheTableMeanwhile()
{
    ScriptedNode node("Counter");
    listenToAll(&node);
    QVERIFY(node.connectTo(m_master->serverPort()));
    node.send(QPlcMessage::Hello, node.helloFields());
    QCOMPARE(node.next().kind(), QPlcMessage::Hello);
    const qplc::MasterServer &server = QPlcMasterNodePrivate::of(*m_master).parts->server;
    const qplc::MasterConnection *connection = server.connections().back().get();
    ReaderHeld heldBefore(*m_master);
    node.send(QPlcMessage::Register, node.registerFields());
    QVERIFY(waitUntil([&] { return connection->longRead != nullptr; }));
    ReaderHeld heldBehind(*m_master);
    heldBefore.letGo();
    QVERIFY(waitUntil([&] { return !connection->cyclicKind.isEmpty(); }));  // it is read, and its rights are checked
    for (int i = 0; i < 5; ++i)
        QCOMPARE(m_other->ask(QPlcMessage::GetState).kind(), QPlcMessage::State);
    QVERIFY(!connection->isNode());
    heldBehind.letGo();
    QVERIFY(node.waitForMessage(QPlcMessage::Registered));
}

void tst_LongReads::nodeWithMoreSignalsThanTheTableIsRefused()
{
    QJsonArray inputs;
    for (int i = 0; i <= Signals; ++i)
        inputs << QJsonObject{{"name", "signal_1"}, {"type", "Real64"}, {"unit", ""}, {"padding", QString(70, 'x')}};
    m_sender->send(QPlcMessage::Register,
                   {{"name", "sender"},
                    {"policy", "ErrorZeroOrderHold"},
                    {"inputs", inputs},
                    {"outputs", QJsonArray()},
                    {"cyclic", "tcp"}});
    const QPlcMessage answer = m_sender->next();
    QCOMPARE(answer.text("error"), QString("MalformedMessage"));
    QVERIFY2(answer.text("text").contains("declares 2001 inputs and 0 outputs, and the table has 2000"),
             qPrintable(answer.text("text")));
}

/// They would stay in memory as long as the node does.
void tst_LongReads::registrationWithManyUnknownFieldsIsRefused()
{
    QJsonObject fields{{"name", "sender"},
                       {"policy", "ErrorZeroOrderHold"},
                       {"inputs", QJsonArray()},
                       {"outputs", QJsonArray()},
                       {"cyclic", "tcp"}};
    for (int i = 0; i <= qplc::messages::Register::mostOthers; ++i)
        fields.insert(QStringLiteral("field %1").arg(i), 0);
    m_sender->send(QPlcMessage::Register, fields);
    const QPlcMessage answer = m_sender->next();
    QCOMPARE(answer.text("error"), QString("MalformedMessage"));
    QVERIFY2(answer.text("text").contains("65 fields that this master does not know"), qPrintable(answer.text("text")));
}

QTEST_GUILESS_MAIN(tst_LongReads)
#include "tst_LongReads.moc"
