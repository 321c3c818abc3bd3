// SPDX-License-Identifier: Apache-2.0
#include "BlockingClient.h"

#include "TerminalText.h"

#include <QtCore/QEventLoop>

namespace tools {

using Message = QPlcMessage;
using qplc::ControlClient;

bool hasCycles(const QString &state)
{
    namespace messages = qplc::messages;
    return messages::hasCycles(
        messages::valueNamed<messages::MasterState>(state).value_or(messages::MasterState::Unknown));
}

BlockingClient::BlockingClient(std::chrono::milliseconds timeout)
    : m_control({QStringLiteral("qtplc"), qplc::messages::Part::Tool, {}})
    , m_timeout(timeout)
{
    m_control.setAnswerTimes(timeout, timeout);
    connect(&m_control, &ControlClient::lost, this, &BlockingClient::end);
}

bool BlockingClient::connectToMaster(const QPlcUnderlyingProtocol &master)
{
    m_address = master.toString().section(QStringLiteral("://"), 1);
    QEventLoop loop;
    connect(&m_control, &ControlClient::greeted, &loop, &QEventLoop::quit);
    connect(this, &BlockingClient::lost, &loop, &QEventLoop::quit);
    m_control.connectToMaster(master);
    if (!m_control.isGreeted() && m_error == NoError)
        loop.exec();
    m_wasGreeted = m_control.isGreeted();
    return m_error == NoError;
}

void BlockingClient::end(ControlClient::Loss loss, const QString &reason)
{
    if (m_error != NoError)  // a refusal that came before says more
        return;
    if (m_wasGreeted)
        setError(Lost, QStringLiteral("lost the master at %1: %2").arg(m_address, printable(reason)));
    else if (loss == ControlClient::Loss::Rejected)
        setError(Refused, QStringLiteral("the master at %1 refuses: %2").arg(m_address, printable(reason)));
    else if (loss == ControlClient::Loss::NoGreeting)
        setError(
            Unreachable,
            QStringLiteral("%1 answers with %2 instead of a greeting; is it a QtPLC master?").arg(m_address, reason));
    else if (loss == ControlClient::Loss::OtherVersion)
        setError(
            Unreachable,
            QStringLiteral("the master at %1 speaks protocol version %2, this tool version 1; update the older one")
                .arg(m_address, reason));
    else
        setError(Unreachable,
                 QStringLiteral("cannot reach a master at %1: %2; start the master, or give its address by --master")
                     .arg(m_address, reason));
    Q_EMIT lost();
}

bool BlockingClient::setError(Error error, const QString &text)
{
    m_error = error;
    m_errorString = text;
    return false;
}

bool BlockingClient::ask(const Message &request, Message *answer)
{
    if (m_error != NoError || !m_control.isGreeted())
        return false;
    QEventLoop loop;
    Message received;
    connect(this, &BlockingClient::lost, &loop, &QEventLoop::quit);
    m_control.send(request, Message::Invalid, [&](const Message &message) {
        received = message;
        if (message.kind() == Message::Invalid)
            return;  // lost() follows
        m_refusal = message.text(QStringLiteral("error"));
        if (message.kind() == Message::Failed || message.kind() == Message::Rejected)
            setError(Refused,
                     QStringLiteral("the master refuses: %1").arg(printable(message.text(QStringLiteral("text")))));
        loop.quit();
    });
    if (received.kind() == Message::Invalid && m_error == NoError)
        loop.exec();
    if (m_error != NoError)
        return false;
    if (answer)
        *answer = received;
    return true;
}

bool BlockingClient::askFor(Message::Kind request, Message::Kind expected, const QJsonObject &fields, Message *answer)
{
    const bool isAnswered = ask(Message(request, fields), answer);
    const bool isUnknown = m_error == Refused && m_refusal == QLatin1String("MalformedMessage");
    if (isUnknown || (isAnswered && answer->kind() != expected))
        return setUnknown(request);
    return isAnswered;
}

bool BlockingClient::setUnknown(Message::Kind request)
{
    return setError(Refused,
                    QStringLiteral("the master at %1 does not know %2; it is older than this tool: update it")
                        .arg(m_address, Message::kindName(request)));
}

QPlcSignalTable BlockingClient::table()
{
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromMaster(m_control.master().table.toUtf8(), &errors);
    if (table.isEmpty())
        setError(Lost, QPlcParseError::toString(errors));
    return table;
}

}  // namespace tools
