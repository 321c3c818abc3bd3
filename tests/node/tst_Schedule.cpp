// SPDX-License-Identifier: Apache-2.0
#include "node/cycle/Schedule.h"

#include <QtTest/QtTest>

#include <random>

using namespace qplc;

Q_DECLARE_METATYPE(std::vector<qplc::Schedule::Node>)

// Stages by direct feed-through, compared with what follows from their definition, and loops
// compared with reachability (Floyd and Warshall).
class tst_Schedule : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void withoutSameCycleInputsThereIsOneStage();
    void scheduleWithoutNodesHasNoStages();
    void aChainHasAStageForEachNode();
    void nodesWithoutSameCycleInputsAreInTheFirstStage();
    void twoPhaseNodesCloseLoops();
    void outputsOfTwoPhaseNodesAddNoStage();
    void aNodeThatReadsItselfIsALoop();
    void theLoopBeginsWithTheLastNodeAndIsShort();
    void randomGraphsGiveValidSchedulesOrLoops_data();
    void randomGraphsGiveValidSchedulesOrLoops();
};

namespace {

using Nodes = std::vector<Schedule::Node>;
using Matrix = std::vector<std::vector<bool>>;

constexpr bool same = true;
constexpr bool last = false;

/// Whether node j depends on node i directly: by definition, not as Schedule finds it.
Matrix dependencies(const Nodes &nodes)
{
    Matrix depends(nodes.size(), std::vector<bool>(nodes.size()));
    for (std::size_t from = 0; from < nodes.size(); ++from) {
        for (std::size_t to = 0; to < nodes.size(); ++to) {
            for (const Schedule::Input &input : nodes[to].inputs) {
                for (QPlcSignalIndex output : nodes[from].outputs)
                    depends[from][to]
                        = depends[from][to] || (input.signal == output && input.sameCycle && !nodes[from].twoPhase);
            }
        }
    }
    return depends;
}

/// Floyd and Warshall.
Matrix closure(Matrix reaches)
{
    for (std::size_t via = 0; via < reaches.size(); ++via) {
        for (std::size_t from = 0; from < reaches.size(); ++from) {
            for (std::size_t to = 0; to < reaches.size(); ++to)
                reaches[from][to] = reaches[from][to] || (reaches[from][via] && reaches[via][to]);
        }
    }
    return reaches;
}

/// Node i writes signal 2i and 2i + 1.
Nodes randomNodes(std::mt19937 &random, double density)
{
    Nodes nodes(random() % 12);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        nodes[i].twoPhase = uniform(random) < 0.2;
        nodes[i].outputs = {QPlcSignalIndex(2 * i), QPlcSignalIndex(2 * i + 1)};
        for (QPlcSignalIndex signal = 0; signal < 2 * nodes.size() + 2; ++signal) {  // two of them are of nobody
            if (uniform(random) < density)
                nodes[i].inputs.push_back({signal, uniform(random) < 0.7});
        }
    }
    return nodes;
}

}  // namespace

void tst_Schedule::withoutSameCycleInputsThereIsOneStage()
{
    const Schedule schedule(
        {{false, {{1, last}}, {0}}, {false, {{0, last}}, {1}}, {true, {{0, last}, {2, last}}, {2}}});
    QVERIFY(schedule.isValid());
    QCOMPARE(schedule.stageCount(), std::size_t(1));
    for (std::size_t node : {0, 1, 2}) {
        QCOMPARE(schedule.stage(node), std::size_t(0));
        QVERIFY(!schedule.feedsLaterStage(node));
    }
    QCOMPARE(schedule.writer(2), std::size_t(2));
    QVERIFY(schedule.writer(3) == Schedule::Nobody);
}

void tst_Schedule::scheduleWithoutNodesHasNoStages()
{
    const Schedule schedule(Nodes{});
    QVERIFY(schedule.isValid());
    QCOMPARE(schedule.stageCount(), std::size_t(0));
}

void tst_Schedule::aChainHasAStageForEachNode()
{
    // The last one registers first.
    const Schedule schedule({{false, {{1, same}}, {2}}, {false, {{0, same}}, {1}}, {false, {{9, same}}, {0}}});
    QVERIFY(schedule.isValid());
    QCOMPARE(schedule.stageCount(), std::size_t(3));
    for (std::size_t node : {0, 1, 2})
        QCOMPARE(schedule.stage(node), 2 - node);
    QVERIFY(!schedule.feedsLaterStage(0));
    QVERIFY(schedule.feedsLaterStage(1));
    QVERIFY(schedule.feedsLaterStage(2));
}

void tst_Schedule::nodesWithoutSameCycleInputsAreInTheFirstStage()
{
    const Schedule schedule({{false, {}, {0}}, {false, {{0, same}}, {1}}, {false, {{1, last}}, {}}});
    QCOMPARE(schedule.stage(1), std::size_t(1));
    QCOMPARE(schedule.stage(2), std::size_t(0));
}

void tst_Schedule::twoPhaseNodesCloseLoops()
{
    Nodes loop{{true, {{1, same}}, {0}}, {false, {{0, same}}, {1}}};
    const Schedule schedule(loop);
    QVERIFY(schedule.isValid());
    QCOMPARE(schedule.stage(1), std::size_t(0));  // the controller
    QCOMPARE(schedule.stage(0), std::size_t(1));  // the update of the model
    loop[0].twoPhase = false;
    QVERIFY(!Schedule(loop).isValid());
}

void tst_Schedule::outputsOfTwoPhaseNodesAddNoStage()
{
    const Schedule schedule({{true, {}, {0}}, {true, {{0, same}}, {1}}, {false, {{0, same}, {1, same}}, {}}});
    QCOMPARE(schedule.stageCount(), std::size_t(1));
}

void tst_Schedule::aNodeThatReadsItselfIsALoop()
{
    Nodes nodes{{false, {}, {0}}, {false, {{5, last}, {3, same}}, {2, 3}}};
    const Schedule schedule(nodes);
    QCOMPARE(schedule.loop().size(), std::size_t(1));
    QCOMPARE(schedule.loop()[0].node, std::size_t(1));
    QCOMPARE(schedule.loop()[0].input, QPlcSignalIndex(3));
    nodes[1].twoPhase = true;
    QVERIFY(Schedule(nodes).isValid());
    nodes[1] = {false, {{3, last}}, {3}};
    QVERIFY(Schedule(nodes).isValid());
}

void tst_Schedule::theLoopBeginsWithTheLastNodeAndIsShort()
{
    // A ring of five, and a short cut from node 1 to node 4: 4 -> 0 -> 1 -> 4.
    Nodes ring;
    for (int i = 0; i < 5; ++i)
        ring.push_back({false, {{QPlcSignalIndex((i + 4) % 5), same}}, {QPlcSignalIndex(i)}});
    ring[4].inputs.push_back({1, same});
    const Schedule schedule(ring);
    const std::vector<Schedule::Hop> &loop = schedule.loop();
    QCOMPARE(loop.size(), std::size_t(3));
    QCOMPARE(loop[0].node, std::size_t(4));
    QCOMPARE(loop[0].input, QPlcSignalIndex(1));
    QCOMPARE(loop[1].node, std::size_t(0));
    QCOMPARE(loop[1].input, QPlcSignalIndex(4));
    QCOMPARE(loop[2].node, std::size_t(1));
    QCOMPARE(loop[2].input, QPlcSignalIndex(0));
}

void tst_Schedule::randomGraphsGiveValidSchedulesOrLoops_data()
{
    QTest::addColumn<double>("density");
    for (double density : {0.02, 0.05, 0.1, 0.3})
        QTest::addRow("%g", density) << density;
}

void tst_Schedule::randomGraphsGiveValidSchedulesOrLoops()
{
    QFETCH(double, density);
    std::mt19937 random(7);
    int valid = 0;
    constexpr int rounds = 2000;
    for (int round = 0; round < rounds; ++round) {
        const Nodes nodes = randomNodes(random, density);
        const Matrix direct = dependencies(nodes);
        const Matrix reaches = closure(direct);
        const Schedule schedule(nodes);
        bool hasLoop = false;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            hasLoop = hasLoop || reaches[i][i];
        QCOMPARE(schedule.isValid(), !hasLoop);
        const std::vector<Schedule::Hop> &loop = schedule.loop();
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Schedule::Hop &next = loop[(i + 1) % loop.size()];
            QVERIFY(direct[loop[i].node][next.node]);
            QCOMPARE(schedule.writer(next.input), loop[i].node);
            const std::vector<Schedule::Input> &inputs = nodes[next.node].inputs;
            QVERIFY(std::any_of(inputs.begin(), inputs.end(), [&](const Schedule::Input &input) {
                return input.signal == next.input && input.sameCycle;
            }));
            for (std::size_t j = 0; j < i; ++j)
                QVERIFY(loop[i].node != loop[j].node);
        }
        if (hasLoop)
            continue;
        ++valid;
        // A stage is one more than the last stage of those that are waited for, and 0 without them.
        std::size_t stages = 0;
        for (std::size_t to = 0; to < nodes.size(); ++to) {
            std::size_t expected = 0;
            bool feeds = false;
            for (std::size_t other = 0; other < nodes.size(); ++other) {
                expected = direct[other][to] ? std::max(expected, schedule.stage(other) + 1) : expected;
                feeds = feeds || direct[to][other];
            }
            QCOMPARE(schedule.stage(to), expected);
            QCOMPARE(schedule.feedsLaterStage(to), feeds);
            stages = std::max(stages, expected + 1);
        }
        QCOMPARE(schedule.stageCount(), stages);
    }
    QVERIFY2(valid > 0 && valid < rounds, qPrintable(QString::number(valid)));  // both kinds were there
}

QTEST_APPLESS_MAIN(tst_Schedule)
#include "tst_Schedule.moc"
