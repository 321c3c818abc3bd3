// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace qplc {

/// Called when SIGINT or SIGTERM asks the program for an orderly end, before its event loop learns
/// of it; null: nothing is. It runs in the handler of the signal, so it may only do what such a
/// handler may (signal-safety(7)). A program whose event loop may stand still sets it.
inline std::atomic<void (*)()> atEndSignal{nullptr};

}  // namespace qplc
