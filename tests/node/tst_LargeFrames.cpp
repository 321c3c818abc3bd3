// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "NodeFixtures.h"
#include "protocol/CyclicFrame.h"
#include "signals/PayloadLayout.h"

// Inputs and outputs of more bytes than one frame holds; texts and arrays among them.
class tst_LargeFrames : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void cleanup() { QPlcSignalIndexTable::setCurrent({}); }
    void textsAndArraysTravelUnchanged_data();
    void textsAndArraysTravelUnchanged();
    void payloadsAroundTheFrameLimitTravelUnchanged_data();
    void payloadsAroundTheFrameLimitTravelUnchanged();
    void payloadsOfManyFramesTravelThroughSharedMemory_data();
    void payloadsOfManyFramesTravelThroughSharedMemory();
};

namespace {

constexpr int Count = 4;       // texts, and as many arrays
constexpr int Elements = 150;  // of an array
constexpr quint64 Cycles = 300;

/// Signals "text0" ..., "array0" ... and the copies "textCopy0" ..., "arrayCopy0" ...
QPlcSignalTable largeTable()
{
    QByteArray ini;
    for (const char *suffix : {"", "Copy"}) {
        for (int i = 0; i < Count; ++i) {
            const QByteArray number = suffix + QByteArray::number(i);
            ini += "[text" + number + "]\ntype = String(900)\n[array" + number + "]\ntype = Real64[150]\n";
        }
    }
    return QPlcSignalTable::fromIni(ini);
}

/// What text \a i is in cycle \a cycle: from nothing to 897 bytes, one to four for each character.
QString textOf(int i, quint64 cycle)
{
    return QString::fromUtf8("a\u00e4\u20ac\U0001f600xyz").repeated(int((cycle * 7 + quint64(i) * 11) % 70));
}

std::array<double, Elements> arrayOf(int i, quint64 cycle)
{
    std::array<double, Elements> values{};
    for (std::size_t j = 0; j < values.size(); ++j)
        values[j] = double(cycle) + 1000.0 * i + 1e-3 * double(j);
    return values;
}

/// Compact signals for all texts and arrays; \a suffix  "" or "Copy".
struct LargePorts
{
    LargePorts(QPlcCompactSlaveNode *node, QPlcPort::Direction direction, const QByteArray &suffix)
    {
        for (int i = 0; i < Count; ++i) {
            const QByteArray number = suffix + QByteArray::number(i);
            texts.push_back(std::make_unique<QPlcCompactSignal>(("text" + number).constData(), direction, node));
            arrays.push_back(std::make_unique<QPlcCompactSignal>(("array" + number).constData(), direction, node));
        }
    }
    void set(quint64 cycle)
    {
        for (int i = 0; i < Count; ++i) {
            *texts[std::size_t(i)] = QPlcValue(textOf(i, cycle));
            *arrays[std::size_t(i)] = QPlcValue(arrayOf(i, cycle));
        }
    }
    bool are(quint64 cycle) const
    {
        for (int i = 0; i < Count; ++i) {
            if (texts[std::size_t(i)]->value().toString() != textOf(i, cycle)
                || arrays[std::size_t(i)]->value() != QPlcValue(arrayOf(i, cycle)))
                return false;
        }
        return true;
    }
    std::vector<std::unique_ptr<QPlcCompactSignal>> texts;
    std::vector<std::unique_ptr<QPlcCompactSignal>> arrays;
};

/// Writes what belongs to the next cycle.
class Writer : public QPlcCompactSlaveNode
{
public:
    Writer()
        : QPlcCompactSlaveNode("Writer")
    {
    }
    void reset() override { m_outputs.set(0); }
    void step(const QPlcCycle &cycle) override { m_outputs.set(cycle.number() + 1); }

private:
    LargePorts m_outputs{this, QPlcPort::Output, ""};
};

/// Compares its inputs with what they should be, and gives them back.
class Copier : public QPlcCompactSlaveNode
{
public:
    Copier()
        : QPlcCompactSlaveNode("Copier")
    {
    }
    quint64 good = 0;
    void step(const QPlcCycle &cycle) override
    {
        good += m_inputs.are(cycle.number());
        for (std::size_t i = 0; i < Count; ++i) {
            *m_outputs.texts[i] = m_inputs.texts[i]->value();
            *m_outputs.arrays[i] = m_inputs.arrays[i]->value();
        }
    }

private:
    LargePorts m_inputs{this, QPlcPort::Input, ""};
    LargePorts m_outputs{this, QPlcPort::Output, "Copy"};
};

}  // namespace

void tst_LargeFrames::textsAndArraysTravelUnchanged_data()
{
    QTest::addColumn<QString>("writerKind");
    QTest::addColumn<QString>("copierKind");
    QTest::newRow("in process") << "local"
                                << "local";
    QTest::newRow("udp") << "udp"
                         << "udp";
    QTest::newRow("tcp") << "tcp"
                         << "tcp";
    QTest::newRow("udp to tcp") << "udp"
                                << "tcp";
    QTest::newRow("in process to udp") << "local"
                                       << "udp";
}

void tst_LargeFrames::textsAndArraysTravelUnchanged()
{
    QFETCH(QString, writerKind);
    QFETCH(QString, copierKind);
    static QSet<quint64> digests;  // of all rows
    TestMaster master(QPlcClock::lockstep(), largeTable());
    master.setCycleLimit(Cycles);
    QVERIFY(master.listen());
    Writer writer;
    Copier copier;
    QVERIFY2(master.admit(writer, writerKind), qPrintable(master.errorString() + writer.errorString()));
    QVERIFY2(master.admit(copier, copierKind), qPrintable(master.errorString() + copier.errorString()));
    QVERIFY2(master.startRealTime(), qPrintable(master.errorString()));
    QVERIFY(waitUntil([&] { return master.statistics().cycles == Cycles && master.state() == QPlcMasterNode::Off; },
                      30000));
    writer.disconnectFromMaster();
    copier.disconnectFromMaster();
    QCOMPARE(copier.good, Cycles);
    for (int i = 0; i < Count; ++i) {
        QCOMPARE(master.signalValue(QString("textCopy%1").arg(i)).toString(), textOf(i, Cycles - 1));
        QCOMPARE(master.signalValue(QString("arrayCopy%1").arg(i)), QPlcValue(arrayOf(i, Cycles - 1)));
    }
    digests << master.statistics().imageDigest;
    QCOMPARE(digests.size(), 1);  // bit by bit the same on every way
}

void tst_LargeFrames::payloadsAroundTheFrameLimitTravelUnchanged_data()
{
    QTest::addColumn<int>("second");  // [byte] of the second signal; the first one has 1440
    QTest::addColumn<int>("third");   // [byte]
    QTest::addColumn<int>("parts");
    QTest::newRow("1455 bytes") << 8 << 7 << 1;
    QTest::newRow("1456 bytes") << 8 << 8 << 1;
    QTest::newRow("1457 bytes") << 8 << 9 << 2;
    QTest::newRow("1440 and 1456 bytes") << 16 << 1440 << 2;
    QTest::newRow("1440, 1440 and 17 bytes") << 1440 << 17 << 3;
}

void tst_LargeFrames::payloadsAroundTheFrameLimitTravelUnchanged()
{
    QFETCH(int, second);
    QFETCH(int, third);
    QFETCH(int, parts);
    class Through : public QPlcCompactSlaveNode
    {
    public:
        Through()
            : QPlcCompactSlaveNode("Through")
        {
        }
        void step(const QPlcCycle &) override
        {
            m_a = m_inA;
            m_b = m_inB;
            m_c = m_inC;
        }
        QPlcCompactSignal m_inA = QPlcCompactSignal("in0", QPlcPort::Input, this);
        QPlcCompactSignal m_inB = QPlcCompactSignal("in1", QPlcPort::Input, this);
        QPlcCompactSignal m_inC = QPlcCompactSignal("in2", QPlcPort::Input, this);
        QPlcCompactSignal m_a = QPlcCompactSignal("out0", QPlcPort::Output, this);
        QPlcCompactSignal m_b = QPlcCompactSignal("out1", QPlcPort::Output, this);
        QPlcCompactSignal m_c = QPlcCompactSignal("out2", QPlcPort::Output, this);
    };
    const int sizes[3] = {1440, second, third};
    QByteArray ini;
    for (const char *direction : {"in", "out"}) {
        for (int i = 0; i < 3; ++i)
            ini += "[" + QByteArray(direction) + QByteArray::number(i) + "]\ntype = Int8["
                + QByteArray::number(sizes[i]) + "]\n";
    }
    const QPlcSignalTable table = QPlcSignalTable::fromIni(ini);
    QCOMPARE(int(qplc::PayloadLayout(table, {0, 1, 2}).partBorders(qplc::MaximumCyclicPayload).size()), parts + 1);
    for (const QString kind : {"udp", "tcp"}) {
        TestMaster master(QPlcClock::lockstep(), table);
        master.setCycleLimit(20);
        QVERIFY(master.listen());
        Through node;
        QVERIFY2(master.admit(node, kind), qPrintable(node.errorString()));
        for (int i = 0; i < 3; ++i) {
            QByteArray bytes(sizes[i], '\0');
            for (int j = 0; j < bytes.size(); ++j)
                bytes[j] = char(31 * j + i);
            QVERIFY(master.setSignalValue(QString("in%1").arg(i),
                                          QPlcValue::fromBytes(table.at(QPlcSignalIndex(i)).type, bytes)));
        }
        QVERIFY(master.startRealTime());
        QVERIFY(waitUntil([&] { return master.statistics().cycles == 20 && master.state() == QPlcMasterNode::Off; },
                          10000));
        node.disconnectFromMaster();
        for (int i = 0; i < 3; ++i)
            QCOMPARE(master.signalValue(QString("out%1").arg(i)).toBytes(),
                     master.signalValue(QString("in%1").arg(i)).toBytes());
        QPlcSignalIndexTable::setCurrent({});
    }
}

void tst_LargeFrames::payloadsOfManyFramesTravelThroughSharedMemory_data()
{
    QTest::addColumn<int>("bytes");
    QTest::newRow("45 kB") << 45'000;
    QTest::newRow("64 kB") << 64'000;
    QTest::newRow("all that the messages of an initialization hold") << 786'240;
}

void tst_LargeFrames::payloadsOfManyFramesTravelThroughSharedMemory()
{
    QFETCH(int, bytes);
    const int count = (bytes + 1439) / 1440;
    QByteArray ini;
    for (const char *direction : {"in", "out"}) {
        for (int i = 0; i < count; ++i)
            ini += "[" + QByteArray(direction) + QByteArray::number(i) + "]\ntype = Int8["
                + QByteArray::number(qMin(1440, bytes - 1440 * i)) + "]\n";
    }
    class Through : public QPlcCompactSlaveNode
    {
    public:
        explicit Through(int count)
            : QPlcCompactSlaveNode("Through")
        {
            for (int i = 0; i < count; ++i) {
                const QByteArray number = QByteArray::number(i);
                m_in.push_back(std::make_unique<QPlcCompactSignal>(("in" + number).constData(), QPlcPort::Input, this));
                m_out.push_back(
                    std::make_unique<QPlcCompactSignal>(("out" + number).constData(), QPlcPort::Output, this));
            }
        }
        void step(const QPlcCycle &) override
        {
            for (std::size_t i = 0; i < m_in.size(); ++i)
                *m_out[i] = m_in[i]->value();
        }

    private:
        std::vector<std::unique_ptr<QPlcCompactSignal>> m_in;
        std::vector<std::unique_ptr<QPlcCompactSignal>> m_out;
    };
    const QPlcSignalTable table = QPlcSignalTable::fromIni(ini);
    TestMaster master(QPlcClock::lockstep(), table);
    master.setCycleLimit(20);
    QVERIFY(master.listen());
    QPlcSignalIndexTable::setCurrent(table);
    Through node(count);
    QVERIFY2(
        node.connectToMasterAndWaitForConnected(QPlcUnderlyingProtocol::local(QString::number(master.serverPort()))),
        qPrintable(node.errorString()));
    for (int i = 0; i < count; ++i) {
        QByteArray value(qMin(1440, bytes - 1440 * i), char(i));
        value[0] = char(i / 256 + 1);
        QVERIFY(master.setSignalValue(QString("in%1").arg(i),
                                      QPlcValue::fromBytes(table.at(QPlcSignalIndex(i)).type, value)));
    }
    QVERIFY2(master.startRealTime(), qPrintable(master.errorString()));
    QVERIFY(
        waitUntil([&] { return master.statistics().cycles == 20 && master.state() == QPlcMasterNode::Off; }, 60'000));
    node.disconnectFromMaster();
    for (int i = 0; i < count; ++i)
        QCOMPARE(master.signalValue(QString("out%1").arg(i)).toBytes(),
                 master.signalValue(QString("in%1").arg(i)).toBytes());
}

QTEST_GUILESS_MAIN(tst_LargeFrames)
#include "tst_LargeFrames.moc"
