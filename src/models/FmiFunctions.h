// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// The functions of an FMU that we call, as the standards FMI 2.0 and FMI 3.0 define them for C.
/// Values are passed as `void *`: how large they are follows from the function.
namespace qplc::fmi {

using Instance = void *;
using ValueReference = std::uint32_t;

/// What a function of an FMU returns; the same numbers in both versions.
enum Status : int {
    Ok,
    Warning,
    Discard,
    Error,
    Fatal,
    Pending  // FMI 2.0 only
};

using Version = const char *(*)();
using OfInstance = int (*)(Instance);
using FreeInstance = void (*)(Instance);

}  // namespace qplc::fmi

namespace qplc::fmi2 {

using fmi::Instance;
using fmi::ValueReference;

enum Type : int { ModelExchange, CoSimulation };
enum StatusKind : int { DoStepStatus, PendingStatus, LastSuccessfulTime, Terminated };

struct Callbacks
{
    void (*logger)(void *environment, const char *instance, int status, const char *category, const char *message, ...);
    void *(*allocateMemory)(std::size_t count, std::size_t size);
    void (*freeMemory)(void *memory);
    void (*stepFinished)(void *environment, int status);
    void *environment;
};

using Instantiate = Instance (*)(const char *name, int type, const char *guid, const char *resources,
                                 const Callbacks *callbacks, int visible, int loggingOn);
using SetupExperiment
    = int (*)(Instance, int toleranceDefined, double tolerance, double startTime, int stopTimeDefined, double stopTime);
using Get = int (*)(Instance, const ValueReference *references, std::size_t count, void *values);
using Set = int (*)(Instance, const ValueReference *references, std::size_t count, const void *values);
using DoStep = int (*)(Instance, double time, double step, int noSetStatePriorToTime);
using GetBooleanStatus = int (*)(Instance, int kind, int *value);
using GetRealStatus = int (*)(Instance, int kind, double *value);

}  // namespace qplc::fmi2

namespace qplc::fmi3 {

using fmi::Instance;
using fmi::ValueReference;

using LogMessage = void (*)(void *environment, int status, const char *category, const char *message);
using IntermediateUpdate
    = void (*)(void *environment, double time, bool setRequested, bool getAllowed, bool stepFinished,
               bool canReturnEarly, bool *earlyReturnRequested, double *earlyReturnTime);
using Instantiate = Instance (*)(const char *name, const char *token, const char *resources, bool visible,
                                 bool loggingOn, bool eventModeUsed, bool earlyReturnAllowed,
                                 const ValueReference *intermediateVariables, std::size_t intermediateCount,
                                 void *environment, LogMessage logMessage, IntermediateUpdate intermediateUpdate);
using EnterInitializationMode = int (*)(Instance, bool toleranceDefined, double tolerance, double startTime,
                                        bool stopTimeDefined, double stopTime);
using Get
    = int (*)(Instance, const ValueReference *references, std::size_t count, void *values, std::size_t valueCount);
using Set = int (*)(Instance, const ValueReference *references, std::size_t count, const void *values,
                    std::size_t valueCount);
using UpdateDiscreteStates = int (*)(Instance, bool *needsUpdate, bool *terminate, bool *nominalsChanged,
                                     bool *statesChanged, bool *nextEventTimeDefined, double *nextEventTime);
using DoStep = int (*)(Instance, double time, double step, bool noSetStatePriorToTime, bool *eventNeeded,
                       bool *terminate, bool *earlyReturn, double *lastTime);

}  // namespace qplc::fmi3
