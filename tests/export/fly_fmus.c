/* SPDX-License-Identifier: Apache-2.0 */
/* Model and autopilot as FMUs, coupled as simulators do it: all inputs, then all steps. Prints the
 * energy, so that a test compares it with the flight of a plant. With PROGRAM, the autopilot is this
 * program, and its FMU is the master awe_flight_control. No Qt.
 *
 * usage: fly_fmus 2|3 MODEL_FOLDER AUTOPILOT_FOLDER SECONDS [PROGRAM]   (folders of unpacked FMUs)
 */
#include "plant_host.h"

#define MOST 24

static const char *measured[]
    = {"bodyPosition_earth", "bodyVelocity_earth", "windVelocity_earth", "bodyControlOrientation",
       "angleOfAttack",      "tetherForce_earth",  "tetherLength"};
static const int measured_size[] = {3, 3, 3, 3, 1, 3, 1};
static const char *commands[] = {"bodyControlPitchSpeed", "bodyControlYawSpeed", "tetherSpeed"};

typedef struct
{
    Description description;
    void *library;
    Fmi2 fmi2;
    Fmi3 fmi3;
    Component component;
    char identification[80];
} Unit;

static int version;

static Unit load(const char *folder, const char *name)
{
    char path[1024];
    Unit unit;
    snprintf(path, sizeof path, "%s/modelDescription.xml", folder);
    unit.description = read_description(path);
    copy_attribute(unit.description.text, version == 2 ? "guid" : "instantiationToken", unit.identification,
                   sizeof unit.identification);
    snprintf(path, sizeof path, "%s/binaries/%s/%s.so", folder, version == 2 ? "linux64" : "x86_64-linux", name);
    unit.library = open_library(path);
    if (version == 2) {
        const Callbacks2 callbacks = {log2_message, NULL, NULL, NULL, NULL};
        unit.fmi2 = load2(unit.library);
        unit.component = unit.fmi2.instantiate(name, 1, unit.identification, NULL, &callbacks, 0, 0);
        REQUIRE(unit.component != NULL);
        REQUIRE(unit.fmi2.setup(unit.component, 0, 0, 0, 0, 0) == STATUS_OK);
        REQUIRE(unit.fmi2.enter(unit.component) == STATUS_OK);
    } else {
        unit.fmi3 = load3(unit.library);
        unit.component = unit.fmi3.instantiate(name, unit.identification, NULL, false, false, false, false, NULL, 0,
                                               NULL, log3_message, NULL);
        REQUIRE(unit.component != NULL);
        REQUIRE(unit.fmi3.enter(unit.component, false, 0, 0, false, 0) == STATUS_OK);
    }
    return unit;
}

static const char *program;

static void start_autopilot(Plant *plant)
{
    char master[80];
    snprintf(master, sizeof master, "--master=udp://127.0.0.1:%d", plant->port);
    char *arguments[] = {(char *)program, master, "--same-cycle", NULL};
    plant->nodes[0] = start_program(arguments);
}

/* The master whose node is the autopilot. */
static Unit load_master(const char *folder, Plant *plant, Library *library)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/binaries/%s/awe_flight_control.so", folder,
             version == 2 ? "linux64" : "x86_64-linux");
    *library = load_library(version, folder, path);
    make_plant(plant, library, start_autopilot);
    REQUIRE(set_integer(plant, "plant.port", 0) == STATUS_OK && enter_plant(plant) == STATUS_OK);
    Unit unit = {library->description, library->library, library->fmi2, library->fmi3, plant->component, ""};
    return unit;
}

/* References of the elements (FMI 2) or of the arrays (FMI 3) of a signal. */
static size_t add_references(const Unit *unit, const char *name, int size, uint32_t *references)
{
    char element[80];
    if (version == 3 || size == 1) {
        references[0] = reference_of(&unit->description, name);
        return 1;
    }
    for (int i = 0; i < size; ++i) {
        snprintf(element, sizeof element, "%s[%d]", name, i + 1);
        references[i] = reference_of(&unit->description, element);
    }
    return (size_t)size;
}

/* Numbers of both precisions: in FMI 3 each type has its function. */
static void get(const Unit *unit, const uint32_t *references, size_t count, double *values, size_t size)
{
    float single[MOST];
    if (version == 2) {
        REQUIRE(unit->fmi2.get_real(unit->component, references, count, values) == STATUS_OK);
    } else if (unit->fmi3.get_float32(unit->component, references, count, single, size) == STATUS_OK) {
        for (size_t i = 0; i < size; ++i)
            values[i] = (double)single[i];
    } else {
        REQUIRE(unit->fmi3.get_float64(unit->component, references, count, values, size) == STATUS_OK);
    }
}

static void set(const Unit *unit, const uint32_t *references, size_t count, const double *values, size_t size)
{
    float single[MOST];
    for (size_t i = 0; i < size; ++i)
        single[i] = (float)values[i];
    if (version == 2)
        REQUIRE(unit->fmi2.set_real(unit->component, references, count, values) == STATUS_OK);
    else if (unit->fmi3.set_float32(unit->component, references, count, single, size) != STATUS_OK)
        REQUIRE(unit->fmi3.set_float64(unit->component, references, count, values, size) == STATUS_OK);
}

static void step(const Unit *unit, double time, double size)
{
    if (version == 2)
        REQUIRE(unit->fmi2.step(unit->component, time, size, 1) == STATUS_OK);
    else
        REQUIRE(unit->fmi3.step(unit->component, time, size, true, NULL, NULL, NULL, NULL) == STATUS_OK);
}

static void leave(const Unit *unit)
{
    REQUIRE((version == 2 ? unit->fmi2.leave(unit->component) : unit->fmi3.leave(unit->component)) == STATUS_OK);
}

static void end(const Unit *unit)
{
    if (version == 2) {
        REQUIRE(unit->fmi2.terminate(unit->component) == STATUS_OK);
        unit->fmi2.free_instance(unit->component);
    } else {
        REQUIRE(unit->fmi3.terminate(unit->component) == STATUS_OK);
        unit->fmi3.free_instance(unit->component);
    }
    dlclose(unit->library);
    free(unit->description.text);
}

int main(int argc, char **argv)
{
    Library library;
    Plant plant;
    if (argc != 5 && argc != 6)
        return 2;
    version = atoi(argv[1]);
    program = argc == 6 ? argv[5] : NULL;
    const Unit model = load(argv[2], "awe_model");
    const Unit autopilot = program ? load_master(argv[3], &plant, &library) : load(argv[3], "awe_autopilot");
    const long cycles = lround(atof(argv[4]) * 100);
    uint32_t from[MOST], to[MOST], from_command[MOST], to_command[MOST];
    double values[MOST];
    size_t sizes[7], counts[7], commanded = 0, offset = 0;
    size_t starts[7];
    for (int i = 0; i < 7; ++i) {
        starts[i] = offset;
        sizes[i] = (size_t)measured_size[i];
        counts[i] = add_references(&model, measured[i], measured_size[i], from + offset);
        add_references(&autopilot, measured[i], measured_size[i], to + offset);
        offset += counts[i];
    }
    for (int i = 0; i < 3; ++i) {
        add_references(&autopilot, commands[i], 1, from_command + commanded);
        commanded += add_references(&model, commands[i], 1, to_command + commanded);
    }
    /* In each cycle: all inputs, then all steps. */
    for (long cycle = -1; cycle < cycles; ++cycle) {
        const double time = 0.01 * (double)cycle;
        for (int i = 0; i < 7; ++i) {
            get(&model, from + starts[i], counts[i], values, sizes[i]);
            set(&autopilot, to + starts[i], counts[i], values, sizes[i]);
        }
        for (int i = 0; i < 3; ++i) {
            get(&autopilot, from_command + i, 1, values, 1);
            set(&model, to_command + i, 1, values, 1);
        }
        if (cycle < 0) {
            leave(&model);
            leave(&autopilot);
            continue;
        }
        step(&model, time, 0.01);
        step(&autopilot, time, 0.01);
    }
    const uint32_t energy = reference_of(&model.description, "energy");
    get(&model, &energy, 1, values, 1);
    printf("%.17g\n", values[0]);
    end(&model);
    end(&autopilot);
    REQUIRE(!program || finish(&plant.nodes[0]) == 0);
    return 0;
}
