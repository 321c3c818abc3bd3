// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedMaster.h"
#include "SecurityFixtures.h"
#include "WireTap.h"

#include <random>

// Cycles over a network on which others listen, change, repeat and forge: a real master and real
// nodes with pre-shared keys on loopback.
class tst_SealedCycles : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void noNonceServesTwoFrames();
    void securedNodeRefusesRegistrationWithoutFrameKeys_data();
    void securedNodeRefusesRegistrationWithoutFrameKeys();
    void aSecuredNodeComputesNoFrameThatIsNotSealed();
    void valuesAreNotSeenOnTheWire_data();
    void valuesAreNotSeenOnTheWire();
    void sharedMemoryIsNotSealed();
    void everyChangedFrameIsCountedAndDropped_data();
    void everyChangedFrameIsCountedAndDropped();
    void repeatedFramesAreDroppedAsOld();
    void framesOfTheLastRegistrationAreForged();
    void framesOfAnotherNodeOrDirectionAreForged();
    void forgedFramesAreReportedOnce();
    void keysAreNotLogged();

private:
    static QByteArray bytesOf(double value) { return QByteArray(reinterpret_cast<const char *>(&value), sizeof value); }
    SecurityFiles m_files;
};

static const double Secret = 1.234567890123456;

// 3 parts of inputs, 3 of outputs when sealed.
static const QByteArray WideTable = "[a]\ntype = Real64[150]\n[b]\ntype = Real64[150]\n[c]\ntype = Real64[150]\n"
                                    "[d]\ntype = Real64[150]\n[e]\ntype = Real64[150]\n[f]\ntype = Real64[150]\n";

/// Its output is its input, and 1.
class Mirror : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    explicit Mirror(const QString &name, const char *input = "setpoint", const char *output = "echo")
        : QPlcCompactSlaveNode(name)
        , m_in(this, input)
        , m_out(this, output)
    {
    }
    ~Mirror() override { disconnectFromMaster(); }  // what is still queued is not computed any more

protected:
    void step(const QPlcCycle &) override { m_out = m_in + 1.0; }

private:
    QPlcInput<double> m_in;
    QPlcOutput<double> m_out;
};

class Wide : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    Wide()
        : QPlcCompactSlaveNode(QStringLiteral("Wide"))
    {
    }
    ~Wide() override { disconnectFromMaster(); }

protected:
    void step(const QPlcCycle &) override { m_d = m_a; }

private:
    using Values = std::array<double, 150>;
    QPlcInput<Values> m_a{this, "a"}, m_b{this, "b"}, m_c{this, "c"};
    QPlcOutput<Values> m_d{this, "d"}, m_e{this, "e"}, m_f{this, "f"};
};

/// A master with the keys of the nodes Mirror, Stream, Wide and Lossy.
class SecuredMaster : public TestMaster
{
    Q_OBJECT
public:
    explicit SecuredMaster(const SecurityFiles &files)
        : TestMaster(QPlcClock::realTime(), QPlcSignalTable::fromIni(testTable().toIni() + WideTable))
    {
        QByteArray keys;
        for (const char *name : {"Mirror", "Stream", "Wide", "Lossy"})
            keys += SecurityFiles::section(name, keyOf(name), "Node");
        setSecurity(QPlcSecurity::preSharedKeys(files.write("plant.ini", keys)));
        setInterval(std::chrono::milliseconds(5));
    }
    static QByteArray keyOf(const QString &name) { return SecurityFiles::key(name.toLower().at(0) == 'm' ? 'a' : 'b'); }
    static QPlcSecurity securityOf(const SecurityFiles &files, const QString &name)
    {
        return QPlcSecurity::preSharedKeys(
            files.write(name + ".ini", SecurityFiles::section(name.toUtf8(), keyOf(name), "Node")), name);
    }
    bool admitSecured(const SecurityFiles &files, QPlcSlaveNode &node, const QString &kind)
    {
        node.setSecurity(securityOf(files, node.name()));
        return admit(node, kind);
    }
    bool fly(quint64 cycles)
    {
        return (isArmingRequired() ? startArmed() : startRealTime()) && waitForState(RealTime) && waitForCycles(cycles);
    }
    QPlcNodeInfo infoOf(const QString &name) const
    {
        for (const QPlcNodeInfo &info : nodes()) {
            if (info.name == name)
                return info;
        }
        return {};
    }
};

static bool isOutputs(const wire::Sent &frame)
{
    return frame.bytes.size() > 12 && frame.bytes.at(0) == 0x22;
}

static bool isInputs(const wire::Sent &frame)
{
    return frame.bytes.size() > 12 && frame.bytes.at(0) == 0x21;
}

// ---- nonces ----

/// Answers after some requests were lost: the master sends them again, and the node its answers.
static void playLossy(ScriptedNode *node, const SecurityFiles &files)
{
    node->name = QStringLiteral("Lossy");
    node->policy = QStringLiteral("SilentWait");
    node->inputs = QStringList{QStringLiteral("free")};
    node->outputs = QStringList{QStringLiteral("sum")};
    node->control.setSecurity(SecuredMaster::securityOf(files, node->name));
    auto random = std::make_shared<std::mt19937>(7);
    auto sent = std::make_shared<QHash<quint64, QVector<QByteArray>>>();
    node->onRequest = [=](const ScriptedNode::Request &request) {
        if ((*random)() % 4 == 0)
            return;  // as if it was lost
        if (!sent->contains(request.cycle))
            sent->insert(request.cycle, node->answerFrames(request.cycle, QByteArray(8, '\0')));
        for (const QByteArray &frame : qAsConst((*sent)[request.cycle]))
            node->sendFrame(frame);
    };
}

void tst_SealedCycles::noNonceServesTwoFrames()
{
    wire::resetSeals();
    int registrations = 0;
    quint64 resent = 0;
    for (int restart = 0; restart < 2; ++restart) {
        SecuredMaster master(m_files);
        QVERIFY(master.listen());
        Mirror mirror("Mirror");
        Mirror stream("Stream", "echo", "masterWorkload");
        Wide wide;
        ScriptedNode lossy;
        playLossy(&lossy, m_files);
        QVERIFY(master.admitSecured(m_files, mirror, "udp"));
        QVERIFY(master.admitSecured(m_files, stream, "tcp"));
        QVERIFY(master.admitSecured(m_files, wide, "udp"));
        QVERIFY(lossy.registerAt(master.serverPort()));
        registrations += 4;
        for (int phase = 0; phase < 3; ++phase) {
            QVERIFY(master.fly(15));
            mirror.disconnectFromMaster();
            QTRY_VERIFY(master.infoOf("Mirror").name.isEmpty());
            QVERIFY(master.admitSecured(m_files, mirror, "udp"));  // while the others run
            ++registrations;
            QVERIFY(master.waitForCycles(30));
            master.stop();
            resent += master.infoOf("Lossy").resent;
            QCOMPARE(master.infoOf("Wide").forged + master.infoOf("Stream").forged + master.infoOf("Mirror").forged,
                     quint64(0));
        }
    }
    const wire::Seals seals = wire::seals();
    QCOMPARE(seals.conflicts, quint64(0));
    QCOMPARE(seals.repeated, quint64(0));  // what is sent again was kept
    QCOMPARE(seals.keys, 2 * registrations);
    QVERIFY2(seals.frames > 1000, qPrintable(QString::number(seals.frames)));
    QVERIFY(resent > 10);
}

// ---- a master that does not seal ----

/// Greets \a node over TLS as its master. \return what the master says to its registration, without
/// `seal`
static QJsonObject greetSecured(ScriptedMaster &master, const SecurityFiles &files, QPlcSlaveNode &node)
{
    master.setSecurity(QPlcSecurity::preSharedKeys(files.write(
        "plant.ini", SecurityFiles::section(node.name().toUtf8(), SecuredMaster::keyOf(node.name()), "Node"))));
    node.setSecurity(SecuredMaster::securityOf(files, node.name()));
    node.connectToMaster(master.udp());
    if (master.next().kind() != QPlcMessage::Hello)
        return {};
    master.send(QPlcMessage::Hello, master.helloFields());
    return master.registeredFields(master.next());
}

void tst_SealedCycles::securedNodeRefusesRegistrationWithoutFrameKeys_data()
{
    QTest::addColumn<QJsonValue>("seal");
    QTest::addColumn<QString>("words");
    const QString none = "gives node 'Mirror' no keys for its frames";
    const QString unusable = "field 'seal'";
    const QString key = QPlcMessage::fromBytes(QByteArray(32, 'k'));
    const QString shorter = QPlcMessage::fromBytes(QByteArray(31, 'k'));
    QTest::newRow("no field") << QJsonValue(QJsonValue::Undefined) << none;
    QTest::newRow("false") << QJsonValue(false) << unusable;
    QTest::newRow("null") << QJsonValue(QJsonValue::Null) << unusable;
    QTest::newRow("empty") << QJsonValue(QJsonObject()) << unusable;
    QTest::newRow("one direction") << QJsonValue(QJsonObject{{"inputs", key}}) << unusable;
    QTest::newRow("too short") << QJsonValue(QJsonObject{{"inputs", key}, {"outputs", shorter}}) << none;
    QTest::newRow("no text") << QJsonValue(QJsonObject{{"inputs", key}, {"outputs", 7}}) << unusable;
}

void tst_SealedCycles::securedNodeRefusesRegistrationWithoutFrameKeys()
{
    QFETCH(QJsonValue, seal);
    QFETCH(QString, words);
    ScriptedMaster master;
    Mirror mirror("Mirror");
    QJsonObject fields = greetSecured(master, m_files, mirror);
    QVERIFY(!fields.isEmpty());
    fields.insert("seal", seal);
    master.send(QPlcMessage::Registered, fields);
    master.send(QPlcMessage::CyclicChannelAttached);
    QTRY_COMPARE(mirror.error(), QPlcSlaveNode::ProtocolError);
    QCOMPARE(mirror.state(), QPlcSlaveNode::Rejected);
    QVERIFY2(mirror.errorString().contains(words), qPrintable(mirror.errorString()));
}

void tst_SealedCycles::aSecuredNodeComputesNoFrameThatIsNotSealed()
{
    ScriptedMaster master;
    Mirror mirror("Mirror");
    QJsonObject fields = greetSecured(master, m_files, mirror);
    const QString key = QPlcMessage::fromBytes(QByteArray(32, 'k'));
    fields.insert("seal", QJsonObject{{"inputs", key}, {"outputs", key}});
    master.send(QPlcMessage::Registered, fields);
    master.send(QPlcMessage::CyclicChannelAttached);
    QTRY_COMPARE(mirror.state(), QPlcSlaveNode::Registered);
    QVERIFY(master.start());
    master.request(0);  // in clear, and else as it should be
    QByteArray asLongAsSealed = master.requestFrames(1, QByteArray(8, '\0')).first() + QByteArray(12, '\0');
    master.sendFrame(asLongAsSealed);
    QTRY_COMPARE(mirror.counters().rejected + mirror.counters().forged, quint64(2));
    QCOMPARE(mirror.counters().cycles, quint64(0));
    mirror.disconnectFromMaster();
}

// ---- what others see ----

void tst_SealedCycles::valuesAreNotSeenOnTheWire_data()
{
    QTest::addColumn<QString>("kind");
    QTest::addColumn<bool>("isSecured");
    for (const char *kind : {"udp", "tcp"}) {
        QTest::addRow("%s, sealed", kind) << kind << true;
        QTest::addRow("%s, plain: the tap works", kind) << kind << false;
    }
}

void tst_SealedCycles::valuesAreNotSeenOnTheWire()
{
    QFETCH(QString, kind);
    QFETCH(bool, isSecured);
    SecuredMaster master(m_files);
    if (!isSecured)
        master.setSecurity(QPlcSecurity());
    QVERIFY(master.listen());
    Mirror mirror("Mirror");
    QVERIFY(isSecured ? master.admitSecured(m_files, mirror, kind) : master.admit(mirror, kind));
    QVERIFY(master.setSignalValue("setpoint", Secret));
    wire::listen();
    QVERIFY(master.fly(20));
    QTRY_COMPARE(master.signalValue("echo").toReal(), Secret + 1.0);
    master.stop();
    const QVector<wire::Sent> inputs = wire::heard(isInputs);
    const QVector<wire::Sent> outputs = wire::heard(isOutputs);
    QVERIFY(inputs.size() >= 20);
    QVERIFY(!outputs.isEmpty());
    QCOMPARE(inputs.first().bytes.size(), int(8 + (isSecured ? qplc::SealedOverhead : qplc::CyclicOverhead)));
    for (const wire::Sent &frame : inputs)
        QCOMPARE(frame.bytes.contains(bytesOf(Secret)), !isSecured);
    const auto showsEcho = [](const wire::Sent &f) { return f.bytes.contains(bytesOf(Secret + 1.0)); };
    QCOMPARE(std::any_of(outputs.begin(), outputs.end(), showsEcho), !isSecured);
    QVERIFY(!isSecured || wire::heard(showsEcho).isEmpty());
}

void tst_SealedCycles::sharedMemoryIsNotSealed()
{
    SecuredMaster master(m_files);
    QVERIFY(master.listen());
    Mirror mirror("Mirror");
    mirror.setSecurity(SecuredMaster::securityOf(m_files, "Mirror"));
    wire::resetSeals();
    QVERIFY2(
        mirror.connectToMasterAndWaitForConnected(QPlcUnderlyingProtocol::local(QString::number(master.serverPort()))),
        qPrintable(mirror.errorString()));
    QVERIFY(master.fly(10));
    master.stop();
    QCOMPARE(wire::seals().frames, quint64(0));
}

// ---- what others send ----

void tst_SealedCycles::everyChangedFrameIsCountedAndDropped_data()
{
    QTest::addColumn<bool>("toMaster");
    QTest::newRow("to the master") << true;
    QTest::newRow("to the node") << false;
}

void tst_SealedCycles::everyChangedFrameIsCountedAndDropped()
{
    QFETCH(bool, toMaster);
    SecuredMaster master(m_files);
    QVERIFY(master.listen());
    Mirror mirror("Mirror");
    QVERIFY(master.admitSecured(m_files, mirror, "udp"));
    QVERIFY(master.setSignalValue("setpoint", Secret));
    wire::listen();
    QVERIFY(master.fly(10));
    QTRY_COMPARE(master.signalValue("echo").toReal(), Secret + 1.0);
    const wire::Sent good = wire::heard(toMaster ? isOutputs : isInputs).last();
    const auto counted = [&](quint64 QPlcNodeInfo::*atMaster, quint64 QPlcSlaveNode::Counters::*atNode) {
        return toMaster ? master.infoOf("Mirror").*atMaster : mirror.counters().*atNode;
    };
    const auto forgedSoFar = [&] { return counted(&QPlcNodeInfo::forged, &QPlcSlaveNode::Counters::forged); };
    const auto rejectedSoFar = [&] { return counted(&QPlcNodeInfo::rejected, &QPlcSlaveNode::Counters::rejected); };
    const int size = 8 + int(qplc::SealedOverhead);
    QCOMPARE(good.bytes.size(), size);

    quint64 rejected = 0;
    quint64 forged = 0;
    for (int bit = 0; bit < size * 8; ++bit) {
        QByteArray changed = good.bytes;
        changed[bit / 8] = char(changed.at(bit / 8) ^ (1 << bit % 8));
        wire::forge(good, changed);
        const bool isOfFirstChecks = bit < 8 || bit == 15 || (bit >= 16 && bit < 32);  // kind, Part, session
        ++(isOfFirstChecks ? rejected : forged);
        if (bit % 32 == 31)
            QTRY_COMPARE(forgedSoFar(), forged);  // before the queue of the receiver is full
    }
    for (const QByteArray &garbage :
         {QByteArray(), good.bytes.left(size - 1), good.bytes + 'x', QByteArray(size, 'x')}) {
        wire::forge(good, garbage);
        ++rejected;
    }
    QTRY_COMPARE(rejectedSoFar(), rejected);
    QCOMPARE(forgedSoFar(), forged);
    QCOMPARE(forged, quint64(size * 8 - 25));
    QCOMPARE(master.signalValue("echo").toReal(), Secret + 1.0);
    QVERIFY(master.waitForCycles(master.statistics().cycles + 5));
    master.stop();
}

void tst_SealedCycles::repeatedFramesAreDroppedAsOld()
{
    SecuredMaster master(m_files);
    QVERIFY(master.listen());
    Mirror mirror("Mirror");
    QVERIFY(master.admitSecured(m_files, mirror, "udp"));
    wire::listen();
    QVERIFY(master.setSignalValue("setpoint", 5.0));
    QVERIFY(master.fly(10));
    QTRY_VERIFY(wire::heard(isOutputs).size() >= 8);
    QVERIFY(master.setSignalValue("setpoint", Secret));
    QTRY_COMPARE(master.signalValue("echo").toReal(), Secret + 1.0);
    const QVector<wire::Sent> outputs = wire::heard(isOutputs).mid(0, 8);
    const QVector<wire::Sent> inputs = wire::heard(isInputs).mid(0, 8);
    for (int phase = 0; phase < 2; ++phase) {
        const quint64 duplicates = master.infoOf("Mirror").duplicates;
        const quint64 outdated = mirror.counters().outdated + mirror.counters().duplicated;
        for (const wire::Sent &frame : outputs + inputs)
            wire::forge(frame, frame.bytes);
        QTRY_COMPARE(master.infoOf("Mirror").duplicates, duplicates + 8);
        QTRY_COMPARE(mirror.counters().outdated + mirror.counters().duplicated, outdated + 8);
        QCOMPARE(master.infoOf("Mirror").forged + mirror.counters().forged, quint64(0));
        QCOMPARE(master.signalValue("echo").toReal(), Secret + 1.0);
        master.stop();
        QVERIFY(master.fly(5));  // a new phase of the same registration
    }
    master.stop();
}

void tst_SealedCycles::framesOfTheLastRegistrationAreForged()
{
    SecuredMaster master(m_files);
    QVERIFY(master.listen());
    Mirror mirror("Mirror");
    QVERIFY(master.admitSecured(m_files, mirror, "udp"));
    wire::listen();
    QVERIFY(master.fly(10));
    QTRY_VERIFY(wire::heard(isOutputs).size() >= 8);
    const QVector<wire::Sent> old = wire::heard(isOutputs).mid(0, 8);
    master.stop();
    mirror.disconnectFromMaster();
    QTRY_VERIFY(master.nodes().isEmpty());
    QVERIFY(master.admitSecured(m_files, mirror, "udp"));
    wire::listen();
    QVERIFY(master.fly(10));
    QTRY_VERIFY(!wire::heard(isOutputs).isEmpty());
    const wire::Sent now = wire::heard(isOutputs).last();
    for (const wire::Sent &frame : old)
        wire::forge(now, frame.bytes);
    QTRY_COMPARE(master.infoOf("Mirror").forged, quint64(8));
    QCOMPARE(master.infoOf("Mirror").duplicates, quint64(0));
    master.stop();
}

void tst_SealedCycles::framesOfAnotherNodeOrDirectionAreForged()
{
    SecuredMaster master(m_files);
    QVERIFY(master.listen());
    Mirror mirror("Mirror");
    Mirror stream("Stream", "echo", "masterWorkload");  // the same sizes
    QVERIFY(master.admitSecured(m_files, mirror, "udp") && master.admitSecured(m_files, stream, "udp"));
    wire::listen();
    QVERIFY(master.fly(10));
    QTRY_VERIFY(!wire::heard(isOutputs).isEmpty());
    const QVector<wire::Sent> outputs = wire::heard(isOutputs);
    const int mirrorsSocket = outputs.last().descriptor;
    const auto isOthers = [&](const wire::Sent &f) { return isOutputs(f) && f.descriptor != mirrorsSocket; };
    QTRY_VERIFY(!wire::heard(isOthers).isEmpty());
    const wire::Sent others = wire::heard(isOthers).last();
    wire::forge(outputs.last(), others.bytes);  // the answer of one node from the address of the other
    QByteArray turned = wire::heard(isInputs).last().bytes;
    turned[0] = 0x22;
    wire::forge(outputs.last(), turned);  // a request, made to look like an answer
    const auto forged = [&] { return master.infoOf("Mirror").forged + master.infoOf("Stream").forged; };
    QTRY_COMPARE(forged(), quint64(2));
    master.stop();
}

void tst_SealedCycles::forgedFramesAreReportedOnce()
{
    LogCapture log;
    SecuredMaster master(m_files);
    QVERIFY(master.listen());
    Mirror mirror("Mirror");
    QVERIFY(master.admitSecured(m_files, mirror, "udp"));
    wire::listen();
    QVERIFY(master.fly(5));
    QTRY_VERIFY(!wire::heard(isOutputs).isEmpty());
    for (const wire::Sent &frame : {wire::heard(isOutputs).last(), wire::heard(isInputs).last()}) {
        for (int i = 0; i < 10; ++i)
            wire::forge(frame, frame.bytes.left(frame.bytes.size() - 16) + QByteArray(16, char(i)));
    }
    QTRY_COMPARE(master.infoOf("Mirror").forged, quint64(10));
    QTRY_COMPARE(mirror.counters().forged, quint64(10));
    QTRY_COMPARE(log.matching("frames from the address of node Mirror have a wrong seal").size(), 1);
    QTRY_COMPARE(log.matching("drops frames that are not as its master seals them").size(), 1);
    master.stop();
}

void tst_SealedCycles::keysAreNotLogged()
{
    QLoggingCategory::setFilterRules("qtplc.*.debug=true");
    {
        LogCapture log;
        SecuredMaster master(m_files);
        QVERIFY(master.listen());
        ScriptedNode node;
        playLossy(&node, m_files);
        QVERIFY(node.registerAt(master.serverPort()));
        const QJsonObject seal = node.registered.fields().value("seal").toObject();
        QCOMPARE(seal.size(), 2);
        QVERIFY(!log.matching("Registered").isEmpty());
        for (const QString &direction : seal.keys()) {
            const QByteArray base64 = seal.value(direction).toString().toLatin1();
            for (const QString &line : log.all()) {
                const QString bytes = QString(line).remove(' ');
                QVERIFY2(!line.contains(base64) && !bytes.contains(base64.toHex())
                             && !bytes.contains(QByteArray::fromBase64(base64).toHex()),
                         qPrintable(line));
            }
        }
    }
    QLoggingCategory::setFilterRules(QString());
}

QTEST_GUILESS_MAIN(tst_SealedCycles)
#include "tst_SealedCycles.moc"
