/* SPDX-License-Identifier: Apache-2.0 */
/* The table of states of FMI 2.0 and 3.0: which function may be called in which state. */
#pragma once

#include "fmu_host.h"

/* The states of the standard. */
enum { INSTANTIATED, INITIALIZING, STEPPING, TERMINATED, FAILED, STATES };

/* A function of an FMU. */
typedef struct
{
    const char *name;
    int (*call)(Component);
    const char *allowed; /* '+' or '-' for each of the states */
} StateRow;

/* The ways from one state to another, in the version of the FMU. */
typedef struct
{
    Component (*make)(void);
    int (*enter)(Component);
    int (*leave)(Component);
    int (*step)(Component);
    int (*terminate)(Component);
    int (*reset)(Component);
    void (*let_fail)(Component); /* in the next step */
    void (*free_instance)(Component);
} StateWays;

static Component in_state(const StateWays *ways, int state)
{
    Component component = ways->make();
    if (state >= INITIALIZING)
        REQUIRE(ways->enter(component) == STATUS_OK);
    if (state >= STEPPING)
        REQUIRE(ways->leave(component) == STATUS_OK);
    if (state == TERMINATED)
        REQUIRE(ways->terminate(component) == STATUS_OK);
    if (state == FAILED) {
        ways->let_fail(component);
        REQUIRE(ways->step(component) == STATUS_ERROR);
    }
    last_message[0] = '\0';
    return component;
}

/* Each function in each state does its work, or is an error with a sentence; the instance works afterwards. */
static void check_states(const StateWays *ways, const StateRow *rows, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        for (int state = INSTANTIATED; state < STATES; ++state) {
            Component component = in_state(ways, state);
            const int status = rows[i].call(component);
            if (rows[i].allowed[state] == '+') {
                REQUIRE(status == STATUS_OK);
            } else {
                REQUIRE(status == STATUS_ERROR && strstr(last_message, rows[i].name));
                TOLD("is not allowed now, because it ");
            }
            REQUIRE(ways->reset(component) == STATUS_OK && ways->enter(component) == STATUS_OK);
            REQUIRE(ways->leave(component) == STATUS_OK && ways->step(component) == STATUS_OK);
            ways->free_instance(component);
        }
        REQUIRE(rows[i].call(NULL) == STATUS_ERROR);
    }
}
