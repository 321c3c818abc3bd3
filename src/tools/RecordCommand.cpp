// SPDX-License-Identifier: Apache-2.0
// record: from the ring of a master on this computer into a file.
#include "Commands.h"
#include "TerminalText.h"
#include "recording/PlantRecorder.h"
#include "recording/RingFiles.h"

#include <QtCore/QFile>
#include <QtCore/QTimer>

#include <cstdio>

namespace tools {

namespace {

constexpr int LookAfter = 5;                 // [ms] between two looks for records
constexpr qint64 SaveAfter = 1'000'000'000;  // [ns] a loss of power costs no more
constexpr int MostAtEnd = 1000;              // chunks
constexpr int TryAgainAfter = 1000;          // [ms] when the file could not be written

/// The ring of the only master of this user. Empty, with the message out: none, or several.
QString onlyRing(const CommandCall &call)
{
    const QStringList rings = qplc::ringsOfMasters();
    if (rings.size() == 1)
        return rings.constFirst();
    call.application.usageError(
        rings.isEmpty() ? QStringLiteral("no master of this user runs cycles on this computer; start the plant first")
                        : QStringLiteral("several masters run cycles: name one of their rings, --ring %1")
                              .arg(rings.join(QStringLiteral(" or --ring "))));
    return {};
}

/// Records until the phase is over, or a signal comes.
class Recording
{
public:
    Recording(const CommandCall &call, const QString &file)
        : m_call(call)
        , m_file(file)
        , m_isStopped(call.quitOnSignals())
    {
        m_timer.setTimerType(Qt::PreciseTimer);
        QObject::connect(&m_timer, &QTimer::timeout, &m_timer, [this] { proceed(); });
    }

    bool begin(const QString &ring, QString *error)
    {
        if (!m_recorder.attach(QFile::encodeName(ring), error))
            return false;
        std::unique_ptr<qplc::mcap::FileSink> sink = qplc::mcap::FileSink::create(m_file, error);
        return sink && m_recorder.begin(std::move(sink), error);
    }
    int run()
    {
        printLine(QStringLiteral("recording plant '%1' to %2")
                      .arg(printable(m_recorder.description().plant), printable(m_file)));
        std::fflush(stdout);
        m_timer.start(LookAfter);
        if (!*m_isStopped)
            m_call.application.exec();
        return end();
    }

private:
    void proceed()
    {
        QString error;
        const qplc::PlantRecorder::Progress progress = m_recorder.proceed(&error);
        m_hasEnded = progress == qplc::PlantRecorder::Ended;
        m_isAbandoned = progress == qplc::PlantRecorder::Abandoned;
        if (m_hasEnded || m_isAbandoned)
            return QCoreApplication::quit();
        const qint64 now = qplc::monotonicNow();
        bool isWritten = progress != qplc::PlantRecorder::Failed;
        if (isWritten && now - m_saved > SaveAfter) {
            isWritten = m_recorder.save(true, &error);
            m_saved = now;
        }
        if (!isWritten && !m_hasFailed)
            QPlcCoreApplication::printError(error
                                            + QStringLiteral("; the ring keeps the cycles, and it is tried again"));
        m_hasFailed = !isWritten;
        m_timer.setInterval(m_hasFailed ? TryAgainAfter : progress == qplc::PlantRecorder::Recorded ? 0 : LookAfter);
    }
    int end()
    {
        QString error;
        // A signal: what is in the ring by now is still recorded.
        for (int i = 0; i < MostAtEnd && m_recorder.proceed(&error) == qplc::PlantRecorder::Recorded; ++i) {}
        if (!m_recorder.finish(&error)) {
            QPlcCoreApplication::printError(error);
            return QPlcCoreApplication::Failure;
        }
        m_recorder.detach();
        if (m_hasEnded || m_isAbandoned)
            m_recorder.removeRing();
        printLine(QStringLiteral("%1 cycles in %2, %3 missing")
                      .arg(m_recorder.cycles())
                      .arg(printable(m_file))
                      .arg(m_recorder.missing()));
        if (m_isAbandoned)
            QPlcCoreApplication::printError(QStringLiteral("the master has ended without the end of its phase"));
        return m_isAbandoned ? QPlcCoreApplication::Failure : QPlcCoreApplication::Success;
    }

    const CommandCall &m_call;
    QString m_file;
    std::shared_ptr<const bool> m_isStopped;
    qplc::PlantRecorder m_recorder;
    QTimer m_timer;
    qint64 m_saved = 0;
    bool m_hasFailed = false;
    bool m_hasEnded = false;
    bool m_isAbandoned = false;
};

}  // namespace

int recordPlant(const CommandCall &call)
{
    const QString option = QStringLiteral("ring");
    const QString ring = call.application.isSet(option) ? call.application.value(option) : onlyRing(call);
    if (ring.isEmpty())
        return QPlcCoreApplication::UsageError;
    Recording recording(call, call.arguments.value(0));
    QString error;
    if (!recording.begin(ring, &error))
        return call.application.usageError(error);
    return recording.run();
}

}  // namespace tools
