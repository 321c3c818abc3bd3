// SPDX-License-Identifier: Apache-2.0
#include "BlockingClient.h"

#include "TerminalText.h"
#include "protocol/messages/Vocabulary.h"

#include <QtCore/QEventLoop>

namespace tools {

using qplc::ControlClient;

BlockingClient::BlockingClient(std::chrono::milliseconds timeout)
    : m_control({QStringLiteral("qtplc"), qplc::messages::Part::Tool, {}})
    , m_timeout(timeout)
{
    m_control.setAnswerTimes(timeout, timeout);
    connect(&m_control, &ControlClient::lost, this, &BlockingClient::end);
}

bool BlockingClient::connectToMaster(const QPlcUnderlyingProtocol &master)
{
    m_address = placeText(master);
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
            QStringLiteral("the master at %1 speaks protocol version %2, this tool version %3; update the older one")
                .arg(m_address, reason)
                .arg(qplc::messages::protocolVersion));
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

bool BlockingClient::exchange(const QPlcMessage &request)
{
    if (m_error != NoError || !m_control.isGreeted())
        return false;
    QEventLoop loop;
    bool isAnswered = false;
    connect(this, &BlockingClient::lost, &loop, &QEventLoop::quit);
    m_control.send(request, [&](const QPlcMessage &message) {
        if (message.kind() == QPlcMessage::Invalid)
            return;  // lost() follows
        isAnswered = true;
        m_answer = message;
        if (message.kind() == QPlcMessage::Failed || message.kind() == QPlcMessage::Rejected) {
            const qplc::messages::Failed refusal = ControlClient::failureOf(message);
            m_refusal = refusal.error;
            setError(Refused, QStringLiteral("the master refuses: %1").arg(printable(refusal.text)));
        }
        loop.quit();
    });
    if (!isAnswered && m_error == NoError)
        loop.exec();
    return m_error == NoError;
}

/// An older master says so of a kind that it does not know.
bool BlockingClient::isUnknownKind() const
{
    return m_error == Refused && m_refusal == qplc::messages::errorWord::malformedMessage;
}

bool BlockingClient::setUnknown(QPlcMessage::Kind request)
{
    return setError(Refused,
                    QStringLiteral("the master at %1 does not know %2; it is older than this tool: update it")
                        .arg(m_address, QPlcMessage::kindName(request)));
}

bool BlockingClient::askForSignals(const QStringList &names, std::vector<qplc::messages::SignalEntry> *signals)
{
    for (int first = 0; first < names.size(); first += SignalsPerAnswer) {
        qplc::messages::Signals answer;
        if (!ask(qplc::messages::GetSignals{names.mid(first, SignalsPerAnswer)}, &answer))
            return false;
        signals->insert(signals->end(), answer.signals.begin(), answer.signals.end());
    }
    return true;
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
