// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeFixtures.h"
#include "node/session/InitializeSequence.h"
#include "node/session/StartSequence.h"
#include "node/session/StopSequence.h"

/// A session that writes down what it is asked and told, and answers as the test says: without a
/// network or a node.
class ScriptedSession final : public qplc::NodeSession
{
public:
    using Log = QStringList;

    ScriptedSession(std::shared_ptr<qplc::NodeSlot> slot, Answers answers, Log &log)
        : NodeSession(std::move(slot), answers)
        , m_log(log)
    {
    }

    /// Called after a request or a piece of news was written down: "askOutputs".
    std::function<void(const QString &what)> heard = [](const QString &) {};
    QString fault;       // of its answers; empty: it can do what it is asked
    QByteArray outputs;  // that it gives
    QByteArray lastInputs;
    qplc::messages::RealTimeStarted lastStart;
    std::optional<quint64> lastPhase;

    std::optional<Answer> askOutputs(std::optional<quint64> phase) override
    {
        lastPhase = phase;
        note(QStringLiteral("askOutputs"));
        return answer(outputs);
    }
    std::optional<Answer> giveInputs(const QByteArray &values) override
    {
        lastInputs = values;
        note(QStringLiteral("giveInputs"));
        return answer();
    }
    std::optional<Answer> start(const qplc::messages::RealTimeStarted &start) override
    {
        lastStart = start;
        note(QStringLiteral("start"));
        return answer();
    }
    void cyclesStarted(QPlcProfile::Value profile) override
    {
        note(QStringLiteral("cyclesStarted ") + QPlcProfile::name(profile));
    }
    void cancel(const QString &reason, bool isStarting) override
    {
        setStage(Idle);
        note((isStarting ? QStringLiteral("cancel start: ") : QStringLiteral("cancel initialization: ")) + reason);
    }
    void stop(const QString &reason) override
    {
        setStage(Idle);
        note(QStringLiteral("stop: ") + reason);
    }
    void tellSafe() override { note(QStringLiteral("tellSafe")); }
    void drop(const QString &reason) override { note(QStringLiteral("drop: ") + reason); }
    void leave() override {}
    QPlcSlaveNode::State state() const override { return QPlcSlaveNode::Registered; }
    QString codeFailed() override { return {}; }
    QString transportName() const override { return {}; }
    QString address() const override { return {}; }

private:
    void note(const QString &what)
    {
        m_log << name() + QLatin1Char(' ') + what;
        heard(what);
    }
    std::optional<Answer> answer(const QByteArray &given = {}) const
    {
        return answersAtOnce() ? std::optional<Answer>(Answer{fault, given}) : std::nullopt;
    }

    Log &m_log;
};

/// Time that stands still until the test says that it is over.
class ScriptedTimer final : public qplc::StepTimer
{
public:
    void start(std::function<void()> timedOut) override { m_timedOut = std::move(timedOut); }
    void stop() override { m_timedOut = nullptr; }
    std::chrono::milliseconds length() const override { return std::chrono::milliseconds(2000); }
    bool isRunning() const { return bool(m_timedOut); }
    void elapse() { std::exchange(m_timedOut, nullptr)(); }

private:
    std::function<void()> m_timedOut;
};

/// Cycles that run when the test says so.
class ScriptedCycles final : public qplc::PhaseCycles
{
public:
    QString threadError;  // empty: start() succeeds
    bool running = false;
    quint64 newest = 0;
    QStringList gone;
    int rosters = 0;

    bool start(QString *error) override
    {
        *error = threadError;
        running = threadError.isEmpty();
        return running;
    }
    bool isRunning() const override { return running; }
    quint64 cycle() const override { return newest; }
    quint64 cycleZero() const override { return 1000; }
    void renewRoster() override { ++rosters; }
    bool hasLeft(const QString &name) const override { return gone.contains(name); }
};

/// A master that only writes down what its sequences tell it.
class ScriptedControl final : public qplc::MasterControl
{
public:
    explicit ScriptedControl(QStringList &log)
        : m_log(log)
    {
    }

    /// Called after an event was written down.
    std::function<void(qplc::MasterEvent event)> heard = [](qplc::MasterEvent) {};

    QPlcMasterNode::State state() const override { return QPlcMasterNode::Initializing; }
    bool apply(qplc::MasterEvent event, const QString &reason) override
    {
        m_log << QStringLiteral("master %1").arg(QLatin1String(qplc::nameOf(event)))
                + (reason.isEmpty() ? QString() : QStringLiteral(": ") + reason);
        heard(event);
        return true;
    }
    void announce(const qplc::messages::StatesInitialized &news) override
    {
        m_log << (news.ok ? QStringLiteral("all: initialized") : QStringLiteral("all: ") + news.text);
    }

private:
    QStringList &m_log;
};

/// The sequences of a master with scripted nodes, cycles and time, in one thread and without an
/// event loop.
struct SequenceBench
{
    explicit SequenceBench(QPlcSignalTable signalTable = testTable())
        : table(std::move(signalTable))
    {
    }

    QStringList log;
    QPlcSignalTable table;
    qplc::CyclicHub hub;
    qplc::NodeRegistry registry{table};
    qplc::MasterCycle image{table, hub, false};  // started by a RealTimePhase only
    qplc::Leases leases;
    qplc::StatisticSignals statistics;
    qplc::Journal journal;
    qplc::PhaseSettings settings;
    qplc::ProfileFacts facts;
    qplc::PhaseProfile profile{journal, [this] { return facts; }};
    qplc::NodeSessions nodes;
    ScriptedTimer timer;
    ScriptedTimer joinTimer;
    ScriptedCycles cycles;
    ScriptedControl master{log};
    qplc::SequenceStep step{timer};
    qplc::InitialValues values{image, registry, leases, statistics};
    qplc::StartMessages starts{settings, profile, cycles, hub, 7};
    qplc::JoinSequence joining{step, joinTimer, nodes, values, starts, cycles, profile, journal};
    qplc::InitializeSequence initialization{master, step, nodes, values, profile, joining};
    qplc::StartSequence starting{master, step, nodes, starts, profile, cycles, joining};
    qplc::StopSequence stopping{master, step, nodes};

    /// Registers a node. \param output  signal that it writes, with the value 1 at first
    std::shared_ptr<ScriptedSession> add(const QString &name, qplc::NodeSession::Answers answers, const QString &output,
                                         const QString &input = QString(), bool isListener = false)
    {
        const auto signal = [&](const QString &wanted) {
            const QPlcSignalDefinition &definition = table.at(table.indexOf(wanted));
            return qplc::messages::DeclaredSignal{wanted, definition.type.name(), definition.unit, false, {}};
        };
        qplc::NodeDeclaration declaration;
        declaration.name = name;
        declaration.listener = isListener;
        if (!output.isEmpty())
            declaration.outputs.push_back(signal(output));
        if (!input.isEmpty())
            declaration.inputs.push_back(signal(input));
        qplc::Refusal refusal;
        const auto slot = registry.admit(declaration, &refusal);
        Q_ASSERT_X(slot, "SequenceBench", qPrintable(refusal.text));
        slot->prepare(image.image(), 7);
        const auto session = std::make_shared<ScriptedSession>(slot, answers, log);
        if (!output.isEmpty())
            session->outputs = bytes(output, QPlcValue(1.0));
        nodes.add(session);
        return session;
    }
    QByteArray bytes(const QString &signal, const QPlcValue &value) const
    {
        QByteArray packed(int(table.at(table.indexOf(signal)).type.size()), 0);
        value.toBytes(packed.data());
        return packed;
    }
    /// Whether events of the journal tell this.
    bool hasEvent(const QString &text) const
    {
        for (const qplc::JournalEvent &event : journal.events().after(0, 100)) {
            if (event.text == text)
                return true;
        }
        return false;
    }
    QStringList takeLog() { return std::exchange(log, {}); }
};
