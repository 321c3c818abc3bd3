// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <typeindex>

namespace qplc {

/// What a program has once: its signal table, its security.
///
/// A process is one program. Only a simulator runs several programs in one process, and gives a
/// scope to each life of each of them.
///
/// \code
/// ProgramScope::current().the<Settings>().name = "Winch";
/// \endcode
///
/// Any thread.
class ProgramScope
{
public:
    /// That of the calling thread: of the process, unless the lookup knows another one.
    static ProgramScope &current();
    /// \param lookup  null where it knows none
    static void setLookup(ProgramScope *(*lookup)()) noexcept;

    /// The only T of the program, which is made at the first call.
    template<typename T>
    T &the()
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        std::shared_ptr<void> &thing = m_things[typeid(T)];
        if (!thing)
            thing = std::make_shared<T>();
        return *static_cast<T *>(thing.get());
    }

private:
    std::mutex m_mutex;
    std::map<std::type_index, std::shared_ptr<void>> m_things;
};

}  // namespace qplc
