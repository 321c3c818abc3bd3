// SPDX-License-Identifier: Apache-2.0
#include "Plant.h"

#include "PlantFeed.h"
#include "node/Logging.h"

#include <type_traits>
#include <utility>

namespace qplc {

namespace {

QMap<QString, QString> textsOf(const QHash<QString, QPlcValue> &values)
{
    QMap<QString, QString> texts;
    for (auto value = values.begin(); value != values.end(); ++value)
        texts.insert(value.key(), value.value().toString());
    return texts;
}

}  // namespace

/// The caller of a command has to know its number before he is told what became of it.
template<typename Task>
void Plant::callLater(Task task)
{
    QMetaObject::invokeMethod(this, task, Qt::QueuedConnection);
}

template<typename Request>
int Plant::command(const Request &request)
{
    using Reply = ControlClient::Reply<Request>;
    const int number = ++m_lastCommand;
    const auto finish = [this, number](const Reply &reply) {
        if constexpr (std::is_same_v<Request, messages::Arm>) {
            if (const auto *armed = std::get_if<messages::Armed>(&reply))
                m_token = armed->token;
        }
        tellOutcome(number, Request::kind, std::get_if<messages::Failed>(&reply));
    };
    if (m_feed && isConnected()) {
        Q_EMIT m_feed->commanded(messages::toMessage(request));
        callLater([this, number] { Q_EMIT commandDone(number); });
    } else if (isConnected()) {
        m_connection.control().request(request, finish);
    } else {
        callLater([this, finish] { finish(messages::Failed{{}, refusalToCommand()}); });
    }
    return number;
}

QString Plant::refusalToCommand() const
{
    return m_recording ? QStringLiteral("'%1' is a recording: nothing can be commanded").arg(name())
                       : QStringLiteral("there is no connection to the master at %1").arg(address());
}

/// \param failed  null: it was carried out
void Plant::tellOutcome(int number, QPlcMessage::Kind command, const messages::Failed *failed)
{
    if (!failed) {
        Q_EMIT commandDone(number);
    } else {
        const QString sentence = printable(failed->text);
        tell(PlantEvent::Error, QStringLiteral("%1 failed: %2").arg(QPlcMessage::kindName(command), sentence));
        Q_EMIT commandFailed(number, sentence);
    }
    refresh();
}

int Plant::initialize()
{
    return command(messages::InitializeAllStates());
}

int Plant::start()
{
    return command(messages::StartRealTime{{}, std::exchange(m_token, std::nullopt)});
}

int Plant::stop(const QString &how)
{
    const bool isFedAndRuns = m_feed && m_status.isRunning();
    if (isFedAndRuns)
        m_status.master.stopped = messages::StopEntry{PlantLeases::whoever(), how,
                                                      quint64(QDateTime::currentMSecsSinceEpoch()) * 1'000'000, true};
    return command(messages::Stop{PlantLeases::whoever(), how});
}

int Plant::perform(Action action)
{
    Q_ASSERT_X(action != NoAction, "Plant::perform", "there is nothing to do");
    switch (action) {
    case Initialize:
        return initialize();
    case Arm:
        return command(messages::Arm());
    case Start:
        return start();
    case Reset:
        return command(messages::Reset{m_status.master.latch});
    case StopAction:
    case NoAction:
        break;
    }
    return stop();
}

int Plant::evict(const QString &name)
{
    return command(messages::Evict{name});
}

int Plant::admit(const QString &name)
{
    return command(messages::Admit{name});
}

int Plant::note(const QString &text)
{
    return command(messages::Note{text, PlantLeases::whoever()});
}

int Plant::setValues(const QHash<QString, QPlcValue> &values, std::chrono::nanoseconds duration)
{
    messages::SetSignals wish{textsOf(values), std::nullopt};
    if (duration.count() > 0)
        wish.duration = duration;
    return command(wish);
}

int Plant::takeLease(const QStringList &signalNames, const QHash<QString, QPlcValue> &values, TakeOver takeOver)
{
    messages::TakeLease wish = m_leases.wish(signalNames);
    wish.values = textsOf(values);
    wish.takeOver = takeOver == AlsoFromOthers;
    return command(wish);
}

int Plant::releaseLease(const QStringList &signalNames)
{
    return command(messages::ReleaseLease{signalNames});
}

}  // namespace qplc
