/* SPDX-License-Identifier: Apache-2.0 */
/* A host that holds the master of the kite's plant: model, autopilot and a display are programs, and
 * speak UDP. Prints the digest of all values and the energy, so that a test compares them with a
 * flight of awe_sil. No Qt.
 *
 * usage: watch_kite 2|3 FOLDER PROGRAMS_FOLDER PLANT_PART SECONDS   (of the unpacked FMU)
 */
#include "plant_host.h"

static const char *programs, *part;

static void start_nodes(Plant *plant)
{
    static const char *names[] = {NULL, "awe_compact_model", "awe_autopilot"};
    char master[80], file[1024], line[80];
    snprintf(master, sizeof master, "--master=udp://127.0.0.1:%d", plant->port);
    for (int node = 0; node < 3; ++node) {
        snprintf(file, sizeof file, "%s/%s", programs, names[node] ? names[node] : "");
        char *of_kite[] = {file, master, NULL};
        char *of_display[] = {(char *)part, "--part", "display", "--signal", "energy", master, NULL};
        plant->nodes[node] = start_program(names[node] ? of_kite : of_display);
        if (node == 0) { /* the plant begins without it, too */
            read_line(&plant->nodes[node], line, sizeof line);
            REQUIRE(strcmp(line, "registered") == 0);
        }
    }
}

int main(int argc, char **argv)
{
    char path[1024], shown[80];
    Plant plant;
    if (argc != 6)
        return 2;
    const int version = atoi(argv[1]);
    programs = argv[3];
    part = argv[4];
    snprintf(path, sizeof path, "%s/binaries/%s/awe_watched_plant.so", argv[2],
             version == 2 ? "linux64" : "x86_64-linux");
    const Library library = load_library(version, argv[2], path);
    is_logging = 1;
    make_plant(&plant, &library, start_nodes);
    REQUIRE(set_integer(&plant, "plant.port", 0) == STATUS_OK);
    REQUIRE(enter_plant(&plant) == STATUS_OK && leave_plant(&plant) == STATUS_OK);
    const long cycles = lround(atof(argv[5]) * 100);
    double before = 0, longest = 0;
    for (long cycle = 0; cycle < cycles; ++cycle) {
        before = number(&plant, "energy");
        const double begin = now();
        REQUIRE(step_by(&plant, 1) == STATUS_OK);
        longest = now() - begin > longest ? now() - begin : longest;
    }
    REQUIRE(terminate_plant(&plant) == STATUS_OK);
    read_line(&plant.nodes[0], shown, sizeof shown);
    REQUIRE(atof(shown) == before); /* the display reads the cycle before */
    free_plant(&plant);
    for (int node = 0; node < 3; ++node)
        REQUIRE(finish(&plant.nodes[node]) == 0);
    fprintf(stderr, "the longest of %ld steps took %.1f ms\n", cycles, longest * 1e3);
    printf("%s %.17g\n", plant.digest, before);
    free(library.description.text);
    return 0;
}
