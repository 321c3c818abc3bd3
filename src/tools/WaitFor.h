// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QEventLoop>
#include <QtCore/QTimer>

#include <chrono>

namespace tools {

/// How a wait has ended.
enum class Waited { ToldToEnd, Done, TimeIsUp };

/// Runs the event loop until \a isDone, which is asked once in \a pause, or for \a longest.
/// \return ToldToEnd when the program is told to end meanwhile, or was before
template<typename Condition>
Waited waitFor(std::chrono::milliseconds longest, std::chrono::milliseconds pause, Condition isDone)
{
    QEventLoop loop;
    QTimer look;
    QObject::connect(&look, &QTimer::timeout, &loop, [&] {
        if (isDone())
            loop.exit(int(Waited::Done));
    });
    QTimer::singleShot(longest, Qt::PreciseTimer, &loop, [&loop] { loop.exit(int(Waited::TimeIsUp)); });
    look.start(pause);
    // QCoreApplication::quit() ends all loops with 0, and those that begin later with -1.
    const int result = loop.exec();
    return result > 0 ? Waited(result) : Waited::ToldToEnd;
}

}  // namespace tools
