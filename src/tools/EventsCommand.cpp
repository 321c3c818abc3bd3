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
        for (const QJsonValue &event : events) {
            const double sequence = event[QStringLiteral("sequence")].toDouble();
            if (sequence <= m_newest)
                continue;
            m_newest = sequence;
            if (m_isJson)
                printJson(QJsonDocument(event.toObject()));
            else
                printLine(lineOf(event.toObject()));
        }
    }
    double newest() const { return m_newest; }

private:
    static QString lineOf(const QJsonObject &event)
    {
        const auto text
            = [&event](const char *field) { return printable(event.value(QLatin1String(field)).toString()); };
        const quint64 time = text("time").toULongLong(nullptr, 16);
        return QStringLiteral("%1  %2  %3  %4  %5")
            .arg(QDateTime::fromMSecsSinceEpoch(qint64(time / 1'000'000))
                     .toString(QStringLiteral("yyyy-MM-dd HH:mm:ss.zzz")),
                 text("severity").leftJustified(7), text("kind").leftJustified(7), text("source"), text("text"));
    }

    const bool m_isJson;
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
