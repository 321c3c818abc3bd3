// SPDX-License-Identifier: Apache-2.0
#include "RemoteRings.h"

#include "TerminalText.h"
#include "protocol/messages/Vocabulary.h"
#include "realtime/Host.h"
#include "realtime/TimeSource.h"

#include <QtPlcRecording>

#include <QtCore/QEventLoop>
#include <QtCore/QFile>
#include <QtCore/QSysInfo>

namespace tools {

using qplc::ControlClient;
using qplc::RingCopy;

namespace {

constexpr int LookEach = 10;         // [ms] between two looks whether there is something to ask
constexpr int AskAgainAfter = 1000;  // [ms] a refusal
constexpr int LongestGoodbye = 2000;

ControlClient::Caller caller()
{
    return {QStringLiteral("qtplc record on ") + QSysInfo::machineHostName(),
            qplc::messages::Part::Tool,
            {},
            qplc::newUuid(),
            {},
            false};
}

}  // namespace

RemoteRings::RemoteRings(QPlcRecorder *recorder, const QPlcUnderlyingProtocol &master)
    : m_recorder(recorder)
    , m_master(master)
    , m_control(caller())
{
    m_retry.setSingleShot(true);
    m_due.setSingleShot(true);
    connect(&m_retry, &QTimer::timeout, this, [this] { m_control.connectToMaster(m_master); });
    connect(&m_due, &QTimer::timeout, this, &RemoteRings::ask);
    connect(&m_control, &ControlClient::lost, this, &RemoteRings::lost);
    connect(&m_control, &ControlClient::greeted, this, [this] {
        m_wasThere = true;
        m_backOff.reset();
        ask();
    });
}

void RemoteRings::start()
{
    RingCopy::removeDead();
    m_copy = std::make_unique<RingCopy>(QSysInfo::machineHostName());
    m_control.connectToMaster(m_master);
}

// ---- the connection ----

/// The master may be there again soon, with the same ring.
void RemoteRings::lost(ControlClient::Loss loss, const QString &reason)
{
    m_due.stop();
    if (loss == ControlClient::Loss::MasterEnded && m_isRecording)
        forget();
    const bool isFinal = loss == ControlClient::Loss::Rejected || loss == ControlClient::Loss::NoGreeting
        || loss == ControlClient::Loss::OtherVersion;
    const QString text = QStringLiteral("no connection to the master at %1: %2").arg(placeText(m_master), reason);
    if (!m_wasThere || (isFinal && !m_isRecording))
        return fail(text + QStringLiteral("; start the master, or give its address by --master"));
    trouble(text + QStringLiteral("; it is tried again"));
    const double chance = qplc::randomFraction();
    m_retry.start(isFinal ? m_backOff.afterRefusal(chance) : m_backOff.next(chance));
}

void RemoteRings::fail(const QString &text)
{
    m_error = printable(text);
    m_control.close();
    Q_EMIT failed();
}

void RemoteRings::trouble(const QString &text)
{
    if (std::exchange(m_trouble, text) != text)
        Q_EMIT troubled(printable(text));
}

// ---- questions ----

void RemoteRings::ask()
{
    if (!m_control.isGreeted() || m_isFinishing)
        return;
    if (const auto question = m_copy->question(qplc::monotonicNow()))
        m_control.request(*question, [this](const Reply &reply) { handle(reply); });
    else
        m_due.start(LookEach);
}

void RemoteRings::handle(const Reply &reply)
{
    QString error;
    if (const auto *refusal = std::get_if<qplc::messages::Failed>(&reply)) {
        m_copy->forgetQuestion();
        refused(*refusal);
    } else if (!m_copy->take(std::get<qplc::messages::Records>(reply), qplc::monotonicNow(), &error)) {
        fail(error);
    } else {
        taken();
    }
}

void RemoteRings::refused(const qplc::messages::Failed &refusal)
{
    if (refusal.error == qplc::messages::errorWord::lost)
        return;  // lost() follows
    if (refusal.error == qplc::messages::errorWord::unknownRing) {
        trouble(QStringLiteral("the master was started again; its former phase has no more cycles"));
        forget();
        ask();
    } else if (!m_isRecording) {
        fail(QStringLiteral("the master at %1 refuses: %2").arg(placeText(m_master), refusal.text));
    } else {
        trouble(QStringLiteral("the master refuses: %1; it is asked again").arg(refusal.text));
        m_due.start(AskAgainAfter);
    }
}

void RemoteRings::taken()
{
    if (m_copy->state() == RingCopy::Ready && !m_isRecording) {
        m_isRecording = m_recorder->addRing(QFile::decodeName(m_copy->file()));
        if (!m_isRecording)
            return fail(m_recorder->errorString());
        m_trouble.clear();
    }
    if (m_copy->state() == RingCopy::Ended)
        forget();
    ask();
}

/// The next ring is another one. The recorder gets what has come of this one.
void RemoteRings::forget()
{
    m_copy->abandon();
    m_copy = std::make_unique<RingCopy>(QSysInfo::machineHostName());
    m_isRecording = false;
}

void RemoteRings::finish()
{
    m_isFinishing = true;
    m_due.stop();
    m_retry.stop();
    m_control.disconnect(this);
    if (!m_control.isGreeted() || !m_isRecording)
        return;
    QEventLoop loop;
    QTimer::singleShot(LongestGoodbye, &loop, &QEventLoop::quit);
    connect(&m_control, &ControlClient::lost, &loop, &QEventLoop::quit);
    m_control.request(m_copy->end(), [&loop](const Reply &) { loop.quit(); });
    loop.exec();
    m_control.close();
}

}  // namespace tools
