/* SPDX-License-Identifier: Apache-2.0 */
/* An FMU of FMI 3.0 with all types, called rightly and wrongly. No Qt.
 * usage: misuse_fmi3 FOLDER   (of the unpacked FMU all_kinds_fmi3)
 */
#include "state_table.h"

static Fmi3 fmi;
static Description description;
static char token[80];

static uint32_t of(const char *name)
{
    return reference_of(&description, name);
}

static Component make(void)
{
    Component component
        = fmi.instantiate("one", token, NULL, false, false, false, false, NULL, 0, NULL, log3_message, NULL);
    REQUIRE(component != NULL);
    return component;
}

static Component begin(void)
{
    Component component = make();
    REQUIRE(fmi.enter(component, false, 0, 0, false, 0) == STATUS_OK && fmi.leave(component) == STATUS_OK);
    return component;
}

static int step(Component component, double time, double size)
{
    return fmi.step(component, time, size, true, NULL, NULL, NULL, NULL);
}

static void instances_that_cannot_be(void *library)
{
    REQUIRE(!fmi.instantiate("one", "{wrong}", NULL, false, true, false, false, NULL, 0, NULL, log3_message, NULL));
    TOLD("belongs to it");
    REQUIRE(!fmi.instantiate("one", NULL, NULL, false, true, false, false, NULL, 0, NULL, NULL, NULL));
    REQUIRE(!fmi.instantiate("one", token, NULL, false, true, true, false, NULL, 0, NULL, log3_message, NULL));
    TOLD("no event mode");
    const uint32_t reference = 1;
    REQUIRE(!fmi.instantiate("one", token, NULL, false, true, false, false, &reference, 1, NULL, log3_message, NULL));
    TOLD("no intermediate updates");
    REQUIRE(!fmi.instantiate(NULL, token, NULL, false, true, false, false, NULL, 0, NULL, log3_message, NULL));
    Component (*exchange)(const char *, const char *, const char *, bool, bool, void *, Logger3);
    *(void **)&exchange = symbol(library, "fmi3InstantiateModelExchange");
    REQUIRE(!exchange("one", token, NULL, false, true, NULL, log3_message));
    TOLD("co-simulation only");
    REQUIRE(!exchange("one", token, NULL, false, true, NULL, NULL));
    Component quiet = fmi.instantiate("one", token, NULL, false, true, false, true, NULL, 0, NULL, NULL, NULL);
    REQUIRE(quiet && step(quiet, 0, 0.01) == STATUS_ERROR);
    fmi.free_instance(quiet);
    fmi.free_instance(NULL);
    REQUIRE(step(NULL, 0, 0.01) == STATUS_ERROR && fmi.reset(NULL) == STATUS_ERROR);
    REQUIRE(fmi.enter(NULL, false, 0, 0, false, 0) == STATUS_ERROR && fmi.leave(NULL) == STATUS_ERROR);
}

static void order_and_steps(void)
{
    Component component = make();
    bool events = true, stop = true, early = true;
    double last = 0, time = -1;
    const uint32_t clock = of("time");
    REQUIRE(step(component, 0, 0.01) == STATUS_ERROR);
    TOLD("fmi3DoStep is not allowed now");
    REQUIRE(fmi.enter(component, true, 1e-6, 5, true, 10) == STATUS_OK);
    REQUIRE(fmi.enter(component, false, 0, 0, false, 0) == STATUS_ERROR);
    REQUIRE(fmi.leave(component) == STATUS_OK && fmi.leave(component) == STATUS_ERROR);
    REQUIRE(fmi.step(component, 5, 0.02, true, &events, &stop, &early, &last) == STATUS_OK);
    REQUIRE(!events && !stop && !early && fabs(last - 5.02) < 1e-9);
    REQUIRE(fmi.get_float64(component, &clock, 1, &time, 1) == STATUS_OK && time == last);
    REQUIRE(fmi.set_float64(component, &clock, 1, &time, 1) == STATUS_ERROR);
    REQUIRE(step(component, 5.02, 0.005) == STATUS_ERROR);
    TOLD("whole multiple");
    REQUIRE(step(component, 5, 0.01) == STATUS_ERROR && step(component, 5.02, NAN) == STATUS_ERROR);
    REQUIRE(fmi.terminate(component) == STATUS_OK && step(component, 5.02, 0.01) == STATUS_ERROR);
    REQUIRE(fmi.reset(component) == STATUS_OK);
    fmi.free_instance(component);
}

static int (*set_int32)(Component, const uint32_t *, size_t, const int32_t *, size_t);

static void let_fail(Component component)
{
    const uint32_t mode = of("mode");
    const int32_t fails = 1;
    REQUIRE(set_int32(component, &mode, 1, &fails, 1) == STATUS_OK);
}

static int call_enter(Component component)
{
    return fmi.enter(component, false, 0, 0, false, 0);
}
static int call_leave(Component component)
{
    return fmi.leave(component);
}
static int call_step(Component component)
{
    return step(component, 0, 0.01);
}
static int call_terminate(Component component)
{
    return fmi.terminate(component);
}
static int call_reset(Component component)
{
    return fmi.reset(component);
}
static int call_get(Component component)
{
    const uint32_t reference = of("real");
    double value;
    return fmi.get_float64(component, &reference, 1, &value, 1);
}
static int call_set(Component component)
{
    const uint32_t reference = of("real");
    const double value = 1;
    return fmi.set_float64(component, &reference, 1, &value, 1);
}

static void state_table(void)
{
    static const StateRow rows[] = {{"fmi3EnterInitializationMode", call_enter, "+----"},
                                    {"fmi3ExitInitializationMode", call_leave, "-+---"},
                                    {"fmi3DoStep", call_step, "--+--"},
                                    {"fmi3Terminate", call_terminate, "--+-+"},
                                    {"fmi3Reset", call_reset, "+++++"},
                                    {"fmi3GetFloat64", call_get, "-++++"},
                                    {"fmi3SetFloat64", call_set, "+++--"}};
    const StateWays ways
        = {make, call_enter, call_leave, call_step, call_terminate, call_reset, let_fail, fmi.free_instance};
    check_states(&ways, rows, sizeof rows / sizeof *rows);
}

/* What a host should hear also without logging. */
static void warnings(void)
{
    Component component = begin();
    const uint32_t real = of("real"), out = of("realOut");
    const double good = 3, bad = NAN;
    double value = 0;
    REQUIRE(fmi.set_float64(component, &real, 1, &good, 1) == STATUS_OK && step(component, 0, 0.01) == STATUS_OK);
    REQUIRE(fmi.set_float64(component, &real, 1, &bad, 1) == STATUS_OK && step(component, 0.01, 0.01) == STATUS_OK);
    TOLD("real is not finite or outside of its limits");
    REQUIRE(fmi.get_float64(component, &out, 1, &value, 1) == STATUS_OK && value == 3);
    REQUIRE(step(component, 0.02, 0.01) == STATUS_OK && last_message[0] == '\0'); /* once */
    fmi.free_instance(component);
}

static void values(void)
{
    Component component = begin();
    const uint32_t array = of("array"), array_out = of("arrayOut"), big = of("big"), big_out = of("bigOut");
    const uint32_t flag = of("flag"), flag_out = of("flagOut"), phase = of("phase"), phase_out = of("phaseOut");
    const uint32_t text = of("text"), text_out = of("textOut"), real = of("real"), real_out = of("realOut");
    const uint32_t both[] = {real, of("realOut")};
    float single[3] = {0};
    double numbers[2] = {0};
    uint64_t large = 0;
    REQUIRE(step(component, 0, 0.01) == STATUS_OK);
    REQUIRE(fmi.get_float32(component, &array_out, 1, single, 3) == STATUS_OK && single[2] == 0.3f);
    REQUIRE(fmi.get_uint64(component, &big_out, 1, &large, 1) == STATUS_OK && large == UINT64_MAX);
    REQUIRE(fmi.get_float64(component, both, 2, numbers, 2) == STATUS_OK && numbers[0] == 1.5 && numbers[1] == 1.5);
    const float other[] = {4, 5, 6};
    const uint64_t odd = (1ull << 63) + 1;
    const bool no = false;
    const int64_t reel_in = 2, much = 1000;
    const char *word = "abc", *read = NULL;
    REQUIRE(fmi.set_float32(component, &array, 1, other, 3) == STATUS_OK);
    REQUIRE(fmi.set_uint64(component, &big, 1, &odd, 1) == STATUS_OK);
    REQUIRE(fmi.set_boolean(component, &flag, 1, &no, 1) == STATUS_OK);
    REQUIRE(fmi.set_int64(component, &phase, 1, &reel_in, 1) == STATUS_OK);
    REQUIRE(fmi.set_string(component, &text, 1, &word, 1) == STATUS_OK);
    REQUIRE(step(component, 0.01, 0.01) == STATUS_OK);
    int64_t number = 0;
    bool flag_read = true;
    REQUIRE(fmi.get_float32(component, &array_out, 1, single, 3) == STATUS_OK && single[0] == 4 && single[2] == 6);
    REQUIRE(fmi.get_uint64(component, &big_out, 1, &large, 1) == STATUS_OK && large == odd);
    REQUIRE(fmi.get_boolean(component, &flag_out, 1, &flag_read, 1) == STATUS_OK && !flag_read);
    REQUIRE(fmi.get_int64(component, &phase_out, 1, &number, 1) == STATUS_OK && number == 2);
    REQUIRE(fmi.get_string(component, &text_out, 1, &read, 1) == STATUS_OK && strcmp(read, word) == 0);
    /* what cannot be */
    REQUIRE(fmi.set_float32(component, &array, 1, other, 2) == STATUS_ERROR);
    TOLD("too few for 'array' with 3 elements");
    REQUIRE(fmi.set_float64(component, &real, 1, numbers, 2) == STATUS_ERROR);
    TOLD("2 values for 1 elements");
    REQUIRE(fmi.set_float64(component, &array, 1, numbers, 1) == STATUS_ERROR);
    TOLD("variable 'array' has the type Float32");
    REQUIRE(fmi.set_float64(component, &real_out, 1, numbers, 1) == STATUS_ERROR);
    TOLD("is an output");
    REQUIRE(fmi.set_int64(component, &phase, 1, &much, 1) == STATUS_ERROR);
    TOLD("does not fit 'phase'");
    const uint32_t nothing = 4711;
    REQUIRE(fmi.get_float64(component, &nothing, 1, numbers, 1) == STATUS_ERROR);
    REQUIRE(fmi.get_float64(component, NULL, 1, numbers, 1) == STATUS_ERROR);
    REQUIRE(fmi.get_float64(component, &real, 1, NULL, 1) == STATUS_ERROR);
    int8_t tiny;
    REQUIRE(fmi.get_int8(component, &phase, 1, &tiny, 1) == STATUS_ERROR);
    fmi.free_instance(component);
}

static void failures_and_two_instances(void)
{
    Component component = begin(), other = begin();
    const uint32_t mode = of("mode"), out = of("realOut");
    const int32_t fails = 1, stops = 2;
    double value = 0;
    bool stop = false;
    REQUIRE(set_int32(component, &mode, 1, &fails, 1) == STATUS_OK);
    REQUIRE(step(component, 0, 0.01) == STATUS_ERROR);
    TOLD("mode 1 is an error");
    REQUIRE(fmi.get_float64(component, &out, 1, &value, 1) == STATUS_OK && value == -1); /* its safe value */
    REQUIRE(step(other, 0, 0.01) == STATUS_OK);
    REQUIRE(set_int32(other, &mode, 1, &stops, 1) == STATUS_OK);
    REQUIRE(fmi.step(other, 0.01, 0.05, true, NULL, &stop, NULL, &value) == STATUS_OK);
    REQUIRE(stop && fabs(value - 0.02) < 1e-12);
    TOLD("safe stop in cycle 1");
    fmi.free_instance(component);
    fmi.free_instance(other);
}

static void functions_that_are_not_offered(void *library)
{
    static const char *names[] = {"fmi3GetVersion",
                                  "fmi3SetDebugLogging",
                                  "fmi3InstantiateScheduledExecution",
                                  "fmi3EnterEventMode",
                                  "fmi3SetBinary",
                                  "fmi3GetClock",
                                  "fmi3SetClock",
                                  "fmi3GetNumberOfVariableDependencies",
                                  "fmi3GetVariableDependencies",
                                  "fmi3GetFMUState",
                                  "fmi3SetFMUState",
                                  "fmi3FreeFMUState",
                                  "fmi3SerializedFMUStateSize",
                                  "fmi3SerializeFMUState",
                                  "fmi3DeserializeFMUState",
                                  "fmi3GetDirectionalDerivative",
                                  "fmi3GetAdjointDerivative",
                                  "fmi3EnterConfigurationMode",
                                  "fmi3ExitConfigurationMode",
                                  "fmi3GetIntervalDecimal",
                                  "fmi3GetIntervalFraction",
                                  "fmi3GetShiftDecimal",
                                  "fmi3GetShiftFraction",
                                  "fmi3SetIntervalDecimal",
                                  "fmi3SetIntervalFraction",
                                  "fmi3SetShiftDecimal",
                                  "fmi3SetShiftFraction",
                                  "fmi3EvaluateDiscreteStates",
                                  "fmi3UpdateDiscreteStates",
                                  "fmi3EnterContinuousTimeMode",
                                  "fmi3CompletedIntegratorStep",
                                  "fmi3SetTime",
                                  "fmi3SetContinuousStates",
                                  "fmi3GetContinuousStateDerivatives",
                                  "fmi3GetEventIndicators",
                                  "fmi3GetContinuousStates",
                                  "fmi3GetNominalsOfContinuousStates",
                                  "fmi3GetNumberOfEventIndicators",
                                  "fmi3GetNumberOfContinuousStates",
                                  "fmi3EnterStepMode",
                                  "fmi3GetOutputDerivatives",
                                  "fmi3ActivateModelPartition",
                                  "fmi3GetInt16",
                                  "fmi3SetInt8",
                                  "fmi3GetUInt8",
                                  "fmi3SetUInt16",
                                  "fmi3GetUInt32"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        symbol(library, names[i]);
    int (*get_binary)(Component, const uint32_t *, size_t, size_t *, const uint8_t **, size_t);
    *(void **)&get_binary = symbol(library, "fmi3GetBinary");
    Component component = begin();
    REQUIRE(get_binary(component, NULL, 0, NULL, NULL, 0) == STATUS_ERROR);
    TOLD("fmi3GetBinary is not offered");
    REQUIRE(get_binary(NULL, NULL, 0, NULL, NULL, 0) == STATUS_ERROR);
    fmi.free_instance(component);
}

int main(int argc, char **argv)
{
    char path[1024];
    if (argc != 2)
        return 2;
    snprintf(path, sizeof path, "%s/modelDescription.xml", argv[1]);
    description = read_description(path);
    copy_attribute(description.text, "instantiationToken", token, sizeof token);
    snprintf(path, sizeof path, "%s/binaries/x86_64-linux/all_kinds.so", argv[1]);
    void *library = open_library(path);
    fmi = load3(library);
    instances_that_cannot_be(library);
    *(void **)&set_int32 = symbol(library, "fmi3SetInt32");
    order_and_steps();
    state_table();
    warnings();
    values();
    failures_and_two_instances();
    functions_that_are_not_offered(library);
    free(description.text);
    dlclose(library);
    puts("FMI 3 is as it should be");
    return 0;
}
