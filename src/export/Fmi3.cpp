// SPDX-License-Identifier: Apache-2.0
// The functions of FMI 3.0, for co-simulation. All of the standard are there: those that are not
// offered say so.
#include "FmuInstance.h"
#include "QSplitPrimitive.h"

#include <cstdint>

using qplc_export::FmuInstance;
using qplc_export::FmuVariable;

#define FMI3_FUNCTION extern "C" __attribute__((visibility("default")))

namespace {

using Instance = void *;
using Reference = std::uint32_t;
enum Status { Ok, Warning, Discard, Error };
using Logger = void (*)(void *environment, int status, const char *category, const char *text);

FmuInstance *of(Instance instance)
{
    return static_cast<FmuInstance *>(instance);
}

FmuInstance::Log logOf(Logger logger, void *environment)
{
    return [logger, environment](FmuInstance::Level level, const char *text) {
        if (!logger)
            return;
        switch (level) {
        case FmuInstance::Level::Error:
            return logger(environment, Error, "logStatusError", text);
        case FmuInstance::Level::Warning:
            return logger(environment, Warning, "logStatusWarning", text);
        case FmuInstance::Level::Discard:
            return logger(environment, Discard, "logStatusDiscard", text);
        case FmuInstance::Level::Notice:
        case FmuInstance::Level::Info:
            return logger(environment, Ok, "logEvents", text);
        }
    };
}

constexpr int readable
    = FmuInstance::Initializing | FmuInstance::Stepping | FmuInstance::Terminated | FmuInstance::Failed;
constexpr int writable = FmuInstance::Instantiated | FmuInstance::Initializing | FmuInstance::Stepping;

/// What a call of fmi3GetX() or fmi3SetX() is about.
struct Call
{
    Instance instance;
    const char *function;
    int phases;
    const Reference *references;
    std::size_t count;
    const void *values;
    std::size_t valueCount;
};

/// Calls \a access(instance, variable, position) for each variable, whose elements begin at this
/// position of the values; stops at the first one that it refuses.
template<typename IsRight, typename Access>
Status forEach(const Call &call, IsRight isRight, Access access)
{
    FmuInstance *instance = of(call.instance);
    if (!instance || !instance->allows(call.function, call.phases))
        return Error;
    const QString function = QLatin1String(call.function);
    if (call.count > 0 && (!call.references || !call.values)) {
        instance->fail(QStringLiteral("%1: an array is null").arg(function));
        return Error;
    }
    std::size_t position = 0;
    for (std::size_t i = 0; i < call.count; ++i) {
        const FmuVariable *variable = instance->find(call.function, call.references[i]);
        if (!variable)
            return Error;
        const QString name = variable->name;
        if (!isRight(*variable)) {
            instance->fail(QStringLiteral("%1: variable '%2' has the type %3")
                               .arg(function, name, qplc_export::nameOf(variable->kind)));
            return Error;
        }
        if (call.phases == writable && !instance->isSettable(call.function, *variable))
            return Error;
        if (position + std::size_t(variable->count) > call.valueCount) {
            instance->fail(QStringLiteral("%1: there are %2 values, too few for '%3' with %4 elements")
                               .arg(function)
                               .arg(call.valueCount)
                               .arg(name)
                               .arg(variable->count));
            return Error;
        }
        if (!access(*instance, *variable, position))
            return Error;
        position += std::size_t(variable->count);
    }
    if (position == call.valueCount)
        return Ok;
    instance->fail(
        QStringLiteral("%1: there are %2 values for %3 elements").arg(function).arg(call.valueCount).arg(position));
    return Error;
}

auto only(FmuVariable::Kind kind)
{
    return [kind](const FmuVariable &variable) { return variable.kind == kind; };
}

/// Enumerations are read and written as integers of 64 bits.
bool isInt64(const FmuVariable &variable)
{
    return variable.kind == FmuVariable::Int64 || variable.kind == FmuVariable::Enumeration;
}

/// Numbers whose type is that of the signal: their bytes are copied.
template<typename T>
Status getNumbers(const Call &call, FmuVariable::Kind kind, T *values)
{
    return forEach(
        call, only(kind), [values](FmuInstance &instance, const FmuVariable &variable, std::size_t position) {
            const char *bytes = instance.runner().bytes(variable.signal);
            for (int i = 0; i < variable.count; ++i)
                values[position + std::size_t(i)] = QSplitPrimitive<T>::fromBytes(bytes + std::size_t(i) * sizeof(T));
            return true;
        });
}

template<typename T>
Status setNumbers(const Call &call, FmuVariable::Kind kind, const T *values)
{
    return forEach(call, only(kind),
                   [values](FmuInstance &instance, const FmuVariable &variable, std::size_t position) {
                       std::array<char, QPlcSignalType::MaximumSize> bytes;
                       for (int i = 0; i < variable.count; ++i)
                           QSplitPrimitive<T>(values[position + std::size_t(i)])
                               .toBytes(bytes.data() + std::size_t(i) * sizeof(T));
                       instance.runner().setBytes(variable.signal, bytes.data());
                       return true;
                   });
}

Status notOffered(Instance instance, const char *function)
{
    if (instance)
        of(instance)->fail(QStringLiteral("%1 is not offered by this FMU: it is one for co-simulation without states, "
                                          "derivatives, events, clocks and configuration")
                               .arg(QLatin1String(function)));
    return Error;
}

Instance notInstantiated(const char *what, Logger logger, void *environment)
{
    logOf(logger, environment)(FmuInstance::Level::Error, what);
    return nullptr;
}

}  // namespace

// ---- common ----

FMI3_FUNCTION const char *fmi3GetVersion()
{
    return "3.0";
}

FMI3_FUNCTION int fmi3SetDebugLogging(Instance instance, bool isOn, std::size_t, const char *const *)
{
    if (!instance)
        return Error;
    of(instance)->setLogging(isOn);
    return Ok;
}

FMI3_FUNCTION Instance fmi3InstantiateCoSimulation(const char *name, const char *token, const char *, bool,
                                                   bool isLogging, bool usesEvents, bool, const Reference *,
                                                   std::size_t intermediateCount, void *environment, Logger logger,
                                                   void (*)())
{
    if (usesEvents)
        return notInstantiated("this FMU has no event mode; instantiate it without", logger, environment);
    if (intermediateCount > 0)
        return notInstantiated("this FMU has no intermediate updates; instantiate it without", logger, environment);
    auto instance = FmuInstance::make(qplc_export::Standard::Fmi3, name, token, logOf(logger, environment));
    if (instance)
        instance->setLogging(isLogging);
    return instance.release();
}

FMI3_FUNCTION Instance fmi3InstantiateModelExchange(const char *, const char *, const char *, bool, bool,
                                                    void *environment, Logger logger)
{
    return notInstantiated("this FMU is for co-simulation only; call fmi3InstantiateCoSimulation()", logger,
                           environment);
}

FMI3_FUNCTION Instance fmi3InstantiateScheduledExecution(const char *, const char *, const char *, bool, bool,
                                                         void *environment, Logger logger, void (*)(), void (*)(),
                                                         void (*)())
{
    return notInstantiated("this FMU is for co-simulation only; call fmi3InstantiateCoSimulation()", logger,
                           environment);
}

FMI3_FUNCTION void fmi3FreeInstance(Instance instance)
{
    delete of(instance);
}

FMI3_FUNCTION int fmi3EnterInitializationMode(Instance instance, bool, double, double start, bool, double)
{
    return instance && of(instance)->allows("fmi3EnterInitializationMode", FmuInstance::Instantiated)
            && of(instance)->setStart(start) && of(instance)->enterInitialization()
        ? Ok
        : Error;
}

FMI3_FUNCTION int fmi3ExitInitializationMode(Instance instance)
{
    return instance && of(instance)->allows("fmi3ExitInitializationMode", FmuInstance::Initializing)
            && of(instance)->exitInitialization()
        ? Ok
        : Error;
}

FMI3_FUNCTION int fmi3Terminate(Instance instance)
{
    if (!instance || !of(instance)->allows("fmi3Terminate", FmuInstance::Stepping | FmuInstance::Failed))
        return Error;
    of(instance)->terminate();
    return Ok;
}

FMI3_FUNCTION int fmi3Reset(Instance instance)
{
    return instance && of(instance)->reset() ? Ok : Error;
}

/// The arguments behind the state are optional.
FMI3_FUNCTION int fmi3DoStep(Instance instance, double time, double size, bool, bool *needsEvents, bool *wantsStop,
                             bool *isEarly, double *last)
{
    if (!instance || !of(instance)->allows("fmi3DoStep", FmuInstance::Stepping))
        return Error;
    bool wants = false;
    using Result = FmuInstance::StepResult;
    const Result result = of(instance)->doStep(time, size, &wants);
    if (needsEvents)
        *needsEvents = false;
    if (wantsStop)
        *wantsStop = wants;
    if (isEarly)
        *isEarly = false;
    if (last)
        *last = of(instance)->time();
    return result == Result::Failed ? Error : result == Result::Warned ? Warning : Ok;
}

// ---- values ----

#define NUMBERS(Kind, T)                                                                                               \
    FMI3_FUNCTION int fmi3Get##Kind(Instance instance, const Reference *references, std::size_t count, T *values,      \
                                    std::size_t valueCount)                                                            \
    {                                                                                                                  \
        return getNumbers<T>({instance, __func__, readable, references, count, values, valueCount}, FmuVariable::Kind, \
                             values);                                                                                  \
    }                                                                                                                  \
    FMI3_FUNCTION int fmi3Set##Kind(Instance instance, const Reference *references, std::size_t count,                 \
                                    const T *values, std::size_t valueCount)                                           \
    {                                                                                                                  \
        return setNumbers<T>({instance, __func__, writable, references, count, values, valueCount}, FmuVariable::Kind, \
                             values);                                                                                  \
    }

NUMBERS(Float32, float)
NUMBERS(Int8, std::int8_t)
NUMBERS(Int16, std::int16_t)
NUMBERS(Int32, std::int32_t)
NUMBERS(UInt8, std::uint8_t)
NUMBERS(UInt16, std::uint16_t)
NUMBERS(UInt32, std::uint32_t)
NUMBERS(UInt64, quint64)

FMI3_FUNCTION int fmi3GetFloat64(Instance instance, const Reference *references, std::size_t count, double *values,
                                 std::size_t valueCount)
{
    if (instance && count == 1 && references && values && valueCount == 1
        && references[0] == qplc_export::TimeReference) {
        *values = of(instance)->time();
        return Ok;
    }
    return getNumbers<double>({instance, __func__, readable, references, count, values, valueCount},
                              FmuVariable::Float64, values);
}

FMI3_FUNCTION int fmi3SetFloat64(Instance instance, const Reference *references, std::size_t count,
                                 const double *values, std::size_t valueCount)
{
    return setNumbers<double>({instance, __func__, writable, references, count, values, valueCount},
                              FmuVariable::Float64, values);
}

FMI3_FUNCTION int fmi3GetInt64(Instance instance, const Reference *references, std::size_t count, std::int64_t *values,
                               std::size_t valueCount)
{
    return forEach({instance, __func__, readable, references, count, values, valueCount}, isInt64,
                   [values](FmuInstance &fmu, const FmuVariable &variable, std::size_t position) {
                       for (int i = 0; i < variable.count; ++i)
                           values[position + std::size_t(i)] = fmu.runner().integer(variable.signal, i);
                       return true;
                   });
}

FMI3_FUNCTION int fmi3SetInt64(Instance instance, const Reference *references, std::size_t count,
                               const std::int64_t *values, std::size_t valueCount)
{
    return forEach({instance, __func__, writable, references, count, values, valueCount}, isInt64,
                   [values, function = __func__](FmuInstance &fmu, const FmuVariable &variable, std::size_t position) {
                       for (int i = 0; i < variable.count; ++i) {
                           if (!fmu.setInteger(function, variable, values[position + std::size_t(i)], i))
                               return false;
                       }
                       return true;
                   });
}

FMI3_FUNCTION int fmi3GetBoolean(Instance instance, const Reference *references, std::size_t count, bool *values,
                                 std::size_t valueCount)
{
    return forEach({instance, __func__, readable, references, count, values, valueCount}, only(FmuVariable::Boolean),
                   [values](FmuInstance &fmu, const FmuVariable &variable, std::size_t position) {
                       for (int i = 0; i < variable.count; ++i)
                           values[position + std::size_t(i)] = fmu.runner().integer(variable.signal, i) != 0;
                       return true;
                   });
}

FMI3_FUNCTION int fmi3SetBoolean(Instance instance, const Reference *references, std::size_t count, const bool *values,
                                 std::size_t valueCount)
{
    return forEach({instance, __func__, writable, references, count, values, valueCount}, only(FmuVariable::Boolean),
                   [values, function = __func__](FmuInstance &fmu, const FmuVariable &variable, std::size_t position) {
                       for (int i = 0; i < variable.count; ++i) {
                           if (!fmu.setInteger(function, variable, values[position + std::size_t(i)] ? 1 : 0, i))
                               return false;
                       }
                       return true;
                   });
}

FMI3_FUNCTION int fmi3GetString(Instance instance, const Reference *references, std::size_t count, const char **values,
                                std::size_t valueCount)
{
    return forEach({instance, __func__, readable, references, count, values, valueCount}, only(FmuVariable::String),
                   [values](FmuInstance &fmu, const FmuVariable &variable, std::size_t position) {
                       values[position] = fmu.text(variable);
                       return true;
                   });
}

FMI3_FUNCTION int fmi3SetString(Instance instance, const Reference *references, std::size_t count,
                                const char *const *values, std::size_t valueCount)
{
    return forEach({instance, __func__, writable, references, count, values, valueCount}, only(FmuVariable::String),
                   [values, function = __func__](FmuInstance &fmu, const FmuVariable &variable, std::size_t position) {
                       return fmu.setText(function, variable, values[position]);
                   });
}

// ---- not offered ----

#define NOT_OFFERED(function, ...)                                                                                     \
    FMI3_FUNCTION int function(__VA_ARGS__)                                                                            \
    {                                                                                                                  \
        return notOffered(instance, #function);                                                                        \
    }

using References = const Reference *;
using Size = std::size_t;
NOT_OFFERED(fmi3GetBinary, Instance instance, References, Size, Size *, const std::uint8_t **, Size)
NOT_OFFERED(fmi3SetBinary, Instance instance, References, Size, const Size *, const std::uint8_t *const *, Size)
NOT_OFFERED(fmi3GetClock, Instance instance, References, Size, bool *)
NOT_OFFERED(fmi3SetClock, Instance instance, References, Size, const bool *)
NOT_OFFERED(fmi3GetNumberOfVariableDependencies, Instance instance, Reference, Size *)
NOT_OFFERED(fmi3GetVariableDependencies, Instance instance, Reference, Size *, Reference *, Size *, int *, Size)
NOT_OFFERED(fmi3GetFMUState, Instance instance, void **)
NOT_OFFERED(fmi3SetFMUState, Instance instance, void *)
NOT_OFFERED(fmi3FreeFMUState, Instance instance, void **)
NOT_OFFERED(fmi3SerializedFMUStateSize, Instance instance, void *, Size *)
NOT_OFFERED(fmi3SerializeFMUState, Instance instance, void *, std::uint8_t *, Size)
NOT_OFFERED(fmi3DeserializeFMUState, Instance instance, const std::uint8_t *, Size, void **)
NOT_OFFERED(fmi3GetDirectionalDerivative, Instance instance, References, Size, References, Size, const double *, Size,
            double *, Size)
NOT_OFFERED(fmi3GetAdjointDerivative, Instance instance, References, Size, References, Size, const double *, Size,
            double *, Size)
NOT_OFFERED(fmi3EnterEventMode, Instance instance)
NOT_OFFERED(fmi3EnterConfigurationMode, Instance instance)
NOT_OFFERED(fmi3ExitConfigurationMode, Instance instance)
NOT_OFFERED(fmi3GetIntervalDecimal, Instance instance, References, Size, double *, int *)
NOT_OFFERED(fmi3GetIntervalFraction, Instance instance, References, Size, std::uint64_t *, std::uint64_t *, int *)
NOT_OFFERED(fmi3GetShiftDecimal, Instance instance, References, Size, double *)
NOT_OFFERED(fmi3GetShiftFraction, Instance instance, References, Size, std::uint64_t *, std::uint64_t *)
NOT_OFFERED(fmi3SetIntervalDecimal, Instance instance, References, Size, const double *)
NOT_OFFERED(fmi3SetIntervalFraction, Instance instance, References, Size, const std::uint64_t *, const std::uint64_t *)
NOT_OFFERED(fmi3SetShiftDecimal, Instance instance, References, Size, const double *)
NOT_OFFERED(fmi3SetShiftFraction, Instance instance, References, Size, const std::uint64_t *, const std::uint64_t *)
NOT_OFFERED(fmi3EvaluateDiscreteStates, Instance instance)
NOT_OFFERED(fmi3UpdateDiscreteStates, Instance instance, bool *, bool *, bool *, bool *, bool *, double *)
NOT_OFFERED(fmi3EnterContinuousTimeMode, Instance instance)
NOT_OFFERED(fmi3CompletedIntegratorStep, Instance instance, bool, bool *, bool *)
NOT_OFFERED(fmi3SetTime, Instance instance, double)
NOT_OFFERED(fmi3SetContinuousStates, Instance instance, const double *, Size)
NOT_OFFERED(fmi3GetContinuousStateDerivatives, Instance instance, double *, Size)
NOT_OFFERED(fmi3GetEventIndicators, Instance instance, double *, Size)
NOT_OFFERED(fmi3GetContinuousStates, Instance instance, double *, Size)
NOT_OFFERED(fmi3GetNominalsOfContinuousStates, Instance instance, double *, Size)
NOT_OFFERED(fmi3GetNumberOfEventIndicators, Instance instance, Size *)
NOT_OFFERED(fmi3GetNumberOfContinuousStates, Instance instance, Size *)
NOT_OFFERED(fmi3EnterStepMode, Instance instance)
NOT_OFFERED(fmi3GetOutputDerivatives, Instance instance, References, Size, const int *, double *, Size)
NOT_OFFERED(fmi3ActivateModelPartition, Instance instance, Reference, double)
