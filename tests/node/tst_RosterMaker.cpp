// SPDX-License-Identifier: Apache-2.0
#include "PhaseFixtures.h"

#include <QtTest/QtTest>

using qplc::NodeSession;
using qplc::Roster;
using Answers = NodeSession::Answers;

namespace {

QPlcSignalTable tableWithSafeValue()
{
    return QPlcSignalTable::fromIni("[sum]\ntype = Real64\nunit = m\n[echo]\ntype = Real64\n"
                                    "[valve]\ntype = Int32\nsafe = 1\n[free]\ntype = Int32\n");
}

struct RosterBench : PhaseBench
{
    RosterBench()
        : PhaseBench(tableWithSafeValue())
    {
    }

    /// Names of signals that are marked in \a mask.
    QStringList names(const std::vector<bool> &mask) const
    {
        QStringList names;
        for (std::size_t i = 0; i < mask.size(); ++i) {
            if (mask[i])
                names << table.at(QPlcSignalIndex(i)).name;
        }
        return names;
    }
    static QStringList names(const Roster &roster)
    {
        QStringList names;
        for (const auto &slot : roster.nodes)
            names << slot->name;
        return names;
    }
};

}  // namespace

class tst_RosterMaker : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void onlyNodesThatAnswerCyclesTakePart();
    void signalsOfNodesAreSafeInASafeStop();
    void whatAPhaseHasWrittenStaysSafeWithoutItsNode();
    void whatIsTakenOverIsHeldAndSafe();
    void theMasterKeepsItsOwnSignals();
    void signalsOfANodeThatLeftTooEarlyAreAbandoned();
};

void tst_RosterMaker::onlyNodesThatAnswerCyclesTakePart()
{
    RosterBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    const auto kite = bench.add("Kite", Answers::AtOnce, "echo");
    winch->setStage(NodeSession::Running);
    kite->setStage(NodeSession::Starting);
    QCOMPARE(bench.names(bench.rosters.make()), QStringList{"Winch"});
    kite->setStage(NodeSession::Running);
    QCOMPARE(bench.names(bench.rosters.make()), QStringList({"Winch", "Kite"}));
    bench.nodes.remove(*winch);  // registered still, without a session
    QCOMPARE(bench.names(bench.rosters.make()), QStringList{"Kite"});
}

void tst_RosterMaker::signalsOfNodesAreSafeInASafeStop()
{
    RosterBench bench;
    QCOMPARE(bench.names(bench.rosters.make().safe), QStringList{"valve"});  // it has a safe value
    bench.add("Winch", Answers::Later, "sum", "echo")->setStage(NodeSession::Running);
    QCOMPARE(bench.names(bench.rosters.make().safe), QStringList({"sum", "valve"}));
}

void tst_RosterMaker::whatAPhaseHasWrittenStaysSafeWithoutItsNode()
{
    RosterBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    winch->setStage(NodeSession::Running);
    (void)bench.rosters.make();
    bench.remove(winch);
    QCOMPARE(bench.names(bench.rosters.make().safe), QStringList({"sum", "valve"}));
    bench.rosters.forgetWritten();
    QCOMPARE(bench.names(bench.rosters.make().safe), QStringList{"valve"});
}

void tst_RosterMaker::whatIsTakenOverIsHeldAndSafe()
{
    RosterBench bench;
    int person = 0;
    bench.leases.take({bench.index("echo")}, &person, "anna", 1000, 0);
    const Roster roster = bench.rosters.make();
    QCOMPARE(bench.names(roster.held), QStringList{"echo"});
    QCOMPARE(bench.names(roster.safe), QStringList({"echo", "valve"}));
}

void tst_RosterMaker::theMasterKeepsItsOwnSignals()
{
    RosterBench bench;
    QVERIFY(bench.registry.claim(bench.index("valve")));
    QCOMPARE(bench.names(bench.rosters.make().safe), QStringList());
}

void tst_RosterMaker::signalsOfANodeThatLeftTooEarlyAreAbandoned()
{
    RosterBench bench;
    const auto winch = bench.add("Winch", Answers::Later, "sum");
    bench.rosters.abandon(*winch->slot());
    QVERIFY(bench.rosters.make().abandoned.empty());  // it is still their writer
    bench.remove(winch);
    QCOMPARE(bench.rosters.make().abandoned, std::vector<QPlcSignalIndex>{bench.index("sum")});
    const auto other = bench.add("Other", Answers::Later, "sum");
    QVERIFY(bench.rosters.make().abandoned.empty());
    bench.remove(other);
    bench.rosters.forgetAbandoned();
    QVERIFY(bench.rosters.make().abandoned.empty());
}

QTEST_GUILESS_MAIN(tst_RosterMaker)
#include "tst_RosterMaker.moc"
