// SPDX-License-Identifier: Apache-2.0
// events: what has happened in the master, and what happens.
#include "Commands.h"
#include "TerminalText.h"

#include <QtCore/QDateTime>
#include <QtCore/QJsonArray>

namespace tools {

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
    void print(const QPlcMessage &message)
    {
        const QJsonArray events = message.fields().value(QStringLiteral("events")).toArray();
        for (const QJsonValue &event : events)
            m_sourceWidth = qBound(m_sourceWidth, displayWidth(printable(event[QStringLiteral("source")].toString())),
                                   longestSource);
        for (const QJsonValue &event : events) {
            const double sequence = event[QStringLiteral("sequence")].toDouble();
            if (sequence <= m_newest)
                continue;
            m_newest = sequence;
            if (m_isJson)
                printJson(QJsonDocument(event.toObject()));
            else
                printLineOf(event.toObject());
        }
    }
    double newest() const { return m_newest; }

private:
    void printLineOf(const QJsonObject &event) const
    {
        const auto text
            = [&event](const char *field) { return printable(event.value(QLatin1String(field)).toString()); };
        const quint64 time = text("time").toULongLong(nullptr, 16);
        const QString gap = QStringLiteral("  ");
        const QString when = QDateTime::fromMSecsSinceEpoch(qint64(time / 1'000'000))
                                 .toString(QStringLiteral("yyyy-MM-dd HH:mm:ss.zzz"))
            + gap;
        const QString severity = padded(text("severity"), 7);
        const QString rest = gap + padded(text("kind"), 7) + gap + padded(text("source"), m_sourceWidth) + gap;
        printWrapped(when + toned(severity, toneOf(text("severity"))) + rest, displayWidth(when + severity + rest),
                     text("text"));
    }
    static Tone toneOf(const QString &severity)
    {
        return severity == QLatin1String("error")  ? Tone::Bad
            : severity == QLatin1String("warning") ? Tone::Caution
                                                   : Tone::Plain;
    }

    static constexpr int longestSource = 12;  // that columns are made for

    const bool m_isJson;
    int m_sourceWidth = 0;  // of the widest so far
    double m_newest = 0.0;
};

/// Prints the events that the master still has. \return false, with the message out, when the master does not answer
bool printBacklog(const CommandCall &call, EventPrinter *printer)
{
    for (bool more = true; more;) {
        QPlcMessage answer;
        const double since = printer->newest();
        if (!call.askFor(QPlcMessage::GetEvents, QPlcMessage::Events, {{QStringLiteral("since"), since}}, &answer))
            return false;
        printer->print(answer);
        more = answer.fields().value(QStringLiteral("more")).toBool() && printer->newest() > since;
    }
    return true;
}

int follow(const CommandCall &call)
{
    QObject::connect(&call.client, &ControlClient::lost, &call.application,
                     [] { QPlcCoreApplication::exit(QPlcCoreApplication::Failure); });
    const int exitCode = QPlcCoreApplication::exec();
    if (exitCode != QPlcCoreApplication::Success)
        QPlcCoreApplication::printError(call.client.errorString());
    return exitCode;
}

}  // namespace

int showEvents(const CommandCall &call)
{
    const bool isFollowing = call.application.isSet(QStringLiteral("follow"));
    EventPrinter printer(call.isJson());
    if (isFollowing) {
        call.client.offer(QStringLiteral("events"));
        QObject::connect(&call.client, &ControlClient::pushed, &call.application,
                         [&printer](const QPlcMessage &message) { printer.print(message); });
    }
    if (!call.connect() || !printBacklog(call, &printer))
        return call.exitCode();
    if (!isFollowing)
        return QPlcCoreApplication::Success;
    call.application.quitOnSignals();
    return follow(call);
}

}  // namespace tools
