/* SPDX-License-Identifier: Apache-2.0 */
/* A host that calls controllers, as OpenFAST does, and so holds the master of a plant; its nodes are
 * programs. No Qt.
 * usage: hold_turbine equal LIBRARY RECORDS WORK_FOLDER CONTROLLER LIBRARY_OF_NODE
 *        hold_turbine SCENARIO LIBRARY RECORDS WORK_FOLDER PLANT_PART QTPLC   (held_turbine)
 */
#include "plant_host.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#define RECORDS 100
#define MESSAGE 500

typedef void (*Discon)(float *, int *, char *, char *, char *);
typedef struct
{
    Discon function;
    float records[RECORDS + 1]; /* from 1 */
    char message[MESSAGE];
    int fail;
} Controller;

static const char *library, *records, *work, *program, *other;
static char file[1024]; /* that the host names */
static int port;

/* Nobody listens there. */
static int free_port(void)
{
    struct sockaddr_in address = {.sin_family = AF_INET, .sin_addr = {htonl(INADDR_LOOPBACK)}};
    socklen_t size = sizeof address;
    const int one = socket(AF_INET, SOCK_STREAM, 0);
    REQUIRE(bind(one, (struct sockaddr *)&address, size) == 0);
    REQUIRE(getsockname(one, (struct sockaddr *)&address, &size) == 0);
    close(one);
    return ntohs(address.sin_port);
}

/* The file of records, and settings of the plant behind them. */
static void write_file(const char *scenario, const char *settings)
{
    char text[4096];
    FILE *from = fopen(records, "rb");
    REQUIRE(from != NULL);
    const size_t size = fread(text, 1, sizeof text, from);
    fclose(from);
    snprintf(file, sizeof file, "%s/%s_records.ini", work, scenario);
    FILE *to = fopen(file, "wb");
    REQUIRE(to != NULL && fwrite(text, 1, size, to) == size);
    fprintf(to, "\n[plant]\nport = %d\n%s", port, settings);
    fclose(to);
}

static void call(Controller *controller, int status, double time)
{
    static char out[1024];
    controller->records[1] = (float)status;
    controller->records[2] = (float)time;
    controller->records[3] = 0.0125F;
    controller->records[49] = MESSAGE;
    controller->records[50] = (float)strlen(file);
    controller->fail = 99;
    controller->message[0] = '\0';
    controller->function(controller->records + 1, &controller->fail, file, out, controller->message);
    snprintf(last_message, sizeof last_message, "%s", controller->message);
}

static Controller open_controller(const char *name)
{
    Controller controller = {.function = NULL};
    *(void **)&controller.function = symbol(open_library(name), "DISCON");
    return controller;
}

static Program start_node(const char *name)
{
    char master[80];
    snprintf(master, sizeof master, "--master=udp://127.0.0.1:%d", port);
    char *of_part[] = {(char *)program, "--part", (char *)name, "--stay", master, NULL};
    char *of_controller[] = {(char *)program, "--same-cycle", "--stay", master, NULL};
    return start_program(name ? of_part : of_controller);
}

/* It waits for the next master. */
static void end_node(Program *node)
{
    REQUIRE(kill(node->process, SIGTERM) == 0 && finish(node) == 0);
}

static Controller begin(Program *tank, Program *display)
{
    Controller held = open_controller(library);
    *tank = start_node("tank");
    *display = start_node("display");
    call(&held, 0, 0);
    REQUIRE(held.fail == 0);
    return held;
}

/* The controller on the network gives the same bits as the one in the library. */
static void equal(void)
{
    write_file("equal", "");
    Program node = start_node(NULL);
    Controller held = open_controller(library), own = open_controller(other);
    for (int step = 0; step <= 4800; ++step) { /* a minute */
        const float speed = (float)(100 + 40 * sin(0.002 * step)), pitch = (float)(0.1 + 0.1 * cos(0.003 * step));
        Controller *controllers[] = {&held, &own};
        for (int i = 0; i < 2; ++i) {
            controllers[i]->records[20] = speed;
            controllers[i]->records[4] = controllers[i]->records[33] = controllers[i]->records[34] = pitch;
            if (i == 1)
                snprintf(file, sizeof file, "%s", records);
            else
                snprintf(file, sizeof file, "%s/equal_records.ini", work);
            call(controllers[i], step == 0 ? 0 : 1, 0.0125 * step);
            REQUIRE(controllers[i]->fail == 0);
        }
        REQUIRE(held.records[47] == own.records[47] && held.records[47] > 0);
        REQUIRE(held.records[42] == own.records[42] && held.records[44] == own.records[44]);
    }
    call(&held, -1, 61);
    REQUIRE(held.fail == 0);
    end_node(&node);
}

static void values_pass(void)
{
    Program tank, display;
    write_file("values_pass", "");
    Controller held = open_controller(library);
    held.records[20] = 3;
    tank = start_node("tank");
    display = start_node("display");
    call(&held, 0, 0);
    REQUIRE(held.fail == 0 && held.records[47] == 8 && held.records[48] == 3); /* 5 + 3; it began with 3 */
    held.records[20] = 2;
    call(&held, 1, 0.0125);
    REQUIRE(held.fail == 0 && held.records[47] == 10);
    call(&held, 1, 0.0125); /* the same time again */
    REQUIRE(held.fail == 0 && held.records[47] == 10);
    call(&held, -1, 0.025);
    REQUIRE(held.fail == 0);
    call(&held, 0, 0); /* once more: the nodes have waited */
    REQUIRE(held.fail == 0 && held.records[47] == 7);
    call(&held, -1, 0.0125);
    end_node(&tank);
    end_node(&display);
}

static void wrong_settings(void)
{
    Controller held = open_controller(library);
    write_file("wrong", "prot = 1\n");
    call(&held, 0, 0);
    REQUIRE(held.fail == -1);
    TOLD("unknown key 'prot'; use port, listen, keys, access, start_timeout, longest_wait");
    write_file("wrong", "longest_wait = 5\n");
    call(&held, 0, 0);
    REQUIRE(held.fail == -1);
    TOLD("longest_wait = 5: use 1 ms to 3600 s, with the unit");
    write_file("wrong", "listen = 0.0.0.0\n");
    call(&held, 0, 0);
    REQUIRE(held.fail == -1);
    TOLD("everybody in that network could command the plant");
    write_file("wrong", "start_timeout = 200 ms\n");
    const double before = now();
    call(&held, 0, 0);
    printf("nodes that never come: %.3f s with start_timeout = 200 ms\n", now() - before);
    REQUIRE(held.fail == -1);
    TOLD("'Tank'");
    call(&held, 1, 0.0125);
    REQUIRE(held.fail == -1);
    TOLD("'Tank'");
}

static void killed_required(void)
{
    Program tank, display;
    write_file("killed_required", "longest_wait = 60 s\n");
    Controller held = begin(&tank, &display);
    REQUIRE(kill(display.process, SIGKILL) == 0);
    int step = 1, warnings = 0;
    for (; warnings == 0 && step < 100000; ++step) {
        call(&held, 1, 0.0125 * step);
        REQUIRE(held.fail == 0 || held.fail == 1);
        warnings += held.fail == 1;
    }
    REQUIRE(warnings == 1);
    TOLD("'Display'");
    call(&held, 1, 0.0125 * step); /* it goes on */
    REQUIRE(held.fail == 0 && held.message[0] == '\0');
    call(&held, -1, 0.0125 * (step + 1));
    REQUIRE(finish(&display) == -SIGKILL);
    end_node(&tank);
}

static bool is_listening(void)
{
    struct sockaddr_in address = {
        .sin_family = AF_INET, .sin_port = htons((uint16_t)port), .sin_addr = {htonl(INADDR_LOOPBACK)}};
    const int client = socket(AF_INET, SOCK_STREAM, 0);
    const bool is_there = connect(client, (struct sockaddr *)&address, sizeof address) == 0;
    close(client);
    return is_there;
}

static void killed_critical(void)
{
    Program tank, display;
    write_file("killed_critical", "longest_wait = 60 s\n");
    Controller held = begin(&tank, &display);
    REQUIRE(kill(tank.process, SIGKILL) == 0);
    for (int step = 1; held.fail >= 0 && step < 100000; ++step)
        call(&held, 1, 0.0125 * step);
    REQUIRE(held.fail == -1 && held.records[47] == -1); /* its safe value */
    REQUIRE(strstr(last_message, "stopped safely") && strstr(last_message, "'Tank'"));
    REQUIRE(finish(&tank) == -SIGKILL);
    REQUIRE(is_listening());
    call(&held, -1, 1e4);
    REQUIRE(held.fail == -1 && !is_listening()); /* the plant ends with the last call, also after a failure */
    TOLD("'Tank'");
    end_node(&display);
}

static void stop_by_a_person(void)
{
    Program tank, display;
    char master[40];
    write_file("stop_by_a_person", "");
    Controller held = begin(&tank, &display);
    snprintf(master, sizeof master, "127.0.0.1:%d", port);
    char *arguments[] = {(char *)other, "--master", master, "stop", NULL};
    Program stop = start_program(arguments);
    REQUIRE(finish(&stop) == 0);
    call(&held, 1, 0.0125);
    REQUIRE(held.fail == -1);
    TOLD("a person or a program has stopped the plant in cycle 1");
    call(&held, -1, 0.025);
    REQUIRE(held.fail == 0);
    end_node(&tank);
    end_node(&display);
}

int main(int argc, char **argv)
{
    static const struct
    {
        const char *name;
        void (*run)(void);
    } scenarios[] = {{"equal", equal},
                     {"values_pass", values_pass},
                     {"wrong_settings", wrong_settings},
                     {"killed_required", killed_required},
                     {"killed_critical", killed_critical},
                     {"stop_by_a_person", stop_by_a_person}};
    if (argc != 7)
        return 2;
    library = argv[2];
    records = argv[3];
    work = argv[4];
    program = argv[5];
    other = argv[6];
    port = free_port();
    for (size_t i = 0; i < sizeof scenarios / sizeof *scenarios; ++i) {
        if (strcmp(argv[1], scenarios[i].name) == 0)
            return scenarios[i].run(), 0;
    }
    fprintf(stderr, "there is no scenario %s\n", argv[1]);
    return 2;
}
