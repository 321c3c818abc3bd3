// SPDX-License-Identifier: Apache-2.0
#include "NodeFixtures.h"
#include "RandomNetwork.h"
#include "signals/ProcessImage.h"

#include <QtTest/QtTest>

#include <cstring>

// Random networks with same-cycle inputs and two-phase nodes: whatever the stages and the
// transport, the master computes what the definition says, bit for bit; and a node is refused when,
// and only when, it closes a loop.
class tst_RandomNetworks : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void stagedNetworkEqualsTopologicalEvaluation_data();
    void stagedNetworkEqualsTopologicalEvaluation();

private:
    static constexpr int signalCount = 30;  // the last two are of nobody
    static constexpr double initialValue = 0.5;
    static constexpr int cycles = 40;

    static std::vector<RandomNodeRule> randomRules(std::mt19937 &random, double density);
    static bool hasLoop(const std::vector<RandomNodeRule> &rules);
    static quint64 expectedDigest(const std::vector<RandomNodeRule> &rules, const QPlcSignalTable &table);
    bool join(TestMaster &master, RandomNode &node, const QString &kind);

    int m_refused = 0;
    int m_stages = 0;
    int m_mixed = 0;
};

std::vector<RandomNodeRule> tst_RandomNetworks::randomRules(std::mt19937 &random, double density)
{
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<RandomNodeRule> rules(1 + random() % 9);
    int output = 0;
    for (std::size_t i = 0; i < rules.size(); ++i) {
        rules[i].number = int(i);
        rules[i].twoPhase = uniform(random) < 0.25;
        for (int count = int(random() % 4); count > 0; --count)
            rules[i].outputs.push_back(output++);
        for (int signal = 0; signal < signalCount; ++signal) {
            if (uniform(random) < density)
                rules[i].inputs.push_back({signal, uniform(random) < 0.6});
        }
    }
    std::shuffle(rules.begin(), rules.end(), random);
    return rules;
}

/// Reachability by Floyd and Warshall, on the definition of direct feed-through.
bool tst_RandomNetworks::hasLoop(const std::vector<RandomNodeRule> &rules)
{
    const std::size_t n = rules.size();
    std::vector<std::vector<bool>> reaches(n, std::vector<bool>(n));
    for (std::size_t from = 0; from < n; ++from) {
        for (std::size_t to = 0; to < n && !rules[from].twoPhase; ++to) {
            for (const RandomNodeRule::Input &input : rules[to].inputs)
                reaches[from][to] = reaches[from][to]
                    || (input.sameCycle
                        && std::count(rules[from].outputs.begin(), rules[from].outputs.end(), input.signal) > 0);
        }
    }
    for (std::size_t via = 0; via < n; ++via) {
        for (std::size_t from = 0; from < n; ++from) {
            for (std::size_t to = 0; to < n; ++to)
                reaches[from][to] = reaches[from][to] || (reaches[from][via] && reaches[via][to]);
        }
    }
    bool loop = false;
    for (std::size_t i = 0; i < n; ++i)
        loop = loop || reaches[i][i];
    return loop;
}

quint64 tst_RandomNetworks::expectedDigest(const std::vector<RandomNodeRule> &rules, const QPlcSignalTable &table)
{
    RandomEvaluation evaluation(rules, signalCount, initialValue);
    qplc::ProcessImage image(table);
    quint64 digest = 0;
    for (int i = 0; i < cycles; ++i) {
        const std::vector<double> &values = evaluation.evaluate(QPlcCycle(quint64(i), std::chrono::milliseconds(10)));
        std::memcpy(image.data(), values.data(), sizeof(double) * values.size());
        digest = image.digest(digest);
    }
    return digest;
}

bool tst_RandomNetworks::join(TestMaster &master, RandomNode &node, const QString &kind)
{
    if (kind == QLatin1String("inprocess") || (kind == QLatin1String("mixed") && m_mixed++ % 3 == 0))
        return master.addLocalNode(&node);
    const QString transport = kind == QLatin1String("mixed") ? QString(m_mixed % 3 == 1 ? "udp" : "tcp") : kind;
    return node.connectToMasterAndWaitForConnected(master.protocol(transport));
}

void tst_RandomNetworks::stagedNetworkEqualsTopologicalEvaluation_data()
{
    QTest::addColumn<QString>("kind");
    QTest::addColumn<int>("networks");
    QTest::newRow("in process") << "inprocess" << 400;
    QTest::newRow("udp") << "udp" << 15;
    QTest::newRow("tcp") << "tcp" << 15;
    QTest::newRow("mixed") << "mixed" << 30;
}

void tst_RandomNetworks::stagedNetworkEqualsTopologicalEvaluation()
{
    QFETCH(QString, kind);
    QFETCH(int, networks);
    QByteArray ini;
    std::vector<QByteArray> names;
    for (int i = 0; i < signalCount; ++i) {
        names.push_back("signal" + QByteArray::number(i));
        ini += "[" + names.back() + "]\ntype = Real64\ninitial = 0.5\n";
    }
    const QPlcSignalTable table = QPlcSignalTable::fromIni(ini);
    std::mt19937 random(11);
    m_refused = m_stages = 0;
    for (int network = 0; network < networks; ++network) {
        LogCapture log;  // refusals are wanted here
        TestMaster master(QPlcClock::lockstep(), table);
        QVERIFY(kind == QLatin1String("inprocess") || master.listen());
        std::vector<RandomNodeRule> accepted;
        std::vector<std::unique_ptr<RandomNode>> nodes;
        const double density = 0.02 + 0.01 * (network % 12);
        for (const RandomNodeRule &rule : randomRules(random, density)) {
            std::vector<RandomNodeRule> candidate = accepted;
            candidate.push_back(rule);
            auto node = std::make_unique<RandomNode>(rule, names);
            const bool closesLoop = hasLoop(candidate);
            QCOMPARE(join(master, *node, kind), !closesLoop);
            const QString reason = node->errorString() + master.errorString();
            QVERIFY2(!closesLoop || reason.contains(QLatin1String("algebraic loop")), qPrintable(reason));
            m_refused += closesLoop ? 1 : 0;
            if (closesLoop)
                continue;
            accepted = candidate;
            nodes.push_back(std::move(node));
        }
        m_stages = std::max(m_stages, master.schedule().stages.size());
        master.setCycleLimit(cycles);
        QVERIFY(master.startRealTime());
        QVERIFY(master.waitForState(QPlcMasterNode::Off));
        QCOMPARE(master.statistics().cycles, quint64(cycles));
        QCOMPARE(master.statistics().imageDigest, expectedDigest(accepted, table));
        for (const auto &node : nodes)
            node->disconnectFromMaster();
        QPlcSignalIndexTable::setCurrent({});
    }
    QVERIFY2(m_refused > 0 && m_stages >= 4, qPrintable(QStringLiteral("%1 %2").arg(m_refused).arg(m_stages)));
}

QTEST_GUILESS_MAIN(tst_RandomNetworks)
#include "tst_RandomNetworks.moc"
