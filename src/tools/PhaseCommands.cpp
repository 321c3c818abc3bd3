// SPDX-License-Identifier: Apache-2.0
// init, arm, start, stop, safestop, reset: what brings a plant from one state to the next.
#include "Commands.h"
#include "TerminalText.h"

namespace tools {

namespace messages = qplc::messages;

namespace {

/// Asks for something that is done or not.
template<typename Request>
int command(const CommandCall &call, const Request &request, const QString &done)
{
    if (!call.connect() || !call.ask(messages::toMessage(request)))
        return call.exitCode();
    if (call.isJson()) {
        QJsonObject document = messages::toObject(request);
        document.insert(QStringLiteral("done"), QPlcMessage::kindName(Request::kind));
        printJson(QJsonDocument(document));
    } else {
        printLine(done);
    }
    return QPlcCoreApplication::Success;
}

}  // namespace

int initializeStates(const CommandCall &call)
{
    return command(call, messages::InitializeAllStates(), QStringLiteral("initialized"));
}

int armMaster(const CommandCall &call)
{
    messages::Armed armed;
    if (!call.connect() || !call.askFor(messages::Arm(), &armed))
        return call.exitCode();
    if (call.isJson())
        printJson(QJsonDocument(messages::toObject(armed)));
    else
        printLine(QStringLiteral("armed for %1 s; token %2")
                      .arg(double(armed.validFor.count()) * 1e-9)
                      .arg(QPlcMessage::fromHex64(armed.token)));
    return QPlcCoreApplication::Success;
}

int resetMaster(const CommandCall &call)
{
    return command(call, messages::Reset(), QStringLiteral("reset"));
}

int stopSafely(const CommandCall &call)
{
    return command(call, messages::SafeStop{call.arguments.join(QLatin1Char(' '))}, QStringLiteral("stopped safely"));
}

namespace {

/// The token of a start, where the master requires one. \return false, with the message out
bool armIfRequired(const CommandCall &call, QString *token)
{
    messages::State state;
    messages::Armed armed;
    if (!call.connect() || !call.ask(messages::GetState(), &state))
        return false;
    if (!state.armingRequired)
        return true;
    if (state.state == messages::MasterState::Off && !call.ask(QPlcMessage(QPlcMessage::InitializeAllStates)))
        return false;  // a start would have done it, but permits are given in Ready
    if (!call.askFor(messages::Arm(), &armed))
        return false;
    *token = QPlcMessage::fromHex64(armed.token);
    return true;
}

}  // namespace

int startRealTime(const CommandCall &call)
{
    constexpr qint64 mostCycles = 1'000'000'000'000;
    qint64 cycles = 0;
    QString token = call.application.value(QStringLiteral("token"));
    if (!call.readInteger("cycles", 1, mostCycles, &cycles))
        return call.exitCode();
    if (token.isEmpty() ? !armIfRequired(call, &token) : !call.connect())
        return call.exitCode();
    QJsonObject fields;
    QJsonObject document{{QStringLiteral("done"), QStringLiteral("StartRealTime")}};
    if (!token.isEmpty())
        fields.insert(QStringLiteral("token"), token);
    if (cycles > 0) {
        fields.insert(QStringLiteral("cycles"), cycles);
        document.insert(QStringLiteral("cycles"), cycles);
    }
    if (!call.ask(QPlcMessage(QPlcMessage::StartRealTime, fields)))
        return call.exitCode();
    if (call.isJson())
        printJson(QJsonDocument(document));
    else if (cycles == 0)
        printLine(QStringLiteral("started"));
    else
        printLine(QStringLiteral("started for %1 %2")
                      .arg(cycles)
                      .arg(cycles == 1 ? QStringLiteral("cycle") : QStringLiteral("cycles")));
    return QPlcCoreApplication::Success;
}

int stopRealTime(const CommandCall &call)
{
    return command(call, messages::Stop(), QStringLiteral("stopped"));
}

}  // namespace tools
