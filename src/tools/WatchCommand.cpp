// SPDX-License-Identifier: Apache-2.0
#include "EchoCommand.h"
#include "FullScreen.h"
#include "SignalListener.h"
#include "SignalSelection.h"
#include "TerminalText.h"
#include "WatchTable.h"
#include "node/state/StateText.h"
#include "realtime/TimeSource.h"

#include <cmath>

namespace tools {

namespace {

double now()  // [s]
{
    return double(qplc::monotonicNow()) * 1e-9;
}

/// What a listener hears, as a table on the whole terminal.
class Watch : public QObject
{
public:
    Watch(SignalListener &listener, const QString &master, double rate)
        : m_listener(listener)
        , m_master(master)
        , m_table(listener.definitions())
    {
        connect(&listener, &SignalListener::heard, this, &Watch::takeCycles);
        connect(&listener, &SignalListener::valuesAtRest, this,
                [this](const QVector<QPlcValue> &values, const QVector<QPlcQuality> &qualities) {
                    m_table.update(values, now(), qualities);
                });
        connect(&listener, &SignalListener::masterEnded, this, [this] {
            QCoreApplication::exit(m_listener.isSound() ? QPlcCoreApplication::Success : QPlcCoreApplication::Failure);
        });
        connect(&m_screen, &FullScreen::pressed, this, &Watch::obey);
        connect(&m_paint, &QTimer::timeout, this, [this] { paint(); });
        connect(&m_refresh, &QTimer::timeout, &listener, &SignalListener::askForState);
        m_paint.start(int(std::lround(1e3 / rate)));
        m_refresh.start(refreshPause);
        listener.askForState();
        paint();
    }

private:
    static constexpr int refreshPause = 500;  // [ms]
    static constexpr int headLines = 2;
    static constexpr int titleLines = 1;

    void takeCycles(const QVector<SignalListener::Sample> &samples)
    {
        for (const SignalListener::Sample &sample : samples) {
            m_table.update(sample.values, now(), sample.qualities);
            m_cycle = sample.cycle;
        }
        if (!samples.isEmpty())
            m_heardAt = now();
    }

    void obey(FullScreen::Key key)
    {
        switch (key) {
        case FullScreen::Quit:
            QCoreApplication::quit();
            return;
        case FullScreen::Up:
            --m_first;
            break;
        case FullScreen::Down:
            ++m_first;
            break;
        case FullScreen::PageUp:
            m_first -= rowsThatFit();
            break;
        case FullScreen::PageDown:
            m_first += rowsThatFit();
            break;
        case FullScreen::Home:
            m_first = 0;
            break;
        case FullScreen::End:
            m_first = m_table.rowCount();
            break;
        case FullScreen::Reset:
            m_table.forgetExtremes();
            break;
        }
        paint();
    }

    static int rowsThatFit() { return qMax(1, terminalSize().lines - headLines - titleLines); }

    QString head() const
    {
        QString text = QStringLiteral("%1  %2").arg(
            m_master, toned(qplc::stateText(m_listener.state()), toneOfState(m_listener.state())));
        if (m_listener.isRunning() && m_heardAt > 0.0)
            text += QStringLiteral("  cycle %1  %2 s").arg(m_cycle).arg(m_listener.timeOf(m_cycle), 0, 'f', 2);
        constexpr double silence = 1.0;  // [s]
        if (m_listener.isRunning() && m_heardAt > 0.0 && now() - m_heardAt > silence)
            text += QLatin1String("  ")
                + toned(QStringLiteral("nothing heard for %1 s").arg(now() - m_heardAt, 0, 'f', 0), Tone::Bad);
        return text;
    }

    QString keysText() const
    {
        const int last = qMin(m_first + rowsThatFit(), m_table.rowCount());
        const QString keys = QStringLiteral("q ends, r forgets min and max");
        return m_table.rowCount() <= rowsThatFit() ? keys
                                                   : QStringLiteral("rows %1-%2 of %3, arrows scroll, %4")
                                                         .arg(m_first + 1)
                                                         .arg(last)
                                                         .arg(m_table.rowCount())
                                                         .arg(keys);
    }

    void paint()
    {
        const TerminalSize size = terminalSize();
        m_first = qBound(0, m_first, qMax(0, m_table.rowCount() - rowsThatFit()));
        QStringList lines{head(), keysText()};
        lines += m_table.lines(m_first, size.columns, size.lines - headLines, now());
        m_screen.show(lines);
    }

    SignalListener &m_listener;
    QString m_master;
    WatchTable m_table;
    FullScreen m_screen;
    QTimer m_paint;
    QTimer m_refresh;
    int m_first = 0;
    quint64 m_cycle = 0;
    double m_heardAt = 0.0;  // [s]; 0: never
};

int watchOnTerminal(const CommandCall &call, const QPlcSignalTable &table, const QStringList &names,
                    const LineRate &rate)
{
    constexpr int listenPause = 20;  // [ms]
    SignalListener listener(call, QStringLiteral("watch"), table, names, listenPause);
    listener.setInterval(int(rate.every));
    const auto endIsWanted = call.quitOnSignals();
    const bool hasJoined = listener.join();
    if (*endIsWanted || !hasJoined)
        return *endIsWanted ? QPlcCoreApplication::Success : QPlcCoreApplication::Failure;
    Watch watch(listener, placeText(call.master), rate.rate);
    return QCoreApplication::exec();
}

}  // namespace

int watchSignals(const CommandCall &call)
{
    LineRate rate;
    QPlcSignalTable table;
    QStringList names;
    if (!call.readNumber("rate", 0.01, 100.0, &rate.rate) || !readEvery(call, &rate.every) || !call.connect(&table)
        || !selectSignalsOrAll(call.application, table, call.arguments, &names))
        return call.exitCode();
    return isScreen() && !call.isJson() ? watchOnTerminal(call, table, names, rate)
                                        : printLines(call, table, names, rate);
}

}  // namespace tools
