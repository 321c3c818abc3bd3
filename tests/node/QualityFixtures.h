// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ScriptedNode.h"

inline QPlcSignalTable qualityTable(const QByteArray &more = {})
{
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table
        = QPlcSignalTable::fromIni("[count]\ntype = Int32\n[echo]\ntype = Real64\nmin = -100\nmax = 100\nsafe = -5\n"
                                   "[sum]\ntype = Real64\nunit = m\n[vector]\ntype = Real64Triple\nmax = 9\nhold = 1\n"
                                   "[free]\ntype = Real32\ninitial = 3\n"
                                       + more,
                                   &errors);
    Q_ASSERT_X(errors.isEmpty(), "qualityTable", qPrintable(QPlcParseError::toString(errors)));
    return table;
}

/// Writes "echo": the number of the cycle, unless the test has another idea.
class Source : public QPlcCompactSlaveNode
{
public:
    explicit Source(const QString &name = QStringLiteral("Source"))
        : QPlcCompactSlaveNode(name)
    {
    }
    std::function<double(quint64)> idea;
    QPlcOutput<double> m_echo{this, "echo"};
    QPlcOutput<std::array<double, 3>> m_vector{this, "vector"};

private:
    void reset() override { m_echo = 0.5; }
    void step(const QPlcCycle &cycle) override { m_echo = idea ? idea(cycle.number()) : double(cycle.number()); }
};

/// Moves something by "echo", and writes down what it was told in each cycle: "7 good".
class Actuator : public QPlcCompactSlaveNode
{
public:
    explicit Actuator(QPlcInputTiming::Value timing = QPlcInputTiming::LastCycle, bool asks = true)
        : QPlcCompactSlaveNode(QStringLiteral("Actuator"))
        , m_echo(this, "echo", timing)
    {
        setReceivesQuality(asks);
    }
    QStringList record;
    std::function<void()> afterStep;
    QString seenFree;
    QPlcInput<double> m_echo;
    QPlcInput<float> m_free{this, "free"};

private:
    void reset() override { record.clear(); }
    void step(const QPlcCycle &) override
    {
        record << QStringLiteral("%1 %2").arg(m_echo.value()).arg(m_echo.quality().toString());
        seenFree = QStringLiteral("%1 %2").arg(double(m_free.value())).arg(m_free.quality().toString());
        if (afterStep)
            afterStep();
    }
};
