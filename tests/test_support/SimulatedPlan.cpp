// SPDX-License-Identifier: Apache-2.0
// The text of a SimulatedPlan, and the shortest one that still fails.
#include "Scenario.h"

#include <QtCore/QRegularExpression>
#include <QtCore/QTextStream>

#include <algorithm>

namespace soak {

namespace {

const QString scenarioWord = QStringLiteral("scenario");
const QString seedWord = QStringLiteral("seed");
const QString secondsWord = QStringLiteral("seconds");

/// Reads a plan line by line. Functions return what is wrong with a line; empty: nothing.
class PlanReader
{
public:
    QString read(const QString &line)
    {
        const QString word = line.section(QLatin1Char(' '), 0, 0);
        const QString value = line.section(QLatin1Char(' '), 1);
        if (word == scenarioWord)
            return readScenario(value);
        if (word == seedWord)
            return readNumber(word, value, 0, &m_seed);
        if (word == secondsWord)
            return readNumber(word, value, 1, &m_seconds);
        return readFault(line);
    }
    /// What the whole plan lacks.
    QString missing() const
    {
        const QString text = QStringLiteral("the plan has no line '%1'");
        if (!m_scenario)
            return text.arg(QStringLiteral("scenario NAME"));
        if (!m_seed)
            return text.arg(QStringLiteral("seed N"));
        return m_seconds ? QString() : text.arg(QStringLiteral("seconds S"));
    }
    /// \pre nothing is missing()
    SimulatedPlan plan() const { return {m_scenario, *m_seed, int(*m_seconds), m_faults}; }

private:
    QString readScenario(const QString &name)
    {
        if (m_scenario)
            return QStringLiteral("a second scenario; a plan has one");
        m_scenario = Scenario::named(name);
        return m_scenario
            ? QString()
            : QStringLiteral("unknown scenario '%1'; use %2").arg(name, Scenario::names().join(QStringLiteral(", ")));
    }
    static QString readNumber(const QString &word, const QString &text, quint64 least, std::optional<quint64> *number)
    {
        if (*number)
            return QStringLiteral("a second line '%1'; a plan has one").arg(word);
        QString error;
        *number = wholeNumber(text, least, &error);
        return *number ? QString() : QStringLiteral("'%1 %2': %3").arg(word, text, error);
    }
    QString readFault(const QString &line)
    {
        if (const QString lack = missing(); !lack.isEmpty())
            return QStringLiteral("'%1' before the scenario, the seed and the seconds: %2").arg(line, lack);
        Fault fault;
        const QString wrong = Fault::read(line, m_scenario->profile.shape.nodes, &fault);
        m_faults.push_back(fault);
        return wrong;
    }

    const Scenario *m_scenario = nullptr;
    std::optional<quint64> m_seed;
    std::optional<quint64> m_seconds;
    std::vector<Fault> m_faults;
};

/// Changes a plan step by step as long as it still fails.
class Shrinking
{
public:
    Shrinking(const SimulatedPlan &plan, const std::function<bool(const SimulatedPlan &)> &fails)
        : m_plan(plan)
        , m_fails(fails)
    {
    }
    /// Looks at each fault and each time, at many faults at once first. \return whether something
    /// could be shortened
    bool pass()
    {
        m_isShorter = false;
        for (std::size_t count = std::max<std::size_t>(1, m_plan.faults.size() / 2); count > 0; count /= 2)
            leaveOut(count);
        for (std::size_t place = 0; place < m_plan.faults.size(); ++place) {
            halve([place](SimulatedPlan *plan) { return &plan->faults[place].amount; }, 1);
            halve([place](SimulatedPlan *plan) { return &plan->faults[place].pause; }, 0);
        }
        halve([](SimulatedPlan *plan) { return &plan->seconds; }, 1);
        return m_isShorter;
    }
    const SimulatedPlan &plan() const { return m_plan; }

private:
    template<typename Change>
    bool tryTo(Change change)
    {
        SimulatedPlan changed = m_plan;
        change(&changed);
        if (!m_fails(changed))
            return false;
        m_plan = changed;
        m_isShorter = true;
        return true;
    }
    /// From the last to the first, \a count at once.
    void leaveOut(std::size_t count)
    {
        for (std::size_t end = m_plan.faults.size(); end >= count; end -= count) {
            tryTo([begin = end - count, end](SimulatedPlan *plan) {
                const auto first = plan->faults.begin();
                plan->faults.erase(first + std::ptrdiff_t(begin), first + std::ptrdiff_t(end));
            });
        }
    }
    /// As often as the plan still fails.
    template<typename NumberOf>
    void halve(NumberOf numberOf, int least)
    {
        const auto change = [&](SimulatedPlan *plan) { *numberOf(plan) /= 2; };
        while (*numberOf(&m_plan) / 2 >= least && *numberOf(&m_plan) > 0 && tryTo(change)) {}
    }

    SimulatedPlan m_plan;
    const std::function<bool(const SimulatedPlan &)> &m_fails;
    bool m_isShorter = false;
};

}  // namespace

QString SimulatedPlan::toText() const
{
    QString text;
    QTextStream lines(&text);
    lines << scenarioWord << ' ' << scenario->profile.name << '\n'
          << seedWord << ' ' << seed << '\n'
          << secondsWord << ' ' << seconds << '\n';
    for (const Fault &fault : faults)
        lines << fault.toString() << '\n';
    return text;
}

std::optional<SimulatedPlan> SimulatedPlan::fromText(const QString &text, QString *error)
{
    PlanReader reader;
    const QStringList lines = text.split(QLatin1Char('\n'));
    for (int i = 0; i < lines.size(); ++i) {
        const QString line = lines.at(i).trimmed();
        if (line.isEmpty() || line.startsWith(QLatin1Char('#')))
            continue;
        if (const QString wrong = reader.read(line); !wrong.isEmpty()) {
            *error = QStringLiteral("%1: %2").arg(i + 1).arg(wrong);
            return std::nullopt;
        }
    }
    *error = reader.missing();
    if (error->isEmpty())
        return reader.plan();
    error->prepend(QStringLiteral("%1: ").arg(lines.size()));
    return std::nullopt;
}

SimulatedPlan shrunk(SimulatedPlan plan, const std::function<bool(const SimulatedPlan &)> &fails)
{
    Shrinking shrinking(plan, fails);
    while (shrinking.pass()) {}
    return shrinking.plan();
}

SimulatedPlan shrunk(const SimulatedPlan &plan)
{
    const QString gate = run(plan).violatedGate();
    return shrunk(plan, [&](const SimulatedPlan &shorter) { return run(shorter).violatedGate() == gate; });
}

}  // namespace soak
