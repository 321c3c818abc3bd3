// SPDX-License-Identifier: Apache-2.0
// The functions of FMI 2.0, for co-simulation. All of the standard are there: those that are not
// offered say so.
#include "FmuInstance.h"

#include <cstring>

using qplc_export::FmuInstance;
using qplc_export::FmuVariable;

#define FMI2_FUNCTION extern "C" __attribute__((visibility("default")))

namespace {

using Component = void *;
using Reference = unsigned;
enum Status { Ok, Warning, Discard, Error };
enum StatusKind { DoStepStatus, PendingStatus, LastSuccessfulTime, TerminatedStatus };
enum Type { ModelExchange, CoSimulation };

struct Callbacks
{
    void (*logger)(void *environment, const char *instance, int status, const char *category, const char *format, ...);
    void *(*allocate)(std::size_t, std::size_t);
    void (*release)(void *);
    void (*stepFinished)(void *environment, int status);
    void *environment;
};

struct Fmu2
{
    std::unique_ptr<FmuInstance> instance;
    Status lastStep = Ok;
    bool isTerminated = false;
};

FmuInstance *of(Component component)
{
    return component ? static_cast<Fmu2 *>(component)->instance.get() : nullptr;
}

/// \param callbacks  may be null, and so may each of them
FmuInstance::Log logOf(const Callbacks *callbacks, const char *instanceName)
{
    if (!callbacks || !callbacks->logger)
        return [](FmuInstance::Level, const char *) {};
    return [logger = callbacks->logger, environment = callbacks->environment,
            name = std::string(instanceName ? instanceName : "")](FmuInstance::Level level, const char *text) {
        switch (level) {
        case FmuInstance::Level::Error:
            return logger(environment, name.c_str(), Error, "logStatusError", "%s", text);
        case FmuInstance::Level::Warning:
            return logger(environment, name.c_str(), Warning, "logStatusWarning", "%s", text);
        case FmuInstance::Level::Discard:
            return logger(environment, name.c_str(), Discard, "logStatusDiscard", "%s", text);
        case FmuInstance::Level::Notice:
        case FmuInstance::Level::Info:
            return logger(environment, name.c_str(), Ok, "logEvents", "%s", text);
        }
    };
}

constexpr int readable
    = FmuInstance::Initializing | FmuInstance::Stepping | FmuInstance::Terminated | FmuInstance::Failed;
constexpr int writable = FmuInstance::Instantiated | FmuInstance::Initializing | FmuInstance::Stepping;

/// Calls \a access for each variable; stops at the first one that it refuses.
template<typename Access>
Status forEach(Component component, const char *function, int phases, const Reference *references, std::size_t count,
               const void *values, FmuVariable::Kind kind, Access access)
{
    FmuInstance *instance = of(component);
    if (!instance || !instance->allows(function, phases))
        return Error;
    if (count > 0 && (!references || !values)) {
        instance->fail(QStringLiteral("%1: an array is null").arg(QLatin1String(function)));
        return Error;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const FmuVariable *variable = instance->find(function, references[i]);
        // An enumeration is read and written like an integer.
        const bool isEnumeration
            = variable && variable->kind == FmuVariable::Enumeration && kind == FmuVariable::Integer;
        if (!variable || (!isEnumeration && !instance->find(function, references[i], kind)))
            return Error;
        if (phases == writable && !instance->isSettable(function, *variable))
            return Error;
        if (!access(*instance, *variable, i))
            return Error;
    }
    return Ok;
}

Status notOffered(Component component, const char *function)
{
    if (FmuInstance *instance = of(component))
        instance->fail(QStringLiteral("%1 is not offered by this FMU: it is one for co-simulation without states, "
                                      "derivatives and asynchronous steps")
                           .arg(QLatin1String(function)));
    return Error;
}

}  // namespace

// ---- common ----

FMI2_FUNCTION const char *fmi2GetTypesPlatform()
{
    return "default";
}

FMI2_FUNCTION const char *fmi2GetVersion()
{
    return "2.0";
}

FMI2_FUNCTION int fmi2SetDebugLogging(Component component, int isOn, std::size_t, const char *const *)
{
    if (FmuInstance *instance = of(component))
        return instance->setLogging(isOn != 0), Ok;
    return Error;
}

FMI2_FUNCTION Component fmi2Instantiate(const char *instanceName, int type, const char *guid, const char *,
                                        const Callbacks *callbacks, int, int isLogging)
{
    const FmuInstance::Log log = logOf(callbacks, instanceName);
    if (type != CoSimulation) {
        log(FmuInstance::Level::Error, "this FMU is for co-simulation only; instantiate it as fmi2CoSimulation");
        return nullptr;
    }
    auto fmu = std::make_unique<Fmu2>();
    fmu->instance = FmuInstance::make(qplc_export::Standard::Fmi2, instanceName, guid, log);
    if (!fmu->instance)
        return nullptr;
    fmu->instance->setLogging(isLogging != 0);
    return fmu.release();
}

FMI2_FUNCTION void fmi2FreeInstance(Component component)
{
    delete static_cast<Fmu2 *>(component);
}

FMI2_FUNCTION int fmi2SetupExperiment(Component component, int, double, double start, int, double)
{
    FmuInstance *instance = of(component);
    return instance && instance->allows("fmi2SetupExperiment", FmuInstance::Instantiated) && instance->setStart(start)
        ? Ok
        : Error;
}

FMI2_FUNCTION int fmi2EnterInitializationMode(Component component)
{
    FmuInstance *instance = of(component);
    return instance && instance->allows("fmi2EnterInitializationMode", FmuInstance::Instantiated)
            && instance->enterInitialization()
        ? Ok
        : Error;
}

FMI2_FUNCTION int fmi2ExitInitializationMode(Component component)
{
    FmuInstance *instance = of(component);
    return instance && instance->allows("fmi2ExitInitializationMode", FmuInstance::Initializing)
            && instance->exitInitialization()
        ? Ok
        : Error;
}

FMI2_FUNCTION int fmi2Terminate(Component component)
{
    FmuInstance *instance = of(component);
    if (!instance || !instance->allows("fmi2Terminate", FmuInstance::Stepping | FmuInstance::Failed))
        return Error;
    instance->terminate();
    return Ok;
}

FMI2_FUNCTION int fmi2Reset(Component component)
{
    if (!component)
        return Error;
    auto *fmu = static_cast<Fmu2 *>(component);
    fmu->lastStep = Ok;
    fmu->isTerminated = false;
    return fmu->instance->reset() ? Ok : Error;
}

// ---- values ----

FMI2_FUNCTION int fmi2GetReal(Component component, const Reference *references, std::size_t count, double *values)
{
    return forEach(component, __func__, readable, references, count, values, FmuVariable::Real,
                   [values](FmuInstance &instance, const FmuVariable &variable, std::size_t i) {
                       values[i] = instance.runner().real(variable.signal, variable.element);
                       return true;
                   });
}

FMI2_FUNCTION int fmi2GetInteger(Component component, const Reference *references, std::size_t count, int *values)
{
    return forEach(component, __func__, readable, references, count, values, FmuVariable::Integer,
                   [values](FmuInstance &instance, const FmuVariable &variable, std::size_t i) {
                       values[i] = int(instance.runner().integer(variable.signal, variable.element));
                       return true;
                   });
}

FMI2_FUNCTION int fmi2GetBoolean(Component component, const Reference *references, std::size_t count, int *values)
{
    return forEach(component, __func__, readable, references, count, values, FmuVariable::Boolean,
                   [values](FmuInstance &instance, const FmuVariable &variable, std::size_t i) {
                       values[i] = instance.runner().integer(variable.signal, variable.element) != 0;
                       return true;
                   });
}

FMI2_FUNCTION int fmi2GetString(Component component, const Reference *references, std::size_t count,
                                const char **values)
{
    return forEach(component, __func__, readable, references, count, values, FmuVariable::String,
                   [values](FmuInstance &instance, const FmuVariable &variable, std::size_t i) {
                       values[i] = instance.text(variable);
                       return true;
                   });
}

FMI2_FUNCTION int fmi2SetReal(Component component, const Reference *references, std::size_t count, const double *values)
{
    return forEach(component, __func__, writable, references, count, values, FmuVariable::Real,
                   [values, function = __func__](FmuInstance &instance, const FmuVariable &variable, std::size_t i) {
                       return instance.setReal(function, variable, values[i]);
                   });
}

FMI2_FUNCTION int fmi2SetInteger(Component component, const Reference *references, std::size_t count, const int *values)
{
    return forEach(component, __func__, writable, references, count, values, FmuVariable::Integer,
                   [values, function = __func__](FmuInstance &instance, const FmuVariable &variable, std::size_t i) {
                       return instance.setInteger(function, variable, values[i]);
                   });
}

FMI2_FUNCTION int fmi2SetBoolean(Component component, const Reference *references, std::size_t count, const int *values)
{
    return forEach(component, __func__, writable, references, count, values, FmuVariable::Boolean,
                   [values, function = __func__](FmuInstance &instance, const FmuVariable &variable, std::size_t i) {
                       return instance.setInteger(function, variable, values[i] != 0);
                   });
}

FMI2_FUNCTION int fmi2SetString(Component component, const Reference *references, std::size_t count,
                                const char *const *values)
{
    return forEach(component, __func__, writable, references, count, values, FmuVariable::String,
                   [values, function = __func__](FmuInstance &instance, const FmuVariable &variable, std::size_t i) {
                       return instance.setText(function, variable, values[i]);
                   });
}

// ---- co-simulation ----

FMI2_FUNCTION int fmi2DoStep(Component component, double time, double size, int)
{
    FmuInstance *instance = of(component);
    if (!instance)
        return Error;
    auto *fmu = static_cast<Fmu2 *>(component);
    bool wantsStop = false;
    using Result = FmuInstance::StepResult;
    const Result result = instance->allows("fmi2DoStep", FmuInstance::Stepping)
        ? instance->doStep(time, size, &wantsStop)
        : Result::Failed;
    if (result == Result::Failed)
        return fmu->lastStep = Error;
    fmu->isTerminated = wantsStop;
    return fmu->lastStep = wantsStop ? Discard : result == Result::Warned ? Warning : Ok;
}

FMI2_FUNCTION int fmi2GetStatus(Component component, int kind, int *value)
{
    if (!component || kind != DoStepStatus || !value)
        return notOffered(component, "fmi2GetStatus with this kind of status");
    *value = static_cast<Fmu2 *>(component)->lastStep;
    return Ok;
}

FMI2_FUNCTION int fmi2GetRealStatus(Component component, int kind, double *value)
{
    if (!component || kind != LastSuccessfulTime || !value)
        return notOffered(component, "fmi2GetRealStatus with this kind of status");
    *value = of(component)->time();
    return Ok;
}

FMI2_FUNCTION int fmi2GetIntegerStatus(Component component, int, int *)
{
    return notOffered(component, "fmi2GetIntegerStatus");
}

FMI2_FUNCTION int fmi2GetBooleanStatus(Component component, int kind, int *value)
{
    if (!component || kind != TerminatedStatus || !value)
        return notOffered(component, "fmi2GetBooleanStatus with this kind of status");
    *value = static_cast<Fmu2 *>(component)->isTerminated;
    return Ok;
}

FMI2_FUNCTION int fmi2GetStringStatus(Component component, int kind, const char **value)
{
    if (!component || kind != PendingStatus || !value)
        return notOffered(component, "fmi2GetStringStatus with this kind of status");
    *value = "";
    return Ok;
}

// ---- not offered ----

#define NOT_OFFERED(function, ...)                                                                                     \
    FMI2_FUNCTION int function(__VA_ARGS__)                                                                            \
    {                                                                                                                  \
        return notOffered(component, #function);                                                                       \
    }

NOT_OFFERED(fmi2CancelStep, Component component)
NOT_OFFERED(fmi2SetRealInputDerivatives, Component component, const Reference *, std::size_t, const int *,
            const double *)
NOT_OFFERED(fmi2GetRealOutputDerivatives, Component component, const Reference *, std::size_t, const int *, double *)
NOT_OFFERED(fmi2GetFMUstate, Component component, void **)
NOT_OFFERED(fmi2SetFMUstate, Component component, void *)
NOT_OFFERED(fmi2FreeFMUstate, Component component, void **)
NOT_OFFERED(fmi2SerializedFMUstateSize, Component component, void *, std::size_t *)
NOT_OFFERED(fmi2SerializeFMUstate, Component component, void *, char *, std::size_t)
NOT_OFFERED(fmi2DeSerializeFMUstate, Component component, const char *, std::size_t, void **)
NOT_OFFERED(fmi2GetDirectionalDerivative, Component component, const Reference *, std::size_t, const Reference *,
            std::size_t, const double *, double *)
NOT_OFFERED(fmi2EnterEventMode, Component component)
NOT_OFFERED(fmi2NewDiscreteStates, Component component, void *)
NOT_OFFERED(fmi2EnterContinuousTimeMode, Component component)
NOT_OFFERED(fmi2CompletedIntegratorStep, Component component, int, int *, int *)
NOT_OFFERED(fmi2SetTime, Component component, double)
NOT_OFFERED(fmi2SetContinuousStates, Component component, const double *, std::size_t)
NOT_OFFERED(fmi2GetDerivatives, Component component, double *, std::size_t)
NOT_OFFERED(fmi2GetEventIndicators, Component component, double *, std::size_t)
NOT_OFFERED(fmi2GetContinuousStates, Component component, double *, std::size_t)
NOT_OFFERED(fmi2GetNominalsOfContinuousStates, Component component, double *, std::size_t)
