// SPDX-License-Identifier: Apache-2.0
#include "EchoCommand.h"

#include "SignalListener.h"
#include "SignalSelection.h"
#include "TerminalText.h"
#include "node/cycle/ListeningInterval.h"

#include <QtCore/QDeadlineTimer>

#include <algorithm>
#include <cmath>

namespace tools {

namespace {

/// Lines of values: aligned columns on a terminal, tab-separated elsewhere.
class ValueLines
{
public:
    explicit ValueLines(const QVector<QPlcSignalDefinition> &definitions)
    {
        QStringList titles{QStringLiteral("time [s]")};
        m_widths.append(10);
        for (const QPlcSignalDefinition &definition : definitions) {
            titles << (definition.unit.isEmpty() ? definition.name
                                                 : QStringLiteral("%1 [%2]").arg(definition.name, definition.unit));
            const bool isNumber = definition.type.isReal() || definition.type.isInteger();
            m_widths.append(
                std::max(displayWidth(printable(titles.constLast())), isNumber ? 14 * definition.type.count() : 20));
        }
        printLine(toned(toLine(titles), Tone::Title));
    }

    void print(const QStringList &cells) const { printLine(toLine(cells)); }

private:
    QString toLine(const QStringList &cells) const
    {
        QStringList columns;
        for (int i = 0; i < cells.size(); ++i) {
            const QString cell = printable(cells.at(i));
            columns << (isTerminal() ? padded(cell, m_widths.at(i), Right) : cell);
        }
        return columns.join(isTerminal() ? QStringLiteral("  ") : QStringLiteral("\t"));
    }

    QVector<int> m_widths;
};

/// Prints what a listener hears, at most so often and so many lines.
class Echo : public QObject
{
public:
    Echo(SignalListener &listener, bool isJson, double rate, qint64 count)
        : m_listener(listener)
        , m_pause(std::llround(1e9 / rate))
        , m_remaining(count)
    {
        if (!isJson)
            m_lines.emplace(listener.definitions());
        connect(&listener, &SignalListener::heard, this, &Echo::takeCycles);
        connect(&listener, &SignalListener::masterEnded, this, &Echo::masterEnded);
    }

    /// Whether as many lines are out as were wanted.
    bool isComplete() const { return m_remaining == 0; }

    /// While no cycle runs one line with the values as they are, without time, if it is the first.
    void printAtRest(const QVector<QPlcValue> &values)
    {
        if (!m_listener.isRunning() && !m_hasPrinted)
            print(QJsonObject{{QStringLiteral("time"), QJsonValue()}}, QStringLiteral("-"), values);
    }

private:
    void takeCycles(const QVector<SignalListener::Sample> &samples)
    {
        if (!samples.isEmpty())
            m_newest = samples.constLast();
        if (!m_newest || !m_next.hasExpired() || m_remaining == 0)
            return;
        const SignalListener::Sample sample = *std::exchange(m_newest, std::nullopt);
        m_next = QDeadlineTimer::addNSecs(m_next, m_pause);
        if (m_next.hasExpired())  // nothing came for long
            m_next.setPreciseRemainingTime(0, m_pause, Qt::PreciseTimer);
        const double time = m_listener.timeOf(sample.cycle);
        print(QJsonObject{{QStringLiteral("time"), time}, {QStringLiteral("cycle"), double(sample.cycle)}},
              QString::number(time, 'f', 3), sample.values);
    }

    void print(QJsonObject object, const QString &time, const QVector<QPlcValue> &values)
    {
        m_hasPrinted = true;
        if (m_lines) {
            QStringList cells{time};
            for (int i = 0; i < values.size(); ++i)  // people read names, programs numbers
                cells << (isTerminal() ? m_listener.definitions().at(i).textOf(values.at(i)) : values.at(i).toString());
            m_lines->print(cells);
        } else {
            object.insert(QStringLiteral("values"), m_listener.toJson(values));
            printJson(QJsonDocument(object));
        }
        if (m_remaining > 0 && --m_remaining == 0)
            QCoreApplication::exit(QPlcCoreApplication::Success);
    }

    void masterEnded()
    {
        if (m_remaining > 0 && m_listener.isSound())
            QPlcCoreApplication::printError(QStringLiteral("the master has ended %1 lines too early").arg(m_remaining));
        QCoreApplication::exit(m_remaining > 0 || !m_listener.isSound() ? QPlcCoreApplication::Failure
                                                                        : QPlcCoreApplication::Success);
    }

    SignalListener &m_listener;
    std::optional<ValueLines> m_lines;               // none: JSON
    std::optional<SignalListener::Sample> m_newest;  // none: nothing since the last line
    qint64 m_pause;                                  // between two lines [ns]
    QDeadlineTimer m_next{0, Qt::PreciseTimer};
    qint64 m_remaining;  // lines; below 0: no end
    bool m_hasPrinted = false;
};

}  // namespace

bool readEvery(const CommandCall &call, qint64 *every)
{
    return call.readInteger("every", 1, qplc::ListeningInterval::Longest, every);
}

int printLines(const CommandCall &call, const QPlcSignalTable &table, const QStringList &names, const LineRate &rate)
{
    // Twice as often as lines come, and often enough for the buffer.
    SignalListener listener(call, QStringLiteral("echo"), table, names, std::clamp(int(500.0 / rate.rate), 1, 50));
    listener.setInterval(int(rate.every));
    Echo echo(listener, call.isJson(), rate.rate, rate.count);
    QObject::connect(&listener, &SignalListener::valuesAtRest, &echo, &Echo::printAtRest);
    qplc::messages::State state;
    std::vector<qplc::messages::SignalEntry> values;
    if (!call.ask(qplc::messages::GetState(), &state)
        || !call.tell(call.client.askForSignals(listener.names(), &values)))
        return call.exitCode();
    const auto endIsWanted = call.quitOnSignals();
    listener.handleState(state);
    listener.handleValues(values);
    if (echo.isComplete())
        return QPlcCoreApplication::Success;
    const bool hasJoined = listener.join();
    if (*endIsWanted)
        return QPlcCoreApplication::Success;
    return hasJoined ? QCoreApplication::exec() : QPlcCoreApplication::Failure;
}

int echoSignals(const CommandCall &call)
{
    LineRate rate;
    QPlcSignalTable table;
    QStringList names;
    if (!call.readNumber("rate", 0.01, 1000.0, &rate.rate) || !call.readInteger("count", 1, 1'000'000'000, &rate.count)
        || !readEvery(call, &rate.every) || !call.connect(&table)
        || !selectSignals(call.application, table, call.arguments, &names))
        return call.exitCode();
    return printLines(call, table, names, rate);
}

}  // namespace tools
