// SPDX-License-Identifier: Apache-2.0
#include "node/state/MasterStates.h"

#include <QtTest/QtTest>

using namespace qplc;

using S = QPlcMasterNode::State;
using E = MasterEvent;

// Every pair of state and event of a master.
class tst_MasterStates : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void everyTransitionMatchesTheTable_data();
    void everyTransitionMatchesTheTable();
    void refusedEventGivesAReasonAndKeepsTheState();
    void motionBeginsOnlyByAStart();
    void safeStopIsLeftByAResetOnly();
    void stoppingIsNeverRefused();
    void everyStateIsReachedAndLeft();
    void namesAreThoseOfTheEnum();

private:
    template<typename Check>
    static void forAll(Check check)
    {
        for (std::size_t state = 0; state < MasterStateCount; ++state) {
            for (std::size_t event = 0; event < MasterEventCount; ++event)
                check(S(state), E(event), masterStates().at(S(state), E(event)));
        }
    }
};

void tst_MasterStates::everyTransitionMatchesTheTable_data()
{
    // The next state by its first letters; '.' stays, '-' ignored, 'x' refused.
    QTest::addColumn<int>("event");
    QTest::addColumn<QString>("outcomes");  // Off, Initializing, Ready, RealTime, Waiting, SafeStop, Fault
    const auto row = [](E event, const char *outcomes) { QTest::newRow(nameOf(event)) << int(event) << outcomes; };
    row(E::Initialize, "In x In x x x x");
    row(E::InitializeIncomplete, "x x x x x x x");
    row(E::Arm, "x x . x x x x");
    row(E::Start, "In x In x x x x");
    row(E::StartIncomplete, "x x x x x x x");
    row(E::StartUnarmed, "x x x x x x x");
    row(E::Stop, ". Of Of Of Of . .");
    row(E::SafeStop, ". Of Of Sa Sa . .");
    row(E::Reset, ". x x x x Of Of");
    row(E::ResetTooEarly, ". x x x x x x");
    row(E::Listen, ". x . x x x .");
    row(E::AddNode, ". x Of x x x x");
    row(E::End, ". Of Of Of Of . .");
    row(E::StatesInitialized, "- Re - - - - -");
    row(E::CyclesStarted, "- RT - - - - -");
    row(E::SequenceFailed, "- Of - - - - -");
    row(E::ThreadFailed, "- Fa - - - - -");
    row(E::ServerListens, ". - . - - - Of");
    row(E::ServerFailed, "Fa - Fa - - - .");
    row(E::NodeJoined, ". . Of . . . .");
    row(E::ListenerJoined, ". . . . . . .");
    row(E::NodeLeft, ". . Of . . . .");
    row(E::CriticalNodeLeft, ". . Of Sa Sa . .");
    row(E::NodeFailed, "- Of - Of Of - -");
    row(E::CriticalNodeFailed, "- Of - Sa Sa - -");
    row(E::WaitBegan, "- - - Wa - - -");
    row(E::WaitEnded, "- - - - RT - -");
    row(E::CyclesTripped, "- - - Sa Sa - -");
    row(E::CycleLimitReached, "- - - Of Of - -");
    row(E::OverrunStop, "- - - Of Of - -");
}

void tst_MasterStates::everyTransitionMatchesTheTable()
{
    static const QStringList letters{"Of", "In", "Re", "RT", "Wa", "Sa", "Fa"};
    QFETCH(int, event);
    QFETCH(QString, outcomes);
    QStringList found;
    for (std::size_t state = 0; state < MasterStateCount; ++state) {
        const auto &cell = masterStates().at(S(state), E(event));
        found << (cell.verdict == Verdict::Refused       ? QStringLiteral("x")
                      : cell.verdict == Verdict::Ignored ? QStringLiteral("-")
                      : cell.next == S(state)            ? QStringLiteral(".")
                                                         : letters.at(int(cell.next)));
    }
    QCOMPARE(found.join(' '), outcomes);
}

void tst_MasterStates::refusedEventGivesAReasonAndKeepsTheState()
{
    forAll([](S state, E event, const MasterStateTable::Cell &cell) {
        const QByteArray where = QByteArray(nameOf(state)) + " x " + nameOf(event);
        QVERIFY2((cell.verdict == Verdict::Refused) == (qstrlen(cell.text) > 0), where.constData());
        if (cell.verdict != Verdict::Accepted) {
            QVERIFY2(cell.next == state, where.constData());
            QVERIFY2(cell.action == MasterAction::None, where.constData());
        }
    });
    for (E event : {E::Initialize, E::InitializeIncomplete, E::Arm, E::Start, E::StartIncomplete, E::StartUnarmed})
        QVERIFY(QByteArray(masterStates().at(S::SafeStop, event).text).startsWith("fault latched: %1"));
}

void tst_MasterStates::motionBeginsOnlyByAStart()
{
    forAll([](S state, E event, const MasterStateTable::Cell &cell) {
        const bool moves = cell.next == S::RealTime && state != S::RealTime;
        const bool mayMove = (state == S::Initializing && event == E::CyclesStarted)
            || (state == S::WaitingForLateSlaves && event == E::WaitEnded);
        QVERIFY2(!moves || mayMove, nameOf(event));
        const bool begins = cell.action == MasterAction::StartNodes || cell.action == MasterAction::CollectThenStart;
        QVERIFY2(!begins || event == E::Start, nameOf(event));
    });
}

void tst_MasterStates::safeStopIsLeftByAResetOnly()
{
    forAll([](S state, E event, const MasterStateTable::Cell &cell) {
        if (state == S::SafeStop && cell.next != S::SafeStop) {
            QCOMPARE(event, E::Reset);
            QCOMPARE(cell.next, S::Off);
        }
        if (cell.next == S::SafeStop && state != S::SafeStop)
            QVERIFY(cell.action == MasterAction::MakeCyclesSafe || cell.action == MasterAction::LatchReason);
    });
}

void tst_MasterStates::stoppingIsNeverRefused()
{
    forAll([](S state, E event, const MasterStateTable::Cell &cell) {
        Q_UNUSED(state)
        if (event == E::Stop || event == E::SafeStop || event == E::End)
            QCOMPARE(cell.verdict, Verdict::Accepted);
    });
}

void tst_MasterStates::everyStateIsReachedAndLeft()
{
    for (std::size_t from = 0; from < MasterStateCount; ++from) {
        QSet<int> reached{int(from)};
        for (int before = 0; before != reached.size();) {
            before = reached.size();
            forAll([&](S state, E, const MasterStateTable::Cell &cell) {
                if (reached.contains(state))
                    reached.insert(cell.next);
            });
        }
        QCOMPARE(reached.size(), int(MasterStateCount));
    }
}

void tst_MasterStates::namesAreThoseOfTheEnum()
{
    const QMetaEnum states = QMetaEnum::fromType<S>();
    QCOMPARE(states.keyCount(), int(MasterStateCount));
    for (int state = 0; state < states.keyCount(); ++state)
        QCOMPARE(nameOf(S(state)), states.valueToKey(state));
    QSet<QByteArray> events;
    for (std::size_t event = 0; event < MasterEventCount; ++event)
        events.insert(nameOf(E(event)));
    QCOMPARE(events.size(), int(MasterEventCount));
    QCOMPARE(nameOf(E::OverrunStop), "OverrunStop");
    QCOMPARE(nameOf(MasterAction::LetJoin), "LetJoin");
}

QTEST_GUILESS_MAIN(tst_MasterStates)
#include "tst_MasterStates.moc"
