// SPDX-License-Identifier: Apache-2.0
#include "Intruder.h"

#include "Operator.h"
#include "PlantKeys.h"

using Message = QPlcMessage;

namespace soak {

namespace {

constexpr int LongestSettling = 10'000;  // [ms]
constexpr int TurnsOfAHandshake = 5;     // a handshake is work for the master, with a wrong key, too

/// What an observer may not send.
Message forbidden(int number)
{
    const QString drive = QStringLiteral("n0.drive");
    switch (number % 7) {
    case 0:
        return Message(Message::StartRealTime);
    case 1:
        return Message(Message::Arm);
    case 2:
        return Message(Message::InitializeAllStates);
    case 3:
        return Message(Message::Reset);
    case 4:
        return Message(Message::SetSignals, {{QStringLiteral("values"), QJsonObject{{drive, 1.0}}}});
    case 5:
        return Message(Message::TakeLease, {{QStringLiteral("signals"), QJsonArray{drive}}});
    default:
        return Message(Message::ReleaseLease, {{QStringLiteral("signals"), QJsonArray{drive}}});
    }
}

}  // namespace

Intruder::Intruder(quint16 port, int attempts, quint64 seed, const QString &folder, HistoryWriter &history)
    : m_port(port)
    , m_attempts(attempts * Interval / 1000)
    , m_folder(folder)
    , m_history(history)
    , m_strangers(seed)
{
    connect(&m_timer, &QTimer::timeout, this, &Intruder::tryAgain);
    if (m_attempts == 0)
        return;
    enterAsObserver();
    const qint64 end
        = Operator::now() + LongestSettling;  // the runner has other work, and a handshake has to end in time
    while (!m_isObserverIn && Operator::now() < end)
        Operator::wait(Interval);
    m_timer.start(Interval);
}

Intruder::~Intruder() = default;

void Intruder::end()
{
    m_timer.stop();
    const qint64 end = Operator::now() + LongestSettling;
    while (!isSettled() && Operator::now() < end) {
        Operator::wait(Interval);
        m_ended += quint64(m_strangers.leaveEnded());
    }
    if (m_attempts > 0)
        record();
}

void Intruder::record()
{
    m_history.append(Record::Attempts, -1, {m_made, m_ended, m_commands, m_denials});
}

void Intruder::tryAgain()
{
    m_ended += quint64(m_strangers.leaveEnded());
    const int commands = m_attempts / 2;
    m_made += quint64(m_strangers.sendGarbage(m_port, m_attempts - commands));
    m_made += quint64(m_strangers.sendCommands(m_port, commands));
    if (++m_turn % TurnsOfAHandshake == 0)
        knockWithWrongKey();
    command();
    record();
}

void Intruder::knockWithWrongKey()
{
    if (m_liar)
        return;  // has no answer yet
    m_liar = std::make_unique<QPlcMasterSocket>();
    m_liar->setSecurity(PlantKeys::ofStranger(m_folder));
    connect(m_liar.get(), &QPlcAbstractSocket::errorOccurred, this, [this](QPlcAbstractSocket::Error error) {
        if (!m_liar || error != QPlcAbstractSocket::SecurityError)
            return;
        ++m_ended;
        m_liar.release()->deleteLater();
    });
    m_liar->connectToMaster(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, m_port));
    ++m_made;
}

void Intruder::enterAsObserver()
{
    m_observer.setSecurity(PlantKeys::ofObserver(m_folder));
    connect(&m_observer, &QPlcAbstractSocket::connected, this, [this] {
        m_observer.sendMessage(
            Message(Message::Hello,
                    {{QStringLiteral("protocol"), 2},
                     {QStringLiteral("name"), QStringLiteral("Observer")},
                     {QStringLiteral("uuid"), QStringLiteral("5704ed00-0000-4000-8000-000000000001")},
                     {QStringLiteral("role"), QStringLiteral("tool")}}));
    });
    connect(&m_observer, &QPlcAbstractSocket::messageReceived, this, &Intruder::receiveAsObserver);
    m_observer.connectToMaster(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, m_port));
}

void Intruder::receiveAsObserver(const Message &message)
{
    if (message.kind() == Message::Hello)
        m_isObserverIn = true;
    else if (message.kind() == Message::Failed && message.text(QStringLiteral("error")) == QLatin1String("Denied"))
        ++m_denials;
}

void Intruder::command()
{
    if (!m_isObserverIn || m_denials < m_commands)
        return;  // has no answer yet
    m_observer.sendMessage(forbidden(int(m_commands)));
    ++m_commands;
}

}  // namespace soak
