// SPDX-License-Identifier: Apache-2.0
// The functions of FMI 3.0 for the plant, with event mode.
#include "plant.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef void (*LogMessage)(void *environment, int status, const char *category, const char *text);

static const char token[] = "{9d1a4f0e-plant-3}";

static void writeLog(Plant *plant, int status, const char *text)
{
    ((LogMessage)plant->logger)(plant->environment, status, "plant", text);
}

const char *fmi3GetVersion(void)
{
    return "3.0";
}

void *fmi3InstantiateCoSimulation(const char *name, const char *instantiationToken, const char *resources, bool visible,
                                  bool loggingOn, bool eventModeUsed, bool earlyReturnAllowed,
                                  const uint32_t intermediate[], size_t intermediateCount, void *environment,
                                  LogMessage logMessage, void *intermediateUpdate)
{
    (void)intermediate, (void)intermediateUpdate, (void)loggingOn;
    if (visible || earlyReturnAllowed || intermediateCount != 0 || !name || !resources || resources[0] != '/'
        || resources[strlen(resources) - 1] != '/' || strcmp(instantiationToken, token) != 0)
        return 0;
#ifdef WITHOUT_EVENT_MODE
    if (eventModeUsed)
        return 0;
#endif
    Plant *plant = calloc(1, sizeof(Plant));
    plant->log = writeLog;
    plant->logger = (void *)logMessage;
    plant->environment = environment;
    plant->usesEventMode = eventModeUsed;
    plantReset(plant);
    return plant;
}

void fmi3FreeInstance(void *instance)
{
    free(instance);
}

static int move(Plant *plant, enum State from, enum State to)
{
    if (plant->isDead || plant->state != from)
        return Error;
    plant->state = to;
    return Ok;
}

int fmi3EnterInitializationMode(void *instance, bool hasTolerance, double tolerance, double start, bool hasStop,
                                double stop)
{
    (void)hasTolerance, (void)tolerance;
    ((Plant *)instance)->time = start;
    if (hasStop)
        ((Plant *)instance)->stop = stop;
    plantInitialize(instance);
    return move(instance, Instantiated, Initialization);
}

int fmi3ExitInitializationMode(void *instance)
{
    Plant *plant = instance;
    plant->x = plant->x0;
    return move(plant, Initialization, plant->usesEventMode ? Event : Step);
}

int fmi3EnterEventMode(void *instance)
{
    return move(instance, Step, Event);
}

int fmi3EnterStepMode(void *instance)
{
    return move(instance, Event, Step);
}

int fmi3UpdateDiscreteStates(void *instance, bool *needsUpdate, bool *terminate, bool *nominalsChanged,
                             bool *statesChanged, bool *hasNextTime, double *nextTime)
{
    Plant *plant = instance;
    if (plant->state != Event)
        return Error;
    *needsUpdate = plantHasEvent(plant);
    plantHandleEvent(plant);
    *terminate = *nominalsChanged = *statesChanged = *hasNextTime = false;
    *nextTime = 0.0;
    return Ok;
}

int fmi3Terminate(void *instance)
{
    return move(instance, Step, Terminated);
}

int fmi3Reset(void *instance)
{
    Plant *plant = instance;
    if (plant->isDead)
        return Error;
    plantReset(plant);
    return Ok;
}

int fmi3DoStep(void *instance, double time, double step, bool noSetStatePriorToTime, bool *needsEvent, bool *terminate,
               bool *isEarly, double *lastTime)
{
    (void)noSetStatePriorToTime;
    Plant *plant = instance;
    if (plant->state != Step)
        return Error;
    const int status = plantStep(plant, time, step);
    *needsEvent = plant->usesEventMode && plantHasEvent(plant);
    *terminate = plant->hasEnded;
    *isEarly = false;
    *lastTime = plant->time;
    return status;
}

int fmi3GetFloat64(void *instance, const uint32_t references[], size_t count, double values[], size_t valueCount)
{
    const Plant *plant = instance;
    size_t used = 0;
    for (size_t i = 0; i < count; ++i) {
        const bool isArray = references[i] == R1;
        const size_t size = isArray ? 3 : 1;
        if (plant->isDead || used + size > valueCount)
            return Error;
        for (size_t element = 0; element < size; ++element) {
            if (plantGetReal(plant, references[i] + (uint32_t)element, &values[used++]) != Ok)
                return Error;
        }
    }
    return used == valueCount ? Ok : Error;
}

/// In event mode, what is not continuous changes at events only.
static bool isAllowed(const Plant *plant, bool isDiscrete)
{
    return !(isDiscrete && plant->usesEventMode && plant->state == Step);
}

int fmi3SetFloat64(void *instance, const uint32_t references[], size_t count, const double values[], size_t valueCount)
{
    Plant *plant = instance;
    for (size_t i = 0; i < count; ++i) {
        if (count != valueCount || !isAllowed(plant, references[i] != U)
            || plantSetReal(plant, references[i], values[i]) != Ok)
            return Error;
    }
    return Ok;
}

int fmi3GetInt64(void *instance, const uint32_t references[], size_t count, int64_t values[], size_t valueCount)
{
    if (count != 1 || valueCount != 1 || references[0] != Mode)
        return Error;
    values[0] = ((Plant *)instance)->mode;
    return Ok;
}

int fmi3SetInt64(void *instance, const uint32_t references[], size_t count, const int64_t values[], size_t valueCount)
{
    (void)instance, (void)references, (void)count, (void)values, (void)valueCount;
    return Error;
}

int fmi3GetInt32(void *instance, const uint32_t references[], size_t count, int32_t values[], size_t valueCount)
{
    if (count != 1 || valueCount != 1 || references[0] != FaultKind)
        return Error;
    values[0] = ((Plant *)instance)->fault;
    return Ok;
}

int fmi3SetInt32(void *instance, const uint32_t references[], size_t count, const int32_t values[], size_t valueCount)
{
    Plant *plant = instance;
    if (count != 1 || valueCount != 1 || references[0] != FaultKind || !plantMaySet(plant, false))
        return Error;
    plant->fault = values[0];
    return Ok;
}

int fmi3GetBoolean(void *instance, const uint32_t references[], size_t count, bool values[], size_t valueCount)
{
    if (count != 1 || valueCount != 1 || references[0] != Enabled)
        return Error;
    values[0] = ((Plant *)instance)->enabled;
    return Ok;
}

int fmi3SetBoolean(void *instance, const uint32_t references[], size_t count, const bool values[], size_t valueCount)
{
    Plant *plant = instance;
    if (count != 1 || valueCount != 1 || references[0] != Enabled || !plantMaySet(plant, true)
        || !isAllowed(plant, true))
        return Error;
    plant->enabled = values[0];
    return Ok;
}

int fmi3GetString(void *instance, const uint32_t references[], size_t count, const char *values[], size_t valueCount)
{
    if (count != 1 || valueCount != 1 || references[0] != Label)
        return Error;
    values[0] = ((Plant *)instance)->label;
    return Ok;
}

int fmi3SetString(void *instance, const uint32_t references[], size_t count, const char *const values[],
                  size_t valueCount)
{
    Plant *plant = instance;
    if (count != 1 || valueCount != 1 || references[0] != Label || strlen(values[0]) >= sizeof(plant->label))
        return Error;
    strcpy(plant->label, values[0]);
    return Ok;
}
