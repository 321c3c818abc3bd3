// SPDX-License-Identifier: Apache-2.0
// An integrator with an event and with faults on demand, for tests of the import of FMUs. It
// refuses calls that the standard does not allow in its state.
#ifndef PLANT_H
#define PLANT_H

#include <stdbool.h>

enum State { Instantiated, Initialization, Event, Step, StepFailed, Terminated };
enum Status { Ok, Warning, Discard, Error, Fatal };
enum Fault {
    NoFault,
    DiscardsStep,
    EndsSimulation,
    ReportsError,
    ReportsFatalError,
    WritesNan,
    Crashes,
    Sleeps,
    Hangs,
    FloodsLog,
    AccessesWrongly,
    HangsInitializing,  // says so before
    Exits,
    OverflowsStack,
    ExitsAtOnce,
    ExitsQuickly
};
enum Reference { Time, U, X, Mode, X0, Limit, FaultKind, FaultTime, Gain, Enabled, Label, R1, R2, R3, RefCount };

typedef struct Plant Plant;
struct Plant
{
    enum State state;
    double time, stop, u, x, x0, limit, faultTime, gain;
    int mode, fault, enabled;
    bool isAbove, usesEventMode, isDead, hasEnded;
    char label[64];
    void (*log)(Plant *plant, int status, const char *text);
    void *environment;
    void *logger;
};

void plantReset(Plant *plant);
/// A step; \return a Status
int plantStep(Plant *plant, double time, double step);
/// Whether the event is there that changes the mode.
bool plantHasEvent(const Plant *plant);
void plantHandleEvent(Plant *plant);
int plantGetReal(const Plant *plant, unsigned reference, double *value);
int plantSetReal(Plant *plant, unsigned reference, double value);
/// Whether start values may be set now, or (\a isInput) inputs.
bool plantMaySet(const Plant *plant, bool isInput);
/// Start of the initialization: does not return if that is the fault.
void plantInitialize(const Plant *plant);

#endif
