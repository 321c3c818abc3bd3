// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "WakeUp.h"

#include <functional>
#include <memory>

namespace qplc {

/// Does long work beside an event loop: one job after the other, on a thread of its own with
/// ordinary scheduling, which is made for the first job. Where there is no thread (on a simulated
/// host, or because the system makes none) begin() does the job itself.
///
/// \code
/// worker.begin([data] { data->read(); }, [this] { use(); });  // read() beside, use() here
/// ...
/// worker.collect();                                           // when descriptor() is readable
/// \endcode
///
/// Used by one thread.
class Worker
{
public:
    using Call = std::function<void()>;

    Worker();
    /// Waits for the job at hand, and forgets the others. No more \a done is called.
    ~Worker();
    Worker(const Worker &) = delete;
    Worker &operator=(const Worker &) = delete;

    /// Does \a work behind all that was begun before, and ends its life there; then collect() calls
    /// \a done on the thread of the caller. Without a thread both are called at once.
    void begin(Call work, Call done = {});
    /// Calls what is due of jobs that have ended.
    void collect();
    /// Readable when collect() is due; for QSocketNotifier. -1: there is no thread (yet).
    int descriptor() const noexcept;

private:
    struct State;
    bool hasThread();

    std::unique_ptr<State> d;  // null: no thread (yet)
    bool m_isAlone = false;    // there will be none
};

}  // namespace qplc
