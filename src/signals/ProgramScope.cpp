// SPDX-License-Identifier: Apache-2.0
#include "ProgramScope.h"

#include <atomic>

namespace qplc {

namespace {

std::atomic<ProgramScope *(*)()> currentLookup{nullptr};

// Made at the first use and never destroyed: objects in static storage may ask for it until the
// very end.
ProgramScope &scopeOfProcess()
{
    static ProgramScope *const scope = new ProgramScope;
    return *scope;
}

}  // namespace

ProgramScope &ProgramScope::current()
{
    ProgramScope *(*const lookup)() = currentLookup;
    ProgramScope *const scope = lookup ? lookup() : nullptr;
    return scope ? *scope : scopeOfProcess();
}

void ProgramScope::setLookup(ProgramScope *(*lookup)()) noexcept
{
    currentLookup = lookup;
}

}  // namespace qplc
