// SPDX-License-Identifier: Apache-2.0
#include "OwnApplication.h"

#include "realtime/BlockedSignals.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QTextCodec>
#include <QtCore/QVariant>
#include <QtCore/QtDebug>

#include <atomic>
#include <clocale>
#include <cstdio>
#include <future>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace qplc {

namespace {

/// A program may have several libraries with a copy of this code in each of them. The copy that
/// makes the application counts those of the others that use it.
using Guests = std::atomic<int>;
constexpr const char *guestsProperty = "qtplcGuests";  // of the application: the address of the number
constexpr int isEnding = std::numeric_limits<int>::min() / 2;
Guests guests{0};

/// While it exists, Qt does not say that the application is made in another thread than the first
/// one that has used Qt: this is on purpose, and does no harm here.
class Quiet
{
public:
    Quiet() { m_next = qInstallMessageHandler(pass); }
    ~Quiet() { qInstallMessageHandler(m_next); }
    Quiet(const Quiet &) = delete;
    Quiet &operator=(const Quiet &) = delete;

private:
    static void pass(QtMsgType type, const QMessageLogContext &context, const QString &text)
    {
        if (text.contains(QLatin1String("was not created in the main() thread")))
            return;
        if (const QtMessageHandler next = m_next)
            return next(type, context, text);
        std::fprintf(stderr, "%s\n", qPrintable(qFormatLogMessage(type, context, text)));
    }

    static inline std::atomic<QtMessageHandler> m_next{nullptr};
};

/// The application and its thread. Qt takes the first thread that uses it for its main one: nothing
/// of Qt is used on the thread of the program before this one runs.
class ApplicationThread
{
public:
    ApplicationThread()
    {
        std::promise<void> isReady;
        {
            const BlockedSignals blocked;
            m_thread = std::thread([&isReady] { run(isReady); });
        }
        isReady.get_future().wait();
    }
    ~ApplicationThread()
    {
        QMetaObject::invokeMethod(QCoreApplication::instance(), &QCoreApplication::quit, Qt::QueuedConnection);
        m_thread.join();
    }
    ApplicationThread(const ApplicationThread &) = delete;
    ApplicationThread &operator=(const ApplicationThread &) = delete;

private:
    /// The locale of the program stays as it is: an application of Qt sets that of the environment,
    /// which would change how the program writes numbers.
    static void run(std::promise<void> &isReady)
    {
        static char name[] = "qtplc";
        static char *arguments[] = {name, nullptr};
        static int count = 1;
        const char *locale = std::setlocale(LC_ALL, nullptr);
        const std::string before = locale ? locale : "C";
        std::optional<Quiet> quiet(std::in_place);
        QCoreApplication application(count, arguments);
        quiet.reset();
        application.setProperty(guestsProperty, QVariant::fromValue(reinterpret_cast<quintptr>(&guests)));
        (void)QTextCodec::codecForLocale();  // fixes how names of files are written
        std::setlocale(LC_ALL, before.c_str());
        QMetaObject::invokeMethod(
            &application, [&isReady] { isReady.set_value(); }, Qt::QueuedConnection);
        QCoreApplication::exec();
    }

    std::thread m_thread;
};

std::mutex mutex;
int users = 0;                               // guarded by mutex
std::unique_ptr<ApplicationThread> running;  // guarded by mutex
Guests *host = nullptr;                      // where this copy is a guest; guarded by mutex

/// \return where this copy has become a guest; null: the application belongs to the program, or has
///     just ended
Guests *visit()
{
    auto *others = reinterpret_cast<Guests *>(QCoreApplication::instance()->property(guestsProperty).value<quintptr>());
    int count = others ? others->load() : 0;
    while (others && count >= 0 && !others->compare_exchange_weak(count, count + 1)) {}
    if (count >= 0)
        return others;
    while (QCoreApplication::instance())
        std::this_thread::yield();
    return nullptr;
}

}  // namespace

OwnApplication::OwnApplication()
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (++users > 1 || running)
        return;
    if (QCoreApplication::instance())
        host = visit();
    if (!QCoreApplication::instance())
        running = std::make_unique<ApplicationThread>();
}

/// With guests in it, the application stays until the end of the program.
OwnApplication::~OwnApplication()
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (--users > 0)
        return;
    if (host)
        host->fetch_sub(1);
    host = nullptr;
    int none = 0;
    if (!running || !guests.compare_exchange_strong(none, isEnding))
        return;
    running.reset();
    guests = 0;
}

}  // namespace qplc
