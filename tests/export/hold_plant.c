/* SPDX-License-Identifier: Apache-2.0 */
/* A host that holds the master of a plant; its nodes are programs. No Qt.
 * usage: hold_plant SCENARIO 2|3 FOLDER PLANT_PART QTPLC WORK_FOLDER   (of the unpacked FMU)
 */
#include "plant_host.h"

#include <arpa/inet.h>
#include <dirent.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>

enum { TANK, DISPLAY, NODES };

static Library library;
static const char *part, *qtplc, *folder, *work;

static bool has_keys = false; /* the nodes that are started */

static void run_node(Plant *plant, int node)
{
    char master[80], keys[1024];
    snprintf(master, sizeof master, "--master=udp://127.0.0.1:%d", plant->port);
    snprintf(keys, sizeof keys, "--keys=%s/key_%d.ini", work, node);
    char *arguments[] = {(char *)part, "--part", node == TANK ? "tank" : "display", master, NULL, NULL, NULL};
    if (has_keys) {
        arguments[4] = "--security=psk";
        arguments[5] = keys;
    }
    plant->nodes[node] = start_program(arguments);
}

static void start_node(Plant *plant, int node)
{
    char line[80];
    run_node(plant, node);
    read_line(&plant->nodes[node], line, sizeof line);
    REQUIRE(strcmp(line, "registered") == 0);
}

static void start_nodes(Plant *plant)
{
    start_node(plant, TANK);
    start_node(plant, DISPLAY);
}

static void begin(Plant *plant)
{
    make_plant(plant, &library, start_nodes);
    REQUIRE(enter_plant(plant) == STATUS_OK && leave_plant(plant) == STATUS_OK);
}

/* A node ends in order with its master; one that was killed does not. */
static void expect_end(Plant *plant, int node, int code)
{
    REQUIRE(finish(&plant->nodes[node]) == code);
}

static void end(Plant *plant)
{
    free_plant(plant);
    for (int node = 0; node < NODES; ++node)
        if (plant->nodes[node].process > 0)
            expect_end(plant, node, 0);
}

static void values_pass(void)
{
    Plant plant;
    is_logging = 1;
    make_plant(&plant, &library, start_nodes);
    REQUIRE(set_number(&plant, "command", 3) == STATUS_OK);
    REQUIRE(enter_plant(&plant) == STATUS_OK);
    REQUIRE(number(&plant, "level") == 5); /* as the tank begins */
    REQUIRE(set_number(&plant, "command", 7) == STATUS_OK);
    REQUIRE(leave_plant(&plant) == STATUS_OK);
    REQUIRE(number(&plant, "level") == 5);
    REQUIRE(step_by(&plant, 1) == STATUS_OK);
    REQUIRE(number(&plant, "level") == 12 && number(&plant, "began") == 7); /* of this step */
    REQUIRE(set_number(&plant, "command", -2) == STATUS_OK);
    REQUIRE(step_by(&plant, 3) == STATUS_OK); /* three periods */
    REQUIRE(number(&plant, "level") == 6);
    const int size = plant.of->version == 2 ? 1 : 3;
    float triple[] = {1, -2.5F, 3}, read[3] = {0};
    if (size == 1) {
        REQUIRE(set_number(&plant, "triple[2]", -2.5) == STATUS_OK && step_by(&plant, 1) == STATUS_OK);
        REQUIRE(number(&plant, "tripleOut[2]") == -2.5 && number(&plant, "tripleOut[3]") == 0);
    } else {
        const uint32_t in = reference_of(&library.description, "triple"),
                       out = reference_of(&library.description, "tripleOut");
        REQUIRE(library.fmi3.set_float32(plant.component, &in, 1, triple, 3) == STATUS_OK);
        REQUIRE(step_by(&plant, 1) == STATUS_OK);
        REQUIRE(library.fmi3.get_float32(plant.component, &out, 1, read, 3) == STATUS_OK);
        REQUIRE(memcmp(triple, read, sizeof read) == 0);
    }
    REQUIRE(set_number(&plant, "command", NAN) == STATUS_OK); /* is not taken */
    REQUIRE(step_by(&plant, 1) == STATUS_OK && number(&plant, "level") == 2);
    REQUIRE(strstr(plant.warning, "command is not finite") != NULL);
    REQUIRE(terminate_plant(&plant) == STATUS_OK);
    TOLD("has computed 6 cycles");
    end(&plant);
}

static void wrong_steps(void)
{
    Plant plant;
    begin(&plant);
    if (library.version == 2)
        REQUIRE(library.fmi2.step(plant.component, 0, 0.015, 1) == STATUS_ERROR);
    else
        REQUIRE(library.fmi3.step(plant.component, 0, 0.015, true, NULL, NULL, NULL, NULL) == STATUS_ERROR);
    TOLD("a step of 0.015 s is not possible; use 0.01 s");
    REQUIRE(set_integer(&plant, "plant.port", 4) == STATUS_ERROR);
    TOLD("'plant.port' is a parameter; set it before the initialization begins");
    REQUIRE(step_by(&plant, 1) == STATUS_OK);
    end(&plant); /* without terminate */
}

/* The initialization fails with this sentence. After a reset it succeeds with the settings of the file. */
static void refused(Plant *plant, const char *sentence)
{
    plant->begin = NULL;
    REQUIRE(enter_plant(plant) == STATUS_ERROR);
    TOLD(sentence);
    REQUIRE(leave_plant(plant) == STATUS_ERROR);
    REQUIRE(reset_plant(plant) == STATUS_OK);
}

static void wrong_settings(void)
{
    Plant plant;
    char file[1024];
    make_plant(&plant, &library, NULL);
    REQUIRE(set_text(&plant, "plant.listen", "here") == STATUS_OK);
    refused(&plant, "plant.listen 'here' is no address");
    REQUIRE(set_text(&plant, "plant.listen", "0.0.0.0") == STATUS_OK);
    refused(&plant, "everybody in that network could command the plant");
    snprintf(file, sizeof file, "%s/no_keys.ini", work);
    REQUIRE(set_text(&plant, "plant.keys", file) == STATUS_OK);
    refused(&plant, "no_keys.ini");
    REQUIRE(set_number(&plant, "plant.start_timeout", 0) == STATUS_OK);
    refused(&plant, "plant.start_timeout is 0; use 0.001 ... 3600");
    REQUIRE(set_number(&plant, "plant.longest_wait", NAN) == STATUS_OK);
    refused(&plant, "plant.longest_wait is nan");
    REQUIRE(set_integer(&plant, "plant.port", 70000) == STATUS_OK);
    refused(&plant, "plant.port is 70000; use 0 ... 65535");
    plant.begin = start_nodes;
    REQUIRE(enter_plant(&plant) == STATUS_OK && leave_plant(&plant) == STATUS_OK && step_by(&plant, 1) == STATUS_OK);
    end(&plant);
}

static void write_keys(const char *name, bool has_tank, bool has_display)
{
    char file[1024];
    snprintf(file, sizeof file, "%s/%s", work, name);
    FILE *stream = fopen(file, "wb");
    REQUIRE(stream != NULL && chmod(file, 0600) == 0);
    if (has_tank)
        fprintf(stream, "[Tank]\nrole = Node\nkey = %064d\n", 1);
    if (has_display)
        fprintf(stream, "[Display]\nrole = Node\nkey = %064d\n", 2);
    fclose(stream);
}

/* A node without a key is refused, and then the others come. */
static void start_stranger_and_nodes(Plant *plant)
{
    has_keys = false;
    run_node(plant, TANK);
    REQUIRE(finish(&plant->nodes[TANK]) == 2);
    has_keys = true;
    start_nodes(plant);
}

static void keys(void)
{
    Plant plant;
    char file[1024];
    write_keys("keys.ini", true, true);
    write_keys("key_0.ini", true, false);
    write_keys("key_1.ini", false, true);
    make_plant(&plant, &library, start_stranger_and_nodes);
    snprintf(file, sizeof file, "%s/keys.ini", work);
    REQUIRE(set_text(&plant, "plant.keys", file) == STATUS_OK && set_number(&plant, "command", 2) == STATUS_OK);
    REQUIRE(enter_plant(&plant) == STATUS_OK && leave_plant(&plant) == STATUS_OK);
    REQUIRE(step_by(&plant, 10) == STATUS_OK && number(&plant, "level") == 25);
    end(&plant);
}

static void port_in_use(void)
{
    Plant plant;
    struct sockaddr_in address = {.sin_family = AF_INET, .sin_addr = {htonl(INADDR_LOOPBACK)}};
    socklen_t size = sizeof address;
    const int taken = socket(AF_INET, SOCK_STREAM, 0);
    REQUIRE(bind(taken, (struct sockaddr *)&address, size) == 0 && listen(taken, 1) == 0);
    REQUIRE(getsockname(taken, (struct sockaddr *)&address, &size) == 0);
    make_plant(&plant, &library, NULL);
    REQUIRE(set_integer(&plant, "plant.port", ntohs(address.sin_port)) == STATUS_OK);
    refused(&plant, "in use");
    close(taken);
    free_plant(&plant);
}

static void absent_nodes(void)
{
    Plant plant;
    make_plant(&plant, &library, NULL);
    for (int i = 0; i < 2; ++i) {
        REQUIRE(set_number(&plant, "plant.start_timeout", 0.2) == STATUS_OK);
        const double before = now();
        refused(&plant, i == 0 ? "'Tank'" : "'Display'");
        printf("nodes that never come: %.3f s with plant.start_timeout 0.2 s\n", now() - before);
    }
    plant.begin = start_nodes;
    REQUIRE(enter_plant(&plant) == STATUS_OK && leave_plant(&plant) == STATUS_OK && step_by(&plant, 1) == STATUS_OK);
    end(&plant);
}

static void two_plants(void)
{
    Plant one, two;
    begin(&one);
    begin(&two);
    REQUIRE(one.port != two.port);
    REQUIRE(set_number(&one, "command", 1) == STATUS_OK && set_number(&two, "command", 2) == STATUS_OK);
    for (int i = 0; i < 10; ++i)
        REQUIRE(step_by(&one, 1) == STATUS_OK && (i >= 5 || step_by(&two, 1) == STATUS_OK));
    REQUIRE(number(&one, "level") == 15 && number(&two, "level") == 15);
    end(&one);
    REQUIRE(step_by(&two, 1) == STATUS_OK && number(&two, "level") == 17);
    end(&two);
}

/* The limit of a step is a minute, and so is the limit of this program. */
static void killed_required(void)
{
    Plant plant;
    begin(&plant);
    REQUIRE(set_number(&plant, "command", 1) == STATUS_OK && step_by(&plant, 5) == STATUS_OK);
    REQUIRE(kill(plant.nodes[DISPLAY].process, SIGKILL) == 0);
    const double before = now();
    int steps = 0, status = STATUS_OK;
    while (status == STATUS_OK && ++steps < 100000)
        status = step_by(&plant, 1);
    REQUIRE(status == STATUS_WARNING);
    printf("killed node that is required: %.3f s, %d steps\n", now() - before, steps);
    REQUIRE(plant.warnings == 1 && strstr(plant.warning, "'Display'") != NULL);
    REQUIRE(step_by(&plant, 10) == STATUS_OK); /* it goes on */
    REQUIRE(number(&plant, "level") == (double)(5 + plant.cycle));
    expect_end(&plant, DISPLAY, -SIGKILL);
    end(&plant);
}

static void killed_critical(void)
{
    Plant plant;
    begin(&plant);
    REQUIRE(step_by(&plant, 5) == STATUS_OK);
    REQUIRE(kill(plant.nodes[TANK].process, SIGKILL) == 0);
    const double before = now();
    int status = STATUS_OK, steps = 0;
    while (status <= STATUS_WARNING && ++steps < 100000)
        status = step_by(&plant, 1);
    printf("killed node that is critical: %.3f s, %d steps\n", now() - before, steps);
    REQUIRE(status == STATUS_ERROR && strstr(last_message, "stopped safely") && strstr(last_message, "'Tank'"));
    REQUIRE(number(&plant, "level") == -1); /* its safe value */
    REQUIRE(step_by(&plant, 1) == STATUS_ERROR);
    expect_end(&plant, TANK, -SIGKILL);
    REQUIRE(terminate_plant(&plant) == STATUS_OK && reset_plant(&plant) == STATUS_OK);
    start_node(&plant, TANK); /* the master is the same: a new phase */
    REQUIRE(enter_plant(&plant) == STATUS_OK && leave_plant(&plant) == STATUS_OK && step_by(&plant, 1) == STATUS_OK);
    end(&plant);
}

static void begin_impatiently(Plant *plant, double longest_wait)
{
    make_plant(plant, &library, start_nodes);
    REQUIRE(set_number(plant, "plant.longest_wait", longest_wait) == STATUS_OK);
    REQUIRE(enter_plant(plant) == STATUS_OK && leave_plant(plant) == STATUS_OK && step_by(plant, 5) == STATUS_OK);
}

static void end_hanging(Plant *plant)
{
    const double before = now();
    free_plant(plant);
    printf("the end of a plant with nodes that hang: %.3f s\n", now() - before);
    for (int node = 0; node < NODES; ++node) {
        REQUIRE(kill(plant->nodes[node].process, SIGKILL) == 0);
        finish(&plant->nodes[node]);
    }
}

static void hanging_required(void)
{
    Plant plant;
    begin_impatiently(&plant, 0.5);
    REQUIRE(kill(plant.nodes[DISPLAY].process, SIGSTOP) == 0);
    double before = now(), longest = 0;
    for (int i = 0; i < 1000; ++i) { /* if each of them cost the limit, this would take 500 s */
        const double begin = now();
        REQUIRE(step_by(&plant, 1) <= STATUS_WARNING);
        longest = now() - begin > longest ? now() - begin : longest;
    }
    printf("node that hangs and is required: 1000 steps in %.3f s, the longest one %.3f s, with plant.longest_wait "
           "0.5 s\n",
           now() - before, longest);
    REQUIRE(plant.warnings >= 1 && strstr(plant.warning, "'Display'") != NULL);
    end_hanging(&plant);
}

static void hanging_critical(void)
{
    Plant plant;
    begin_impatiently(&plant, 6); /* other than the usual limit, 5 s */
    REQUIRE(kill(plant.nodes[TANK].process, SIGSTOP) == 0);
    const double before = now();
    REQUIRE(step_by(&plant, 1000) == STATUS_ERROR);
    printf("node that hangs and is critical: %.3f s with plant.longest_wait 6 s\n", now() - before);
    REQUIRE(now() - before >= 5.99);
    REQUIRE(strstr(last_message, "stopped safely") && strstr(last_message, "'Tank'"));
    end_hanging(&plant);
}

static void stop_by_a_person(void)
{
    Plant plant;
    char master[40];
    begin(&plant);
    REQUIRE(step_by(&plant, 1) == STATUS_OK);
    snprintf(master, sizeof master, "127.0.0.1:%d", plant.port);
    char *arguments[] = {(char *)qtplc, "--master", master, "stop", NULL};
    Program stop = start_program(arguments);
    REQUIRE(finish(&stop) == 0);
    const int status = step_by(&plant, 3);
    REQUIRE(status == (library.version == 2 ? STATUS_DISCARD : STATUS_OK) && plant.is_over);
    TOLD("a person or a program has stopped the plant in cycle 1");
    REQUIRE(terminate_plant(&plant) == STATUS_OK && reset_plant(&plant) == STATUS_OK);
    REQUIRE(enter_plant(&plant) == STATUS_OK && leave_plant(&plant) == STATUS_OK); /* the nodes are still there */
    REQUIRE(step_by(&plant, 1) == STATUS_OK);
    end(&plant);
}

/* The code of a node throws: the step in which that happens fails, and a new phase is possible. */
static void fail_by(double command, int good, const char *reason)
{
    Plant plant;
    begin(&plant);
    REQUIRE(step_by(&plant, 5) == STATUS_OK && set_number(&plant, "command", command) == STATUS_OK);
    for (int i = 0; i < good; ++i)
        REQUIRE(step_by(&plant, 1) == STATUS_OK);
    REQUIRE(step_by(&plant, 1) == STATUS_ERROR);
    TOLD(reason);
    REQUIRE(number(&plant, "level") == -1); /* its safe value */
    REQUIRE(step_by(&plant, 1) == STATUS_ERROR);
    REQUIRE(terminate_plant(&plant) == STATUS_OK && reset_plant(&plant) == STATUS_OK);
    for (int node = 0; node < NODES; ++node) {
        kill(plant.nodes[node].process, SIGKILL);
        finish(&plant.nodes[node]);
    }
    start_nodes(&plant);
    REQUIRE(enter_plant(&plant) == STATUS_OK && leave_plant(&plant) == STATUS_OK && step_by(&plant, 1) == STATUS_OK);
    end(&plant);
}

static void failing_required(void)
{
    fail_by(99, 1, "the plant has stopped in cycle 6: node 'Display'"); /* it reads the level of the last cycle */
}

static void failing_critical(void)
{
    fail_by(-100, 0, "the plant has stopped safely in cycle 5: ");
}

/* Two libraries with a QtPLC each: the one that has made the application ends first. */
static void two_libraries(void)
{
    char command[2048], file[1024];
    snprintf(file, sizeof file, "%s/copy_fmi%d.so", work, library.version);
    snprintf(command, sizeof command, "cp '%s/binaries/%s/held_plant.so' '%s'", folder,
             library.version == 2 ? "linux64" : "x86_64-linux", file);
    REQUIRE(system(command) == 0);
    const Library copy = load_library(library.version, folder, file);
    Plant one, two;
    begin(&one);
    make_plant(&two, &copy, start_nodes);
    REQUIRE(enter_plant(&two) == STATUS_OK && leave_plant(&two) == STATUS_OK);
    end(&one);
    REQUIRE(step_by(&two, 10) == STATUS_OK && terminate_plant(&two) == STATUS_OK && reset_plant(&two) == STATUS_OK);
    REQUIRE(enter_plant(&two) == STATUS_OK && leave_plant(&two) == STATUS_OK && step_by(&two, 10) == STATUS_OK);
    begin(&one);
    REQUIRE(step_by(&one, 10) == STATUS_OK && step_by(&two, 1) == STATUS_OK);
    end(&two);
    REQUIRE(step_by(&one, 10) == STATUS_OK);
    end(&one);
    free(copy.description.text);
}

static int threads(void)
{
    int count = 0;
    DIR *tasks = opendir("/proc/self/task");
    for (const struct dirent *entry = readdir(tasks); entry; entry = readdir(tasks))
        count += entry->d_name[0] != '.';
    closedir(tasks);
    return count;
}

/* Nodes end in order, also when the host has not ended the simulation. */
static void ends(void)
{
    Plant plant;
    begin(&plant);
    end(&plant);
    for (is_logging = 0; is_logging <= 1; ++is_logging) {
        begin(&plant); /* its port is told in any case */
        REQUIRE(step_by(&plant, 1) == STATUS_OK && terminate_plant(&plant) == STATUS_OK);
        REQUIRE((strstr(last_message, "has computed 1 cycles") != NULL) == is_logging);
        end(&plant);
    }
    make_plant(&plant, &library, NULL);
    free_plant(&plant);
    REQUIRE(threads() == 1);
}

/* The host calls exit() while an instance is there that is initialized, and no phase has begun. */
static void exits_early(void)
{
    static Plant plant;
    make_plant(&plant, &library, start_nodes);
    REQUIRE(enter_plant(&plant) == STATUS_OK);
    exit(0);
}

int main(int argc, char **argv)
{
    static const struct
    {
        const char *name;
        void (*run)(void);
    } scenarios[] = {{"values_pass", values_pass},
                     {"wrong_steps", wrong_steps},
                     {"wrong_settings", wrong_settings},
                     {"keys", keys},
                     {"port_in_use", port_in_use},
                     {"absent_nodes", absent_nodes},
                     {"two_plants", two_plants},
                     {"two_libraries", two_libraries},
                     {"killed_required", killed_required},
                     {"killed_critical", killed_critical},
                     {"hanging_required", hanging_required},
                     {"hanging_critical", hanging_critical},
                     {"failing_required", failing_required},
                     {"failing_critical", failing_critical},
                     {"stop_by_a_person", stop_by_a_person},
                     {"exits_early", exits_early},
                     {"ends", ends}};
    char file[1024];
    if (argc != 7)
        return 2;
    const int version = atoi(argv[2]);
    folder = argv[3];
    part = argv[4];
    qtplc = argv[5];
    work = argv[6];
    snprintf(file, sizeof file, "%s/binaries/%s/held_plant.so", folder, version == 2 ? "linux64" : "x86_64-linux");
    library = load_library(version, folder, file);
    for (size_t i = 0; i < sizeof scenarios / sizeof *scenarios; ++i) {
        if (strcmp(argv[1], scenarios[i].name) != 0)
            continue;
        scenarios[i].run();
        free(library.description.text);
        return 0;
    }
    fprintf(stderr, "there is no scenario %s\n", argv[1]);
    return 2;
}
