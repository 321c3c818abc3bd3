// SPDX-License-Identifier: Apache-2.0
// The functions of FMI 2.0 for the plant.
#include "plant.h"

#include <stdlib.h>
#include <string.h>

typedef struct
{
    void (*logger)(void *environment, const char *instance, int status, const char *category, const char *text, ...);
    void *(*allocateMemory)(size_t count, size_t size);
    void (*freeMemory)(void *memory);
    void (*stepFinished)(void *environment, int status);
    void *environment;
} Callbacks;

static const char token[] = "{9d1a4f0e-plant-2}";

static void writeLog(Plant *plant, int status, const char *text)
{
    const Callbacks *callbacks = plant->logger;
    callbacks->logger(callbacks->environment, "plant", status, "plant", "%s", text);
}

const char *fmi2GetVersion(void)
{
    return "2.0";
}

const char *fmi2GetTypesPlatform(void)
{
    return "default";
}

void *fmi2Instantiate(const char *name, int type, const char *guid, const char *resources, const Callbacks *callbacks,
                      int visible, int loggingOn)
{
    if (type != 1 || visible || !name || !resources || strncmp(resources, "file:///", 8) != 0
        || !callbacks->allocateMemory)
        return 0;
    if (strcmp(guid, token) != 0) {
        callbacks->logger(callbacks->environment, name, Error, "plant", "the guid is %s, not %s", guid, token);
        return 0;
    }
    Plant *plant = callbacks->allocateMemory(1, sizeof(Plant));
    plant->log = writeLog;
    plant->logger = (void *)callbacks;
    plantReset(plant);
    if (loggingOn)
        plant->log(plant, Ok, "it logs");
    return plant;
}

void fmi2FreeInstance(void *instance)
{
    Plant *plant = instance;
    ((const Callbacks *)plant->logger)->freeMemory(plant);
}

int fmi2SetDebugLogging(void *instance, int on, size_t count, const char *const categories[])
{
    (void)instance, (void)on, (void)count, (void)categories;
    return Ok;
}

int fmi2SetupExperiment(void *instance, int hasTolerance, double tolerance, double start, int hasStop, double stop)
{
    (void)hasTolerance, (void)tolerance;
    Plant *plant = instance;
    plant->time = start;
    if (hasStop)
        plant->stop = stop;
    return plant->state == Instantiated ? Ok : Error;
}

static int move(Plant *plant, enum State from, enum State to)
{
    if (plant->isDead || plant->state != from)
        return Error;
    plant->state = to;
    return Ok;
}

int fmi2EnterInitializationMode(void *instance)
{
    plantInitialize(instance);
    return move(instance, Instantiated, Initialization);
}

int fmi2ExitInitializationMode(void *instance)
{
    Plant *plant = instance;
    plant->x = plant->x0;
    return move(plant, Initialization, Step);
}

int fmi2Terminate(void *instance)
{
    Plant *plant = instance;
    return plant->state == StepFailed ? move(plant, StepFailed, Terminated) : move(plant, Step, Terminated);
}

int fmi2Reset(void *instance)
{
    Plant *plant = instance;
    if (plant->isDead)
        return Error;
    plantReset(plant);
    return Ok;
}

#ifndef WITHOUT_DO_STEP
int fmi2DoStep(void *instance, double time, double step, int noSetStatePriorToTime)
{
    (void)noSetStatePriorToTime;
    Plant *plant = instance;
    if (plant->state != Step)
        return Error;
    const int status = plantStep(plant, time, step);
    if (status == Discard || plant->hasEnded) {
        plant->state = StepFailed;
        return Discard;
    }
    return status;
}
#endif

int fmi2CancelStep(void *instance)
{
    (void)instance;
    return Error;
}

int fmi2GetBooleanStatus(void *instance, int kind, int *value)
{
    *value = ((Plant *)instance)->hasEnded;
    return kind == 3 ? Ok : Discard;
}

int fmi2GetRealStatus(void *instance, int kind, double *value)
{
    *value = ((Plant *)instance)->time;
    return kind == 2 ? Ok : Discard;
}

static bool mayGet(const Plant *plant)
{
    return !plant->isDead && plant->state != Instantiated;
}

int fmi2GetReal(void *instance, const unsigned references[], size_t count, double values[])
{
    int worst = mayGet(instance) ? Ok : Error;
    for (size_t i = 0; i < count && worst == Ok; ++i)
        worst = plantGetReal(instance, references[i], &values[i]);
    return worst;
}

int fmi2SetReal(void *instance, const unsigned references[], size_t count, const double values[])
{
    int worst = Ok;
    for (size_t i = 0; i < count && worst == Ok; ++i)
        worst = plantSetReal(instance, references[i], values[i]);
    return worst;
}

int fmi2GetInteger(void *instance, const unsigned references[], size_t count, int values[])
{
    const Plant *plant = instance;
    for (size_t i = 0; i < count; ++i) {
        if (!mayGet(plant) || (references[i] != Mode && references[i] != FaultKind))
            return Error;
        values[i] = references[i] == Mode ? plant->mode : plant->fault;
    }
    return Ok;
}

int fmi2SetInteger(void *instance, const unsigned references[], size_t count, const int values[])
{
    Plant *plant = instance;
    if (count != 1 || references[0] != FaultKind || !plantMaySet(plant, false))
        return Error;
    plant->fault = values[0];
    return Ok;
}

int fmi2GetBoolean(void *instance, const unsigned references[], size_t count, int values[])
{
    if (count != 1 || references[0] != Enabled)
        return Error;
    values[0] = ((Plant *)instance)->enabled;
    return Ok;
}

int fmi2SetBoolean(void *instance, const unsigned references[], size_t count, const int values[])
{
    Plant *plant = instance;
    if (count != 1 || references[0] != Enabled || !plantMaySet(plant, true) || values[0] < 0 || values[0] > 1)
        return Error;
    plant->enabled = values[0];
    return Ok;
}

int fmi2GetString(void *instance, const unsigned references[], size_t count, const char *values[])
{
    if (count != 1 || references[0] != Label)
        return Error;
    values[0] = ((Plant *)instance)->label;
    return Ok;
}

int fmi2SetString(void *instance, const unsigned references[], size_t count, const char *const values[])
{
    Plant *plant = instance;
    if (count != 1 || references[0] != Label || strlen(values[0]) >= sizeof(plant->label) || !plantMaySet(plant, false))
        return Error;
    strcpy(plant->label, values[0]);
    plant->log(plant, Warning, plant->label);
    return Ok;
}
