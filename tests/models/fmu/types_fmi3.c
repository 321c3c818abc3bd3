// SPDX-License-Identifier: Apache-2.0
// An FMU of FMI 3.0 with inputs and outputs of all types that are numbers, and with arrays: after a
// step, each output is its input.
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

// Of each type: a scalar in 0 and out 1, a vector in 2 and out 3. Kind k begins at 100 * k.
enum { Vector = 3, Rows = 2, Columns = 3, Matrix = Rows * Columns };

#define KINDS(DO) \
    DO(1, float, Float32) DO(2, double, Float64) DO(3, int8_t, Int8) DO(4, uint8_t, UInt8) DO(5, int16_t, Int16) \
    DO(6, uint16_t, UInt16) DO(7, int32_t, Int32) DO(8, uint32_t, UInt32) DO(9, int64_t, Int64) \
    DO(10, uint64_t, UInt64) DO(11, bool, Boolean)

#define MEMBERS(KIND, TYPE, NAME) \
    TYPE scalar##NAME[2]; \
    TYPE vector##NAME[2][Vector];
typedef struct
{
    KINDS(MEMBERS)
    int64_t enumeration[2];
    double matrix[2][Matrix];
} Types;

const char *fmi3GetVersion(void)
{
    return "3.0";
}

void *fmi3InstantiateCoSimulation(const char *name, const char *token, const char *resources, bool visible,
                                  bool loggingOn, bool eventModeUsed, bool earlyReturnAllowed,
                                  const uint32_t intermediate[], size_t intermediateCount, void *environment,
                                  void *logMessage, void *intermediateUpdate)
{
    (void)name, (void)resources, (void)visible, (void)loggingOn, (void)eventModeUsed, (void)earlyReturnAllowed;
    (void)intermediate, (void)intermediateCount, (void)environment, (void)logMessage, (void)intermediateUpdate;
    return strcmp(token, "types") == 0 ? calloc(1, sizeof(Types)) : 0;
}

void fmi3FreeInstance(void *instance)
{
    free(instance);
}

int fmi3EnterInitializationMode(void *instance, bool hasTolerance, double tolerance, double start, bool hasStop,
                                double stop)
{
    (void)instance, (void)hasTolerance, (void)tolerance, (void)start, (void)hasStop, (void)stop;
    return 0;
}

static int nothing(void *instance)
{
    (void)instance;
    return 0;
}

int fmi3ExitInitializationMode(void *instance)
{
    return nothing(instance);
}

int fmi3Terminate(void *instance)
{
    return nothing(instance);
}

int fmi3Reset(void *instance)
{
    memset(instance, 0, sizeof(Types));
    return 0;
}

#define PASS(KIND, TYPE, NAME) \
    types->scalar##NAME[1] = types->scalar##NAME[0]; \
    memcpy(types->vector##NAME[1], types->vector##NAME[0], sizeof(types->vector##NAME[0]));

int fmi3DoStep(void *instance, double time, double step, bool noSetStatePriorToTime, bool *needsEvent, bool *terminate,
               bool *isEarly, double *lastTime)
{
    (void)noSetStatePriorToTime;
    Types *types = instance;
    KINDS(PASS)
    types->enumeration[1] = types->enumeration[0];
    memcpy(types->matrix[1], types->matrix[0], sizeof(types->matrix[0]));
    *needsEvent = *terminate = *isEarly = false;
    *lastTime = time + step;
    return 0;
}

/// Copies one value after the other, in the order of the references; \return whether their number
/// is right.
#define ACCESS(KIND, TYPE, NAME) \
    static TYPE *place##NAME(Types *types, uint32_t reference, size_t *size) \
    { \
        const uint32_t number = reference - 100u * KIND; \
        *size = number < 2 ? 1 : Vector; \
        if (KIND == 9 && (number == 4 || number == 5)) { \
            *size = 1; \
            return (TYPE *)(void *)&types->enumeration[number - 4]; \
        } \
        if (KIND == 2 && (number == 4 || number == 5)) { \
            *size = Matrix; \
            return (TYPE *)(void *)types->matrix[number - 4]; \
        } \
        return number < 2 ? &types->scalar##NAME[number] : number < 4 ? types->vector##NAME[number - 2] : 0; \
    } \
    int fmi3Get##NAME(void *instance, const uint32_t references[], size_t count, TYPE values[], size_t valueCount) \
    { \
        size_t used = 0; \
        for (size_t i = 0; i < count; ++i) { \
            size_t size = 0; \
            const TYPE *place = place##NAME(instance, references[i], &size); \
            if (!place || used + size > valueCount) \
                return 3; \
            memcpy(values + used, place, size * sizeof(TYPE)); \
            used += size; \
        } \
        return used == valueCount ? 0 : 3; \
    } \
    int fmi3Set##NAME(void *instance, const uint32_t references[], size_t count, const TYPE values[], \
                      size_t valueCount) \
    { \
        size_t used = 0; \
        for (size_t i = 0; i < count; ++i) { \
            size_t size = 0; \
            TYPE *place = place##NAME(instance, references[i], &size); \
            if (!place || references[i] % 2 != 0 || used + size > valueCount) \
                return 3; \
            memcpy(place, values + used, size * sizeof(TYPE)); \
            used += size; \
        } \
        return used == valueCount ? 0 : 3; \
    }
KINDS(ACCESS)
