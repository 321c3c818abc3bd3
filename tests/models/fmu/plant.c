// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "plant.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

void plantReset(Plant *plant)
{
    plant->state = Instantiated;
    plant->time = plant->u = plant->x = plant->x0 = 0.0;
    plant->limit = plant->faultTime = plant->stop = 1e300;
    plant->gain = 1.0;
    plant->mode = 0;
    plant->fault = NoFault;
    plant->enabled = 1;
    plant->hasEnded = false;
    strcpy(plant->label, "plain");
}

static void sleepFor(long milliseconds)
{
    const struct timespec time = {milliseconds / 1000, milliseconds % 1000 * 1000000};
    nanosleep(&time, 0);
}

/* Takes all of the stack, and needs it afterwards. */
static int descend(Plant *plant, int depth)
{
    volatile char room[4096];
    room[depth % 4096] = (char)depth;
    return plant->fault == OverflowsStack ? descend(plant, depth + 1) + room[depth % 4096] : Ok;
}

static int fail(Plant *plant)
{
    switch (plant->fault) {
    case DiscardsStep:
        return Discard;
    case EndsSimulation:
        plant->hasEnded = true;
        return Ok;
    case ReportsError:
        plant->log(plant, Error, "the tank is empty");
        return Error;
    case ReportsFatalError:
        plant->log(plant, Fatal, "the tank has burst");
        plant->isDead = true;
        return Fatal;
    case Crashes:
        *(volatile int *)0 = 1;
        return Ok;
    case Exits:
        exit(0);
    case ExitsAtOnce:
        _exit(0);
    case ExitsQuickly:
        quick_exit(0);
    case OverflowsStack:
        return descend(plant, 0);
    case Sleeps:
        sleepFor(150);
        return Ok;
    case Hangs:
        for (;;)
            sleepFor(1000);
    case FloodsLog:
        for (int i = 0; i < 1000; ++i)
            plant->log(plant, Warning, "flood");
        return Ok;
    default:
        return Ok;
    }
}

void plantInitialize(const Plant *plant)
{
    if (plant->fault != HangsInitializing)
        return;
    fputs("the plant hangs\n", stderr);
    for (;;)
        sleepFor(1000);
}

int plantStep(Plant *plant, double time, double step)
{
    const bool isFaulty = plant->fault != NoFault && time + step > plant->faultTime - 1e-9;
    if (fabs(time - plant->time) > 1e-9 || !(step > 0.0)) {
        plant->log(plant, Error, "this is not the time that was reached");
        return Error;
    }
    if (time + step > plant->stop + 1e-9) {
        plant->log(plant, Error, "this is beyond the stop time");
        return Error;
    }
    if (isFaulty && plant->fault != WritesNan) {
        const int status = fail(plant);
        if (status != Ok || plant->hasEnded)
            return status;
    }
    if (plant->enabled)
        plant->x += plant->gain * plant->u * step;
    plant->time = time + step;
    if (!plant->usesEventMode && plantHasEvent(plant))
        plantHandleEvent(plant);
    return Ok;
}

bool plantHasEvent(const Plant *plant)
{
    return (plant->x >= plant->limit) != (plant->mode != 0);
}

void plantHandleEvent(Plant *plant)
{
    plant->mode = plant->x >= plant->limit ? 1 : 0;
}

int plantGetReal(const Plant *plant, unsigned reference, double *value)
{
    const bool isNan = plant->fault == WritesNan && plant->time > plant->faultTime - 1e-9;
    const double x = isNan ? NAN : plant->state == Initialization ? plant->x0 : plant->x;
    switch (reference) {
    case Time:
        *value = plant->time;
        return Ok;
    case U:
        *value = plant->u;
        return Ok;
    case X:
        *value = x;
        return Ok;
    case X0:
        *value = plant->x0;
        return Ok;
    case Limit:
        *value = plant->limit;
        return Ok;
    case FaultTime:
        *value = plant->faultTime;
        return Ok;
    case Gain:
        *value = plant->gain;
        return Ok;
    case R1:
    case R2:
    case R3:
        *value = x * (double)(reference - R1 + 1);
        return Ok;
    default:
        return Error;
    }
}

int plantSetReal(Plant *plant, unsigned reference, double value)
{
    if (!plantMaySet(plant, reference == U || reference == Gain))
        return Error;
    switch (reference) {
    case U:
        plant->u = value;
        return Ok;
    case X0:
        plant->x0 = value;
        return Ok;
    case Limit:
        plant->limit = value;
        return Ok;
    case FaultTime:
        plant->faultTime = value;
        return Ok;
    case Gain:
        plant->gain = value;
        return Ok;
    default:
        return Error;
    }
}

bool plantMaySet(const Plant *plant, bool isInput)
{
    return !plant->isDead
        && (plant->state == Instantiated
            || (isInput && (plant->state == Initialization || plant->state == Step || plant->state == Event)));
}
