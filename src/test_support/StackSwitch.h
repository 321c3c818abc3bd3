// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#if defined(__SANITIZE_ADDRESS__)
#define QTPLC_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define QTPLC_ADDRESS_SANITIZER
#endif
#endif
#if defined(__SANITIZE_THREAD__)
#define QTPLC_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define QTPLC_THREAD_SANITIZER
#endif
#endif
#if defined(QTPLC_ADDRESS_SANITIZER)
#include <sanitizer/asan_interface.h>
#include <sanitizer/common_interface_defs.h>
#endif
#if defined(QTPLC_THREAD_SANITIZER)
#include <sanitizer/tsan_interface.h>
#endif

namespace qplc {

/// Tells sanitizers that the thread goes on with the stack of a fiber, and that it comes back. Does
/// nothing in other builds.
class StackSwitch
{
public:
    StackSwitch() = default;
    ~StackSwitch() { destroy(); }
    StackSwitch(const StackSwitch &) = delete;
    StackSwitch &operator=(const StackSwitch &) = delete;

    /// \param bottom  of the stack of the fiber: its lowest address
    void create([[maybe_unused]] const void *bottom, [[maybe_unused]] std::size_t size) noexcept
    {
#if defined(QTPLC_ADDRESS_SANITIZER)
        m_bottom = bottom;
        m_size = size;
#endif
#if defined(QTPLC_THREAD_SANITIZER)
        destroy();
        m_inside = __tsan_create_fiber(0);
#endif
    }
    /// Outside, before the fiber goes on.
    void enter() noexcept
    {
#if defined(QTPLC_ADDRESS_SANITIZER)
        __sanitizer_start_switch_fiber(&m_outsideFrames, m_bottom, m_size);
#endif
#if defined(QTPLC_THREAD_SANITIZER)
        m_outside = __tsan_get_current_fiber();
        __tsan_switch_to_fiber(m_inside, 0);
#endif
    }
    /// Inside, when the fiber goes on.
    void hasEntered() noexcept
    {
#if defined(QTPLC_ADDRESS_SANITIZER)
        __sanitizer_finish_switch_fiber(m_insideFrames, &m_outsideBottom, &m_outsideSize);
#endif
    }
    /// Inside, before the fiber waits. \param isLast  it never comes back
    void leave([[maybe_unused]] bool isLast = false) noexcept
    {
#if defined(QTPLC_ADDRESS_SANITIZER)
        m_hasEnded = isLast;
        __sanitizer_start_switch_fiber(isLast ? nullptr : &m_insideFrames, m_outsideBottom, m_outsideSize);
#endif
#if defined(QTPLC_THREAD_SANITIZER)
        __tsan_switch_to_fiber(m_outside, 0);
#endif
    }
    /// Outside, when the fiber waits or has ended.
    void hasLeft() noexcept
    {
#if defined(QTPLC_ADDRESS_SANITIZER)
        __sanitizer_finish_switch_fiber(m_outsideFrames, nullptr, nullptr);
        if (m_hasEnded)  // others get this memory
            __asan_unpoison_memory_region(m_bottom, m_size);
#endif
    }

private:
    void destroy() noexcept
    {
#if defined(QTPLC_THREAD_SANITIZER)
        if (m_inside)
            __tsan_destroy_fiber(m_inside);
        m_inside = nullptr;
#endif
    }

#if defined(QTPLC_ADDRESS_SANITIZER)
    const void *m_bottom = nullptr;
    std::size_t m_size = 0;
    const void *m_outsideBottom = nullptr;
    std::size_t m_outsideSize = 0;
    void *m_insideFrames = nullptr;
    void *m_outsideFrames = nullptr;
    bool m_hasEnded = false;
#endif
#if defined(QTPLC_THREAD_SANITIZER)
    void *m_inside = nullptr;
    void *m_outside = nullptr;
#endif
};

}  // namespace qplc
