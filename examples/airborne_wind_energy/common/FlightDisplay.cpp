// SPDX-License-Identifier: Apache-2.0
#include "FlightDisplay.h"

#include <QtCore/QMutex>

#include <cstdio>
#include <sys/ioctl.h>
#include <unistd.h>

namespace awe {

namespace {

const char *const signalNames[] = {
    "flightPhase", "bodyPosition_earth", "windVelocity_earth", "tetherLength", "tetherForce_earth", "power", "energy",
    "crashed"};

// Alternate screen, no cursor, no line wrap; and back.
const char *const takeScreen = "\033[?1049h\033[?25l\033[?7l\033[2J";
const char *const giveScreenBack = "\033[?7h\033[?25h\033[?1049l";

struct TerminalSize
{
    int columns = 80;
    int rows = 24;
};

TerminalSize terminalSize()
{
    winsize size = {};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 0)
        return {int(size.ws_col), int(size.ws_row)};
    return {};
}

void write(const QByteArray &text)
{
    std::fwrite(text.constData(), 1, std::size_t(text.size()), stderr);
    std::fflush(stderr);
}

/// Keeps what is logged while the picture is on the screen, from any thread.
class HeldMessages
{
public:
    void hold() { m_previous = qInstallMessageHandler(&HeldMessages::take); }

    void release()
    {
        qInstallMessageHandler(m_previous);
        const QMutexLocker lock(&m_mutex);
        for (const QString &text : qAsConst(m_texts))
            write(text.toUtf8() + '\n');
        m_texts.clear();
    }

    QString newest()
    {
        const QMutexLocker lock(&m_mutex);
        return m_texts.isEmpty() ? QString() : m_texts.constLast();
    }

    static HeldMessages &instance()
    {
        static HeldMessages messages;
        return messages;
    }

private:
    static void take(QtMsgType type, const QMessageLogContext &context, const QString &text)
    {
        const QMutexLocker lock(&instance().m_mutex);
        instance().m_texts << qFormatLogMessage(type, context, text);
    }

    QMutex m_mutex;
    QStringList m_texts;
    QtMessageHandler m_previous = nullptr;
};

Eigen::Vector3d vectorOf(const QPlcValue &value)
{
    return Eigen::Vector3d(value.toReal(0), value.toReal(1), value.toReal(2));
}

/// Whether the terminal is that of this program now. In the background of a shell it is not: what a
/// person types and reads there stays as it is.
bool isInForeground()
{
    const pid_t foreground = ::tcgetpgrp(STDERR_FILENO);
    return foreground < 0 || foreground == ::getpgrp();
}

/// Whether the lines of logLine() are wanted.
bool isForScript(FlightDisplay::Kind kind, double duration)
{
    return kind == FlightDisplay::Line && duration >= 1.0 && !FlightDisplay::hasTerminal()
        && qgetenv("QTPLC_PROGRESS") == "lines";
}

}  // namespace

bool FlightDisplay::hasTerminal()
{
    return ::isatty(STDERR_FILENO) != 0 && qgetenv("TERM") != "dumb";
}

FlightDisplay::FlightDisplay(QPlcMasterNode &master, double duration, Kind kind)
    : m_master(master)
    , m_duration(duration)
    , m_kind(kind)
    , m_view(duration, qEnvironmentVariableIsEmpty("NO_COLOR"))
    , m_listener(QStringLiteral("FlightView"))
{
    if (isForScript(kind, duration)) {
        m_timer.setInterval(1000);
        connect(&m_timer, &QTimer::timeout, this, &FlightDisplay::logLine);
    }
    if (!hasTerminal())
        return;
    m_timer.setInterval(kind == Picture ? 100 : 200);
    connect(&m_timer, &QTimer::timeout, this, kind == Picture ? &FlightDisplay::drawPicture : &FlightDisplay::drawLine);
    if (kind == Picture)
        m_valid = joinMaster();
}

FlightDisplay::~FlightDisplay()
{
    end();
    m_master.removeLocalNode(&m_listener);
}

bool FlightDisplay::joinMaster()
{
    QPlcSignalIndexList indices;
    for (const char *name : signalNames)
        indices.insert(QString::fromLatin1(name));
    m_listener.setInputSignalIndices(indices);
    m_listener.setBufferSize(5000);
    return m_master.addLocalNode(&m_listener);
}

void FlightDisplay::begin()
{
    if ((!hasTerminal() && !isForScript(m_kind, m_duration)) || m_timer.isActive())
        return;
    if (m_kind == Picture) {
        HeldMessages::instance().hold();
        write(takeScreen);
    }
    m_timer.start();
}

void FlightDisplay::end()
{
    if (!m_timer.isActive())
        return;
    m_timer.stop();
    if (!hasTerminal() || (m_kind == Line && !isInForeground()))
        return;
    write(m_kind == Picture ? giveScreenBack : "\r\033[K");
    if (m_kind == Picture)
        HeldMessages::instance().release();
}

FlightMoment FlightDisplay::momentOf(const QPlcSignalList &values, double time) const
{
    const auto value = [&values](const char *name) { return values.value(QString::fromLatin1(name)); };
    FlightMoment moment;
    moment.time = time;
    moment.phase = FlightPhase(value("flightPhase").toInt());
    moment.position = vectorOf(value("bodyPosition_earth"));
    moment.windVelocity = vectorOf(value("windVelocity_earth"));
    moment.tetherLength = value("tetherLength").toReal();
    moment.tetherForce = vectorOf(value("tetherForce_earth")).norm();
    moment.power = value("power").toReal();
    moment.energy = value("energy").toReal();
    moment.crashed = value("crashed").toBool();
    return moment;
}

void FlightDisplay::drawLine()
{
    if (!isInForeground())
        return;
    QPlcSignalList values;
    for (const char *name : signalNames)
        values.insert(QString::fromLatin1(name), m_master.signalValue(QString::fromLatin1(name)));
    const double period = std::chrono::duration<double>(m_master.interval()).count();
    const QString line = progressLine(momentOf(values, double(m_master.cycle()) * period), m_duration);
    write("\r" + line.left(terminalSize().columns - 1).toUtf8() + "\033[K");
}

void FlightDisplay::logLine()
{
    const double time = std::chrono::duration<double>(m_master.interval()).count() * double(m_master.cycle());
    write(QStringLiteral("progress: %1 of %2\n").arg(qint64(time)).arg(qint64(m_duration)).toUtf8());
}

void FlightDisplay::drawPicture()
{
    const double period = std::chrono::duration<double>(m_master.interval()).count();
    QVector<quint64> cycles;
    const QList<QPlcSignalList> batch = m_listener.takeInputSignals(&cycles);
    for (int i = 0; i < batch.size(); ++i)
        m_view.add(momentOf(batch.at(i), double(cycles.at(i)) * period));
    const TerminalSize size = terminalSize();
    QByteArray text = "\033[H";
    const QStringList lines = m_view.draw(size.columns, size.rows - 1);
    for (const QString &line : lines)
        text += "\033[2K" + line.toUtf8() + "\r\n";
    write(text + "\033[J" + HeldMessages::instance().newest().left(size.columns).toUtf8());
}

}  // namespace awe
