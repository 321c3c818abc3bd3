// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "TerminalText.h"

#include <QtCore/QDeadlineTimer>
#include <QtCore/QJsonArray>
#include <QtCore/QTimer>

#include <algorithm>
#include <cmath>

namespace tools {

namespace {

/// Lines of values: aligned columns on a terminal, tab-separated elsewhere.
class ValueLines
{
public:
    ValueLines(const QPlcSignalTable &table, const QStringList &names)
    {
        QStringList titles{QStringLiteral("time [s]")};
        m_widths.append(10);
        for (const QString &name : names) {
            const QPlcSignalDefinition &definition = table.at(table.indexOf(name));
            titles << (definition.unit.isEmpty() ? name : QStringLiteral("%1 [%2]").arg(name, definition.unit));
            const bool isNumber = definition.type.isReal() || definition.type.isInteger();
            m_widths.append(std::max(titles.constLast().size(), isNumber ? 14 * definition.type.count() : 20));
        }
        printLine(bold(toLine(titles)));
    }

    void print(const QStringList &cells) const { printLine(toLine(cells)); }

private:
    QString toLine(const QStringList &cells) const
    {
        QStringList columns;
        for (int i = 0; i < cells.size(); ++i) {
            const QString cell = printable(cells.at(i));
            columns << (isTerminal() ? cell.rightJustified(m_widths.at(i)) : cell);
        }
        return columns.join(isTerminal() ? QStringLiteral("  ") : QStringLiteral("\t"));
    }

    QVector<int> m_widths;
};

/// Joins the plant as a listener and prints what it hears.
class Echo : public QObject
{
public:
    Echo(const CommandCall &call, const QPlcSignalTable &table, double rate, qint64 count)
        : m_lines(table, call.arguments)
        , m_node(QStringLiteral("qtplc-echo-%1").arg(QCoreApplication::applicationPid()))
        , m_pause(std::llround(1e9 / rate))
        , m_remaining(count)
    {
        QPlcSignalIndexTable::setCurrent(table);
        QPlcSignalIndexList indices;
        for (const QString &name : call.arguments)
            m_wanted << indices.insert(name);
        m_node.setInputSignalIndices(indices);
        m_node.setBufferSize(10000);
        m_timer.setTimerType(Qt::PreciseTimer);
        m_timer.setInterval(
            std::clamp(int(500.0 / rate), 1, 50));  // twice as often as lines come, and often enough for the buffer
        connect(&m_timer, &QTimer::timeout, this, [this] { takeValues(); });
        connect(&m_node, &QPlcSlaveNode::realTimeHasStarted, this,
                [this] { m_node.sendMessageToMaster(QPlcMessage(QPlcMessage::GetState)); });
        connect(&m_node, &QPlcSlaveNode::messageReceived, this,
                [this](const QPlcMessage &message) { readPeriod(message); });
        connect(&m_node, &QPlcSlaveNode::disconnectedFromMaster, this, [this] {
            // When the master was lost, and did not just end, the error follows.
            QMetaObject::invokeMethod(
                this, [this] { masterEnded(); }, Qt::QueuedConnection);
        });
    }

    ~Echo() override { m_node.disconnect(this); }

    /// Whether as many lines are out as were wanted.
    bool isComplete() const { return m_remaining == 0; }

    bool printPresentValues(ControlClient &client, const QStringList &names)
    {
        QPlcMessage state;
        QPlcMessage answer;
        if (!client.ask(QPlcMessage(QPlcMessage::GetState), &state))
            return false;
        readPeriod(state);
        const QString name = state.text(QStringLiteral("state"));
        if (name != QLatin1String("Off") && name != QLatin1String("Initializing"))
            return true;
        if (!client.ask(
                QPlcMessage(QPlcMessage::GetSignals, {{QStringLiteral("names"), QJsonArray::fromStringList(names)}}),
                &answer))
            return false;
        QStringList cells{QStringLiteral("-")};
        const QJsonArray values = answer.fields().value(QStringLiteral("signals")).toArray();
        for (const QJsonValue &value : values)
            cells << value.toObject().value(QStringLiteral("value")).toString();
        print(cells);
        return true;
    }

    bool join(const QPlcUnderlyingProtocol &master, std::chrono::milliseconds timeout)
    {
        m_timer.start();
        return m_node.connectToMasterAndWaitForConnected(master, timeout);
    }

private:
    void readPeriod(const QPlcMessage &message)
    {
        if (message.kind() == QPlcMessage::State)
            m_period = message.fields().value(QStringLiteral("period")).toDouble() * 1e-9;
    }

    void takeValues()
    {
        QVector<quint64> cycles;
        const QList<QPlcSignalList> batch = m_node.takeInputSignals(&cycles);
        if (!batch.isEmpty()) {
            m_newest = batch.constLast();
            m_cycle = cycles.constLast();
        }
        if (m_newest.isEmpty() || !m_next.hasExpired() || m_remaining == 0)
            return;
        QStringList cells{QString::number(double(m_cycle) * m_period, 'f', 3)};
        for (const QPlcSignalIndex index : qAsConst(m_wanted))
            cells << m_newest.value(index).toString();
        m_newest.clear();
        m_next = QDeadlineTimer::addNSecs(m_next, m_pause);
        if (m_next.hasExpired())  // nothing came for long
            m_next.setPreciseRemainingTime(0, m_pause, Qt::PreciseTimer);
        print(cells);
    }

    void print(const QStringList &cells)
    {
        m_lines.print(cells);
        if (m_remaining > 0 && --m_remaining == 0)
            QCoreApplication::exit(QPlcCoreApplication::Success);
    }

    void masterEnded()
    {
        if (m_remaining > 0 && m_node.error() == QPlcSlaveNode::NoError)
            QPlcCoreApplication::printError(QStringLiteral("the master has ended %1 lines too early").arg(m_remaining));
        QCoreApplication::exit(m_remaining > 0 || m_node.error() != QPlcSlaveNode::NoError
                                   ? QPlcCoreApplication::Failure
                                   : QPlcCoreApplication::Success);
    }

    ValueLines m_lines;
    QPlcIOBufferSlaveNode m_node;
    QTimer m_timer;
    QVector<QPlcSignalIndex> m_wanted;
    QPlcSignalList m_newest;  // empty: nothing since the last line
    quint64 m_cycle = 0;
    double m_period = 0.0;  // [s]
    qint64 m_pause;         // between two lines [ns]
    QDeadlineTimer m_next{0, Qt::PreciseTimer};
    qint64 m_remaining;  // lines; below 0: no end
};

}  // namespace

int echoSignals(const CommandCall &call)
{
    double rate = 10.0;
    qint64 count = -1;
    if (!call.application.number(QStringLiteral("rate"), 0.01, 1000.0, &rate)
        || (call.application.isSet(QStringLiteral("count"))
            && !call.application.integer(QStringLiteral("count"), 1, 1'000'000'000, &count)))
        return call.application.exitCode();
    const QPlcSignalTable table = call.client.table();
    if (table.isEmpty())
        return reportFailure(call.client);
    if (!knowsSignals(call.application, table, call.arguments))
        return call.application.exitCode();

    Echo echo(call, table, rate, count);
    if (!echo.printPresentValues(call.client, call.arguments))
        return reportFailure(call.client);
    if (echo.isComplete())
        return QPlcCoreApplication::Success;
    call.application.quitOnSignals();
    if (!echo.join(call.master, call.client.timeout()))
        return QPlcCoreApplication::Failure;  // the node has said why
    return QCoreApplication::exec();
}

}  // namespace tools
