// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ScriptedNode.h"

#include <functional>

/// Adds one to the same-cycle or last value of a signal.
class Adder : public QPlcCompactSlaveNode
{
public:
    Adder(const char *name, const char *in, const char *out, QPlcInputTiming::Value timing,
          RealTimeViolationPolicy policy = ErrorZeroOrderHold)
        : QPlcCompactSlaveNode(name, policy)
        , m_in(this, in, timing)
        , m_out(this, out)
    {
    }
    std::function<void(const QPlcCycle &, double)> onStep;

protected:
    void reset() override { m_out = 0.0; }
    void step(const QPlcCycle &cycle) override
    {
        m_out = m_in + 1.0;
        if (onStep)
            onStep(cycle, m_in);
    }

private:
    QPlcInput<double> m_in;
    QPlcOutput<double> m_out;
};

/// A two-phase sum of "setpoint" in "sum".
class Integrator : public QPlcCompactSlaveNode
{
public:
    explicit Integrator(QPlcInputTiming::Value timing = QPlcInputTiming::SameCycle)
        : QPlcCompactSlaveNode("Integrator")
        , m_in(this, "setpoint", timing)
    {
        setTwoPhase(true);
    }
    double sum = 0.0;

protected:
    void reset() override { sum = 1.0; }
    void outputs() override { m_sum = sum; }
    void update(const QPlcCycle &) override { sum += m_in; }
    void step(const QPlcCycle &) override { qFatal("a two-phase node has no step"); }

private:
    QPlcInput<double> m_in;
    QPlcOutput<double> m_sum{this, "sum"};
};

/// The same with lists.
class ListIntegrator : public QPlcSlaveNode
{
public:
    ListIntegrator()
        : QPlcSlaveNode("Integrator")
    {
        setTwoPhase(true);
    }

protected:
    QPlcSignalIndexList declareInputSignals() override
    {
        QPlcSignalIndexList list;
        m_in = list.insert("setpoint", QPlcInputTiming::SameCycle);
        return list;
    }
    QPlcSignalIndexList declareOutputSignals() override
    {
        QPlcSignalIndexList list;
        m_out = list.insert("sum");
        return list;
    }
    QPlcSignalList initialOutputSignals() override
    {
        m_state = 1.0;
        return outputSignals();
    }
    QPlcSignalList outputSignals() override
    {
        QPlcSignalList list;
        list.insert(m_out, m_state);
        return list;
    }
    void updateStates(const QPlcSignalList &inputs) override { m_state += inputs.value(m_in).toReal(); }
    QPlcSignalList realTimeout(const QPlcSignalList &) override { qFatal("a two-phase node has no step"); }

private:
    QPlcSignalIndex m_in = 0;
    QPlcSignalIndex m_out = 0;
    double m_state = 0.0;
};

inline bool join(TestMaster &master, QPlcSlaveNode &node, const QString &kind)
{
    return kind == QLatin1String("inprocess") ? master.addLocalNode(&node)
                                              : node.connectToMasterAndWaitForConnected(master.protocol(kind));
}

inline void addTransports()
{
    QTest::addColumn<QString>("kind");
    for (const char *kind : {"inprocess", "udp", "tcp"})
        QTest::newRow(kind) << kind;
}

inline QStringList stageTexts(const QPlcSchedule &schedule)
{
    QStringList texts;
    for (const QVector<QPlcSchedule::Turn> &stage : schedule.stages) {
        QStringList turns;
        for (const QPlcSchedule::Turn &turn : stage)
            turns << turn.node + QLatin1Char(' ') + QPlcSchedule::phaseName(turn.phase);
        texts << turns.join(", ");
    }
    return texts;
}

inline int ageOf(const QPlcSchedule &schedule, const QString &signal, const QString &reader)
{
    for (const QPlcSchedule::Link &link : schedule.links) {
        if (link.signal == signal && link.to == reader)
            return link.age;
    }
    return -1;
}

/// Registers as a two-phase node, or with same-cycle inputs.
inline bool registerOrdered(ScriptedNode &node, quint16 port, bool twoPhase, bool sameCycle)
{
    if (!node.connectTo(port))
        return false;
    node.features = QStringList{"sameCycle"};
    node.send(QPlcMessage::Hello, node.helloFields());
    const QPlcMessage hello = node.next();
    node.session = hello.hex64("session");
    QJsonObject fields = node.registerFields();
    QJsonArray inputs;
    const QJsonArray declared = fields.value("inputs").toArray();
    for (const QJsonValue &value : declared) {
        QJsonObject input = value.toObject();
        input.insert("sameCycle", sameCycle);
        inputs << input;
    }
    fields.insert("inputs", inputs);
    fields.insert("twoPhase", twoPhase);
    node.send(QPlcMessage::Register, fields);
    return node.takeRegistered(node.next()) && node.next().kind() == QPlcMessage::CyclicChannelAttached;
}
