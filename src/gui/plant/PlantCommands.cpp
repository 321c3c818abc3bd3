// SPDX-License-Identifier: Apache-2.0
#include "Plant.h"

#include "PlantFeed.h"
#include "node/Logging.h"

#include <QtCore/QJsonArray>

namespace qplc {

namespace {

using Message = QPlcMessage;

QJsonObject textsOf(const QHash<QString, QPlcValue> &values)
{
    QJsonObject texts;
    for (auto value = values.begin(); value != values.end(); ++value)
        texts.insert(value.key(), value.value().toString());
    return texts;
}

}  // namespace

int Plant::command(const Message &message)
{
    const int number = ++m_lastCommand;
    const auto tellOutcome = [this, number, name = message.kindName()](const Message &answer) {
        if (answer.kind() == Message::Armed)
            m_token = answer.text(QStringLiteral("token"));
        if (answer.kind() == Message::Done || answer.kind() == Message::Armed) {
            Q_EMIT commandDone(number);
        } else {
            const QString sentence = printable(answer.text(QStringLiteral("text")));
            tell(PlantEvent::Error, QStringLiteral("%1 failed: %2").arg(name, sentence));
            Q_EMIT commandFailed(number, sentence);
        }
        refresh();
    };
    // Never before the caller knows the number.
    if (m_feed && isConnected()) {
        Q_EMIT m_feed->commanded(message);
        QMetaObject::invokeMethod(
            this, [this, number] { Q_EMIT commandDone(number); }, Qt::QueuedConnection);
    } else if (isConnected()) {
        m_connection.control().command(message, tellOutcome);
    } else {
        QMetaObject::invokeMethod(
            this,
            [this, tellOutcome] {
                tellOutcome(Message(Message::Failed,
                                    {{QStringLiteral("text"),
                                      QStringLiteral("there is no connection to the master at %1").arg(address())}}));
            },
            Qt::QueuedConnection);
    }
    return number;
}

int Plant::initialize()
{
    return command(Message(Message::InitializeAllStates));
}

int Plant::start()
{
    QJsonObject fields;
    if (!m_token.isEmpty())
        fields.insert(QStringLiteral("token"), m_token);
    m_token.clear();
    return command(Message(Message::StartRealTime, fields));
}

int Plant::stop(const QString &how)
{
    const bool isFedAndRuns = m_feed && m_status.isRunning();
    if (isFedAndRuns)
        m_status.stop = {PlantLeases::whoever(), how, QDateTime::currentDateTime(), true};
    return command(
        Message(Message::Stop, {{QStringLiteral("whoever"), PlantLeases::whoever()}, {QStringLiteral("how"), how}}));
}

int Plant::perform(Action action)
{
    Q_ASSERT_X(action != NoAction, "Plant::perform", "there is nothing to do");
    switch (action) {
    case Initialize:
        return initialize();
    case Arm:
        return command(Message(Message::Arm));
    case Start:
        return start();
    case Reset:
        return command(Message(Message::Reset));
    case StopAction:
    case NoAction:
        break;
    }
    return stop();
}

int Plant::setValues(const QHash<QString, QPlcValue> &values, std::chrono::nanoseconds duration)
{
    QJsonObject fields{{QStringLiteral("values"), textsOf(values)}};
    if (duration.count() > 0)
        fields.insert(QStringLiteral("duration"), double(duration.count()));
    return command(Message(Message::SetSignals, fields));
}

int Plant::takeLease(const QStringList &signalNames, const QHash<QString, QPlcValue> &values, TakeOver takeOver)
{
    QJsonObject fields = m_leases.identity();
    fields.insert(QStringLiteral("signals"), QJsonArray::fromStringList(signalNames));
    fields.insert(QStringLiteral("values"), textsOf(values));
    fields.insert(QStringLiteral("takeOver"), takeOver == AlsoFromOthers);
    return command(Message(Message::TakeLease, fields));
}

int Plant::releaseLease(const QStringList &signalNames)
{
    return command(
        Message(Message::ReleaseLease, {{QStringLiteral("signals"), QJsonArray::fromStringList(signalNames)}}));
}

}  // namespace qplc
