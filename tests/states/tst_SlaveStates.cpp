// SPDX-License-Identifier: Apache-2.0
#include "node/state/SlaveStates.h"

#include <QtTest/QtTest>

using namespace qplc;

using S = QPlcSlaveNode::State;
using E = SlaveEvent;

// Every pair of state and event of a node.
class tst_SlaveStates : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void everyTransitionMatchesTheTable_data();
    void everyTransitionMatchesTheTable();
    void refusedEventGivesAReasonAndKeepsTheState();
    void motionBeginsOnlyWhenTheMasterStartsAPhase();
    void safeNodeNeverResumesByItself();
    void leavingIsNeverRefused();
    void everyStateIsReachedAndLeft();
    void namesAreThoseOfTheEnum();

private:
    template<typename Check>
    static void forAll(Check check)
    {
        for (std::size_t state = 0; state < SlaveStateCount; ++state) {
            for (std::size_t event = 0; event < SlaveEventCount; ++event)
                check(S(state), E(event), slaveStates().at(S(state), E(event)));
        }
    }
};

void tst_SlaveStates::everyTransitionMatchesTheTable_data()
{
    // The next state by its letters; '.' stays, '-' ignored, 'x' refused.
    QTest::addColumn<int>("event");
    QTest::addColumn<QString>("outcomes");
    // Disconnected, Connecting, Registering, Rejected, Registered, Initializing, Ready, RealTime,
    // SafeStop, Fault
    const auto row = [](E event, const char *outcomes) { QTest::newRow(nameOf(event)) << int(event) << outcomes; };
    row(E::Connect, "Co x x Co x x x x Co Co");
    row(E::Retry, "Co - - Co - - - - Co Co");
    row(E::Leave, ". Di Di Di Di Di Di Di Di Di");
    row(E::AddedLocally, "Rd x x x x x x x x x");
    row(E::Connected, "- Rg - - - - - - - -");
    row(E::ConnectionLost, "- Di Di - Di Di Di Sa . .");
    row(E::HelloCame, "x x . x x x x x x x");
    row(E::Accepted, "x x . x x x x x x x");
    row(E::ChannelAttached, "x x Rd x x x x x x x");
    row(E::Refused, "- Rj Rj - Rj Rj Rj Rj Rj Rj");
    row(E::MasterEnded, "- Di Di - Di Di Di Di Di Di");
    row(E::OutputsWanted, "x x x x In . In x x In");
    row(E::ValuesCame, "x x x x Re Re . x x x");
    row(E::InitializationFailed, "- - - - . Rd Rd - - -");
    row(E::PhaseStarted, "x x x x RT x RT x x x");
    row(E::PhaseStopped, "- - - - . Rd Rd Rd Rd .");
    row(E::ToldSafeStop, "- - - - - - - Sa - -");
    row(E::WatchdogTimedOut, "- - - - - - - Sa . .");
    row(E::CodeFailed, "- - - - Fa Fa Fa Fa Fa .");
}

void tst_SlaveStates::everyTransitionMatchesTheTable()
{
    static const QStringList letters{"Di", "Co", "Rg", "Rj", "Rd", "In", "Re", "RT", "Sa", "Fa"};
    QFETCH(int, event);
    QFETCH(QString, outcomes);
    QStringList found;
    for (std::size_t state = 0; state < SlaveStateCount; ++state) {
        const auto &cell = slaveStates().at(S(state), E(event));
        found << (cell.verdict == Verdict::Refused       ? QStringLiteral("x")
                      : cell.verdict == Verdict::Ignored ? QStringLiteral("-")
                      : cell.next == S(state)            ? QStringLiteral(".")
                                                         : letters.at(int(cell.next)));
    }
    QCOMPARE(found.join(' '), outcomes);
}

void tst_SlaveStates::refusedEventGivesAReasonAndKeepsTheState()
{
    forAll([](S state, E event, const SlaveStateTable::Cell &cell) {
        const QByteArray where = QByteArray(nameOf(state)) + " x " + nameOf(event);
        QVERIFY2((cell.verdict == Verdict::Refused) == (qstrlen(cell.text) > 0), where.constData());
        if (cell.verdict != Verdict::Accepted) {
            QVERIFY2(cell.next == state, where.constData());
            QVERIFY2(cell.action == SlaveAction::None, where.constData());
        }
    });
}

void tst_SlaveStates::motionBeginsOnlyWhenTheMasterStartsAPhase()
{
    forAll([](S state, E event, const SlaveStateTable::Cell &cell) {
        if (cell.next == S::RealTime && state != S::RealTime)
            QCOMPARE(event, E::PhaseStarted);
    });
}

void tst_SlaveStates::safeNodeNeverResumesByItself()
{
    forAll([](S state, E event, const SlaveStateTable::Cell &cell) {
        if (state == S::SafeStop || state == S::Fault)
            QVERIFY2(cell.next != S::RealTime && cell.next != S::Ready, nameOf(event));
        // No end of a phase without the safe state: whatever leads out of it closes the connection,
        // ends the cycles, or is said by cycles that are safe already.
        if (state == S::RealTime && cell.next != S::RealTime)
            QVERIFY2(cell.action == SlaveAction::CloseConnection || cell.action == SlaveAction::CloseAndRetry
                         || cell.action == SlaveAction::EndCycles || event == E::ToldSafeStop || event == E::CodeFailed,
                     nameOf(event));
    });
}

void tst_SlaveStates::leavingIsNeverRefused()
{
    forAll([](S, E event, const SlaveStateTable::Cell &cell) {
        if (event == E::Leave)
            QCOMPARE(cell.verdict, Verdict::Accepted);
    });
}

void tst_SlaveStates::everyStateIsReachedAndLeft()
{
    for (std::size_t from = 0; from < SlaveStateCount; ++from) {
        QSet<int> reached{int(from)};
        for (int before = 0; before != reached.size();) {
            before = reached.size();
            forAll([&](S state, E, const SlaveStateTable::Cell &cell) {
                if (reached.contains(state))
                    reached.insert(cell.next);
            });
        }
        QCOMPARE(reached.size(), int(SlaveStateCount));
    }
}

void tst_SlaveStates::namesAreThoseOfTheEnum()
{
    const QMetaEnum states = QMetaEnum::fromType<S>();
    for (std::size_t state = 0; state < SlaveStateCount; ++state)
        QCOMPARE(states.keyToValue(nameOf(S(state))), int(state));
    QSet<QByteArray> events;
    for (std::size_t event = 0; event < SlaveEventCount; ++event)
        events.insert(nameOf(E(event)));
    QCOMPARE(events.size(), int(SlaveEventCount));
    QCOMPARE(nameOf(E::CodeFailed), "CodeFailed");
    QCOMPARE(nameOf(SlaveAction::EndCycles), "EndCycles");
}

QTEST_GUILESS_MAIN(tst_SlaveStates)
#include "tst_SlaveStates.moc"
