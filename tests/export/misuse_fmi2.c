/* SPDX-License-Identifier: Apache-2.0 */
/* An FMU of FMI 2.0 with all types, called rightly and wrongly. No Qt.
 * usage: misuse_fmi2 FOLDER   (of the unpacked FMU all_kinds)
 */
#include "state_table.h"

static Fmi2 fmi;
static Description description;
static char guid[80];
static const Callbacks2 callbacks = {log2_message, NULL, NULL, NULL, NULL};

static unsigned of(const char *name)
{
    return reference_of(&description, name);
}

static Component make(void)
{
    Component component = fmi.instantiate("one", 1, guid, NULL, &callbacks, 0, 0); /* warnings come without logging */
    REQUIRE(component != NULL);
    return component;
}

static Component begin(void)
{
    Component component = make();
    REQUIRE(fmi.setup(component, 0, 0, 0, 0, 0) == STATUS_OK);
    REQUIRE(fmi.enter(component) == STATUS_OK && fmi.leave(component) == STATUS_OK);
    return component;
}

static double real(Component component, const char *name)
{
    const unsigned reference = of(name);
    double value = -999;
    REQUIRE(fmi.get_real(component, &reference, 1, &value) == STATUS_OK);
    return value;
}

static int integer(Component component, const char *name)
{
    const unsigned reference = of(name);
    int value = -999;
    REQUIRE(fmi.get_integer(component, &reference, 1, &value) == STATUS_OK);
    return value;
}

static void set_mode(Component component, int mode)
{
    const unsigned reference = of("mode");
    REQUIRE(fmi.set_integer(component, &reference, 1, &mode) == STATUS_OK);
}

static void instances_that_cannot_be(void)
{
    REQUIRE(!fmi.instantiate("one", 0, guid, NULL, &callbacks, 0, 0));
    TOLD("co-simulation only");
    REQUIRE(!fmi.instantiate("one", 1, "{wrong}", NULL, &callbacks, 0, 0));
    TOLD("modelDescription.xml that belongs to it");
    REQUIRE(!fmi.instantiate("one", 1, NULL, NULL, &callbacks, 0, 0));
    REQUIRE(!fmi.instantiate("", 1, guid, NULL, &callbacks, 0, 0));
    TOLD("no name");
    REQUIRE(!fmi.instantiate(NULL, 1, guid, NULL, &callbacks, 0, 0));
    setenv("ALL_KINDS_REFUSES", "1", 1);
    REQUIRE(!fmi.instantiate("one", 1, guid, NULL, &callbacks, 0, 0));
    TOLD("no device");
    unsetenv("ALL_KINDS_REFUSES");
    /* Without callbacks, or with empty ones. */
    const Callbacks2 empty = {NULL, NULL, NULL, NULL, NULL};
    REQUIRE(!fmi.instantiate("one", 1, "{wrong}", NULL, NULL, 0, 1));
    REQUIRE(!fmi.instantiate("one", 1, "{wrong}", NULL, &empty, 0, 1));
    Component quiet = fmi.instantiate("one", 1, guid, NULL, NULL, 0, 1);
    REQUIRE(quiet && fmi.step(quiet, 0, 0.01, 0) == STATUS_ERROR);
    fmi.free_instance(quiet);
    fmi.free_instance(NULL);
    REQUIRE(fmi.enter(NULL) == STATUS_ERROR && fmi.step(NULL, 0, 1, 0) == STATUS_ERROR);
    REQUIRE(fmi.reset(NULL) == STATUS_ERROR && fmi.terminate(NULL) == STATUS_ERROR);
    REQUIRE(fmi.get_real(NULL, NULL, 0, NULL) == STATUS_ERROR);
}

static void wrong_order(void)
{
    Component component = make();
    double value = 0;
    const unsigned reference = of("real"), output = of("realOut");
    REQUIRE(fmi.step(component, 0, 0.01, 0) == STATUS_ERROR);
    TOLD("fmi2DoStep is not allowed now");
    REQUIRE(fmi.leave(component) == STATUS_ERROR && fmi.terminate(component) == STATUS_ERROR);
    REQUIRE(fmi.get_real(component, &output, 1, &value) == STATUS_ERROR);
    REQUIRE(fmi.set_real(component, &reference, 1, &value) == STATUS_OK);
    REQUIRE(fmi.enter(component) == STATUS_OK);
    REQUIRE(fmi.setup(component, 0, 0, 0, 0, 0) == STATUS_ERROR && fmi.enter(component) == STATUS_ERROR);
    REQUIRE(fmi.step(component, 0, 0.01, 0) == STATUS_ERROR);
    REQUIRE(fmi.leave(component) == STATUS_OK && fmi.leave(component) == STATUS_ERROR);
    REQUIRE(fmi.step(component, 0, 0.01, 0) == STATUS_OK);
    REQUIRE(fmi.terminate(component) == STATUS_OK && fmi.terminate(component) == STATUS_ERROR);
    REQUIRE(fmi.step(component, 0.01, 0.01, 0) == STATUS_ERROR);
    TOLD("terminated");
    REQUIRE(fmi.set_real(component, &reference, 1, &value) == STATUS_ERROR);
    REQUIRE(real(component, "realOut") == 0);
    REQUIRE(fmi.reset(component) == STATUS_OK && fmi.enter(component) == STATUS_OK);
    REQUIRE(fmi.leave(component) == STATUS_OK && fmi.step(component, 0, 0.01, 0) == STATUS_OK);
    REQUIRE(real(component, "realOut") == 1.5);
    fmi.free_instance(component);
}

static void let_fail(Component component)
{
    set_mode(component, 1);
}

static int call_setup(Component component)
{
    return fmi.setup(component, 0, 0, 0, 0, 0);
}
static int call_step(Component component)
{
    return fmi.step(component, 0, 0.01, 0);
}
static int call_get(Component component)
{
    const unsigned reference = of("real");
    double value;
    return fmi.get_real(component, &reference, 1, &value);
}
static int call_set(Component component)
{
    const unsigned reference = of("real");
    const double value = 1;
    return fmi.set_real(component, &reference, 1, &value);
}
static int call_enter(Component component)
{
    return fmi.enter(component);
}
static int call_leave(Component component)
{
    return fmi.leave(component);
}
static int call_terminate(Component component)
{
    return fmi.terminate(component);
}
static int call_reset(Component component)
{
    return fmi.reset(component);
}

static void state_table(void)
{
    static const StateRow rows[] = {{"fmi2SetupExperiment", call_setup, "+----"},
                                    {"fmi2EnterInitializationMode", call_enter, "+----"},
                                    {"fmi2ExitInitializationMode", call_leave, "-+---"},
                                    {"fmi2DoStep", call_step, "--+--"},
                                    {"fmi2Terminate", call_terminate, "--+-+"},
                                    {"fmi2Reset", call_reset, "+++++"},
                                    {"fmi2GetReal", call_get, "-++++"},
                                    {"fmi2SetReal", call_set, "+++--"}};
    const StateWays ways
        = {make, call_enter, call_leave, call_step, call_terminate, call_reset, let_fail, fmi.free_instance};
    check_states(&ways, rows, sizeof rows / sizeof *rows);
}

static void steps(void)
{
    Component component = begin();
    REQUIRE(fmi.step(component, 0, 0.03, 0) == STATUS_OK); /* a multiple of the period */
    REQUIRE(integer(component, "count") == 3);
    REQUIRE(fmi.step(component, 0.03, 0.015, 0) == STATUS_ERROR);
    TOLD("a step of 0.015 s is not possible; use 0.01 s");
    REQUIRE(fmi.step(component, 0.03, 0, 0) == STATUS_ERROR && fmi.step(component, 0.03, -0.01, 0) == STATUS_ERROR);
    REQUIRE(fmi.step(component, 0.03, NAN, 0) == STATUS_ERROR);
    REQUIRE(fmi.step(component, 0.03, INFINITY, 0) == STATUS_ERROR);
    REQUIRE(fmi.step(component, NAN, 0.01, 0) == STATUS_ERROR);
    REQUIRE(fmi.step(component, 0.05, 0.01, 0) == STATUS_ERROR);
    TOLD("a step at 0.05 s is not possible, because the node is at 0.03 s");
    REQUIRE(fmi.step(component, 0.02, 0.01, 0) == STATUS_ERROR);
    REQUIRE(integer(component, "count") == 3);
    double time = 0.03; /* a time that drifts, as hosts have it */
    for (int i = 0; i < 10000; ++i, time += 0.01)
        REQUIRE(fmi.step(component, time, 0.01, 0) == STATUS_OK);
    REQUIRE(integer(component, "count") == 10003);
    fmi.free_instance(component);
    component = make();
    REQUIRE(fmi.setup(component, 0, 0, 100, 1, 200) == STATUS_OK); /* another start */
    REQUIRE(fmi.enter(component) == STATUS_OK && fmi.leave(component) == STATUS_OK);
    REQUIRE(fmi.step(component, 0, 0.01, 0) == STATUS_ERROR && fmi.step(component, 100, 0.01, 0) == STATUS_OK);
    REQUIRE(fmi.get_real_status(component, 2, &time) == STATUS_OK && fabs(time - 100.01) < 1e-9);
    fmi.free_instance(component);
    component = make();
    REQUIRE(fmi.setup(component, 0, 0, NAN, 0, 0) == STATUS_ERROR);
    fmi.free_instance(component);
}

static void values(void)
{
    Component component = begin();
    const unsigned array[] = {of("array[1]"), of("array[2]"), of("array[3]")};
    const double numbers[] = {1, -2.5, 1e-3};
    const unsigned flag = of("flag"), phase = of("phase"), text = of("text"), big = of("big"), mode = of("mode");
    const int no = 0, reel_in = 2, much = 1000;
    const char *word = "w\303\266rld", *too_long = "123456789", *read = NULL;
    REQUIRE(fmi.step(component, 0, 0.01, 0) == STATUS_OK);
    REQUIRE(real(component, "realOut") == 1.5 && real(component, "arrayOut[2]") == (double)0.2f);
    REQUIRE(integer(component, "phaseOut") == 1);
    REQUIRE(fmi.set_real(component, array, 3, numbers) == STATUS_OK);
    REQUIRE(fmi.set_boolean(component, &flag, 1, &no) == STATUS_OK);
    REQUIRE(fmi.set_integer(component, &phase, 1, &reel_in) == STATUS_OK);
    REQUIRE(fmi.set_string(component, &text, 1, &word) == STATUS_OK);
    const double two_to_53 = 9007199254740992.0;
    REQUIRE(fmi.set_real(component, &big, 1, &two_to_53) == STATUS_OK);
    REQUIRE(fmi.step(component, 0.01, 0.01, 0) == STATUS_OK);
    REQUIRE(real(component, "arrayOut[2]") == -2.5 && real(component, "arrayOut[3]") == (double)1e-3f);
    REQUIRE(integer(component, "phaseOut") == 2 && real(component, "bigOut") == two_to_53);
    const unsigned text_out = of("textOut"), flag_out = of("flagOut");
    int flag_read = 7;
    REQUIRE(fmi.get_string(component, &text_out, 1, &read) == STATUS_OK && strcmp(read, word) == 0);
    REQUIRE(fmi.get_boolean(component, &flag_out, 1, &flag_read) == STATUS_OK && flag_read == 0);
    /* what cannot be */
    REQUIRE(fmi.set_string(component, &text, 1, &too_long) == STATUS_ERROR);
    TOLD("does not fit 'text'");
    const char *null = NULL, *broken = "\303";
    REQUIRE(fmi.set_string(component, &text, 1, &null) == STATUS_ERROR);
    REQUIRE(fmi.set_string(component, &text, 1, &broken) == STATUS_ERROR);
    REQUIRE(fmi.set_integer(component, &phase, 1, &much) == STATUS_ERROR);
    TOLD("1000 does not fit 'phase' of type Int8");
    REQUIRE(fmi.set_real(component, &mode, 1, numbers) == STATUS_ERROR);
    TOLD("variable 'mode' has the type Integer");
    REQUIRE(fmi.set_integer(component, &array[0], 1, &no) == STATUS_ERROR);
    const unsigned output = of("realOut"), nothing = 4711, zero = 0;
    REQUIRE(fmi.set_real(component, &output, 1, numbers) == STATUS_ERROR);
    TOLD("is an output");
    double value;
    REQUIRE(fmi.get_real(component, &nothing, 1, &value) == STATUS_ERROR);
    TOLD("value reference 4711");
    REQUIRE(fmi.get_real(component, &zero, 1, &value) == STATUS_ERROR);
    REQUIRE(fmi.get_real(component, NULL, 1, &value) == STATUS_ERROR);
    REQUIRE(fmi.get_real(component, &output, 1, NULL) == STATUS_ERROR);
    REQUIRE(fmi.get_real(component, NULL, 0, NULL) == STATUS_OK);
    fmi.free_instance(component);
}

static void limits(void)
{
    Component component = begin();
    const unsigned reference = of("real");
    const double good = 3, bad = NAN, large = 11;
    double time = 0;
    REQUIRE(fmi.set_real(component, &reference, 1, &good) == STATUS_OK);
    REQUIRE(fmi.step(component, time, 0.01, 0) == STATUS_OK);
    REQUIRE(fmi.set_real(component, &reference, 1, &bad) == STATUS_OK);
    REQUIRE(fmi.step(component, time += 0.01, 0.01, 0) == STATUS_OK);
    TOLD("real is not finite or outside of its limits");
    REQUIRE(real(component, "realOut") == 3);
    REQUIRE(fmi.set_real(component, &reference, 1, &large) == STATUS_OK);
    REQUIRE(fmi.step(component, time += 0.01, 0.01, 0) == STATUS_OK);
    REQUIRE(real(component, "realOut") == 3);
    fmi.free_instance(component);
}

static void failures(void)
{
    Component component = begin();
    REQUIRE(fmi.step(component, 0, 0.01, 0) == STATUS_OK);
    set_mode(component, 1);
    REQUIRE(fmi.step(component, 0.01, 0.01, 0) == STATUS_ERROR);
    TOLD("mode 1 is an error");
    REQUIRE(real(component, "realOut") == -1); /* its safe value */
    REQUIRE(fmi.step(component, 0.02, 0.01, 0) == STATUS_ERROR);
    TOLD("it has failed");
    REQUIRE(fmi.terminate(component) == STATUS_OK);
    REQUIRE(fmi.reset(component) == STATUS_OK && fmi.enter(component) == STATUS_OK);
    REQUIRE(fmi.leave(component) == STATUS_OK && fmi.step(component, 0, 0.01, 0) == STATUS_OK);
    set_mode(component, 2);
    REQUIRE(fmi.step(component, 0.01, 0.05, 0) == STATUS_DISCARD);
    TOLD("safe stop in cycle 1");
    int terminated = 0;
    double last = 0;
    REQUIRE(fmi.get_boolean_status(component, 3, &terminated) == STATUS_OK && terminated == 1);
    REQUIRE(fmi.get_real_status(component, 2, &last) == STATUS_OK && fabs(last - 0.02) < 1e-12);
    fmi.free_instance(component);
}

static void two_instances(void)
{
    Component one = begin(), two = begin();
    const unsigned reference = of("real");
    const double first = 2, second = -2;
    REQUIRE(fmi.set_real(one, &reference, 1, &first) == STATUS_OK);
    REQUIRE(fmi.set_real(two, &reference, 1, &second) == STATUS_OK);
    for (int i = 0; i < 3; ++i)
        REQUIRE(fmi.step(one, 0.01 * i, 0.01, 0) == STATUS_OK);
    REQUIRE(fmi.step(two, 0, 0.01, 0) == STATUS_OK);
    REQUIRE(real(one, "realOut") == 2 && real(two, "realOut") == -2);
    REQUIRE(integer(one, "count") == 3 && integer(two, "count") == 1);
    fmi.free_instance(one);
    REQUIRE(fmi.step(two, 0.01, 0.01, 0) == STATUS_OK && integer(two, "count") == 2);
    fmi.free_instance(two);
}

static void functions_that_are_not_offered(void *library)
{
    static const char *names[] = {"fmi2GetTypesPlatform",
                                  "fmi2GetVersion",
                                  "fmi2GetStatus",
                                  "fmi2GetIntegerStatus",
                                  "fmi2GetStringStatus",
                                  "fmi2SetRealInputDerivatives",
                                  "fmi2GetRealOutputDerivatives",
                                  "fmi2FreeFMUstate",
                                  "fmi2SerializedFMUstateSize",
                                  "fmi2SerializeFMUstate",
                                  "fmi2DeSerializeFMUstate",
                                  "fmi2GetDirectionalDerivative",
                                  "fmi2EnterEventMode",
                                  "fmi2NewDiscreteStates",
                                  "fmi2EnterContinuousTimeMode",
                                  "fmi2CompletedIntegratorStep",
                                  "fmi2SetTime",
                                  "fmi2SetContinuousStates",
                                  "fmi2GetDerivatives",
                                  "fmi2GetEventIndicators",
                                  "fmi2GetContinuousStates",
                                  "fmi2GetNominalsOfContinuousStates",
                                  "fmi2CancelStep"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        symbol(library, names[i]);
    int (*get_state)(Component, void **), (*set_state)(Component, void *);
    *(void **)&get_state = symbol(library, "fmi2GetFMUstate");
    *(void **)&set_state = symbol(library, "fmi2SetFMUstate");
    Component component = begin();
    void *state = NULL;
    REQUIRE(get_state(component, &state) == STATUS_ERROR);
    TOLD("fmi2GetFMUstate is not offered");
    REQUIRE(set_state(component, NULL) == STATUS_ERROR && get_state(NULL, NULL) == STATUS_ERROR);
    fmi.free_instance(component);
}

int main(int argc, char **argv)
{
    char path[1024];
    if (argc != 2)
        return 2;
    snprintf(path, sizeof path, "%s/modelDescription.xml", argv[1]);
    description = read_description(path);
    copy_attribute(description.text, "guid", guid, sizeof guid);
    REQUIRE(strstr(description.text, "less &lt; than, more &gt; than, &quot;quoted&quot; &amp; Gr\303\266\303\237e"));
    snprintf(path, sizeof path, "%s/binaries/linux64/all_kinds.so", argv[1]);
    void *library = open_library(path);
    fmi = load2(library);
    instances_that_cannot_be();
    wrong_order();
    state_table();
    steps();
    values();
    limits();
    failures();
    two_instances();
    functions_that_are_not_offered(library);
    free(description.text);
    dlclose(library);
    puts("FMI 2 is as it should be");
    return 0;
}
