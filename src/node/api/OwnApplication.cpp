// SPDX-License-Identifier: Apache-2.0
#include "OwnApplication.h"

#include "realtime/BlockedSignals.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QTextCodec>

#include <clocale>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace qplc {

namespace {

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
        QCoreApplication application(count, arguments);
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

}  // namespace

OwnApplication::OwnApplication()
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (++users == 1 && !QCoreApplication::instance())
        running = std::make_unique<ApplicationThread>();
}

OwnApplication::~OwnApplication()
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (--users == 0)
        running.reset();
}

}  // namespace qplc
