/* SPDX-License-Identifier: Apache-2.0 */
/* A host of controller DLLs, as Bladed and OpenFAST are. No Qt.
 * usage: call_discon LIBRARY RECORDS_FILE WORK_FOLDER
 */
#include "fmu_host.h"

#define RECORDS 200
#define MESSAGE 400

typedef void (*Discon)(float *, int *, char *, char *, char *);

static Discon discon;
static float records[RECORDS + 1]; /* from 1, as the interface counts */
static char message[MESSAGE];
static int fail;

static void call_with(float status, double time, const char *file)
{
    static char name[1024], out[1024];
    records[1] = status;
    records[2] = (float)time;
    if (file)
        snprintf(name, sizeof name, "%s", file);
    records[50] = file ? (float)strlen(file) : 0;
    fail = 99;
    discon(records + 1, &fail, file ? name : NULL, out, message);
    snprintf(last_message, sizeof last_message, "%.*s", MESSAGE, message); /* it may have no end */
}

static void call(int status, double time, const char *file)
{
    call_with((float)status, time, file);
}

static void prepare(void)
{
    memset(records, 0, sizeof records);
    memset(message, 'x', sizeof message);
    records[3] = 0.0125F;
    records[49] = MESSAGE;
    records[20] = 100; /* generator speed [rad/s] */
}

/* The first call with a file of this text fails with this sentence. */
static void refused(const char *folder, const char *text, const char *sentence)
{
    char file[1024];
    snprintf(file, sizeof file, "%s/records.ini", folder);
    FILE *stream = fopen(file, "wb");
    REQUIRE(stream != NULL);
    fputs(text, stream);
    fclose(stream);
    prepare();
    call(0, 0, file);
    REQUIRE(fail == -1);
    TOLD(sentence);
    for (int i = 0; i < 2; ++i) { /* and so do all calls that follow */
        call(i == 0 ? 1 : -1, 0.0125, file);
        REQUIRE(fail == -1);
        TOLD(sentence);
    }
}

static void wrong_files(const char *folder)
{
    prepare();
    call(0, 0, "/nowhere/records.ini");
    REQUIRE(fail == -1);
    TOLD("/nowhere/records.ini");
    call(0, 0, NULL);
    REQUIRE(fail == -1);
    TOLD("names no file");
    call(0, 0, "");
    REQUIRE(fail == -1);
    refused(folder, "", "no signal has a record");
    refused(folder, "[read]\ngeneratorSpeed = 0\n", "records.ini:2: '0' is not a record");
    refused(folder, "[read]\ngeneratorSpeed = 99999\n", "'99999' is not a record");
    refused(folder, "[read]\ngeneratorSpeed = twenty\n", "'twenty' is not a record");
    refused(folder, "[read]\ngeneratorSpeed = 20 * x\n", "'x' is not a number");
    refused(folder, "[read]\ngeneratorSpeed = 20 * 1 * 2\n", "several factors");
    refused(folder, "[read]\ngeneratorSpeed = 20 * 0\n", "with the factor '0', nothing is left of the value");
    refused(folder, "[read]\ngeneratorSpeed = 20 * nan\n", "'nan' is not a number");
    refused(folder, "[constant]\n35 = inf\n", "'inf' is not a number");
    refused(folder, "[read]\ngeneratorSpeed = 20\ngeneratorSpeed = 21\n", "'generatorSpeed' is there twice");
    /* all errors at once */
    refused(folder, "[read]\ngeneratorSpeed = 0\n[write]\ngeneratorTork = 47\n", "records.ini:2: '0' is not a record");
    refused(folder, "[read]\ngeneratorSpeed = 0\n[write]\ngeneratorTork = 47\n", "records.ini:4: ");
    refused(folder, "[read]\ngeneratorSped = 20\n", "did you mean 'generatorSpeed'");
    refused(folder, "[read]\ngeneratorTorque = 47\n", "move it to the section [write]");
    refused(folder, "[write]\ngeneratorSpeed = 47\n", "move it to the section [read]");
    refused(folder, "[read]\nbladePitch = 4\n", "needs 3 records");
    refused(folder, "[write]\ngeneratorTorque = 1\n", "record 1 belongs to the host");
    refused(folder, "[write]\ngeneratorTorque = 47\nbladePitchDemand = 47, 43, 44\n", "record 47 is written twice");
    refused(folder, "[constant]\n47 = 1\n[write]\ngeneratorTorque = 47\n", "written twice");
    refused(folder, "[constant]\n35 = often\n", "'often' is not a number");
    refused(folder, "[reed]\n", "unknown section [reed]");
    refused(folder, "generatorSpeed = 20\n", "write SIGNAL = RECORD");
    refused(folder, "[read]\ngeneratorSpeed\n", "write SIGNAL = RECORD");
}

static void flight(const char *file)
{
    prepare();
    call(0, 0, file);
    REQUIRE(fail == 0);
    REQUIRE(records[47] == 23300 && records[35] == 1); /* k * w^2 */
    records[20] = 130;
    for (int i = 1; i <= 4800; ++i) { /* a minute */
        call(1, 0.0125 * i, file);
        REQUIRE(fail == 0);
    }
    REQUIRE(records[47] == 39377);
    REQUIRE(records[42] > 0.1F && records[42] == records[43] && records[43] == records[44]);
    const float pitch = records[42];
    call(1, 60, file); /* the same time again: the same answer */
    REQUIRE(fail == 0 && records[42] == pitch);
    records[20] = 100;
    call(1, 60.5, file); /* times that the host leaves out */
    REQUIRE(fail == 0 && records[42] != pitch);
    call(1, 10, file);
    REQUIRE(fail == -1);
    TOLD("time must not go back");
    call(1, NAN, file);
    REQUIRE(fail == -1);
    TOLD("the time in record 2 is not a finite number");
    call(1, 1e30, file);
    REQUIRE(fail == -1);
    TOLD("too late for a controller with a period of 0.0125 s");
    static const float statuses[] = {7, -8, 0.5F, NAN, INFINITY};
    for (size_t i = 0; i < sizeof statuses / sizeof *statuses; ++i) {
        records[42] = -1;
        call_with(statuses[i], 60.5125, file); /* neither a step nor an end */
        REQUIRE(fail == -1 && records[42] == -1);
        TOLD("use 0 (first call), 1 (step) or -1 (last call)");
    }
    call(1, 60.5125, file);
    REQUIRE(fail == 0);
    records[20] = NAN; /* no measurement: the last good one counts */
    const float torque = records[47];
    call(1, 60.525, file);
    REQUIRE(fail == 0 && records[47] == torque);
    call(-1, 60.5375, file);
    REQUIRE(fail == 0);
    call(1, 60.55, file);
    REQUIRE(fail == -1);
    TOLD("there was no first call (record 1 = 0) before this one");
    prepare();
    call(0, 0, file); /* once more */
    REQUIRE(fail == 0 && records[47] == 23300);
    call(-1, 0.0125, file);
}

static void wrong_calls(const char *file)
{
    fail = 99;
    discon(NULL, &fail, NULL, NULL, message);
    REQUIRE(fail == -1);
    discon(records + 1, NULL, NULL, NULL, NULL);
    prepare();
    records[3] = 0;
    call(0, 0, file);
    REQUIRE(fail == -1);
    TOLD("the period in record 3 is 0 s");
    records[3] = NAN;
    call(0, 0, file);
    REQUIRE(fail == -1);
    records[3] = 0.0125F;
    call(0, NAN, file);
    REQUIRE(fail == -1);
    TOLD("record 2");
    prepare();
    records[49] = 10; /* room for nine characters */
    message[9] = message[10] = 'x';
    call(0, 0, "/nowhere");
    REQUIRE(fail == -1 && strlen(message) == 9 && message[10] == 'x');
    records[49] = 0; /* none */
    message[0] = 'x';
    call(0, 0, "/nowhere");
    REQUIRE(fail == -1 && message[0] == 'x');
    records[49] = NAN;
    call(0, 0, "/nowhere");
    REQUIRE(fail == -1 && message[0] == 'x');
    records[1] = 0;
    records[50] = 8;
    discon(records + 1, &fail, NULL, NULL, NULL);
    REQUIRE(fail == -1);
}

/* Two turbines in one host have a copy of the library each. */
static void two_turbines(const char *library, const char *file, const char *folder)
{
    char command[2048], copy[1024];
    const Discon first = discon;
    snprintf(copy, sizeof copy, "%s/second_turbine.so", folder);
    snprintf(command, sizeof command, "cp '%s' '%s'", library, copy);
    REQUIRE(system(command) == 0);
    const Discon second = (Discon)symbol(open_library(copy), "DISCON");
    float torques[2] = {0, 0};
    for (int status = 0; status >= -1; status = status == 0 ? 1 : status == 1 ? -1 : -2) {
        for (int turbine = 0; turbine < 2; ++turbine) {
            prepare();
            records[20] = turbine == 0 ? 100 : 110;
            discon = turbine == 0 ? first : second;
            call(status, status == 0 ? 0 : 0.0125, file);
            REQUIRE(fail == 0);
            if (status == 1)
                torques[turbine] = records[47];
        }
    }
    REQUIRE(torques[0] == 23300 && torques[1] == 28193); /* k * w^2 */
    discon = first;
}

int main(int argc, char **argv)
{
    if (argc != 4)
        return 2;
    void *library = open_library(argv[1]);
    *(void **)&discon = symbol(library, "DISCON");
#ifndef QTPLC_IS_SHARED                                        /* else dlsym() looks into its library, too */
    REQUIRE(dlsym(library, "_ZN13QPlcSlaveNodeD1Ev") == NULL); /* nothing else is exported */
#endif
    wrong_files(argv[3]);
    wrong_calls(argv[2]);
    flight(argv[2]);
    two_turbines(argv[1], argv[2], argv[3]);
    dlclose(library);
    puts("DISCON is as it should be");
    return 0;
}
