// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcCore>

#include <memory>
#include <random>
#include <vector>

/// What a node of a random network is, and what it computes: sums that stay bounded.
struct RandomNodeRule
{
    struct Input
    {
        int signal;
        bool sameCycle;
    };
    int number = 0;
    bool twoPhase = false;
    std::vector<Input> inputs;
    std::vector<int> outputs;

    double mean(const std::vector<double> &inputValues) const
    {
        double sum = 0.1 * number;
        for (std::size_t i = 0; i < inputValues.size(); ++i)
            sum += inputValues[i] / double(i + 1);
        return sum / double(inputValues.size() + 1);
    }
    double initialState() const { return 0.01 * number; }
    /// Output \a place of a two-phase node.
    double output(double state, int place) const { return 0.7 * state + 0.03 * place; }
    /// Of any other.
    double output(double state, int place, const std::vector<double> &inputValues) const
    {
        return output(state, place) + 0.2 * mean(inputValues);
    }
    double nextState(double state, const std::vector<double> &inputValues, const QPlcCycle &cycle) const
    {
        return 0.6 * state + 0.3 * mean(inputValues) + cycle.dt() * double(cycle.number() % 7);
    }
};

/// The same as a node of a master.
class RandomNode : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    RandomNode(const RandomNodeRule &rule, const std::vector<QByteArray> &names)
        : QPlcCompactSlaveNode(QStringLiteral("Node%1").arg(rule.number))
        , m_rule(rule)
        , m_values(rule.inputs.size())
    {
        setTwoPhase(rule.twoPhase);
        for (const RandomNodeRule::Input &input : rule.inputs)
            m_inputs.push_back(std::make_unique<QPlcInput<double>>(this, names[std::size_t(input.signal)].constData(),
                                                                   input.sameCycle ? QPlcInputTiming::SameCycle
                                                                                   : QPlcInputTiming::LastCycle));
        for (int output : rule.outputs)
            m_outputs.push_back(std::make_unique<QPlcOutput<double>>(this, names[std::size_t(output)].constData()));
    }

private:
    void reset() override
    {
        m_state = m_rule.initialState();
        for (const auto &output : m_outputs)
            *output = -1.0;
    }
    void step(const QPlcCycle &cycle) override
    {
        read();
        for (std::size_t i = 0; i < m_outputs.size(); ++i)
            *m_outputs[i] = m_rule.output(m_state, int(i), m_values);
        m_state = m_rule.nextState(m_state, m_values, cycle);
    }
    void outputs() override
    {
        for (std::size_t i = 0; i < m_outputs.size(); ++i)
            *m_outputs[i] = m_rule.output(m_state, int(i));
    }
    void update(const QPlcCycle &cycle) override
    {
        read();
        m_state = m_rule.nextState(m_state, m_values, cycle);
    }
    void read()
    {
        for (std::size_t i = 0; i < m_inputs.size(); ++i)
            m_values[i] = *m_inputs[i];
    }

    const RandomNodeRule m_rule;
    std::vector<double> m_values;
    double m_state = 0.0;
    std::vector<std::unique_ptr<QPlcInput<double>>> m_inputs;
    std::vector<std::unique_ptr<QPlcOutput<double>>> m_outputs;
};

/// The same without any master: a cycle is evaluated by following each value to those that it is
/// made of.
class RandomEvaluation
{
public:
    RandomEvaluation(const std::vector<RandomNodeRule> &rules, int signalCount, double initialValue)
        : m_rules(rules)
        , m_values(std::size_t(signalCount), initialValue)
    {
        for (const RandomNodeRule &rule : m_rules) {
            m_states.push_back(rule.initialState());
            for (std::size_t i = 0; i < rule.outputs.size(); ++i)
                m_values[std::size_t(rule.outputs[i])]
                    = rule.twoPhase ? rule.output(rule.initialState(), int(i)) : -1.0;
        }
    }
    /// Values of all signals at the end of the cycle.
    const std::vector<double> &evaluate(const QPlcCycle &cycle)
    {
        m_last = m_values;
        m_done.assign(m_rules.size(), false);
        m_inputs.assign(m_rules.size(), {});
        for (std::size_t i = 0; i < m_rules.size(); ++i) {
            const RandomNodeRule &rule = m_rules[i];
            for (std::size_t j = 0; rule.twoPhase && j < rule.outputs.size(); ++j)
                m_values[std::size_t(rule.outputs[j])] = rule.output(m_states[i], int(j));
        }
        for (std::size_t i = 0; i < m_rules.size(); ++i)
            compute(i);
        for (std::size_t i = 0; i < m_rules.size(); ++i)
            m_states[i] = m_rules[i].nextState(m_states[i], m_inputs[i], cycle);
        return m_values;
    }

private:
    void compute(std::size_t node)
    {
        if (m_done[node])
            return;
        m_done[node] = true;
        const RandomNodeRule &rule = m_rules[node];
        for (const RandomNodeRule::Input &input : rule.inputs) {
            for (std::size_t writer = 0; input.sameCycle && writer < m_rules.size(); ++writer) {
                const std::vector<int> &outputs = m_rules[writer].outputs;
                if (!m_rules[writer].twoPhase
                    && std::find(outputs.begin(), outputs.end(), input.signal) != outputs.end())
                    compute(writer);
            }
            m_inputs[node].push_back((input.sameCycle ? m_values : m_last)[std::size_t(input.signal)]);
        }
        for (std::size_t i = 0; !rule.twoPhase && i < rule.outputs.size(); ++i)
            m_values[std::size_t(rule.outputs[i])] = rule.output(m_states[node], int(i), m_inputs[node]);
    }

    const std::vector<RandomNodeRule> m_rules;
    std::vector<double> m_states;
    std::vector<double> m_values;
    std::vector<double> m_last;
    std::vector<bool> m_done;
    std::vector<std::vector<double>> m_inputs;
};
