// SPDX-License-Identifier: Apache-2.0
// plant_listener: a listener (or, with --worker, a node that is waited for) in a process of its
// own. At its end it prints what it has heard.
#include "ListenerPlant.h"

#include <QtCore/QDateTime>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>

#include <algorithm>
#include <cstdio>
#include <deque>

namespace {

constexpr qint64 StaleAfter = 100'000'000;  // [ns] values that are older were not the newest

class Listener : public QPlcCompactSlaveNode
{
public:
    Listener()
        : QPlcCompactSlaveNode(QStringLiteral("Listener"), SilentZeroOrderHold)
    {
        setListener(true);
        for (int i = 0; i < ListenerPlant::Values; ++i)
            m_values.emplace_back(this, ("value" + QByteArray::number(i)).constData());
    }
    QJsonObject heard() const
    {
        return {{QStringLiteral("computed"), double(m_computed)},
                {QStringLiteral("missed"), double(m_missed)},
                {QStringLiteral("spanned"), double(m_last - m_first + 1)},
                {QStringLiteral("stale"), double(m_stale)},
                {QStringLiteral("pause_ms"), double(m_longestPause) * 1e-6},
                {QStringLiteral("silence_ms"), double(m_silence) * 1e-6}};
    }

private:
    void step(const QPlcCycle &cycle) override
    {
        const qint64 now = wallClock();
        const bool stale = now - m_time > StaleAfter;
        m_stale += stale ? 1 : 0;
        if (m_computed == 0)
            m_first = cycle.number() - cycle.missedCycles();  // it may have missed the first ones
        else if (now - m_lastStep > m_longestPause) {
            m_longestPause = now - m_lastStep;
            m_pauseEnd = now;
            m_silence = -1;
        }
        if (m_silence < 0 && !stale)
            m_silence = now - m_pauseEnd;
        m_lastStep = now;
        m_last = cycle.number();
        m_missed += cycle.missedCycles();
        ++m_computed;
    }
    static qint64 wallClock()
    {
        using namespace std::chrono;
        return duration_cast<nanoseconds>(system_clock::now().time_since_epoch()).count();
    }

    QPlcInput<qint64> m_time{this, "time"};
    std::deque<QPlcInput<double>> m_values;
    quint64 m_first = 0, m_last = 0, m_computed = 0, m_missed = 0, m_stale = 0;
    qint64 m_lastStep = 0, m_longestPause = 0, m_pauseEnd = 0;
    qint64 m_silence = -1;  // from the end of the longest pause to the first fresh values
};

class Worker : public QPlcCompactSlaveNode
{
public:
    Worker()
        : QPlcCompactSlaveNode(QStringLiteral("Worker"), SilentZeroOrderHold)
    {
    }

private:
    void step(const QPlcCycle &) override { m_echo = m_request; }
    QPlcInput<double> m_request{this, "request"};
    QPlcOutput<double> m_echo{this, "echo"};
};

int run(QPlcNodeApplication &application, QPlcSlaveNode &node)
{
    return application.parseNodeOptions() ? application.run(node) : application.exitCode();
}

}  // namespace

int main(int argc, char **argv)
{
    QPlcNodeApplication application(argc, argv);
    application.addOption({QStringLiteral("worker"), QStringLiteral("Be the node that is waited for.")});
    const bool isWorker = std::count(argv, argv + argc, std::string("--worker")) > 0;
    if (isWorker) {
        Worker worker;
        return run(application, worker);
    }
    Listener listener;
    const int code = run(application, listener);
    std::puts(QJsonDocument(listener.heard()).toJson(QJsonDocument::Compact).constData());
    return code;
}
