// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "SignalSelection.h"
#include "TerminalText.h"

#include <QtCore/QJsonArray>
#include <QtCore/QTimer>

#include <cmath>

namespace tools {

namespace messages = qplc::messages;

namespace {

constexpr double longestDuration = 1e6;  // [s]

/// What is to be set, in the order of the command line.
struct Settings
{
    QVector<QPlcSignalDefinition> definitions;
    messages::SetSignals message;
};

/// Reads "SIGNAL VALUE SIGNAL VALUE ...". \return false, with the message out, when a value cannot
/// be meant
bool readValues(const CommandCall &call, const QPlcSignalTable &table, Settings *settings)
{
    for (int i = 0; i < call.arguments.size(); i += 2) {
        QStringList names;
        if (!selectSignals(call.application, table, {call.arguments.at(i)}, &names))
            return false;
        QString error;
        const QPlcSignalDefinition &definition = table.at(table.indexOf(names.constFirst()));
        const QPlcValue value = definition.valueFromText(call.arguments.at(i + 1), &error);
        if (!value.isValid())
            error = QStringLiteral("signal '%1': %2").arg(definition.name, error);
        else if (settings->message.values.contains(definition.name))
            error = QStringLiteral("signal '%1' is there twice; give it one value").arg(definition.name);
        if (!error.isEmpty()) {
            call.application.usageError(error);
            return false;
        }
        settings->message.values.insert(definition.name, value.toString());
        settings->definitions << definition;
    }
    return true;
}

void print(const CommandCall &call, const Settings &settings, double duration)
{
    QJsonObject values;
    for (const QPlcSignalDefinition &definition : settings.definitions) {
        const QString text = settings.message.values.value(definition.name);
        values.insert(definition.name, toJson(definition, text));
        if (!call.isJson())
            printLine(QStringLiteral("%1 = %2").arg(
                definition.name,
                withUnit(definition.textOf(QPlcValue::fromString(definition.type, text)), definition.unit)));
    }
    QJsonObject document{{QStringLiteral("values"), values}};
    if (duration > 0.0)
        document.insert(QStringLiteral("duration"), duration);
    if (call.isJson())
        printJson(QJsonDocument(document));
}

/// Keeps the connection for as long as the values are to stay: its end would end them.
int waitForTheEnd(const CommandCall &call, double duration)
{
    QObject::connect(&call.client, &BlockingClient::lost, &call.application,
                     [] { QPlcCoreApplication::exit(QPlcCoreApplication::Failure); });
    QTimer::singleShot(std::chrono::milliseconds(qint64(std::ceil(duration * 1e3)) + 1), Qt::PreciseTimer,
                       &call.application, [] { QPlcCoreApplication::quit(); });
    const int exitCode = QPlcCoreApplication::exec();
    if (exitCode != QPlcCoreApplication::Success)
        QPlcCoreApplication::printError(call.client.errorString());
    return exitCode;
}

}  // namespace

int setSignals(const CommandCall &call)
{
    double duration = 0.0;  // [s]; 0: for good
    Settings settings;
    if (!call.readNumber("for", 0.001, longestDuration, &duration))
        return call.exitCode();
    if (call.arguments.size() % 2 != 0)
        return call.application.usageError(
            QStringLiteral("signal '%1' has no value; use qtplc set SIGNAL VALUE ...").arg(call.arguments.constLast()));
    for (int i = 0; i < call.arguments.size(); i += 2) {
        if (isPattern(call.arguments.at(i)))
            return call.application.usageError(
                QStringLiteral("'%1' is a pattern; set takes names only").arg(call.arguments.at(i)));
    }
    QPlcSignalTable table;
    if (duration > 0.0)
        settings.message.duration = std::chrono::nanoseconds(std::llround(duration * 1e9));
    if (!call.connect(&table) || !readValues(call, table, &settings) || !call.ask(settings.message))
        return call.exitCode();
    if (duration > 0.0)
        call.application.quitOnSignals();
    print(call, settings, duration);
    return duration > 0.0 ? waitForTheEnd(call, duration) : QPlcCoreApplication::Success;
}

}  // namespace tools
