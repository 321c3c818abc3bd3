/* SPDX-License-Identifier: Apache-2.0 */
/* What a host of a plant knows: FMUs of both standards behind one face, and the programs of the
 * nodes. No Qt.
 */
#ifndef PLANT_HOST_H
#define PLANT_HOST_H

#include "fmu_host.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define MOST_NODES 4

/* Qt keeps what it knows of the first thread of a host until its end, when another thread has the
 * application. A sanitizer calls this.
 */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libQt5Core.so\n";
}

/* A program with its standard output. */
typedef struct
{
    pid_t process;
    FILE *output;
} Program;

static inline Program start_program(char *const *arguments)
{
    Program program = {0, NULL};
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    program.process = fork();
    REQUIRE(program.process >= 0);
    if (program.process == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL); /* a host that fails leaves none behind */
        dup2(ends[1], 1);
        close(ends[0]);
        close(ends[1]);
        execv(arguments[0], arguments);
        _exit(126);
    }
    close(ends[1]);
    program.output = fdopen(ends[0], "r");
    return program;
}

/* Its next line, without the end; fails when there is none. */
static inline void read_line(const Program *program, char *line, int size)
{
    REQUIRE(fgets(line, size, program->output) != NULL);
    line[strcspn(line, "\n")] = '\0';
}

/* Waits for the end; returns the exit code, or minus the signal. */
static inline int finish(Program *program)
{
    int status = 0;
    REQUIRE(waitpid(program->process, &status, 0) == program->process);
    fclose(program->output);
    program->process = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

static inline double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* The library of an FMU, and an instance of it. */
typedef struct
{
    int version;
    Description description;
    void *library;
    Fmi2 fmi2;
    Fmi3 fmi3;
    int (*set_int32)(Component, const uint32_t *, size_t, const int32_t *, size_t);
    char identification[80];
} Library;

typedef struct Plant Plant;
struct Plant
{
    const Library *of;
    Component component;
    Callbacks2 callbacks;
    int port;
    void (*begin)(Plant *); /* starts the nodes, as soon as the master listens; null: nothing */
    Program nodes[MOST_NODES];
    char warning[1024]; /* the last one */
    int warnings;
    char digest[40];
    long cycle;
    bool is_over; /* it wants the simulation to end */
};

static inline Library load_library(int version, const char *folder, const char *file)
{
    char path[1024];
    Library library = {.version = version};
    snprintf(path, sizeof path, "%s/modelDescription.xml", folder);
    library.description = read_description(path);
    copy_attribute(library.description.text, version == 2 ? "guid" : "instantiationToken", library.identification,
                   sizeof library.identification);
    library.library = open_library(file);
    if (version == 2) {
        library.fmi2 = load2(library.library);
    } else {
        library.fmi3 = load3(library.library);
        *(void **)&library.set_int32 = symbol(library.library, "fmi3SetInt32");
    }
    return library;
}

static inline void take_message(Plant *plant, int status, const char *text)
{
    const char *port = strstr(text, ", port "), *digest = strstr(text, "digest of all values is ");
    snprintf(last_message, sizeof last_message, "%s", text);
    if (status == STATUS_WARNING) {
        snprintf(plant->warning, sizeof plant->warning, "%s", text);
        ++plant->warnings;
    }
    if (digest)
        snprintf(plant->digest, sizeof plant->digest, "%s", digest + strlen("digest of all values is "));
    if (status == STATUS_OK && port) {
        plant->port = atoi(port + strlen(", port "));
        if (plant->begin)
            plant->begin(plant);
    }
}

static inline void log2_of_plant(void *environment, const char *instance, int status, const char *category,
                                 const char *format, ...)
{
    char text[1024];
    va_list arguments;
    (void)instance, (void)category;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    take_message(environment, status, text);
}

static inline void log3_of_plant(void *environment, int status, const char *category, const char *text)
{
    (void)category;
    take_message(environment, status, text);
}

static int is_logging = 0; /* of the next instances: then they also tell what is no warning */

/* The plant must stay where it is: the instance has its address. */
static inline void make_plant(Plant *plant, const Library *library, void (*begin)(Plant *))
{
    memset(plant, 0, sizeof *plant);
    plant->of = library;
    plant->begin = begin;
    plant->callbacks = (Callbacks2){log2_of_plant, NULL, NULL, NULL, plant};
    plant->component = library->version == 2
        ? library->fmi2.instantiate("plant", 1, library->identification, NULL, &plant->callbacks, 0, is_logging)
        : library->fmi3.instantiate("plant", library->identification, NULL, false, is_logging, false, false, NULL, 0,
                                    plant, log3_of_plant, NULL);
    REQUIRE(plant->component != NULL);
}

static inline int enter_plant(Plant *plant)
{
    if (plant->of->version == 3)
        return plant->of->fmi3.enter(plant->component, false, 0, 0, false, 0);
    REQUIRE(plant->of->fmi2.setup(plant->component, 0, 0, 0, 0, 0) == STATUS_OK);
    return plant->of->fmi2.enter(plant->component);
}

static inline int leave_plant(Plant *plant)
{
    plant->cycle = 0;
    plant->is_over = false;
    return plant->of->version == 2 ? plant->of->fmi2.leave(plant->component) : plant->of->fmi3.leave(plant->component);
}

static inline int step_by(Plant *plant, int periods)
{
    const double time = 0.01 * (double)plant->cycle, size = 0.01 * periods;
    int status, terminated = 0;
    if (plant->of->version == 2) {
        status = plant->of->fmi2.step(plant->component, time, size, 1);
        if (status == STATUS_DISCARD)
            REQUIRE(plant->of->fmi2.get_boolean_status(plant->component, 3, &terminated) == STATUS_OK);
        plant->is_over = terminated != 0;
    } else {
        status = plant->of->fmi3.step(plant->component, time, size, true, NULL, &plant->is_over, NULL, NULL);
    }
    plant->cycle += periods;
    return status;
}

static inline int terminate_plant(Plant *plant)
{
    return plant->of->version == 2 ? plant->of->fmi2.terminate(plant->component)
                                   : plant->of->fmi3.terminate(plant->component);
}

static inline int reset_plant(Plant *plant)
{
    return plant->of->version == 2 ? plant->of->fmi2.reset(plant->component) : plant->of->fmi3.reset(plant->component);
}

static inline void free_plant(Plant *plant)
{
    if (plant->of->version == 2)
        plant->of->fmi2.free_instance(plant->component);
    else
        plant->of->fmi3.free_instance(plant->component);
    plant->component = NULL;
}

static inline int set_number(const Plant *plant, const char *name, double value)
{
    const uint32_t reference = reference_of(&plant->of->description, name);
    return plant->of->version == 2 ? plant->of->fmi2.set_real(plant->component, &reference, 1, &value)
                                   : plant->of->fmi3.set_float64(plant->component, &reference, 1, &value, 1);
}

static inline int set_integer(const Plant *plant, const char *name, int value)
{
    const uint32_t reference = reference_of(&plant->of->description, name);
    return plant->of->version == 2 ? plant->of->fmi2.set_integer(plant->component, &reference, 1, &value)
                                   : plant->of->set_int32(plant->component, &reference, 1, &value, 1);
}

static inline int set_text(const Plant *plant, const char *name, const char *value)
{
    const uint32_t reference = reference_of(&plant->of->description, name);
    return plant->of->version == 2 ? plant->of->fmi2.set_string(plant->component, &reference, 1, &value)
                                   : plant->of->fmi3.set_string(plant->component, &reference, 1, &value, 1);
}

/* Of both precisions: in FMI 3 each has its function. */
static inline double number(const Plant *plant, const char *name)
{
    const uint32_t reference = reference_of(&plant->of->description, name);
    double value = -999;
    float single;
    if (plant->of->version == 2) {
        REQUIRE(plant->of->fmi2.get_real(plant->component, &reference, 1, &value) == STATUS_OK);
        return value;
    }
    if (plant->of->fmi3.get_float64(plant->component, &reference, 1, &value, 1) == STATUS_OK)
        return value;
    REQUIRE(plant->of->fmi3.get_float32(plant->component, &reference, 1, &single, 1) == STATUS_OK);
    return (double)single;
}

#endif
