// SPDX-License-Identifier: Apache-2.0
// init, arm, start, stop, safestop, reset: what brings a plant from one state to the next; evict
// and admit: who takes part; note: what a person says.
#include "Commands.h"
#include "TerminalText.h"

namespace tools {

namespace messages = qplc::messages;

namespace {

/// Tells that \a request was carried out.
template<typename Request>
int tellDone(const CommandCall &call, const Request &request, const QString &done)
{
    if (call.isJson()) {
        QJsonObject document = messages::toObject(request);
        document.insert(QStringLiteral("done"), QPlcMessage::kindName(Request::kind));
        printJson(QJsonDocument(document));
    } else {
        printLine(done);
    }
    return QPlcCoreApplication::Success;
}

/// Asks for something that is done or not.
template<typename Request>
int command(const CommandCall &call, const Request &request, const QString &done)
{
    return call.connect() && call.ask(request) ? tellDone(call, request, done) : call.exitCode();
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
        printJson(call.client.lastAnswer());
    else
        printLine(QStringLiteral("armed for %1 s; token %2")
                      .arg(double(armed.validFor.count()) * 1e-9)
                      .arg(QPlcMessage::fromHex64(armed.token)));
    return QPlcCoreApplication::Success;
}

int resetMaster(const CommandCall &call)
{
    messages::State state;
    if (!call.connect() || !call.askFor(messages::GetState(), &state))
        return call.exitCode();
    const messages::Reset reset{state.latch};
    if (!call.ask(reset))
        return call.exitCode();
    return tellDone(call, reset,
                    messages::isLatched(state.state) ? QStringLiteral("reset: %1").arg(printable(state.reason))
                                                     : QStringLiteral("reset"));
}

int evict(const CommandCall &call)
{
    const QString name = call.arguments.value(0);
    return command(call, messages::Evict{name}, QStringLiteral("evicted: %1").arg(printable(name)));
}

int admit(const CommandCall &call)
{
    const QString name = call.arguments.value(0);
    return command(call, messages::Admit{name}, QStringLiteral("admitted: %1").arg(printable(name)));
}

int writeNote(const CommandCall &call)
{
    const QString text = call.arguments.join(QLatin1Char(' '));
    return command(call, messages::Note{text, {}}, QStringLiteral("noted: %1").arg(printable(text)));
}

int stopSafely(const CommandCall &call)
{
    return command(call, messages::SafeStop{call.arguments.join(QLatin1Char(' '))}, QStringLiteral("stopped safely"));
}

namespace {

/// The option --token. \return false, with the message out, when its value is no token
bool readToken(const CommandCall &call, std::optional<messages::Hex64> *token)
{
    const QString text = call.application.value(QStringLiteral("token"));
    if (text.isEmpty() || messages::Wire<std::optional<messages::Hex64>>::fromJson(text, token))
        return true;
    call.application.usageError(
        QStringLiteral("'%1' is not a token; use the one that qtplc arm prints: 16 hexadecimal digits").arg(text));
    return false;
}

/// The token of a start, where the master requires one. \return false, with the message out
bool armIfRequired(const CommandCall &call, std::optional<messages::Hex64> *token)
{
    messages::State state;
    messages::Armed armed;
    if (!call.connect() || !call.ask(messages::GetState(), &state))
        return false;
    if (!state.armingRequired)
        return true;
    if (state.state == messages::MasterState::Off && !call.ask(messages::InitializeAllStates()))
        return false;  // a start would have done it, but permits are given in Ready
    if (!call.askFor(messages::Arm(), &armed))
        return false;
    *token = armed.token;
    return true;
}

}  // namespace

int startRealTime(const CommandCall &call)
{
    constexpr qint64 mostCycles = 1'000'000'000'000;
    qint64 cycles = 0;
    messages::StartRealTime start;
    if (!readToken(call, &start.token) || !call.readInteger("cycles", 1, mostCycles, &cycles))
        return call.exitCode();
    if (start.token ? !call.connect() : !armIfRequired(call, &start.token))
        return call.exitCode();
    if (cycles > 0)
        start.cycles = quint64(cycles);
    if (!call.ask(start))
        return call.exitCode();
    start.token.reset();  // it is used up
    return tellDone(call, start,
                    cycles == 0       ? QStringLiteral("started")
                        : cycles == 1 ? QStringLiteral("started for 1 cycle")
                                      : QStringLiteral("started for %1 cycles").arg(cycles));
}

int stopRealTime(const CommandCall &call)
{
    return command(call, messages::Stop(), QStringLiteral("stopped"));
}

}  // namespace tools
