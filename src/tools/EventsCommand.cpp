// SPDX-License-Identifier: Apache-2.0
// events: what has happened in the master, and what happens.
#include "RecordingChoice.h"
#include "TerminalText.h"
#include "node/statistics/EventFile.h"
#include "protocol/messages/StoredEvent.h"
#include "recording/Happenings.h"

#include <QtCore/QDateTime>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>

namespace tools {

namespace messages = qplc::messages;

namespace {

/// "2026-01-31 12:00:00.123  warning  node     Winch  text", or an object in a line.
class EventPrinter
{
public:
    explicit EventPrinter(bool isJson)
        : m_isJson(isJson)
    {
    }
    /// Prints those that were not printed yet: what is pushed and what is asked for may overlap.
    void print(const std::vector<messages::EventEntry> &events)
    {
        for (const messages::EventEntry &event : events)
            makeRoomFor(event);
        for (const messages::EventEntry &event : events) {
            if (event.sequence > m_newest)
                printOne(event);
        }
    }
    /// Prints all of them: several masters may have written them, one after the other.
    void print(const std::vector<messages::StoredEvent> &events)
    {
        for (const messages::StoredEvent &event : events)
            makeRoomFor(event);
        for (const messages::StoredEvent &event : events) {
            const bool isNewRun = std::exchange(m_run, event.run) != event.run;
            if (!isNewRun && event.sequence > m_newest + 1 && !m_isJson)
                printText(QStringLiteral("... %1 events are missing here\n").arg(event.sequence - m_newest - 1));
            printOne(event);
        }
    }
    quint64 newest() const { return m_newest; }

private:
    void makeRoomFor(const messages::EventEntry &event)
    {
        m_sourceWidth = qBound(m_sourceWidth, displayWidth(printable(event.source)), longestSource);
    }
    template<typename Event>
    void printOne(const Event &event)
    {
        m_newest = event.sequence;
        if (m_isJson)
            printJson(QJsonDocument(messages::toObject(event)));
        else
            printLineOf(event);
    }
    void printLineOf(const messages::EventEntry &event) const
    {
        const QString gap = QStringLiteral("  ");
        const QString when = QDateTime::fromMSecsSinceEpoch(qint64(event.time / 1'000'000))
                                 .toString(QStringLiteral("yyyy-MM-dd HH:mm:ss.zzz"))
            + gap;
        const QString severity = padded(printable(event.severity), 7);
        const QString rest
            = gap + padded(printable(event.kind), 7) + gap + padded(printable(event.source), m_sourceWidth) + gap;
        printWrapped(when + toned(severity, toneOf(event.severity)) + rest, displayWidth(when + severity + rest),
                     printable(event.text));
    }
    static Tone toneOf(const QString &severity)
    {
        const auto known = messages::valueNamed<messages::Severity>(severity);
        return known == messages::Severity::Error  ? Tone::Bad
            : known == messages::Severity::Warning ? Tone::Caution
                                                   : Tone::Plain;
    }

    static constexpr int longestSource = 12;  // that columns are made for

    const bool m_isJson;
    int m_sourceWidth = 0;  // of the widest so far
    quint64 m_newest = 0;
    quint64 m_run = 0;
};

/// Prints the events that the master still has. \return false, with the message out, when the
/// master does not answer
bool printBacklog(const CommandCall &call, EventPrinter *printer)
{
    constexpr int mostAnswers = 100;  // a master keeps 1000 events, and sends 200 in an answer
    bool more = true;
    for (int i = 0; more && i < mostAnswers; ++i) {
        messages::Events answer;
        const quint64 since = printer->newest();
        if (!call.askFor(messages::GetEvents{since}, &answer))
            return false;
        printer->print(answer.events);
        more = answer.more.value_or(false) && printer->newest() > since;
    }
    return true;
}

int follow(const CommandCall &call)
{
    QObject::connect(&call.client, &BlockingClient::lost, &call.application,
                     [] { QPlcCoreApplication::exit(QPlcCoreApplication::Failure); });
    const int exitCode = QPlcCoreApplication::exec();
    if (exitCode != QPlcCoreApplication::Success)
        QPlcCoreApplication::printError(call.client.errorString());
    return exitCode;
}

/// Prints the events of a file. \return false, with the message out, when it cannot be read, or has
/// lines that are no events
bool printFile(const QString &path, EventPrinter *printer)
{
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly)) {
        QPlcCoreApplication::printError(QStringLiteral("cannot read %1: %2").arg(path, file.errorString()));
        return false;
    }
    std::vector<messages::StoredEvent> events;
    int unreadable = 0;
    while (!file.atEnd()) {
        messages::StoredEvent event;
        if (event.fromLine(file.readLine()))
            events.push_back(event);
        else
            ++unreadable;
    }
    printer->print(events);
    if (unreadable > 0)
        QPlcCoreApplication::printError(QStringLiteral("%1: %2 lines are not events").arg(path).arg(unreadable));
    return unreadable == 0;
}

/// The oldest file first.
int showStored(const QString &path, bool isJson)
{
    EventPrinter printer(isJson);
    bool isReadable = true;
    for (int number = qplc::EventFile::mostFiles - 1; number >= 0; --number) {
        const QString each = qplc::EventFile::numbered(path, number);
        if (number == 0 || QFile::exists(each))
            isReadable = printFile(each, &printer) && isReadable;
    }
    return isReadable ? QPlcCoreApplication::Success : QPlcCoreApplication::Failure;
}

// ---- recordings ----

bool isRecording(const QString &path)
{
    return QFileInfo(path).isDir() || path.endsWith(QLatin1String(".mcap"));
}

/// "12:00:00.123  1234  info     command  Anna  text"
void printHappening(const qplc::Recording &recording, const qplc::Happening &happening)
{
    const QString gap = QStringLiteral("  ");
    const QString when = recording.isTimed() ? QDateTime::fromMSecsSinceEpoch(happening.wallTime / 1'000'000)
                                                   .toString(QStringLiteral("yyyy-MM-dd HH:mm:ss.zzz"))
                                             : QString::number(double(happening.time) * 1e-9, 'f', 3).rightJustified(9);
    const QString severity = padded(happening.severity(), 7);
    const QString begin = when + gap + QString::number(happening.cycle()).rightJustified(8) + gap;
    const QString rest = gap + padded(printable(happening.kind()), 8) + gap;
    const Tone tone = happening.severity() == QLatin1String("error") ? Tone::Bad
        : happening.severity() == QLatin1String("warning")           ? Tone::Caution
                                                                     : Tone::Plain;
    printWrapped(begin + toned(severity, tone) + rest, displayWidth(begin + severity + rest), happening.sentence());
}

/// What people and programs did, beside the events.
int showRecorded(const CommandCall &call, const QString &path, const QString &signal)
{
    qplc::Recording recording;
    if (!openRecording(call, path, &recording))
        return QPlcCoreApplication::UsageError;
    if (!signal.isEmpty() && recording.indexOf(signal) < 0)
        return call.application.usageError(recording.table().unknownSignalText(signal));
    const int topics
        = qplc::Happening::Command | qplc::Happening::Lease | (signal.isEmpty() ? qplc::Happening::Event : 0);
    qplc::HappeningReader reader(recording, topics);
    for (qplc::Happening happening; reader.next(&happening);) {
        if (!signal.isEmpty() && !happening.isAbout(signal))
            continue;
        if (call.isJson())
            printJson(QJsonDocument(happening.toJson()));
        else
            printHappening(recording, happening);
    }
    return exitCodeOf(recording, reader.damages());
}

}  // namespace

int showEvents(const CommandCall &call)
{
    const bool isFollowing = call.application.isSet(QStringLiteral("follow"));
    const QString file = call.application.value(QStringLiteral("file"));
    const QString signal = call.application.value(QStringLiteral("signal"));
    if (isFollowing && !file.isEmpty())
        return call.application.usageError(
            QStringLiteral("--follow needs a master, and --file none; use tail -F FILE"));
    if (!signal.isEmpty() && !isRecording(file))
        return call.application.usageError(
            QStringLiteral("--signal needs a recording: qtplc events --file flight.mcap --signal %1").arg(signal));
    if (call.application.isSet(QStringLiteral("file")))
        return isRecording(file) ? showRecorded(call, file, signal) : showStored(file, call.isJson());
    EventPrinter printer(call.isJson());
    if (isFollowing) {
        call.client.control().offer(messages::feature::events);
        QObject::connect(&call.client.control(), &qplc::ControlClient::unasked, &call.application,
                         [&printer](const QPlcMessage &message) {
                             if (const auto events = messages::readAs<messages::Events>(message))
                                 printer.print(events->events);
                         });
    }
    if (!call.connect() || !printBacklog(call, &printer))
        return call.exitCode();
    if (!isFollowing)
        return QPlcCoreApplication::Success;
    call.application.quitOnSignals();
    return follow(call);
}

}  // namespace tools
