/* SPDX-License-Identifier: Apache-2.0 */
/* What a host of FMUs knows: the functions of both standards that these tests call. No Qt. */
#ifndef FMU_HOST_H
#define FMU_HOST_H

#include <dlfcn.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STATUS_OK, STATUS_WARNING, STATUS_DISCARD, STATUS_ERROR };

static char last_message[4096]; /* what the host was told last */

#define REQUIRE(condition)                                                                                             \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            fprintf(stderr, "%s:%d: %s\nlast message: %s\n", __FILE__, __LINE__, #condition, last_message);            \
            exit(1);                                                                                                   \
        }                                                                                                              \
    } while (0)

/* The host was told a sentence with this text; it is forgotten then. */
#define TOLD(text)                                                                                                     \
    do {                                                                                                               \
        REQUIRE(strstr(last_message, text) != NULL);                                                                   \
        last_message[0] = '\0';                                                                                        \
    } while (0)

static inline void *symbol(void *library, const char *name)
{
    void *address = dlsym(library, name);
    if (!address) {
        fprintf(stderr, "there is no function %s\n", name);
        exit(1);
    }
    return address;
}

static inline void *open_library(const char *file)
{
    void *library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        fprintf(stderr, "%s\n", dlerror());
        exit(1);
    }
    return library;
}

/* modelDescription.xml, read as text: enough for files whose form is known. */
typedef struct
{
    char *text;
} Description;

static inline Description read_description(const char *file)
{
    Description description = {NULL};
    FILE *stream = fopen(file, "rb");
    REQUIRE(stream != NULL);
    description.text = calloc(1, 1 << 20);
    const size_t size = fread(description.text, 1, (1 << 20) - 1, stream);
    fclose(stream);
    REQUIRE(size > 0);
    return description;
}

static inline void copy_attribute(const char *from, const char *name, char *value, size_t size)
{
    char wanted[80];
    snprintf(wanted, sizeof wanted, " %s=\"", name);
    const char *begin = strstr(from, wanted);
    REQUIRE(begin != NULL);
    begin += strlen(wanted);
    const char *end = strchr(begin, '"');
    REQUIRE(end != NULL && (size_t)(end - begin) < size);
    memcpy(value, begin, (size_t)(end - begin));
    value[end - begin] = '\0';
}

static inline unsigned reference_of(const Description *description, const char *variable)
{
    char wanted[120], value[20];
    snprintf(wanted, sizeof wanted, " name=\"%s\" valueReference=", variable);
    const char *begin = strstr(description->text, wanted);
    if (!begin) {
        fprintf(stderr, "there is no variable %s\n", variable);
        exit(1);
    }
    copy_attribute(begin, "valueReference", value, sizeof value);
    return (unsigned)strtoul(value, NULL, 10);
}

/* ---- FMI 2 ---- */

typedef void *Component;
typedef struct
{
    void (*logger)(void *, const char *, int, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*finished)(void *, int);
    void *environment;
} Callbacks2;

typedef struct
{
    Component (*instantiate)(const char *, int, const char *, const char *, const Callbacks2 *, int, int);
    void (*free_instance)(Component);
    int (*setup)(Component, int, double, double, int, double);
    int (*enter)(Component);
    int (*leave)(Component);
    int (*terminate)(Component);
    int (*reset)(Component);
    int (*step)(Component, double, double, int);
    int (*get_real)(Component, const unsigned *, size_t, double *);
    int (*set_real)(Component, const unsigned *, size_t, const double *);
    int (*get_integer)(Component, const unsigned *, size_t, int *);
    int (*set_integer)(Component, const unsigned *, size_t, const int *);
    int (*get_boolean)(Component, const unsigned *, size_t, int *);
    int (*set_boolean)(Component, const unsigned *, size_t, const int *);
    int (*get_string)(Component, const unsigned *, size_t, const char **);
    int (*set_string)(Component, const unsigned *, size_t, const char *const *);
    int (*get_real_status)(Component, int, double *);
    int (*get_boolean_status)(Component, int, int *);
    int (*set_logging)(Component, int, size_t, const char *const *);
} Fmi2;

static inline void log2_message(void *environment, const char *instance, int status, const char *category,
                                const char *format, ...)
{
    (void)environment, (void)instance, (void)status, (void)category;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(last_message, sizeof last_message, format, arguments);
    va_end(arguments);
}

static inline Fmi2 load2(void *library)
{
    Fmi2 fmi;
#define LOAD(member, name) *(void **)&fmi.member = symbol(library, name)
    LOAD(instantiate, "fmi2Instantiate");
    LOAD(free_instance, "fmi2FreeInstance");
    LOAD(setup, "fmi2SetupExperiment");
    LOAD(enter, "fmi2EnterInitializationMode");
    LOAD(leave, "fmi2ExitInitializationMode");
    LOAD(terminate, "fmi2Terminate");
    LOAD(reset, "fmi2Reset");
    LOAD(step, "fmi2DoStep");
    LOAD(get_real, "fmi2GetReal");
    LOAD(set_real, "fmi2SetReal");
    LOAD(get_integer, "fmi2GetInteger");
    LOAD(set_integer, "fmi2SetInteger");
    LOAD(get_boolean, "fmi2GetBoolean");
    LOAD(set_boolean, "fmi2SetBoolean");
    LOAD(get_string, "fmi2GetString");
    LOAD(set_string, "fmi2SetString");
    LOAD(get_real_status, "fmi2GetRealStatus");
    LOAD(get_boolean_status, "fmi2GetBooleanStatus");
    LOAD(set_logging, "fmi2SetDebugLogging");
#undef LOAD
    return fmi;
}

/* ---- FMI 3 ---- */

typedef void (*Logger3)(void *, int, const char *, const char *);
typedef struct
{
    Component (*instantiate)(const char *, const char *, const char *, bool, bool, bool, bool, const uint32_t *, size_t,
                             void *, Logger3, void (*)(void));
    void (*free_instance)(Component);
    int (*enter)(Component, bool, double, double, bool, double);
    int (*leave)(Component);
    int (*terminate)(Component);
    int (*reset)(Component);
    int (*step)(Component, double, double, bool, bool *, bool *, bool *, double *);
    int (*get_float64)(Component, const uint32_t *, size_t, double *, size_t);
    int (*set_float64)(Component, const uint32_t *, size_t, const double *, size_t);
    int (*get_float32)(Component, const uint32_t *, size_t, float *, size_t);
    int (*set_float32)(Component, const uint32_t *, size_t, const float *, size_t);
    int (*get_int8)(Component, const uint32_t *, size_t, int8_t *, size_t);
    int (*get_int64)(Component, const uint32_t *, size_t, int64_t *, size_t);
    int (*set_int64)(Component, const uint32_t *, size_t, const int64_t *, size_t);
    int (*get_uint64)(Component, const uint32_t *, size_t, uint64_t *, size_t);
    int (*set_uint64)(Component, const uint32_t *, size_t, const uint64_t *, size_t);
    int (*get_boolean)(Component, const uint32_t *, size_t, bool *, size_t);
    int (*set_boolean)(Component, const uint32_t *, size_t, const bool *, size_t);
    int (*get_string)(Component, const uint32_t *, size_t, const char **, size_t);
    int (*set_string)(Component, const uint32_t *, size_t, const char *const *, size_t);
} Fmi3;

static inline void log3_message(void *environment, int status, const char *category, const char *text)
{
    (void)environment, (void)status, (void)category;
    snprintf(last_message, sizeof last_message, "%s", text);
}

static inline Fmi3 load3(void *library)
{
    Fmi3 fmi;
#define LOAD(member, name) *(void **)&fmi.member = symbol(library, name)
    LOAD(instantiate, "fmi3InstantiateCoSimulation");
    LOAD(free_instance, "fmi3FreeInstance");
    LOAD(enter, "fmi3EnterInitializationMode");
    LOAD(leave, "fmi3ExitInitializationMode");
    LOAD(terminate, "fmi3Terminate");
    LOAD(reset, "fmi3Reset");
    LOAD(step, "fmi3DoStep");
    LOAD(get_float64, "fmi3GetFloat64");
    LOAD(set_float64, "fmi3SetFloat64");
    LOAD(get_float32, "fmi3GetFloat32");
    LOAD(set_float32, "fmi3SetFloat32");
    LOAD(get_int8, "fmi3GetInt8");
    LOAD(get_int64, "fmi3GetInt64");
    LOAD(set_int64, "fmi3SetInt64");
    LOAD(get_uint64, "fmi3GetUInt64");
    LOAD(set_uint64, "fmi3SetUInt64");
    LOAD(get_boolean, "fmi3GetBoolean");
    LOAD(set_boolean, "fmi3SetBoolean");
    LOAD(get_string, "fmi3GetString");
    LOAD(set_string, "fmi3SetString");
#undef LOAD
    return fmi;
}

#endif
